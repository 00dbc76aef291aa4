//! The program itself: renders the picture, and counts what that takes.

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::primitives::Rectangle;
use rayline::shape::Geometry;
use rayline::{DisplayColor, DrawError, PreparedScene, Renderer};

use crate::InstructionCounter;
use crate::fpu;
use crate::meter::Meter;
use crate::picture::{Buffer, HEIGHT, LINES, Memory, Number, QUALITY, SCENE, SETTINGS, WIDTH};
use crate::report::Figures;
use crate::stack::PaintedStack;

/// Why the program cannot go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The floating-point unit flushes small numbers to zero.
    FlushToZero,
    /// The scene was refused.
    Scene,
    /// The settings were refused.
    Settings,
    /// The buffer does not fit the picture.
    Buffer,
    /// The file of scenes cannot be read.
    Input,
    /// The display or the file failed.
    Output,
    /// The host does not take what the program tells.
    Host,
    /// The stack grew into the statics.
    Stack,
    /// The processor raised a fault.
    Processor,
}

impl Fault {
    /// What happened, in words.
    pub(crate) fn message(self) -> &'static str {
        match self {
            Self::FlushToZero => "the floating-point unit flushes small numbers to zero (FPSCR.FZ)",
            Self::Scene => "the scene was refused",
            Self::Settings => "the settings were refused",
            Self::Buffer => "the buffer does not fit the picture",
            Self::Input => "the file of scenes cannot be read",
            Self::Output => "the picture could not be put out",
            Self::Host => "the host does not listen",
            Self::Stack => "the stack is too small",
            Self::Processor => "the processor raised a hard fault",
        }
    }
}

/// Renders the picture on a display that is as large as the picture. Counted are the instructions of rendering alone.
///
/// # Errors
/// What went wrong.
pub fn run<D>(
    memory: &mut Memory,
    buffer: &mut Buffer<D::Color>,
    counter: &impl InstructionCounter,
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
    // Large: it stays where it is, as `?` would copy it.
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

/// Draws in the mode that was chosen.
#[inline(always)]
pub(crate) fn draw<S: Geometry, D: DrawTarget<Color: DisplayColor>>(
    renderer: &Renderer<'_, '_, Number, S>,
    display: &mut D,
    buffer: &mut Buffer<D::Color>,
) -> Result<(), Fault> {
    let Some(quality) = QUALITY else { return draw_exact(renderer, display, &mut buffer.colors) };
    let quality = quality.lend(&mut buffer.colors, &mut buffer.samples);
    renderer.draw(display, quality).map_err(|error| match error {
        DrawError::Display { .. } => Fault::Output,
        _ => Fault::Buffer,
    })
}

/// Draws some lines at a time: the way that spends nothing on anything but pixels.
// A function of its own: how the compiler puts tracing together shall not hang on how a scene is prepared.
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
