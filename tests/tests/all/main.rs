//! The core as its users see it: pictures, scenes and faults.
//!
//! One program, so that the kernel is compiled once for each number system and not once for each file.

// This is test code: where something is wrong, it panics.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing)]

mod acceleration;
mod architecture;
mod backgrounds;
mod baked;
mod causes;
mod closed_forms;
mod drawing;
mod fixed;
mod gallery;
mod goldens;
mod media;
mod operations;
mod optics;
mod own_shape;
mod povray;
mod realtime;
mod reference;
mod robustness;
mod solids;
