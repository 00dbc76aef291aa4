//! What light goes through between two surfaces: its index of refraction, and what it absorbs (Beer's law).

use crate::color::{LinearRgb, check_channel};
use crate::fault::{Fault, check_number};
use crate::math::{Product, Real, Scale};
use crate::throughput::Throughput;

/// What fills the space on one side of a surface.
///
/// Behind a surface there is what its [`Material`](super::Material) says: its index and its absorption. In front there is air, unless
/// [`Optics::outside`](super::Optics::outside) says otherwise. Each surface knows what lies on its two sides, and no ray has to remember
/// where it is: one rule for what is solid, open, nested or put together from faces. Where two bodies touch there is *one*
/// surface, with the one in front and the other behind.
///
/// | surface | normal toward | [`ior`](super::Material::ior), behind | `outside`, in front |
/// |---|---|---|---|
/// | a bubble in a ball of glass | the glass | 1 | 1.5 |
/// | ice in water, all of it | the water | 1.31 | 1.33 |
/// | a glass: outer wall, foot, rim, inner wall above the water | the air | 1.5 | 1 |
/// | its inner wall below the water | the water | 1.5 | 1.33 |
/// | the water's surface | the air | 1.33 | 1 |
///
/// The inside of an open cylinder is behind it: for an inner wall, swap the two.
///
/// ```
/// use rayline::{Material, Medium, Optics, materials};
/// const GLASS: f32 = materials::GLASS.ior;
/// const BUBBLE: Material = Material {
///     ior: 1.0,
///     optics: Some(&Optics { outside: Medium::clear(GLASS), ..Optics::CLEAR }),
///     ..materials::GLASS
/// };
/// /// The wall of a cylinder of water within glass.
/// const WATER_IN_GLASS: Material = Material { ior: materials::WATER.ior, ..BUBBLE };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
pub struct Medium {
    /// Index of refraction: air is 1, water 1.33, glass about 1.5.
    pub ior: f32,
    /// Coefficients of absorption, per unit of length, 0 or more: after a way s, exp(-coefficient s) is left of light.
    pub absorption: LinearRgb,
}

impl Medium {
    /// Air, or nothing at all.
    pub const AIR: Self = Self::clear(1.0);

    /// Something of this index of refraction that absorbs nothing.
    pub const fn clear(ior: f32) -> Self {
        Self { ior, absorption: LinearRgb::gray(0.0) }
    }
}

impl Default for Medium {
    fn default() -> Self {
        Self::AIR
    }
}

/// Refuses an index of refraction that is not positive.
pub(super) fn check_ior<R: Real>(ior: f32) -> Result<R::Setup, Fault> {
    check_number(ior)?;
    // A tiny index has a reciprocal that no longer is a sane number.
    if ior < 1e-3 { Err(Fault::IorNotPositive) } else { Ok(R::Setup::from_f32(ior)) }
}

/// What a medium absorbs, prepared.
///
/// In fixed point a unit of the kernel may be the whole scene, so that a coefficient per unit is too large to be held, while what shows is
/// absorbed on a small part of the unit. So coefficients are halved until they can be held, and what comes out is doubled again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Absorption<R> {
    /// How often light halves on each unit of length, over 2 to the power of `doublings`.
    halvings: LinearRgb<R>,
    doublings: u8,
    /// More than so much of that does not show, and may not be held.
    most: R,
}

impl<R: Real> Absorption<R> {
    /// The largest coefficient that is held, and the most by which one is made smaller for that.
    const LARGEST: f32 = 120.0;
    const MOST_DOUBLINGS: u8 = 20;
    /// Of 2⁻²⁴ of light nothing shows.
    const MOST_HALVINGS: f32 = 24.0;

    /// Checks the coefficients and converts them; `None` where nothing is absorbed.
    pub(super) fn prepare(coefficients: LinearRgb, scale: Scale) -> Result<Option<Self>, Fault> {
        coefficients.channels().into_iter().try_for_each(check_channel)?;
        let LinearRgb { r, g, b } = coefficients;
        let strongest = r.larger(g).larger(b);
        if !(strongest > 0.0) {
            return Ok(None);
        }
        let (mut unit, mut most, mut doublings) =
            (core::f32::consts::LOG2_E / scale.to_f32(), Self::MOST_HALVINGS, 0);
        while strongest * unit > Self::LARGEST && doublings < Self::MOST_DOUBLINGS {
            (unit, most, doublings) = (unit * 0.5, most * 0.5, doublings + 1);
        }
        // Where it is still more, less than 2⁻¹²⁰ is left on a millionth of the scene.
        let halvings = |coefficient: f32| R::from_f32((coefficient * unit).min(Self::LARGEST));
        let halvings = LinearRgb::new(halvings(r), halvings(g), halvings(b));
        Ok(Some(Self { halvings, doublings, most: R::from_f32(most) }))
    }

    /// What is left of light after a way of this length; `None`: a way without end, however far the number system reaches.
    pub(super) fn left_after(&self, length: Option<R>) -> Throughput<R> {
        let LinearRgb { r, g, b } = self.halvings;
        let left = |halvings: R| {
            let Some(length) = length else {
                return if halvings > R::ZERO { R::ZERO } else { R::ONE };
            };
            let times = halvings.times(length);
            if times > self.most.times(R::ONE) {
                return R::ZERO;
            }
            (0..self.doublings).fold(times.over(R::ONE), |times, _| times + times).halved()
        };
        Throughput::colored(LinearRgb::new(left(r), left(g), left(b)))
    }
}

#[cfg(test)]
#[cfg(feature = "optics")]
mod tests {
    use super::*;
    use crate::math::{Extent, Fixed, Vec3};

    /// In a scene of 256 units and in one of 2, on a way of half a unit and none.
    fn assert_absorbs<R: Real>() {
        for size in [1.0, 128.0] {
            let scale = Scale::new::<R>(Extent::solid(size), Vec3::ZERO);
            let coefficients = LinearRgb::new(0.25, 2.0, 40.0);
            let absorption = Absorption::<R>::prepare(coefficients, scale).unwrap().unwrap();
            for way in [0.5, 0.0] {
                let way_there = scale.length(R::Setup::from_f32(way));
                let left = absorption.left_after(Some(way_there)).color().to_f32();
                let expected = coefficients.channels().map(|coefficient| (-coefficient * way).exp());
                for (left, expected) in left.channels().into_iter().zip(expected) {
                    assert!((left - expected).abs() < 2e-5, "{size} {way}: {left}, not {expected}");
                }
            }
        }
    }

    #[test]
    fn a_way_without_end_absorbs_all_light() {
        // In fixed point rays end after 59 units, where half of the light is left.
        fn check<R: Real>() {
            let scale = Scale::new::<R>(Extent::solid(0.5), Vec3::ZERO);
            let coefficients = LinearRgb::new(0.0, 0.01, 4.0);
            let absorption = Absorption::<R>::prepare(coefficients, scale).unwrap().unwrap();
            assert_eq!(absorption.left_after(None).color().to_f32(), LinearRgb::new(1.0, 0.0, 0.0));
        }
        check::<f32>();
        check::<f64>();
        check::<Fixed>();
    }

    #[test]
    fn large_scenes_absorb_as_much_as_small_ones() {
        assert_absorbs::<f32>();
        assert_absorbs::<f64>();
        assert_absorbs::<Fixed>();
    }
}
