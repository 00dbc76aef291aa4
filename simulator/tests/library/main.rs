//! Tests of the library that render pictures. The kernels are compiled once, with the library: among its unit
//! tests they would be compiled once more.

// All of this is test code, but clippy counts only functions with `#[test]` as such.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing)]

mod caustics;
mod demands;
mod light;
mod pictures;
