//! A box along the axes.

use super::{Real, Vec3};

/// A box along the axes that holds a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb<R> {
    /// The corner with the smallest coordinates.
    pub min: Vec3<R>,
    /// The corner with the largest.
    pub max: Vec3<R>,
}

impl<R: Real> Aabb<R> {
    /// The box that holds this point alone.
    pub fn point(point: Vec3<R>) -> Self {
        Self { min: point, max: point }
    }

    /// The box around `center` that reaches `reach` along each axis.
    pub fn around(center: Vec3<R>, reach: Vec3<R>) -> Self {
        Self { min: center - reach, max: center + reach }
    }

    /// The smallest box that holds both boxes.
    // Not inlined: during preparation, size matters more than time.
    #[inline(never)]
    pub fn union(self, other: Self) -> Self {
        self.joined(other)
    }

    /// [`union`](Self::union), inlined: for loops over many boxes.
    #[inline]
    pub(crate) fn joined(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self {
            min: Vec3::new(b.min.x.smaller(a.min.x), b.min.y.smaller(a.min.y), b.min.z.smaller(a.min.z)),
            max: Vec3::new(a.max.x.larger(b.max.x), a.max.y.larger(b.max.y), a.max.z.larger(b.max.z)),
        }
    }

    /// The box, larger by `margin` on every side.
    #[inline(never)]
    pub fn padded(self, margin: R) -> Self {
        let margin = Vec3::new(margin, margin, margin);
        Self { min: self.min - margin, max: self.max + margin }
    }

    /// The largest absolute value among all coordinates.
    #[inline(never)]
    pub fn magnitude(self) -> R {
        self.min.magnitude().larger(self.max.magnitude())
    }

    /// The middle.
    pub fn center(self) -> Vec3<R> {
        (self.min + self.max) * R::from_f32(0.5)
    }

    /// The box in the number system of the preparation.
    pub fn to_setup(self) -> Aabb<R::Setup> {
        Aabb { min: self.min.to_setup(), max: self.max.to_setup() }
    }

    /// The eight corners.
    pub fn corners(self) -> impl Iterator<Item = Vec3<R>> {
        let Self { min, max } = self;
        let pick = move |upper: bool, min: R, max: R| if upper { max } else { min };
        (0..8u8).map(move |i| {
            Vec3::new(
                pick(i & 1 != 0, min.x, max.x),
                pick(i & 2 != 0, min.y, max.y),
                pick(i & 4 != 0, min.z, max.z),
            )
        })
    }

    /// The distance of a point from the box: 0 inside.
    pub fn distance(self, point: Vec3<R>) -> R {
        let beyond = |least: R, at: R, most: R| (least - at).larger(at - most).larger(R::ZERO);
        let Self { min, max } = self;
        let Vec3 { x, y, z } = point;
        Vec3::new(beyond(min.x, x, max.x), beyond(min.y, y, max.y), beyond(min.z, z, max.z)).length()
    }

    /// Whether the box holds a point.
    pub fn contains(self, point: Vec3<R>) -> bool {
        point.x >= self.min.x
            && point.y >= self.min.y
            && point.z >= self.min.z
            && point.x <= self.max.x
            && point.y <= self.max.y
            && point.z <= self.max.z
    }
}
