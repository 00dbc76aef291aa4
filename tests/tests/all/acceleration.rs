//! Tests that acceleration never changes a byte: pictures with and without it, of built-in, stored and random
//! scenes.

use std::mem::MaybeUninit;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use proptest::prelude::*;
use rayline::builtin::PRISM;
use rayline::math::Fixed;
use rayline::shape::{
    Cone, Csg, CsgStep, Cuboid, Disc, Ellipsoid, Geometry, Mesh, Plane, Polygon, Quadric, Rectangle, Shape,
    Solid, Sphere, Torus, Triangle,
};
use rayline::{
    Background, Camera, Event, Light, LinearRgb, Material, Object, Optics, PreparedScene, Probe, RayCounts,
    Real, Renderer, Scene, Settings, Sides, Vec3,
};
use rayline_tests::{
    Watch, cut_box, each_scene, instances, lamps, maps, meshes, metaballs, optics, turned_box, with_scene,
};

fn lines<R: Real, S: Geometry>(scene: &PreparedScene<'_, R, S>, settings: Settings) -> Vec<Rgb888> {
    let renderer = Renderer::new(scene, settings).unwrap();
    let mut pixels = Vec::new();
    for y in 0..settings.height {
        let mut line = vec![Rgb888::BLACK; settings.width as usize];
        renderer.line(y, &mut line).unwrap();
        pixels.extend(line);
    }
    pixels
}

/// The number of pixels that differ between pictures with and without acceleration.
fn differences<R: Real>(scene: &Scene, settings: Settings) -> usize {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R, _>::new(scene, &mut memory).unwrap();
    let fast = lines(&prepared, settings);
    let slow = lines(&prepared.without_acceleration(), settings);
    fast.iter().zip(&slow).filter(|(fast, slow)| fast != slow).count()
}

fn picture<R: Real>(scene: &Scene, settings: Settings) -> Vec<Rgb888> {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    lines(&PreparedScene::<R, _>::new(scene, &mut memory).unwrap(), settings)
}

fn check(name: &str) {
    with_scene(name, |scene, bounces| {
        for (width, height) in [(160, 120), (97, 31)] {
            let settings = Settings { bounces, ..Settings::new(width, height) };
            assert_eq!(differences::<f32>(scene, settings), 0);
            assert_eq!(differences::<f64>(scene, settings), 0);
        }
        // From a near position, with objects around and behind the camera.
        let Camera { eye, target, .. } = scene.camera;
        for share in [0.3, 0.8, 0.95] {
            let camera = Camera { eye: eye + (target - eye) * share, ..scene.camera };
            let settings = Settings { bounces, ..Settings::new(64, 48) };
            assert_eq!(differences::<f32>(&Scene { camera, ..*scene }, settings), 0);
        }
    });
}

each_scene!(check);

/// A probe that records all events in order.
#[derive(Default)]
struct Record(Vec<Event<f32>>);

impl Probe<f32> for Record {
    fn record(&mut self, event: Event<f32>) {
        self.0.push(event);
    }
}

/// Pixels that are traced side by side take the same rays as alone, and a probe that needs the order receives
/// the events of one pixel after the other.
#[test]
fn pixels_side_by_side_take_the_same_rays() {
    for name in ["flake", "balls_s2", "teapot_s2", "rings_s1", "mount_s1"] {
        with_scene(name, |scene, bounces| {
            let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
            let prepared = PreparedScene::<f32, _>::new(scene, &mut memory).unwrap();
            // A small limit of rays, which some pixels reach.
            let settings = Settings { bounces, rays_per_pixel: 9, ..Settings::new(53, 40) };
            let renderer = Renderer::new(&prepared, settings).unwrap();
            let mut line = [Rgb888::BLACK; 53];
            for y in 0..40 {
                let (mut together, mut alone) = (RayCounts::default(), RayCounts::default());
                let (mut in_order, mut pixel_by_pixel) = (Record::default(), Record::default());
                renderer.lines(y, &mut line, &mut Watch(&mut together)).unwrap();
                renderer.lines(y, &mut line, &mut Watch(&mut in_order)).unwrap();
                for x in 0..53 {
                    renderer.pixel(x, y as u16, &mut Watch(&mut alone));
                    renderer.pixel(x, y as u16, &mut Watch(&mut pixel_by_pixel));
                }
                assert_eq!(together, alone, "{name}, line {y}");
                assert!(in_order.0 == pixel_by_pixel.0, "{name}, line {y}");
            }
        });
    }
}

