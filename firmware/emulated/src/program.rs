//! Renders the picture, and measures instructions and stack.

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::primitives::Rectangle;
use rayline::shape::Geometry;
use rayline::{DisplayColor, DrawError, PreparedScene, Preview, Renderer};

use crate::fpu;
use crate::meter::Meter;
use crate::picture::{
    Buffer, HEIGHT, IS_PREVIEW, LINES, Memory, Number, QUALITY, SCENE, SEGMENTS, SETTINGS, WIDTH,
};
use crate::report::Figures;
use crate::stack::PaintedStack;
use crate::{Counter, Fault};

/// Renders the picture on a display of the picture's size. Only the instructions of rendering are counted.
///
/// # Errors
/// A [`Fault`] if the scene, the settings or the display fail, or the stack is too small.
pub fn run<D>(
    memory: &mut Memory,
    buffer: &mut Buffer<D::Color>,
    counter: Counter,
    display: &mut D,
) -> Result<Figures, Fault>
where
    D: DrawTarget<Color: DisplayColor + ToBytes<Bytes: AsRef<[u8]>>>,
{
    let stack = PaintedStack::paint();
    if fpu::flushes_to_zero() {
        return Err(Fault::FlushToZero);
    }
    let scene = PreparedScene::<Number, _>::new(&SCENE, memory.lend()).map_err(|_| Fault::Scene)?;
    // Not with `?`, which would copy the renderer: it is large.
    let renderer = Renderer::new(&scene, SETTINGS);
    let Ok(renderer) = &renderer else {
        return Err(Fault::Settings);
    };
    let mut meter = Meter::new(counter, display);
    meter.resume();
    draw(renderer, &mut meter, buffer)?;
    meter.pause();
    let (instructions, digest) = (meter.instructions(), meter.digest());
    #[cfg(feature = "twin")]
    let instructions = instructions + u64::from(crate::panic::reachable_panic());
    let stack_bytes = stack.used().ok_or(Fault::Stack)?;
    Ok(Figures { digest, instructions, stack_bytes })
}

/// Draws the picture in the program's mode.
#[inline(always)]
pub(crate) fn draw<S: Geometry, D: DrawTarget<Color: DisplayColor>>(
    renderer: &Renderer<'_, '_, Number, S>,
    display: &mut D,
    buffer: &mut Buffer<D::Color>,
) -> Result<(), Fault> {
    let failed = |error| match error {
        DrawError::Display { .. } => Fault::Output,
        _ => Fault::Buffer,
    };
    if IS_PREVIEW {
        let Buffer { colors, facets, pixels, .. } = buffer;
        let mut preview = Preview::new(renderer, SEGMENTS, facets).map_err(|_| Fault::Buffer)?;
        return renderer.draw(display, preview.lend(colors, pixels)).map_err(failed);
    }
    let Some(quality) = QUALITY else { return draw_exact(renderer, display, &mut buffer.colors) };
    let quality = quality.lend(&mut buffer.colors, &mut buffer.samples);
    renderer.draw(display, quality).map_err(failed)
}

/// Draws an exact picture, a few lines at a time.
// Not inlined, so that preparing a scene does not change the machine code of tracing.
#[inline(never)]
fn draw_exact<S: Geometry, D: DrawTarget<Color: DisplayColor>>(
    renderer: &Renderer<'_, '_, Number, S>,
    display: &mut D,
    buffer: &mut [D::Color],
) -> Result<(), Fault> {
    for y in (0..HEIGHT).step_by(LINES) {
        let height = LINES.min(HEIGHT - y);
        let lines = buffer.get_mut(..WIDTH * height).ok_or(Fault::Buffer)?;
        renderer.lines(y as u32, lines, &mut ()).map_err(|_| Fault::Buffer)?;
        let area = Rectangle::new(Point::new(0, y as i32), Size::new(WIDTH as u32, height as u32));
        display.fill_contiguous(&area, lines.iter().copied()).map_err(|_| Fault::Output)?;
    }
    Ok(())
}
