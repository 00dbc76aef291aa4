//! A cone or frustum: a ray meets its side at the roots of a quadratic equation (Haines in Glassner (ed.),
//! "An Introduction to Ray Tracing", 1989, ch. 2), which is solved without cancellation (Press et al.,
//! "Numerical Recipes", §5.6).
//!
//! # No hit outside
//! A cone may be a hundred thousand times as long as it is wide, and a ray may run almost along it. The
//! equation as textbooks give it loses all digits there. Three steps keep the error of a hit to a few units
//! in the last place of the cone's coordinates, far less than the room that its bounds have:
//!
//! - Places are measured from one point of the ray ([`Approach`]): of the part between the planes of the two
//!   ends, the point that is nearest to the axis. No hit is nearer to the axis, so the terms of the equation
//!   are no larger than the cone's radius at the hit.
//! - The angle between ray and axis enters by its sine: the length of the part of the direction that is at
//!   right angles to the axis. In textbooks, 1 less the squared cosine takes its place, and cancels for a ray
//!   almost along the axis.
//! - The discriminant is (α r - β e)² - D² (α² - β²), with the letters of [`Passage`]. It does not cancel
//!   where the textbook's b² - a c does.
//!
//! # Rays that pass by
//! Most rays that are tested pass the axis farther away than the cone reaches. In floating point this is
//! tested first, by the distance between two lines: for half the products of an intersection. In fixed point
//! coefficients must not overflow, so the first test is whether the ray comes near the base at all.

use super::tessellate::{Directions, Grid, Ring};
use super::{
    Facet, Geometry, Hull, Intersect, Silhouette, Spans, Tessellation, Tip, normal_after_step, reach_across,
    uv,
};
use crate::arena::Arena;
use crate::fault::{Fault, check_coordinate, check_held, check_point, check_size, unit};
use crate::math::{Aabb, Extent, FourRays, Interval, Product, Ray, Real, Scale, Vec3, choose, each};
use crate::surface::Surface;

/// A cone, or the frustum of one, between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Cone {
    /// The middle of one end.
    pub base: Vec3,
    /// Radius at the base, 0 or more.
    pub base_radius: f32,
    /// The middle of the other end.
    pub top: Vec3,
    /// Radius at the top, 0 or more. At least one of the two radii must be more than 0.
    pub top_radius: f32,
    /// Whether discs close the ends. If not, the cone is a surface without thickness.
    pub capped: bool,
}

impl Geometry for Cone {
    type Prepared<'m, R: Real> = PreparedCone<R>;

    fn is_solid(&self) -> bool {
        self.capped
    }

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
        let widest = base_radius.larger(top_radius);
        let size = length + widest;
        check_size(scale.length::<R>(widest))?;
        let magnitude: R = scale.length(base.magnitude() + size);
        let reach: R = scale.length(widest * R::Setup::from_f32(1.03));
        Ok(PreparedCone {
            base: scale.point(base),
            axis: Vec3::from_setup(axis),
            length: scale.length(length),
            base_radius: scale.length(base_radius),
            slope: R::from_setup(slope),
            magnitude,
            size: scale.length(size),
            reach: reach + R::offset(magnitude),
            reach_squared: reach * reach,
            capped: self.capped,
        })
    }
}

/// An end is a tip if its radius, times this, is less than the radius of the other end.
const BLUNT: u16 = 8;

/// A [`Cone`] or [`Cylinder`](super::Cylinder), prepared: the radius at height h along the axis is
/// `base_radius + slope · h`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedCone<R> {
    base: Vec3<R>,
    axis: Vec3<R>,
    length: R,
    base_radius: R,
    slope: R,
    magnitude: R,
    /// No point of the cone is farther from the base.
    size: R,
    /// A distance from the axis that no hit exceeds, with room for rounding.
    reach: R,
    /// The square of that distance, without the room for the rounding of coordinates.
    reach_squared: R,
    capped: bool,
}