/// A probe that keeps the largest error of the squared length of a direction.
struct LengthError(f64);

impl Probe<f32> for LengthError {
    fn record(&mut self, event: Event<f32>) {
        let direction = match event {
            Event::Ray { ray, .. } => ray.direction,
            Event::Light { toward, .. } => toward,
            _ => return,
        };
        self.0 = self.0.max((direction.to::<f64>().length_squared() - 1.0).abs());
    }
}

/// Rays between mirrors that face each other aslant, and through glass between them: each bounce adds to the
/// error of the direction's length. The longest leave a huge ball, and must not meet it again.
#[test]
fn directions_stay_unit_vectors() {
    let across = Vec3::new(0.48, 0.6, 0.64);
    let mirror = |z: f32| Object::new(Shape::Plane(Plane::new(across * z, across)), 0);
    let ball = Object::new(Shape::Sphere(Sphere::new(across * 0.5, 0.7)), 1);
    let dark = Material { diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) };
    let diamond = Material { reflectance: 0.2, transmittance: 0.8, ior: 2.4, ..dark };
    let scene = Scene {
        camera: Camera {
            eye: across * -2.0,
            target: Vec3::ZERO,
            up: Vec3::new(0.0, 1.0, 0.0),
            ..PRISM.camera
        },
        objects: &[mirror(-3.0), mirror(3.0), ball],
        materials: &[Material { reflectance: 1.0, ..dark }, diamond],
        ..PRISM
    };
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
    let prepared = PreparedScene::<f32, _>::new(&scene, &mut memory).unwrap();
    let settings = Settings { bounces: 16, cutoff: 0.0, ..Settings::new(32, 24) };
    let renderer = Renderer::new(&prepared, settings).unwrap();
    let mut error = LengthError(0.0);
    for (x, y) in (0..24).flat_map(|y| (0..32).map(move |x| (x, y))) {
        renderer.pixel(x, y, &mut error);
    }
    println!("the squared length is off by {:.1e}", error.0);
    // A unit vector is rounded by up to 1.8e-7 of its length.
    assert!(error.0 < 3.6e-7, "{}", error.0);
}

fn coordinate() -> BoxedStrategy<f32> {
    prop_oneof![4 => -4.0f32..4.0, 1 => (-8i8..8).prop_map(|x| f32::from(x) * 0.5)].boxed()
}

fn vector() -> BoxedStrategy<Vec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(|[x, y, z]| Vec3::new(x, y, z)).boxed()
}

