//! Scenes and images in the formats of other programs, for Rayline on the desktop.
//!
//! - [`nff`], [`obj`] and [`gltf`] read scenes and models;
//! - [`povray`] writes scenes in POV-Ray's language, and renders them with it;
//! - [`raster`] reads and writes images;
//! - [`Pictures`] are the files of images beside the file of a scene;
//! - [`files`] reads the bytes of all of them, within limits.
//!
//! `rayline-scenes` opens any scene, and has Rayline's own formats. Rays are traced only to measure the light
//! of glTF files, in a coarse picture. The workspace builds the crate with fewer optimizations than the rest:
//! its code is long, and runs once for each file.

mod exposure;
pub mod files;
mod format;
pub mod gltf;
mod meter;
mod model;
pub mod nearest;
pub mod nff;
mod notes;
pub mod obj;
mod palette;
mod pictures;
pub mod povray;
pub mod raster;
pub mod space;
pub mod srgb;
pub mod text;

pub use exposure::{Exposure, ExposureError};
pub use format::{Format, OpenOptions};
pub use model::{ModelView, Parted, Up, part};
pub use notes::Notes;
pub use pictures::Pictures;

/// Checks whether a scene can be drawn.
#[cfg(test)]
fn check(scene: &rayline::Scene<'_>) -> Result<(), rayline::SceneError> {
    let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f32>()];
    rayline::PreparedScene::<f32, _>::new(scene, &mut memory).map(|_| ())
}
