//! The figures as tables in Markdown.

use super::allowances::{
    GROWTH, LEAST_FRAMES, MOST_FLASH, MOST_FLASH_OF_SPHERES, MOST_GROWTH, MOST_RAM, growth,
};
use super::entries::{BAKED, DUAL_PICO, FIXED_SCENES, LARGE_M0, M0, M3, M4F, PICO};
use super::measured::{Build, Measured, Measurements};
use crate::board::BOARDS;
use crate::table::{Align, Table, with_commas};

/// The modes, each a row of a table.
const MODES: [&str; 2] = ["exact", "realtime"];

/// The scenes with one kind of shape each, and what stands on their plane.
const SHAPES: [(&str, &str, Build); 5] = [
    ("spheres", "three balls", Build::Small),
    ("spheres", "three balls", Build::Fast),
    ("torus", "a torus", Build::Fast),
    ("csg", "a cube, two balls", Build::Fast),
    ("mesh", "80 smooth triangles", Build::Fast),
];

/// Boards, scenes and number systems that are traced and previewed: the board of the traced picture, and that
/// of the preview, which takes more RAM.
const PREVIEWS: [([&str; 2], &str, &str); 5] = [
    ([M4F, M4F], "classic", "f32"),
    ([M4F, M4F], "mesh", "f32"),
    ([M4F, M4F], "flake-10", "f32"),
    ([M4F, M4F], "flake-91", "f32"),
    ([M0, LARGE_M0], "classic", "fixed"),
];

/// The programs whose memory is shown.
const MEMORY: [(&str, Build); 3] =
    [("exact", Build::Small), ("exact", Build::Fast), ("realtime", Build::Fast)];

/// All tables, each with a heading that says what was measured.
pub(super) fn all(measured: Measurements<'_>) -> [(&'static str, Table); 7] {
    [
        ("All boards: `classic` in exact quality", boards(measured)),
        ("Scenes in fixed point: instructions per pixel", scenes(measured)),
        ("Frames on a Pico, in fixed point", frames(measured)),
        ("Many objects: `flake` on M4F, `f32`, exact, 320x240", many_objects(measured)),
        ("Kinds of shapes on a plane: M4F, `f32`, exact, 320x240", shapes(measured)),
        ("Memory of `classic` on M4F, `f32`, 320x240", memory(measured)),
        ("Ray tracing and scan conversion, 320x240", previews(measured)),
    ]
}

/// A cell with a figure, or a dash if the program was not measured.
fn cell(measured: Option<&Measured>, text: impl Fn(&Measured) -> String) -> String {
    measured.map_or("-".into(), text)
}

pub(super) fn bytes(bytes: u64) -> String {
    with_commas(bytes) + " B"
}

pub(super) fn per_pixel(measured: &Measured) -> String {
    with_commas(measured.instructions_per_pixel().round() as u64)
}

fn per_ray(measured: &Measured) -> String {
    with_commas(measured.instructions_per_ray().round() as u64)
}

fn size(measured: &Measured) -> String {
    format!("{}x{}", measured.width, measured.height)
}

fn decibels(measured: &Measured) -> String {
    measured.psnr_db.map_or("-".into(), |psnr| format!("{psnr:.1} dB"))
}

/// The name of a program with its features.
fn name(program: &str, build: Build) -> String {
    match build {
        Build::Fast => program.into(),
        Build::Small => format!("{program}, small"),
    }
}

/// One picture on each board, in `f32`; in fixed point on the Pico.
fn boards(measured: Measurements<'_>) -> Table {
    let mut table = Table::new([
        ("board", Align::Left),
        ("core", Align::Left),
        ("size", Align::Right),
        ("number", Align::Left),
        ("instr/pixel", Align::Right),
        ("flash", Align::Right),
        ("RAM", Align::Right),
        ("stack", Align::Right),
    ]);
    for board in BOARDS.iter().filter(|board| !board.stands_in) {
        let number = if [PICO, DUAL_PICO].contains(&board.name) { "fixed" } else { "f32" };
        let figures = measured.find(board.name, "classic", number, "exact");
        table.push([
            board.name.into(),
            board.core.into(),
            cell(figures, size),
            number.into(),
            cell(figures, per_pixel),
            cell(figures, |figures| bytes(figures.text_bytes)),
            cell(figures, |figures| bytes(figures.static_ram_bytes)),
            cell(figures, |figures| bytes(figures.stack_bytes)),
        ]);
    }
    table
}

