//! Tests of nested media: water in glass, bubbles, spheres in spheres. Each surface names the media on its
//! two sides.

use std::mem::MaybeUninit;
use std::path::Path;

use rayline::math::Fixed;
use rayline::shape::{Cuboid, Cylinder, Disc, Plane, Shape, Sphere};
use rayline::{
    Background, Camera, Event, Light, LinearRgb, Material, Medium, Object, Optics, PreparedScene, Probe,
    RayKind, Real, Renderer, Scene, Settings, Sky, Texture, Transfer, Vec3,
};
use rayline_tests::textbook::Textbook;
use rayline_tests::{PovrayPicture, Watch, assert_alike, core_picture};

const WATER: f32 = 1.333;
const GLASS: f32 = 1.5;
const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);
const CAMERA: Camera =
    Camera { eye: Vec3::new(0.0, 0.0, 5.0), target: Vec3::ZERO, up: UP, vertical_fov: 0.5, lens: None };

/// A clear material with these media behind and in front.
fn between(behind: f32, outside: Medium) -> Material<'static> {
    let optics = Box::leak(Box::new(Optics { outside, ..Optics::PLAIN }));
    Material {
        diffuse: 0.0,
        transmittance: 1.0,
        ior: behind,
        optics: Some(optics),
        ..Material::matte(LinearRgb::WHITE)
    }
}

/// A probe that records the directions of a camera ray and of the rays that follow it, and their hits.
#[derive(Default)]
struct Way {
    directions: Vec<Vec3>,
    kinds: Vec<RayKind>,
}

impl<R: Real> Probe<R> for Way {
    fn record(&mut self, event: Event<R>) {
        if let Event::Ray { kind, ray, .. } = event {
            self.directions.push(ray.direction.to_f32());
            self.kinds.push(kind);
        }
    }
}

/// The light that the camera sees straight ahead, and the path of the rays.
fn look<R: Real>(
    objects: &[Object<Shape<'static>>],
    materials: &[Material],
    lights: &[Light],
) -> ([f32; 3], Way) {
    let background = Background::gray(0.5);
    let scene = Scene { camera: CAMERA, background, objects, materials, lights, motions: &[] };
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R, _>::new(&scene, &mut memory).expect("a legal scene");
    let settings = Settings { cutoff: 0.0, bounces: 8, ..Settings::new(1, 1) };
    let mut path = Way::default();
    let (light, _) = Renderer::new(&prepared, settings).unwrap().pixel(0, 0, &mut Watch(&mut path));
    let light = light.to_f32();
    ([light.r, light.g, light.b], path)
}

/// A wall through (0, 0, z), orthogonal to the line of sight and then turned by `degrees`.
fn wall(z: f32, degrees: f32, material: u16) -> Object<Shape<'static>> {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    Object::new(Shape::Plane(Plane::new(Vec3::new(0.0, 0.0, z), Vec3::new(sine, 0.0, cosine))), material)
}

fn assert_slabs<R: Real>(bound: f32) {
    for degrees in [0.0f32, 20.0, 45.0, 70.0] {
        // Air, glass, water, glass, air; once with all normals toward the eye, and once with two of them away
        // from it.
        let towards = [
            between(GLASS, Medium::AIR),
            between(WATER, Medium::clear(GLASS)),
            between(GLASS, Medium::clear(WATER)),
            between(1.0, Medium::clear(GLASS)),
        ];
        let away = [
            between(GLASS, Medium::AIR),
            between(GLASS, Medium::clear(WATER)),
            between(GLASS, Medium::clear(WATER)),
            between(GLASS, Medium::AIR),
        ];
        for (materials, turned) in [(towards, [0.0; 4]), (away, [0.0, 180.0, 0.0, 180.0])] {
            let objects: Vec<_> = (0u16..)
                .zip(turned)
                .map(|(i, turned)| wall(f32::from(i) * -0.5, degrees + turned, i))
                .collect();
            let (light, Way { directions, kinds }) = look::<R>(&objects, &materials, &[]);
            assert!(light.iter().all(|light| (light - 0.5).abs() < 2e-3), "{light:?}");
            assert!(kinds[1..].iter().all(|kind| *kind == RayKind::Refracted));
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let along = Vec3::new(cosine, 0.0, -sine);
            // n sin θ is the same in each layer, and the last direction equals the first.
            assert_eq!(directions.len(), 5);
            for (direction, ior) in directions.iter().zip([1.0, GLASS, WATER, GLASS, 1.0]) {
                let kept = direction.dot(along) * ior;
                assert!((kept - directions[0].dot(along)).abs() < bound, "{kept} in {ior} at {degrees}°");
            }
            let off = (directions[4] - directions[0]).length();
            assert!(off < bound, "leaves {off} off at {degrees}°");
        }
    }
}

