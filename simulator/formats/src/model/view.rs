//! The default surroundings of models: a camera, a key light at its shoulder, and a sky.
//!
//! The camera sees the whole model. The sky goes from light above to dark below, in a bluish hue, so that a
//! model of one color meets it at one height at most, and models in shades of gray at none. A polished metal
//! mirrors it. Its light on the model is ambient light.

use bumpalo::Bump;
use rayline::math::Aabb;
use rayline::shape::{Mesh, Shape};
use rayline::{Background, Camera, Light, LinearRgb, Object, Sky, Vec3};

/// The note about the default light.
pub(crate) const LIT: &str = "lit from beside the camera and by a sky";

/// The view of a model that has no camera of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ModelView {
    /// The axis of the model that points up; `None`: y.
    pub up: Option<Up>,
    /// The direction from the model to the camera, as azimuth and elevation in degrees; `None`: slightly from
    /// the right and above. The azimuth is 0 in front of the model, 90 to its right as the camera sees it,
    /// and 180 behind. The elevation is 90 straight above.
    pub from: Option<(f32, f32)>,
}

/// The axis of a model that points up. The front of a model is on the side of +z if y is up, and on the side
/// of -y if z is up, as in programs for design; +x is to the right. The other axes are those that a quarter
/// or half turn about z brings up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Up {
    /// Up is +x.
    X,
    /// Up is +y.
    #[default]
    Y,
    /// Up is +z.
    Z,
    /// Up is -x.
    MinusX,
    /// Up is -y.
    MinusY,
    /// Up is -z.
    MinusZ,
}

/// The direction from the center of the model to the eye: right, up, and to the front.
const TOWARD_EYE: Vec3 = Vec3::new(0.45, 0.4, 1.0);

/// The vertical angle of view in radians. `TANGENT_OF_HALF` is the tangent of half of it.
const FOV: f32 = 0.6;
const TANGENT_OF_HALF: f32 = 0.309_336_25;
/// The margin around the model: the distance is 1.1 times that at which the model fills the picture.
const MARGIN: f32 = 1.1;
/// The width and height of the picture in pixels. `ASPECT` is width over height.
pub(crate) const SIZE: (u32, u32) = (640, 480);
const ASPECT: f32 = 4.0 / 3.0;

/// The colors of the sky: straight above, at the horizon, and straight below.
const ZENITH: LinearRgb = LinearRgb::new(0.62, 0.72, 0.85);
const HORIZON: LinearRgb = LinearRgb::new(0.22, 0.29, 0.4);
const NADIR: LinearRgb = LinearRgb::new(0.03, 0.04, 0.06);
/// The ambient light of the sky. Materials take a tenth of it: the shadows of a white model are as bright as
/// half of the sky's mean.
const AMBIENT: LinearRgb = LinearRgb::new(1.4, 1.7, 2.1);
/// The key light. Beside the ambient light, white stays below 1.
const KEY: LinearRgb = LinearRgb::new(0.82, 0.78, 0.72);
/// The direction to the key light: to the right, up, and backward, as the camera sees it.
const TOWARD_KEY: Vec3 = Vec3::new(-0.25, 0.4, 1.0);

/// The default lights: beside the camera, and the light of the sky.
pub(crate) fn lights(camera: &Camera) -> [Light; 2] {
    let unit = |vector: Vec3, otherwise| vector.normalized().unwrap_or(otherwise);
    let backward = unit(camera.eye - camera.target, Vec3::new(0.0, 0.0, 1.0));
    let right = unit(camera.up.cross(backward), Vec3::new(1.0, 0.0, 0.0));
    let upward = backward.cross(right);
    let toward = right * TOWARD_KEY.x + upward * TOWARD_KEY.y + backward * TOWARD_KEY.z;
    [Light::Directional { direction: -toward, color: KEY }, Light::Ambient { color: AMBIENT }]
}

/// The bounding box of all meshes; `None` if there are none.
pub(crate) fn bounds(objects: &[Object<Shape<'_>>]) -> Option<Aabb<f32>> {
    let corners = objects.iter().filter_map(|object| match object.shape {
        Shape::Mesh(Mesh { vertices, triangles, .. }) => Some((vertices, triangles)),
        _ => None,
    });
    let corners = corners.flat_map(|(vertices, triangles)| {
        triangles.as_flattened().iter().filter_map(|corner| vertices.get(usize::from(*corner)))
    });
    corners.map(|corner| Aabb::point(*corner)).reduce(Aabb::union)
}

impl Up {
    /// The directions to the right, up and to the front of a model.
    fn frame(self) -> [Vec3; 3] {
        let [x, y, z] = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)];
        match self {
            Self::X => [-y, x, z],
            Self::Y => [x, y, z],
            Self::Z => [x, z, -y],
            Self::MinusX => [y, -x, z],
            Self::MinusY => [-x, -y, z],
            Self::MinusZ => [x, -z, y],
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
            Self::MinusX => "-x",
            Self::MinusY => "-y",
            Self::MinusZ => "-z",
        }
    }
}

impl ModelView {
    /// The note about the default camera.
    pub(crate) fn note(&self) -> String {
        let up = self.up.unwrap_or_default().name();
        let from = match self.from {
            None => "the front, slightly from the right and above".to_owned(),
            Some((azimuth, elevation)) => format!("azimuth {azimuth}°, elevation {elevation}°"),
        };
        format!("the whole model is seen from {from} ({up} is up; see --up and --from)")
    }

    /// The sky.
    pub(crate) fn background<'a>(&self, arena: &'a Bump) -> Background<'a> {
        let [_, up, _] = self.up.unwrap_or_default().frame();
        Background::Gradient(arena.alloc(Sky { up, zenith: ZENITH, horizon: HORIZON, nadir: NADIR }))
    }

    /// A camera that sees the whole bounding box.
    pub(crate) fn camera(&self, bounds: Aabb<f32>) -> Camera {
        let target = bounds.center();
        let [rightward, axis, front] = self.up.unwrap_or_default().frame();
        let (across, high, near) = match self.from {
            None => (TOWARD_EYE.x, TOWARD_EYE.y, TOWARD_EYE.z),
            Some((azimuth, elevation)) => {
                let ((sine, cosine), (high, level)) =
                    (azimuth.to_radians().sin_cos(), elevation.to_radians().sin_cos());
                (sine * level, high, cosine * level)
            }
        };
        let toward = rightward * across + axis * high + front * near;
        let backward = toward * toward.length().recip();
        // Straight from above or below, the front of the model is down or up in the picture.
        let is_steep = axis.cross(backward).length() < 1e-2;
        let up = if is_steep { self.level_direction() * -high.signum() } else { axis };
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

    /// The direction of the azimuth from the center of the model, at the height of the center.
    fn level_direction(&self) -> Vec3 {
        let [rightward, _, front] = self.up.unwrap_or_default().frame();
        let (sine, cosine) = self.from.map_or(0.0, |(azimuth, _)| azimuth).to_radians().sin_cos();
        rightward * sine + front * cosine
    }
}