fn shape() -> BoxedStrategy<Shape<'static>> {
    prop_oneof![
        5 => (vector(), 0.01f32..3.0).prop_map(|(center, radius)| Shape::Sphere(Sphere::new(center, radius))),
        1 => (vector(), vector()).prop_map(|(point, normal)| Shape::Plane(Plane::new(point, normal))),
        2 => [vector(), vector(), vector()].prop_map(|[a, b, c]| Shape::Triangle(Triangle::flat(a, b, c))),
        2 => [vector(), vector(), vector()].prop_map(|[a, b, c]| {
            // The polygon is a parallelogram.
            Shape::Polygon(Polygon::new(Box::leak(Box::new([a, b, c, a + c - b]))))
        }),
        1 => (vector(), vector(), 0.0f32..2.0, 0.0f32..1.0).prop_map(|(center, normal, radius, share)| {
            Shape::Disc(Disc::ring(center, normal, radius * share, radius))
        }),
        1 => (vector(), vector(), vector())
            .prop_map(|(corner, right, up)| Shape::Rectangle(Rectangle::new(corner, right, up))),
        1 => (vector(), vector()).prop_map(|(one, other)| Shape::Cuboid(Cuboid::aligned(one, other))),
        1 => (vector(), vector(), vector(), 0.01f32..2.0)
            .prop_map(|(center, along, aside, length)| {
                Shape::Cuboid(turned_box(center, along, aside, length))
            }),
        1 => (vector(), vector(), proptest::collection::vec(vector(), 0..6))
            .prop_map(|(center, half, cuts)| Shape::ConvexPolyhedron(cut_box(center, half, &cuts))),
        1 => (vector(), vector(), 0.0f32..2.0, 0.0f32..2.0, any::<bool>()).prop_map(
            |(base, top, base_radius, top_radius, capped)| {
                Shape::Cone(Cone { base, base_radius, top, top_radius, capped })
            }
        ),
        1 => (vector(), [vector(), vector(), vector()])
            .prop_map(|(center, axes)| Shape::Ellipsoid(Ellipsoid { center, axes })),
        1 => (vector(), vector(), 0.5f32..3.0, 0.01f32..0.5).prop_map(
            |(center, axis, major_radius, minor_radius)| {
                Shape::Torus(Torus { center, axis, major_radius, minor_radius })
            }
        ),
        1 => (vector(), vector(), vector(), vector(), any::<bool>()).prop_map(
            |(center, squares, linear, corner, capped)| {
                let (a, b) = (squares, linear);
                let coefficients = [a.x, a.y, a.z, b.x, 0.0, b.y, b.z, 0.0, b.x, -1.0];
                let max = Vec3::new(corner.x.abs(), corner.y.abs(), corner.z.abs());
                Shape::Quadric(Quadric { center, coefficients, min: -max, max, capped })
            }
        ),
        1 => meshes(vector(), 1..30).prop_map(Shape::Mesh),
        1 => metaballs(vector(), (0.1f32..3.0).boxed()).prop_map(Shape::Metaballs),
        1 => instances(vector(), (0.1f32..1.5).boxed()).prop_map(Shape::Instances),
        1 => (vector(), vector(), 0.1f32..3.0, 0.1f32..3.0, vector(), 0..3usize).prop_map(
            |(center, aside, radius, other_radius, normal, operator)| {
                // The solids are so close together that the result is not empty.
                let ball = |center, radius| CsgStep::Solid(Solid::Sphere(Sphere::new(center, radius)));
                let operator = [CsgStep::Union, CsgStep::Intersection, CsgStep::Difference][operator];
                Shape::Csg(Csg::new(Box::leak(Box::new([
                    ball(center, radius),
                    ball(center + aside * (0.3 * radius), other_radius),
                    operator,
                    CsgStep::Solid(Solid::Plane(Plane::new(center, normal))),
                    CsgStep::Difference,
                ]))))
            }
        ),
    ]
    .boxed()
}

fn material() -> BoxedStrategy<Material<'static>> {
    let shares = (0.0f32..1.0, 0.0f32..0.6, prop_oneof![Just(0.0f32), 0.1f32..0.4], 0.6f32..2.0);
    let share = (0.0f32..1.0).boxed();
    let grays = share.clone().prop_map(LinearRgb::gray).boxed();
    let maps = maps(&share, &grays);
    (shares, [share.clone(), share.clone(), share.clone()], optics(&share), maps)
        .prop_map(|((specular, reflectance, transmittance, ior), [r, g, b], optics, maps)| Material {
            optics,
            maps,
            specular,
            shininess: 10.0,
            reflectance,
            transmittance,
            ior,
            ..Material::matte(LinearRgb::new(r, g, b))
        })
        .boxed()
}

fn light() -> BoxedStrategy<Light> {
    let color = LinearRgb::gray(0.7);
    prop_oneof![
        vector().prop_map(move |v| Light::Point { position: v * 3.0, color }),
        vector().prop_map(move |direction| Light::Directional { direction, color }),
        lamps(&(-5.0f32..5.0).boxed(), &Just(color).boxed()),
    ]
    .boxed()
}

/// Shapes like those of [`shape`], but smaller, so that many fit beside each other.
fn small_shape() -> BoxedStrategy<Shape<'static>> {
    let small = prop_oneof![Just(0.05f32), Just(0.25), 0.01f32..0.4];
    prop_oneof![
        6 => (vector(), small.clone())
            .prop_map(|(center, radius)| Shape::Sphere(Sphere::new(center, radius))),
        6 => (vector(), vector(), vector(), small.clone()).prop_map(|(at, b, c, size)| {
            Shape::Triangle(Triangle::flat(at, at + b * size, at + c * size))
        }),
        2 => (vector(), vector(), small.clone(), 0.0f32..0.5).prop_map(|(base, along, size, top_radius)| {
            let top = base + along * size;
            Shape::Cone(Cone { base, base_radius: size, top, top_radius, capped: size > 0.2 })
        }),
        1 => shape(),
    ]
    .boxed()
}

