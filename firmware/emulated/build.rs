//! Chooses scene and size of the picture, and gives each board its memory layout.
//!
//! `RAYLINE_SCENE` names a built-in scene, `RAYLINE_SIZE` is such as `320x240`, `RAYLINE_BOUNCES` a number; where
//! one is not given, it is `classic`, 64x48, and as many bounces as the scene is meant to be seen with.

use std::env;
use std::error::Error;
use std::fs;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let name = variable("RAYLINE_SCENE").unwrap_or_else(|| "classic".into());
    let size = variable("RAYLINE_SIZE").unwrap_or_else(|| "64x48".into());
    let index = rayline::builtin::ALL
        .iter()
        .position(|builtin| builtin.name == name)
        .ok_or_else(|| format!("there is no built-in scene {name:?}"))?;
    let (width, height) = size.split_once('x').ok_or_else(|| format!("{size:?} is not such as 320x240"))?;
    let (width, height): (u16, u16) = (width.parse()?, height.parse()?);
    let bounces = match variable("RAYLINE_BOUNCES") {
        Some(bounces) => bounces.parse::<u8>()?.to_string(),
        None => "BUILTIN.bounces".into(),
    };
    let picture = format!(
        "const BUILTIN: rayline::builtin::Builtin = rayline::builtin::ALL[{index}];\n\
         /// Width of the picture in pixels.\n\
         pub const WIDTH: usize = {width};\n\
         /// Height of the picture in pixels.\n\
         pub const HEIGHT: usize = {height};\n\
         /// How often light may be mirrored or refracted.\n\
         pub const BOUNCES: u8 = {bounces};\n"
    );
    fs::write(Path::new(&env::var("OUT_DIR")?).join("picture.rs"), picture)?;

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

/// An environment variable that the program depends on.
fn variable(name: &str) -> Option<String> {
    println!("cargo:rerun-if-env-changed={name}");
    env::var(name).ok()
}
