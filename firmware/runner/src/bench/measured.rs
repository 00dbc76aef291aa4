//! What was measured of one program.

use serde::{Deserialize, Serialize};

use crate::record::Record;

/// What a program is, and what it took.
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
    /// For a frame, and how many frames a second they mean, where the emulator counts them.
    pub(super) cycles: Option<u64>,
    pub(super) frames_per_second: Option<f64>,
    pub(super) text_bytes: u64,
    pub(super) static_ram_bytes: u64,
    pub(super) stack_bytes: u64,
}

impl Measured {
    /// Of a program that ran and drew the right picture.
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

    /// What the program is, in words: no two have the same.
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

    fn pixels(&self) -> f64 {
        f64::from(self.width) * f64::from(self.height)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// What a program of 100 pixels might have taken.
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
