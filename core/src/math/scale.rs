//! How large a scene is, and how large it is traced.

use super::{Real, Vec3};

/// How far the parts of a scene extend: the largest absolute coordinates, by kind of shape.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    /// The largest coordinate of curved shapes. Their squares and slopes need the most room.
    pub solid: f32,
    /// The largest coordinate of bounded flat shapes.
    pub flat: f32,
    /// The distance of the farthest infinite plane from the origin; `None` if there is no such plane.
    pub plane: Option<f32>,
}

impl Extent {
    /// The extent of a curved shape whose coordinates are within ±`magnitude`.
    pub const fn solid(magnitude: f32) -> Self {
        Self { solid: magnitude, flat: 0.0, plane: None }
    }

    /// The extent of a bounded flat shape whose coordinates are within ±`magnitude`.
    pub const fn flat(magnitude: f32) -> Self {
        Self { solid: 0.0, flat: magnitude, plane: None }
    }

    /// The extent of a flat shape between these points.
    pub(crate) fn flat_between(points: impl IntoIterator<Item = Vec3>) -> Self {
        Self::flat(points.into_iter().fold(0.0, |most: f32, point| most.larger(point.magnitude())))
    }

    /// The extent of an infinite plane at this distance from the origin.
    pub const fn plane(distance: f32) -> Self {
        Self { solid: 0.0, flat: 0.0, plane: Some(distance) }
    }

    /// The extent of both together.
    pub fn union(self, other: Self) -> Self {
        Self {
            solid: self.solid.larger(other.solid),
            flat: self.flat.larger(other.flat),
            plane: match (self.plane, other.plane) {
                (Some(a), Some(b)) => Some(a.larger(b)),
                (a, b) => a.or(b),
            },
        }
    }
}

/// The factor from the units of a scene's description to the units in which a number system traces it: a
/// power of two.
///
/// For floating point it is 1. A number system with little range ([`Real::IS_FIXED_POINT`]) gets the scene
/// such that its solids lie within 1/2 of the origin, and flat shapes, eye and lights within 8. Where there
/// are infinite planes, these, eye and solids lie within 1/4, and the eye is no farther from any plane than
/// 1/2: a plane is then seen 118 times as far as the eye is away from it, and most often more than 200 times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale(f32);

impl Scale {
    /// The scene as it is described.
    pub const ONE: Self = Self(1.0);

    /// How far solids may extend, after scaling.
    const SOLID: f32 = 0.5;
    /// How far solids, the eye and planes may extend in a scene with a plane: the last line before the
    /// horizon of a picture of 240 lines is then nearer than the end of a ray.
    const ON_PLANE: f32 = 0.25;
    /// How far from a plane the eye may be: the plane is then seen up to half a degree below the horizon.
    const ABOVE_PLANE: f32 = 0.5;
    /// How far flat shapes may extend, and how far eye and lights may be from the origin.
    const NEAR: f32 = 8.0;

    /// The scale for a scene that is seen from `eye`.
    pub fn new<R: Real>(extent: Extent, eye: Vec3) -> Self {
        if !R::IS_FIXED_POINT {
            return Self::ONE;
        }
        let (from_origin, eye) = (eye.length(), eye.magnitude());
        // The distance between eye and plane is at most the sum of their distances from the origin.
        let (near, limit, height) = match extent.plane {
            Some(plane) => (extent.solid.larger(eye).larger(plane), Self::ON_PLANE, plane + from_origin),
            None => (extent.solid, Self::SOLID, 0.0),
        };
        let fits = |scale: f32| {
            near * scale <= limit
                && height * scale <= Self::ABOVE_PLANE
                && extent.flat * scale <= Self::NEAR
                // All eyes that are no farther from the origin are then near.
                && from_origin * scale <= Self::NEAR
        };
        // The largest scale that fits, from 2⁻³⁰ to 2³⁰: coordinates end at 10⁶, and a scene smaller than
        // 10⁻⁹ is a point.
        let mut scale = (1u32 << 30) as f32;
        for _ in 0..60 {
            if fits(scale) {
                break;
            }
            scale *= 0.5;
        }
        Self(scale)
    }

    /// How many units of the traced scene one unit of its description is.
    pub fn to_f32(self) -> f32 {
        self.0
    }

    /// The scale for a scene that is larger by this factor.
    pub(crate) fn enlarged(self, factor: f32) -> Self {
        Self(self.0 * factor)
    }

    /// A length or coordinate, scaled.
    pub fn length<R: Real>(self, length: R::Setup) -> R {
        R::from_setup(self.setup::<R>(length))
    }

    /// A point, scaled.
    pub fn point<R: Real>(self, point: Vec3<R::Setup>) -> Vec3<R> {
        Vec3::from_setup(self.setup_point::<R>(point))
    }

    /// A length or coordinate, scaled but not yet rounded.
    pub fn setup<R: Real>(self, length: R::Setup) -> R::Setup {
        length * R::Setup::from_f32(self.0)
    }

    /// A point, scaled but not yet rounded.
    pub fn setup_point<R: Real>(self, point: Vec3<R::Setup>) -> Vec3<R::Setup> {
        point * R::Setup::from_f32(self.0)
    }

    /// A coordinate in the scene's units again. If it is beyond the range of the number system, the result
    /// differs from it by a multiple of 256.
    pub fn unscaled<R: Real>(self, coordinate: R) -> R {
        let (mut coordinate, mut scale) = (coordinate, self.0);
        // In fixed point sums wrap. The scale is 2⁻³⁰ or more.
        while scale < 1.0 {
            (coordinate, scale) = (coordinate + coordinate, scale + scale);
        }
        if scale > 1.0 { coordinate * R::from_f32(1.0 / scale) } else { coordinate }
    }

    /// `true` if an eye or light at this point is near enough to the origin.
    pub fn is_near<R: Real>(self, point: Vec3) -> bool {
        !R::IS_FIXED_POINT || point.magnitude() * self.0 <= Self::NEAR
    }

    /// `true` if an eye at this distance from an infinite plane sees it up to the horizon.
    pub(crate) fn is_near_plane<R: Real>(height: R) -> bool {
        // The height of the eye that a scene was prepared with is rounded.
        !R::IS_FIXED_POINT || height.abs() <= R::from_f32(Self::ABOVE_PLANE) + R::offset(R::ONE)
    }

    /// The largest power of two, 1 or less, that brings a point with coordinates of up to 10⁶ units [near
    /// enough](Self::is_near).
    pub(crate) fn shrink(self, point: Vec3) -> f32 {
        let mut shrink = 1.0;
        while point.magnitude() * self.0 * shrink > Self::NEAR {
            shrink *= 0.5;
        }
        shrink
    }
}
