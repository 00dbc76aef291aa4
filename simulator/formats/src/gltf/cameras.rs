//! Cameras (glTF 2.0 Specification, section 3.10).

use rayline::math::Aabb;
use rayline::{Camera, Vec3};

use super::error::{At, GltfFault, Wrong, find, name};
use super::json::{Perspective, Root};
use super::nodes::Placed;
use crate::model::view;
use crate::notes::Notes;

/// A camera, the size of its picture in pixels, and its name.
pub(super) type Named = (Camera, (u32, u32), String);

/// The first perspective camera of the scene; `None` if there is none.
pub(super) fn first(
    root: &Root,
    nodes: &[Placed<'_>],
    bounds: Aabb<f32>,
    notes: &mut Notes,
) -> Result<Option<Named>, Wrong> {
    let mut first = None;
    for placed in nodes {
        let Some(index) = placed.node.camera else { continue };
        let camera = find(&root.cameras, "camera", index).at(|| placed.name())?;
        let called = format!("{}, {}", placed.name(), name("camera", index, camera.name.as_ref()));
        let Some(perspective) = &camera.perspective else {
            notes.add(called, "left out: it is not perspective");
            continue;
        };
        if first.is_some() {
            notes.add(called, "left out, as only the first camera is used");
            continue;
        }
        let camera = described(placed, perspective, bounds).at(|| called.clone())?;
        first = Some((camera, size(perspective.aspect_ratio), called));
    }
    Ok(first)
}

fn described(placed: &Placed<'_>, perspective: &Perspective, bounds: Aabb<f32>) -> Result<Camera, GltfFault> {
    let nothing = || GltfFault::Number { meaning: "the length of its direction", found: 0.0 };
    let eye = placed.place.point([0.0; 3]);
    let forward = placed.place.direction([0.0, 0.0, -1.0]).ok_or_else(nothing)?;
    let up = placed.place.direction([0.0, 1.0, 0.0]).ok_or_else(nothing)?;
    Ok(Camera {
        eye,
        target: eye + forward * depth(eye, forward, bounds),
        up,
        vertical_fov: perspective.yfov,
        lens: None,
    })
}

/// The distance along the line of sight to the point nearest to the middle of the scene; 1 if that point is
/// behind the camera.
fn depth(eye: Vec3, forward: Vec3, bounds: Aabb<f32>) -> f32 {
    let depth = (bounds.center() - eye).dot(forward);
    if depth > 1e-3 { depth } else { 1.0 }
}

/// The size of a picture with this aspect ratio, width over height.
fn size(aspect: Option<f32>) -> (u32, u32) {
    let (width, height) = view::SIZE;
    match aspect {
        Some(aspect) if (0.1..=10.0).contains(&aspect) => ((height as f32 * aspect).round() as u32, height),
        _ => (width, height),
    }
}
