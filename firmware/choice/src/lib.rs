//! For build scripts: what picture a program for a board renders, and how.
//!
//! `RAYLINE_SCENE` names a built-in scene, `RAYLINE_SIZE` is such as `320x240`, `RAYLINE_BOUNCES` a number; where
//! one is not given, it is `classic`, what the program's author chose, and as many bounces as the scene is meant to
//! be seen with. `RAYLINE_NUMBER` and `RAYLINE_MODE` choose among what a program offers, see [`write_number`] and
//! [`write_mode`].

mod narrow;

use std::env;
use std::error::Error;
use std::fs;
use std::path::Path;

use rayline::builtin::{self, Builtin};

/// Writes the constants of the picture into `picture.rs` in the build's output folder.
///
/// # Errors
/// A variable that names no scene, size or number; or a folder that cannot be written to.
pub fn write(usual_size: &str) -> Result<(), Box<dyn Error>> {
    let name = variable("RAYLINE_SCENE").unwrap_or_else(|| "classic".into());
    let size = variable("RAYLINE_SIZE").unwrap_or_else(|| usual_size.into());
    let (builtin, chosen) = find(&name).ok_or_else(|| format!("there is no built-in scene {name:?}"))?;
    let (width, height) = size.split_once('x').ok_or_else(|| format!("{size:?} is not such as 320x240"))?;
    let (width, height): (u16, u16) = (width.parse()?, height.parse()?);
    let bounces = match variable("RAYLINE_BOUNCES") {
        Some(bounces) => bounces.parse::<u8>()?.to_string(),
        None => "BUILTIN.bounces".into(),
    };
    let picture = format!(
        "/// The scene with its name.\n\
         pub(crate) const BUILTIN: rayline::builtin::Builtin = {builtin};\n\
         /// Width of the picture in pixels.\n\
         pub const WIDTH: usize = {width};\n\
         /// Height of the picture in pixels.\n\
         pub const HEIGHT: usize = {height};\n\
         /// How often light may be mirrored or refracted.\n\
         pub const BOUNCES: u8 = {bounces};\n"
    );
    let picture = picture + &narrow::scene(chosen.scene);
    fs::write(Path::new(&env::var("OUT_DIR")?).join("picture.rs"), picture)?;
    Ok(())
}

/// The built-in scene of this name, and where the library has it.
fn find(name: &str) -> Option<(String, Builtin)> {
    [("ALL", &builtin::ALL[..]), ("GROWTH", &builtin::GROWTH)].into_iter().find_map(|(list, builtins)| {
        let index = builtins.iter().position(|builtin| builtin.name == name)?;
        Some((format!("rayline::builtin::{list}[{index}]"), *builtins.get(index)?))
    })
}

/// Writes the number system that the program computes in into `number.rs` in the build's output folder:
/// `RAYLINE_NUMBER` is `f32` or `fixed`, and `f32` where it is not given.
///
/// # Errors
/// A variable that names no number system; or a folder that cannot be written to.
pub fn write_number() -> Result<(), Box<dyn Error>> {
    let number = match variable("RAYLINE_NUMBER").as_deref() {
        None | Some("f32") => "f32",
        Some("fixed") => "rayline::math::Fixed",
        Some(other) => return Err(format!("{other:?} is not f32 or fixed").into()),
    };
    let text = format!("/// The number system that the program computes in.\npub type Number = {number};\n");
    fs::write(Path::new(&env::var("OUT_DIR")?).join("number.rs"), text)?;
    Ok(())
}

/// Writes how the picture is drawn into `mode.rs` in the build's output folder: `RAYLINE_MODE` is `exact` or `realtime`,
/// and `exact` where it is not given.
///
/// # Errors
/// A variable that names no mode; or a folder that cannot be written to.
pub fn write_mode() -> Result<(), Box<dyn Error>> {
    let quality = match variable("RAYLINE_MODE").as_deref() {
        None | Some("exact") => "None",
        Some("realtime") => "Some(rayline::Realtime::new())",
        Some(other) => return Err(format!("{other:?} is not exact or realtime").into()),
    };
    let text = format!(
        "/// Realtime quality, if the picture is drawn in it.\n\
         pub const QUALITY: Option<rayline::Realtime> = {quality};\n"
    );
    fs::write(Path::new(&env::var("OUT_DIR")?).join("mode.rs"), text)?;
    Ok(())
}

/// An environment variable that the program depends on.
fn variable(name: &str) -> Option<String> {
    println!("cargo:rerun-if-env-changed={name}");
    env::var(name).ok()
}
