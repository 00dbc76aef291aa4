//! Pictures by the core, the code under test.

use std::mem::MaybeUninit;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use rayline::{PreparedScene, RayCounts, Real, Renderer, Scene, Settings};

use crate::{Picture, Watch};

/// Draws a scene with the core in the number system `R`.
pub fn core_picture<R: Real>(scene: &Scene<'_>, settings: Settings) -> Picture {
    let (pixels, _) = render::<R>(scene, settings);
    Picture { width: settings.width, pixels }
}

/// The core's ray counts for drawing a scene in `f32`.
pub fn ray_counts(scene: &Scene<'_>, settings: Settings) -> RayCounts {
    render::<f32>(scene, settings).1
}

fn render<R: Real>(scene: &Scene<'_>, settings: Settings) -> (Vec<[u8; 3]>, RayCounts) {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R>::new(scene, &mut memory).unwrap();
    let renderer = Renderer::new(&prepared, settings).unwrap();
    let mut counts = RayCounts::default();
    let mut line = vec![Rgb888::BLACK; settings.width as usize];
    let mut pixels = Vec::new();
    for y in 0..settings.height {
        renderer.lines(y, &mut line, &mut Watch(&mut counts)).unwrap();
        pixels.extend(line.iter().map(|color| [color.r(), color.g(), color.b()]));
    }
    (pixels, counts)
}
