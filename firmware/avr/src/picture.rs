//! The picture: a ball that mirrors a little, on a checkered floor.

use core::mem::MaybeUninit;

use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::prelude::RgbColor;
use rayline::math::Fixed;
use rayline::shape::{Plane, Sphere};
use rayline::{
    Background, Camera, Checker, Light, LinearRgb, Material, Object, PreparedScene, Real, Renderer, Scene,
    Settings, Texture, Vec3, Workspace, prepared_bytes,
};

const WIDTH: usize = 32;
const HEIGHT: usize = 24;

rayline::shape_set! {
    enum Things;
    enum PreparedThings {
        Ball(Sphere),
        Floor(Plane),
    }
}

static SCENE: Scene<Things> = Scene {
    camera: Camera {
        eye: Vec3::new(0.0, 1.5, 5.0),
        target: Vec3::new(0.0, 0.6, 0.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.7,
        lens: None,
    },
    background: Background::Solid(LinearRgb::new(0.2, 0.4, 0.8)),
    objects: &[
        Object::new(Things::Ball(Sphere::new(Vec3::new(0.0, 1.0, 0.0), 1.0)), 0),
        Object::new(Things::Floor(Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0))), 1),
    ],
    materials: &[
        Material {
            diffuse: 0.6,
            specular: 0.4,
            shininess: 30.0,
            reflectance: 0.3,
            ..Material::matte(LinearRgb::new(0.9, 0.2, 0.1))
        },
        Material {
            color: Texture::Checker(Checker {
                even: LinearRgb::gray(0.9),
                odd: LinearRgb::gray(0.1),
                cells_per_unit: Vec3::new(1.0, 1.0, 1.0),
            }),
            ..Material::matte(LinearRgb::WHITE)
        },
    ],
    lights: &[Light::Point { position: Vec3::new(3.0, 5.0, 4.0), color: LinearRgb::WHITE }],
    motions: &[],
};

/// Draws the picture in fixed point and then in `f32`, and sends the pixels line by line, in RGB565, the high
/// byte first. Returns `None` if the scene or the settings are refused.
pub(crate) fn draw(mut send: impl FnMut(u8)) -> Option<()> {
    draw_in::<Fixed>(Workspace::<{ prepared_bytes!(Fixed, SCENE) }>::new().lend(), &mut send)?;
    draw_in::<f32>(Workspace::<{ prepared_bytes!(f32, SCENE) }>::new().lend(), &mut send)
}

/// Draws the picture in a number system, with memory for the prepared scene.
// Not inlined, so that the stack holds one of the two renderers.
#[inline(never)]
fn draw_in<R: Real>(memory: &mut [MaybeUninit<u8>], send: &mut impl FnMut(u8)) -> Option<()> {
    let scene = PreparedScene::<R, _>::new(&SCENE, memory).ok()?;
    let settings = Settings { bounces: 2, ..Settings::new(WIDTH as u32, HEIGHT as u32) };
    let renderer = Renderer::new(&scene, settings).ok()?;
    let mut line = [Rgb565::BLACK; WIDTH];
    for y in 0..HEIGHT {
        renderer.line(y as u32, &mut line).ok()?;
        line.iter().flat_map(|color| color.to_be_bytes()).for_each(&mut *send);
    }
    Some(())
}