/// The point of a ray that is nearest to the axis between the planes of the cone's ends.
struct Approach<R> {
    /// The point, relative to the base.
    from_base: Vec3<R>,
    /// The distance of the point from the ray's origin.
    advance: R,
    /// The change of height along the axis for each unit along the ray: the cosine between the two.
    climb: R,
    /// The unit vector along the part of the direction that is at right angles to the axis, and the length of
    /// that part: the sine. Both are 0 for a ray along the axis.
    across: Vec3<R>,
    sine: R,
}

/// [`Approach`] of four rays.
struct FourApproaches<R> {
    /// A bit for each ray that comes near enough.
    near_enough: u32,
    from_base: [Vec3<R>; 4],
    advance: [R; 4],
    climb: [R; 4],
    across: [Vec3<R>; 4],
    sine: [R; 4],
}

/// A line through a cone of infinite length and through the mirror image beyond its apex, from the line's
/// [`Approach`] on.
///
/// Let D be the distance between line and axis, and τ the distance from the approach, times `unit`. Seen
/// along the axis, the line passes the axis at the distance D, and is e + α τ beyond the place where it is
/// nearest. The cone's radius at the same height is r + β τ. So the line meets the cone where
/// D² + (e + α τ)² = (r + β τ)², or a τ² + 2 b τ + c = 0.
struct Passage<R: Real> {
    /// The point of the approach, relative to the base.
    from_base: Vec3<R>,
    /// The distance of that point from the ray's origin.
    advance: R,
    direction: Vec3<R>,
    /// The height of that point along the axis.
    height: R,
    /// The change of height for each unit along the line.
    climb: R,
    /// The larger of two changes for each unit along the line: that of the place as it is seen along the
    /// axis, and that of the radius. Divided by it, they are α and β, of which the larger is 1.
    unit: R,
    /// α² - β²
    a: R,
    /// α e - β r
    b: R,
    /// The squared distance from the axis less the squared radius: D² + e² - r².
    c: R::Product,
    discriminant: R::Product,
}

impl<R: Real> Passage<R> {
    /// The two places at which the line meets the cone, if the discriminant is positive. If the line is
    /// parallel to a line of the cone, it meets the cone once, and both results are that place.
    #[inline]
    fn roots(&self) -> (R, R) {
        let root = self.discriminant.sqrt();
        let q = if self.b > R::ZERO { -self.b - root } else { root - self.b };
        // q is 0 only if both b and the discriminant are. If the line is parallel to a line of the cone, a is
        // almost 0 and q / a is far away, or out of range in fixed point.
        let one = self.c.over(q);
        let other = if is_met_twice(self.a) { q / self.a } else { one };
        (one / self.unit, other / self.unit)
    }

    /// The part of the line, between `-reach` and `reach`, that lies inside the cone, whose radius grows by
    /// `slope` for each unit of height. The part inside the cone's mirror image is left out.
    fn inside(&self, slope: R, reach: R) -> (R, R) {
        if !(self.discriminant > R::Product::ZERO) {
            return if self.c < R::Product::ZERO { (-reach, reach) } else { (reach, -reach) };
        }
        let (one, other) = self.roots();
        let (near, far) = if one < other { (one, other) } else { (other, one) };
        let rises = if is_met_twice(self.a) {
            if self.a > R::ZERO {
                return (near, far);
            }
            self.climb * slope > R::ZERO
        } else {
            self.b < R::ZERO
        };
        if rises { (far, reach) } else { (-reach, near) }
    }
}

/// Whether a line meets the cone twice, by the first coefficient of the quadratic equation: it does unless it
/// is parallel to a line of the cone.
#[inline]
fn is_met_twice<R: Real>(a: R) -> bool {
    a.abs() > R::RAY_OFFSET * R::RAY_OFFSET
}

/// α and β: `sine` and `other`, both divided by `larger`, which is the larger of their absolute values; 0 if
/// that is 0.
#[inline]
fn shares<R: Real>(sine: R, other: R, larger: R) -> (R, R) {
    if sine < larger {
        (sine / larger, if other < R::ZERO { -R::ONE } else { R::ONE })
    } else if larger > R::ZERO {
        (R::ONE, other / larger)
    } else {
        (R::ZERO, R::ZERO)
    }
}

