//! The reasons why a program ends early.

/// The reason why a program ends early.
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
    /// The display, or the file of the picture, failed.
    Output,
    /// The host does not accept the report.
    Host,
    /// The stack grew into the statics.
    Stack,
    /// The processor raised a fault.
    Processor,
}

impl Fault {
    /// The reason in words, and what to do about it.
    pub(crate) fn message(self) -> &'static str {
        match self {
            Self::FlushToZero => {
                "the floating-point unit flushes small numbers to zero: clear the bit FZ of FPSCR"
            }
            Self::Scene => "the scene was refused: `rayline check` says why",
            Self::Settings => "the settings were refused: choose fewer --bounces or a smaller --size",
            Self::Buffer => "the buffer does not fit the picture: this is an error of the program, report it",
            Self::Input => "the file of scenes cannot be read: this is an error of the program, report it",
            Self::Output => "the picture cannot be written: make room on the host's disk",
            Self::Host => "the host does not accept the report: run the program by `cargo boards`",
            Self::Stack => "the stack is too small: choose a smaller --size, or --small",
            Self::Processor => {
                "the processor raised a hard fault: this is an error of the program, report it"
            }
        }
    }
}
