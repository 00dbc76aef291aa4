//! Tests of the estimates whether a scene fits boards.

use rayline::builtin::{CLASSIC, FLAKE, FLAKE_10, FLAKE_820, MESH, SPHERES, TABLE, TORUS, WHITTED};
use rayline::shape::{Instances, Mesh, Model, Pose, Shape, Sphere};
use rayline::{
    AreaLights, Integrator, Light, LinearRgb, Material, Object, ObjectId, Optics, Sampling, Scene, Settings,
    Vec3,
};
use rayline_simulator::{BOARDS, Demand, Demands};

const SETTINGS: Settings = Settings { bounces: 3, ..Settings::new(32, 24) };

fn demand(scene: &Scene<'_>, board: &str) -> Demand {
    let board = BOARDS.iter().find(|known| known.name == board).unwrap();
    Demands::new(scene, [board], SETTINGS).unwrap().0[0]
}

#[test]
fn small_scenes_fit_and_large_ones_do_not() {
    let demands = Demands::new(&CLASSIC, &BOARDS, SETTINGS).unwrap();
    assert_eq!(demands.0.len(), BOARDS.len());
    for demand in demands.0 {
        assert!(demand.stack > 1024 && demand.fits(), "{demand:?}");
        assert!(demand.mean_rays > 1.0 && f64::from(demand.worst_rays) > demand.mean_rays, "{demand:?}");
    }
    // 820 balls take more RAM than a microbit has.
    let flake = demand(&FLAKE_820, "microbit");
    assert!(!flake.fits() && flake.ram > 16 * 1024, "{flake:?}");
    assert!(demand(&FLAKE_820, "pico").fits());
}

/// `classic` has three lights, mirrors and glass: at most 15 hits of 4 rays. A lamp with a size takes 16.
#[test]
fn no_pixel_takes_more_rays_than_the_bound() {
    let counts = |scene: &Scene<'_>, settings| {
        let board = BOARDS.iter().find(|known| known.name == "pico").unwrap();
        let demand = Demands::new(scene, [board], settings).unwrap().0[0];
        assert!(u64::from(demand.worst_rays) <= demand.most_rays, "{demand:?}");
        (demand.worst_rays, demand.most_rays)
    };
    assert_eq!(counts(&CLASSIC, SETTINGS), (16, 60));
    let sampling = Sampling::new(16);
    assert_eq!(counts(&CLASSIC, Settings { sampling, ..SETTINGS }).1, 16 * 60);
    let glass = counts(&WHITTED, SETTINGS);
    assert_eq!(glass.1, (1 + 2 + 4 + 8) * (1 + WHITTED.lights.len() as u64));
    let limited = Settings { rays_per_pixel: 5, ..SETTINGS };
    assert_eq!(counts(&CLASSIC, limited).1, 5);

    let optics = Optics { emission: LinearRgb::WHITE, ..Optics::PLAIN };
    let glow = Material { optics: Some(&optics), ..Material::matte(LinearRgb::WHITE) };
    let ball = |y, radius| Shape::Sphere(Sphere::new(Vec3::new(0.0, y, 0.0), radius));
    let scene = Scene {
        objects: &[Object::new(ball(4.0, 1.0), 0), Object::new(ball(0.0, 1.0), 1)],
        materials: &[glow, Material::matte(LinearRgb::WHITE)],
        lights: &[Light::Object(ObjectId(0)), Light::Sky],
        ..SPHERES
    };
    assert_eq!(counts(&scene, SETTINGS).1, 33);
    assert_eq!(counts(&scene, Settings { area_lights: AreaLights::ClosedForm, ..SETTINGS }), (2, 2));
    // A path takes one ray to the lamp from each of its four hits.
    let (_, most) = counts(&scene, Settings { integrator: Integrator::PathTracing, ..SETTINGS });
    assert_eq!(most, 4 * 2);
}

