//! For build scripts of boards' programs: writes the picture that the program renders as Rust source.
//!
//! Environment variables choose the picture:
//!
//! | variable | value | default |
//! |---|---|---|
//! | `RAYLINE_SCENE` | a built-in scene, or the path of a `.rayline` file | `classic` |
//! | `RAYLINE_SIZE` | width and height, such as `320x240` | the program's own |
//! | `RAYLINE_BOUNCES` | how often a ray may be mirrored or refracted | the scene's own; 6 for a file |
//! | `RAYLINE_AREA_LIGHTS` | `sampled` or `closed-form` | `sampled` |
//! | `RAYLINE_NUMBER` | `f32` or `fixed`, see [`write_number`] | `f32` |
//! | `RAYLINE_MODE` | `exact`, `realtime`, `smooth` or `preview`, see [`write_mode`] | `exact` |

use core::mem::MaybeUninit;
use std::env;
use std::error::Error;
use std::fs;
use std::path::Path;

use rayline::bake::{self, BakeError};
use rayline::limits::MAX_PREVIEW_FACETS;
use rayline::math::Fixed;
use rayline::{PreparedScene, Preview, PreviewFacet, Real, Renderer, Scene, Settings, builtin};

/// Bounces of scenes from files, which do not say how many they need.
pub const BOUNCES_OF_FILES: u8 = 6;

/// The sides of the polygons that take the place of circles in previews.
pub const SEGMENTS: u16 = 16;

/// The value of `RAYLINE_MODE` for previews.
const PREVIEW: &str = "preview";

/// The number system of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    /// `f32`.
    F32,
    /// [`Fixed`].
    Fixed,
}

/// Writes `picture.rs` into the build's output folder: size and bounces of the picture, and its scene as
/// [`rayline::bake`] writes it for a number system. `default_size` is such as `320x240`.
///
/// # Errors
/// A variable that is no scene, size or number of bounces; a file that is no scene; or an output folder that
/// cannot be written to.
pub fn write_picture(default_size: &str, number: Number) -> Result<(), Box<dyn Error>> {
    let (width, height) = size(&variable("RAYLINE_SIZE").unwrap_or_else(|| default_size.into()))?;
    let name = variable("RAYLINE_SCENE").unwrap_or_else(|| "classic".into());
    let is_preview = variable("RAYLINE_MODE").as_deref() == Some(PREVIEW);
    let ((source, facets), default_bounces) = with_scene(&name, |scene| {
        let facets = if is_preview { facets(scene, number, (width, height))? } else { 0 };
        Ok((bake(scene, number)?, facets))
    })?;
    let bounces = match variable("RAYLINE_BOUNCES") {
        Some(bounces) => bounces
            .parse()
            .map_err(|_| format!("RAYLINE_BOUNCES={bounces}: set it to a number from 0 to 255"))?,
        None => default_bounces,
    };
    let area_lights = match variable("RAYLINE_AREA_LIGHTS").as_deref() {
        None | Some("sampled") => "Sampled",
        Some("closed-form") => "ClosedForm",
        Some(other) => {
            return Err(format!("RAYLINE_AREA_LIGHTS={other}: set it to sampled or closed-form").into());
        }
    };
    let picture = format!(
        "{source}
/// Bytes of memory for the prepared scene.
pub const PREPARED_BYTES: usize = prepared_bytes::<Number>();
/// Width of the picture in pixels.
pub const WIDTH: usize = {width};
/// Height of the picture in pixels.
pub const HEIGHT: usize = {height};
/// How often a ray may be mirrored or refracted.
pub const BOUNCES: u8 = {bounces};
/// The sides of the polygons that take the place of circles in a preview.
pub const SEGMENTS: u16 = {SEGMENTS};
/// The facets of a preview; 0 for other pictures.
pub const FACETS: usize = {facets};
/// How lamps with a size light.
pub const AREA_LIGHTS: rayline::AreaLights = rayline::AreaLights::{area_lights};
"
    );
    write("picture.rs", &picture)
}

/// How many facets are seen in the preview of a scene.
fn facets(scene: &Scene<'_>, number: Number, size: (u16, u16)) -> Result<usize, Box<dyn Error>> {
    match number {
        Number::F32 => facets_in::<f32>(scene, size),
        Number::Fixed => facets_in::<Fixed>(scene, size),
    }
}

fn facets_in<R: Real>(scene: &Scene<'_>, (width, height): (u16, u16)) -> Result<usize, Box<dyn Error>> {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R, _>::new(scene, &mut memory)?;
    let renderer = Renderer::new(&prepared, Settings::new(width.into(), height.into()))?;
    Ok(Preview::new(&renderer, SEGMENTS, &mut vec![PreviewFacet::BLANK; MAX_PREVIEW_FACETS])?.facets())
}

