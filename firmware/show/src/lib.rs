//! What a board shows, frame after frame: a camera that goes around a scene.
//!
//! Board and host both take the camera from here, so that their pictures can be compared byte for byte.

#![cfg_attr(not(test), no_std)]

mod orbit;

pub use orbit::Orbit;

/// The number system in which the frames are rendered.
pub type Number = rayline::math::Fixed;
