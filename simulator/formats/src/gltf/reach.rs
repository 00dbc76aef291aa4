//! The bounds of a scene before it is read: scenes that lie or reach too far are moved.

use std::collections::HashMap;

use glam::DVec3;

use super::accessor::Lists;
use super::json::Mesh;
use super::nodes::Placed;
use super::skins::{self, Places, Skins};
use crate::model::Moved;

/// The change that brings everything that these nodes show into the limits of a scene. Parts that cannot be
/// read count for nothing: reading them gives an error or a note.
pub(super) fn moved(lists: Lists<'_>, nodes: &[Placed<'_>]) -> Moved {
    let mut points = Vec::new();
    let (mut boxes, mut skins) = (HashMap::new(), Skins::default());
    let mut has_camera = false;
    for placed in nodes {
        let is_view = |camera: &usize| {
            lists.root.cameras.get(*camera).is_some_and(|camera| camera.perspective.is_some())
        };
        let shows = placed.node.camera.as_ref().is_some_and(is_view);
        has_camera |= shows;
        if shows || placed.node.extensions.light.is_some() {
            points.push(placed.place.exact([0.0; 3]));
        }
        let Some(index) = placed.node.mesh.filter(|_| !placed.is_hidden) else { continue };
        let Some(mesh) = lists.root.meshes.get(index) else { continue };
        if placed.node.skin.is_some() {
            points.extend(skinned(lists, placed, mesh, &mut skins).into_iter().flatten());
            continue;
        }
        let weights = skins::weights(placed.node, mesh);
        let key = (index, weights.iter().map(|weight| weight.to_bits()).collect::<Vec<_>>());
        let corners = boxes.entry(key).or_insert_with(|| corners(&positions(lists, mesh, weights)));
        points.extend(corners.iter().map(|corner| placed.place.exact(*corner)));
    }
    points.retain(|point| point.is_finite());
    Moved::of(points.into_iter(), has_camera)
}

/// The positions of a mesh in its own coordinates.
fn positions(lists: Lists<'_>, mesh: &Mesh, weights: &[f32]) -> Vec<[f32; 3]> {
    let of_primitive = |primitive| {
        let mut positions = skins::positions(lists, primitive)?;
        let _ = skins::morph(lists, (primitive, weights), "POSITION", &mut positions);
        Some(positions)
    };
    mesh.primitives.iter().filter_map(of_primitive).flatten().collect()
}

/// The corners of the box around points; none without points.
fn corners(points: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let Some(first) = points.first() else { return Vec::new() };
    let (mut low, mut high) = (*first, *first);
    for point in points {
        for ((low, high), at) in low.iter_mut().zip(&mut high).zip(point) {
            (*low, *high) = (low.min(*at), high.max(*at));
        }
    }
    let ([x, y, z], [right, top, front]) = (low, high);
    let mut corners = Vec::new();
    for x in [x, right] {
        for y in [y, top] {
            corners.extend([[x, y, z], [x, y, front]]);
        }
    }
    corners
}

/// The vertices of a mesh with a skin, in the scene.
fn skinned(lists: Lists<'_>, placed: &Placed<'_>, mesh: &Mesh, skins: &mut Skins) -> Option<Vec<DVec3>> {
    let joints = skins.joints(lists, placed.node.skin?).ok()?;
    let weights = skins::weights(placed.node, mesh);
    let mut vertices = Vec::new();
    for primitive in &mesh.primitives {
        let Some(mut positions) = skins::positions(lists, primitive) else { continue };
        let _ = skins::morph(lists, (primitive, weights), "POSITION", &mut positions);
        let places = Places::skinned(lists, primitive, &joints, placed.place);
        let places = places.unwrap_or(Places::One(placed.place));
        vertices.extend(positions.iter().enumerate().map(|(index, at)| places.of(index).exact(*at)));
    }
    Some(vertices)
}
