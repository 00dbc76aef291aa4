//! Tests of colored glass and metal, Fresnel terms, absorption and lamps, against results that can be
//! computed by hand and against the textbook renderer.

use std::mem::MaybeUninit;
use std::path::Path;

use rayline::math::Fixed;
use rayline::shape::{Mesh, Plane, Shape, Sphere};
use rayline::{
    Background, Camera, Falloff, Fault, Fresnel, Highlight, Lamp, Light, LightCone, LinearRgb, Map, Material,
    Object, Onto, Optics, PreparedScene, Real, Renderer, Scene, Settings, Sides, Texture, Transfer, Vec3,
};
use rayline_tests::textbook::Textbook;
use rayline_tests::{assert_alike, core_picture};

use super::closed_forms::{CAMERA, DARK, wall};

/// A material that emits light.
const LAMP: Material = Material { optics: Some(&Optics { emission: WARM, ..Optics::PLAIN }), ..DARK };
const WARM: LinearRgb = LinearRgb::new(0.8, 0.6, 0.4);
const DARKNESS: LinearRgb = LinearRgb::gray(0.0);

fn ball(z: f32, radius: f32, material: u16) -> Object<Shape<'static>> {
    Object::new(Shape::Sphere(Sphere::new(Vec3::new(0.0, 0.0, z), radius)), material)
}

fn look<R: Real>(scene: &Scene) -> [f64; 3] {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R, _>::new(scene, &mut memory).expect("a legal scene");
    let settings = Settings { cutoff: 0.0, bounces: 8, ..Settings::new(1, 1) };
    let (light, _) = Renderer::new(&prepared, settings).unwrap().pixel(0, 0, &mut ());
    let light = light.to_f32();
    [light.r, light.g, light.b].map(f64::from)
}

/// Asserts the light that the camera sees straight ahead, in every number system.
#[track_caller]
fn assert_sees(
    objects: &[Object<Shape<'static>>],
    materials: &[Material],
    lights: &[Light],
    expected: [f64; 3],
) {
    let background = Background::gray(0.5);
    let scene = Scene { camera: CAMERA, background, objects, materials, lights, motions: &[] };
    for (light, bound) in
        [(look::<f32>(&scene), 2e-5), (look::<f64>(&scene), 2e-5), (look::<Fixed>(&scene), 2e-3)]
    {
        let close = light.iter().zip(expected).all(|(light, expected)| (light - expected).abs() < bound);
        assert!(close, "{light:?}, not {expected:?}");
    }
}

#[test]
fn emission_is_seen_without_lights() {
    assert_sees(&[ball(0.0, 1.0, 0)], &[LAMP], &[], [0.8, 0.6, 0.4]);
}

#[test]
fn metal_colors_what_it_mirrors_and_its_highlight() {
    let gold = Optics { reflection_color: LinearRgb::new(1.0, 0.75, 0.25), ..Optics::PLAIN };
    let mirror = Material { reflectance: 0.8, optics: Some(&gold), ..DARK };
    assert_sees(&[wall(0.0, 0.0, 0)], &[mirror], &[], [0.4, 0.3, 0.1]);
    let shiny = Material { specular: 0.5, shininess: 10.0, optics: Some(&gold), ..DARK };
    let light = Light::Point { position: Vec3::new(0.0, 0.0, 9.0), color: LinearRgb::WHITE };
    assert_sees(&[wall(0.0, 0.0, 0)], &[shiny], &[light], [0.5, 0.375, 0.125]);
}

#[test]
fn colored_glass_colors_what_is_behind_and_the_light_that_comes_through() {
    let green = Optics { transmission_color: LinearRgb::new(0.5, 1.0, 0.25), ..Optics::PLAIN };
    let pane = Material { transmittance: 0.8, optics: Some(&green), ..DARK };
    assert_sees(&[wall(0.0, 0.0, 0)], &[pane], &[], [0.2, 0.4, 0.1]);
    // The pane is behind the eye and the light behind the pane, so that the wall is lit through it.
    let light = Light::Point { position: Vec3::new(0.0, 0.0, 9.0), color: LinearRgb::WHITE };
    let wall_and_pane = [wall(0.0, 0.0, 1), wall(7.0, 0.0, 0)];
    let matte = Material::matte(LinearRgb::WHITE);
    assert_sees(&wall_and_pane, &[pane, matte], &[light], [0.4, 0.8, 0.2]);
}

#[test]
fn light_is_absorbed_on_its_way_through_glass() {
    // A ball of radius 1 without refraction: light passes 2 units of glass.
    let amber = Optics { absorption: LinearRgb::new(0.1, 0.5, 2.0), ..Optics::PLAIN };
    let glass = Material { transmittance: 1.0, optics: Some(&amber), ..DARK };
    let left = [0.1f64, 0.5, 2.0].map(|coefficient| (-2.0 * coefficient).exp());
    assert_sees(&[ball(0.0, 1.0, 0)], &[glass], &[], left.map(|left| 0.5 * left));
    // The light of a lamp is absorbed in the same way.
    let light = Light::Point { position: Vec3::new(0.0, 0.0, 9.0), color: LinearRgb::WHITE };
    let matte = Material::matte(LinearRgb::WHITE);
    assert_sees(&[wall(0.0, 0.0, 1), ball(7.0, 1.0, 0)], &[glass, matte], &[light], left);
    // Behind an infinite surface no light is left.
    assert_sees(&[wall(0.0, 0.0, 0)], &[glass], &[], [0.0; 3]);
}

/// A wall at the place of the eye's target that shows its back.
fn back(z: f32, material: u16) -> Object<Shape<'static>> {
    let plane = Plane::new(Vec3::new(0.0, 0.0, z), Vec3::new(0.0, 0.0, -1.0));
    Object::new(Shape::Plane(plane), material)
}

