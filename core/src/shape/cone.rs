//! A cone or frustum, by the quadratic equation of its radius along the axis (Heckbert in Glassner (ed.), "An
//! Introduction to Ray Tracing", 1989, ch. 2), solved without cancellation (Press et al., "Numerical Recipes",
//! §5.6).

use super::{Geometry, Intersect, Spine};
use crate::arena::Arena;
use crate::fault::{Fault, check_coordinate, check_held, check_point, check_size, unit};
use crate::math::{Aabb, Extent, Interval, Product, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// A cone, or the frustum of one, between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The middle of one end.
    pub base: Vec3,
    /// Radius there, 0 or more.
    pub base_radius: f32,
    /// The middle of the other end.
    pub top: Vec3,
    /// Radius there, 0 or more; one of the two is more than 0.
    pub top_radius: f32,
    /// Whether discs close the ends; without, it is a cone without thickness.
    pub capped: bool,
}

impl Geometry for Cone {
    type Prepared<'m, R: Real> = PreparedCone<R>;

    fn extent(&self) -> Extent {
        let radius = self.base_radius.larger(self.top_radius);
        Extent::solid(self.base.magnitude().larger(self.top.magnitude()) + radius)
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, _: &mut Arena<'m>) -> Result<PreparedCone<R>, Fault>
    where
        Self: 'm,
    {
        check_point(self.base)?;
        check_point(self.top)?;
        check_coordinate(self.base_radius)?;
        check_coordinate(self.top_radius)?;
        if self.base_radius < 0.0 || self.top_radius < 0.0 || self.base_radius + self.top_radius <= 0.0 {
            return Err(Fault::RadiusNotPositive);
        }
        let axis: Vec3<R::Setup> = unit(self.top - self.base)?;
        let base: Vec3<R::Setup> = self.base.to();
        let length = (self.top.to() - base).length();
        let (base_radius, top_radius) =
            (R::Setup::from_f32(self.base_radius), R::Setup::from_f32(self.top_radius));
        let slope = (top_radius - base_radius) / length;
        let steepness = R::Setup::ONE + slope * slope;
        check_held::<R>(steepness)?;
        let size = length + base_radius.larger(top_radius);
        check_size(scale.length::<R>(base_radius.larger(top_radius)))?;
        Ok(PreparedCone {
            base: scale.point(base),
            axis: Vec3::from_setup(axis),
            length: scale.length(length),
            base_radius: scale.length(base_radius),
            slope: R::from_setup(slope),
            steepness: R::from_setup(steepness),
            magnitude: scale.length(base.magnitude() + length + base_radius.larger(top_radius)),
            size: scale.length(size),
            capped: self.capped,
        })
    }
}

/// A [`Cone`] or [`Cylinder`](super::Cylinder), prepared: the radius at height h along the axis is
/// `base_radius + slope · h`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedCone<R> {
    base: Vec3<R>,
    axis: Vec3<R>,
    length: R,
    base_radius: R,
    slope: R,
    /// 1 + slope²
    steepness: R,
    magnitude: R,
    /// No point is farther from the base.
    size: R,
    capped: bool,
}

impl<R: Real> PreparedCone<R> {
    /// The nearest hit of the side. `start` lies on the ray at distance `advance` from its origin.
    fn intersect_side(
        &self,
        start: Vec3<R>,
        advance: R,
        direction: Vec3<R>,
        range: Interval<R>,
    ) -> Option<R> {
        let from_base = start - self.base;
        let height = from_base.dot(self.axis);
        let climb = direction.dot(self.axis);
        let radius = self.base_radius + self.slope * height;
        // Distance from the axis, squared, less the cone's radius there, squared: a t² + 2 b t + c.
        let a = R::ONE - self.steepness * climb * climb;
        let b = from_base.dot(direction) - height * climb - self.slope * climb * radius;
        let across = from_base - self.axis * height;
        let c = across.dot_wide(across) - radius.times(radius);
        let discriminant = b.times(b) - c.times(a);
        if !(discriminant > R::Product::ZERO) {
            return None;
        }
        let root = discriminant.sqrt();
        let q = if b > R::ZERO { -b - root } else { root - b };
        // q is zero only if b and the discriminant are. Along a line of the cone a is next to 0 and q / a is
        // far away; without floats it might not be representable.
        let one = c.over(q);
        let other = if a.abs() > R::RAY_OFFSET * R::RAY_OFFSET { q / a } else { one };
        let on_side = |t: R| {
            let at = height + climb * t;
            // Beyond its apex the quadratic describes a second cone: there the radius is negative.
            at >= R::ZERO && at <= self.length && self.base_radius + self.slope * at >= R::ZERO
        };
        let mut nearest = None;
        let mut range = range;
        for t in [one, other] {
            if on_side(t) && range.contains(t + advance) {
                range.max = t + advance;
                nearest = Some(t + advance);
            }
        }
        nearest
    }

