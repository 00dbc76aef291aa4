//! For build scripts: what picture a program for a board renders, and how.
//!
//! `RAYLINE_SCENE` names a built-in scene or a `.rayline` file with the bytes of one, `RAYLINE_SIZE` is such as `320x240`,
//! `RAYLINE_BOUNCES` a number; where one is not given, it is `classic`, what the program's author chose, and as many bounces as the
//! scene is meant to be seen with. `RAYLINE_NUMBER` and `RAYLINE_MODE` choose among what a program offers, see [`write_number`]
//! and [`write_mode`].

use core::mem::MaybeUninit;
use std::env;
use std::error::Error;
use std::fs;
use std::path::Path;

use rayline::bake::{self, BakeError};
use rayline::math::Fixed;
use rayline::{Scene, builtin};

/// The number system that a program computes in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    /// `f32`.
    F32,
    /// [`Fixed`].
    Fixed,
}

/// Writes the picture into `picture.rs` in the build's output folder: its size and bounces, and its scene as
/// [`rayline::bake`] writes it for a number system.
///
/// # Errors
/// A variable that names no scene, size or number; bytes that are no scene; or a folder that cannot be written to.
pub fn write(usual_size: &str, number: Number) -> Result<(), Box<dyn Error>> {
    let name = variable("RAYLINE_SCENE").unwrap_or_else(|| "classic".into());
    let size = variable("RAYLINE_SIZE").unwrap_or_else(|| usual_size.into());
    let (width, height) = size.split_once('x').ok_or_else(|| format!("{size:?} is not such as 320x240"))?;
    let (width, height): (u16, u16) = (width.parse()?, height.parse()?);
    let (source, usual_bounces) =
        if name.ends_with(".rayline") { of_file(&name, number)? } else { of_builtin(&name, number)? };
    let bounces = match variable("RAYLINE_BOUNCES") {
        Some(bounces) => bounces.parse()?,
        None => usual_bounces,
    };
    let picture = format!(
        "{source}
/// Memory that the prepared scene takes.
pub const PREPARED_BYTES: usize = prepared_bytes::<Number>();
/// Width of the picture in pixels.
pub const WIDTH: usize = {width};
/// Height of the picture in pixels.
pub const HEIGHT: usize = {height};
/// How often light may be mirrored or refracted.
pub const BOUNCES: u8 = {bounces};
"
    );
    fs::write(Path::new(&env::var("OUT_DIR")?).join("picture.rs"), picture)?;
    Ok(())
}

/// A built-in scene as Rust, and how often light is mirrored in it.
fn of_builtin(name: &str, number: Number) -> Result<(String, u8), Box<dyn Error>> {
    let builtin = builtin::all().find(|builtin| builtin.name == name);
    let builtin =
        builtin.ok_or_else(|| format!("there is no built-in scene {name:?}, and files end in .rayline"))?;
    Ok((bake(builtin.scene, number)?, builtin.bounces))
}

/// The same of a file that holds the bytes of a scene.
fn of_file(path: &str, number: Number) -> Result<(String, u8), Box<dyn Error>> {
    println!("cargo:rerun-if-changed={path}");
    let bytes = fs::read(path).map_err(|error| format!("cannot read {path:?}: {error}"))?;
    let mut memory = memory_for(&bytes);
    let scene = Scene::from_bytes(&bytes, &mut memory).map_err(|error| format!("{path:?}: {error}"))?;
    Ok((bake(&scene, number)?, USUAL_BOUNCES))
}

fn bake(scene: &Scene<'_>, number: Number) -> Result<String, BakeError> {
    match number {
        Number::F32 => bake::scene::<f32>(scene),
        Number::Fixed => bake::scene::<Fixed>(scene),
    }
}

/// Memory for the lists of a scene in these bytes. Written out, numbers take a few times the bytes that they have in the file.
pub fn memory_for(bytes: &[u8]) -> Vec<MaybeUninit<u8>> {
    vec![MaybeUninit::uninit(); bytes.len().saturating_mul(64).max(1 << 16)]
}

/// How often light is mirrored where nobody says it: in scenes from files.
pub const USUAL_BOUNCES: u8 = 6;

/// Writes the number system that the program computes in into `number.rs` in the build's output folder, and tells it:
/// `RAYLINE_NUMBER` is `f32` or `fixed`, and `f32` where it is not given.
///
/// # Errors
/// A variable that names no number system; or a folder that cannot be written to.
pub fn write_number() -> Result<Number, Box<dyn Error>> {
    let (number, name) = match variable("RAYLINE_NUMBER").as_deref() {
        None | Some("f32") => (Number::F32, "f32"),
        Some("fixed") => (Number::Fixed, "rayline::math::Fixed"),
        Some(other) => return Err(format!("{other:?} is not f32 or fixed").into()),
    };
    let is_float = matches!(number, Number::F32);
    let text = format!(
        "/// The number system that the program computes in.
pub type Number = {name};
/// Whether it is floating point.
pub const IS_FLOAT: bool = {is_float};
"
    );
    fs::write(Path::new(&env::var("OUT_DIR")?).join("number.rs"), text)?;
    Ok(number)
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
