//! Media: the index of refraction and the absorption (Beer's law) of the space between surfaces.

use crate::color::{LinearRgb, check_channel};
use crate::fault::{Fault, check_number};
use crate::math::{Product, Real, Scale};
use crate::share::Share;

/// The medium that fills the space on one side of a surface.
///
/// Behind a surface lies the medium of its [`Material`](super::Material): its `ior` and its absorption. In
/// front of it lies air, or [`Optics::outside`](super::Optics::outside). So each surface names the media on
/// its two sides, and a ray does not have to remember which bodies it is inside of. This one rule serves
/// solid, open and nested bodies, and bodies made of faces. Where two bodies touch, describe *one* surface,
/// with one medium in front and the other behind.
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
    /// Index of refraction, 0.001 or more: air is 1, water 1.33, glass about 1.5.
    pub ior: f32,
    /// Coefficients of absorption per unit of length, 0 or more: after a distance s, the share
    /// exp(-coefficient · s) of the light is left.
    pub absorption: LinearRgb,
}

impl Medium {
    /// Air or vacuum.
    pub const AIR: Self = Self::clear(1.0);

    /// A medium with this index of refraction that absorbs no light.
    pub const fn clear(ior: f32) -> Self {
        Self { ior, absorption: LinearRgb::gray(0.0) }
    }
}

impl Default for Medium {
    fn default() -> Self {
        Self::AIR
    }
}

/// Refuses an index of refraction below 0.001.
pub(super) fn check_ior<R: Real>(ior: f32) -> Result<R::Setup, Fault> {
    check_number(ior)?;
    // The reciprocal of a tiny index would be out of range.
    if ior < 1e-3 { Err(Fault::IorNotPositive) } else { Ok(R::Setup::from_f32(ior)) }
}

/// The absorption of a medium, prepared.
///
/// In fixed point one unit of the kernel may be as long as the whole scene. A coefficient per unit may then
/// be out of range, although the light visibly fades within a small part of the unit. So coefficients are
/// halved until they are in range, and the product with the distance is doubled as often.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Absorption<R> {
    /// The number of halvings of light per unit of length, divided by 2 to the power of `doublings`.
    halvings: LinearRgb<R>,
    doublings: u8,
    /// The largest product of `halvings` and distance that leaves visible light. Larger products may be out
    /// of range.
    most: R,
}

impl<R: Real> Absorption<R> {
    /// The largest value of `halvings`. `MOST_DOUBLINGS` bounds how often a coefficient is halved to get
    /// there.
    const LARGEST: f32 = 120.0;
    const MOST_DOUBLINGS: u8 = 20;
    /// 2⁻²⁴ of the light is invisible.
    const MOST_HALVINGS: f32 = 24.0;

    /// Checks the coefficients and converts them; `None` where all are 0.
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
        // If a coefficient is still larger, less than 2⁻¹²⁰ of the light is left after a millionth of the
        // scene.
        let halvings = |coefficient: f32| R::from_f32((coefficient * unit).min(Self::LARGEST));
        let halvings = LinearRgb::new(halvings(r), halvings(g), halvings(b));
        Ok(Some(Self { halvings, doublings, most: R::from_f32(most) }))
    }

    /// The share of light that is left after this distance; `None` is an infinite distance.
    pub(super) fn left_after(&self, length: Option<R>) -> Share<R> {
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
        Share::colored(LinearRgb::new(left(r), left(g), left(b)))
    }
}

#[cfg(test)]
#[cfg(feature = "optics")]
mod tests {
    use super::*;
    use crate::math::{Extent, Fixed, Vec3};

    /// In scenes of 2 and 256 units, after distances of 0.5 and 0.
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
    fn an_infinite_distance_absorbs_all_light() {
        // In fixed point rays end after 59 units, where half of the light would still be left.
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
