//! A mesh of triangles that share their vertices, with a hierarchy of boxes around them (see `hierarchy`).
//! The test of one triangle is in [`ray`].
//!
//! # Memory
//! In `f32` and fixed point:
//!
//! | data | bytes |
//! |---|---|
//! | order of the triangles | 2 a triangle |
//! | boxes, for more than [`FEW_TRIANGLES`] | up to 36 a triangle |
//! | prepared vertices | 12 a vertex |
//! | normals at vertices | 6 a vertex |
//! | the mesh itself | 88; 152 on 64-bit processors |
//!
//! A closed mesh has half as many vertices as triangles: it takes 48 bytes a triangle with normals, and 45
//! without. A mesh that has no more vertices than triangles takes at most 57. The indices of vertices and the
//! coordinates for textures are read from the description, in flash. A [`BakedMesh`] takes no memory, as all
//! of its data lies in flash.
//!
//! # Finding the triangle again
//! [`Intersect::surface`] gets only the ray and the distance, not the triangle. It tests the triangles whose
//! boxes contain the hit once more, in the same way, and takes the first one in the list that the ray meets
//! at exactly that distance. So the result does not depend on the order in which boxes are visited.
//!
//! # The edge of the shadow
//! Where a smooth mesh turns away from a light, whole triangles do so before their interpolated normals, and
//! the shadow begins in steps. With [`Mesh::smooth_terminator`], rays leave the smooth surface instead: see
//! `terminator`.

mod baked;
mod ray;
mod smooth;
mod terminator;
#[cfg(test)]
mod tests;

pub use baked::{BakedMesh, BakedParts};
pub use smooth::SmallNormal;

use super::{Bend, Facet, Geometry, Intersect, Rim, Silhouette, Tessellation, bounds_of};
use crate::arena::Arena;
use crate::color::LinearRgb;
use crate::fault::{Fault, check_held, check_number, check_point, check_size};
use crate::hierarchy::Hierarchy;
use crate::limits::MAX_COUNT;
use crate::math::{Aabb, Extent, Interval, Product, Ray, Real, Scale, Vec3};
use crate::surface::Surface;
use crate::texture::Encoding;
use ray::{Meeting, MeshRay};

/// A mesh of up to 65535 triangles, which share up to 65535 vertices.
///
/// No ray slips through an edge or a vertex that triangles share by its index. Triangles without area, which
/// files often have at poles and seams, are never met.
///
/// ```
/// use rayline::Vec3;
/// use rayline::shape::Mesh;
///
/// /// Four faces; their fronts are outside.
/// static TETRAHEDRON: Mesh = Mesh::new(
///     &[
///         Vec3::new(1.0, 1.0, 1.0),
///         Vec3::new(1.0, -1.0, -1.0),
///         Vec3::new(-1.0, 1.0, -1.0),
///         Vec3::new(-1.0, -1.0, 1.0),
///     ],
///     &[[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]],
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Mesh<'a> {
    /// The vertices of all triangles.
    pub vertices: &'a [Vec3],
    /// For each triangle the indices of its corners in `vertices`. Its front is the side from which they run
    /// counterclockwise.
    pub triangles: &'a [[u16; 3]],
    /// Normals at the vertices, interpolated for shading: one for each vertex, of any length. A triangle is
    /// flat where they cancel or are 0; with `None`, all triangles are flat.
    pub normals: Option<&'a [Vec3]>,
    /// Coordinates u and v at the vertices, interpolated for textures: one pair for each vertex, from -59 to
    /// 59 if all number systems are to hold them. With `None`, each triangle has those of a single
    /// [`Triangle`](super::Triangle).
    pub uvs: Option<&'a [[f32; 2]]>,
    /// Colors at the vertices, as codes of sRGB, interpolated in linear light: one for each vertex. The color
    /// of the material is multiplied by them, channel by channel. They need the feature `textures`.
    pub colors: Option<&'a [[u8; 3]]>,
    /// Whether rays leave the smooth surface that the normals describe, and not the flat triangles. Removes
    /// the steps at shadows' edges on coarse meshes (Hanika, "Hacking the Shadow Terminator", Ray Tracing
    /// Gems II, 2021, ch. 4). Needs normals, and a material that is not transparent. Takes about a twentieth
    /// of the time of their pixels.
    pub smooth_terminator: bool,
}

#[cfg(feature = "serde")]
crate::read::read_struct! {
    [] Mesh as Mesh<'m> {
        vertices, triangles, normals = None, uvs = None, colors = None, smooth_terminator = false,
    }
    may be named
}

