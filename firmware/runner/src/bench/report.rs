//! The page of all tables, `docs/benchmarks.md`.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use super::measured::Measurements;
use super::tables;

/// The most columns of a line of text.
const COLUMNS: usize = 110;

const HEAD: &str = "\
# Benchmarks

A command writes this page; do not edit it.

```sh
cargo boards --bench --report docs/benchmarks.md  # measures everything, in about half an hour
cargo boards --report docs/benchmarks.md          # writes `On boards` again from firmware/boards.json
```
";

/// The heading of the part that boards measure, and of the part that the desktop measures.
const ON_BOARDS: &str = "## On boards\n";
const ON_THE_DESKTOP: &str = "## On the desktop\n";

/// The page. Each part begins with its heading.
#[derive(Debug)]
pub(super) struct Page {
    on_boards: String,
    on_the_desktop: String,
}

impl Page {
    /// The page in a file; empty parts if there is no such file.
    pub(super) fn read(file: &Path) -> Self {
        let text = fs::read_to_string(file).unwrap_or_default();
        let part =
            |heading| text.find(heading).and_then(|start| text.get(start..)).unwrap_or(heading).to_owned();
        let on_boards = part(ON_BOARDS);
        let end = on_boards.find(ON_THE_DESKTOP).unwrap_or(on_boards.len());
        Self {
            on_boards: on_boards.get(..end).unwrap_or_default().into(),
            on_the_desktop: part(ON_THE_DESKTOP),
        }
    }

    /// The page with other figures of boards, which this compiler built programs for.
    pub(super) fn with_boards(self, measured: Measurements<'_>, compiler: &str) -> Self {
        let introduction = wrapped(&format!(
            "Emulators count instructions; a count is the same on every run. It holds for one compiler: \
             {compiler}. \
             Instructions of the display's driver are not counted. PSNR is that of the picture in 8-bit \
             sRGB: of a \
             realtime picture against the exact one in the same number system, of an exact one in fixed \
             point \
             against `f64`. Flash holds program and scene; RAM holds everything static, with the prepared \
             scene and \
             the line buffer; the stack is its largest size during the run. An allowance is a limit that \
             `cargo boards --bench --check` keeps; it also fails if instructions or flash rise by more than \
             2 % over \
             `firmware/boards.json`.\n\n\
             M4F, M7 and M33 have an FPU; the other boards of QEMU compute `f32` in software in the first \
             table, at a \
             small size. M3 is `mps2-an385`. M0 is `microbit` for `classic`; for scenes that its 16 KB of \
             RAM cannot \
             hold, it is the same code on a Cortex-M3 with more memory. `flake-91` has 91 balls, \
             `show-teapot` is a \
             mesh of 2,120 triangles, `light-baked` the Cornell box with its light in textures. \"Small\" \
             programs leave out the features that only make exact pictures faster."
        ));
        let mut on_boards = format!("{ON_BOARDS}\n{introduction}\n");
        for (heading, table) in tables::all(measured) {
            // Writing to a `String` does not fail.
            _ = write!(on_boards, "### {heading}\n\n{table}\n");
        }
        Self { on_boards, ..self }
    }

    /// The page with other figures of the desktop.
    pub(super) fn with_desktop(self, text: String) -> Self {
        Self { on_the_desktop: format!("{ON_THE_DESKTOP}\n{}", wrapped(text.trim_end())), ..self }
    }

    pub(super) fn write(&self, file: &Path) -> Result<()> {
        fs::write(file, self.text()).with_context(|| file.display().to_string())
    }

    fn text(&self) -> String {
        format!("{HEAD}\n{}\n\n{}\n", self.on_boards.trim_end(), self.on_the_desktop.trim_end())
    }
}

/// Text whose paragraphs have lines of at most [`COLUMNS`] columns. Tables stay as they are.
fn wrapped(text: &str) -> String {
    let mut wrapped = String::new();
    for line in text.lines() {
        if line.starts_with('|') {
            wrapped += line;
        } else {
            let mut column = 0;
            for word in line.split_whitespace() {
                let length = word.chars().count();
                if column > 0 && column + 1 + length > COLUMNS {
                    wrapped.push('\n');
                    column = 0;
                } else if column > 0 {
                    wrapped.push(' ');
                    column += 1;
                }
                wrapped += word;
                column += length;
            }
        }
        wrapped.push('\n');
    }
    wrapped
}

#[cfg(test)]
mod tests {
    use super::super::committed::Committed;
    use super::super::tables::{bytes, per_pixel};
    use super::*;

    #[test]
    fn paragraphs_are_wrapped_and_tables_are_not() {
        let row = format!("| {} |", "x".repeat(120));
        let text = wrapped(&format!("{}\n\n{row}\n", "word ".repeat(30)));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.iter().map(|line| line.len()).collect::<Vec<_>>(), [109, 39, 0, 124]);
    }

    #[test]
    fn a_page_keeps_its_other_part() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("benchmarks.md");
        let page = Page::read(&file).with_desktop("Fast.".into()).with_boards(Measurements(&[]), "rustc 1");
        page.write(&file).unwrap();
        let other = Page::read(&file).with_boards(Measurements(&[]), "rustc 2");
        assert_eq!(other.text(), page.text().replace("rustc 1", "rustc 2"));
        assert!(other.text().ends_with("## On the desktop\n\nFast.\n"), "{}", other.text());
        assert_eq!(Page::read(&file).with_desktop("Fast.".into()).text(), page.text());
    }

    #[test]
    fn the_page_with_the_source_shows_the_committed_figures() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/benchmarks.md");
        let Committed { compiler, measured } = Committed::read().unwrap();
        let page = Page::read(&file).with_boards(Measurements(&measured), &compiler);
        assert!(
            page.text() == fs::read_to_string(&file).unwrap(),
            "docs/benchmarks.md does not show firmware/boards.json: run `cargo boards --report \
             docs/benchmarks.md`"
        );
    }

    #[test]
    fn the_readme_shows_the_committed_figures() {
        let readme =
            fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../README.md")).unwrap();
        let Committed { measured, .. } = Committed::read().unwrap();
        for board in ["mps2-an386", "mps2-an385", "microbit"] {
            let number = if board == "mps2-an386" { "f32" } else { "fixed" };
            let of = |mode| {
                let name = format!("{board} classic 320x240 {number} {mode}");
                measured.iter().find(|measured| measured.name() == name).unwrap()
            };
            let (exact, realtime) = (of("exact"), of("realtime"));
            let cells = [
                number.to_owned(),
                per_pixel(exact),
                per_pixel(realtime),
                bytes(exact.text_bytes),
                bytes(exact.ram_bytes()),
            ];
            let row = readme.lines().find(|line| line.starts_with(&format!("| {board} "))).unwrap();
            let shown: Vec<&str> =
                row.split('|').skip(3).map(str::trim).filter(|cell| !cell.is_empty()).collect();
            assert_eq!(shown, cells, "README.md, {board}: write these figures of firmware/boards.json");
        }
    }
}
