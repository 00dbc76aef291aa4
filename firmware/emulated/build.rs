//! Chooses scene, size, number system and mode of the picture, and gives each board its memory layout.

use std::env;
use std::error::Error;
use std::fs;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    rayline_choice::write("64x48")?;
    rayline_choice::write_number()?;
    rayline_choice::write_mode()?;

    // Every board is a folder with its main.rs and memory.x.
    let boards = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("src").join("bin");
    println!("cargo:rerun-if-changed={}", boards.display());
    for board in fs::read_dir(boards)? {
        let board = board?;
        let name = board.file_name().into_string().map_err(|name| format!("{name:?} is not UTF-8"))?;
        for argument in [&format!("-L{}", board.path().display()), "-Tlink.x", "--nmagic"] {
            println!("cargo:rustc-link-arg-bin={name}={argument}");
        }
    }
    Ok(())
}