/// The most triangles that are tested one by one, without a hierarchy.
const FEW_TRIANGLES: usize = 8;

/// The most triangles in a leaf of the hierarchy.
const LEAF: usize = 4;

/// The number of triangles that the hierarchy has, for a mesh of so many.
const fn in_boxes(triangles: usize) -> usize {
    if cfg!(feature = "hierarchy") && triangles > FEW_TRIANGLES { triangles } else { 0 }
}

impl<'a> Mesh<'a> {
    /// Flat triangles without coordinates or colors of their own.
    pub const fn new(vertices: &'a [Vec3], triangles: &'a [[u16; 3]]) -> Self {
        Self { vertices, triangles, normals: None, uvs: None, colors: None, smooth_terminator: false }
    }
}

impl Mesh<'_> {
    /// [`Geometry::bytes`], usable in constants.
    pub const fn const_bytes<R: Real>(&self) -> usize {
        let (vertices, triangles) = (self.vertices.len(), self.triangles.len());
        let normals = if self.normals.is_some() { vertices } else { 0 };
        Arena::bytes::<MeshData<'_, R>>(1)
            .saturating_add(Arena::bytes::<Vec3<R>>(vertices))
            .saturating_add(Arena::bytes::<SmallNormal>(normals))
            .saturating_add(Arena::bytes::<u16>(triangles))
            .saturating_add(Hierarchy::<R>::bytes(in_boxes(triangles), LEAF))
    }

    /// Refuses a description with wrong counts, indices or numbers.
    fn check<R: Real>(&self) -> Result<(), Fault> {
        let (vertices, triangles) = (self.vertices.len(), self.triangles.len());
        for given in [vertices, triangles] {
            if given > MAX_COUNT {
                return Err(Fault::TooMany { given });
            }
        }
        if let Some(normals) = self.normals
            && normals.len() != vertices
        {
            return Err(Fault::NormalCount { normals: normals.len(), vertices });
        }
        if self.smooth_terminator && self.normals.is_none() {
            return Err(Fault::TerminatorWithoutNormals);
        }
        if let Some(uvs) = self.uvs {
            if uvs.len() != vertices {
                return Err(Fault::UvCount { uvs: uvs.len(), vertices });
            }
            for coordinate in uvs.iter().flatten() {
                check_number(*coordinate)?;
                check_held::<R>(R::Setup::from_f32(*coordinate))?;
            }
        }
        if let Some(colors) = self.colors {
            if !cfg!(feature = "textures") {
                return Err(Fault::WithoutFeature { feature: "textures" });
            }
            if colors.len() != vertices {
                return Err(Fault::ColorCount { colors: colors.len(), vertices });
            }
        }
        self.vertices.iter().copied().try_for_each(check_point)?;
        for (triangle, corners) in self.triangles.iter().enumerate() {
            let unknown = corners.iter().copied().map(usize::from).find(|corner| *corner >= vertices);
            if let Some(named) = unknown {
                return Err(Fault::UnknownVertex { triangle, named, vertices });
            }
        }
        Ok(())
    }
}