/// Earlier estimates were as low as a quarter of the times in the README's tables.
#[test]
fn estimated_times_agree_with_measured_ones() {
    let cycles = |scene: &Scene<'_>, bounces, board| {
        let board = BOARDS.iter().find(|known| known.name == board).unwrap();
        let settings = Settings { bounces, ..Settings::new(160, 120) };
        let demand = Demands::new(scene, [board], settings).unwrap().0[0];
        demand.seconds * board.megahertz * 1e6 / (160.0 * 120.0)
    };
    // A Pico's core takes 52.77 million cycles for a picture of this size, including those for the
    // display.
    let pico = cycles(&CLASSIC, 3, "pico") * 160.0 * 120.0;
    assert!((47.5e6..54.5e6).contains(&pico), "{pico}");
    // Measured instructions of a pixel on other boards, at 1.401 cycles each.
    for (scene, bounces, board, instructions) in [
        (&CLASSIC, 3, "microbit", 1773.0),
        (&CLASSIC, 3, "bluepill", 916.0),
        (&CLASSIC, 3, "nrf52840dk", 575.0),
        (&FLAKE_10, 4, "nrf52840dk", 1445.0),
        (&FLAKE_820, 4, "nrf52840dk", 3769.0),
        (&TORUS, 3, "nrf52840dk", 1726.0),
        (&MESH, 3, "nrf52840dk", 2807.0),
    ] {
        let (estimated, measured) = (cycles(scene, bounces, board), instructions * 1.401);
        assert!((estimated / measured - 1.0).abs() < 0.03, "{board}: {estimated}, {measured}");
    }
}

/// Earlier estimates left out the 14 KB of the hierarchy.
#[test]
fn estimated_flash_includes_the_hierarchy() {
    for (scene, measured) in [(&FLAKE_10, 32616.0), (&FLAKE, 48664.0), (&FLAKE_820, 66180.0)] {
        let estimated = demand(scene, "nrf52840dk").flash as f64;
        // Large scenes take more bytes in a program than in a file.
        assert!((estimated / measured - 1.0).abs() < 0.07, "{estimated}, {measured}");
    }
    // In fixed point the hierarchy replaces code that is as large.
    let code =
        |scene| demand(scene, "bluepill").flash - rayline_scenes::to_bytes(scene).unwrap().len() as u64;
    assert_eq!(code(&FLAKE), code(&FLAKE_10));
}

/// An earlier version traced each of four thousand million pixels.
#[test]
fn some_pixels_of_large_pictures_are_traced() {
    let of_size = |width, height| {
        let board = BOARDS.iter().find(|known| known.name == "pico2").unwrap();
        let settings = Settings { bounces: 3, ..Settings::new(width, height) };
        Demands::new(&CLASSIC, [board], settings).unwrap().0[0]
    };
    let (small, large) = (of_size(640, 480), of_size(64000, 48000));
    assert_eq!((small.step, large.step), (1, 77));
    assert!((large.mean_rays / small.mean_rays - 1.0).abs() < 0.01, "{large:?} {small:?}");
    assert!((large.seconds / small.seconds / 1e4 - 1.0).abs() < 0.01, "{large:?} {small:?}");
}

#[test]
fn more_kinds_of_shapes_take_more() {
    let (spheres, table) = (demand(&SPHERES, "pico"), demand(&TABLE, "pico"));
    assert!(table.flash > spheres.flash + 8 * 1024, "{table:?} {spheres:?}");
    assert!(table.seconds > spheres.seconds);
    // A board with an FPU is faster.
    assert!(demand(&TABLE, "blackpill").seconds < demand(&TABLE, "bluepill").seconds);
}

#[test]
fn models_of_instances_are_in_ram_and_meshes_by_themselves_in_flash() {
    let mesh = Mesh::new(&TRIANGLE, &[[0, 1, 2]]);
    let poses = [Pose::at(Vec3::ZERO)];
    let model = Model::Mesh(mesh);
    let [alone, instance] = [Shape::Mesh(mesh), Shape::Instances(Instances::new(&model, &poses))]
        .map(|shape| demand(&Scene { objects: &[Object::new(shape, 0)], ..SPHERES }, "pico"));
    assert!(instance.ram > alone.ram && alone.flash > instance.flash, "{instance:?} {alone:?}");
    assert!(instance.flash > demand(&SPHERES, "pico").flash);
}

const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];

#[test]
fn scenes_that_cannot_be_drawn_are_refused() {
    let settings = Settings { bounces: 99, ..SETTINGS };
    assert!(Demands::new(&CLASSIC, &BOARDS, settings).is_err());
}
