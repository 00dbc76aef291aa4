//! A quadric in a box: all points where a polynomial of second degree is 0 (Haines in Glassner (ed.), "An
//! Introduction to Ray Tracing", 1989, ch. 2). Its roots are found without cancellation (Press et al.,
//! "Numerical Recipes", §5.6).

mod polynomial;

use polynomial::{Polynomial, Roots, power_of_two_above};

use super::marching::{Lattice, each_facet_of_any};
use super::{Facet, Geometry, Intersect, Silhouette, Spans, Tessellation, normal_after_step, uv};
use crate::arena::Arena;
use crate::fault::{Fault, check_point, check_size};
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// The part of a quadric in a box: of an ellipsoid, a hyperboloid, a paraboloid, a cone or a cylinder, in any
/// direction.
///
/// It is all points with A x² + B y² + C z² + D xy + E xz + F yz + G x + H y + I z + J = 0; inside, this
/// polynomial is negative. Multiplying the coefficients by a positive factor changes nothing; a negative
/// factor exchanges inside and outside.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Quadric {
    /// The point where x, y and z of the equation are 0.
    pub center: Vec3,
    /// The coefficients A to J.
    pub coefficients: [f32; 10],
    /// The corner of the box with the smallest coordinates, relative to the center.
    pub min: Vec3,
    /// The corner with the largest coordinates, relative to the center. The box must have a volume.
    pub max: Vec3,
    /// Whether the faces of the box close the quadric. If not, it is a surface without thickness.
    pub capped: bool,
}

impl Quadric {
    /// [`Geometry::bytes`], usable in constants.
    pub const fn const_bytes<R: Real>(&self) -> usize {
        Arena::bytes::<BoxedQuadric<R>>(1)
    }
}

impl Geometry for Quadric {
    type Prepared<'m, R: Real> = PreparedQuadric<'m, R>;

    fn bytes<R: Real>(&self) -> usize {
        self.const_bytes::<R>()
    }

    fn is_solid(&self) -> bool {
        self.capped
    }

    fn extent(&self) -> Extent {
        Extent::solid((self.center + self.min).magnitude().larger((self.center + self.max).magnitude()))
    }

    fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedQuadric<'m, R>, Fault>
    where
        Self: 'm,
    {
        let Self { center, coefficients, min, max, capped } = *self;
        [center, min, max, center + min, center + max].into_iter().try_for_each(check_point)?;
        if coefficients.iter().any(|coefficient| !coefficient.is_finite()) {
            return Err(Fault::NotFinite);
        }
        let sides = max - min;
        if !(sides.x > 0.0 && sides.y > 0.0 && sides.z > 0.0) {
            return Err(Fault::NoVolume);
        }
        let half = R::Setup::from_f32(0.5);
        let (min, max) = (min.to::<R::Setup>(), max.to::<R::Setup>());
        let (middle, reach) = ((min + max) * half, (max - min) * half);
        let unit = R::Setup::from_f32(power_of_two_above(reach.length().to_f32()));
        let polynomial = Polynomial::new(coefficients, middle, unit)?;
        let middle = middle + center.to();
        let length = reach.length();
        let shortest = [reach.x, reach.y, reach.z].into_iter().fold(length, |a, b| if b < a { b } else { a });
        check_size(scale.length::<R>(shortest))?;
        let quadric = BoxedQuadric {
            middle: scale.point(middle),
            unit: scale.length(unit),
            polynomial: polynomial.rounded(),
            half: Vec3::from_setup(reach * unit.recip()),
            reach: scale.point(reach),
            length: scale.length(length),
            magnitude: scale.length(middle.magnitude() + length),
            capped,
        };
        memory.store(quadric).map(PreparedQuadric)
    }
}

/// A [`Quadric`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedQuadric<'m, R>(&'m BoxedQuadric<R>);

/// The data of a [`PreparedQuadric`].
#[derive(Clone, Copy, Debug, PartialEq)]
struct BoxedQuadric<R> {
    /// The middle of the box.
    middle: Vec3<R>,
    /// The length that is 1 in the polynomial: a power of two that is more than half of the box's diagonal.
    unit: R,
    polynomial: Polynomial<R>,
    /// Half the sides of the box, in that unit.
    half: Vec3<R>,
    /// Half the sides of the box, unscaled.
    reach: Vec3<R>,
    /// Half the diagonal of the box.
    length: R,
    magnitude: R,
    capped: bool,
}

/// A ray's line through the box. It is parametrized from its point nearest to the middle of the box.
struct BoxPassage<R> {
    /// The distance of that point from the ray's origin.
    advance: R,
    /// The part of the line in the box, in units.
    inside: Interval<R>,
    /// The roots of the polynomial along the line, in units.
    roots: Roots<R>,
}

impl<R: Real> BoxedQuadric<R> {
    /// `None` if the ray misses the box.
    fn passage(&self, ray: &Ray<R>) -> Option<BoxPassage<R>> {
        let (from_middle, advance) = ray.nearest_to(self.middle);
        if from_middle.length_squared_wide() > self.length.times(self.length) {
            return None;
        }
        let start = self.in_units(from_middle);
        let inside = self.in_box(start, ray.direction)?;
        Some(BoxPassage { advance, inside, roots: self.polynomial.roots(start, ray.direction) })
    }

    /// A vector in units of the polynomial.
    fn in_units(&self, vector: Vec3<R>) -> Vec3<R> {
        Vec3::new(vector.x / self.unit, vector.y / self.unit, vector.z / self.unit)
    }

