//! Tests of the core's public interface: pictures, scenes and faults.
//!
//! All tests are in one program, so that the kernel is compiled once for each number system, not once for
//! each file.

// This is test code, which may panic.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing)]

mod acceleration;
mod architecture;
mod backgrounds;
mod baked;
mod causes;
mod circles;
mod closed_forms;
mod coherence;
mod distributed;
mod drawing;
mod fixed;
mod gallery;
mod goldens;
mod judges;
mod looks;
mod media;
mod operations;
mod optics;
mod own_shape;
mod panels;
mod path_tracing;
mod povray;
mod preview;
mod progressive;
mod realtime;
mod reference;
mod robustness;
mod sampling;
mod smooth_edges;
mod smooth_normals;
mod solids;
