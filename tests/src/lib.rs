//! Code that the tests share: the scenes, pictures of them by the core and by an independent textbook
//! renderer, and the comparison of pictures.

// This crate is test code, which may panic.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing)]

mod comparison;
mod core_picture;
mod counted;
mod picture;
mod povray;
mod random;
mod scenes;
mod screen;
pub mod textbook;
mod watch;

pub use comparison::{Comparison, assert_alike};
pub use core_picture::{core_picture, ray_counts};
pub use counted::{Counted, Operations, operations_of};
pub use picture::Picture;
pub use povray::PovrayPicture;
pub use random::{
    backgrounds, cut_box, instances, lamps, lights, maps, meshes, metaballs, numbers, optics, shapes,
    textures, turned_box, vectors,
};
pub use scenes::{scene_names, settings, with_scene};
pub use screen::{Screen, Unplugged};
pub use watch::Watch;

/// The example of the README compiles.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
