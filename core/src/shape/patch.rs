//! A plane with two coordinates: the common part of triangles and rectangles. After Woop's affine triangle,
//! as given by Havel and Herout, "Yet Faster Ray-Triangle Intersection (Using SSE4)", IEEE TVCG 2010, eqs.
//! 4-9.

use super::{Hull, PreparedPlane};
use crate::fault::{Fault, check_size};
use crate::math::{FourRays, Interval, Linear, Ray, Real, Scale, Vec3, each};

/// A plane, spanned by two edges from a corner. Along each edge one coordinate grows from 0 to 1; the other
/// one is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Patch<R: Real> {
    pub(super) plane: PreparedPlane<R>,
    u: R::Linear,
    v: R::Linear,
}

impl<R: Real> Patch<R> {
    /// The patch with the edges `right` and `up`, in the scene's units. The patch is refused if the edges lie
    /// on one line, or if the patch is too thin for the number system.
    pub(super) fn new(
        corner: Vec3<R::Setup>,
        right: Vec3<R::Setup>,
        up: Vec3<R::Setup>,
        scale: Scale,
    ) -> Result<Self, Fault> {
        let area_normal = right.cross(up);
        let area = area_normal.length();
        // The normal of a patch that is thinner than a millionth of its length would be rounding.
        if !(area > R::Setup::from_f32(1e-6) * right.length() * up.length()) {
            return Err(Fault::Collinear);
        }
        // A gradient is 1 over the distance of an edge from the corners that are not on it. In fixed point,
        // that of a thinner patch has no room.
        check_size(scale.length::<R>(area / right.length().larger(up.length())))?;
        let normal = area_normal * area.recip();
        // The gradient of each coordinate lies in the plane, at a right angle to the other edge.
        let gradient_u = up.cross(normal) * area.recip();
        let gradient_v = normal.cross(right) * area.recip();
        let zero = scale.setup_point::<R>(corner);
        let per_unit = R::Setup::from_f32(1.0 / scale.to_f32());
        Ok(Self {
            plane: PreparedPlane::new(normal, normal.dot(corner), scale),
            u: R::Linear::new(gradient_u * per_unit, zero),
            v: R::Linear::new(gradient_v * per_unit, zero),
        })
    }

    /// The distance at which a ray meets the part of the plane whose two coordinates are `inside`.
    #[inline]
    pub(super) fn meet(
        &self,
        ray: &Ray<R>,
        range: Interval<R>,
        inside: impl FnOnce(R, R) -> bool,
    ) -> Option<R> {
        self.plane.meet_where(ray, range, |point| {
            let (u, v) = self.coordinates(point);
            inside(u, v)
        })
    }

    /// [`meet`](Self::meet) for four rays: a bit for each ray that meets the plane nearer than its `max`, the
    /// four distances, and both coordinates of the four hits.
    #[inline]
    #[allow(clippy::indexing_slicing)] // All indices are below 4.
    pub(super) fn meet_four(&self, rays: &FourRays<R>, max: &[R; 4]) -> (u32, [R; 4], [R; 4], [R; 4]) {
        let PreparedPlane { normal, distance } = self.plane;
        let height = each(|i| distance - normal.dot(rays.ray(i).origin));
        let slope = each(|i| normal.dot(rays.ray(i).direction));
        // Positive and finite only for rays that go toward the plane.
        let t = each(|i| height[i] / slope[i]);
        let met = R::less(&[R::ZERO; 4], &t) & R::less(&t, max);
        let points = each(|i| rays.ray(i).at(t[i]));
        (met, t, each(|i| self.u.at(points[i])), each(|i| self.v.at(points[i])))
    }

    /// The coordinates of a point of the plane.
    pub(super) fn coordinates(&self, point: Vec3<R>) -> (R, R) {
        (self.u.at(point), self.v.at(point))
    }

    /// The parallelogram of the two edges.
    pub(super) fn hull(&self) -> Hull<R> {
        let [corner, right, up] = self.edges().map(Vec3::from_setup);
        Hull::edges(corner, [right, up, Vec3::ZERO])
    }

    /// The corner and the two edges.
    pub(super) fn edges(&self) -> [Vec3<R::Setup>; 3] {
        let (u, v) = (self.u.gradient(), self.v.gradient());
        let (n, distance) = (self.plane.normal.to_setup(), self.plane.distance.to_setup());
        // The edges are the dual basis of the gradients.
        let volume = u.cross(v).dot(n).recip();
        let (right, up) = (v.cross(n) * volume, n.cross(u) * volume);
        [n * distance - right * self.u.offset() - up * self.v.offset(), right, up]
    }
}