#[test]
fn backs_of_one_sided_surfaces_are_not_seen_and_throw_shadows() {
    let optics = Optics { emission: WARM, sides: Sides::Front, ..Optics::PLAIN };
    let sheet = Material { optics: Some(&optics), ..DARK };
    assert_sees(&[wall(0.0, 0.0, 0)], &[sheet], &[], [0.8, 0.6, 0.4]);
    assert_sees(&[back(0.0, 0)], &[sheet], &[], [0.5; 3]);
    // Behind several backs, the ball's front is seen.
    let behind = [back(2.0, 0), ball(-3.0, 1.0, 0), back(0.0, 0)];
    assert_sees(&behind, &[sheet], &[], [0.8, 0.6, 0.4]);
    // From inside, a ball has no surface.
    assert_sees(&[ball(5.0, 3.0, 0)], &[sheet], &[], [0.5; 3]);
    // A mirrored ray passes backs, too: the camera stands in front of a mirror.
    let mirror = Material { reflectance: 1.0, ..DARK };
    assert_sees(&[wall(0.0, 0.0, 1), wall(9.0, 0.0, 0)], &[sheet, mirror], &[], [0.5; 3]);
    assert_sees(&[wall(0.0, 0.0, 1), back(9.0, 0)], &[sheet, mirror], &[], [0.8, 0.6, 0.4]);
    // Of two triangles at one place, the front is seen, from either side.
    const CORNERS: [Vec3; 3] =
        [Vec3::new(-2.0, -2.0, 0.0), Vec3::new(2.0, -2.0, 0.0), Vec3::new(0.0, 2.0, 0.0)];
    const BOTH: [[u16; 3]; 2] = [[0, 2, 1], [0, 1, 2]];
    for triangles in [&BOTH[..], &BOTH[1..]] {
        let mesh = Mesh::new(&CORNERS, triangles);
        assert_sees(&[Object::new(Shape::Mesh(mesh), 0)], &[sheet], &[], [0.8, 0.6, 0.4]);
    }
    let mesh = Mesh::new(&CORNERS, &BOTH[..1]);
    assert_sees(&[Object::new(Shape::Mesh(mesh), 0)], &[sheet], &[], [0.5; 3]);
    // Glass needs its backs.
    let glass = Material { transmittance: 0.5, ..sheet };
    let (camera, background) = (CAMERA, Background::gray(0.5));
    let objects = [wall(0.0, 0.0, 0)];
    let scene =
        Scene { camera, background, objects: &objects, materials: &[glass], lights: &[], motions: &[] };
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
    let error = PreparedScene::<f32, _>::new(&scene, &mut memory).unwrap_err();
    assert_eq!(error.fault, Fault::OneSidedGlass);
    // Both sides throw shadows.
    let light = Light::Point { position: Vec3::new(0.0, 0.0, 9.0), color: LinearRgb::WHITE };
    let matte = Material::matte(LinearRgb::WHITE);
    for sheet_behind in [wall(7.0, 0.0, 0), back(7.0, 0)] {
        assert_sees(&[wall(0.0, 0.0, 1), sheet_behind], &[sheet, matte], &[light], [0.0; 3]);
    }
}

