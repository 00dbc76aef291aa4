//! A triangle as three planes, after Woop's affine triangle as Havel and Herout give it, "Yet Faster
//! Ray-Triangle Intersection (Using SSE4)", IEEE TVCG 2010, eqs. 4-9: one plane holds the triangle, and the
//! other two measure its barycentric coordinates.

use super::{Geometry, Intersect, project_onto_plane};
use crate::arena::Arena;
use crate::fault::{Fault, check_direction, check_point};
use crate::math::{Interval, Ray, Real, Vec3};
use crate::surface::Surface;

/// A triangle; its front is the side from which the vertices run counterclockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// The corners.
    pub vertices: [Vec3; 3],
    /// Normals at the corners, interpolated for shading; any length but 0. `None`: flat.
    pub normals: Option<[Vec3; 3]>,
}

impl Triangle {
    /// A flat triangle.
    pub const fn flat(a: Vec3, b: Vec3, c: Vec3) -> Self {
        Self { vertices: [a, b, c], normals: None }
    }

    pub(super) const fn const_vectors(&self) -> usize {
        if self.normals.is_some() { 3 } else { 0 }
    }
}

impl Geometry for Triangle {
    type Prepared<'m, R: Real> = PreparedTriangle<'m, R>;

    fn vectors(&self) -> usize {
        self.const_vectors()
    }

    fn prepare<'m, R: Real>(&self, memory: &mut Arena<'m>) -> Result<PreparedTriangle<'m, R>, Fault>
    where
        Self: 'm,
    {
        self.vertices.into_iter().try_for_each(check_point)?;
        let [a, b, c] = self.vertices.map(Vec3::to::<R>);
        let (ab, ac) = (b - a, c - a);
        let area_normal = ab.cross(ac);
        let doubled_area = area_normal.length();
        // Thinner than a millionth of its length, a triangle has no direction that could be trusted.
        if !(doubled_area > R::from_f32(1e-6) * ab.length() * ac.length()) {
            return Err(Fault::Collinear);
        }
        let normal = area_normal * doubled_area.recip();
        // The gradient of each barycentric coordinate lies in the plane, across the opposite edge.
        let gradient_b = ac.cross(normal) * doubled_area.recip();
        let gradient_c = normal.cross(ab) * doubled_area.recip();
        let normals = match self.normals {
            None => None,
            Some(normals) => {
                let mut units = [Vec3::ZERO; 3];
                for (unit, normal) in units.iter_mut().zip(normals) {
                    *unit = check_direction(normal)?;
                }
                memory.store(units).map(Some)?
            }
        };
        Ok(PreparedTriangle {
            normal,
            distance: normal.dot(a),
            gradient_b,
            offset_b: -gradient_b.dot(a),
            gradient_c,
            offset_c: -gradient_c.dot(a),
            normals,
        })
    }
}

/// A [`Triangle`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedTriangle<'m, R> {
    normal: Vec3<R>,
    distance: R,
    gradient_b: Vec3<R>,
    offset_b: R,
    gradient_c: Vec3<R>,
    offset_c: R,
    normals: Option<&'m [Vec3<R>; 3]>,
}

impl<R: Real> PreparedTriangle<'_, R> {
    /// The weights of the second and third corner at a point of the plane.
    fn barycentric(&self, point: Vec3<R>) -> (R, R) {
        (self.gradient_b.dot(point) + self.offset_b, self.gradient_c.dot(point) + self.offset_c)
    }
}

impl<R: Real> Intersect<R> for PreparedTriangle<'_, R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let height = self.distance - self.normal.dot(ray.origin);
        let slope = self.normal.dot(ray.direction);
        let toward = (height > R::ZERO && slope > R::ZERO) || (height < R::ZERO && slope < R::ZERO);
        if !toward {
            return None;
        }
        let t = height / slope;
        if !range.contains(t) {
            return None;
        }
        let (b, c) = self.barycentric(ray.at(t));
        (b >= R::ZERO && c >= R::ZERO && b + c <= R::ONE).then_some(t)
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let point = project_onto_plane(ray.at(t), self.normal, self.distance);
        let shading_normal = self.normals.and_then(|[at_a, at_b, at_c]| {
            let (b, c) = self.barycentric(point);
            (*at_a * (R::ONE - b - c) + *at_b * b + *at_c * c).normalized()
        });
        Surface {
            point,
            normal: self.normal,
            shading_normal: shading_normal.unwrap_or(self.normal),
            magnitude: point.magnitude().larger(self.distance.abs()),
        }
    }
}
