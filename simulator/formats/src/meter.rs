//! A light meter: it measures how bright the lights of a scene make the surfaces that its camera sees.
//!
//! A coarse picture is traced. For each pixel, the probe adds up the light of lights and all other light in
//! separate sums. So one picture is enough to compute the brightness for any strength of the lights.
//!
//! Large scenes take long to prepare, and most of their triangles are much smaller than these pixels. So
//! their vertices are rounded to grids (Rossignac and Borrel, "Multi-resolution 3D Approximations for
//! Rendering Complex Scenes", 1993), here of up to a pixel at their distance. Triangles that lose a corner
//! are left out; the others still meet.
//!
//! The set of shapes is that of models: the code for all shapes takes 3 s more to compile.

use core::mem::MaybeUninit;

use bumpalo::Bump;
use rayline::shape::{Instances, Mesh, Model, Shape};
use rayline::{
    Camera, Event, LinearRgb, Object, PreparedScene, Probe, Renderer, Scene, Settings, Vec3, prepared_bytes,
};

/// The pixels of the coarse picture, about.
const PIXELS: f32 = 3072.0;

/// The light of the brightest pixels. It is less than white, so that an even floor is not white.
const TARGET: f32 = 0.9;

/// The share of the pixels in the light that may become brighter.
const BRIGHTER: f32 = 0.01;

/// A pixel that is this bright without the lights does not count: it shows the sky, or a surface that emits
/// light. The lights must not become dark because of such a pixel.
const BRIGHT: f32 = 0.5;

/// The most triangles of a scene that is prepared as it is.
const MANY: usize = 20_000;

rayline::shape_set! {
    /// The shapes of models.
    enum ModelShape<'a>;
    /// `ModelShape`, prepared.
    enum PreparedModelShape {
        /// A mesh.
        Mesh(Mesh<'a>),
        /// A mesh in several places.
        Instances(Instances<'a, Mesh<'a>>),
    }
}

/// The factor for all lights of a model by which the brightest of what they light is almost white, in a
/// picture of these proportions. `None` if they light nothing that is seen. Only meshes and their instances
/// are seen.
pub(crate) fn factor(scene: &Scene<'_>, (width, height): (u32, u32)) -> Option<f32> {
    let aspect = width as f32 / height as f32;
    let lines = (PIXELS / aspect).sqrt().round().max(1.0);
    let settings = Settings::new((lines * aspect).round().max(1.0) as u32, lines as u32);
    let arena = Bump::new();
    let pixel = 2.0 * (scene.camera.vertical_fov * 0.5).tan() / lines;
    let Scene { camera, background, objects, materials, lights, motions } = *scene;
    let objects = coarse(objects, &camera, pixel, &arena);
    let scene = Scene { camera, background, objects, materials, lights, motions };
    let mut memory = vec![MaybeUninit::uninit(); prepared_bytes!(f32, scene)];
    let prepared = PreparedScene::<f32, _>::new(&scene, &mut memory).ok()?;
    let renderer = Renderer::new(&prepared, settings).ok()?;
    let (width, height) = (settings.width as u16, settings.height as u16);
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let mut factors: Vec<f32> = pixels
        .filter_map(|(x, y)| {
            let mut seen = Seen::default();
            renderer.pixel(x, y, &mut seen);
            seen.factor()
        })
        .collect();
    let brighter = (factors.len() as f32 * BRIGHTER) as usize;
    (brighter < factors.len()).then(|| *factors.select_nth_unstable_by(brighter, f32::total_cmp).1)
}

/// The objects without what is smaller than a pixel, if they have many triangles. `pixel` is the size of a
/// pixel at distance 1.
fn coarse<'a>(
    objects: &[Object<Shape<'a>>],
    camera: &Camera,
    pixel: f32,
    arena: &'a Bump,
) -> &'a [Object<ModelShape<'a>>] {
    let triangles = objects.iter().map(|object| match object.shape {
        Shape::Mesh(mesh) => mesh.triangles.len(),
        _ => 0,
    });
    let are_many = triangles.sum::<usize>() > MANY;
    let round = |vertex: &Vec3| {
        let size = ((*vertex - camera.eye).length() * pixel).max(1e-9);
        // The largest power of two up to the size.
        let cell = f32::from_bits(size.to_bits() & f32::INFINITY.to_bits());
        let round = |coordinate: f32| (coordinate / cell).round() * cell;
        Vec3::new(round(vertex.x), round(vertex.y), round(vertex.z))
    };
    let coarse_mesh = |mesh: Mesh<'a>| {
        let vertices = &*arena.alloc_slice_fill_iter(mesh.vertices.iter().map(round));
        let has_corners = |triangle: &[u16; 3]| {
            let [a, b, c] = triangle.map(|corner| vertices.get(usize::from(corner)));
            a != b && b != c && c != a
        };
        let left: Vec<_> = mesh.triangles.iter().copied().filter(has_corners).collect();
        (!left.is_empty()).then(|| Mesh { vertices, triangles: arena.alloc_slice_copy(&left), ..mesh })
    };
    let seen = objects.iter().filter_map(|object| {
        let shape = match object.shape {
            Shape::Mesh(mesh) if are_many => ModelShape::Mesh(coarse_mesh(mesh)?),
            Shape::Mesh(mesh) => ModelShape::Mesh(mesh),
            Shape::Instances(Instances { model: Model::Mesh(model), size, poses }) => {
                ModelShape::Instances(Instances { model, size, poses })
            }
            _ => return None,
        };
        Some(Object { shape, material: object.material })
    });
    arena.alloc_slice_copy(&seen.collect::<Vec<_>>())
}

