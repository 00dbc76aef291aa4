//! Baked light: in closed form, and beside the lamps that it takes the place of.

use bumpalo::Bump;
use rayline::shape::{Cuboid, Mesh, Polygon, Rectangle, Shape, Sphere, Triangle};
use rayline::{
    Background, Camera, Figure, Light, LinearRgb, Material, Object, ObjectId, Onto, Optics, Placed, Scene,
    Settings, Texture, Transfer, Vec3,
};
use rayline_simulator::{
    BakedLight, LightError, LightOptions, LightTexels, Number, RenderOptions, bake_light, render,
};

const CAMERA: Camera = Camera {
    eye: Vec3::new(0.5, 0.5, 0.6),
    target: Vec3::new(0.3, 0.4, 0.0),
    up: Vec3::new(0.0, 1.0, 0.0),
    vertical_fov: 1.5,
    lens: None,
};

/// The walls of the unit cube: floor, ceiling, left, right, back, front.
fn walls(material: u16) -> [Object<Shape<'static>>; 6] {
    let v = Vec3::new;
    let (x, y, z) = (v(1.0, 0.0, 0.0), v(0.0, 1.0, 0.0), v(0.0, 0.0, 1.0));
    [
        (v(0.0, 0.0, 0.0), x, z),
        (y, x, z),
        (v(0.0, 0.0, 0.0), y, z),
        (x, y, z),
        (v(0.0, 0.0, 0.0), x, y),
        (z, x, y),
    ]
    .map(|(corner, right, up)| Object::new(Shape::Rectangle(Rectangle { corner, right, up }), material))
}

/// Half of the light is scattered, and this light is emitted.
fn glowing(optics: &Optics) -> Material<'_> {
    Material { optics: Some(optics), ..Material::matte(LinearRgb::gray(0.5)) }
}

const GLOW: Optics = Optics { emission: LinearRgb::WHITE, ..Optics::PLAIN };

fn scene<'a>(
    objects: &'a [Object<Shape<'a>>],
    materials: &'a [Material<'a>],
    lights: &'a [Light],
) -> Scene<'a> {
    Scene { camera: CAMERA, background: Background::BLACK, objects, materials, lights, motions: &[] }
}

pub(super) fn baked<'a>(scene: &Scene<'a>, options: &LightOptions, arena: &'a Bump) -> BakedLight<'a> {
    bake_light(scene, options, arena, &|_, _| ()).unwrap_or_else(|error| panic!("{error}"))
}

/// The light that a baked texture holds, of each of an object's texels.
pub(super) fn light_on(scene: &Scene<'_>, object: usize) -> Vec<f32> {
    let material = scene.materials[usize::from(scene.objects[object].material.0)];
    let map = material.maps.iter().find(|map| matches!(map.onto, Onto::AmbientLight { .. })).unwrap();
    let Onto::AmbientLight { most } = map.onto else { unreachable!() };
    let Texture::Placed(Placed { figure: Figure::Image(image), .. }) = map.texture else { panic!("{map:?}") };
    let texels = (0..image.height).flat_map(|line| (0..image.width).map(move |column| (column, line)));
    texels.map(|(column, line)| image.light(column, line).g * most).collect()
}

fn mean(values: &[f32]) -> f32 {
    values.iter().sum::<f32>() / values.len() as f32
}

pub(super) const SMALL: LightOptions = LightOptions {
    keep_lamps: false,
    budget: 12_000,
    photons: 20_000,
    texels: LightTexels::Rgb888,
    grid: [1, 1, 1],
    moving: Vec::new(),
};

/// Where all surfaces emit 1 and scatter a half, each receives 2 (White, "furnace").
#[test]
fn a_furnace_is_evenly_bright() {
    let (objects, materials, arena) = (walls(0), [glowing(&GLOW)], Bump::new());
    let baked = baked(&scene(&objects, &materials, &[]), &SMALL, &arena);
    for wall in 0..6 {
        for light in light_on(&baked.scene, wall) {
            assert!((light - 2.0).abs() < 0.02, "wall {wall}: {light}");
        }
    }
    assert!(baked.bytes <= SMALL.budget && baked.bytes == baked.texels * 3);
}

