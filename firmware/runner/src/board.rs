//! The boards: for each, the program that is built for it, and its emulator.

use anyhow::{Context, Result};

use crate::picture::{Mode, Size};

/// A board, with its program and its emulator.
#[derive(Debug)]
pub(crate) struct Board {
    pub(crate) name: &'static str,
    /// Name of the processor core.
    pub(crate) core: &'static str,
    /// Memory and output of the board, in words.
    pub(crate) description: &'static str,
    /// The compiler's name of the processor: a target triple.
    pub(crate) target: &'static str,
    pub(crate) program: ProgramSource,
    pub(crate) emulator: EmulatorKind,
    pub(crate) output: Output,
    /// Default size of the picture: what the board renders in about a second.
    pub(crate) size: Size,
    /// Whether this is not a real board: it has the processor of another board, and more memory. It runs only
    /// if it is named, for `--gallery` and for `--bench`.
    pub(crate) stands_in: bool,
}

impl Board {
    /// The board of this name.
    ///
    /// # Errors
    /// No board has the name.
    pub(crate) fn named(name: &str) -> Result<&'static Self> {
        BOARDS.iter().find(|board| board.name == name).with_context(|| format!("there is no board {name}"))
    }

    /// Whether the board's program can draw in a mode.
    ///
    /// # Errors
    /// The modes that it can draw in.
    pub(crate) fn draws(&self, mode: Mode) -> Result<(), String> {
        if self.program.modes.contains(&mode) {
            return Ok(());
        }
        let modes: Vec<&str> = self.program.modes.iter().map(|mode| mode.name()).collect();
        Err(format!(
            "its program draws only in mode {}: use --mode {}",
            modes.join(" or "),
            modes.join(" or ")
        ))
    }
}

/// The program that is built for a board.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ProgramSource {
    pub(crate) package: &'static str,
    /// The program's name in its package.
    pub(crate) binary: &'static str,
    pub(crate) features: &'static [&'static str],
    /// Whether the program uses a hardware abstraction layer (HAL). A HAL holds panics, so only the functions
    /// that render are checked for panics.
    pub(crate) has_hal: bool,
    /// The modes that it can draw in.
    pub(crate) modes: &'static [Mode],
    /// The folder in `emulated/boards` with the board's memory layout: the value of `RAYLINE_BOARD`.
    pub(crate) layout: &'static str,
}

/// The emulator of a board.
#[derive(Clone, Copy, Debug)]
pub(crate) enum EmulatorKind {
    /// QEMU.
    Qemu {
        command: &'static str,
        /// Debian's package with this command.
        package: &'static str,
        /// Arguments that choose this board.
        machine: &'static [&'static str],
    },
    /// rp2040js in Node.js, until the panel has shown `frames` frames.
    Rp2040js { frames: u32 },
}

/// The place that a board's picture goes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Output {
    /// A file, as RGB565.
    File,
    /// A panel of this size, in 16 grays, two pixels a byte.
    Panel(Size),
    /// The middle of a panel of this size, frame after frame, as RGB565. The emulator writes the whole panel
    /// to a file after each frame.
    Frames(Size),
}

impl Output {
    /// Bytes of a pixel, as the emulator writes it.
    pub(crate) fn pixel_bytes(self) -> usize {
        match self {
            Self::File | Self::Frames(_) => 2,
            Self::Panel(_) => 1,
        }
    }
}

/// A program without a HAL, which draws one picture.
const fn bare_metal(binary: &'static str, layout: &'static str) -> ProgramSource {
    ProgramSource {
        package: "rayline-emulated",
        binary,
        features: &[],
        has_hal: false,
        modes: &[Mode::Exact, Mode::Realtime, Mode::Smooth, Mode::Preview],
        layout,
    }
}

/// The Pico's program.
const fn pico(features: &'static [&'static str]) -> ProgramSource {
    ProgramSource {
        package: "rayline-pico",
        binary: "pico",
        features,
        has_hal: true,
        modes: &[Mode::Exact, Mode::Realtime, Mode::Smooth],
        layout: "",
    }
}

const fn arm(machine: &'static [&'static str]) -> EmulatorKind {
    EmulatorKind::Qemu { command: "qemu-system-arm", package: "qemu-system-arm", machine }
}

const fn riscv32(machine: &'static [&'static str]) -> EmulatorKind {
    EmulatorKind::Qemu { command: "qemu-system-riscv32", package: "qemu-system-misc", machine }
}