    /// The nearest hit of the discs at the ends.
    fn intersect_caps(
        &self,
        start: Vec3<R>,
        advance: R,
        direction: Vec3<R>,
        range: Interval<R>,
    ) -> Option<R> {
        let climb = direction.dot(self.axis);
        if climb == R::ZERO {
            return None;
        }
        let from_base = start - self.base;
        let height = from_base.dot(self.axis);
        let mut nearest = None;
        let mut range = range;
        for end in [R::ZERO, self.length] {
            // Compare before dividing: a disc that is many units away for a ray along it is not met.
            let t = (end - height) / climb;
            if range.contains(t + advance) {
                let across = from_base + direction * t - self.axis * end;
                let radius = self.base_radius + self.slope * end;
                if across.dot_wide(across) < radius.times(radius) {
                    range.max = t + advance;
                    nearest = Some(t + advance);
                }
            }
        }
        nearest
    }
}

impl<R: Real> Intersect<R> for PreparedCone<R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        // Start from the point of the ray nearest to the base: the coefficients stay of the cone's own size,
        // however far away the ray begins.
        let advance = (self.base - ray.origin).dot(ray.direction);
        let start = ray.at(advance);
        if R::REACH.is_some() {
            // The coefficients of a ray that passes far away would be out of range.
            let from_base = start - self.base;
            if from_base.dot_wide(from_base) > self.size.times(self.size) {
                return None;
            }
        }
        let side = self.intersect_side(start, advance, ray.direction, range);
        if !self.capped {
            return side;
        }
        let range = Interval { max: side.unwrap_or(range.max), ..range };
        self.intersect_caps(start, advance, ray.direction, range).or(side)
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        // A disc across the axis reaches r √(1 - a²) along a coordinate axis.
        let across = |a: R| (R::ONE - a * a).larger(R::ZERO).sqrt();
        let reach = Vec3::new(across(self.axis.x), across(self.axis.y), across(self.axis.z));
        let disc = |height: R| {
            let radius = (self.base_radius + self.slope * height).larger(R::ZERO);
            Aabb::around(self.base + self.axis * height, reach * radius)
        };
        Some(disc(R::ZERO).union(disc(self.length)).padded(R::offset(self.magnitude)))
    }

    fn spine(&self) -> Option<Spine<R>> {
        let top_radius = self.base_radius + self.slope * self.length;
        Some(Spine {
            from: self.base,
            to: self.base + self.axis * self.length,
            radius: self.base_radius.larger(top_radius),
        })
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let point = ray.at(t);
        let height = (point - self.base).dot(self.axis);
        let across = point - self.base - self.axis * height;
        let radius = self.base_radius + self.slope * height;
        let distance = across.length();
        // Of the side and the two discs, the hit belongs to the one that it is nearest to.
        let from_side = (distance - radius).abs();
        let (from_base, from_top) = (height.abs(), (height - self.length).abs());
        let (point, normal) = if self.capped && from_base < from_side && from_base <= from_top {
            (self.base + across, -self.axis)
        } else if self.capped && from_top < from_side {
            (self.base + self.axis * self.length + across, self.axis)
        } else {
            let outward = across.normalized().unwrap_or(self.axis);
            let normal = (outward - self.axis * self.slope).normalized().unwrap_or(outward);
            (self.base + self.axis * height + outward * radius, normal)
        };
        Surface { point, normal, shading_normal: normal, magnitude: self.magnitude, part: 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;

    // Half a right angle: as wide at the base as it is high.
    const TENT: Cone = Cone {
        base: Vec3::new(0.0, 0.0, 0.0),
        base_radius: 2.0,
        top: Vec3::new(0.0, 2.0, 0.0),
        top_radius: 0.0,
        capped: true,
    };
    const LEFT: Vec3 = Vec3::new(-1.0, 0.0, 0.0);
    const DOWN: Vec3 = Vec3::new(0.0, -1.0, 0.0);
    const HALF: f64 = core::f64::consts::FRAC_1_SQRT_2;

    #[test]
    fn met_on_the_side() {
        assert_meets(TENT, Vec3::new(5.0, 1.0, 0.0), LEFT, 4.0, [HALF, HALF, 0.0]);
        // From inside the same way: the far wall.
        assert_meets(TENT, Vec3::new(0.5, 1.0, 0.0), LEFT, 1.5, [-HALF, HALF, 0.0]);
        assert_meets(TENT, Vec3::new(0.0, 5.0, 1.0), DOWN, 4.0, [0.0, HALF, HALF]);
    }

    #[test]
    fn lids_close_it_only_when_capped() {
        let up = -DOWN;
        assert_meets(TENT, Vec3::new(1.0, -3.0, 0.0), up, 3.0, [0.0, -1.0, 0.0]);
        let open = Cone { capped: false, ..TENT };
        // Through the open base onto the inside of the wall.
        assert_meets(open, Vec3::new(1.0, -3.0, 0.0), up, 4.0, [HALF, HALF, 0.0]);
        let frustum = Cone { top_radius: 1.0, ..TENT };
        assert_meets(frustum, Vec3::new(0.5, 5.0, 0.0), DOWN, 3.0, [0.0, 1.0, 0.0]);
        assert_misses(Cone { capped: false, ..frustum }, Vec3::new(0.5, 5.0, 0.0), DOWN);
    }

    #[test]
    fn its_mirror_image_beyond_the_apex_is_not_there() {
        assert_misses(TENT, Vec3::new(5.0, 2.5, 0.0), LEFT);
        assert_misses(TENT, Vec3::new(5.0, 3.0, 0.0), LEFT);
        assert_misses(TENT, Vec3::new(5.0, -0.5, 0.0), LEFT);
    }

    #[test]
    fn a_ray_along_a_line_of_the_cone_is_met_once() {
        // Parallel to the wall on the left, half a unit inside: leaves through the lid.
        let along = Vec3::new(-1.0, -1.0, 0.0);
        let inside = Vec3::new(-0.5, 1.0, 0.0);
        assert_meets(TENT, inside, along, f64::sqrt(2.0), [0.0, -1.0, 0.0]);
    }

    #[test]
    fn a_cylinder_is_a_cone_that_does_not_narrow() {
        let pipe = super::super::Cylinder {
            base: Vec3::new(1.0, 0.0, 0.0),
            top: Vec3::new(1.0, 0.0, 4.0),
            radius: 0.5,
            capped: false,
        };
        assert_meets(pipe, Vec3::new(5.0, 0.0, 2.0), LEFT, 3.5, [1.0, 0.0, 0.0]);
        assert_meets(pipe, Vec3::new(1.0, 0.0, 2.0), LEFT, 0.5, [-1.0, 0.0, 0.0]);
        // Over half the radius off the axis.
        let off = 0.5 * f64::sqrt(0.75);
        assert_meets(pipe, Vec3::new(5.0, 0.25, 2.0), LEFT, 4.0 - off, [2.0 * off, 0.5, 0.0]);
        assert_misses(pipe, Vec3::new(1.0, 0.1, 9.0), Vec3::new(0.0, 0.0, -1.0));
        assert_misses(pipe, Vec3::new(5.0, 0.5, 2.0), LEFT);
        assert_misses(pipe, Vec3::new(5.0, 0.0, 4.1), LEFT);
        let can = super::super::Cylinder { capped: true, ..pipe };
        assert_meets(can, Vec3::new(1.0, 0.1, 9.0), Vec3::new(0.0, 0.0, -1.0), 5.0, [0.0, 0.0, 1.0]);
        assert_meets(can, Vec3::new(1.0, 0.1, 3.0), Vec3::new(0.0, 0.0, -1.0), 3.0, [0.0, 0.0, -1.0]);
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            // Not down to a tip: there the opposite wall really is that near.
            for top_radius in [0.1, 0.4, 0.8] {
                for capped in [false, true] {
                    let cone = Cone {
                        base: Vec3::new(-0.7, 0.1, -0.2) * extent,
                        base_radius: 0.8 * extent,
                        top: Vec3::new(0.6, 0.3, 0.5) * extent,
                        top_radius: top_radius * extent,
                        capped,
                    };
                    assert_no_self_hits(cone, Vec3::ZERO, extent, 20_000);
                }
            }
        }
    }

    #[test]
    fn bad_cones_are_refused() {
        let refused = |cone: Cone| refusal(cone);
        assert_eq!(refused(Cone { base_radius: 0.0, ..TENT }), Fault::RadiusNotPositive);
        assert_eq!(refused(Cone { base_radius: 1.0, top_radius: -0.5, ..TENT }), Fault::RadiusNotPositive);
        assert_eq!(refused(Cone { top: TENT.base, ..TENT }), Fault::ZeroLength);
        assert_eq!(refused(Cone { top_radius: f32::NAN, ..TENT }), Fault::NotFinite);
    }
}
