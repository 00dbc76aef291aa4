//! Tests of light transport against results that can be computed by hand, in f32 and in f64.

use std::mem::MaybeUninit;

use rayline::shape::{Plane, Polygon, Shape, Sphere};
use rayline::{
    Background, Camera, Event, Light, LinearRgb, Material, Object, Optics, PreparedScene, Probe, RayCounts,
    RayKind, Real, Renderer, Scene, Settings, Vec3,
};
use rayline_tests::Watch;

/// A camera at (0, 0, 5) that looks along the negative z axis.
pub(super) const CAMERA: Camera = Camera {
    eye: Vec3::new(0.0, 0.0, 5.0),
    target: Vec3::ZERO,
    up: Vec3::new(0.0, 1.0, 0.0),
    vertical_fov: 0.5,
    lens: None,
};

/// A material without diffuse light.
pub(super) const DARK: Material = Material { diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) };
const GLASS: Material = Material { transmittance: 1.0, ior: 1.5, ..DARK };

fn scene<'a>(
    objects: &'a [Object<Shape<'a>>],
    materials: &'a [Material<'a>],
    lights: &'a [Light],
) -> Scene<'a> {
    Scene { camera: CAMERA, background: Background::BLACK, objects, materials, lights, motions: &[] }
}

/// The light that the camera sees straight ahead, and the events on the way.
fn look<R: Real, P: Probe<R> + Default>(scene: &Scene, settings: Settings) -> (LinearRgb, P) {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R, _>::new(scene, &mut memory).expect("a legal scene");
    let renderer = Renderer::new(&prepared, settings).expect("legal settings");
    let mut probe = P::default();
    let (light, _) = renderer.pixel(0, 0, &mut Watch(&mut probe));
    (light.to_f32(), probe)
}

const ONE_PIXEL: Settings = Settings { cutoff: 0.0, bounces: 16, ..Settings::new(1, 1) };

/// Asserts the gray that the camera sees straight ahead, in both number systems.
#[track_caller]
fn assert_sees(scene: &Scene, expected: f64) {
    for (light, _) in [look::<f32, RayCounts>(scene, ONE_PIXEL), look::<f64, RayCounts>(scene, ONE_PIXEL)] {
        assert!((f64::from(light.r) - expected).abs() < 1e-5, "{light:?}, not {expected}");
        assert_eq!((light.r, light.r), (light.g, light.b));
    }
}

/// A ball of radius 1 at the origin.
fn ball(material: u16) -> Object<Shape<'static>> {
    sphere(Vec3::ZERO, 1.0, material)
}

fn sphere(center: Vec3, radius: f32, material: u16) -> Object<Shape<'static>> {
    Object::new(Shape::Sphere(Sphere::new(center, radius)), material)
}

/// A wall through (0, 0, z), orthogonal to the line of sight and then turned by `degrees` about the y axis.
pub(super) fn wall(z: f32, degrees: f32, material: u16) -> Object<Shape<'static>> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Object::new(Shape::Plane(Plane::new(Vec3::new(0.0, 0.0, z), Vec3::new(sin, 0.0, cos))), material)
}

fn point_light(x: f32, y: f32, z: f32) -> Light {
    Light::Point { position: Vec3::new(x, y, z), color: LinearRgb::WHITE }
}

/// A probe that records all rays but shadow rays, with their directions.
#[derive(Default)]
struct Rays(Vec<(RayKind, [f64; 3], f64)>);

impl<R: Real> Probe<R> for Rays {
    fn record(&mut self, event: Event<R>) {
        if let Event::Ray { kind, ray, throughput, .. } = event {
            let d = ray.direction.to_f32();
            self.0.push((kind, [d.x, d.y, d.z].map(f64::from), f64::from(throughput.to_f32())));
        }
    }
}

#[test]
fn without_objects_the_background_is_seen() {
    let empty = Scene { background: Background::gray(0.3), ..scene(&[], &[], &[]) };
    assert_sees(&empty, f64::from(0.3f32));
}