fn accepted<R: Real>(scene: &Scene) -> bool {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    PreparedScene::<R, _>::new(scene, &mut memory).is_ok()
}

/// A scene with those objects and lights that are accepted.
fn with_accepted<R: Real>(
    eye: Vec3,
    objects: impl Iterator<Item = Object<Shape<'static>>>,
    materials: &[Material<'static>],
    lights: Vec<Light>,
    check: impl FnOnce(&Scene),
) {
    let camera =
        Camera { eye, target: Vec3::ZERO, up: Vec3::new(0.1, 1.0, 0.05), vertical_fov: 1.0, lens: None };
    let background = Background::Solid(LinearRgb::new(0.2, 0.4, 0.6));
    let empty = Scene { camera, background, objects: &[], materials, lights: &[], motions: &[] };
    if !accepted::<R>(&empty) {
        return;
    }
    let objects: Vec<_> =
        objects.filter(|object| accepted::<R>(&Scene { objects: &[*object], ..empty })).collect();
    let lights: Vec<_> =
        lights.into_iter().filter(|light| accepted::<R>(&Scene { lights: &[*light], ..empty })).collect();
    check(&Scene { objects: &objects, lights: &lights, ..empty });
}

fn eye() -> BoxedStrategy<Vec3> {
    vector().prop_map(|eye| eye * 2.0 + Vec3::new(0.1, 0.2, 0.3)).boxed()
}

/// A shadow ray begins at an offset from its hit. Far out on a floor, the offset is as large as the distance
/// of a small ball from its lamp.
#[test]
fn lamps_close_to_balls_above_a_floor_to_the_horizon() {
    let white = Material::matte(LinearRgb::gray(0.8));
    let materials = [Material { ambient: 0.3, ..white }, Material::matte(LinearRgb::new(0.9, 0.2, 0.1))];
    let lamp = Vec3::new(0.0, 1.0, 0.0);
    for (away, radius) in [(0.55, 0.5), (0.055, 0.05), (0.0055, 0.005), (0.0024, 0.002)] {
        let middle = lamp + Vec3::new(0.2, 0.98, 0.0) * away;
        for light in [
            Light::Point { position: lamp, color: LinearRgb::gray(50.0) },
            Light::Directional { direction: Vec3::new(-0.2, -0.98, 0.0), color: LinearRgb::WHITE },
        ] {
            let scene = Scene {
                camera: Camera {
                    eye: Vec3::new(0.0, 0.5, 5.0),
                    target: Vec3::new(-1.0, 0.6, 0.0),
                    up: Vec3::new(0.0, 1.0, 0.0),
                    vertical_fov: 0.7,
                    lens: None,
                },
                background: Background::Solid(LinearRgb::gray(0.3)),
                objects: &[
                    Object::new(
                        Shape::Plane(Plane::new(Vec3::new(0.0, -1.0, 0.0), Vec3::new(0.08, 1.0, 0.0))),
                        0,
                    ),
                    Object::new(Shape::Sphere(Sphere::new(middle, radius)), 1),
                ],
                materials: &materials,
                lights: &[light],
                motions: &[],
            };
            assert_same_in_all_numbers(&scene, Settings::new(320, 240), (away, light));
        }
    }
}

/// A bow tie is drawn as the two triangles that it encloses.
#[test]
fn a_bow_tie_is_two_triangles() {
    let place = |u: f32, v: f32| Vec3::new(0.9 * u, v + 0.2 * u, 0.3 * u - 0.4 * v);
    let corners = [place(-1.0, -0.7), place(-1.0, 0.7), place(1.0, -0.7), place(1.0, 0.7)];
    let [a, b, c, d] = corners;
    let middle = place(0.0, 0.0);
    // The triangles have the same front as the bow tie.
    let triangles = [Triangle::flat(a, b, middle), Triangle::flat(c, middle, d)];
    let floor = Object::new(Shape::Plane(Plane::new(Vec3::new(0.0, -1.5, 0.0), Vec3::new(0.0, 1.0, 0.0))), 1);
    let balls = |count: u16| {
        (0..count).map(|i| {
            let center = Vec3::new(f32::from(i % 8) * 0.3 - 1.0, f32::from(i / 8) * 0.3 - 1.0, -2.0);
            Object::new(Shape::Sphere(Sphere::new(center, 0.1)), 1)
        })
    };
    let camera = Camera {
        eye: Vec3::new(0.3, 0.4, 4.0),
        target: Vec3::ZERO,
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.7,
        lens: None,
    };
    let glass = Material { transmittance: 0.5, ior: 1.5, ..Material::matte(LinearRgb::new(0.9, 0.3, 0.2)) };
    let materials = [glass, Material::matte(LinearRgb::gray(0.7))];
    let lights = [Light::Point { position: Vec3::new(3.0, 4.0, 3.0), color: LinearRgb::gray(0.9) }];
    let background = Background::Solid(LinearRgb::new(0.2, 0.4, 0.6));
    let settings = Settings::new(96, 72);
    for count in [0, 50] {
        let with = |shapes: &[Shape<'static>], check: &dyn Fn(&Scene)| {
            let objects: Vec<_> = shapes
                .iter()
                .map(|shape| Object::new(*shape, 0))
                .chain([floor])
                .chain(balls(count))
                .collect();
            check(&Scene {
                camera,
                background,
                objects: &objects,
                materials: &materials,
                lights: &lights,
                motions: &[],
            });
        };
        let bow_tie = Shape::Polygon(Polygon::new(Box::leak(Box::new(corners))));
        with(&[bow_tie], &|bow_tie| {
            assert_same_in_all_numbers(bow_tie, settings, count);
            with(&triangles.map(Shape::Triangle), &|triangles| {
                // Pixels on the outline and on the edge of the shadow may differ.
                let off = |a: Vec<Rgb888>, b: Vec<Rgb888>| a.iter().zip(&b).filter(|(a, b)| a != b).count();
                let counts = [
                    off(picture::<f32>(bow_tie, settings), picture::<f32>(triangles, settings)),
                    off(picture::<f64>(bow_tie, settings), picture::<f64>(triangles, settings)),
                    off(picture::<Fixed>(bow_tie, settings), picture::<Fixed>(triangles, settings)),
                ];
                assert!(counts.iter().all(|count| *count <= 8), "{counts:?}");
            });
        });
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 1500,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn random_scenes(
        eye in eye(),
        shapes in proptest::collection::vec((shape(), 0..4u16), 1..12),
        materials in proptest::collection::vec(material(), 4),
        lights in proptest::collection::vec(light(), 1..4),
    ) {
        let objects = shapes.into_iter().map(|(shape, material)| Object::new(shape, material));
        with_accepted::<f32>(eye, objects, &materials, lights, |scene| {
            assert_eq!(differences::<f32>(scene, Settings::new(24, 18)), 0);
        });
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 250, failure_persistence: None, ..ProptestConfig::default() })]

    /// Scenes with too many objects for sets, which have a hierarchy.
    #[test]
    fn random_scenes_of_many_objects(
        eye in eye(),
        shapes in proptest::collection::vec((small_shape(), 0..4u16), 33..120),
        again in proptest::collection::vec((any::<prop::sample::Index>(), 0..4u16), 0..30),
        materials in proptest::collection::vec(material(), 4),
        lights in proptest::collection::vec(light(), 1..4),
    ) {
        // Some objects occur twice with different materials, so that the picture shows which one is hit.
        let twice: Vec<_> = again.iter().map(|(which, material)| (which.get(&shapes).0, *material)).collect();
        let objects = shapes.into_iter().chain(twice).map(|(shape, material)| Object::new(shape, material));
        with_accepted::<f32>(eye, objects, &materials, lights, |scene| {
            let settings = Settings::new(24, 18);
            assert_eq!(differences::<f32>(scene, settings), 0);
            assert_eq!(differences::<f64>(scene, settings), 0);
            if accepted::<Fixed>(scene) {
                assert_eq!(differences::<Fixed>(scene, settings), 0);
            }
        });
    }
}