/// Scenes on the cores without an FPU, in both qualities.
fn scenes(measured: Measurements<'_>) -> Table {
    let mut table = Table::new([
        ("scene", Align::Left),
        ("size", Align::Right),
        ("mode", Align::Left),
        ("M3", Align::Right),
        ("M0", Align::Right),
        ("rays/pixel", Align::Right),
        ("PSNR", Align::Right),
        ("flash on M0", Align::Right),
        ("RAM on M0", Align::Right),
    ]);
    let others = FIXED_SCENES.map(|scene| (scene, LARGE_M0));
    for (scene, m0) in [("classic", M0)].into_iter().chain(others) {
        for mode in MODES {
            let on_m3 = measured.find(M3, scene, "fixed", mode);
            let on_m0 = measured.find(m0, scene, "fixed", mode);
            let either = on_m3.or(on_m0);
            table.push([
                scene.into(),
                cell(either, size),
                mode.into(),
                cell(on_m3, per_pixel),
                cell(on_m0, per_pixel),
                cell(either, |figures| format!("{:.2}", figures.rays_per_pixel())),
                cell(either, decibels),
                cell(on_m0, |figures| bytes(figures.text_bytes)),
                cell(on_m0, |figures| bytes(figures.ram_bytes())),
            ]);
        }
    }
    table
}

/// Frames a second on one and both cores of a Pico.
fn frames(measured: Measurements<'_>) -> Table {
    let mut table = Table::new([
        ("scene", Align::Left),
        ("size", Align::Right),
        ("cores", Align::Left),
        ("mode", Align::Left),
        ("PSNR", Align::Right),
        ("million cycles", Align::Right),
        ("MHz", Align::Right),
        ("frames/s", Align::Right),
        ("allowance", Align::Right),
    ]);
    let of_classic =
        [PICO, DUAL_PICO].into_iter().flat_map(|board| MODES.map(|mode| (board, "classic", mode)));
    for (board, scene, mode) in of_classic.chain([(DUAL_PICO, BAKED, "exact")]) {
        let figures = measured.find(board, scene, "fixed", mode);
        let number = |number: Option<f64>| number.map_or("-".into(), |number| format!("{number:.2}"));
        let is_limited = (board, scene, mode) == (DUAL_PICO, "classic", "realtime");
        table.push([
            scene.into(),
            cell(figures, size),
            if board == DUAL_PICO { "both" } else { "one" }.into(),
            mode.into(),
            cell(figures, decibels),
            cell(figures, |figures| number(figures.cycles.map(|cycles| cycles as f64 / 1e6))),
            cell(figures, |figures| figures.megahertz().map_or("-".into(), |clock| format!("{clock:.0}"))),
            cell(figures, |figures| number(figures.frames_per_second)),
            if is_limited { format!("≥ {LEAST_FRAMES}") } else { "-".into() },
        ]);
    }
    table
}

/// The growth of a ray's instructions with the number of objects.
fn many_objects(measured: Measurements<'_>) -> Table {
    let headings = ["balls", "instr/pixel", "rays/pixel", "instr/ray", "growth", "allowance"];
    let mut table = Table::new(headings.map(|heading| (heading, Align::Right)));
    for (index, ((scene, balls), growth)) in GROWTH.into_iter().zip(growth(measured)).enumerate() {
        let figures = measured.find(M4F, scene, "f32", "exact");
        table.push([
            with_commas(balls),
            cell(figures, per_pixel),
            cell(figures, |figures| format!("{:.2}", figures.rays_per_pixel())),
            cell(figures, per_ray),
            growth.map_or("-".into(), |growth| format!("x{growth:.2}")),
            if index == 0 { "-".into() } else { format!("≤ x{MOST_GROWTH}") },
        ]);
    }
    table
}

/// The costs of single kinds of shapes.
fn shapes(measured: Measurements<'_>) -> Table {
    let mut table = Table::new([
        ("scene", Align::Left),
        ("on the plane", Align::Left),
        ("instr/pixel", Align::Right),
        ("instr/ray", Align::Right),
        ("flash", Align::Right),
        ("allowance", Align::Right),
        ("RAM in all", Align::Right),
    ]);
    for (scene, what, build) in SHAPES {
        let figures = measured.find_build([M4F, scene, "f32", "exact"], build);
        let is_limited = build == Build::Small;
        table.push([
            name(scene, build),
            what.into(),
            cell(figures, per_pixel),
            cell(figures, per_ray),
            cell(figures, |figures| bytes(figures.text_bytes)),
            if is_limited { format!("≤ {}", bytes(MOST_FLASH_OF_SPHERES)) } else { "-".into() },
            cell(figures, |figures| bytes(figures.ram_bytes())),
        ]);
    }
    table
}

/// Flash and RAM of the programs for one scene.
fn memory(measured: Measurements<'_>) -> Table {
    let mut table = Table::new([
        ("mode", Align::Left),
        ("instr/pixel", Align::Right),
        ("PSNR", Align::Right),
        ("flash", Align::Right),
        ("allowance", Align::Right),
        ("statics", Align::Right),
        ("stack", Align::Right),
        ("RAM in all", Align::Right),
        ("allowance", Align::Right),
    ]);
    for (mode, build) in MEMORY {
        let figures = measured.find_build([M4F, "classic", "f32", mode], build);
        let limit = |most| if mode == "exact" { format!("≤ {}", bytes(most)) } else { "-".into() };
        table.push([
            name(mode, build),
            cell(figures, per_pixel),
            cell(figures, decibels),
            cell(figures, |figures| bytes(figures.text_bytes)),
            limit(MOST_FLASH),
            cell(figures, |figures| bytes(figures.static_ram_bytes)),
            cell(figures, |figures| bytes(figures.stack_bytes)),
            cell(figures, |figures| bytes(figures.ram_bytes())),
            limit(MOST_RAM),
        ]);
    }
    table
}