#[test]
fn without_lights_only_ambient_is_seen() {
    let material = Material { ambient: 0.25, ..Material::matte(LinearRgb::gray(0.5)) };
    assert_sees(&scene(&[ball(0)], &[material], &[]), 0.125);
}

/// A probe that sums the light of all hits.
#[derive(Default)]
struct Parts([f64; 3]);

impl<R: Real> Probe<R> for Parts {
    fn record(&mut self, event: Event<R>) {
        if let Event::Surface { shown } | Event::Light { shown, .. } = event {
            let LinearRgb { r, g, b } = shown.to_f32();
            self.0.iter_mut().zip([r, g, b]).for_each(|(sum, part)| *sum += f64::from(part));
        }
    }
}

/// Earlier events had the light of lights, but not ambient light and emission.
#[test]
fn the_light_in_events_adds_up_to_the_pixel() {
    let glowing = Optics { emission: LinearRgb::new(0.3, 0.2, 0.1), ..Optics::PLAIN };
    let matte = Material { ambient: 0.25, ..Material::matte(LinearRgb::new(0.5, 0.25, 1.0)) };
    let shiny = Material { specular: 0.5, shininess: 3.0, optics: Some(&glowing), ..matte };
    let dim = Light::Ambient { color: LinearRgb::new(1.0, 0.5, 0.5) };
    let unlit = Material { optics: Some(&glowing), ..DARK };
    for material in [matte, shiny, unlit] {
        let lights = [point_light(1.0, 0.0, 4.0), dim, point_light(-1.0, 2.0, 5.0)];
        let objects = [ball(0)];
        let (light, Parts(sum)) = look::<f64, Parts>(&scene(&objects, &[material], &lights), ONE_PIXEL);
        for (seen, said) in [light.r, light.g, light.b].map(f64::from).into_iter().zip(sum) {
            assert!((seen - said).abs() < 1e-6 && said > 0.0, "{light:?}, said to be {sum:?}");
        }
    }
}

#[test]
fn lambert_is_the_cosine() {
    for degrees in [0.0f32, 30.0, 60.0, 89.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let material = Material { diffuse: 0.8, ..Material::matte(LinearRgb::gray(0.5)) };
        let sun =
            Light::Directional { direction: Vec3::new(-sin, 0.0, -cos) * 3.0, color: LinearRgb::gray(2.0) };
        assert_sees(&scene(&[ball(0)], &[material], &[sun]), 0.8 * 0.5 * 2.0 * f64::from(cos));
    }
}

#[test]
fn light_does_not_fall_off_with_distance() {
    let material = Material::matte(LinearRgb::WHITE);
    for distance in [2.0, 20.0, 2e4] {
        assert_sees(&scene(&[ball(0)], &[material], &[point_light(0.0, 0.0, distance)]), 1.0);
    }
}

#[test]
fn a_light_on_the_far_side_gives_nothing() {
    let shiny = Material { specular: 1.0, shininess: 0.0, ..Material::matte(LinearRgb::WHITE) };
    assert_sees(&scene(&[wall(0.0, 0.0, 0)], &[shiny], &[point_light(0.0, 1.0, -3.0)]), 0.0);
}

#[test]
fn surfaces_have_two_sides() {
    let material = Material::matte(LinearRgb::WHITE);
    let lights = [point_light(0.0, 0.0, 4.0)];
    assert_sees(&scene(&[wall(0.0, 0.0, 0)], &[material], &lights), 1.0);
    assert_sees(&scene(&[wall(0.0, 180.0, 0)], &[material], &lights), 1.0);
}

#[test]
fn phong_is_the_power_of_the_cosine_to_the_mirrored_ray() {
    // The wall mirrors the line of sight back; the light is 20° beside it.
    for (shininess, degrees) in [(1.0f32, 20.0f32), (10.0, 20.0), (50.0, 5.0), (3.0827, 40.0)] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let material = Material { specular: 0.5, shininess, ..DARK };
        let sun = Light::Directional { direction: Vec3::new(-sin, 0.0, -cos), color: LinearRgb::WHITE };
        let expected = 0.5 * f64::from(cos).powf(f64::from(shininess));
        assert_sees(&scene(&[wall(0.0, 0.0, 0)], &[material], &[sun]), expected);
    }
}

