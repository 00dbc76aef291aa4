//! Scenes of which exact pictures once changed with acceleration, one test for each cause; see
//! `scenes/acceleration`.

use std::mem::MaybeUninit;
use std::path::Path;

use bumpalo::Bump;
use embedded_graphics::pixelcolor::{PixelColor, raw::RawU32};
use rayline::math::Fixed;
use rayline::shape::{Instances, Mesh, Shape};
use rayline::{
    DisplayColor, Light16, Object, PreparedScene, Quantizer, Real, Renderer, Scene, Settings, Transfer,
};
use rayline_simulator::LoadedScene;

/// All digits of light, and what a display shows of it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen {
    light: [u32; 3],
    color: [u8; 3],
}

impl PixelColor for Seen {
    type Raw = RawU32;
}

impl DisplayColor for Seen {
    fn from_light(light: Light16, quantizer: &Quantizer) -> Self {
        let Light16 { r, g, b } = light;
        Self { light: [r, g, b], color: [r, g, b].map(|light| quantizer.level(light, 255)) }
    }
}

/// Bounces, rays per pixel and cutoff, after width and height.
const fn settings(width: u32, height: u32, bounces: u8, rays_per_pixel: u32, cutoff: f32) -> Settings {
    let plain = Settings::new(width, height);
    Settings { bounces, rays_per_pixel, cutoff, transfer: Transfer::Srgb, ..plain }
}

const EVERY_256TH: f32 = 1.0 / 256.0;

/// The picture, drawn at once and line by line.
fn pictures<R: Real>(scene: &PreparedScene<'_, R>, settings: Settings) -> [Vec<Seen>; 2] {
    let renderer = Renderer::new(scene, settings).unwrap();
    let blank = vec![Seen { light: [0; 3], color: [0; 3] }; (settings.width * settings.height) as usize];
    let (mut at_once, mut by_lines) = (blank.clone(), blank);
    renderer.lines(0, &mut at_once, &mut ()).unwrap();
    for (y, line) in by_lines.chunks_mut(settings.width as usize).enumerate() {
        renderer.line(y as u32, line).unwrap();
    }
    [at_once, by_lines]
}

/// The objects of a scene, with meshes and instances in pieces that are too small for boxes of their own.
fn in_pieces<'a>(objects: &[Object<Shape<'a>>]) -> Vec<Object<Shape<'a>>> {
    let pieces = |object: &Object<Shape<'a>>| -> Vec<Object<Shape<'a>>> {
        let like = |shape| Object { shape, ..*object };
        match object.shape {
            Shape::Mesh(mesh) => {
                let piece = |triangles| like(Shape::Mesh(Mesh { triangles, ..mesh }));
                mesh.triangles.chunks(4).map(piece).collect()
            }
            Shape::Instances(instances) => {
                let piece = |poses| like(Shape::Instances(Instances { poses, ..instances }));
                instances.poses.chunks(4).map(piece).collect()
            }
            _ => vec![*object],
        }
    };
    objects.iter().flat_map(pieces).collect()
}

/// Draws a scene with acceleration, without, and without boxes inside meshes and instances either: all are
/// the same. Then the pixel at x and y has the color that `f64` gives it.
fn assert_same<R: Real>(name: &str, settings: Settings, right: Option<((u32, u32), [u8; 3])>) {
    let arena = Bump::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/acceleration");
    let scene = LoadedScene::open(&folder.join(name), &arena).unwrap().scene;
    let draw = |scene: &Scene, is_fast: bool| {
        let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
        let prepared = PreparedScene::<R, _>::new(scene, &mut memory).unwrap();
        pictures(&if is_fast { prepared } else { prepared.without_acceleration() }, settings)
    };
    let [fast, fast_by_lines] = draw(&scene, true);
    let [slow, slow_by_lines] = draw(&scene, false);
    let objects = in_pieces(scene.objects);
    let [pieces, _] = draw(&Scene { objects: &objects, ..scene }, false);
    for (what, other) in [
        ("drawn by lines", &fast_by_lines),
        ("without acceleration", &slow),
        ("without acceleration, by lines", &slow_by_lines),
        ("in pieces", &pieces),
    ] {
        let place = fast.iter().zip(other).position(|(fast, other)| fast != other);
        let both = place.map(|place| (place, fast[place], other[place]));
        assert_eq!(both, None, "{name} {what}");
    }
    if let Some(((x, y), color)) = right {
        assert_eq!(fast[(y * settings.width + x) as usize].color, color, "{name}");
    }
}

/// Cylinders and cones were met far outside their bounds: those that are long and thin, or that a ray runs
/// almost along.
#[test]
fn a_cones_and_cylinders_seen_by_the_camera() {
    assert_same::<f32>(
        "a-f32-16x10-b2-r4096-c256.rayline",
        settings(16, 10, 2, 4096, EVERY_256TH),
        Some(((7, 5), [65, 114, 65])),
    );
    assert_same::<f32>(
        "a1-01-f32-8x12-b0-r512-c0.rayline",
        settings(8, 12, 0, 512, 0.0),
        Some(((3, 0), [79, 162, 225])),
    );
    assert_same::<Fixed>(
        "a1-06-fixed-20x11-b16-r1-c10.rayline",
        settings(20, 11, 16, 1, 0.1),
        Some(((19, 0), [124, 149, 173])),
    );
}

