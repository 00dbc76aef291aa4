//! Writes the picture's scene, size, number system and mode as Rust, and links each program for the memory of
//! one board.
//!
//! `RAYLINE_BOARD` names the board: a folder in `boards`, with its `memory.x`. `cargo boards` sets it.

use std::env;
use std::error::Error;
use std::fs;
use std::path::Path;

/// The clock of each Cortex-M board's timer, in Hz, as QEMU runs it.
const CLOCKS: [(&str, u32); 5] = [
    ("lm3s6965evb", 25_000_000),
    ("microbit", 16_000_000),
    ("mps2-an385", 25_000_000),
    ("mps2-an386", 25_000_000),
    ("mps2-an505", 20_000_000),
];

/// The programs of this package.
const PROGRAMS: [&str; 3] = ["gallery", "lm3s6965evb", "picture"];

fn main() -> Result<(), Box<dyn Error>> {
    let number = rayline_build_support::write_number()?;
    rayline_build_support::write_picture("64x48", number)?;
    rayline_build_support::write_mode()?;

    println!("cargo:rerun-if-env-changed=RAYLINE_BOARD");
    let board = env::var("RAYLINE_BOARD")
        .map_err(|_| "set RAYLINE_BOARD to a folder in firmware/emulated/boards, or run `cargo boards`")?;
    let folder = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("boards").join(&board);
    if !folder.is_dir() {
        return Err(format!("RAYLINE_BOARD={board}: there is no folder {}", folder.display()).into());
    }
    println!("cargo:rerun-if-changed={}", folder.display());
    write_clock(&board)?;
    PROGRAMS.iter().for_each(|program| link(program, &folder));
    Ok(())
}

/// Writes the frequency of the board's clock into `clock.rs` in the build's output folder. A board without a
/// Cortex-M has a counter of instructions and needs none.
fn write_clock(board: &str) -> Result<(), Box<dyn Error>> {
    let Some((_, hertz)) = CLOCKS.iter().find(|(name, _)| *name == board) else {
        return Ok(());
    };
    let text = format!("/// The frequency of the board's clock.\nconst CLOCK_HZ: u64 = {hertz};\n");
    fs::write(Path::new(&env::var("OUT_DIR")?).join("clock.rs"), text)?;
    Ok(())
}

/// Links a program for the memory of the board in this folder.
fn link(program: &str, folder: &Path) {
    for argument in [&format!("-L{}", folder.display()), "-Tlink.x", "--nmagic"] {
        println!("cargo:rustc-link-arg-bin={program}={argument}");
    }
}