#[test]
fn snells_law_holds_through_every_layer() {
    assert_slabs::<f32>(2e-6);
    assert_slabs::<f64>(1e-6);
    assert_slabs::<Fixed>(2e-6);
}

/// Asserts the color and the path in all number systems.
#[track_caller]
fn assert_sees(
    objects: &[Object<Shape<'static>>],
    materials: &[Material],
    lights: &[Light],
    expected: [f32; 3],
) {
    for (light, bound) in [
        (look::<f32>(objects, materials, lights).0, 2e-5),
        (look::<f64>(objects, materials, lights).0, 2e-5),
        (look::<Fixed>(objects, materials, lights).0, 2e-3),
    ] {
        let close = light.iter().zip(expected).all(|(light, expected)| (light - expected).abs() < bound);
        assert!(close, "{light:?}, not {expected:?}");
    }
}

fn ball(z: f32, radius: f32, material: u16) -> Object<Shape<'static>> {
    Object::new(Shape::Sphere(Sphere::new(Vec3::new(0.0, 0.0, z), radius)), material)
}

#[test]
fn bubbles_under_water_mirror_all_beyond_the_critical_angle() {
    // The critical angle of water is 48.6°.
    let materials = [between(1.0, Medium::clear(WATER))];
    for (degrees, kind) in [(48.0, RayKind::Refracted), (49.2, RayKind::Reflected)] {
        let objects = [wall(0.0, degrees, 0)];
        for kinds in [
            look::<f32>(&objects, &materials, &[]).1.kinds,
            look::<f64>(&objects, &materials, &[]).1.kinds,
            look::<Fixed>(&objects, &materials, &[]).1.kinds,
        ] {
            assert_eq!(kinds, [RayKind::Camera, kind], "{degrees}°");
        }
    }
}

#[test]
fn fresnels_shares_are_those_of_both_sides() {
    let mirrored = ((GLASS - WATER) / (GLASS + WATER)).powi(2);
    let optics =
        Optics { outside: Medium::clear(WATER), transmission_color: LinearRgb::gray(0.0), ..Optics::CLEAR };
    let glass = Material { optics: Some(&optics), ..between(GLASS, Medium::AIR) };
    assert_sees(&[wall(0.0, 0.0, 0)], &[glass], &[], [0.5 * mirrored; 3]);
    // The same from behind.
    assert_sees(&[wall(0.0, 180.0, 0)], &[glass], &[], [0.5 * mirrored; 3]);
}

