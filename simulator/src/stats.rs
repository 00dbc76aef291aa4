//! What a picture took, for programs to read.

use core::time::Duration;

use rayline::shape::Shape;
use rayline::{RayCounts, Scene};
use serde::Serialize;

use crate::Picture;

/// What a picture took.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stats {
    /// Rays that were traced.
    pub rays: Rays,
    /// What they met.
    pub hits: Hits,
    /// What was cut short.
    pub cuts: Cuts,
    /// Time from the scene's description to the finished picture.
    pub seconds: f64,
    /// Bytes of the scene's description: what it takes of a board's flash.
    pub scene_bytes: usize,
    /// Bytes of memory that the prepared scene was lent: what it takes of a board's RAM.
    pub prepared_bytes: usize,
}

/// Rays by kind.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Rays {
    /// From the eye.
    pub camera: u64,
    /// Toward lights.
    pub shadow: u64,
    /// Mirrored.
    pub reflected: u64,
    /// Through transparent surfaces.
    pub refracted: u64,
}

/// Rays that met an object.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Hits {
    /// Of those from the eye.
    pub camera: u64,
}

/// How often light was left out, by reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Cuts {
    /// The bound on bounces.
    pub bounces: u64,
    /// The cut-off of small shares.
    pub throughput: u64,
    /// The bound on rays per pixel.
    pub rays: u64,
    /// The bound on transparent surfaces before a light.
    pub shadow_layers: u64,
}

impl Stats {
    /// What this picture of that scene took.
    pub fn new(scene: &Scene<'_>, picture: &Picture, time: Duration) -> Self {
        let RayCounts {
            camera,
            shadow,
            reflected,
            refracted,
            camera_hits,
            cut_bounces,
            cut_throughput,
            cut_rays,
            cut_shadow_layers,
        } = picture.rays;
        Self {
            rays: Rays { camera, shadow, reflected, refracted },
            hits: Hits { camera: camera_hits },
            cuts: Cuts {
                bounces: cut_bounces,
                throughput: cut_throughput,
                rays: cut_rays,
                shadow_layers: cut_shadow_layers,
            },
            seconds: time.as_secs_f64(),
            scene_bytes: scene_bytes(scene),
            prepared_bytes: picture.prepared_bytes,
        }
    }
}

/// Bytes of a description, with all that it refers to.
fn scene_bytes(scene: &Scene<'_>) -> usize {
    let outlines = scene.objects.iter().map(|object| match object.shape {
        Shape::Polygon(polygon) => size_of_val(polygon.vertices),
        Shape::ConvexPolyhedron(polyhedron) => size_of_val(polyhedron.planes),
        _ => 0,
    });
    size_of_val(scene)
        + size_of_val(scene.objects)
        + size_of_val(scene.materials)
        + size_of_val(scene.lights)
        + outlines.sum::<usize>()
}
