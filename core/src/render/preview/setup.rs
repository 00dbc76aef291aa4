//! From the scene's facets to those of the picture: lit, clipped and projected.

use super::clip::clipped;
use super::corner::{Corner, Light, View};
use super::facet::{PreviewFacet, packed, unpacked};
use super::{PreviewError, Renderer};
use crate::color::LinearRgb;
use crate::integrator::{UnshadowedLight, unshadowed};
use crate::limits::MAX_PREVIEW_FACETS;
use crate::material::{MapRoom, PreparedMaterial};
use crate::math::{Ray, Real, Vec3};
use crate::prepared::{Hit, PreparedScene};
use crate::shape::{Facet, Geometry, Tessellation};
use crate::surface::Surface;
use crate::texture::PreparedTexture;

/// The nearest depth that is shown, as a share of the distance from the eye to the farthest box: 1/512.
const NEAREST: u16 = 1 << 7;

/// Writes the facets of a scene that can be seen to the beginning of `memory`; returns them, and the nearest
/// depth.
pub(super) fn facets<'f, R: Real, S: Geometry>(
    renderer: &Renderer<'_, '_, R, S>,
    segments: u16,
    memory: &'f mut [PreviewFacet],
) -> Result<(&'f mut [PreviewFacet], f32), PreviewError> {
    let (viewport, scene) = (&renderer.viewport, renderer.scene);
    let view = View { eye: viewport.eye(), axes: viewport.axes(), half: viewport.half_at_one() };
    let nearest = nearest_depth(scene, view.eye);
    let mut setup = Setup {
        scene,
        view,
        nearest,
        size: (renderer.width, renderer.height),
        lit: [None; 3],
        kept: 0,
        memory,
    };
    let tessellation = Tessellation { segments, eye: setup.view.eye };
    scene.each_facet(&tessellation, &mut |object, facet| setup.add(object, facet));
    let Setup { kept, memory, .. } = setup;
    let lent = memory.len();
    if kept > lent.min(MAX_PREVIEW_FACETS) {
        return Err(PreviewError::Facets { needed: kept, lent });
    }
    Ok((memory.get_mut(..kept).unwrap_or_default(), nearest.to_f32()))
}

/// The nearest depth that is shown.
fn nearest_depth<R: Real, S: Geometry>(scene: &PreparedScene<'_, R, S>, eye: Vec3<R>) -> R {
    let mut farthest = R::ZERO;
    for bounds in scene.boxes() {
        for corner in [bounds.min, bounds.max] {
            farthest = farthest.larger((corner - eye).magnitude());
        }
    }
    // Before an infinite plane alone.
    if !(farthest > R::ZERO) {
        farthest = R::ONE;
    }
    farthest * R::from_fraction(NEAREST)
}

/// A corner that was lit, for facets that share it.
#[derive(Clone, Copy)]
struct Lit<R> {
    object: usize,
    part: u32,
    point: Vec3<R>,
    normal: Vec3<R>,
    corner: Corner<R>,
}

struct Setup<'s, 'm, 'f, R: Real, S: Geometry + 'm> {
    scene: &'s PreparedScene<'m, R, S>,
    view: View<R>,
    nearest: R,
    size: (u16, u16),
    /// The corners of the last facet.
    lit: [Option<Lit<R>>; 3],
    /// How many facets were to be kept; beyond the end of the memory they are only counted.
    kept: usize,
    memory: &'f mut [PreviewFacet],
}