/// Rays along the axes through a grid of balls, each of which occurs twice, on a floor that occurs twice.
#[test]
fn rays_along_the_axes_through_a_grid() {
    let grid = (0..125u16).map(|i| {
        let at = [i % 5, i / 5 % 5, i / 25].map(|place| f32::from(place) * 2.0 - 4.0);
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(at[0], at[1], at[2]), 1.0)), i % 3)
    });
    let floor = |material| {
        let corner = |x: f32, z: f32| Vec3::new(x * 4.0, -4.0, z * 4.0);
        let corners = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
        Object::new(Shape::Polygon(Polygon::new(Box::leak(Box::new(corners)))), material)
    };
    let objects: Vec<_> = grid.clone().rev().chain([floor(1), floor(0)]).chain(grid).collect();
    let materials = [0.2, 0.5, 0.8]
        .map(|gray| Material { reflectance: 0.4, ..Material::matte(LinearRgb::new(gray, 0.5, 1.0 - gray)) });
    let color = LinearRgb::gray(0.7);
    let lights = [
        Light::Directional { direction: Vec3::new(0.0, 1.0, 0.0), color },
        Light::Point { position: Vec3::new(0.0, 9.0, 0.0), color },
    ];
    for eye in [Vec3::new(0.0, 0.0, 9.0), Vec3::new(9.0, 1.0, 0.0), Vec3::new(1.0, 1.0, 1.0)] {
        // With an odd number of pixels, one ray runs along the axis.
        let camera = Camera {
            eye,
            target: Vec3::new(0.0, eye.y, 0.0),
            up: Vec3::new(0.0, 1.0, 0.0),
            vertical_fov: 1.0,
            lens: None,
        };
        let scene = Scene {
            camera,
            background: Background::Solid(LinearRgb::new(0.2, 0.4, 0.6)),
            objects: &objects,
            materials: &materials,
            lights: &lights,
            motions: &[],
        };
        assert_eq!(differences::<f32>(&scene, Settings::new(41, 31)), 0);
        assert_eq!(differences::<f64>(&scene, Settings::new(41, 31)), 0);
        assert_eq!(differences::<Fixed>(&scene, Settings::new(41, 31)), 0);
    }
}