/// What one wall emits is absorbed by all: half of what they receive.
#[test]
fn a_closed_room_keeps_its_energy() {
    let (mut objects, arena) = (walls(1), Bump::new());
    objects[1].material.0 = 0;
    let materials = [glowing(&GLOW), Material::matte(LinearRgb::gray(0.5))];
    let baked = baked(&scene(&objects, &materials, &[]), &SMALL, &arena);
    let received: f32 = (0..6).map(|wall| mean(&light_on(&baked.scene, wall))).sum();
    assert!((received * 0.5 - 1.0).abs() < 0.01, "{received}");
    // More arrives opposite than beside (0.1998 and 0.2000 of what is emitted are nearly alike, but beside
    // lies light that was scattered once), and the light between the walls is smooth.
    let floor = light_on(&baked.scene, 0);
    let (least, most) = floor.iter().fold((f32::MAX, 0.0_f32), |(l, m), v| (l.min(*v), m.max(*v)));
    assert!(least > 0.2 && most < 0.6, "{least} to {most}");
}

/// A ball that moves takes its light from the volume: with one grid point in the middle of a room with one
/// bright wall, in first-order harmonics. The mean is a sixth; a place that faces the wall has a form factor
/// of 0.5541, half of which is the first order's share.
#[test]
fn moving_things_are_lit_from_the_bright_side() {
    let (walls, arena) = (walls(1), Bump::new());
    let ball = Object::new(Shape::Sphere(Sphere::new(Vec3::new(0.5, 0.5, 0.5), 0.1)), 2);
    let mut objects: Vec<_> = walls.into_iter().chain([ball]).collect();
    objects[3].material.0 = 0;
    let black = Material { diffuse: 1.0, ..Material::matte(LinearRgb::gray(0.0)) };
    let bright = Material { optics: Some(&GLOW), ..black };
    let materials = [bright, black, Material::matte(LinearRgb::WHITE)];
    let options = LightOptions { moving: vec![ObjectId(6)], ..SMALL };
    let BakedLight { scene: lit, .. } = baked(&scene(&objects, &materials, &[]), &options, &arena);
    let shown = |eye: Vec3, number| {
        let camera = Camera { eye, target: Vec3::new(0.5, 0.5, 0.5), vertical_fov: 0.05, ..CAMERA };
        let settings = Settings { transfer: Transfer::Linear, ..Settings::new(1, 1) };
        let options = RenderOptions { number, ..RenderOptions::new(settings) };
        f32::from(render(&Scene { camera, ..lit }, &options).unwrap().rgb[0]) / 255.0
    };
    for number in [Number::F32, Number::Fixed, Number::F64] {
        for (x, expected) in [(0.9, 1.0 / 6.0 + 0.5541 / 2.0), (0.1, 0.0)] {
            let light = shown(Vec3::new(x, 0.5, 0.5), number);
            assert!((light - expected).abs() < 0.015, "{number:?} from {x}: {light}, not {expected}");
        }
        let across = shown(Vec3::new(0.5, 0.5, 0.9), number);
        assert!((across - 1.0 / 6.0).abs() < 0.015, "{number:?} from the side: {across}");
    }
}

