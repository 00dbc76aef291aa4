//! Scenes by name or from files, for Rayline on the desktop.
//!
//! - [`LoadedScene`] opens a scene by name or file;
//! - [`ron`] reads and writes Rayline's own files of scenes;
//! - [`animation`] reads key frames of a scene;
//! - [`to_bytes`] and [`rust_source`] write what programs for boards read.
//!
//! The formats of other programs are in `rayline-formats`. serde makes the code of Rayline's own formats, for
//! each type of a scene once more: it is long, and runs once for each file. So a release is built without
//! optimizations of this crate, which saves 15 s of processor time in a first build.

pub mod animation;
mod loaded;
pub mod ron;
mod source;

pub use loaded::{FILE_SETTINGS, LoadError, LoadedScene};
pub use source::{rust_source, to_bytes};