#[test]
fn objects_in_front_of_a_light_block_it_and_those_behind_do_not() {
    let material = Material::matte(LinearRgb::WHITE);
    let floor = wall(-2.0, 0.0, 0);
    // The blocker is on the way to the light, but not on the line of sight.
    let blocker = |at: f32| sphere(Vec3::new(at, 0.0, at - 2.0), 0.5, 0);
    let light = [point_light(4.0, 0.0, 2.0)];
    let lit = 0.5f64.sqrt();
    assert_sees(&scene(&[floor], &[material], &light), lit);
    assert_sees(&scene(&[floor, blocker(2.0)], &[material], &light), 0.0);
    assert_sees(&scene(&[floor, blocker(5.0)], &[material], &light), lit);
    assert_sees(&scene(&[blocker(2.0), floor, blocker(5.0)], &[material], &light), 0.0);
}

#[test]
fn every_transparent_surface_scales_the_light() {
    let clear = Material { transmittance: 0.5, ior: 1.5, ..DARK };
    let floor = wall(-2.0, 0.0, 0);
    let glass = |at: f32| sphere(Vec3::new(at, 0.0, at - 2.0), 0.4, 1);
    // A pane on the way to the light.
    let corners = [(2.7, -0.3), (3.3, -0.3), (3.3, 0.3), (2.7, 0.3)].map(|(x, y)| Vec3::new(x, y, 4.0 - x));
    let pane = Object::new(Shape::Polygon(Polygon::new(&corners)), 1);
    let materials = [Material::matte(LinearRgb::WHITE), clear];
    let light = [point_light(4.0, 0.0, 2.0)];
    let lit = 0.5f64.sqrt();
    assert_sees(&scene(&[floor, glass(2.0)], &materials, &light), lit * 0.25);
    assert_sees(&scene(&[glass(1.0), floor, glass(2.0)], &materials, &light), lit * 0.0625);
    assert_sees(&scene(&[floor, pane], &materials, &light), lit * 0.5);
}

#[test]
fn more_layers_than_are_followed_block_and_are_counted() {
    let clear = Material { transmittance: 0.9, ..DARK };
    let floor = wall(-2.0, 0.0, 0);
    let glass = |at: f32| sphere(Vec3::new(at, 0.0, at - 2.0), 0.1, 1);
    let materials = [Material::matte(LinearRgb::WHITE), clear];
    let light = [point_light(6.0, 0.0, 4.0)];
    let layers = |count: u8| {
        let mut objects = vec![floor];
        objects.extend((1..=count).map(|i| glass(f32::from(i))));
        look::<f32, RayCounts>(&scene(&objects, &materials, &light), ONE_PIXEL)
    };
    let (light_through, counts) = layers(4);
    assert!((f64::from(light_through.r) - 0.5f64.sqrt() * 0.9f64.powi(8)).abs() < 1e-5);
    assert_eq!(counts.cut_shadow_layers, 0);
    let (light_through, counts) = layers(5);
    assert_eq!((light_through.r, counts.cut_shadow_layers), (0.0, 1));
}

#[test]
fn a_light_on_or_inside_a_surface_is_legal() {
    let material = Material { specular: 0.5, shininess: 5.0, ..Material::matte(LinearRgb::WHITE) };
    for z in [0.0, 1.0, 0.999_999, 1.000_001, -1.0] {
        let lights = [point_light(0.0, 0.0, z)];
        let (light, _) = look::<f32, RayCounts>(&scene(&[ball(0)], &[material], &lights), ONE_PIXEL);
        assert!(light.r.is_finite() && (0.0..=1.5).contains(&light.r), "{z}: {light:?}");
    }
}