/// Width and height from a text such as `320x240`.
fn size(text: &str) -> Result<(u16, u16), Box<dyn Error>> {
    let sides =
        text.split_once('x').and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    sides.ok_or_else(|| format!("RAYLINE_SIZE={text}: set it to width and height, such as 320x240").into())
}

/// Calls a function with a built-in scene or that of a `.rayline` file. Returns what it returns, and the
/// scene's bounces.
fn with_scene<T>(
    name: &str,
    then: impl FnOnce(&Scene<'_>) -> Result<T, Box<dyn Error>>,
) -> Result<(T, u8), Box<dyn Error>> {
    if !name.ends_with(".rayline") {
        let builtin = builtin::all().find(|builtin| builtin.name == name).ok_or_else(|| {
            format!(
                "RAYLINE_SCENE={name}: set it to a name that `rayline scenes` prints, or to a .rayline file"
            )
        })?;
        return Ok((then(builtin.scene)?, builtin.bounces));
    }
    println!("cargo:rerun-if-changed={name}");
    let bytes = fs::read(name).map_err(|error| format!("{name} cannot be read: {error}"))?;
    let mut memory = memory_for(&bytes);
    let scene = Scene::from_bytes(&bytes, &mut memory)
        .map_err(|error| format!("{name}: {error}; write it again with `rayline convert`"))?;
    Ok((then(&scene)?, BOUNCES_OF_FILES))
}

fn bake(scene: &Scene<'_>, number: Number) -> Result<String, BakeError> {
    match number {
        Number::F32 => bake::scene::<f32>(scene),
        Number::Fixed => bake::scene::<Fixed>(scene),
    }
}

/// Memory for the lists of a scene that is read from these bytes. In memory, numbers take a few times the
/// bytes that they have in the file.
pub fn memory_for(bytes: &[u8]) -> Vec<MaybeUninit<u8>> {
    vec![MaybeUninit::uninit(); bytes.len().saturating_mul(64).max(1 << 16)]
}

/// Writes the program's number system, which `RAYLINE_NUMBER` names, into `number.rs` in the build's output
/// folder, and returns it.
///
/// # Errors
/// A variable that names no number system; or an output folder that cannot be written to.
pub fn write_number() -> Result<Number, Box<dyn Error>> {
    let (number, name) = match variable("RAYLINE_NUMBER").as_deref() {
        None | Some("f32") => (Number::F32, "f32"),
        Some("fixed") => (Number::Fixed, "rayline::math::Fixed"),
        Some(other) => return Err(format!("RAYLINE_NUMBER={other}: set it to f32 or fixed").into()),
    };
    let is_float = matches!(number, Number::F32);
    let text = format!(
        "/// The number system that the program computes in.
pub type Number = {name};
/// Whether the number system is floating point.
pub const IS_FLOAT: bool = {is_float};
"
    );
    write("number.rs", &text)?;
    Ok(number)
}

/// Writes the mode of drawing, which `RAYLINE_MODE` names, into `mode.rs` in the build's output folder.
///
/// # Errors
/// A variable that names no mode; or an output folder that cannot be written to.
pub fn write_mode() -> Result<(), Box<dyn Error>> {
    let mode = variable("RAYLINE_MODE");
    let is_preview = mode.as_deref() == Some(PREVIEW);
    let quality = match mode.as_deref() {
        None | Some("exact" | PREVIEW) => "None",
        Some("realtime") => "Some(rayline::Realtime::new())",
        Some("smooth") => "Some(rayline::Realtime::new().smooth())",
        Some(other) => {
            return Err(format!("RAYLINE_MODE={other}: set it to exact, realtime, smooth or preview").into());
        }
    };
    let text = format!(
        "/// The realtime quality that the picture is drawn in; `None` for other pictures.\n\
         pub const QUALITY: Option<rayline::Realtime> = {quality};\n\
         /// Whether the picture is a preview.\n\
         pub const IS_PREVIEW: bool = {is_preview};\n"
    );
    write("mode.rs", &text)
}

/// Writes a file into the build's output folder.
fn write(name: &str, text: &str) -> Result<(), Box<dyn Error>> {
    fs::write(Path::new(&env::var("OUT_DIR")?).join(name), text)?;
    Ok(())
}

/// The value of an environment variable; cargo builds the program again when it changes.
fn variable(name: &str) -> Option<String> {
    println!("cargo:rerun-if-env-changed={name}");
    env::var(name).ok()
}
