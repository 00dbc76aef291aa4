//! Scenes and images from files, for Rayline on the desktop.
//!
//! - [`LoadedScene`] opens a scene by name or file;
//! - [`ron`] reads and writes Rayline's scene files, [`nff`], [`obj`] and [`gltf`] read other formats;
//! - [`animation`] reads key frames of a scene;
//! - [`to_bytes`] and [`rust_source`] write what programs for boards read;
//! - [`Pictures`] are the files of images beside the file of a scene;
//! - [`povray`] writes scenes in POV-Ray's language, and renders them with it;
//! - [`raster`] reads and writes images;
//! - [`files`] reads the bytes of all of them, within limits.
//!
//! Rays are traced only to measure the light of glTF files, in a coarse picture. The workspace builds the
//! crate with fewer optimizations than the rest: its code is long, and runs once for each file.

pub mod animation;
mod exposure;
pub mod files;
pub mod gltf;
mod loaded;
mod meter;
mod model;
mod nearest;
pub mod nff;
mod notes;
pub mod obj;
mod palette;
mod pictures;
pub mod povray;
pub mod raster;
pub mod ron;
mod source;
mod space;
pub mod srgb;
mod text;

pub use exposure::{Exposure, ExposureError};
pub use loaded::{FILE_SETTINGS, Format, LoadError, LoadedScene, OpenOptions};
pub use model::{ModelView, Up};
pub use pictures::Pictures;
pub use source::{rust_source, to_bytes};

/// Checks whether a scene can be drawn.
#[cfg(test)]
fn check(scene: &rayline::Scene<'_>) -> Result<(), rayline::SceneError> {
    let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f32>()];
    rayline::PreparedScene::<f32, _>::new(scene, &mut memory).map(|_| ())
}
