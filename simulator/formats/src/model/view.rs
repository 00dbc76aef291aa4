//! A default camera and light for models without them.

use rayline::math::Aabb;
use rayline::shape::{Instances, Mesh, Model, Shape};
use rayline::{Background, Camera, Light, LinearRgb, Object, Vec3};

use crate::space::{rotation, vector};

/// The note about the default camera.
pub(crate) const SEEN: &str =
    "the whole model is seen from the front, slightly from the right and above (y is up)";
/// The note about the default light.
pub(crate) const LIT: &str = "lit from the upper left";

/// The direction from the center of the model to the eye.
const TOWARD_EYE: Vec3 = Vec3::new(0.45, 0.4, 1.0);

/// The vertical angle of view in radians. `TANGENT_OF_HALF` is the tangent of half of it.
const FOV: f32 = 0.6;
const TANGENT_OF_HALF: f32 = 0.309_336_25;
/// The margin around the model: the distance is 1.1 times that at which the model fills the picture.
const MARGIN: f32 = 1.1;
/// The width and height of the picture in pixels. `ASPECT` is width over height.
pub(crate) const SIZE: (u32, u32) = (640, 480);
const ASPECT: f32 = 4.0 / 3.0;

/// The default light.
pub(crate) static LIGHTS: [Light; 1] =
    [Light::Directional { direction: Vec3::new(0.6, -1.0, -0.6), color: LinearRgb::gray(0.9) }];

/// The default light, as seen by any camera.
pub(crate) fn light(camera: &Camera) -> Light {
    let forward = camera.target - camera.eye;
    let right = forward.cross(camera.up);
    let upward = right.cross(forward);
    let unit = |vector: Vec3| vector * vector.length().recip();
    let direction = unit(right) * 0.6 - unit(upward) + unit(forward) * 0.6;
    Light::Directional { direction, color: LinearRgb::gray(0.9) }
}

/// The default background.
pub(crate) const BACKGROUND: Background<'static> = Background::gray(0.1);

/// The bounding box of all meshes and their instances; `None` if there are none.
pub(crate) fn bounds(objects: &[Object<Shape<'_>>]) -> Option<Aabb<f32>> {
    let all = objects.iter().filter_map(|object| match object.shape {
        Shape::Mesh(mesh) => bounds_of(&mesh, |vertex| vertex),
        Shape::Instances(Instances { model: Model::Mesh(mesh), size, poses }) => {
            let posed = poses.iter().filter_map(|pose| {
                let turn = rotation(pose.rotation) * f64::from(size);
                bounds_of(mesh, |vertex| {
                    let [x, y, z] = (turn * vector(vertex) + vector(pose.origin)).as_vec3().to_array();
                    Vec3::new(x, y, z)
                })
            });
            posed.reduce(Aabb::union)
        }
        _ => None,
    });
    all.reduce(Aabb::union)
}

/// The bounding box of the vertices that triangles use, each moved by `place`.
fn bounds_of(mesh: &Mesh<'_>, place: impl Fn(Vec3) -> Vec3) -> Option<Aabb<f32>> {
    let corners = mesh.triangles.as_flattened().iter();
    let corners = corners.filter_map(|corner| mesh.vertices.get(usize::from(*corner)));
    corners.map(|corner| Aabb::point(place(*corner))).reduce(Aabb::union)
}

/// A camera that sees the whole bounding box.
pub(crate) fn of(bounds: Aabb<f32>) -> Camera {
    let target = bounds.center();
    let up = Vec3::new(0.0, 1.0, 0.0);
    let backward = TOWARD_EYE * TOWARD_EYE.length().recip();
    let right = up.cross(backward);
    let right = right * right.length().recip();
    let upward = backward.cross(right);
    // The largest distance that any corner needs.
    let distance = bounds.corners().fold(0.0f32, |distance, corner| {
        let corner = corner - target;
        let across = corner.dot(upward).abs().max(corner.dot(right).abs() / ASPECT);
        distance.max(across * MARGIN / TANGENT_OF_HALF + corner.dot(backward))
    });
    Camera { eye: target + backward * distance, target, up, vertical_fov: FOV, lens: None }
}
