//! The boards that the program runs on.

use crate::picture::{Mode, Size};

/// A board: what it is, and how it is built for and emulated.
#[derive(Debug)]
pub(crate) struct Board {
    pub(crate) name: &'static str,
    /// Name of the processor core.
    pub(crate) core: &'static str,
    /// What is special about it.
    pub(crate) description: &'static str,
    /// What the compiler calls the processor.
    pub(crate) target: &'static str,
    pub(crate) program: Source,
    pub(crate) emulator: Emulator,
    pub(crate) output: Output,
    /// Size of the picture, if none is asked for.
    pub(crate) size: Size,
    /// Whether there is no such board: it stands in for one with less memory, and runs only where it is named and for the gallery.
    pub(crate) stands_in: bool,
}

impl Board {
    /// Makes sure that the board's program can draw in a mode.
    pub(crate) fn draws(&self, mode: Mode) -> Result<(), String> {
        if self.program.modes.contains(&mode) {
            return Ok(());
        }
        let modes: Vec<&str> = self.program.modes.iter().map(|mode| mode.name()).collect();
        Err(format!("its program draws only in mode {}", modes.join(" or ")))
    }
}

/// What is built for a board.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source {
    pub(crate) package: &'static str,
    /// The program's name in its package.
    pub(crate) binary: &'static str,
    pub(crate) features: &'static [&'static str],
    /// Whether it stands on a hardware abstraction layer. Those have panics, so that of such a program only the
    /// rendering is held to have none.
    pub(crate) has_hal: bool,
    /// How it can draw.
    pub(crate) modes: &'static [Mode],
    /// The folder with the board's memory layout, where a program for several boards asks for it.
    pub(crate) layout: &'static str,
}

/// The program that emulates a board.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Emulator {
    /// QEMU.
    Qemu {
        command: &'static str,
        /// Debian's package that holds it.
        package: &'static str,
        /// Arguments that make it this board.
        machine: &'static [&'static str],
    },
    /// rp2040js in Node.js, until so many frames have been shown.
    Rp2040js { frames: u32 },
}

/// Where a board's picture goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Output {
    /// To a file, as RGB565.
    File,
    /// To a panel of this size, in 16 grays, two pixels a byte.
    Panel(Size),
    /// To the middle of a panel of this size, frame after frame, as RGB565. The emulator hands out the whole panel
    /// after each frame.
    Frames(Size),
}

impl Output {
    /// Bytes of each pixel that is handed out.
    pub(crate) fn pixel_bytes(self) -> usize {
        match self {
            Self::File | Self::Frames(_) => 2,
            Self::Panel(_) => 1,
        }
    }
}

/// The program that has nothing but the processor under it: each board has a folder in `emulated/src/bin`.
const fn on_its_own(name: &'static str) -> Source {
    Source {
        package: "rayline-emulated",
        binary: name,
        features: &[],
        has_hal: false,
        modes: &[Mode::Exact, Mode::Realtime],
        layout: name,
    }
}

const fn pico(features: &'static [&'static str]) -> Source {
    Source {
        package: "rayline-pico",
        binary: "pico",
        features,
        has_hal: true,
        modes: &[Mode::Exact, Mode::Realtime],
        layout: "",
    }
}

const fn arm(machine: &'static [&'static str]) -> Emulator {
    Emulator::Qemu { command: "qemu-system-arm", package: "qemu-system-arm", machine }
}

const fn riscv32(machine: &'static [&'static str]) -> Emulator {
    Emulator::Qemu { command: "qemu-system-riscv32", package: "qemu-system-misc", machine }
}

const OLED: Size = Size { width: 128, height: 64 };
/// A common display, for cores with a floating-point unit.
const QVGA: Size = Size { width: 320, height: 240 };
/// For cores that compute floating-point numbers in software.
const SMALL: Size = Size { width: 64, height: 48 };
/// A quarter of a common display: what the Pico's frames have.
const QQVGA: Size = Size { width: 160, height: 120 };

/// All boards.
pub(crate) const BOARDS: &[Board] = &[
    Board {
        name: "lm3s6965evb",
        core: "Cortex-M3",
        description: "64 KB of RAM; the picture goes to its OLED panel of 128x64 pixels in 16 grays",
        target: "thumbv7m-none-eabi",
        program: on_its_own("lm3s6965evb"),
        emulator: arm(&["-M", "lm3s6965evb"]),
        output: Output::Panel(OLED),
        size: OLED,
        stands_in: false,
    },
    Board {
        name: "mps2-an385",
        core: "Cortex-M3",
        description: "floating-point numbers in software",
        target: "thumbv7m-none-eabi",
        program: on_its_own("mps2-an385"),
        emulator: arm(&["-M", "mps2-an385"]),
        output: Output::File,
        size: SMALL,
        stands_in: false,
    },
    Board {
        name: "mps2-an386",
        core: "Cortex-M4F",
        description: "floating-point unit",
        target: "thumbv7em-none-eabihf",
        program: on_its_own("mps2-an386"),
        emulator: arm(&["-M", "mps2-an386"]),
        output: Output::File,
        size: QVGA,
        stands_in: false,
    },
    Board {
        name: "mps2-an500",
        core: "Cortex-M7",
        description: "floating-point unit",
        target: "thumbv7em-none-eabihf",
        // Memory lies where it does on an386: the program that wants no more is built once for both.
        program: Source { layout: "mps2-an386", ..on_its_own("mps2-an500") },
        emulator: arm(&["-M", "mps2-an500"]),
        output: Output::File,
        size: QVGA,
        stands_in: false,
    },
    Board {
        name: "mps2-an505",
        core: "Cortex-M33",
        description: "floating-point unit",
        target: "thumbv8m.main-none-eabihf",
        program: on_its_own("mps2-an505"),
        emulator: arm(&["-M", "mps2-an505"]),
        output: Output::File,
        size: QVGA,
        stands_in: false,
    },
    Board {
        name: "microbit",
        core: "Cortex-M0",
        description: "16 KB of RAM; floating-point numbers in software",
        target: "thumbv6m-none-eabi",
        program: on_its_own("microbit"),
        emulator: arm(&["-M", "microbit"]),
        output: Output::File,
        size: SMALL,
        stands_in: false,
    },
    Board {
        name: "mps2-an385-v6m",
        core: "Cortex-M3",
        description: "code for a Cortex-M0 (ARMv6-M) on a Cortex-M3, with memory for scenes that a microbit has no room for",
        target: "thumbv6m-none-eabi",
        program: on_its_own("mps2-an385"),
        emulator: arm(&["-M", "mps2-an385"]),
        output: Output::File,
        size: SMALL,
        stands_in: true,
    },
    Board {
        name: "riscv32",
        core: "RV32IMAC",
        description: "QEMU's machine virt; floating-point numbers in software",
        target: "riscv32imac-unknown-none-elf",
        program: on_its_own("riscv32"),
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
        emulator: Emulator::Rp2040js { frames: 2 },
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
        emulator: Emulator::Rp2040js { frames: 2 },
        output: Output::Frames(QVGA),
        size: QQVGA,
        stands_in: false,
    },
];
