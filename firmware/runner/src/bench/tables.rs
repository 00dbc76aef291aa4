//! The measurements next to their targets, as tables in Markdown.

use std::fmt;

use super::measured::Measured;
use super::{M0, M3, M4F, PICO};
use crate::table::{Align, Table, with_commas};

/// Processors of the first table: name, board and number system.
const PROCESSORS: [(&str, &str, &str); 3] =
    [("M4F, f32", M4F, "f32"), ("M3, fixed", M3, "fixed"), ("M0, fixed", M0, "fixed")];

/// The most instructions for a pixel of `classic` on each of them.
const TARGETS: [(&str, [u64; 3]); 2] = [("exact", [250, 450, 1_800]), ("realtime", [90, 160, 650])];

/// How much of the picture realtime quality must keep.
const LEAST_DB: u64 = 38;

/// The fewest frames a second of `classic` in realtime quality on a Pico.
const LEAST_FRAMES: u32 = 10;

/// The scenes of the second table, with their numbers of balls.
const GROWTH: [(&str, u64); 3] = [("flake-10", 10), ("flake-91", 91), ("flake-820", 820)];

/// How much more a ray may take among nine times the objects.
const MOST_GROWTH: f64 = 1.6;

/// The scenes of the third table, with what stands on the plane.
const COSTS: [(&str, &str, Build); 5] = [
    ("spheres", "three balls", Build::Small),
    ("spheres", "three balls", Build::Fast),
    ("torus", "a torus", Build::Fast),
    ("csg", "a cube, two balls", Build::Fast),
    ("mesh", "80 smooth triangles", Build::Fast),
];

/// Whether a program has what only makes it faster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Build {
    Fast,
    Small,
}

impl Build {
    /// A name for what is built so.
    fn of(self, name: &str) -> String {
        match self {
            Self::Fast => name.into(),
            Self::Small => format!("{name}, small"),
        }
    }
}

/// The most flash of spheres and planes: they do not pay for the rest.
const MOST_FLASH_OF_SPHERES: u64 = 20 * 1024;

/// The most flash, and the most RAM with stack and line buffer, of `classic` on an M4F.
const MOST_FLASH: u64 = 32 * 1024;
const MOST_RAM: u64 = 8 * 1024;

/// The programs of the fourth table.
const MEMORY: [(&str, Build); 3] =
    [("exact", Build::Small), ("exact", Build::Fast), ("realtime", Build::Fast)];

/// Everything that was measured.
#[derive(Debug)]
pub(super) struct Tables<'m>(pub(super) &'m [Measured]);

impl fmt::Display for Tables<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "Instructions per pixel of `classic`, four levels, 320x240:\n\n{}", self.pixels())?;
        writeln!(f, "Frames of `classic` on both cores of a Pico, 160x120:\n\n{}", self.frames())?;
        writeln!(f, "Growth: `flake` on M4F, f32, exact:\n\n{}", self.growth())?;
        writeln!(
            f,
            "Shapes on a plane, M4F, f32, exact, 320x240, in programs that name no others:\n\n{}",
            self.costs()
        )?;
        writeln!(f, "Memory of `classic` on M4F, f32, with a line of 320 pixels:\n\n{}", self.memory())
    }
}

