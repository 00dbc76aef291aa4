//! Caustics of baked light: photons that come over mirrors and through glass, in closed form and beside path
//! tracing.

use core::f64::consts::PI;

use bumpalo::Bump;
use rayline::shape::{Rectangle, Shape, Sphere};
use rayline::{
    Background, Camera, Figure, Fresnel, Integrator, Light, LinearRgb, Material, Object, ObjectId, Onto,
    Optics, Placed, Sampler, Sampling, Scene, Settings, Texture, Transfer, Vec3,
};
use rayline_simulator::{LightOptions, RenderOptions, bake_light, render};

use super::light::{SMALL, baked, light_on};

const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);

const CAMERA: Camera =
    Camera { eye: Vec3::new(0.0, 5.0, 5.0), target: Vec3::ZERO, up: UP, vertical_fov: 0.7, lens: None };

const SUN: Light = Light::Directional { direction: Vec3::new(0.0, -1.0, 0.0), color: LinearRgb::gray(0.002) };

/// No objects, and no light.
const EMPTY: Scene<'_> = Scene {
    camera: CAMERA,
    background: Background::BLACK,
    objects: &[],
    materials: &[],
    lights: &[],
    motions: &[],
};

/// A square on the ground around the origin, with sides of twice this length.
fn floor(half: f32) -> Object<Shape<'static>> {
    let corner = Vec3::new(-half, 0.0, -half);
    let (right, up) = (Vec3::new(2.0 * half, 0.0, 0.0), Vec3::new(0.0, 0.0, 2.0 * half));
    Object::new(Shape::Rectangle(Rectangle { corner, right, up }), 0)
}

fn ball(center: Vec3, radius: f32, material: u16) -> Object<Shape<'static>> {
    Object::new(Shape::Sphere(Sphere::new(center, radius)), material)
}

/// Glass that mirrors nothing.
fn glass(transmittance: f32, optics: Option<&Optics>) -> Material<'_> {
    Material { diffuse: 0.0, transmittance, ior: 1.5, optics, ..Material::matte(LinearRgb::gray(0.0)) }
}

const WHITE: Material<'_> = Material::matte(LinearRgb::WHITE);

/// Where a ray of the sun meets the ground below a ball of glass, by the distance of the ray from the middle;
/// and its way inside of the ball. `None` if it goes up.
fn below(distance: f64, (height, radius, ior): (f64, f64, f64)) -> Option<(f64, f64)> {
    let outside = (distance / radius).asin();
    let inside = (outside.sin() / ior).asin();
    let turned = 2.0 * (outside - inside);
    // The ray leaves the ball at this angle from the lowest point, on the other side of the axis or not.
    let place = 2.0 * inside - outside;
    let (across, above) = (radius * place.sin(), height - radius * place.cos());
    (turned < PI / 2.0).then(|| (across - above * turned.tan(), 2.0 * radius * inside.cos()))
}