impl<R: Real> PreparedCone<R> {
    /// The squared distance at which a ray's line passes the axis, and the largest squared distance at which
    /// it may meet the cone. Both are multiplied by the squared sine of the angle between line and axis.
    ///
    /// Before the first is squared, its error is at most 2⁻²¹ of the distance from the base. This is less
    /// than the room for rounding in the reach, or less than the root of `doubt`.
    #[inline]
    fn passing(&self, ray: &Ray<R>) -> (R, R) {
        let to_base = self.base - ray.origin;
        let across = ray.direction.cross(self.axis);
        let distance = to_base.dot(across);
        let doubt = to_base.length_squared() * R::from_f32(1.0 / (1u64 << 33) as f32);
        (distance * distance, self.reach_squared * across.length_squared() + doubt)
    }

    /// The point of the ray where a passage begins. `None` where the ray passes by.
    #[inline]
    fn approach(&self, ray: &Ray<R>) -> Option<Approach<R>> {
        if !R::IS_FIXED_POINT {
            let (distance, reach) = self.passing(ray);
            if distance > reach {
                return None;
            }
        }
        let (from_base, advance) = ray.nearest_to(self.base);
        // Farther away, coefficients would be out of range.
        if R::IS_FIXED_POINT && from_base.length_squared_wide() > self.size.times(self.size) {
            return None;
        }
        let direction = ray.direction;
        let climb = direction.dot(self.axis);
        let (across, sine) = (direction - self.axis * climb).unit_and_length();
        let is_along = !(sine > R::ZERO);
        let across = if is_along { Vec3::ZERO } else { across };

        let height = from_base.dot(self.axis);
        let from_axis = from_base - self.axis * height;
        let aside = from_axis.dot(across);
        if R::IS_FIXED_POINT {
            let passing = from_axis.length_squared_wide() - aside.times(aside);
            if passing > self.reach.times(self.reach) + R::ONE.times(R::RAY_OFFSET) {
                return None;
            }
        }
        let toward = if is_along { R::ZERO } else { -aside / sine };
        let (rise, to_base, to_top) = (climb * toward, -height, self.length - height);
        let shift = if rise < to_base {
            to_base / climb
        } else if rise > to_top {
            to_top / climb
        } else {
            toward
        };
        // If the shift is longer, the ray is far from the cone where it is between the planes of the ends.
        let is_near = shift.abs() <= self.farthest();
        is_near.then(|| Approach {
            from_base: from_base + direction * shift,
            advance: advance + shift,
            climb,
            across,
            sine,
        })
    }

    /// `None` where the ray passes by.
    #[inline]
    fn passage(&self, ray: &Ray<R>) -> Option<Passage<R>> {
        let Approach { from_base, advance, climb, across, sine } = self.approach(ray)?;
        let height = from_base.dot(self.axis);
        let from_axis = from_base - self.axis * height;
        let distance_squared = from_axis.length_squared_wide();
        if distance_squared > self.reach.times(self.reach) {
            return None;
        }
        let aside = from_axis.dot(across);
        let radius = self.base_radius + self.slope * height;
        let widens = self.slope * climb;
        let unit = sine.larger(widens.abs());
        let (alpha, beta) = shares(sine, widens, unit);
        let a = alpha * alpha - beta * beta;
        let b = alpha * aside - beta * radius;
        let c = distance_squared - radius.times(radius);
        let even = alpha * radius - beta * aside;
        let passing = distance_squared - aside.times(aside);
        let discriminant = even.times(even) - passing.times(a);
        let direction = ray.direction;
        Some(Passage { from_base, advance, direction, height, climb, unit, a, b, c, discriminant })
    }