impl Tables<'_> {
    fn find(&self, board: &str, scene: &str, number: &str, mode: &str, build: Build) -> Option<&Measured> {
        self.0.iter().find(|measured| {
            [&measured.board, &measured.scene, &measured.number, &measured.mode]
                == [board, scene, number, mode]
                && measured.small == (build == Build::Small)
        })
    }

    fn pixels(&self) -> Table {
        let mut headings = vec![("mode", Align::Left)];
        headings.extend(
            PROCESSORS.iter().flat_map(|(name, ..)| [(*name, Align::Right), ("target", Align::Right)]),
        );
        let mut table = Table::new(headings);
        for (mode, targets) in TARGETS {
            let mut row = vec![match mode {
                "realtime" => format!("{mode}, ≥ {LEAST_DB} dB"),
                _ => mode.into(),
            }];
            for ((_, board, number), target) in PROCESSORS.into_iter().zip(targets) {
                row.push(self.find(board, "classic", number, mode, Build::Fast).map_or(
                    "-".into(),
                    |measured| {
                        let count = with_commas(measured.instructions_per_pixel().round() as u64);
                        match measured.psnr_db.filter(|_| mode == "realtime") {
                            Some(psnr) => format!("{count} at {psnr:.1} dB"),
                            None => count,
                        }
                    },
                ));
                row.push(format!("≤ {}", with_commas(target)));
            }
            table.push(row);
        }
        table
    }

    fn frames(&self) -> Table {
        let mut table = Table::new([
            ("mode", Align::Left),
            ("million cycles", Align::Right),
            ("frames/s", Align::Right),
            ("target", Align::Right),
        ]);
        for (mode, _) in TARGETS {
            let measured = self.find(PICO, "classic", "fixed", mode, Build::Fast);
            let is_realtime = mode == "realtime";
            let psnr = measured.and_then(|measured| measured.psnr_db).filter(|_| is_realtime);
            let number = |number: Option<f64>| number.map_or("-".into(), |number| format!("{number:.2}"));
            table.push([
                psnr.map_or(mode.into(), |psnr| format!("{mode}, {psnr:.1} dB")),
                number(measured.and_then(|measured| Some(measured.cycles? as f64 / 1e6))),
                number(measured.and_then(|measured| measured.frames_per_second)),
                if is_realtime { format!("≥ {LEAST_FRAMES}") } else { "-".into() },
            ]);
        }
        table
    }

    fn growth(&self) -> Table {
        let headings = ["balls", "instr/pixel", "rays/pixel", "instr/ray", "growth", "target"];
        let mut table = Table::new(headings.map(|heading| (heading, Align::Right)));
        let mut fewer: Option<f64> = None;
        for (index, (scene, balls)) in GROWTH.into_iter().enumerate() {
            let measured = self.find(M4F, scene, "f32", "exact", Build::Fast);
            let cell = |text: &dyn Fn(&Measured) -> String| measured.map_or("-".into(), text);
            let each = measured.map(Measured::instructions_per_ray);
            let growth = each.zip(fewer).map(|(each, fewer)| each / fewer);
            table.push([
                with_commas(balls),
                cell(&|measured| with_commas(measured.instructions_per_pixel().round() as u64)),
                cell(&|measured| format!("{:.2}", measured.rays_per_pixel())),
                cell(&|measured| with_commas(measured.instructions_per_ray().round() as u64)),
                growth.map_or("-".into(), |growth| format!("x{growth:.2}")),
                if index == 0 { "-".into() } else { format!("≤ x{MOST_GROWTH}") },
            ]);
            fewer = each;
        }
        table
    }

    fn costs(&self) -> Table {
        let mut table = Table::new([
            ("scene", Align::Left),
            ("on the plane", Align::Left),
            ("instr/pixel", Align::Right),
            ("instr/ray", Align::Right),
            ("flash", Align::Right),
            ("target", Align::Right),
            ("RAM in all", Align::Right),
        ]);
        for (scene, what, build) in COSTS {
            let measured = self.find(M4F, scene, "f32", "exact", build);
            let cell = |number: &dyn Fn(&Measured) -> u64, unit| {
                measured.map_or("-".into(), |measured| with_commas(number(measured)) + unit)
            };
            table.push([
                build.of(scene),
                what.into(),
                cell(&|measured| measured.instructions_per_pixel().round() as u64, ""),
                cell(&|measured| measured.instructions_per_ray().round() as u64, ""),
                cell(&|measured| measured.text_bytes, " B"),
                if build == Build::Small {
                    format!("≤ {} B", with_commas(MOST_FLASH_OF_SPHERES))
                } else {
                    "-".into()
                },
                cell(&|measured| measured.static_ram_bytes + measured.stack_bytes, " B"),
            ]);
        }
        table
    }

    fn memory(&self) -> Table {
        let mut table = Table::new([
            ("mode", Align::Left),
            ("flash", Align::Right),
            ("target", Align::Right),
            ("statics", Align::Right),
            ("stack", Align::Right),
            ("RAM in all", Align::Right),
            ("target", Align::Right),
        ]);
        let bytes = |bytes: u64| with_commas(bytes) + " B";
        for (mode, build) in MEMORY {
            let measured = self.find(M4F, "classic", "f32", mode, build);
            let cell =
                |count: fn(&Measured) -> u64| measured.map_or("-".into(), |measured| bytes(count(measured)));
            table.push([
                build.of(mode),
                cell(|measured| measured.text_bytes),
                format!("≤ {}", bytes(MOST_FLASH)),
                cell(|measured| measured.static_ram_bytes),
                cell(|measured| measured.stack_bytes),
                cell(|measured| measured.static_ram_bytes + measured.stack_bytes),
                format!("≤ {}", bytes(MOST_RAM)),
            ]);
        }
        table
    }
}