/// The flux within each radius on the floor below a glass ball, where nothing else than what the ball lets
/// through arrives: 2π b db of each ring of rays, times t² at two surfaces, times exp(-2 σ R cos θ').
#[test]
fn a_glass_ball_sends_its_light_where_snell_says() {
    let (height, radius, ior, sun) = (0.7, 0.5, 1.5, f64::from(0.002f32));
    let absorbing = Optics { absorption: LinearRgb::gray(0.4), ..Optics::PLAIN };
    for (optics, absorption) in [(None, 0.0), (Some(&absorbing), 0.4)] {
        let (objects, arena) = ([floor(1.0), ball(Vec3::new(0.0, 0.7, 0.0), 0.5, 1)], Bump::new());
        let materials = [WHITE, glass(0.9, optics)];
        let options = LightOptions { budget: 128 * 128 * 3, photons: 100_000, ..SMALL };
        let lit = baked(
            &Scene { objects: &objects, materials: &materials, lights: &[SUN], ..EMPTY },
            &options,
            &arena,
        );
        let light = light_on(&lit.scene, 0);
        let side = light.len().isqrt();
        assert_eq!(side, 128);
        let area = (2.0 / side as f64).powi(2);
        let at = |index: usize| (index as f64 + 0.5) * 2.0 / side as f64 - 1.0;
        let mut worst = 0.0_f64;
        for circle in [0.1, 0.2, 0.3, 0.4] {
            let near = (0..light.len()).filter(|index| at(index % side).hypot(at(index / side)) < circle);
            let found: f64 = near.map(|index| f64::from(light[index]) * area).sum();
            const RINGS: usize = 10_000;
            let ring = |index: usize| {
                let distance = (index as f64 + 0.5) / RINGS as f64 * radius;
                let (across, way) = below(distance, (height, radius, ior))?;
                let flux = 2.0 * PI * distance * radius / RINGS as f64 * (-absorption * way).exp();
                (across.abs() < circle).then_some(flux)
            };
            let expected = sun * 0.81 * (0..RINGS).filter_map(ring).sum::<f64>();
            let share = found / expected;
            println!("absorption {absorption}, within {circle}: {share:.4} of {expected:.5}");
            worst = worst.max((share - 1.0).abs());
        }
        assert!(worst < 0.03, "{absorption}: {worst}");
    }
}

/// A sun over a mirror on the wall makes a bright rectangle on the floor: also where lamps stay on the
/// device, which shows no light of mirrors. Glass sends light to the floor only in place of the device.
#[test]
fn mirrors_make_caustics_beside_lamps_and_glass_does_not() {
    let v = Vec3::new;
    let mirror = Rectangle { corner: v(-0.5, 0.5, -0.9), right: v(1.0, 0.0, 0.0), up: v(0.0, 0.5, 0.0) };
    let objects = [floor(1.0), Object::new(Shape::Rectangle(mirror), 1)];
    let mirrors = Material { diffuse: 0.0, reflectance: 0.5, ..WHITE };
    let sun = [Light::Directional { direction: v(0.0, -1.0, -1.0), color: LinearRgb::gray(0.5) }];
    // Half of the light comes at 45°.
    let caustic = 0.5 * 0.5 * 0.5f32.sqrt();
    let materials = [WHITE, mirrors];
    for (keep_lamps, photons, inside, outside) in [
        (false, 50_000, 0.5 * 0.5f32.sqrt() + caustic, 0.5 * 0.5f32.sqrt()),
        (true, 50_000, caustic, 0.0),
        (true, 0, 0.0, 0.0),
    ] {
        let options = LightOptions { keep_lamps, photons, budget: 128 * 128 * 3, ..SMALL };
        let arena = Bump::new();
        let lit = baked(
            &Scene { objects: &objects, materials: &materials, lights: &sun, ..EMPTY },
            &options,
            &arena,
        );
        let light = light_on(&lit.scene, 0);
        // Images begin with the upper line, which is the front. The mirror is 0.5 to 1 above the floor, so
        // its light falls on z from -0.4 to 0.1.
        let (side, half) = (light.len().isqrt(), light.len().isqrt() as f32 * 0.5);
        let at = |x: f32, z: f32| light[((1.0 - z) * half) as usize * side + ((x + 1.0) * half) as usize];
        for (x, z, expected) in [
            (0.0, -0.15, inside),
            (-0.4, 0.0, inside),
            (0.4, -0.3, inside),
            (0.0, 0.3, outside),
            (-0.7, -0.15, outside),
        ] {
            let found = at(x, z);
            let place = format!("keep_lamps {keep_lamps}, {photons} photons, at {x}, {z}");
            assert!((found - expected).abs() < 0.015, "{place}: {found}, not {expected}");
        }
    }
    let (objects, materials) = ([floor(1.0), ball(v(0.0, 0.7, 0.0), 0.5, 1)], [WHITE, glass(0.9, None)]);
    let (options, arena) = (LightOptions { keep_lamps: true, ..SMALL }, Bump::new());
    let lit =
        baked(&Scene { objects: &objects, materials: &materials, lights: &[SUN], ..EMPTY }, &options, &arena);
    assert!(light_on(&lit.scene, 0).iter().all(|light| *light == 0.0));
}