#[test]
fn the_outside_medium_absorbs_too() {
    // An amber ball of radius 1 with a bubble of radius 1/2 in it, without refraction: light passes one unit
    // of amber.
    let amber = Medium { absorption: LinearRgb::new(0.1, 0.5, 2.0), ..Medium::AIR };
    let optics = Optics { absorption: amber.absorption, ..Optics::PLAIN };
    let materials = [
        Material { optics: Some(&optics), ..between(1.0, Medium::AIR) },
        between(1.0, amber),
        Material::matte(LinearRgb::WHITE),
    ];
    let left = [0.1f32, 0.5, 2.0].map(|coefficient| (-coefficient).exp());
    assert_sees(&[ball(0.0, 1.0, 0), ball(0.0, 0.5, 1)], &materials, &[], left.map(|left| 0.5 * left));
    // The light of a lamp behind the eye is absorbed in the same way.
    let light = Light::Point { position: Vec3::new(0.0, 0.0, 9.0), color: LinearRgb::WHITE };
    let objects = [wall(0.0, 0.0, 2), ball(7.0, 1.0, 0), ball(7.0, 0.5, 1)];
    assert_sees(&objects, &materials, &[light], left);
    // A mirror in amber: one unit there and one back.
    let optics = Optics { outside: amber, ..Optics::PLAIN };
    let mirror = Material { diffuse: 0.0, reflectance: 1.0, optics: Some(&optics), ..materials[2] };
    let objects = [ball(-1.0, 1.0, 0), wall(-1.0, 0.0, 1)];
    let there_and_back = left.map(|left| 0.5 * left * left);
    assert_sees(&objects, &[materials[0], mirror], &[], there_and_back);
}

#[test]
fn an_index_over_that_outside_is_the_same_bytes() {
    // An index that is stated on one side only is the ratio of both.
    let objects = [wall(0.0, 30.0, 0), ball(-3.0, 1.0, 0)];
    let of = |material| look::<f32>(&objects, &[material], &[]).1.directions;
    assert_eq!(of(between(1.5, Medium::clear(2.0))), of(between(0.75, Medium::AIR)));
    assert_eq!(of(between(1.25, Medium::clear(1.25))), of(between(1.0, Medium::AIR)));
}

const FLOOR: Material = Material {
    color: Texture::checker_xz(LinearRgb::gray(0.8), LinearRgb::new(0.2, 0.25, 0.3), 0.5),
    ambient: 0.2,
    ..Material::matte(LinearRgb::WHITE)
};
static LIGHTS: [Light; 1] = [Light::Point { position: Vec3::new(-4.0, 8.0, 6.0), color: LinearRgb::WHITE }];
const ABOVE: Camera = Camera {
    eye: Vec3::new(0.5, 2.3, 6.5),
    target: Vec3::new(0.1, 0.9, 0.0),
    up: UP,
    vertical_fov: 0.6,
    lens: None,
};
const LOOKED_AT: Settings = Settings { bounces: 10, transfer: Transfer::Linear, ..Settings::new(256, 192) };

/// A glass ball around a water ball around a bubble, and ice in a block of water.
fn with_nested(then: impl FnOnce(&Scene)) {
    let share = |material: Material<'static>| Material { specular: 0.3, shininess: 80.0, ..material };
    let materials = [
        FLOOR,
        share(between(GLASS, Medium::AIR)),
        share(between(WATER, Medium::clear(GLASS))),
        share(between(1.0, Medium::clear(WATER))),
        share(between(WATER, Medium::AIR)),
        share(between(1.309, Medium::clear(WATER))),
        Material { ambient: 0.2, ..Material::matte(LinearRgb::new(0.8, 0.3, 0.1)) },
    ];
    let ball = |x, y, radius, material| {
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(x, y, 0.0), radius)), material)
    };
    let block =
        |corner, opposite, material| Object::new(Shape::Cuboid(Cuboid::aligned(corner, opposite)), material);
    let objects = [
        Object::new(Shape::Plane(Plane::new(Vec3::ZERO, UP)), 0),
        ball(-1.1, 1.05, 1.0, 1),
        ball(-1.1, 1.05, 0.8, 2),
        ball(-1.0, 1.2, 0.35, 3),
        block(Vec3::new(0.3, 0.05, -0.9), Vec3::new(2.1, 1.6, 0.9), 4),
        block(Vec3::new(0.5, 0.9, -0.3), Vec3::new(1.1, 1.4, 0.3), 5),
        ball(1.6, 0.45, 0.3, 6),
    ];
    let background = Background::Solid(LinearRgb::new(0.5, 0.6, 0.8));
    then(&Scene {
        camera: ABOVE,
        background,
        objects: &objects,
        materials: &materials,
        lights: &LIGHTS,
        motions: &[],
    });
}