const OLED: Size = Size { width: 128, height: 64 };
/// The size of a common display, for cores with an FPU.
const QVGA: Size = Size { width: 320, height: 240 };
/// For cores that compute `f32` in software.
const SMALL: Size = Size { width: 64, height: 48 };
/// A quarter of a common display: the size of the Pico's frames.
const QQVGA: Size = Size { width: 160, height: 120 };

/// All boards.
pub(crate) const BOARDS: &[Board] = &[
    Board {
        name: "lm3s6965evb",
        core: "Cortex-M3",
        description: "64 KB of RAM; the picture goes to its OLED panel of 128x64 pixels in 16 grays",
        target: "thumbv7m-none-eabi",
        program: bare_metal("lm3s6965evb", "lm3s6965evb"),
        emulator: arm(&["-M", "lm3s6965evb"]),
        output: Output::Panel(OLED),
        size: OLED,
        stands_in: false,
    },
    Board {
        name: "mps2-an385",
        core: "Cortex-M3",
        description: "`f32` in software",
        target: "thumbv7m-none-eabi",
        program: bare_metal("picture", "mps2-an385"),
        emulator: arm(&["-M", "mps2-an385"]),
        output: Output::File,
        size: SMALL,
        stands_in: false,
    },
    Board {
        name: "mps2-an386",
        core: "Cortex-M4F",
        description: "FPU",
        target: "thumbv7em-none-eabihf",
        program: bare_metal("picture", "mps2-an386"),
        emulator: arm(&["-M", "mps2-an386"]),
        output: Output::File,
        size: QVGA,
        stands_in: false,
    },
    Board {
        name: "mps2-an500",
        core: "Cortex-M7",
        description: "FPU",
        target: "thumbv7em-none-eabihf",
        // Memory and clock are those of mps2-an386, so both boards run the same program.
        program: bare_metal("picture", "mps2-an386"),
        emulator: arm(&["-M", "mps2-an500"]),
        output: Output::File,
        size: QVGA,
        stands_in: false,
    },
    Board {
        name: "mps2-an505",
        core: "Cortex-M33",
        description: "FPU",
        target: "thumbv8m.main-none-eabihf",
        program: bare_metal("picture", "mps2-an505"),
        emulator: arm(&["-M", "mps2-an505"]),
        output: Output::File,
        size: QVGA,
        stands_in: false,
    },
    Board {
        name: "microbit",
        core: "Cortex-M0",
        description: "16 KB of RAM; `f32` in software",
        target: "thumbv6m-none-eabi",
        program: bare_metal("picture", "microbit"),
        emulator: arm(&["-M", "microbit"]),
        output: Output::File,
        size: SMALL,
        stands_in: false,
    },
    Board {
        name: "mps2-an385-v6m",
        core: "Cortex-M3",
        description: "code for a Cortex-M0 (ARMv6-M) on a Cortex-M3 with 4 MB of RAM: for scenes too large \
         for a microbit",
        target: "thumbv6m-none-eabi",
        program: bare_metal("picture", "mps2-an385"),
        emulator: arm(&["-M", "mps2-an385"]),
        output: Output::File,
        size: SMALL,
        stands_in: true,
    },
    Board {
        name: "riscv32",
        core: "RV32IMAC",
        description: "QEMU's machine virt; `f32` in software",
        target: "riscv32imac-unknown-none-elf",
        program: bare_metal("picture", "riscv32"),
        emulator: riscv32(&["-M", "virt", "-bios", "none"]),
        output: Output::File,
        size: SMALL,
        stands_in: false,
    },
    Board {
        name: "pico",
        core: "Cortex-M0+",
        description: "Raspberry Pi Pico with a panel of 320x240 pixels; one of its two cores traces",
        target: "thumbv6m-none-eabi",
        program: pico(&[]),
        emulator: EmulatorKind::Rp2040js { frames: 4 },
        output: Output::Frames(QVGA),
        size: QQVGA,
        stands_in: false,
    },
    Board {
        name: "pico-dual",
        core: "2x Cortex-M0+",
        description: "Raspberry Pi Pico with a panel of 320x240 pixels; both cores trace",
        target: "thumbv6m-none-eabi",
        program: pico(&["second-core"]),
        emulator: EmulatorKind::Rp2040js { frames: 4 },
        output: Output::Frames(QVGA),
        size: QQVGA,
        stands_in: false,
    },
];