/// A lamp, a ball of glass, and a floor below the surface of water: baked, and as path tracing shows them.
#[test]
fn caustics_are_as_paths_find_them() {
    let v = Vec3::new;
    let emission = Optics { emission: LinearRgb::gray(60.0), ..Optics::PLAIN };
    let clear = Optics { fresnel: Fresnel::Exact, ..Optics::PLAIN };
    let black = Material::matte(LinearRgb::gray(0.0));
    let water = Material { ior: 1.33, ..glass(1.0, Some(&clear)) };
    let materials = [
        // Dark, because light that the floor sends back to itself over the water is left out.
        Material::matte(LinearRgb::gray(0.05)),
        glass(1.0, Some(&clear)),
        Material { diffuse: 0.0, optics: Some(&emission), ..black },
        water,
    ];
    let lamp = ball(v(-1.2, 3.0, 0.8), 1.0, 2);
    let surface = Rectangle { corner: v(-3.0, 0.5, 3.0), right: v(6.0, 0.0, 0.0), up: v(0.0, 0.0, -6.0) };
    let in_air = [floor(1.5), ball(v(0.0, 0.8, 0.0), 0.6, 1), lamp];
    let in_water = [floor(1.5), Object::new(Shape::Rectangle(surface), 3), lamp];
    let settings = Settings { transfer: Transfer::Linear, bounces: 8, ..Settings::new(48, 36) };
    for (name, objects, block, most) in [("ball", &in_air, 1, 0.05), ("water", &in_water, 6, 0.03)] {
        let (lights, arena) = ([Light::Object(ObjectId(2))], Bump::new());
        let scene = Scene { objects, materials: &materials, lights: &lights, ..EMPTY };
        let options = LightOptions { budget: 128 * 128 * 3, photons: 200_000, ..SMALL };
        let lit = baked(&scene, &options, &arena);
        // Neither look at the lamp, nor at its image.
        let camera = Camera { eye: v(0.6, 3.2, 3.2), target: v(0.3, 0.1, 0.0), ..CAMERA };
        let sampling = |samples| Sampling { sampler: Sampler::Sobol, ..Sampling::new(samples) };
        let shown = |scene: &Scene<'_>, settings: Settings| -> Vec<f64> {
            let picture = render(&Scene { camera, ..*scene }, &RenderOptions::new(settings)).unwrap();
            // Neighboring pixels together, where paths have much noise.
            let (wide, high) = (48 / block, 36 / block);
            let mut sums = vec![0.0; wide * high];
            for (index, pixel) in picture.rgb.chunks(3).enumerate() {
                sums[index / 48 / block * wide + index % 48 / block] += f64::from(pixel[1]);
            }
            sums
        };
        let (integrator, rays_per_pixel) = (Integrator::PathTracing, 1 << 18);
        let traced = Settings { integrator, rays_per_pixel, sampling: sampling(2048), ..settings };
        let traced = shown(&scene, traced);
        let looked_up = Settings { sampling: sampling(16), rays_per_pixel: 1000, cutoff: 0.0, ..settings };
        let looked_up = shown(&lit.scene, looked_up);
        let all: f64 = traced.iter().sum();
        let apart: f64 = traced.iter().zip(&looked_up).map(|(a, b)| (a - b).abs()).sum();
        let (error, brighter) = (apart / all, looked_up.iter().sum::<f64>() / all);
        println!("{name}: {:.2} % from paths, {brighter:.4} of their light", 100.0 * error);
        assert!(error < most && (brighter - 1.0).abs() < 0.02, "{name}: {error}, {brighter}");
    }
}