    /// The part of a line that lies in the box, in units (Kay and Kajiya, "Ray Tracing Complex Scenes",
    /// SIGGRAPH 1986).
    fn in_box(&self, start: Vec3<R>, direction: Vec3<R>) -> Option<Interval<R>> {
        // The start lies in the ball around the box, whose radius is at most 1.
        let far = R::from_u16(2);
        let mut inside = Interval { min: -far, max: far };
        for (at, along, half) in [
            (start.x, direction.x, self.half.x),
            (start.y, direction.y, self.half.y),
            (start.z, direction.z, self.half.z),
        ] {
            if along == R::ZERO {
                if at.abs() >= half {
                    return None;
                }
                continue;
            }
            let (one, other) = ((-half - at) / along, (half - at) / along);
            let (enters, leaves) = if one < other { (one, other) } else { (other, one) };
            inside.min = inside.min.larger(enters);
            inside.max = leaves.smaller(inside.max);
        }
        (inside.min < inside.max).then_some(inside)
    }

    /// The parts of a line inside both the quadric and the box.
    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        let Some(BoxPassage { advance, inside: Interval { min, max }, roots }) = self.passage(ray) else {
            return Spans::NONE;
        };
        let mut spans = Spans::NONE;
        let mut push = |from: R, to: R| {
            // If the box leaves nothing, a root may be saturated, and its sum with `advance` would wrap.
            if from < to {
                spans.push(advance + from * self.unit, advance + to * self.unit);
            }
        };
        match roots {
            Roots::AllInside => push(min, max),
            Roots::AllOutside => {}
            Roots::Enters(at) => push(at.larger(min), max),
            Roots::Leaves(at) => push(min, max.smaller(at)),
            Roots::Inside(near, far) => push(near.larger(min), max.smaller(far)),
            Roots::Outside(near, far) => {
                push(min, max.smaller(near));
                push(far.larger(min), max);
            }
        }
        spans
    }

    /// The first hit of the quadric without the faces of the box.
    fn intersect_open(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let BoxPassage { advance, inside, roots } = self.passage(ray)?;
        let (near, far) = match roots {
            Roots::AllInside | Roots::AllOutside => return None,
            Roots::Enters(at) | Roots::Leaves(at) => (at, at),
            Roots::Inside(near, far) | Roots::Outside(near, far) => (near, far),
        };
        [near, far]
            .into_iter()
            .filter(|at| inside.contains(*at))
            .map(|at| advance + at * self.unit)
            .find(|t| range.contains(*t))
    }
}

impl<R: Real> Intersect<R> for PreparedQuadric<'_, R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        if !self.0.capped {
            return self.0.intersect_open(ray, range);
        }
        let spans = self.0.spans(ray);
        spans.as_slice().iter().flat_map(|part| [part.min, part.max]).find(|t| range.contains(*t))
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        Some(Aabb::around(self.0.middle, self.0.reach).padded(R::offset(self.0.magnitude)))
    }

    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        if self.0.capped { self.0.spans(ray) } else { Spans::NONE }
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let body = self.0;
        let at = body.in_units(ray.at(t) - body.middle);
        let (gradient, length) = body.polynomial.half_gradient(at).unit_and_length();
        // The gradient, which is 0 at the apex of a cone.
        let slope = length + length;
        let value = body.polynomial.at(at);
        let mut point = at;
        let mut normal = if length > R::ZERO { gradient } else { -ray.direction };
        // The distance from the surface is the value over the slope. Only small steps are taken: a step
        // longer than the rounding of a hit comes from a slope of almost 0, and would be wrong.
        let step = if value == R::ZERO { R::ZERO } else { value / slope };
        if value.abs() <= slope * R::from_fraction(1 << 8) {
            point = at - normal * step;
        }
        if body.capped {
            // The hit belongs to the quadric or to a face of the box, whichever is nearest.
            let mut nearest = step.abs();
            let half = body.half;
            let side = |at: R| if at < R::ZERO { -R::ONE } else { R::ONE };
            let (x, y, z) = (side(at.x), side(at.y), side(at.z));
            for (distance, face, on_face) in [
                (half.x - at.x.abs(), Vec3::new(x, R::ZERO, R::ZERO), Vec3::new(x * half.x, at.y, at.z)),
                (half.y - at.y.abs(), Vec3::new(R::ZERO, y, R::ZERO), Vec3::new(at.x, y * half.y, at.z)),
                (half.z - at.z.abs(), Vec3::new(R::ZERO, R::ZERO, z), Vec3::new(at.x, at.y, z * half.z)),
            ] {
                if distance.abs() < nearest {
                    (nearest, normal, point) = (distance.abs(), face, on_face);
                }
            }
        }
        let point = body.middle + point * body.unit;
        Surface { point, normal, shading_normal: normal, magnitude: body.magnitude, part: 0 }
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        uv::globe(surface.point - self.0.middle)
    }
}

impl<R: Real> Silhouette<R> for PreparedQuadric<'_, R> {
    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        if self.0.capped {
            return each_facet_of_any(self, tessellation, visit);
        }
        let body = self.0;
        let is_inside = |point: Vec3<R>| body.polynomial.at(body.in_units(point - body.middle)) < R::ZERO;
        let lattice = Lattice::within(Aabb::around(body.middle, body.reach), tessellation);
        lattice.each_facet(self, false, |row| row.each(is_inside), visit);
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        normal_after_step(self, surface, step)
    }
}

#[cfg(test)]
mod tests;