/// The light of one pixel.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    /// The share of the light of the last hit that reaches the pixel.
    throughput: [f32; 3],
    /// The light of lights.
    lit: [f32; 3],
    /// All other light.
    other: [f32; 3],
}

impl Seen {
    /// The factor for the lights that brings the brightest channel to the target.
    fn factor(&self) -> Option<f32> {
        if self.other.iter().any(|other| *other >= BRIGHT) {
            return None;
        }
        let channels = self.lit.iter().zip(&self.other).filter(|(lit, _)| **lit > 0.0);
        channels.map(|(lit, other)| (TARGET - other) / lit).min_by(f32::total_cmp)
    }
}

/// Adds a share of a light.
fn add(sum: &mut [f32; 3], light: LinearRgb, share: [f32; 3]) {
    for ((sum, light), share) in sum.iter_mut().zip(light.channels()).zip(share) {
        *sum += light * share;
    }
}

impl Probe<f32> for Seen {
    fn record(&mut self, event: Event<f32>) {
        match event {
            Event::Hit { throughput, .. } => self.throughput = throughput.channels(),
            Event::Surface { shown } => add(&mut self.other, shown, self.throughput),
            Event::Light { shown, .. } => add(&mut self.lit, shown, self.throughput),
            Event::Miss { color, throughput, .. } => add(&mut self.other, color, throughput.channels()),
            Event::Ray { .. } | Event::Cut(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use rayline::{Background, Light, Material, Optics, builtin};

    use super::*;

    const SUN: Light = Light::Directional { direction: Vec3::new(0.0, 0.0, -1.0), color: LinearRgb::WHITE };

    const VIEW: Camera = Camera {
        eye: Vec3::new(0.0, 0.0, 100.0),
        target: Vec3::ZERO,
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.021,
        lens: None,
    };

    /// The factor for a scene in front of a black background, with a sun behind the camera.
    fn of(objects: &[Object<Shape<'_>>], material: Material<'_>) -> Option<f32> {
        let materials = &[material];
        let background = Background::BLACK;
        let scene = Scene { camera: VIEW, background, objects, materials, lights: &[SUN], motions: &[] };
        factor(&scene, (640, 480))
    }

    /// A ball of so many triangles along each of eight faces.
    fn ball(arena: &Bump, steps: u16) -> Object<Shape<'_>> {
        let side = steps * 2 + 1;
        let place = |count: u16| f32::from(count) / f32::from(steps) - 1.0;
        // An octahedron, unfolded to a square: its corners meet at the far end.
        let vertex = |index: u16| {
            let (x, y) = (place(index % side), place(index / side));
            let z = 1.0 - x.abs() - y.abs();
            let (x, y) = match z < 0.0 {
                true => ((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)),
                false => (x, y),
            };
            Vec3::new(x, y, z).normalized().unwrap()
        };
        let vertices = arena.alloc_slice_fill_iter((0..side * side).map(vertex));
        let quad = |index: u16| {
            let first = index / (side - 1) * side + index % (side - 1);
            [[first, first + 1, first + side], [first + 1, first + side + 1, first + side]]
        };
        let quads = (0..(side - 1) * (side - 1)).flat_map(quad);
        let triangles = arena.alloc_slice_copy(&quads.collect::<Vec<_>>());
        let mesh = Mesh { normals: Some(vertices), ..Mesh::new(vertices, triangles) };
        Object::new(Shape::Mesh(mesh), 0)
    }

    /// The light on a ball is the cosine; on the brightest hundredth of its disc it is 0.995 or more. These
    /// are 16 pixels here, which lie on a grid.
    #[test]
    fn the_brightest_hundredth_is_almost_white() {
        let gray = Material::matte(LinearRgb::gray(0.5));
        let arena = Bump::new();
        let round = of(&[ball(&arena, 49)], gray).unwrap();
        assert!((round / (1.8 / 0.995) - 1.0).abs() < 2e-3, "{round}");
        // As a mesh that is rounded to the grids: 64800 triangles, of which fewer than half stay.
        let object = ball(&arena, 90);
        let objects = [object];
        let [Object { shape: ModelShape::Mesh(rounded), .. }] = coarse(&objects, &VIEW, 0.021 / 48.0, &arena)
        else {
            unreachable!()
        };
        assert!((10_000..32_000).contains(&rounded.triangles.len()), "{}", rounded.triangles.len());
        let faceted = of(&objects, gray).unwrap();
        assert!((faceted / round - 1.0).abs() < 0.01, "{faceted}, not {round}");
    }

    #[test]
    fn surfaces_that_are_bright_by_themselves_do_not_count() {
        let arena = Bump::new();
        let ball = [ball(&arena, 49)];
        let emits = |light| Optics { emission: LinearRgb::gray(light), ..Optics::PLAIN };
        let (faint, bright) = (emits(0.25), emits(0.6));
        let of_light =
            |optics| of(&ball, Material { optics: Some(optics), ..Material::matte(LinearRgb::WHITE) });
        assert!((of_light(&faint).unwrap() - 0.65 / 0.995).abs() < 2e-3);
        assert_eq!(of_light(&bright), None);
        assert_eq!(of(&ball, Material { diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) }), None);
    }

    /// The two sums are all light of a pixel, with mirrors and glass before it.
    #[test]
    fn the_light_of_lights_and_other_light_are_all_light() {
        for builtin in builtin::all().filter(|builtin| ["whitted", "prism"].contains(&builtin.name)) {
            let mut memory = vec![MaybeUninit::uninit(); builtin.scene.bytes::<f32>()];
            let prepared = PreparedScene::<f32, _>::new(builtin.scene, &mut memory).unwrap();
            let renderer = Renderer::new(&prepared, Settings::new(32, 24)).unwrap();
            let mut has_both = false;
            for (x, y) in (0..24).flat_map(|y| (0..32).map(move |x| (x, y))) {
                let mut seen = Seen::default();
                let (light, _) = renderer.pixel(x, y, &mut seen);
                for (light, (lit, other)) in light.channels().iter().zip(seen.lit.iter().zip(&seen.other)) {
                    assert!(
                        (lit + other - light).abs() < 1e-4 * light.max(1.0),
                        "{x}, {y}: {light} {seen:?}"
                    );
                    has_both |= *lit > 0.1 && *other > 0.1;
                }
            }
            assert!(has_both, "{}", builtin.name);
        }
    }
}
