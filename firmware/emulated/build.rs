//! Chooses scene, size, number system and mode of the picture, and gives each board its memory layout.
//!
//! The program `gallery` is one for all boards: `RAYLINE_BOARD` names the one whose memory it is linked for.

use std::env;
use std::error::Error;
use std::fs;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let number = rayline_choice::write_number()?;
    rayline_choice::write("64x48", number)?;
    rayline_choice::write_mode()?;

    // Every board is a folder with its main.rs and memory.x.
    let boards = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("src").join("bin");
    println!("cargo:rerun-if-changed={}", boards.display());
    for entry in fs::read_dir(&boards)? {
        let entry = entry?;
        if entry.file_type()?.is_dir() {
            let name = entry.file_name().into_string().map_err(|name| format!("{name:?} is not UTF-8"))?;
            link(&name, &entry.path());
        }
    }
    if env::var_os("CARGO_FEATURE_GALLERY").is_some() {
        println!("cargo:rerun-if-env-changed=RAYLINE_BOARD");
        link("gallery", &boards.join(env::var("RAYLINE_BOARD")?));
    }
    Ok(())
}

/// Links a program for the memory of the board in this folder.
fn link(program: &str, board: &Path) {
    for argument in [&format!("-L{}", board.display()), "-Tlink.x", "--nmagic"] {
        println!("cargo:rustc-link-arg-bin={program}={argument}");
    }
}