/// As before, where the hierarchy of the scene dropped what lies outside its boxes.
#[test]
fn a_cones_and_cylinders_in_boxes() {
    assert_same::<f32>("a2-01-f32-14x14-b16-r512-c0-lines.rayline", settings(14, 14, 16, 512, 0.0), None);
    assert_same::<Fixed>(
        "a2-09-fixed-11x9-b16-r64-c0.rayline",
        settings(11, 9, 16, 64, 0.0),
        Some(((5, 7), [79, 162, 225])),
    );
}

/// As before, where a shadow ray met what lies outside.
#[test]
fn a_cones_and_cylinders_before_lights() {
    assert_same::<f32>(
        "a3-01-f32-18x9-b2-r512-c0-lines.rayline",
        settings(18, 9, 2, 512, 0.0),
        Some(((10, 6), [53, 76, 115])),
    );
    assert_same::<Fixed>(
        "a3-07-fixed-9x11-b0-r4096-c256-lines.rayline",
        settings(9, 11, 0, 4096, EVERY_256TH),
        Some(((1, 7), [197, 197, 197])),
    );
}

/// Triangles that are huge and thin were met where only rounding put them.
#[test]
fn a_huge_thin_triangles() {
    assert_same::<f32>("a4-01-f32-9x7-b2-r512-c10.rayline", settings(9, 7, 2, 512, 0.1), None);
}

/// Instances of solids that are made of cones.
#[test]
fn a_instances_of_cones() {
    assert_same::<f32>("a5-01-f32-10x15-b16-r64-c10-lines.rayline", settings(10, 15, 16, 64, 0.1), None);
}

/// A light is within a ray offset of the plane of a flat blocker. Rays that begin beside their surface cross
/// the plane.
#[test]
fn b_lights_next_to_a_plane() {
    assert_same::<f32>("b-f32-24x7-b0-r7.rayline", settings(24, 7, 0, 7, 0.1), None);
    assert_same::<f32>("b-01-f32-7x10-b0-r7-c10-lines.rayline", settings(7, 10, 0, 7, 0.1), None);
    assert_same::<Fixed>(
        "b-14-fixed-20x8-b16-r64-c256-lines.rayline",
        settings(20, 8, 16, 64, EVERY_256TH),
        None,
    );
}

/// In fixed point the direction to a light pointed below the surface that the light is hardly above.
#[test]
fn c_surfaces_that_hardly_face_a_light() {
    assert_same::<Fixed>("c-fixed-13x12-b6-r64-c0.rayline", settings(13, 12, 6, 64, 0.0), None);
    assert_same::<Fixed>(
        "c-01-fixed-10x15-b1-r64-c10.rayline",
        settings(10, 15, 1, 64, 0.1),
        Some(((5, 4), [57, 54, 72])),
    );
}

/// In fixed point shadow rays ran past lights that are 8 units away and more.
#[test]
fn d_lights_that_are_far_but_not_at_the_end_of_the_world() {
    assert_same::<f32>("d-f32-24x10-b0.ron", settings(24, 10, 0, 4096, 0.1), None);
    assert_same::<Fixed>(
        "d-01-fixed-11x11-b2-r64-c10-lines.rayline",
        settings(11, 11, 2, 64, 0.1),
        Some(((2, 7), [244, 255, 212])),
    );
}

/// A part that is cut out of a long cone is met with the rounding of the whole cone. Rays that begin beside
/// it, by half a unit, cross a plane behind the light.
#[test]
fn f_parts_that_are_cut_out_of_something_large() {
    assert_same::<f32>("f-f32-14x9-b0.ron", settings(14, 9, 0, 4096, 0.0), None);
}

/// As a light next to a plane, with a ball: a receiver that is 1e5 away moves the beginning of its rays by a
/// unit.
#[test]
fn e_lights_next_to_a_ball() {
    assert_same::<f32>("e-f32-13x7-b16-r64.ron", settings(13, 7, 16, 64, EVERY_256TH), None);
    assert_same::<f32>(
        "e-01-f32-19x11-b0-r512-c256-lines.rayline",
        settings(19, 11, 0, 512, EVERY_256TH),
        None,
    );
}

/// A ray that glass refracts was no unit vector, and met the ball of radius 65,535 again that it left: rays
/// leave huge balls by a small part of their radius.
#[test]
fn g_rays_that_leave_a_huge_ball() {
    assert_same::<f32>("g-f32-3x3-b6-r4096-c0.rayline", settings(3, 3, 6, 4096, 0.0), None);
}