    /// As [`approach`](Self::approach), in floating point; `None` where all four pass by.
    #[inline]
    #[allow(clippy::indexing_slicing)] // By places of four.
    fn approach_four(&self, rays: &FourRays<R>) -> Option<FourApproaches<R>> {
        let passing = each(|i| self.passing(&rays.ray(i)));
        let near_enough = R::no_larger(&each(|i| passing[i].0), &each(|i| passing[i].1));
        if near_enough == 0 {
            return None;
        }
        let directions = each(|i| rays.ray(i).direction);
        let near = each(|i| rays.ray(i).nearest_to(self.base));
        let (from_base, advance) = (each(|i| near[i].0), each(|i| near[i].1));
        let climb = each(|i| directions[i].dot(self.axis));
        let across = each(|i| (directions[i] - self.axis * climb[i]).unit_and_length());
        let sine = each(|i| across[i].1);
        let across = each(|i| if sine[i] > R::ZERO { across[i].0 } else { Vec3::ZERO });
        let height = each(|i| from_base[i].dot(self.axis));
        let from_axis = each(|i| from_base[i] - self.axis * height[i]);
        let aside = each(|i| from_axis[i].dot(across[i]));
        let toward = each(|i| if sine[i] > R::ZERO { -aside[i] / sine[i] } else { R::ZERO });
        let shift = each(|i| {
            let (rise, to_base, to_top) = (climb[i] * toward[i], -height[i], self.length - height[i]);
            let (base, top) = (to_base / climb[i], to_top / climb[i]);
            if rise < to_base {
                base
            } else if rise > to_top {
                top
            } else {
                toward[i]
            }
        });
        let near_enough = near_enough & R::no_larger(&each(|i| shift[i].abs()), &[self.farthest(); 4]);
        let from_base = each(|i| from_base[i] + directions[i] * shift[i]);
        let advance = each(|i| advance[i] + shift[i]);
        Some(FourApproaches { near_enough, from_base, advance, climb, across, sine })
    }

    /// No hit is farther than this from the point where a passage begins.
    #[inline]
    fn farthest(&self) -> R {
        self.size + self.size
    }

    /// The nearest hit of the side inside `range`.
    fn intersect_side(&self, passage: &Passage<R>, range: Interval<R>) -> Option<R> {
        if !(passage.discriminant > R::Product::ZERO) {
            return None;
        }
        let (one, other) = passage.roots();
        let on_side = |t: R| {
            let at = passage.height + passage.climb * t;
            // Beyond the apex the equation describes the cone's mirror image, and the radius is negative. In
            // fixed point a place too far away may be saturated.
            t.abs() <= self.farthest()
                && at >= R::ZERO
                && at <= self.length
                && self.base_radius + self.slope * at >= R::ZERO
        };
        let mut nearest = None;
        let mut range = range;
        for t in [one, other] {
            let hit = t + passage.advance;
            if on_side(t) && range.contains(hit) {
                range.max = hit;
                nearest = Some(hit);
            }
        }
        nearest
    }

    /// The nearest hit of the discs at the ends inside `range`.
    fn intersect_caps(&self, passage: &Passage<R>, range: Interval<R>) -> Option<R> {
        let Passage { from_base, advance, direction, height, climb, .. } = *passage;
        if climb == R::ZERO {
            return None;
        }
        let mut nearest = None;
        let mut range = range;
        for end in [R::ZERO, self.length] {
            // In fixed point, `t` is saturated for a ray almost parallel to a disc.
            let t = (end - height) / climb;
            let hit = t + advance;
            if t.abs() <= self.farthest() && range.contains(hit) {
                let across = from_base + direction * t - self.axis * end;
                let radius = self.base_radius + self.slope * end;
                if across.length_squared_wide() < radius.times(radius) {
                    range.max = hit;
                    nearest = Some(hit);
                }
            }
        }
        nearest
    }

    fn top_radius(&self) -> R {
        self.base_radius + self.slope * self.length
    }

    /// Whether a surface is on one of the discs at the ends: only their normals are exactly parallel to the
    /// axis.
    fn is_on_cap(&self, surface: &Surface<R>) -> bool {
        self.capped && (surface.normal == self.axis || surface.normal == -self.axis)
    }
}