/// What is baked depends neither on the number of threads nor on photons that nothing mirrors or refracts.
#[test]
fn the_same_light_is_baked_by_any_number_of_threads() {
    let black = Material::matte(LinearRgb::gray(0.0));
    let emission = Optics { emission: LinearRgb::gray(8.0), ..Optics::PLAIN };
    let lamp = Material { diffuse: 0.0, optics: Some(&emission), ..black };
    // The second ball takes its light from the volume.
    let objects = |material| {
        let v = Vec3::new;
        let balls = [ball(v(0.3, 0.5, 0.0), 0.3, material), ball(v(-0.5, 0.3, 0.2), 0.2, 0)];
        [floor(1.0), balls[0], balls[1], ball(v(0.0, 2.0, 0.0), 0.2, 2)]
    };
    let baked = |objects: &[Object<Shape<'_>>], photons: u32, threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let materials = [WHITE, glass(0.9, None), lamp];
            let (lights, arena) = ([Light::Object(ObjectId(3))], Bump::new());
            let options = LightOptions { photons, ..SMALL };
            let scene = Scene { objects, materials: &materials, lights: &lights, ..EMPTY };
            format!("{:?}", bake_light(&scene, &options, &arena, &|_, _| ()).unwrap())
        })
    };
    let glass = objects(1);
    let once = baked(&glass, 20_000, 1);
    assert!(once == baked(&glass, 20_000, 2) && once != baked(&glass, 0, 1));
    let matte = objects(0);
    assert!(baked(&matte, 20_000, 2) == baked(&matte, 0, 1));
}

/// A mirror on the floor sends half of the sun's light back up: in space, the mean light grows by a quarter
/// of the beam's flux over the area of the grid's only cell, and comes from below.
#[test]
fn things_that_move_are_lit_by_caustics() {
    let v = Vec3::new;
    let mirror = Rectangle { corner: v(-0.5, 0.001, -0.5), right: v(1.0, 0.0, 0.0), up: v(0.0, 0.0, 1.0) };
    let wall = Rectangle { corner: v(-1.0, 0.0, -1.0), right: v(2.0, 0.0, 0.0), up: v(0.0, 1.0, 0.0) };
    let [mirror, wall] = [(mirror, 1), (wall, 0)]
        .map(|(rectangle, material)| Object::new(Shape::Rectangle(rectangle), material));
    let objects = [floor(1.0), wall, mirror, ball(v(0.0, 0.5, 0.0), 0.1, 2)];
    let mirrors = Material { diffuse: 0.0, reflectance: 0.5, ..WHITE };
    let materials = [Material::matte(LinearRgb::gray(0.0)), mirrors, WHITE];
    let sun = [Light::Directional { direction: v(0.0, -1.0, 0.0), color: LinearRgb::WHITE }];
    // The mean, and its change along y, of the light at the one point; and the area of the cell.
    let light = |photons| {
        let (options, arena) = (LightOptions { moving: vec![ObjectId(3)], photons, ..SMALL }, Bump::new());
        let lit = baked(
            &Scene { objects: &objects, materials: &materials, lights: &sun, ..EMPTY },
            &options,
            &arena,
        );
        let map = lit.scene.materials[usize::from(lit.scene.objects[3].material.0)].maps[0];
        let Onto::AmbientLight { most } = map.onto else { panic!() };
        let Texture::Placed(Placed { figure: Figure::IrradianceVolume(volume), placement, .. }) = map.texture
        else {
            panic!()
        };
        let [mean, along] = [0, 6].map(|place| f64::from(volume.light[0][place]) / 32768.0 * f64::from(most));
        (mean, along, f64::from(placement.size.x * placement.size.z))
    };
    let ((mean, along, area), (dark, before, _)) = (light(20_000), light(0));
    let expected = 0.5 * 0.25 / area;
    println!("{:.5} and {:.5}, not {expected:.5}", mean - dark, (before - along) * 0.5);
    assert!(((mean - dark) / expected - 1.0).abs() < 0.02, "{mean}, {dark}, {expected}");
    assert!(((before - along) * 0.5 / expected - 1.0).abs() < 0.02, "{along}, {before}, {expected}");
}