impl<R: Real, S: Geometry> Setup<'_, '_, '_, R, S> {
    /// Adds what is seen of a facet.
    fn add(&mut self, object: usize, facet: &Facet<R>) {
        let Some(material) = self.scene.material(object) else { return };
        let [a, b, c] = facet.corners;
        // Unit vectors, so that small facets keep their digits.
        let Some(normal) = (b - a).unit().cross((c - a).unit()).normalized() else { return };
        let from_eye = a - self.view.eye;
        let is_back = normal.dot(from_eye) > R::ZERO;
        let hides_back = facet.is_closed || material.is_one_sided();
        if is_back && hides_back && !(facet.is_closed && self.scene.may_be_inside(object, self.view.eye)) {
            return;
        }
        // Whether the color is found pixel by pixel.
        let is_textured =
            self.scene.is_tinted(object) || !matches!(material.color, PreparedTexture::Solid(_));
        let mut corners = self.lit;
        for ((room, point), shading_normal) in corners.iter_mut().zip(facet.corners).zip(facet.normals) {
            let surface =
                Surface { point, normal, shading_normal, magnitude: point.magnitude(), part: facet.part };
            *room = Some(self.lit(object, &surface, material, is_textured));
        }
        self.lit = corners;
        let [Some(a), Some(b), Some(c)] = corners else { return };
        let normal = packed(normal);
        let seen = PreviewFacet {
            is_textured,
            object: object as u16,
            part: facet.part,
            normal,
            distance: unpacked::<R>(normal).dot(facet.corners[0]).to_f32(),
            ..PreviewFacet::BLANK
        };
        let polygon = clipped(&[a.corner, b.corner, c.corner], self.nearest);
        // A fan of triangles.
        if let [first, rest @ ..] = polygon.as_slice() {
            for pair in rest.windows(2) {
                if let [second, third] = pair {
                    self.keep([first, second, third], seen);
                }
            }
        }
    }

    /// The light of a corner.
    fn lit(
        &self,
        object: usize,
        surface: &Surface<R>,
        material: &PreparedMaterial<'_, R>,
        is_textured: bool,
    ) -> Lit<R> {
        let Surface { point, shading_normal: normal, part, .. } = *surface;
        let is_same = |lit: &&Lit<R>| {
            lit.object == object
                && (lit.part == part || material.maps.is_empty())
                && lit.point == point
                && lit.normal == normal
        };
        if let Some(lit) = self.lit.iter().flatten().find(is_same) {
            return *lit;
        }
        let (mut room, mapped) = (MapRoom::EMPTY, &mut None);
        let uv = |surface: &Surface<R>| self.scene.uv(object, surface);
        let material = if material.maps.is_empty() {
            material
        } else {
            mapped.insert(material.mapped(surface, uv, &mut room))
        };
        let (direction, t) = (point - self.view.eye).unit_and_length();
        let (ray, hit) = (Ray { origin: self.view.eye, direction }, Hit { t, object, surface: *surface });
        let color = match material.color {
            PreparedTexture::Solid(color) if !is_textured => color,
            _ => LinearRgb::even(R::ONE),
        };
        let UnshadowedLight { scattered, mirrored } = unshadowed(self.scene, &ray, (&hit, color), material);
        // Light that a texture does not color is gray, or part of the color where there is no texture.
        let light = if is_textured {
            Light { scattered, added: mirrored.r.larger(mirrored.g).larger(mirrored.b) }
        } else {
            Light { scattered: scattered + mirrored, added: R::ZERO }
        };
        Lit { object, part, point, normal, corner: self.view.corner(point, light) }
    }

    /// Keeps a triangle that covers the middle of a line.
    fn keep(&mut self, corners: [&Corner<R>; 3], seen: PreviewFacet) {
        let mut placed = corners.map(|corner| Placed::new(corner, self.nearest, self.size));
        sort(&mut placed);
        let facet = PreviewFacet {
            corners: placed.map(|corner| corner.at),
            lights: placed.map(|corner| corner.light),
            ..seen
        };
        let (first, end) = facet.lines();
        let Some(facet) = sloped(facet, &placed) else { return };
        if first >= end {
            return;
        }
        if let Some(room) = self.memory.get_mut(self.kept) {
            *room = facet;
        }
        self.kept = self.kept.saturating_add(1);
    }
}

/// A corner in the picture.
#[derive(Clone, Copy)]
struct Placed {
    /// The place in 16ths of a pixel.
    at: [u16; 2],
    /// The place in 16ths of a pixel, before it is rounded.
    exact: [f32; 2],
    /// In units of 2⁻³⁰ of that of the nearest depth.
    inverse_depth: f32,
    light: [u16; 4],
}

impl Placed {
    fn new<R: Real>(corner: &Corner<R>, nearest: R, (width, height): (u16, u16)) -> Self {
        let [x, y] = corner.place();
        // At most 65536 · 65520, which fits.
        let place = |share: u32, side: u16| share.saturating_mul(u32::from(side) << 4);
        let (x, y) = (place(x, width), place(y, height));
        let whole = (1u32 << 16) as f32;
        Self {
            at: [(x >> 16) as u16, (y >> 16) as u16],
            exact: [x as f32 / whole, y as f32 / whole],
            inverse_depth: (nearest / corner.depth).to_f32() * (1u32 << 30) as f32,
            light: corner.packed_light(),
        }
    }
}

/// From top to bottom, and from left to right on the same height.
fn sort([a, b, c]: &mut [Placed; 3]) {
    let in_order = |upper: &mut Placed, lower: &mut Placed| {
        if (lower.at[1], lower.at[0]) < (upper.at[1], upper.at[0]) {
            core::mem::swap(upper, lower);
        }
    };
    in_order(a, b);
    in_order(b, c);
    in_order(a, b);
}

/// The facet with the slopes of its inverse depth; `None` if it is seen from its edge.
///
/// Places are not rounded here: the depth of a floor far away would move with them.
fn sloped(facet: PreviewFacet, [a, b, c]: &[Placed; 3]) -> Option<PreviewFacet> {
    let from_a = |corner: &Placed| {
        let across = [corner.exact[0] - a.exact[0], corner.exact[1] - a.exact[1]];
        (across, corner.inverse_depth - a.inverse_depth)
    };
    let (([bx, by], to_b), ([cx, cy], to_c)) = (from_a(b), from_a(c));
    let area = bx * cy - by * cx;
    if area == 0.0 || is_flat(&facet) {
        return None;
    }
    // For each 16th of a pixel.
    let right = (to_b * cy - to_c * by) / area;
    let down = (to_c * bx - to_b * cx) / area;
    let rounded = [f32::from(a.at[0]) - a.exact[0], f32::from(a.at[1]) - a.exact[1]];
    let inverse_depth = (a.inverse_depth + right * rounded[0] + down * rounded[1]) as i32;
    // For each pixel, with as many digits as 30 bits hold. Steeper slopes are those of facets that are
    // narrower than a pixel.
    let (mut shift, mut scale) = (0, 16.0f32);
    let most = right.abs().larger(down.abs());
    while shift < 28 && most * scale < (1u32 << 28) as f32 {
        (shift, scale) = (shift + 1, scale + scale);
    }
    let whole = |slope: f32| (slope * scale) as i32;
    Some(PreviewFacet { inverse_depth, right: whole(right), down: whole(down), shift, ..facet })
}

/// Whether the rounded corners lie on a line.
fn is_flat(facet: &PreviewFacet) -> bool {
    let [[ax, ay], [bx, by], [cx, cy]] = facet.corners.map(|at| at.map(i64::from));
    (bx - ax) * (cy - ay) == (by - ay) * (cx - ax)
}
