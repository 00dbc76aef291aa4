//! Statistics of a picture, for programs to read.

use core::time::Duration;

use rayline::shape::Shape;
use rayline::{RayCounts, Scene};
use serde::Serialize;

use crate::Picture;

/// The statistics of a picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stats {
    /// The numbers of rays that were traced.
    pub rays: Rays,
    /// The numbers of rays that hit an object.
    pub hits: Hits,
    /// The numbers of rays and lights that were left out.
    pub cuts: Cuts,
    /// The time from the description of the scene to the finished picture, in seconds.
    pub seconds: f64,
    /// The size of the scene's description, about what it takes in a board's flash, in bytes.
    pub scene_bytes: usize,
    /// The memory that was lent for the prepared scene, about what it takes in a board's RAM, in bytes.
    pub prepared_bytes: usize,
}

/// The numbers of rays by kind.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Rays {
    /// Rays from the eye.
    pub camera: u64,
    /// Rays toward lights.
    pub shadow: u64,
    /// Mirrored rays.
    pub reflected: u64,
    /// Rays through transparent surfaces.
    pub refracted: u64,
    /// Scattered rays, of path tracing.
    pub scattered: u64,
}

/// The numbers of rays that hit an object.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Hits {
    /// Camera rays that hit an object.
    pub camera: u64,
}

/// How many times light was left out, by reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Cuts {
    /// The limit of bounces.
    pub bounces: u64,
    /// The cut-off of small shares.
    pub throughput: u64,
    /// The limit of rays per pixel.
    pub rays: u64,
    /// The limit of transparent surfaces in front of a light.
    pub shadow_layers: u64,
}

impl Stats {
    /// The statistics of this picture of the scene.
    pub fn new(scene: &Scene<'_>, picture: &Picture, time: Duration) -> Self {
        let RayCounts {
            camera,
            shadow,
            reflected,
            refracted,
            scattered,
            camera_hits,
            cut_bounces,
            cut_throughput,
            cut_rays,
            cut_shadow_layers,
        } = picture.rays;
        Self {
            rays: Rays { camera, shadow, reflected, refracted, scattered },
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

/// The size of a description in bytes, with vertices and planes that it refers to.
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