#[test]
fn a_mirror_shows_what_is_beside() {
    // The mirror is turned by 45° and shows a white ball on the right, under ambient light.
    let mirror = Material { reflectance: 0.75, ..DARK };
    let glow = Material { ambient: 1.0, ..DARK };
    let square: [Vec3; 4] = [
        Vec3::new(-1.0, -1.0, 1.0),
        Vec3::new(1.0, -1.0, -1.0),
        Vec3::new(1.0, 1.0, -1.0),
        Vec3::new(-1.0, 1.0, 1.0),
    ];
    let objects =
        [Object::new(Shape::Polygon(Polygon::new(&square)), 0), sphere(Vec3::new(9.0, 0.0, 0.0), 1.0, 1)];
    let materials = [mirror, glow];
    let scene = scene(&objects, &materials, &[]);
    assert_sees(&scene, 0.75);
    let (_, rays) = look::<f64, Rays>(&scene, ONE_PIXEL);
    let [_, (kind, [x, y, z], throughput)] = rays.0[..] else { panic!("two rays") };
    assert_eq!(kind, RayKind::Reflected);
    assert!((x - 1.0).abs() < 1e-6 && y.abs() < 1e-6 && z.abs() < 1e-6);
    assert!((throughput - 0.75).abs() < 1e-6);
}

#[test]
fn snell_bends_light() {
    for degrees in [0.0f32, 10.0, 30.0, 60.0, 80.0] {
        let objects = [wall(0.0, degrees, 0)];
        let (_, rays) = look::<f64, Rays>(&scene(&objects, &[GLASS], &[]), ONE_PIXEL);
        let refracted = rays.0.iter().find(|ray| ray.0 == RayKind::Refracted).expect("a refracted ray");
        let [x, _, z] = refracted.1;
        // The normal is turned by this angle, and the refracted ray lies between the line of sight and the
        // normal.
        let theta = f64::from(degrees).to_radians();
        let bent = theta - (theta.sin() / 1.5).asin();
        assert!((x - -bent.sin()).abs() < 1e-6 && (z - -bent.cos()).abs() < 1e-6, "{degrees}: {refracted:?}");
    }
}

#[test]
fn snell_bends_light_back_when_it_leaves() {
    // The front of the wall faces away from the camera.
    let objects = [wall(0.0, 180.0 + 20.0, 0)];
    let (_, rays) = look::<f64, Rays>(&scene(&objects, &[GLASS], &[]), ONE_PIXEL);
    let refracted = rays.0.iter().find(|ray| ray.0 == RayKind::Refracted).expect("a refracted ray");
    let theta = 20f64.to_radians();
    let bent = (theta.sin() * 1.5).asin() - theta;
    assert!((refracted.1[0] - bent.sin()).abs() < 1e-6, "{refracted:?}");
}

#[test]
fn total_internal_reflection_mirrors_everything() {
    // The critical angle of glass is 41.8°.
    let material = Material { reflectance: 0.1, transmittance: 0.8, ..GLASS };
    for (degrees, total) in [(41.0, false), (42.0, true), (60.0, true)] {
        let objects = [wall(0.0, 180.0 + degrees, 0)];
        let (_, rays) = look::<f64, Rays>(&scene(&objects, &[material], &[]), ONE_PIXEL);
        let share = |kind| rays.0.iter().find(|ray| ray.0 == kind).map(|ray| ray.2);
        let mirrored = share(RayKind::Reflected).expect("a mirrored ray");
        assert!((mirrored - if total { 0.9 } else { 0.1 }).abs() < 1e-6, "{degrees}: {mirrored}");
        assert_eq!(share(RayKind::Refracted).is_none(), total);
    }
}

#[test]
fn an_index_of_one_is_straight_through_with_the_same_bits() {
    let clear = Material { ior: 1.0, ..GLASS };
    let background = LinearRgb::new(0.1, 0.5, 0.9);
    let objects = [ball(0), wall(-3.0, 33.0, 0)];
    let materials = [clear];
    let scene = Scene { background: background.into(), ..scene(&objects, &materials, &[]) };
    let (light, rays) = look::<f32, Rays>(&scene, ONE_PIXEL);
    assert_eq!(light, background);
    assert_eq!(rays.0.len(), 4);
    assert!(rays.0.iter().all(|ray| ray.1 == rays.0[0].1));
}

