//! Where a pattern lies, and how large it is.

use crate::fault::{Fault, check_held, check_number, check_numbers, check_point};
use crate::math::{Cell, Linear, Real, Scale, Vec3};

/// What a pattern varies over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Space {
    /// Over space: the surface cuts through it, as through a block of wood.
    Scene,
    /// Over the place on a surface: u is x, v is y, and z is 0, as with wallpaper. Each shape has its own u and v, see
    /// [`Intersect::uv`](crate::shape::Intersect::uv).
    Surface,
}

/// How a pattern is moved, turned and stretched. It is stretched first, then turned, then moved.
///
/// ```
/// use rayline::{Placement, Vec3};
/// // Twice around and once up.
/// let wallpaper = Placement::SURFACE.stretched(Vec3::new(0.5, 1.0, 1.0));
/// // As large as half a unit, about a point, and turned upright.
/// let grain = Placement::in_scene(0.5).turned(Vec3::new(1.57, 0.0, 0.0)).at(Vec3::new(0.0, 1.0, 0.0));
/// # assert_eq!((wallpaper.size.x, grain.size.x), (0.5, 0.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
pub struct Placement {
    /// What the pattern varies over.
    pub space: Space,
    /// How long one unit of the pattern is along each of its axes; not 0. Negative: mirrored.
    pub size: Vec3,
    /// By which angles it is turned about the x axis, then about y, then about z; in radians, counterclockwise as seen
    /// from the axis' end. Over a surface, only the last has a meaning.
    pub rotation: Vec3,
    /// Where the pattern's origin lies. In fixed point, each coordinate lies within ±59: in the scene, ±59 divided by its scale, see
    /// [`Fixed`](crate::math::Fixed).
    pub origin: Vec3,
}

impl Placement {
    /// Over the place on a surface, as it is.
    pub const SURFACE: Self = Self {
        space: Space::Surface,
        size: Vec3::new(1.0, 1.0, 1.0),
        rotation: Vec3::ZERO,
        origin: Vec3::ZERO,
    };

    /// In space, with its origin where that of the scene is; one unit of it is so long.
    pub const fn in_scene(size: f32) -> Self {
        Self { space: Space::Scene, size: Vec3::new(size, size, size), ..Self::SURFACE }
    }

    /// The same with its origin elsewhere.
    pub const fn at(self, origin: Vec3) -> Self {
        Self { origin, ..self }
    }

    /// The same, turned.
    pub const fn turned(self, rotation: Vec3) -> Self {
        Self { rotation, ..self }
    }

    /// The same in another size.
    pub const fn stretched(self, size: Vec3) -> Self {
        Self { size, ..self }
    }

    pub(super) fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedPlacement<R>, Fault> {
        let Vec3 { x, y, z } = self.size;
        check_numbers(self.rotation)?;
        check_point(self.origin)?;
        for size in [x, y, z] {
            check_number(size)?;
            // Smaller than that, no pixel shows more than noise.
            if size.abs() < 1e-6 {
                return Err(Fault::PatternSize);
            }
        }
        // Only what lies in space is scaled.
        let scale = if self.space == Space::Scene { scale } else { Scale::ONE };
        let origin = scale.setup_point::<R>(self.origin.to());
        [origin.x, origin.y, origin.z].into_iter().try_for_each(check_held::<R>)?;
        let (one, none) = (R::Setup::ONE, R::Setup::ZERO);
        let axis = |unit: Vec3<R::Setup>, size: f32| {
            let per_unit = (R::Setup::from_f32(size) * R::Setup::from_f32(scale.to_f32())).recip();
            R::Linear::new(unit.rotated(self.rotation) * per_unit, origin)
        };
        Ok(PreparedPlacement {
            space: self.space,
            axes: [
                axis(Vec3::new(one, none, none), x),
                axis(Vec3::new(none, one, none), y),
                axis(Vec3::new(none, none, one), z),
            ],
        })
    }
}

