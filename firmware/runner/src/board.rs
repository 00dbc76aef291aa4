//! The boards that the program runs on.

use crate::picture::Size;

/// A board: what it is, and how it is built for and emulated.
#[derive(Debug)]
pub(crate) struct Board {
    /// Name of the program, and of the board's folder in `emulated/src/bin`.
    pub(crate) name: &'static str,
    /// Name of the processor core.
    pub(crate) core: &'static str,
    /// What is special about it.
    pub(crate) description: &'static str,
    /// What the compiler calls the processor.
    pub(crate) target: &'static str,
    pub(crate) emulator: Emulator,
    /// Arguments that make the emulator this board.
    pub(crate) machine: &'static [&'static str],
    pub(crate) output: Output,
    /// Size of the picture, if none is asked for.
    pub(crate) size: Size,
}

/// The program that emulates a board.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Emulator {
    pub(crate) command: &'static str,
    /// Debian's package that holds it.
    pub(crate) package: &'static str,
}

/// Where a board's picture goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Output {
    /// To a file, as RGB565.
    File,
    /// To a panel of this size, in 16 grays, two pixels a byte.
    Panel(Size),
}

const ARM: Emulator = Emulator { command: "qemu-system-arm", package: "qemu-system-arm" };
const RISCV32: Emulator = Emulator { command: "qemu-system-riscv32", package: "qemu-system-misc" };

const OLED: Size = Size { width: 128, height: 64 };
/// A common display, for cores with a floating-point unit.
const QVGA: Size = Size { width: 320, height: 240 };
/// For cores that compute floating-point numbers in software.
const SMALL: Size = Size { width: 64, height: 48 };

/// All boards.
pub(crate) const BOARDS: &[Board] = &[
    Board {
        name: "lm3s6965evb",
        core: "Cortex-M3",
        description: "64 KB of RAM; the picture goes to its OLED panel of 128x64 pixels in 16 grays",
        target: "thumbv7m-none-eabi",
        emulator: ARM,
        machine: &["-M", "lm3s6965evb"],
        output: Output::Panel(OLED),
        size: OLED,
    },
    Board {
        name: "mps2-an385",
        core: "Cortex-M3",
        description: "floating-point numbers in software",
        target: "thumbv7m-none-eabi",
        emulator: ARM,
        machine: &["-M", "mps2-an385"],
        output: Output::File,
        size: SMALL,
    },
    Board {
        name: "mps2-an386",
        core: "Cortex-M4F",
        description: "floating-point unit",
        target: "thumbv7em-none-eabihf",
        emulator: ARM,
        machine: &["-M", "mps2-an386"],
        output: Output::File,
        size: QVGA,
    },
    Board {
        name: "mps2-an500",
        core: "Cortex-M7",
        description: "floating-point unit",
        target: "thumbv7em-none-eabihf",
        emulator: ARM,
        machine: &["-M", "mps2-an500"],
        output: Output::File,
        size: QVGA,
    },
    Board {
        name: "mps2-an505",
        core: "Cortex-M33",
        description: "floating-point unit",
        target: "thumbv8m.main-none-eabihf",
        emulator: ARM,
        machine: &["-M", "mps2-an505"],
        output: Output::File,
        size: QVGA,
    },
    Board {
        name: "microbit",
        core: "Cortex-M0",
        description: "16 KB of RAM; floating-point numbers in software",
        target: "thumbv6m-none-eabi",
        emulator: ARM,
        machine: &["-M", "microbit"],
        output: Output::File,
        size: SMALL,
    },
    Board {
        name: "riscv32",
        core: "RV32IMAC",
        description: "QEMU's machine virt; floating-point numbers in software",
        target: "riscv32imac-unknown-none-elf",
        emulator: RISCV32,
        machine: &["-M", "virt", "-bios", "none"],
        output: Output::File,
        size: SMALL,
    },
];