/// The light of suns on all shapes that hold baked light looks as it does from the suns themselves: so
/// texels lie where the shapes' coordinates say.
#[test]
fn baked_lamps_look_as_lamps() {
    let v = Vec3::new;
    let floor = Rectangle { corner: v(-3.0, 0.0, -3.0), right: v(6.0, 0.0, 0.0), up: v(0.0, 0.0, 6.0) };
    let turned =
        Cuboid { center: v(0.0, 0.6, 0.0), axes: [v(0.4, 0.0, 0.3), v(0.0, 0.6, 0.0), v(0.3, 0.0, -0.4)] };
    let triangle =
        Triangle { vertices: [v(-2.0, 0.2, 1.0), v(-1.0, 0.4, 1.2), v(-1.4, 1.3, 0.6)], normals: None };
    let corners = [v(1.0, 0.1, 1.0), v(2.0, 0.1, 1.2), v(2.3, 0.9, 1.0), v(1.5, 1.5, 0.7), v(0.9, 0.8, 0.8)];
    // In one plane.
    let corners = corners.map(|corner| v(corner.x, corner.y, 1.0 + 0.1 * corner.x - 0.3 * corner.y));
    let pillar = ([v(-1.2, 0.0, -1.0), v(-0.6, 0.0, -1.2), v(-0.9, 1.5, -1.1)], [[0, 1, 2]]);
    let objects = [
        Object::new(Shape::Rectangle(floor), 0),
        Object::new(Shape::Cuboid(turned), 0),
        Object::new(Shape::Triangle(triangle), 0),
        Object::new(Shape::Polygon(Polygon { vertices: &corners }), 0),
        Object::new(Shape::Mesh(Mesh::new(&pillar.0, &pillar.1)), 0),
    ];
    let materials = [Material::matte(LinearRgb::gray(0.1))];
    let lights = [
        (v(1.0, -1.0, -1.0), LinearRgb::new(4.0, 0.5, 0.0)),
        (v(-1.0, -1.0, -0.3), LinearRgb::new(0.0, 2.5, 1.0)),
        (v(0.1, -1.0, 1.0), LinearRgb::new(0.5, 0.0, 3.0)),
    ]
    .map(|(direction, color)| Light::Directional { direction, color });
    let arena = Bump::new();
    let camera = Camera { eye: v(0.5, 2.6, 5.0), target: v(0.0, 0.4, 0.0), vertical_fov: 0.8, ..CAMERA };
    let lamps = Scene { camera, ..scene(&objects, &materials, &lights) };
    let options = LightOptions { budget: 400_000, ..SMALL };
    let BakedLight { scene: light, .. } = baked(&lamps, &options, &arena);
    assert!(light.lights.is_empty());
    let shown = |scene: &Scene<'_>| {
        let settings = Settings { transfer: Transfer::Linear, ..Settings::new(160, 120) };
        render(scene, &RenderOptions::new(settings)).unwrap().rgb
    };
    let (lamps, light) = (shown(&lamps), shown(&light));
    let apart = |(a, b): (&u8, &u8)| f64::from(a.abs_diff(*b));
    let all: f64 = lamps.iter().map(|code| f64::from(*code)).sum();
    let error = lamps.iter().zip(&light).map(apart).sum::<f64>() / all;
    // Surfaces of a tenth scatter a tenth more; edges of shadows have a texel's width.
    assert!(error < 0.05, "{error}");
    let far = lamps.chunks(3).zip(light.chunks(3)).filter(|(a, b)| a.iter().zip(*b).any(|p| apart(p) > 24.0));
    let far = far.count();
    assert!(far < lamps.len() / 3 / 50, "{far} pixels differ");
}

#[test]
fn bad_options_get_clear_errors() {
    let (objects, materials, arena) = (walls(0), [glowing(&GLOW)], Bump::new());
    let room = scene(&objects, &materials, &[]);
    let refusal = |scene: &Scene<'_>, options: LightOptions| {
        let arena = Bump::new();
        // The scene lives as long as what is made of it.
        let scene = Scene { ..*scene };
        bake_light(&scene, &options, &arena, &|_, _| ()).map(|_| ()).unwrap_err()
    };
    let LightError::Budget(needed) = refusal(&room, LightOptions { budget: 10, ..SMALL }) else { panic!() };
    assert_eq!(needed, 6 * 4 * 3);
    let least = baked(&room, &LightOptions { budget: needed, ..SMALL }, &arena);
    assert_eq!(least.bytes, needed);
    let gone = LightOptions { moving: vec![ObjectId(6)], ..SMALL };
    assert!(matches!(refusal(&room, gone), LightError::NoObject(ObjectId(6))));
    assert!(matches!(refusal(&room, LightOptions { grid: [4, 0, 4], ..SMALL }), LightError::Grid));
    let ball = [Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0)), 0)];
    let error = refusal(&scene(&ball, &materials, &[]), SMALL);
    assert!(matches!(error, LightError::NoSurface));
    assert!(error.to_string().contains("add a matte rectangle"), "{error}");
    let bad = [Material { diffuse: f32::NAN, ..materials[0] }];
    assert!(matches!(refusal(&scene(&objects, &bad, &[]), SMALL), LightError::Scene(_)));
}