impl<R: Real> Intersect<R> for PreparedCone<R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let passage = self.passage(ray)?;
        let side = self.intersect_side(&passage, range);
        if !self.capped {
            return side;
        }
        let range = Interval { max: side.unwrap_or(range.max), ..range };
        self.intersect_caps(&passage, range).or(side)
    }

    #[allow(clippy::indexing_slicing)] // All indices are below 4.
    fn intersect_four(&self, rays: &FourRays<R>, max: &[R; 4]) -> (u32, [R; 4]) {
        if self.capped {
            return rays.one_by_one(max, |ray, range| self.intersect(ray, range));
        }
        let Some(approaches) = self.approach_four(rays) else { return (0, *max) };
        let FourApproaches { near_enough, from_base, advance, climb, across, sine } = approaches;
        // The steps of `passage`. The root of a discriminant that is not positive is 0 or NaN.
        let height = each(|i| from_base[i].dot(self.axis));
        let from_axis = each(|i| from_base[i] - self.axis * height[i]);
        let distances_squared = each(|i| from_axis[i].length_squared());
        let near_enough = near_enough & R::no_larger(&distances_squared, &[self.reach * self.reach; 4]);
        if near_enough == 0 {
            return (0, *max);
        }
        let aside = each(|i| from_axis[i].dot(across[i]));
        let radius = each(|i| self.base_radius + self.slope * height[i]);
        let widens = each(|i| self.slope * climb[i]);
        let unit = each(|i| sine[i].larger(widens[i].abs()));
        let parts = each(|i| shares(sine[i], widens[i], unit[i]));
        let (alpha, beta) = (each(|i| parts[i].0), each(|i| parts[i].1));
        let a = each(|i| alpha[i] * alpha[i] - beta[i] * beta[i]);
        let b = each(|i| alpha[i] * aside[i] - beta[i] * radius[i]);
        let c = each(|i| from_axis[i].length_squared_wide() - radius[i].times(radius[i]));
        let even = each(|i| alpha[i] * radius[i] - beta[i] * aside[i]);
        let passing = each(|i| from_axis[i].length_squared_wide() - aside[i].times(aside[i]));
        let root = each(|i| (even[i].times(even[i]) - passing[i].times(a[i])).sqrt());
        let zeros = [R::ZERO; 4];
        let crossed = near_enough & R::less(&zeros, &root);
        if crossed == 0 {
            return (0, *max);
        }
        // The steps of `roots`.
        let q = each(|i| if b[i] > R::ZERO { -b[i] - root[i] } else { root[i] - b[i] });
        let one = each(|i| c[i].over(q[i]));
        let other = each(|i| if is_met_twice(a[i]) { q[i] / a[i] } else { one[i] });
        let (one, other) = (each(|i| one[i] / unit[i]), each(|i| other[i] / unit[i]));
        // The steps of `intersect_side`.
        let met = |t: [R; 4]| {
            let at = each(|i| height[i] + climb[i] * t[i]);
            let radius = each(|i| self.base_radius + self.slope * at[i]);
            let hit = each(|i| t[i] + advance[i]);
            let on_side = R::no_larger(&each(|i| t[i].abs()), &[self.farthest(); 4])
                & R::no_larger(&zeros, &at)
                & R::no_larger(&at, &[self.length; 4])
                & R::no_larger(&zeros, &radius);
            (crossed & on_side & R::less(&zeros, &hit) & R::less(&hit, max), hit)
        };
        let ((meets_one, one), (meets_other, other)) = (met(one), met(other));
        let is_other = meets_other & (R::less(&other, &one) | !meets_one);
        (meets_one | meets_other, choose(is_other, other, one))
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        let reach = reach_across(self.axis);
        let disc = |height: R| {
            let radius = (self.base_radius + self.slope * height).larger(R::ZERO);
            Aabb::around(self.base + self.axis * height, reach * radius)
        };
        Some(disc(R::ZERO).union(disc(self.length)).padded(R::offset(self.magnitude)))
    }

    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        let (true, Some(passage)) = (self.capped, self.passage(ray)) else {
            return Spans::NONE;
        };
        // Between the planes of the ends the radius is positive, so the mirror image has no part there.
        let (mut from, mut to) = passage.inside(self.slope, self.farthest());
        let (to_base, to_top) = (-passage.height, self.length - passage.height);
        if passage.climb == R::ZERO {
            if !(to_base < R::ZERO && to_top > R::ZERO) {
                return Spans::NONE;
            }
        } else {
            let (base, top) = (to_base / passage.climb, to_top / passage.climb);
            let (enters, leaves) = if base < top { (base, top) } else { (top, base) };
            from = from.larger(enters);
            to = if leaves < to { leaves } else { to };
        }
        // If nothing is left, an end may be saturated, and its sum with `advance` would wrap.
        if !(from < to) {
            return Spans::NONE;
        }
        Spans::one(from + passage.advance, to + passage.advance)
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let point = ray.at(t);
        let height = (point - self.base).dot(self.axis);
        let across = point - self.base - self.axis * height;
        let radius = self.base_radius + self.slope * height;
        let distance = across.length();
        // The hit belongs to the side or to a disc, whichever is nearest.
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

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        let from_base = surface.point - self.base;
        let height = from_base.dot(self.axis);
        if self.is_on_cap(surface) {
            let top = surface.normal == self.axis;
            let radius = self.base_radius + if top { self.slope * self.length } else { R::ZERO };
            return uv::disc(surface.normal, from_base - self.axis * height, radius);
        }
        [uv::angle_about(self.axis, from_base), height / self.length]
    }
}