/// A large glass ball, a small one and a slab seen through each other, with small balls inside and around.
/// With `many`, there are more objects than a set holds.
fn glass(ior: f32, many: bool, check: impl Fn(&Scene)) {
    let ball = |x: f32, y: f32, z: f32, radius: f32| Shape::Sphere(Sphere::new(Vec3::new(x, y, z), radius));
    let slab = Cuboid::aligned(Vec3::new(-1.5, -0.9, 1.6), Vec3::new(0.2, 0.4, 1.7));
    let glass = [ball(0.0, 0.3, 0.0, 1.2), ball(0.9, 0.8, 1.6, 0.4), Shape::Cuboid(slab)];
    let small = (0..if many { 60u16 } else { 12 }).map(|i| {
        let turn = f32::from(i) * 2.4;
        let (sine, cosine) = turn.sin_cos();
        let away = if i % 4 == 0 { 0.7 } else { 1.6 + f32::from(i % 7) * 0.4 };
        ball(away * sine, 0.1 + f32::from(i % 5) * 0.3, away * cosine, 0.12)
    });
    let floor = Shape::Plane(Plane::new(Vec3::new(0.0, -1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)));
    let objects = glass.into_iter().map(|shape| Object::new(shape, 0));
    let objects: Vec<_> = objects
        .chain(small.enumerate().map(|(i, shape)| Object::new(shape, 1 + (i % 2) as u16)))
        .chain([Object::new(floor, 3)])
        .collect();
    let matte = |r, g, b| Material::matte(LinearRgb::new(r, g, b));
    let materials = [
        Material { reflectance: 0.1, transmittance: 0.9, ior, ..matte(0.0, 0.0, 0.0) },
        matte(0.9, 0.3, 0.2),
        Material { reflectance: 0.3, ..matte(0.2, 0.5, 0.3) },
        matte(0.7, 0.7, 0.5),
    ];
    let camera = Camera {
        eye: Vec3::new(0.4, 1.1, 5.0),
        target: Vec3::new(0.0, 0.2, 0.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.7,
        lens: None,
    };
    let background = Background::Solid(LinearRgb::new(0.2, 0.4, 0.6));
    let lights = [Light::Point { position: Vec3::new(3.0, 4.0, 3.0), color: LinearRgb::gray(0.9) }];
    check(&Scene {
        camera,
        background,
        objects: &objects,
        materials: &materials,
        lights: &lights,
        motions: &[],
    });
}

fn assert_same_in_all_numbers(scene: &Scene, settings: Settings, which: impl std::fmt::Debug) {
    assert_eq!(differences::<f32>(scene, settings), 0, "{which:?}");
    assert_eq!(differences::<f64>(scene, settings), 0, "{which:?}");
    if accepted::<Fixed>(scene) {
        assert_eq!(differences::<Fixed>(scene, settings), 0, "{which:?}");
    }
}

/// An earlier version had rays of the wrong length that leave glass of a high index.
#[test]
fn glass_of_any_index() {
    for ior in [1e-3, 1.0 / 60.0, 0.05, 0.14, 0.5, 1.5, 2.4, 4.0, 7.6, 17.9, 20.0, 60.0, 1e3] {
        for many in [false, true] {
            let settings = Settings { bounces: 8, ..Settings::new(96, 72) };
            glass(ior, many, |scene| assert_same_in_all_numbers(scene, settings, (ior, many)));
        }
    }
}

/// An earlier version had rays whose length drifted away from 1 with each surface.
#[test]
fn surfaces_that_are_left_in_turn() {
    for (ior, vertical_fov) in [(1.5, 0.1), (2.0, 0.015), (3.0, 1e-3)] {
        for many in [false, true] {
            glass(ior, many, |scene| {
                // Seven panes between the eye and the other objects, all seen from behind.
                let panes = (0..7u16).map(|i| {
                    let corner = Vec3::new(-1.0, -1.0, 4.5 - f32::from(i) * 0.2);
                    let (right, up) = (Vec3::new(2.0, 0.0, 0.0), Vec3::new(0.0, 2.0, 0.0));
                    Object::new(Shape::Rectangle(Rectangle::new(corner, up, right)), 0)
                });
                let objects: Vec<_> = panes.chain(scene.objects.iter().skip(3).copied()).collect();
                let camera = Camera {
                    eye: Vec3::new(0.0, 0.3, 5.0),
                    target: Vec3::new(0.0, 0.3, 0.0),
                    vertical_fov,
                    ..scene.camera
                };
                let settings = Settings { bounces: 8, ..Settings::new(96, 72) };
                assert_same_in_all_numbers(
                    &Scene { objects: &objects, camera, ..*scene },
                    settings,
                    (ior, many),
                );
            });
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    /// A mesh with a hierarchy, and the same mesh in pieces so small that they have none.
    #[test]
    fn meshes_and_their_pieces(
        eye in eye(),
        whole in meshes(vector(), 9..80),
        material in material(),
        lights in proptest::collection::vec(light(), 1..3),
    ) {
        // On an edge between a front and a back, a mesh that is seen from one side has the color of the first
        // triangle, and its pieces have that of the front.
        let two_sided = |optics: &Optics| &*Box::leak(Box::new(Optics { sides: Sides::Both, ..*optics }));
        let optics = material.optics.map(two_sided);
        let material = Material { optics, ..material };
        let floor = || Object::new(Shape::Sphere(Sphere::new(Vec3::new(0.0, -103.0, 0.0), 100.0)), 0);
        let pieces = whole.triangles.chunks(4).map(|triangles| Mesh { triangles, ..whole });
        let pieces = pieces.map(|piece| Object::new(Shape::Mesh(piece), 0)).chain([floor()]);
        let whole = [Object::new(Shape::Mesh(whole), 0), floor()];
        let settings = Settings::new(24, 18);
        with_accepted::<f32>(eye, whole.into_iter(), &[material], lights.clone(), |whole| {
            with_accepted::<f32>(eye, pieces, &[material], lights, |pieces| {
                assert_eq!(picture::<f32>(whole, settings), picture::<f32>(pieces, settings));
                assert_eq!(picture::<f64>(whole, settings), picture::<f64>(pieces, settings));
                if accepted::<Fixed>(whole) && accepted::<Fixed>(pieces) {
                    assert_eq!(picture::<Fixed>(whole, settings), picture::<Fixed>(pieces, settings));
                }
            });
        });
    }
}