#[test]
fn thin_sheets_do_not_bend_light() {
    let optics = Optics { thin: true, ..Optics::PLAIN };
    let pane = Material { transmittance: 0.9, ior: 1.5, optics: Some(&optics), ..DARK };
    // A small lamp straight ahead, behind a pane at 45 degrees.
    let objects = [wall(0.0, 45.0, 0), ball(-6.0, 0.1, 1)];
    assert_sees(&objects, &[pane, LAMP], &[], [0.72, 0.54, 0.36]);
    let bends = Material { optics: None, ..pane };
    assert_sees(&objects, &[bends, LAMP], &[], [0.45; 3]);
    // From behind, Fresnel's equations say the same as from the front.
    let optics = Optics { fresnel: Fresnel::Exact, ..optics };
    let pane = Material { transmittance: 1.0, ior: 1.5, optics: Some(&optics), ..DARK };
    for pane_at in [wall(0.0, 0.0, 0), back(0.0, 0)] {
        assert_sees(
            &[pane_at, ball(-6.0, 0.1, 1)],
            &[pane, LAMP],
            &[],
            WARM.channels().map(|channel| 0.96 * f64::from(channel) + 0.04 * 0.5),
        );
    }
    let absorbs = Optics { absorption: LinearRgb::gray(1.0), ..optics };
    let material = Material { optics: Some(&absorbs), ..pane };
    let scene = Scene {
        camera: CAMERA,
        background: Background::gray(0.5),
        objects: &[wall(0.0, 0.0, 0)],
        materials: &[material],
        lights: &[],
        motions: &[],
    };
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
    let error = PreparedScene::<f32, _>::new(&scene, &mut memory).unwrap_err();
    assert_eq!(error.fault, Fault::ThinAbsorbs);
}

#[test]
fn backs_of_coats_mirror_as_fronts() {
    let optics = Optics { fresnel: Fresnel::Exact, ..Optics::PLAIN };
    let coat = Material { reflectance: 1.0, ior: 1.5, optics: Some(&optics), ..DARK };
    for side in [wall(0.0, 0.0, 0), back(0.0, 0)] {
        assert_sees(&[side], &[coat], &[], [0.02; 3]);
    }
}

