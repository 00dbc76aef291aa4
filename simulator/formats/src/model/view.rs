//! The default surroundings of models: a camera, a key light at its shoulder, and a sky.
//!
//! The camera sees the whole model. The sky goes from light above to dark below, in a bluish hue, so that a
//! model of one color meets it at one height at most, and models in shades of gray at none. A polished metal
//! mirrors it. Its light on the model is ambient light.

use bumpalo::Bump;
use rayline::math::Aabb;
use rayline::shape::{Instances, Mesh, Model, Shape};
use rayline::{Background, Camera, Light, LinearRgb, Object, Sky, Vec3};

use crate::space::{rotation, vector};

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
const ZENITH: LinearRgb = LinearRgb::new(0.5, 0.57, 0.66);
const HORIZON: LinearRgb = LinearRgb::new(0.23, 0.28, 0.35);
const NADIR: LinearRgb = LinearRgb::new(0.028, 0.038, 0.052);
/// The ambient light, of which materials take a tenth: the shadows of a white model are as bright as half of
/// the sky's mean. It has no hue, so that a gray model in shadow is never as bluish as the sky.
const AMBIENT: LinearRgb = LinearRgb::gray(1.7);
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

#[cfg(test)]
#[allow(clippy::indexing_slicing)]
mod tests {
    use core::mem::MaybeUninit;

    use rayline::math::Aabb;
    use rayline::shape::{Cuboid, Pose, Sphere};
    use rayline::{Fresnel, Material, Optics, PreparedScene, Renderer, Scene, Settings};

    use super::*;
    use crate::srgb::code;

    const SIDES: [(f32, f32); 8] = [
        (24.0, 20.0),
        (0.0, 0.0),
        (90.0, -30.0),
        (200.0, 10.0),
        (-60.0, 45.0),
        (0.0, 90.0),
        (0.0, -90.0),
        (45.0, -5.0),
    ];

    /// The codes of a picture of 48 by 36 pixels.
    fn picture(scene: &Scene<'_>) -> Vec<[u8; 3]> {
        let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
        let prepared = PreparedScene::<f32, _>::new(scene, &mut memory).unwrap();
        let renderer = Renderer::new(&prepared, Settings::new(48, 36)).unwrap();
        let light = |x, y| renderer.pixel(x, y, &mut ()).0;
        (0..36).flat_map(|y| (0..48).map(move |x| light(x, y).channels().map(code))).collect()
    }

    /// The colors on both sides of the outline of an object, and the brightest color on it.
    fn outline(shape: Shape<'static>, material: Material<'_>, lights: Option<&[Light]>) -> [Vec<i32>; 2] {
        let (arena, [mut differences, mut brightest]) = (Bump::new(), [const { Vec::new() }; 2]);
        for (from, up) in SIDES.into_iter().zip([Up::Y, Up::Z].into_iter().cycle()) {
            let view = ModelView { up: Some(up), from: Some(from) };
            let half = Vec3::new(1.0, 1.0, 1.0);
            let camera = view.camera(Aabb { min: -half, max: half });
            let default = super::lights(&camera);
            let (objects, materials) = ([Object::new(shape, 0)], [material]);
            let background = view.background(&arena);
            let lights = lights.unwrap_or(&default);
            let scene =
                Scene { camera, background, objects: &objects, materials: &materials, lights, motions: &[] };
            let with = picture(&scene);
            let is_there: Vec<bool> = {
                let glow = Optics { emission: LinearRgb::WHITE, ..Optics::PLAIN };
                let glowing = [Material { optics: Some(&glow), ..Material::matte(LinearRgb::WHITE) }];
                let seen = picture(&Scene { materials: &glowing, ..scene });
                seen.iter().map(|pixel| *pixel == [255; 3]).collect()
            };
            let beside = |at: usize| [at + 1, at + 48].into_iter().filter(|next| *next < with.len());
            for (at, next) in (0..with.len()).flat_map(|at| beside(at).map(move |next| (at, next))) {
                if is_there[at] != is_there[next] {
                    let pairs = with[at].iter().zip(with[next]);
                    let difference = pairs.map(|(a, b)| i32::from(a.abs_diff(b))).max();
                    differences.push(difference.unwrap());
                }
            }
            let codes = with.iter().zip(&is_there).filter(|(_, is_there)| **is_there).map(|(pixel, _)| pixel);
            brightest.push(codes.flatten().copied().max().map(i32::from).unwrap());
        }
        differences.sort_unstable();
        [differences, brightest]
    }

    fn cube() -> Shape<'static> {
        Shape::Cuboid(Cuboid::aligned(Vec3::new(-1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, 1.0)))
    }

    /// A gray model differs from the sky beside it by at least 6 of 255 codes, and by far more almost
    /// everywhere; and white is not too bright.
    #[test]
    fn no_gray_model_blends_into_the_sky() {
        for gray in [0.0, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 1.0] {
            let material = Material { ambient: 0.1, ..Material::matte(LinearRgb::gray(gray)) };
            for shape in [cube(), Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0))] {
                let [differences, brightest] = outline(shape, material, None);
                let median = differences[differences.len() / 2];
                assert!(differences[0] >= 6 && median >= 20, "{gray}: {} {median}", differences[0]);
                if gray == 1.0 {
                    assert!(brightest.iter().all(|code| (220..255).contains(code)), "{brightest:?}");
                }
            }
        }
    }

    /// With nothing but a light from behind, as in a scene of its own lights.
    #[test]
    fn a_white_model_without_light_is_seen() {
        let dark = [Light::Point { position: Vec3::ZERO, color: LinearRgb::gray(0.0) }];
        let material = Material { ambient: 0.1, ..Material::matte(LinearRgb::WHITE) };
        let [differences, _] = outline(cube(), material, Some(&dark));
        assert!(differences[0] >= 6, "{}", differences[0]);
    }

    #[test]
    fn instances_are_turned_and_moved_in_the_bounds() {
        let vertices = [(0.0, 0.0), (15.0, 0.0), (0.0, 15.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
        let mesh = Mesh::new(&vertices, &[[0, 1, 2]]);
        let turn = Vec3::new(0.0, 0.0, core::f32::consts::FRAC_PI_2);
        let poses = [Pose::at(Vec3::ZERO), Pose { rotation: turn, ..Pose::at(Vec3::new(100.0, 0.0, 5.0)) }];
        let model = Model::Mesh(mesh);
        let instances = Shape::Instances(Instances::new(&model, &poses).sized(2.0));
        let bounds = bounds(&[Object::new(instances, 0)]).unwrap();
        assert!((bounds.min - Vec3::ZERO).length() < 1e-4, "{bounds:?}");
        assert!((bounds.max - Vec3::new(100.0, 30.0, 5.0)).length() < 1e-4, "{bounds:?}");
    }

    /// A ball of gold mirrors light from above and dark from below.
    #[test]
    fn metals_have_something_to_mirror() {
        let gold = LinearRgb::new(1.0, 0.77, 0.34);
        let optics = Optics { fresnel: Fresnel::Schlick, reflection_color: gold, ..Optics::PLAIN };
        let mirror =
            Material { diffuse: 0.0, reflectance: 1.0, optics: Some(&optics), ..Material::matte(gold) };
        let [differences, brightest] = outline(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0)), mirror, None);
        assert!(differences[differences.len() / 2] >= 8, "{}", differences[differences.len() / 2]);
        assert!(brightest.iter().all(|code| *code >= 120), "{brightest:?}");
    }
}