#[cfg(test)]
mod tests {
    use super::super::measured::tests::measured;
    use super::*;

    #[test]
    fn counts_stand_next_to_targets() {
        let measured = [
            measured(M4F, "classic", "f32", "exact", 90_500),
            Measured { small: true, ..measured(M4F, "classic", "f32", "exact", 120_000) },
            measured(M4F, "classic", "f32", "realtime", 9_000),
            Measured {
                cycles: Some(19_500_000),
                frames_per_second: Some(10.26),
                ..measured(PICO, "classic", "fixed", "realtime", 3_000)
            },
            measured(M4F, "flake-10", "f32", "exact", 100_000),
            measured(M4F, "flake-91", "f32", "exact", 150_000),
        ];
        let tables = Tables(&measured);
        assert_eq!(
            tables.pixels().to_string(),
            "\
            | mode              |      M4F, f32 | target | M3, fixed | target | M0, fixed |  target |\n\
            | ----------------- | ------------: | -----: | --------: | -----: | --------: | ------: |\n\
            | exact             |           905 |  ≤ 250 |         - |  ≤ 450 |         - | ≤ 1,800 |\n\
            | realtime, ≥ 38 dB | 90 at 41.3 dB |   ≤ 90 |         - |  ≤ 160 |         - |   ≤ 650 |\n"
        );
        assert_eq!(
            tables.frames().to_string(),
            "\
            | mode              | million cycles | frames/s | target |\n\
            | ----------------- | -------------: | -------: | -----: |\n\
            | exact             |              - |        - |      - |\n\
            | realtime, 41.3 dB |          19.50 |    10.26 |   ≥ 10 |\n"
        );
        assert_eq!(
            tables.growth().to_string(),
            "\
            | balls | instr/pixel | rays/pixel | instr/ray | growth | target |\n\
            | ----: | ----------: | ---------: | --------: | -----: | -----: |\n\
            |    10 |       1,000 |       2.00 |       500 |      - |      - |\n\
            |    91 |       1,500 |       2.00 |       750 |  x1.50 | ≤ x1.6 |\n\
            |   820 |           - |          - |         - |      - | ≤ x1.6 |\n"
        );
        assert_eq!(
            tables.memory().to_string(),
            "\
            | mode         |    flash |     target | statics |   stack | RAM in all |    target |\n\
            | ------------ | -------: | ---------: | ------: | ------: | ---------: | --------: |\n\
            | exact, small | 40,000 B | ≤ 32,768 B | 2,000 B | 3,000 B |    5,000 B | ≤ 8,192 B |\n\
            | exact        | 40,000 B | ≤ 32,768 B | 2,000 B | 3,000 B |    5,000 B | ≤ 8,192 B |\n\
            | realtime     | 40,000 B | ≤ 32,768 B | 2,000 B | 3,000 B |    5,000 B | ≤ 8,192 B |\n"
        );
    }
}
