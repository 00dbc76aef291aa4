//! The position, rotation and size of a pattern.

use crate::fault::{Fault, check_held, check_number, check_numbers, check_point};
use crate::math::{LatticeCoordinate, Linear, Real, Scale, Vec3};

/// The coordinates that a pattern is a function of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Space {
    /// The coordinates of the scene: the surface cuts through the pattern, as through a block of wood.
    Scene,
    /// The texture coordinates of the surface, as for wallpaper: x is u, y is v, and z is 0. Each shape
    /// defines its u and v, see [`Intersect::uv`](crate::shape::Intersect::uv).
    Surface,
}

/// The placement of a pattern: it is stretched first, then turned, then moved.
///
/// ```
/// use rayline::{Placement, Vec3};
/// // Twice around and once up.
/// let wallpaper = Placement::SURFACE.stretched(Vec3::new(0.5, 1.0, 1.0));
/// // One unit of the pattern is half a unit of the scene; turned upright, with its origin at (0, 1, 0).
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
    /// The coordinates that the pattern is a function of.
    pub space: Space,
    /// The length of one unit of the pattern along each of its axes, in units of the scene or of u and v; at
    /// least 1e-6. A negative length mirrors the pattern.
    pub size: Vec3,
    /// The rotation about the x axis, then about y, then about z: angles in radians, counterclockwise as seen
    /// from the end of the axis. On a surface only the rotation about z is useful.
    pub rotation: Vec3,
    /// The position of the pattern's origin. In fixed point each coordinate lies within ±59 on a surface, and
    /// within ±59 divided by the scale in the scene, see [`Fixed`](crate::math::Fixed).
    pub origin: Vec3,
}

impl Placement {
    /// The placement on a surface by its u and v, unchanged.
    pub const SURFACE: Self = Self {
        space: Space::Surface,
        size: Vec3::new(1.0, 1.0, 1.0),
        rotation: Vec3::ZERO,
        origin: Vec3::ZERO,
    };

    /// A placement in the scene, with the origin of the scene; one unit of the pattern is `size` units long.
    pub const fn in_scene(size: f32) -> Self {
        Self { space: Space::Scene, size: Vec3::new(size, size, size), ..Self::SURFACE }
    }

    /// This placement with another origin.
    pub const fn at(self, origin: Vec3) -> Self {
        Self { origin, ..self }
    }

    /// This placement with another rotation.
    pub const fn turned(self, rotation: Vec3) -> Self {
        Self { rotation, ..self }
    }

    /// This placement with another size.
    pub const fn stretched(self, size: Vec3) -> Self {
        Self { size, ..self }
    }

    pub(super) fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedPlacement<R>, Fault> {
        let Vec3 { x, y, z } = self.size;
        check_numbers(self.rotation)?;
        check_point(self.origin)?;
        for size in [x, y, z] {
            check_number(size)?;
            // Pixels show only noise of smaller patterns.
            if size.abs() < 1e-6 {
                return Err(Fault::PatternSize);
            }
        }
        // Only patterns in the scene are scaled with it.
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
    /// The maps from the scene or the surface to the pattern's coordinates.
    axes: [R::Linear; 3],
}

impl<R: Real> PreparedPlacement<R> {
    /// The point of the scene, or u and v, at which the pattern is evaluated.
    #[inline]
    pub(super) fn place(&self, point: Vec3<R>, uv: impl FnOnce() -> [R; 2]) -> Vec3<R> {
        match self.space {
            Space::Scene => point,
            Space::Surface => {
                let [u, v] = uv();
                Vec3::new(u, v, R::ZERO)
            }
        }
    }

    /// The pattern's coordinates at `place`.
    pub(super) fn coordinates(&self, place: Vec3<R>) -> [LatticeCoordinate<R>; 3] {
        self.axes.map(|axis| axis.split_at(place))
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
        // The x axis of the pattern is the y axis of the scene.
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
        // The limit depends on the scale in the scene, but not on a surface.
        let scale = Scale::new::<Fixed>(Extent::solid(8.0), Vec3::ZERO);
        let unit = 1.0 / scale.to_f32();
        assert!(unit > 1.0);
        for (placement, most) in [(good, 59.0 * unit), (Placement::SURFACE, 59.0)] {
            let refusal = |x| placement.at(Vec3::new(x, 0.0, 0.0)).prepare::<Fixed>(scale).err();
            assert_eq!((refusal(most), refusal(most * 1.001)), (None, Some(Fault::OutOfRange)));
        }
    }
}