impl Default for Placement {
    fn default() -> Self {
        Self::SURFACE
    }
}

/// A [`Placement`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PreparedPlacement<R: Real> {
    space: Space,
    /// From space or surface to the pattern's coordinates.
    axes: [R::Linear; 3],
}

impl<R: Real> PreparedPlacement<R> {
    /// Where the pattern is looked at: at a point of space or of the surface.
    #[inline(always)]
    pub(super) fn place(&self, point: Vec3<R>, uv: impl FnOnce() -> [R; 2]) -> Vec3<R> {
        match self.space {
            Space::Scene => point,
            Space::Surface => {
                let [u, v] = uv();
                Vec3::new(u, v, R::ZERO)
            }
        }
    }

    /// The pattern's coordinates there.
    pub(super) fn coordinates(&self, place: Vec3<R>) -> [Cell<R>; 3] {
        self.axes.map(|axis| axis.cell(place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Extent, Fixed};

    fn assert_placed<R: Real>() {
        let quarter = core::f32::consts::FRAC_PI_2;
        let placement =
            Placement::in_scene(0.5).turned(Vec3::new(0.0, 0.0, quarter)).at(Vec3::new(1.0, 2.0, 3.0));
        let scale = Scale::new::<R>(Extent::solid(8.0), Vec3::ZERO);
        let prepared = placement.prepare::<R>(scale).unwrap();
        let point = scale.point::<R>(Vec3::new(1.0, 2.75, 3.125).to());
        let got = prepared.coordinates(prepared.place(point, || unreachable!())).map(|c| c.number().to_f32());
        // Along y there, it is x of the pattern.
        for (got, expected) in got.into_iter().zip([1.5, 0.0, 0.25]) {
            assert!((got - expected).abs() < 1e-5, "{got:?}, not {expected}");
        }
        let surface = Placement::SURFACE.stretched(Vec3::new(0.5, -1.0, 1.0)).prepare::<R>(scale).unwrap();
        let place = surface.place(point, || [R::from_f32(0.75), R::from_f32(0.25)]);
        let got = surface.coordinates(place).map(|c| c.number().to_f32());
        assert_eq!(got, [1.5, -0.25, 0.0]);
    }

    #[test]
    fn stretched_then_turned_then_moved() {
        assert_placed::<f32>();
        assert_placed::<f64>();
        assert_placed::<Fixed>();
    }

    #[test]
    fn bad_placements_are_refused() {
        let refusal = |placement: Placement| placement.prepare::<f32>(Scale::ONE).err();
        let good = Placement::in_scene(1.0);
        assert_eq!(refusal(good), None);
        assert_eq!(refusal(Placement::in_scene(0.0)), Some(Fault::PatternSize));
        assert_eq!(refusal(Placement::in_scene(f32::NAN)), Some(Fault::NotFinite));
        assert_eq!(refusal(good.at(Vec3::new(2e6, 0.0, 0.0))), Some(Fault::TooFar));
        assert_eq!(refusal(good.turned(Vec3::new(0.0, f32::INFINITY, 0.0))), Some(Fault::NotFinite));
        let far = good.at(Vec3::new(1e5, 0.0, 0.0));
        assert_eq!(far.prepare::<Fixed>(Scale::ONE).err(), Some(Fault::OutOfRange));
        // In the scene its scale counts, and on a surface it does not.
        let scale = Scale::new::<Fixed>(Extent::solid(8.0), Vec3::ZERO);
        let unit = 1.0 / scale.to_f32();
        assert!(unit > 1.0);
        for (placement, most) in [(good, 59.0 * unit), (Placement::SURFACE, 59.0)] {
            let refusal = |x| placement.at(Vec3::new(x, 0.0, 0.0)).prepare::<Fixed>(scale).err();
            assert_eq!((refusal(most), refusal(most * 1.001)), (None, Some(Fault::OutOfRange)));
        }
    }
}