impl Geometry for Mesh<'_> {
    type Prepared<'m, R: Real>
        = PreparedMesh<'m, R>
    where
        Self: 'm;

    fn bytes<R: Real>(&self) -> usize {
        self.const_bytes::<R>()
    }

    fn extent(&self) -> Extent {
        Extent::flat_between(self.vertices.iter().copied())
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, memory: &mut Arena<'m>) -> Result<PreparedMesh<'m, R>, Fault>
    where
        Self: 'm,
    {
        self.check::<R>()?;
        let convert = |vertex: &Vec3| scale.point::<R>(vertex.to());
        let vertices = self.vertices;
        let vertices = memory
            .try_store_with(vertices.len(), |i, _| vertices.get(i).map(convert).ok_or(Fault::NoTriangles))?;
        let normals = self.normals.unwrap_or_default();
        let normals = memory.try_store_with(normals.len(), |i, _| {
            SmallNormal::new::<R::Setup>(normals.get(i).copied().unwrap_or(Vec3::ZERO))
        })?;
        let order = memory.try_store_with(self.triangles.len(), |i, _| Ok::<u16, Fault>(i as u16))?;

        let list = Hierarchy::list(&[]);
        let bounds = Aabb::point(Vec3::ZERO);
        let uvs = self.uvs.unwrap_or_default();
        let colors = self.colors.unwrap_or_default();
        let (triangles, lift) = (self.triangles, R::ZERO);
        let mut parts = MeshData { triangles, vertices, normals, uvs, colors, hierarchy: list, bounds, lift };
        // Leave out the triangles without area.
        let mut proper = 0;
        for i in 0..order.len() {
            let Some(triangle) = order.get(i).copied() else { break };
            if parts.corners(triangle).and_then(normal).is_some()
                && let Some(place) = order.get_mut(proper)
            {
                *place = triangle;
                proper += 1;
            }
        }
        let order = order.get_mut(..proper).unwrap_or_default();
        let corners = order.iter().filter_map(|triangle| parts.corners(*triangle)).flatten();
        parts.bounds = bounds_of(corners).ok_or(Fault::NoTriangles)?;
        let Vec3 { x, y, z } = parts.bounds.max - parts.bounds.min;
        check_size(x.larger(y).larger(z))?;
        parts.hierarchy = if in_boxes(order.len()) > 0 {
            let bounds =
                |triangle| parts.corners(triangle).and_then(|corners| bounds_of(corners.into_iter()));
            Hierarchy::new(order, LEAF, bounds, memory)?
        } else {
            Hierarchy::list(order)
        };
        if self.smooth_terminator {
            parts.lift = parts.highest_lift();
        }
        Ok(PreparedMesh(memory.store(parts)?))
    }
}

/// A [`Mesh`], prepared.
#[derive(Clone, Copy, Debug)]
pub struct PreparedMesh<'m, R>(&'m MeshData<'m, R>);

/// The data of a prepared mesh. It lies in lent memory or in flash, so that the enum of all shapes stays
/// small.
#[derive(Clone, Copy, Debug, PartialEq)]
struct MeshData<'m, R> {
    triangles: &'m [[u16; 3]],
    vertices: &'m [Vec3<R>],
    /// One for each vertex, or none.
    normals: &'m [SmallNormal],
    /// One pair for each vertex, in the description's memory, or none.
    uvs: &'m [[f32; 2]],
    /// One for each vertex, in the description's memory, or none.
    colors: &'m [[u8; 3]],
    /// The hierarchy of the triangles that have an area.
    hierarchy: Hierarchy<'m, R>,
    bounds: Aabb<R>,
    /// The longest way from a triangle to the smooth surface; 0 if rays leave the triangles.
    lift: R,
}

impl<R: Real> MeshData<'_, R> {
    /// The corners of a triangle.
    #[inline]
    fn corners(&self, triangle: u16) -> Option<[Vec3<R>; 3]> {
        let [a, b, c] = *self.triangles.get(usize::from(triangle))?;
        let vertex = |index: u16| self.vertices.get(usize::from(index)).copied();
        Some([vertex(a)?, vertex(b)?, vertex(c)?])
    }

    /// The longest edge of a triangle, as a rim.
    fn rim(&self, triangle: u16) -> Option<Rim<R>> {
        let [a, b, c] = self.corners(triangle)?;
        let edges = [[a, b], [b, c], [c, a]];
        let [first, second, third] = edges.map(|[from, to]| (to - from).length_squared_wide());
        let [ab, bc, ca] = edges;
        let last = if second >= third { bc } else { ca };
        let ends @ [from, to] = if first >= second && first >= third { ab } else { last };
        let bend = match self.half_normals(triangle) {
            Some(normals) => Bend::Smooth(normals),
            None => Bend::Sharp((b - a).cross(c - a).length() / (to - from).length()),
        };
        Some(Rim { ends, bend })
    }

    /// Half of each unit normal at a triangle's corners, if the mesh has normals.
    fn half_normals(&self, triangle: u16) -> Option<[Vec3<R>; 3]> {
        let [a, b, c] = *self.triangles.get(usize::from(triangle))?;
        let at = |index: u16| self.normals.get(usize::from(index)).map(|normal| normal.half());
        Some([at(a)?, at(b)?, at(c)?])
    }

    #[inline]
    fn meet(&self, triangle: usize, mesh_ray: &MeshRay<R>) -> Option<Meeting<R>> {
        mesh_ray.meet(self.corners(triangle as u16)?)
    }

    /// The interpolated coordinates u and v of a triangle, if the mesh has any.
    fn interpolated_uv(&self, triangle: u16, weight_b: R, weight_c: R) -> Option<[R; 2]> {
        let [a, b, c] = *self.triangles.get(usize::from(triangle))?;
        let at = |index: u16| self.uvs.get(usize::from(index)).map(|uv| uv.map(R::from_f32));
        let ([a_u, a_v], [b_u, b_v], [c_u, c_v]) = (at(a)?, at(b)?, at(c)?);
        let between = |a: R, b: R, c: R| a + (b - a) * weight_b + (c - a) * weight_c;
        Some([between(a_u, b_u, c_u), between(a_v, b_v, c_v)])
    }

    /// The interpolated color of a triangle, if the mesh has colors.
    fn interpolated_color(&self, triangle: u16, weight_b: R, weight_c: R) -> Option<LinearRgb<R>> {
        let [a, b, c] = *self.triangles.get(usize::from(triangle))?;
        let at = |index: u16| {
            let [r, g, b] = self.colors.get(usize::from(index))?.map(|code| Encoding::Srgb.light(code));
            Some(LinearRgb::new(r, g, b))
        };
        let (a, b, c) = (at(a)?, at(b)?, at(c)?);
        // Beside the triangle, weights are below 0 or above 1, but colors are not.
        let within = |weight: R| weight.larger(R::ZERO).smaller(R::ONE);
        let weight_b = within(weight_b);
        let weight_c = weight_c.larger(R::ZERO).smaller(R::ONE - weight_b);
        Some(a.scaled(R::ONE - weight_b - weight_c) + b.scaled(weight_b) + c.scaled(weight_c))
    }

    /// The interpolated normal of a triangle; `None` if it is flat or the normals cancel.
    fn shading_normal(&self, triangle: u16, meeting: Meeting<R>) -> Option<Vec3<R>> {
        let [a, b, c] = self.half_normals(triangle)?;
        let Meeting { b: weight_b, c: weight_c, .. } = meeting;
        let weight_a = R::ONE - weight_b - weight_c;
        (a * weight_a + b * weight_b + c * weight_c).normalized()
    }
}