#[test]
fn textures_change_the_colors_of_optics() {
    let tint = |onto| Map { onto, texture: Texture::Solid(LinearRgb::new(0.5, 0.25, 1.0)) };
    let optics = Optics {
        reflection_color: LinearRgb::new(1.0, 0.8, 0.5),
        transmission_color: LinearRgb::new(0.5, 1.0, 0.5),
        emission: WARM,
        ..Optics::PLAIN
    };
    let maps = [tint(Onto::ReflectionColor)];
    let mirror = Material {
        reflectance: 1.0,
        optics: Some(&Optics { emission: DARKNESS, ..optics }),
        maps: &maps,
        ..DARK
    };
    assert_sees(&[wall(0.0, 0.0, 0)], &[mirror], &[], [0.25, 0.1, 0.25]);
    let maps = [tint(Onto::TransmissionColor)];
    let pane = Material { reflectance: 0.0, transmittance: 1.0, maps: &maps, ..mirror };
    assert_sees(&[wall(0.0, 0.0, 0)], &[pane], &[], [0.125, 0.125, 0.25]);
    // The light of a lamp behind the pane, too.
    let light = Light::Point { position: Vec3::new(0.0, 0.0, 9.0), color: LinearRgb::WHITE };
    let materials = [pane, Material::matte(LinearRgb::WHITE)];
    assert_sees(&[wall(0.0, 0.0, 1), wall(7.0, 0.0, 0)], &materials, &[light], [0.25, 0.25, 0.5]);
    let maps = [tint(Onto::Emission), tint(Onto::Emission)];
    let lamp = Material { optics: Some(&optics), maps: &maps, ..DARK };
    assert_sees(&[wall(0.0, 0.0, 0)], &[lamp], &[], [0.2, 0.0375, 0.4]);
    let scene = Scene {
        camera: CAMERA,
        background: Background::gray(0.5),
        objects: &[wall(0.0, 0.0, 0)],
        materials: &[Material { optics: None, ..lamp }],
        lights: &[],
        motions: &[],
    };
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
    let error = PreparedScene::<f32, _>::new(&scene, &mut memory).unwrap_err();
    assert_eq!(error.fault, Fault::MapWithoutOptics);
}

#[test]
fn vertices_have_colors() {
    const CORNERS: [Vec3; 3] =
        [Vec3::new(-2.0, -1.0, 0.0), Vec3::new(2.0, -1.0, 0.0), Vec3::new(0.0, 2.0, 0.0)];
    const COLORS: [[u8; 3]; 3] = [[255, 0, 188], [0, 255, 188], [0, 0, 188]];
    let mesh = Mesh { colors: Some(&COLORS), ..Mesh::new(&CORNERS, &[[0, 1, 2]]) };
    let shown = Material { ambient: 0.9, ..Material::matte(LinearRgb::new(1.0, 0.5, 1.0)) };
    let half = 0.9 * ((188.0f64 / 255.0 + 0.055) / 1.055).powf(2.4);
    assert_sees(&[Object::new(Shape::Mesh(mesh), 0)], &[shown], &[], [0.3, 0.15, half]);
}

#[test]
fn glass_mirrors_more_at_flat_angles() {
    for degrees in [0.0f64, 30.0, 56.309_932, 80.0] {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let behind = (1.0 - (sine / 1.5).powi(2)).sqrt();
        let across = ((cosine - 1.5 * behind) / (cosine + 1.5 * behind)).powi(2);
        let along = ((behind - 1.5 * cosine) / (behind + 1.5 * cosine)).powi(2);
        let exact = (across + along) / 2.0;
        let schlick = 0.04 + 0.96 * (1.0 - cosine).powi(5);
        for (fresnel, mirrored) in [(Fresnel::Exact, exact), (Fresnel::Schlick, schlick)] {
            let optics = Optics { fresnel, transmission_color: LinearRgb::gray(0.0), ..Optics::PLAIN };
            let glass =
                Material { reflectance: 0.0, transmittance: 1.0, ior: 1.5, optics: Some(&optics), ..DARK };
            assert_sees(&[wall(0.0, degrees as f32, 0)], &[glass], &[], [0.5 * mirrored; 3]);
            if fresnel == Fresnel::Exact {
                // Lacquer on a dark material.
                let lacquer = Material { reflectance: 0.5, transmittance: 0.0, ..glass };
                assert_sees(&[wall(0.0, degrees as f32, 0)], &[lacquer], &[], [0.25 * mirrored; 3]);
            }
        }
        let metal = Optics { fresnel: Fresnel::Schlick, ..Optics::PLAIN };
        let metal = Material { reflectance: 0.6, optics: Some(&metal), ..DARK };
        let mirrored = 0.6 + 0.4 * (1.0 - cosine).powi(5);
        assert_sees(&[wall(0.0, degrees as f32, 0)], &[metal], &[], [0.5 * mirrored; 3]);
    }
}