#[test]
fn in_a_white_furnace_a_lossless_ball_is_invisible() {
    // 0.4 of the light gets inside. Each inner bounce keeps 0.6 of it, and the light after the last bounce is
    // left out.
    let material = Material { reflectance: 0.6, transmittance: 0.4, ..GLASS };
    let (objects, materials) = ([ball(0)], [material]);
    let furnace = Scene { background: Background::gray(1.0), ..scene(&objects, &materials, &[]) };
    assert_sees(&furnace, 1.0 - 0.4 * 0.6f64.powi(15));
    for bounces in [1, 2, 5] {
        let (light, counts) = look::<f64, RayCounts>(&furnace, Settings { bounces, ..ONE_PIXEL });
        let lost = 0.4 * 0.6f64.powi(i32::from(bounces) - 1);
        assert!((f64::from(light.r) - (1.0 - lost)).abs() < 1e-5, "{bounces}: {light:?}");
        assert!(counts.cut_bounces > 0);
    }
}

#[test]
fn facing_mirrors_end_at_the_bound_and_are_counted() {
    let mirror = Material { reflectance: 1.0, ambient: 0.01, ..DARK };
    let objects = [wall(0.0, 0.0, 0), wall(7.0, 0.0, 0)];
    let (light, counts) = look::<f64, RayCounts>(&scene(&objects, &[mirror], &[]), ONE_PIXEL);
    assert!((f64::from(light.r) - 0.17).abs() < 1e-6, "17 hits of 0.01 each, not {light:?}");
    assert_eq!((counts.reflected, counts.cut_bounces), (16, 1));
}

#[test]
fn dim_rays_are_cut_off_and_counted() {
    let mirror = Material { reflectance: 0.5, ..DARK };
    let objects = [wall(0.0, 0.0, 0), wall(7.0, 0.0, 0)];
    let settings = Settings { cutoff: 0.1, ..ONE_PIXEL };
    let (_, counts) = look::<f32, RayCounts>(&scene(&objects, &[mirror], &[]), settings);
    // The shares are 1/2, 1/4 and 1/8; 1/16 is cut off.
    assert_eq!((counts.reflected, counts.cut_throughput), (3, 1));
}

#[test]
fn a_tree_of_rays_ends_with_its_budget_and_is_counted() {
    let material = Material { reflectance: 0.5, transmittance: 0.5, specular: 0.1, ..GLASS };
    let objects = [ball(0), wall(-3.0, 0.0, 0), wall(8.0, 180.0, 0)];
    let lights = [point_light(1.0, 2.0, 4.0), point_light(-1.0, 2.0, 4.0)];
    let materials = [material];
    let scene = scene(&objects, &materials, &lights);
    for rays_per_pixel in [1, 2, 3, 10, 100, 1000] {
        let settings = Settings { rays_per_pixel, ..ONE_PIXEL };
        let (light, counts) = look::<f32, RayCounts>(&scene, settings);
        let spent = counts.total();
        assert_eq!(spent, u64::from(rays_per_pixel));
        assert!(counts.cut_rays >= 1 && light.r.is_finite());
    }
}

#[test]
fn of_two_objects_in_the_same_place_the_first_is_seen() {
    let red = Material { ambient: 1.0, ..DARK };
    let black = DARK;
    assert_sees(&scene(&[ball(0), ball(1)], &[red, black], &[]), 1.0);
    assert_sees(&scene(&[ball(1), ball(0)], &[red, black], &[]), 0.0);
    assert_sees(&scene(&[wall(0.0, 0.0, 0), wall(0.0, 0.0, 1)], &[red, black], &[]), 1.0);
}

#[test]
fn inside_an_object_its_inner_side_is_seen() {
    let material = Material { ambient: 0.5, ..DARK };
    let around = sphere(CAMERA.eye, 3.0, 0);
    assert_sees(&scene(&[around], &[material], &[]), 0.5);
}