/// A glass of water with a straw, made of open surfaces that name the media on both sides.
fn with_glass(then: impl FnOnce(&Scene)) {
    let clear = |behind, outside, absorption| {
        let outside = Medium::clear(outside);
        let optics = Box::leak(Box::new(Optics { outside, absorption, ..Optics::CLEAR }));
        Material { specular: 0.4, shininess: 200.0, optics: Some(optics), ..between(behind, Medium::AIR) }
    };
    let (none, blue) = (LinearRgb::gray(0.0), LinearRgb::new(0.35, 0.12, 0.04));
    let materials = [
        FLOOR,
        clear(GLASS, 1.0, none),
        clear(1.0, GLASS, none),
        clear(WATER, GLASS, blue),
        clear(WATER, 1.0, blue),
        Material { ambient: 0.25, ..Material::matte(LinearRgb::new(0.85, 0.1, 0.1)) },
        clear(GLASS, WATER, none),
    ];
    let at = |y| Vec3::new(0.0, y, 0.0);
    let tube = |base, top, radius, material| {
        Object::new(
            Shape::Cylinder(Cylinder { base: at(base), top: at(top), radius, capped: false }),
            material,
        )
    };
    let disc = |y, normal, hole, radius, material| {
        Object::new(Shape::Disc(Disc { center: at(y), normal, radius, hole }), material)
    };
    let straw = Cylinder {
        base: Vec3::new(-0.5, 0.3, 0.1),
        top: Vec3::new(0.75, 2.4, -0.2),
        radius: 0.06,
        capped: true,
    };
    let objects = [
        Object::new(Shape::Plane(Plane::new(Vec3::ZERO, UP)), 0),
        // Between glass and air: the foot, the outer wall, the rim, and the inner wall above the water.
        disc(0.01, -UP, 0.0, 0.9, 1),
        tube(0.01, 2.0, 0.9, 1),
        disc(2.0, UP, 0.8, 0.9, 1),
        tube(1.5, 2.0, 0.8, 2),
        // Between glass and water: the inner wall below the water level, and the bottom.
        tube(0.2, 1.5, 0.8, 3),
        disc(0.2, UP, 0.0, 0.8, 6),
        // Between water and air.
        disc(1.5, UP, 0.0, 0.8, 4),
        Object::new(Shape::Cylinder(straw), 5),
    ];
    static SKY: Sky = Sky::new(LinearRgb::gray(0.9), LinearRgb::new(0.2, 0.4, 0.8));
    let background = Background::Gradient(&SKY);
    then(&Scene {
        camera: ABOVE,
        background,
        objects: &objects,
        materials: &materials,
        lights: &LIGHTS,
        motions: &[],
    });
}

fn assert_as_in_textbook(name: &str, scene: &Scene) {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let textbook = Textbook::new(scene, LOOKED_AT).picture();
    let (single, double) = (core_picture::<f32>(scene, LOOKED_AT), core_picture::<f64>(scene, LOOKED_AT));
    single.write(&directory.join(format!("{name}.png")));
    assert_alike(directory, name, ("f64", &double), ("textbook", &textbook));
    assert_alike(directory, name, ("f32", &single), ("textbook", &textbook));
}

#[test]
fn nested_bodies_are_those_of_the_textbook() {
    with_nested(|scene| assert_as_in_textbook("nested", scene));
}

#[test]
fn a_glass_of_water_is_that_of_the_textbook() {
    with_glass(|scene| assert_as_in_textbook("glass", scene));
}

#[test]
fn nested_bodies_are_those_of_povray() {
    with_nested(|scene| {
        let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("povray");
        let Some(povray) = PovrayPicture::render(scene, LOOKED_AT, &directory, "nested") else { return };
        let single = core_picture::<f32>(scene, LOOKED_AT);
        assert_alike(&directory, "nested", ("f32", &single), ("povray", &povray.picture));
    });
}
