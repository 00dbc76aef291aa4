//! The time of frames, from the cycles that an emulator counts.

use std::fmt;

use serde::Serialize;

/// Cycles of frames, and the clocks that the program sets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Timing {
    frames: u64,
    /// Cycles of the chip's clock for all frames. A frame lasts from its first command to the first command
    /// of the next frame; bus and cores all work during that time.
    cycles: u64,
    clock_hz: u64,
    spi_hz: u64,
    /// Time that the bus is busy for one frame.
    spi_nanoseconds: u64,
    /// Time from the panel's light to the last pixel of the first frame.
    first_picture_nanoseconds: u64,
}

/// The time of frames, as the JSON has it.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Rates {
    frames: u64,
    cycles: u64,
    pub(crate) cycles_per_frame: u64,
    clock_hz: u64,
    pub(crate) frames_per_second: f64,
    spi_hz: u64,
    spi_milliseconds_per_frame: f64,
    first_picture_milliseconds: f64,
}

impl Timing {
    /// Whether a report's figure of this name belongs here.
    pub(crate) fn has(name: &str) -> bool {
        Self::default().figure(name).is_some()
    }

    /// Sets a figure by its name in the report.
    pub(crate) fn set(&mut self, name: &str, value: u64) {
        if let Some(figure) = self.figure(name) {
            *figure = value;
        }
    }

    /// The time of a frame.
    pub(crate) fn rates(&self) -> Rates {
        let Self { frames, cycles, clock_hz, spi_hz, spi_nanoseconds, first_picture_nanoseconds } = *self;
        let frames_per_second = frames as f64 * clock_hz as f64 / cycles as f64;
        Rates {
            frames,
            cycles,
            cycles_per_frame: cycles / frames.max(1),
            clock_hz,
            // To a hundredth.
            frames_per_second: (frames_per_second * 100.0).round() / 100.0,
            spi_hz,
            spi_milliseconds_per_frame: spi_nanoseconds as f64 / 1e6,
            first_picture_milliseconds: first_picture_nanoseconds as f64 / 1e6,
        }
    }

    fn figure(&mut self, name: &str) -> Option<&mut u64> {
        match name {
            "frames" => Some(&mut self.frames),
            "cycles" => Some(&mut self.cycles),
            "clock_hz" => Some(&mut self.clock_hz),
            "spi_hz" => Some(&mut self.spi_hz),
            "spi_nanoseconds" => Some(&mut self.spi_nanoseconds),
            "first_picture_nanoseconds" => Some(&mut self.first_picture_nanoseconds),
            _ => None,
        }
    }
}

impl fmt::Display for Rates {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:.2} million cycles a frame, {} frames a second at {} MHz; the bus at {4} MHz is busy for \
             {3:.2} ms of each; the first picture is whole {5:.1} ms after the panel's light is on",
            self.cycles_per_frame as f64 / 1e6,
            self.frames_per_second,
            self.clock_hz as f64 / 1e6,
            self.spi_milliseconds_per_frame,
            self.spi_hz as f64 / 1e6,
            self.first_picture_milliseconds,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cycles_become_rates() {
        let mut timing = Timing::default();
        let figures =
            [("frames", 2), ("cycles", 25_000_000), ("clock_hz", 125_000_000), ("spi_hz", 62_500_000)];
        let times = [("spi_nanoseconds", 4_915_200), ("first_picture_nanoseconds", 6_200_000)];
        for (name, value) in figures.into_iter().chain(times) {
            assert!(Timing::has(name));
            timing.set(name, value);
        }
        assert!(!Timing::has("picture"));
        let json = serde_json::to_value(timing.rates()).unwrap();
        let expected = serde_json::json!({
            "frames": 2, "cycles": 25_000_000, "cycles_per_frame": 12_500_000, "clock_hz": 125_000_000,
            "frames_per_second": 10.0, "spi_hz": 62_500_000, "spi_milliseconds_per_frame": 4.9152,
            "first_picture_milliseconds": 6.2,
        });
        assert_eq!(json, expected);
        assert_eq!(
            timing.rates().to_string(),
            "12.50 million cycles a frame, 10 frames a second at 125 MHz; the bus at 62.5 MHz is busy for \
             4.92 ms of each; the first picture is whole 6.2 ms after the panel's light is on"
        );
    }
}
