//! Tests of coarse meshes with smooth normals: where shadows begin, and what mirrors show.

use std::path::Path;

use rayline::math::Fixed;
use rayline::shape::{Mesh, Shape, Sphere};
use rayline::{
    Background, Fault, Light, LinearRgb, Material, Object, PreparedScene, Real, Scene, Settings, Transfer,
    Vec3,
};
use rayline_tests::textbook::Textbook;
use rayline_tests::{Picture, assert_alike, core_picture};

use super::closed_forms::{CAMERA, DARK};

const SETTINGS: Settings = Settings { transfer: Transfer::Linear, ..Settings::new(160, 120) };
const SUN: [Light; 1] =
    [Light::Directional { direction: Vec3::new(1.0, -0.3, -0.1), color: LinearRgb::WHITE }];

/// The unit ball of 14 · 9 quadrilaterals, with the ball's normals.
fn globe() -> Mesh<'static> {
    const ACROSS: u16 = 14;
    const DOWN: u16 = 9;
    let angle = |part: u16, of: u16| f32::from(part) / f32::from(of) * std::f32::consts::PI;
    let point = |down: u16, across: u16| {
        let (latitude, longitude) = (angle(down, DOWN), angle(2 * across, ACROSS));
        let (sine, height) = latitude.sin_cos();
        Vec3::new(sine * longitude.cos(), height, -sine * longitude.sin())
    };
    let points: Vec<_> =
        (0..=DOWN).flat_map(|down| (0..ACROSS).map(move |across| point(down, across))).collect();
    let quads = (0..DOWN).flat_map(|down| (0..ACROSS).map(move |across| (down, across)));
    let triangles: Vec<_> = quads
        .flat_map(|(down, across)| {
            let at = |down: u16, across: u16| down * ACROSS + across % ACROSS;
            let [a, b] = [at(down, across), at(down, across + 1)];
            let [c, d] = [at(down + 1, across), at(down + 1, across + 1)];
            [[a, c, b], [b, c, d]]
        })
        .collect();
    let points: &[_] = points.leak();
    Mesh { normals: Some(points), ..Mesh::new(points, triangles.leak()) }
}

/// Lends a scene of one shape to `look`.
fn with_scene<T>(shape: Shape<'_>, material: Material, look: impl FnOnce(&Scene) -> T) -> T {
    let background = Background::gray(0.5);
    let (objects, materials) = ([Object::new(shape, 0)], [material]);
    look(&Scene {
        camera: CAMERA,
        background,
        objects: &objects,
        materials: &materials,
        lights: &SUN,
        motions: &[],
    })
}

/// On a ball that is lit from the side, how many pixels that face the sun by more than 6 degrees are dark.
fn dark_in_sunlight(mesh: Mesh<'_>, picture: impl Fn(&Scene) -> Picture) -> usize {
    let matte = Material { ambient: 0.1, diffuse: 0.8, ..Material::matte(LinearRgb::WHITE) };
    let ball = with_scene(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0)), matte, &picture);
    let mesh = with_scene(Shape::Mesh(mesh), matte, &picture);
    let sunlit = |[level, ..]: [u8; 3]| (48..=127).contains(&level) || level > 129;
    let dark = |[level, ..]: [u8; 3]| level <= 27;
    ball.pixels.into_iter().zip(mesh.pixels).filter(|(ball, mesh)| sunlit(*ball) && dark(*mesh)).count()
}

#[test]
fn a_smooth_terminator_has_no_steps() {
    let (faceted, smooth) = (globe(), Mesh { smooth_terminator: true, ..globe() });
    let found = |mesh| {
        [
            dark_in_sunlight(mesh, |scene| core_picture::<f32>(scene, SETTINGS)),
            dark_in_sunlight(mesh, |scene| core_picture::<f64>(scene, SETTINGS)),
            dark_in_sunlight(mesh, |scene| core_picture::<Fixed>(scene, SETTINGS)),
        ]
    };
    let (steps, left) = (found(faceted), found(smooth));
    println!("dark pixels in sunlight: {steps:?} with facets, {left:?} with a smooth terminator");
    assert!(steps.iter().all(|count| *count > 90), "{steps:?}");
    assert!(left.iter().all(|count| *count < 10), "{left:?}");
}

#[test]
fn a_smooth_terminator_is_the_textbooks() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let matte = Material { ambient: 0.1, diffuse: 0.8, ..Material::matte(LinearRgb::WHITE) };
    for (name, smooth_terminator) in [("faceted", false), ("smooth", true)] {
        let mesh = Mesh { smooth_terminator, ..globe() };
        with_scene(Shape::Mesh(mesh), matte, |scene| {
            let textbook = Textbook::new(scene, SETTINGS).picture();
            assert_alike(
                directory,
                name,
                ("f32", &core_picture::<f32>(scene, SETTINGS)),
                ("textbook", &textbook),
            );
            let fixed = core_picture::<Fixed>(scene, SETTINGS);
            assert_alike(directory, name, ("fixed", &fixed), ("textbook", &textbook));
        });
    }
}

fn refusal<R: Real>(scene: &Scene) -> Option<Fault> {
    let mut memory = vec![std::mem::MaybeUninit::uninit(); scene.bytes::<R>()];
    PreparedScene::<R, _>::new(scene, &mut memory).err().map(|error| error.fault)
}

#[test]
fn glass_has_no_smooth_terminator() {
    let mesh = Mesh { smooth_terminator: true, ..globe() };
    let glass = Material { transmittance: 0.5, ..DARK };
    with_scene(Shape::Mesh(mesh), glass, |scene| {
        assert_eq!(refusal::<f32>(scene), Some(Fault::TerminatorOnGlass));
    });
    with_scene(Shape::Mesh(mesh), DARK, |scene| assert_eq!(refusal::<f32>(scene), None));
    with_scene(Shape::Mesh(globe()), glass, |scene| assert_eq!(refusal::<f32>(scene), None));
}

/// A convex mirror in an even surrounding shows the surrounding everywhere: no ray is mirrored into the body.
#[test]
fn a_convex_mirror_has_no_dark_rim() {
    let mirror = Material { reflectance: 0.8, ..DARK };
    with_scene(Shape::Mesh(globe()), mirror, |scene| {
        let pictures = [
            core_picture::<f32>(scene, SETTINGS),
            core_picture::<f64>(scene, SETTINGS),
            core_picture::<Fixed>(scene, SETTINGS),
            Textbook::new(scene, SETTINGS).picture(),
        ];
        for picture in pictures {
            let on_mirror = picture.pixels.iter().filter(|[level, ..]| level.abs_diff(102) <= 1).count();
            let around = picture.pixels.iter().filter(|[level, ..]| level.abs_diff(128) <= 1).count();
            assert_eq!(on_mirror + around, 160 * 120);
            assert!(on_mirror > 6_000, "{on_mirror}");
        }
    });
}