#[test]
fn reflections_fade_with_distance_but_the_background_does_not() {
    let falloff = Falloff { constant: 1.0, linear: 0.25, quadratic: 0.0 };
    let dim = Optics { reflection_falloff: falloff, ..Optics::PLAIN };
    let mirror = Material { reflectance: 1.0, optics: Some(&dim), ..DARK };
    // The lamp is a ball behind the eye, at a distance of 8 from the mirror.
    let objects = [wall(0.0, 0.0, 0), ball(9.0, 1.0, 1)];
    assert_sees(&objects, &[mirror, LAMP], &[], [0.8 / 3.0, 0.6 / 3.0, 0.4 / 3.0]);
    assert_sees(&objects[..1], &[mirror], &[], [0.5; 3]);
}

#[test]
fn blinns_highlight_is_half_as_far_away() {
    // The light is 40° off the normal, and the eye on it: Phong's angle is 40°, Blinn's 20°.
    let (sine, cosine) = 40f32.to_radians().sin_cos();
    let light = Light::Directional { direction: Vec3::new(-sine, 0.0, -cosine), color: LinearRgb::WHITE };
    for (highlight, angle) in [(Highlight::Phong, 40f64), (Highlight::BlinnPhong, 20.0)] {
        let optics = Optics { highlight, ..Optics::PLAIN };
        let shiny = Material { specular: 0.5, shininess: 8.0, optics: Some(&optics), ..DARK };
        let expected = 0.5 * angle.to_radians().cos().powi(8);
        assert_sees(&[wall(0.0, 0.0, 0)], &[shiny], &[light], [expected; 3]);
    }
}

#[test]
fn ambient_lights_add_up_and_are_white_where_there_are_none() {
    let matte = Material { ambient: 0.5, ..Material::matte(LinearRgb::new(0.8, 0.4, 0.2)) };
    assert_sees(&[wall(0.0, 0.0, 0)], &[matte], &[], [0.4, 0.2, 0.1]);
    let ambient = |r, g, b| Light::Ambient { color: LinearRgb::new(r, g, b) };
    let lights = [ambient(0.5, 0.0, 0.25), ambient(0.0, 0.5, 0.25)];
    assert_sees(&[wall(0.0, 0.0, 0)], &[matte], &lights, [0.2, 0.1, 0.05]);
}

#[test]
fn lamps_fall_off_and_shine_into_cones() {
    let matte = Material::matte(LinearRgb::WHITE);
    let falloff = Falloff { constant: 1.0, linear: 0.5, quadratic: 0.25 };
    let lamp = Lamp { position: Vec3::new(0.0, 0.0, 4.0), color: LinearRgb::WHITE, falloff, cone: None };
    assert_sees(&[wall(0.0, 0.0, 0)], &[matte], &[Light::Lamp(lamp)], [1.0 / 7.0; 3]);
    // The axis of the cone passes the visible point at an angle of 0.3.
    let direction = Vec3::new(0.3f32.sin(), 0.0, -0.3f32.cos());
    for (bright, dark, share) in [(0.31, 0.5, 1.0), (0.1, 0.29, 0.0)] {
        let cone = Some(LightCone { direction, bright, dark });
        let lamp = Light::Lamp(Lamp { cone, falloff: Falloff::NONE, ..lamp });
        assert_sees(&[wall(0.0, 0.0, 0)], &[matte], &[lamp], [share; 3]);
    }
}

