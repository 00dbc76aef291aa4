//! The figures of one program.

use serde::{Deserialize, Serialize};

use crate::record::Record;

/// A program, and its figures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Measured {
    pub(super) board: String,
    pub(super) scene: String,
    pub(super) width: u16,
    pub(super) height: u16,
    pub(super) number: String,
    pub(super) mode: String,
    pub(super) small: bool,
    pub(super) rays: u64,
    pub(super) psnr_db: Option<f64>,
    pub(super) instructions: u64,
    /// Cycles of a frame, where the emulator counts them.
    pub(super) cycles: Option<u64>,
    /// Frames a second at the clock that the program sets, where the emulator counts cycles.
    pub(super) frames_per_second: Option<f64>,
    pub(super) text_bytes: u64,
    pub(super) static_ram_bytes: u64,
    pub(super) stack_bytes: u64,
}

impl Measured {
    /// The figures of a program that ran and drew the right picture; `None` for any other.
    pub(super) fn of(record: &Record) -> Option<Self> {
        if !record.is_right() {
            return None;
        }
        Some(Self {
            board: record.board.into(),
            scene: record.scene.into(),
            width: record.width,
            height: record.height,
            number: record.number.into(),
            mode: record.mode.into(),
            small: record.small,
            rays: record.rays?,
            psnr_db: record.psnr_db,
            instructions: record.instructions?,
            cycles: record.rates.map(|rates| rates.cycles_per_frame),
            frames_per_second: record.rates.map(|rates| rates.frames_per_second),
            text_bytes: record.text_bytes?,
            static_ram_bytes: record.static_ram_bytes?,
            stack_bytes: record.stack_bytes?,
        })
    }

    /// The name of the program, which no other has.
    pub(super) fn name(&self) -> String {
        let Self { board, scene, width, height, number, mode, small, .. } = self;
        let size = if *small { " small" } else { "" };
        format!("{board} {scene} {width}x{height} {number} {mode}{size}")
    }

    pub(super) fn instructions_per_pixel(&self) -> f64 {
        self.instructions as f64 / self.pixels()
    }

    pub(super) fn instructions_per_ray(&self) -> f64 {
        self.instructions as f64 / self.rays as f64
    }

    pub(super) fn rays_per_pixel(&self) -> f64 {
        self.rays as f64 / self.pixels()
    }

    /// The clock that frames a second hold for, where the emulator counts cycles.
    pub(super) fn megahertz(&self) -> Option<f64> {
        Some(self.cycles? as f64 * self.frames_per_second? / 1e6)
    }

    /// Bytes of RAM: statics and stack.
    pub(super) fn ram_bytes(&self) -> u64 {
        self.static_ram_bytes + self.stack_bytes
    }

    fn pixels(&self) -> f64 {
        f64::from(self.width) * f64::from(self.height)
    }
}

/// Whether a program has the features that only make exact pictures faster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Build {
    Fast,
    Small,
}

/// The figures of all programs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measurements<'m>(pub(super) &'m [Measured]);

impl<'m> Measurements<'m> {
    /// The figures of the fast program for a picture; `None` if it was not measured.
    pub(super) fn find(self, board: &str, scene: &str, number: &str, mode: &str) -> Option<&'m Measured> {
        self.find_build([board, scene, number, mode], Build::Fast)
    }

    /// The figures of a program for a picture of this board, scene, number system and mode.
    pub(super) fn find_build(self, picture: [&str; 4], build: Build) -> Option<&'m Measured> {
        self.0.iter().find(|measured| {
            let Measured { board, scene, number, mode, small, .. } = measured;
            [board, scene, number, mode] == picture && *small == (build == Build::Small)
        })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Figures of a program that draws 100 pixels.
    pub(crate) fn measured(
        board: &str,
        scene: &str,
        number: &str,
        mode: &str,
        instructions: u64,
    ) -> Measured {
        Measured {
            board: board.into(),
            scene: scene.into(),
            width: 10,
            height: 10,
            number: number.into(),
            mode: mode.into(),
            small: false,
            rays: 200,
            psnr_db: (mode == "realtime").then_some(41.26),
            instructions,
            cycles: None,
            frames_per_second: None,
            text_bytes: 40_000,
            static_ram_bytes: 2_000,
            stack_bytes: 3_000,
        }
    }

    #[test]
    fn counts_are_for_a_pixel_and_for_a_ray() {
        let measured = measured("microbit", "classic", "fixed", "exact", 5_000);
        assert_eq!(measured.name(), "microbit classic 10x10 fixed exact");
        assert_eq!(measured.instructions_per_pixel(), 50.0);
        assert_eq!((measured.rays_per_pixel(), measured.instructions_per_ray()), (2.0, 25.0));
    }
}