impl<R: Real> Silhouette<R> for PreparedCone<R> {
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        if part > 0 {
            return None;
        }
        let top_radius = self.top_radius();
        let (half, radius) =
            (self.axis * (self.length * R::from_f32(0.5)), self.base_radius.larger(top_radius));
        let center = self.base + half;
        Some(if self.length < radius {
            // A flat disc, which is thin if it is seen edge-on.
            let (u, v) = self.axis.around();
            Hull { center, axes: [half, u * radius, v * radius], radius: R::ZERO }
        } else {
            Hull { center, axes: [half, Vec3::ZERO, Vec3::ZERO], radius }
        })
    }

    fn tip(&self, number: usize) -> Option<Tip<R>> {
        let top_radius = self.top_radius();
        let top = self.base + self.axis * self.length;
        let (apex, base, narrow, wide) = if top_radius < self.base_radius {
            (top, self.base, top_radius, self.base_radius)
        } else {
            (self.base, top, self.base_radius, top_radius)
        };
        let is_tip = number == 0 && narrow * R::from_u16(BLUNT) < wide;
        is_tip.then_some(Tip { apex, ends: [base; 2], radius: wide })
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        if self.is_on_cap(surface) {
            surface.normal
        } else {
            normal_after_step(&Self { capped: false, ..*self }, surface, step)
        }
    }

    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let (columns, is_closed) = (tessellation.sides(), self.capped);
        let directions = Directions::<R>::new(columns);
        let (first, second) = self.axis.around();
        // An apex has no radius, not even by rounding.
        let pointed = |radius: R| if radius > R::offset(self.magnitude) { radius } else { R::ZERO };
        let (base, base_radius) = (self.base, pointed(self.base_radius));
        let (top, top_radius) = (self.base + self.axis * self.length, pointed(self.top_radius()));
        let side = |column: u16, row: u16| {
            let (along, across) = directions.at(column);
            let outward = first * along + second * across;
            let normal = (outward - self.axis * self.slope).normalized().unwrap_or(outward);
            let (center, radius) = if row == 0 { (base, base_radius) } else { (top, top_radius) };
            (center + outward * radius, normal)
        };
        if is_closed {
            let (axes, radii) = ([first, second, -self.axis], [base_radius, R::ZERO]);
            Ring { center: base, axes, radii, is_closed }.each_facet(&directions, true, visit);
        }
        Grid { columns, rows: 1, is_closed }.each_facet(side, visit);
        if is_closed {
            let (axes, radii) = ([first, second, self.axis], [top_radius, R::ZERO]);
            Ring { center: top, axes, radii, is_closed }.each_facet(&directions, false, visit);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;

    // A slope of 45 degrees: the base radius is the height.
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
    fn an_end_that_tapers_off_is_a_tip() {
        let spire = Cone { base_radius: 0.5, ..TENT };
        let tip = |cone: Cone| prepared::<_, f64>(cone, &mut Memory::new()).unwrap().tip(0);
        let [low, high] = [TENT.base, TENT.top].map(Vec3::to);
        assert_eq!(tip(spire), Some(Tip { apex: high, ends: [low; 2], radius: 0.5 }));
        let icicle = Cone { base_radius: 0.05, top_radius: 0.5, ..spire };
        assert_eq!(tip(icicle), Some(Tip { apex: low, ends: [high; 2], radius: 0.5 }));
        assert!(tip(spire).unwrap().is_sharp() && !tip(TENT).unwrap().is_sharp());
        // A frustum and a pole.
        for cone in [Cone { top_radius: 0.2, ..spire }, Cone { top_radius: 0.5, ..spire }] {
            assert_eq!(tip(cone), None);
        }
    }

    #[test]
    fn four_rays_meet_it_as_single_ones_do() {
        for (top_radius, capped) in [(0.0, true), (0.0, false), (2.0, false), (1.0, false), (3.0, false)] {
            let cone = Cone { top_radius, capped, ..TENT };
            assert_four_are_met_as_one(cone, Vec3::new(0.0, 1.0, 0.0), 2.0);
        }
    }

    #[test]
    fn no_ray_that_comes_near_enough_is_said_to_pass_by() {
        let mut random = Random(7);
        let (mut near, mut passed) = (0, 0);
        for round in 0..100_000usize {
            // Thick cones and very thin ones; rays from nearby and from far away, and almost along the axis.
            let radius = [2.0, 0.5, 1e-2, 1e-4][round % 4];
            let away = [3.0, 30.0, 1e3, 1e6][round / 4 % 4];
            let shape = Cone { base_radius: radius, top_radius: random.next().abs() * radius, ..TENT };
            let mut memory = Memory::new();
            let cone: PreparedCone<f32> = prepared(shape, &mut memory).expect("a legal cone");
            let from_axis = random.direction().cross(cone.axis).normalized().unwrap_or(LEFT);
            let height = cone.axis * (random.next() * 3.0);
            let aim = cone.base + height + from_axis * (radius * (1.2 + random.next() * 0.4));
            let almost_along = random.direction() * 1e-3 + cone.axis;
            let direction = if round / 16 % 2 == 0 { almost_along } else { random.direction() };
            let direction = direction.normalized().unwrap_or(LEFT);
            let ray = Ray { origin: aim - direction * away, direction };
            let (passing, reach) = cone.passing(&ray);
            let is_passed = passing > reach;
            // The distance from line to line in f64.
            let (axis, direction): (Vec3<f64>, Vec3<f64>) = (cone.axis.to(), ray.direction.to());
            let across = direction.cross(axis);
            let distance = (cone.base.to::<f64>() - ray.origin.to()).dot(across).abs() / across.length();
            let is_near = distance <= f64::from(radius);
            assert!(!(is_near && is_passed), "{cone:?}: {ray:?} comes as near as {distance}");
            near += u32::from(is_near);
            passed += u32::from(is_passed);
        }
        assert!(near > 20_000 && passed > 5_000, "{near} near, {passed} passed");
    }

    #[test]
    fn met_on_the_side() {
        assert_meets(TENT, Vec3::new(5.0, 1.0, 0.0), LEFT, 4.0, [HALF, HALF, 0.0]);
        // From inside, in the same direction: the far wall.
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
        // Parallel to the wall on the left, half a unit inside of it: the ray leaves through the disc at the
        // base.
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
        // Half the radius above the axis.
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
    fn bounds_hold_the_ends_of_one_that_lies_almost_along_an_axis() {
        let plate = Cone { base_radius: 1.0, top: Vec3::new(1.0, 2e-4, 0.0), top_radius: 1.0, ..TENT };
        let mut memory = Memory::new();
        let plate = prepared::<_, f32>(plate, &mut memory).unwrap();
        let ray = Ray { origin: Vec3::new(-3.0, 0.99, 0.0), direction: -LEFT };
        let t = plate.intersect(&ray, Interval::AHEAD).unwrap();
        assert!((t - (3.0 - 0.99 * 2e-4)).abs() < 1e-6);
        assert!(plate.bounds().unwrap().contains(ray.at(t)));
    }

    #[test]
    fn its_inside_is_one_part_of_a_line() {
        let up = -DOWN;
        // Side to side, base to side, from inside, and through the mirror image above.
        assert_spans(TENT, Vec3::new(5.0, 1.0, 0.0), LEFT, &[(4.0, 6.0)]);
        assert_spans(TENT, Vec3::new(1.0, -3.0, 0.0), up, &[(3.0, 4.0)]);
        assert_spans(TENT, Vec3::new(1.0, 0.5, 0.0), up, &[(-0.5, 0.5)]);
        assert_spans(TENT, Vec3::new(5.0, 3.0, 0.0), LEFT, &[]);
        // Through the apex, and in the plane of the base.
        assert_spans(TENT, Vec3::new(0.0, 5.0, 0.0), DOWN, &[(3.0, 5.0)]);
        assert_spans(TENT, Vec3::new(5.0, -0.1, 0.0), LEFT, &[]);
        // Along a line of the cone, half a unit inside and half a unit outside.
        let along = Vec3::new(-1.0, -1.0, 0.0);
        let unit = f64::sqrt(2.0);
        assert_spans(TENT, Vec3::new(-0.5, 1.0, 0.0), along, &[(-0.75 * unit, unit)]);
        assert_spans(TENT, Vec3::new(-1.5, 1.0, 0.0), along, &[]);
        assert_spans(Cone { capped: false, ..TENT }, Vec3::new(5.0, 1.0, 0.0), LEFT, &[]);
        let can = super::super::Cylinder { base: Vec3::ZERO, top: up * 2.0, radius: 1.0, capped: true };
        assert_spans(can, Vec3::new(0.5, 5.0, 0.5), DOWN, &[(3.0, 5.0)]);
        assert_spans(can, Vec3::new(1.5, 5.0, 0.5), DOWN, &[]);
        assert_spans(can, Vec3::new(5.0, 1.0, 0.0), LEFT, &[(4.0, 6.0)]);
        assert_spans(can, Vec3::new(1.5, -0.5, 0.0), Vec3::new(-1.0, 1.0, 0.0), &[(0.5 * unit, 2.5 * unit)]);
    }

    #[test]
    fn rays_almost_along_its_lids_pass_by() {
        let can = super::super::Cylinder { base: Vec3::ZERO, top: -DOWN * 2.0, radius: 1.0, capped: true };
        for z in [5.0, -5.0] {
            for (height, climb) in [(2.2, 1e-4), (2.2, -1e-4), (-0.2, 1e-4), (-0.2, -1e-4)] {
                let (origin, toward) = (Vec3::new(0.0, height, z), Vec3::new(0.0, climb, -1.0));
                assert_spans(can, origin, toward, &[]);
                assert_misses(can, origin, toward);
            }
        }
    }

    #[test]
    fn where_it_is_entered_it_is_met() {
        for extent in EXTENTS {
            for top_radius in [0.0, 0.4, 0.8, 3.0] {
                let cone = Cone {
                    base: Vec3::new(-0.7, 0.1, -0.2) * extent,
                    base_radius: 0.8 * extent,
                    top: Vec3::new(0.6, 0.3, 0.5) * extent,
                    top_radius: top_radius * extent,
                    capped: true,
                };
                assert_spans_are_met(cone, Vec3::ZERO, extent, 2_000);
            }
        }
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            // Without a tip: there the opposite wall really is that near.
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
    fn coordinates_are_angle_and_height_and_on_lids_a_square() {
        assert_uv(TENT, Vec3::new(0.0, 1.0, -5.0), Vec3::new(0.0, 0.0, 1.0), [0.25, 0.5]);
        assert_uv(TENT, Vec3::new(-5.0, 1.5, 0.0), -LEFT, [0.5, 0.75]);
        // The base is seen from below: its normal points down, u is along x, and v along z.
        assert_uv(TENT, Vec3::new(1.0, -3.0, 0.5), -DOWN, [0.75, 0.625]);
        let frustum = Cone { top_radius: 1.0, ..TENT };
        assert_uv(frustum, Vec3::new(0.5, 5.0, 0.25), DOWN, [0.75, 0.375]);
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