/// Balls with all kinds of optics, on a floor, under all kinds of lamps.
fn with_still_life(then: impl FnOnce(&Scene)) {
    let optics = |fresnel, highlight| Optics { fresnel, highlight, ..Optics::PLAIN };
    let bottle =
        Optics { absorption: LinearRgb::new(0.9, 0.1, 0.6), ..optics(Fresnel::Exact, Highlight::Phong) };
    let gold = Optics {
        reflection_color: LinearRgb::new(1.0, 0.77, 0.34),
        reflection_falloff: Falloff { constant: 1.0, linear: 0.05, quadratic: 0.01 },
        ..optics(Fresnel::Schlick, Highlight::BlinnPhong)
    };
    let ruby = Optics {
        transmission_color: LinearRgb::new(0.9, 0.2, 0.25),
        ..optics(Fresnel::Schlick, Highlight::BlinnPhong)
    };
    let lacquer = optics(Fresnel::Exact, Highlight::BlinnPhong);
    let ember = Optics { emission: LinearRgb::new(0.7, 0.25, 0.05), ..Optics::PLAIN };
    let shiny = Material { specular: 0.4, shininess: 60.0, ..DARK };
    let materials = [
        Material {
            color: rayline::Texture::checker_xz(LinearRgb::gray(0.7), LinearRgb::gray(0.3), 1.0),
            ..Material::matte(LinearRgb::WHITE)
        },
        Material { transmittance: 1.0, ior: 1.5, optics: Some(&bottle), ..shiny },
        Material { reflectance: 0.9, optics: Some(&gold), ..shiny },
        Material { reflectance: 0.1, transmittance: 0.8, ior: 1.76, optics: Some(&ruby), ..shiny },
        Material {
            reflectance: 1.0,
            ior: 1.5,
            optics: Some(&lacquer),
            ..Material { specular: 0.4, shininess: 60.0, ..Material::matte(LinearRgb::new(0.1, 0.2, 0.6)) }
        },
        Material { optics: Some(&ember), ..DARK },
    ];
    let ball = |x, z, radius, material| {
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(x, radius, z), radius)), material)
    };
    let floor = Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0));
    let objects = [
        Object::new(Shape::Plane(floor), 0),
        ball(-1.3, 0.4, 1.0, 1),
        ball(1.2, -0.6, 1.1, 2),
        ball(0.3, 1.5, 0.6, 3),
        ball(-2.8, -1.2, 0.9, 4),
        ball(1.9, 1.7, 0.35, 5),
    ];
    let cone = LightCone { direction: Vec3::new(-0.5, -1.0, -0.4), bright: 0.25, dark: 0.5 };
    let lights = [
        Light::Lamp(Lamp {
            position: Vec3::new(3.0, 6.0, 3.5),
            color: LinearRgb::gray(0.9),
            falloff: Falloff::NONE,
            cone: Some(cone),
        }),
        Light::Lamp(Lamp {
            position: Vec3::new(-4.0, 4.0, 4.0),
            color: LinearRgb::new(0.9, 1.0, 1.2),
            falloff: Falloff { constant: 1.0, linear: 0.0, quadratic: 0.03 },
            cone: None,
        }),
        Light::Directional { direction: Vec3::new(1.0, -2.0, -1.0), color: LinearRgb::gray(0.15) },
        Light::Ambient { color: LinearRgb::new(0.1, 0.1, 0.2) },
    ];
    let camera = Camera {
        eye: Vec3::new(0.0, 2.4, 7.0),
        target: Vec3::new(-0.3, 0.8, 0.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.66,
        lens: None,
    };
    let background = Background::Solid(LinearRgb::new(0.25, 0.35, 0.5));
    then(&Scene {
        camera,
        background,
        objects: &objects,
        materials: &materials,
        lights: &lights,
        motions: &[],
    });
}

#[test]
fn a_still_life_is_that_of_the_textbook() {
    with_still_life(|scene| {
        let settings = Settings { bounces: 6, transfer: Transfer::Linear, ..Settings::new(256, 192) };
        let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
        let textbook = Textbook::new(scene, settings).picture();
        let single = core_picture::<f32>(scene, settings);
        let double = core_picture::<f64>(scene, settings);
        assert_alike(directory, "still-life", ("f32", &single), ("textbook", &textbook));
        assert_alike(directory, "still-life", ("f64", &double), ("textbook", &textbook));
    });
}
