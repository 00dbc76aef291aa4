//! Common boards, with memory and clock from their data sheets.

/// A board.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Board {
    /// The name of the board.
    pub name: &'static str,
    /// The microcontroller on it.
    pub chip: &'static str,
    /// The kind of its processor.
    pub core: Core,
    /// The clock, in MHz.
    pub megahertz: f64,
    /// The size of flash, in bytes.
    pub flash: u64,
    /// The size of RAM, in bytes.
    pub ram: u64,
}

/// A kind of processor that was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Core {
    /// Cortex-M0 or M0+.
    M0,
    /// Cortex-M3.
    M3,
    /// Cortex-M4F, and M33 with a floating-point unit.
    M4F,
}

impl Core {
    /// Whether the processor has an FPU and so computes in `f32`, else in fixed point.
    pub const fn has_fpu(self) -> bool {
        matches!(self, Self::M4F)
    }
}

const KB: u64 = 1024;

/// The known boards.
pub const BOARDS: [Board; 7] = [
    Board {
        name: "microbit",
        chip: "nRF51822, Cortex-M0",
        core: Core::M0,
        megahertz: 16.0,
        flash: 256 * KB,
        ram: 16 * KB,
    },
    Board {
        name: "pico",
        chip: "RP2040, one Cortex-M0+",
        core: Core::M0,
        megahertz: 133.0,
        flash: 2048 * KB,
        ram: 264 * KB,
    },
    Board {
        name: "bluepill",
        chip: "STM32F103C8, Cortex-M3",
        core: Core::M3,
        megahertz: 72.0,
        flash: 64 * KB,
        ram: 20 * KB,
    },
    Board {
        name: "lm3s6965evb",
        chip: "LM3S6965, Cortex-M3",
        core: Core::M3,
        megahertz: 50.0,
        flash: 256 * KB,
        ram: 64 * KB,
    },
    Board {
        name: "blackpill",
        chip: "STM32F411CE, Cortex-M4F",
        core: Core::M4F,
        megahertz: 100.0,
        flash: 512 * KB,
        ram: 128 * KB,
    },
    Board {
        name: "nrf52840dk",
        chip: "nRF52840, Cortex-M4F",
        core: Core::M4F,
        megahertz: 64.0,
        flash: 1024 * KB,
        ram: 256 * KB,
    },
    Board {
        name: "pico2",
        chip: "RP2350, one Cortex-M33",
        core: Core::M4F,
        megahertz: 150.0,
        flash: 4096 * KB,
        ram: 520 * KB,
    },
];