/// The weights of the second and the third corner at the point of a triangle's plane that is nearest to
/// `point`, by the normal equations of least squares.
fn weights<R: Real>([a, b, c]: [Vec3<R>; 3], point: Vec3<R>) -> (R, R) {
    let (ab, ac, from_a) = (b - a, c - a, point - a);
    // Divide by the longest coordinate of the edges, so that squares keep their digits.
    let unit = ab.magnitude().larger(ac.magnitude());
    let [ab, ac, from_a] = [ab, ac, from_a].map(|v| Vec3::new(v.x / unit, v.y / unit, v.z / unit));
    // The weight of an edge is found along its part at a right angle to the other edge.
    let weight = |edge: Vec3<R>, other: Vec3<R>| {
        let (along, length) = other.unit_and_length();
        let across = edge - along * edge.dot(along);
        if length > R::ZERO { from_a.dot_wide(across).over(across.dot(across)) } else { R::ZERO }
    };
    (weight(ab, ac), weight(ac, ab))
}

/// The unit normal of a triangle; `None` if it has no area: if it is thinner than a millionth of its length.
fn normal<R: Real>([a, b, c]: [Vec3<R>; 3]) -> Option<Vec3<R>> {
    let (ab, bc, ca) = (b - a, c - b, a - c);
    // Use the two shorter edges: their angle is the largest.
    let squared = |edge: Vec3<R>| edge.length_squared_wide();
    let (first, second) = if squared(ca) >= squared(ab) && squared(ca) >= squared(bc) {
        (ab, bc)
    } else if squared(ab) >= squared(bc) {
        (bc, ca)
    } else {
        (ca, ab)
    };
    let (normal, sine) = first.normalized()?.cross(second.normalized()?).unit_and_length();
    (sine > R::from_f32(1e-6)).then_some(normal)
}

