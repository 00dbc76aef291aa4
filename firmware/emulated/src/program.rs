//! The program itself: renders the picture, and counts what that takes.

use embedded_graphics::pixelcolor::raw::ToBytes;
use rayline::{Digest, DisplayColor, PreparedScene, Renderer};

use crate::InstructionCounter;
use crate::fpu;
use crate::picture::{HEIGHT, Memory, Number, SCENE, SETTINGS, WIDTH};
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
    /// The line buffer does not fit the picture.
    Line,
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
            Self::Line => "the line buffer does not fit the picture",
            Self::Output => "the picture could not be put out",
            Self::Host => "the host does not listen",
            Self::Stack => "the stack is too small",
            Self::Processor => "the processor raised a hard fault",
        }
    }
}

/// Renders the picture into `line`, line after line, and hands each to `show`. Counted are the instructions of
/// rendering alone.
///
/// # Errors
/// What went wrong.
pub fn run<C: DisplayColor + ToBytes<Bytes: AsRef<[u8]>>>(
    memory: &mut Memory,
    line: &mut [C; WIDTH],
    counter: &impl InstructionCounter,
    mut show: impl FnMut(u32, &[C; WIDTH]) -> Result<(), Fault>,
) -> Result<Figures, Fault> {
    let stack = PaintedStack::paint();
    if fpu::flushes_to_zero() {
        return Err(Fault::FlushToZero);
    }
    let scene = PreparedScene::<Number, _>::new(SCENE, memory.lend()).map_err(|_| Fault::Scene)?;
    let renderer = Renderer::new(&scene, SETTINGS).map_err(|_| Fault::Settings)?;
    let mut digest = Digest::new();
    let mut instructions = 0;
    for y in 0..HEIGHT as u32 {
        let before = counter.now();
        renderer.line(y, line).map_err(|_| Fault::Line)?;
        instructions += counter.now() - before;
        for color in &*line {
            digest.update(color.to_le_bytes().as_ref());
        }
        show(y, line)?;
    }
    #[cfg(feature = "twin")]
    let instructions = instructions + u64::from(crate::panic::reachable_panic());
    let stack_bytes = stack.used().ok_or(Fault::Stack)?;
    Ok(Figures { digest: digest.value(), instructions, stack_bytes })
}