/// The costs of both ways to draw a scene.
fn previews(measured: Measurements<'_>) -> Table {
    let mut table = Table::new([
        ("scene", Align::Left),
        ("core", Align::Left),
        ("instr/pixel, exact", Align::Right),
        ("preview", Align::Right),
        ("ratio", Align::Right),
        ("RAM, exact", Align::Right),
        ("preview", Align::Right),
        ("flash, exact", Align::Right),
        ("preview", Align::Right),
    ]);
    for (boards, scene, number) in PREVIEWS {
        let find = |board, mode| measured.find(board, scene, number, mode);
        let [traced, shown] = [find(boards[0], "exact"), find(boards[1], "preview")];
        let ratio = traced.zip(shown).map(|(traced, shown)| {
            format!("{:.1}", traced.instructions_per_pixel() / shown.instructions_per_pixel())
        });
        let ram = |figures: &Measured| bytes(figures.ram_bytes());
        let flash = |figures: &Measured| bytes(figures.text_bytes);
        table.push([
            scene.into(),
            if number == "f32" { "M4F, f32" } else { "M0, fixed" }.into(),
            cell(traced, per_pixel),
            cell(shown, per_pixel),
            ratio.unwrap_or("-".into()),
            cell(traced, ram),
            cell(shown, ram),
            cell(traced, flash),
            cell(shown, flash),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::super::measured::tests::measured;
    use super::*;

    #[test]
    fn scenes_have_a_row_for_each_mode() {
        let figures = [
            measured(M3, "classic", "fixed", "exact", 90_500),
            measured(M0, "classic", "fixed", "exact", 170_000),
            measured(LARGE_M0, "whitted", "fixed", "realtime", 9_000),
        ];
        let table = scenes(Measurements(&figures)).to_string();
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!(lines.len(), 2 + 2 * 5);
        assert_eq!(
            lines[2],
            "| classic     | 10x10 | exact    | 905 | 1,700 |       2.00 |       - |    40,000 B |   5,000 \
             B |"
        );
        assert_eq!(
            lines[5],
            "| whitted     | 10x10 | realtime |   - |    90 |       2.00 | 41.3 dB |    40,000 B |   5,000 \
             B |"
        );
    }

    const FRAMES: &str = "\
    | scene       |  size | cores | mode     |    PSNR | million cycles | MHz | frames/s | allowance |\n\
    | ----------- | ----: | ----- | -------- | ------: | -------------: | --: | -------: | --------: |\n\
    | classic     |     - | one   | exact    |       - |              - |   - |        - |         - |\n\
    | classic     |     - | one   | realtime |       - |              - |   - |        - |         - |\n\
    | classic     |     - | both  | exact    |       - |              - |   - |        - |         - |\n\
    | classic     | 10x10 | both  | realtime | 41.3 dB |          19.50 | 200 |    10.26 |      ≥ 11 |\n\
    | light-baked |     - | both  | exact    |       - |              - |   - |        - |         - |\n";

    #[test]
    fn frames_stand_next_to_the_allowance() {
        let figures = [Measured {
            cycles: Some(19_500_000),
            frames_per_second: Some(10.26),
            ..measured(DUAL_PICO, "classic", "fixed", "realtime", 3_000)
        }];
        assert_eq!(frames(Measurements(&figures)).to_string(), FRAMES);
    }

    #[test]
    fn growth_is_against_the_row_above() {
        let figures = [
            measured(M4F, "flake-10", "f32", "exact", 100_000),
            measured(M4F, "flake-91", "f32", "exact", 150_000),
        ];
        assert_eq!(
            many_objects(Measurements(&figures)).to_string(),
            "\
            | balls | instr/pixel | rays/pixel | instr/ray | growth | allowance |\n\
            | ----: | ----------: | ---------: | --------: | -----: | --------: |\n\
            |    10 |       1,000 |       2.00 |       500 |      - |         - |\n\
            |    91 |       1,500 |       2.00 |       750 |  x1.50 |    ≤ x1.6 |\n\
            |   820 |           - |          - |         - |      - |    ≤ x1.6 |\n"
        );
    }

    #[test]
    fn small_programs_have_rows_of_their_own() {
        let figures = [Measured { small: true, ..measured(M4F, "classic", "f32", "exact", 120_000) }];
        let table = memory(Measurements(&figures)).to_string();
        let rows: Vec<&str> = table.lines().skip(2).collect();
        assert!(
            rows[0].starts_with("| exact, small |       1,200 |    - | 40,000 B | ≤ 32,768 B |"),
            "{table}"
        );
        assert!(
            rows[1].starts_with("| exact        |           - |    - |        - | ≤ 32,768 B |"),
            "{table}"
        );
        assert!(rows[2].ends_with("|         - |"), "{table}");
    }
}