impl<R: Real> Intersect<R> for PreparedMesh<'_, R> {
    const IS_SMOOTHED: bool = true;

    // Not inlined: the list of waiting boxes takes 488 bytes of stack, which other shapes should not pay for.
    #[inline(never)]
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let mesh_ray = MeshRay::new(ray);
        let mut range = range;
        let mut nearest = None;
        self.0.hierarchy.walk(ray, range.max, |triangle| {
            if let Some(Meeting { t, .. }) = self.0.meet(triangle, &mesh_ray)
                && range.contains(t)
            {
                range.max = t;
                nearest = Some(t);
            }
            range.max
        });
        nearest
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        // Surfaces lie inside.
        Some(if self.is_lifted() { self.0.bounds.padded(self.0.lift) } else { self.0.bounds })
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let mesh_ray = MeshRay::new(ray);
        let point = ray.at(t);
        let margin = R::offset(ray.origin.magnitude().larger(point.magnitude()));
        let mut met: Option<(u16, Meeting<R>)> = None;
        self.0.hierarchy.visit(point, margin, |triangle| {
            let is_first = met.is_none_or(|(first, _)| triangle < usize::from(first));
            if is_first
                && let Some(meeting) = self.0.meet(triangle, &mesh_ray)
                && meeting.t == t
            {
                met = Some((triangle as u16, meeting));
            }
        });
        let back = -ray.direction;
        let flat =
            |normal| Surface { point, normal, shading_normal: normal, magnitude: point.magnitude(), part: 0 };
        // If `intersect` returned `t`, there is a triangle and it has a normal.
        let Some((triangle, meeting)) = met else { return flat(back) };
        let Some(corners) = self.0.corners(triangle) else { return flat(back) };
        let normal = normal(corners).unwrap_or(back);
        let [a, b, c] = corners;
        let mut point = point - normal * normal.dot(point - a);
        if self.is_lifted() {
            let (facing, _, _) = normal.facing(ray.direction);
            point = point + facing * self.0.lift(triangle, meeting, point, facing);
        }
        Surface {
            point,
            normal,
            shading_normal: self.0.shading_normal(triangle, meeting).unwrap_or(normal),
            magnitude: a.magnitude().larger(b.magnitude()).larger(c.magnitude()),
            part: triangle.into(),
        }
    }

    fn is_lifted(&self) -> bool {
        self.0.lift > R::ZERO
    }

    /// Whether any of the triangles that the ray meets there shows its front: two with opposite fronts may
    /// lie at one place.
    fn is_front(&self, ray: &Ray<R>, t: R) -> bool {
        let mesh_ray = MeshRay::new(ray);
        let point = ray.at(t);
        let margin = R::offset(ray.origin.magnitude().larger(point.magnitude()));
        let mut is_front = false;
        self.0.hierarchy.visit(point, margin, |triangle| {
            let is_met = self.0.meet(triangle, &mesh_ray).is_some_and(|meeting| meeting.t == t);
            let normal = || self.0.corners(triangle as u16).and_then(normal);
            is_front |= is_met && normal().is_some_and(|normal| !(normal.dot(ray.direction) > R::ZERO));
        });
        is_front
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        let triangle = surface.part as u16;
        let Some(corners) = self.0.corners(triangle) else { return [R::ZERO; 2] };
        let (b, c) = weights(corners, surface.point);
        self.0.interpolated_uv(triangle, b, c).unwrap_or([b, c])
    }

    fn is_tinted(&self) -> bool {
        !self.0.colors.is_empty()
    }

    fn tint(&self, surface: &Surface<R>) -> LinearRgb<R> {
        let triangle = surface.part as u16;
        let color = self.0.corners(triangle).and_then(|corners| {
            let (b, c) = weights(corners, surface.point);
            self.0.interpolated_color(triangle, b, c)
        });
        color.unwrap_or(LinearRgb::even(R::ONE))
    }
}

impl<R: Real> Silhouette<R> for PreparedMesh<'_, R> {
    const HAS_RIMS: bool = true;

    fn each_rim(&self, visit: impl FnMut(Rim<R>)) {
        (0..=u16::MAX).map_while(|triangle| self.0.rim(triangle)).for_each(visit);
    }

    fn each_facet(&self, _: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        for triangle in 0..=u16::MAX {
            let Some(corners) = self.0.corners(triangle) else { break };
            let Some(normal) = normal(corners) else { continue };
            // A vertex without a normal is shaded as if the triangle were flat.
            let normals = self
                .0
                .half_normals(triangle)
                .map_or([normal; 3], |halves| halves.map(|half| half.normalized().unwrap_or(normal)));
            visit(&Facet { corners, normals, part: triangle.into(), is_closed: false });
        }
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        let triangle = surface.part as u16;
        let beside = self.0.corners(triangle).and_then(|corners| {
            // A small triangle may be many of its sizes away: limit the extrapolation.
            let (b, c) = weights(corners, surface.point + step);
            let [b, c] = [b, c].map(|weight| weight.larger(-R::from_u16(4)).smaller(R::from_u16(4)));
            self.0.shading_normal(triangle, Meeting { t: R::ZERO, b, c })
        });
        beside.unwrap_or(surface.shading_normal)
    }
}
