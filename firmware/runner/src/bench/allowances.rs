//! Limits that every version keeps, whatever `firmware/boards.json` holds.

use super::entries::{DUAL_PICO, M4F};
use super::measured::{Build, Measured, Measurements};
use crate::table::with_commas;

/// The fewest frames a second of `classic` in realtime quality on both cores of a Pico.
pub(super) const LEAST_FRAMES: f64 = 11.0;

/// The largest growth of the instructions of a ray among nine times the objects.
pub(super) const MOST_GROWTH: f64 = 1.6;

/// The most flash, and the most RAM with stack and a line of 320 pixels, of `classic` in exact quality on an
/// M4F.
pub(super) const MOST_FLASH: u64 = 32 * 1024;
pub(super) const MOST_RAM: u64 = 8 * 1024;

/// The most flash of a small program for spheres and planes on an M4F.
pub(super) const MOST_FLASH_OF_SPHERES: u64 = 20 * 1024;

/// The scenes whose growth is limited, with their numbers of balls.
pub(super) const GROWTH: [(&str, u64); 3] = [("flake-10", 10), ("flake-91", 91), ("flake-820", 820)];

/// The limits that these figures break, a line for each. A figure that was not measured breaks none.
pub(super) fn broken(measured: Measurements<'_>) -> Vec<String> {
    let mut broken = Vec::new();
    let mut require = |holds: bool, line: String| {
        if !holds {
            broken.push(line);
        }
    };
    let frames =
        measured.find(DUAL_PICO, "classic", "fixed", "realtime").and_then(|pico| pico.frames_per_second);
    if let Some(frames) = frames {
        let line = format!(
            "{DUAL_PICO} shows {frames} frames a second of classic in realtime quality, not {LEAST_FRAMES}"
        );
        require(frames >= LEAST_FRAMES, line);
    }
    if let Some(classic) = measured.find(M4F, "classic", "f32", "exact") {
        for (what, bytes, most) in
            [("flash", classic.text_bytes, MOST_FLASH), ("RAM", classic.ram_bytes(), MOST_RAM)]
        {
            let line = format!(
                "{}: {} B of {what}, above {} B",
                classic.name(),
                with_commas(bytes),
                with_commas(most)
            );
            require(bytes <= most, line);
        }
    }
    if let Some(spheres) = measured.find_build([M4F, "spheres", "f32", "exact"], Build::Small) {
        let bytes = spheres.text_bytes;
        let most = with_commas(MOST_FLASH_OF_SPHERES);
        let line = format!("{}: {} B of flash, above {most} B", spheres.name(), with_commas(bytes));
        require(bytes <= MOST_FLASH_OF_SPHERES, line);
    }
    for (growth, (_, balls)) in growth(measured).into_iter().zip(GROWTH) {
        if let Some(growth) = growth {
            let line = format!(
                "a ray among {balls} balls takes {growth:.2} times the instructions, not {MOST_GROWTH}"
            );
            require(growth <= MOST_GROWTH, line);
        }
    }
    broken
}

/// For each scene of [`GROWTH`], how many times the instructions of the scene before a ray takes.
pub(super) fn growth(measured: Measurements<'_>) -> [Option<f64>; 3] {
    let mut fewer = None;
    GROWTH.map(|(scene, _)| {
        let each = measured.find(M4F, scene, "f32", "exact").map(Measured::instructions_per_ray);
        let growth = each.zip(fewer).map(|(each, fewer)| each / fewer);
        fewer = each;
        growth
    })
}

#[cfg(test)]
mod tests {
    use super::super::measured::tests::measured;
    use super::*;

    #[test]
    fn figures_at_the_limits_break_none() {
        let frames = Some(LEAST_FRAMES);
        let figures = [
            Measured { frames_per_second: frames, ..measured(DUAL_PICO, "classic", "fixed", "realtime", 1) },
            Measured { text_bytes: MOST_FLASH, ..measured(M4F, "classic", "f32", "exact", 1) },
            measured(M4F, "flake-10", "f32", "exact", 1_000),
            measured(M4F, "flake-91", "f32", "exact", 1_600),
        ];
        assert_eq!(broken(Measurements(&figures)), <[String; 0]>::default());
        assert_eq!(broken(Measurements(&[])), <[String; 0]>::default());
    }

    #[test]
    fn figures_beyond_the_limits_are_named() {
        let classic = measured(M4F, "classic", "f32", "exact", 1);
        let figures = [
            Measured {
                frames_per_second: Some(10.9),
                ..measured(DUAL_PICO, "classic", "fixed", "realtime", 1)
            },
            Measured { text_bytes: MOST_FLASH + 1, static_ram_bytes: MOST_RAM, ..classic },
            Measured { small: true, ..measured(M4F, "spheres", "f32", "exact", 1) },
            measured(M4F, "flake-10", "f32", "exact", 1_000),
            measured(M4F, "flake-91", "f32", "exact", 1_700),
        ];
        let expected = [
            "pico-dual shows 10.9 frames a second of classic in realtime quality, not 11",
            "mps2-an386 classic 10x10 f32 exact: 32,769 B of flash, above 32,768 B",
            "mps2-an386 classic 10x10 f32 exact: 11,192 B of RAM, above 8,192 B",
            "mps2-an386 spheres 10x10 f32 exact small: 40,000 B of flash, above 20,480 B",
            "a ray among 91 balls takes 1.70 times the instructions, not 1.6",
        ];
        assert_eq!(broken(Measurements(&figures)), expected);
    }
}
