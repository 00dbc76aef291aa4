//! A quadric: where a polynomial of second degree is 0, in a box (Heckbert in Glassner (ed.), "An Introduction to Ray
//! Tracing", 1989, ch. 2), its roots without cancellation (Press et al., "Numerical Recipes", §5.6).

mod polynomial;

use polynomial::{Polynomial, Roots, power_of_two_above};

use super::{Geometry, Intersect, Spans, beside, uv};
use crate::arena::Arena;
use crate::fault::{Fault, check_point, check_size};
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// The part of a quadric in a box: of an ellipsoid, a hyperboloid, a paraboloid, a cone or a cylinder across any direction.
///
/// It is where A x² + B y² + C z² + D xy + E xz + F yz + G x + H y + I z + J = 0; its inside is where that is less than 0. The
/// equation may be multiplied by any positive factor. A negative one turns the inside out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Quadric {
    /// Where x, y and z are 0.
    pub center: Vec3,
    /// A to J.
    pub coefficients: [f32; 10],
    /// The corner of the box with the smallest coordinates, as seen from the center.
    pub min: Vec3,
    /// The corner with the largest; the box must have room inside.
    pub max: Vec3,
    /// Whether the faces of the box close it; without, it is a surface without thickness.
    pub capped: bool,
}

impl Quadric {
    pub(super) const fn const_bytes<R: Real>() -> usize {
        Arena::bytes::<Body<R>>(1)
    }
}

impl Geometry for Quadric {
    type Prepared<'m, R: Real> = PreparedQuadric<'m, R>;

    fn bytes<R: Real>(&self) -> usize {
        Self::const_bytes::<R>()
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
        let body = Body {
            middle: scale.point(middle),
            unit: scale.length(unit),
            polynomial: polynomial.rounded(),
            half: Vec3::from_setup(reach * unit.recip()),
            reach: scale.point(reach),
            length: scale.length(length),
            magnitude: scale.length(middle.magnitude() + length),
            capped,
        };
        memory.store(body).map(PreparedQuadric)
    }
}

/// A [`Quadric`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedQuadric<'m, R>(&'m Body<R>);

#[derive(Clone, Copy, Debug, PartialEq)]
struct Body<R> {
    /// Of the box.
    middle: Vec3<R>,
    /// What is 1 in the polynomial: a power of two, in which half of the box's diagonal fits.
    unit: R,
    polynomial: Polynomial<R>,
    /// Half the sides of the box, in that unit.
    half: Vec3<R>,
    /// The same in the scene's.
    reach: Vec3<R>,
    /// Half the diagonal.
    length: R,
    magnitude: R,
    capped: bool,
}

/// A line's way through the box.
struct Passage<R> {
    /// Distance from the origin of the ray to where it is nearest to the middle of the box.
    advance: R,
    /// The part that is in the box, from there.
    inside: Interval<R>,
    roots: Roots<R>,
}

impl<R: Real> Body<R> {
    fn passage(&self, ray: &Ray<R>) -> Option<Passage<R>> {
        let (from_middle, advance) = ray.nearest_to(self.middle);
        if from_middle.length_squared_wide() > self.length.times(self.length) {
            return None;
        }
        let start = self.in_units(from_middle);
        let inside = self.in_box(start, ray.direction)?;
        Some(Passage { advance, inside, roots: self.polynomial.roots(start, ray.direction) })
    }

    fn in_units(&self, vector: Vec3<R>) -> Vec3<R> {
        Vec3::new(vector.x / self.unit, vector.y / self.unit, vector.z / self.unit)
    }

    /// The part of a line that lies in the box (Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986).
    fn in_box(&self, start: Vec3<R>, direction: Vec3<R>) -> Option<Interval<R>> {
        // The line starts near the middle of a box that fits in the unit ball.
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

    /// The parts of a line inside quadric and box.
    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        let Some(Passage { advance, inside: Interval { min, max }, roots }) = self.passage(ray) else {
            return Spans::NONE;
        };
        let mut spans = Spans::NONE;
        let mut push = |from: R, to: R| {
            // Where the box leaves nothing, a root may be saturated, and a sum with it would wrap.
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

    /// The first hit of the quadric itself.
    fn intersect_open(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let Passage { advance, inside, roots } = self.passage(ray)?;
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
        // At the apex of a cone there is no gradient.
        let slope = length + length;
        let value = body.polynomial.at(at);
        let mut point = at;
        let mut normal = if length > R::ZERO { gradient } else { -ray.direction };
        // The distance is the value over the slope. A step that is longer than the rounding of a hit would lead astray: it
        // comes from a slope that is next to 0.
        let step = if value == R::ZERO { R::ZERO } else { value / slope };
        if value.abs() <= slope * R::from_fraction(1 << 8) {
            point = at - normal * step;
        }
        if body.capped {
            // Of the quadric and the faces of the box, the hit belongs to the one that it is nearest to.
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

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        beside(self, surface, step)
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        uv::globe(surface.point - self.0.middle)
    }
}

#[cfg(test)]
mod tests;
