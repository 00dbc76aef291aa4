//! Tests through the public interface. They are no unit tests, because the library would be compiled once
//! more for these: the readers of RON and JSON take most of that time.

// All of this is test code, but clippy counts only functions with `#[test]` as such.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing)]

mod animation;
mod coplanar;
mod exposure;
mod features;
mod gltf;
mod nff;
mod obj;
mod ron;

/// Checks whether a scene can be drawn.
fn check(scene: &rayline::Scene<'_>) -> Result<(), rayline::SceneError> {
    let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f32>()];
    rayline::PreparedScene::<f32, _>::new(scene, &mut memory).map(|_| ())
}
