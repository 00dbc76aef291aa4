//! Scenes for programs on boards: as bytes, and as Rust source.

use rayline::bake::{self, BakeError};
use rayline::math::Fixed;
use rayline::{BytesError, Scene};

/// The bytes of a scene for [`Scene::from_bytes`].
///
/// # Errors
/// The scene cannot be written as bytes.
pub fn to_bytes(scene: &Scene<'_>) -> Result<Vec<u8>, BytesError> {
    /// The limit: far more than fits a microcontroller.
    const MOST: usize = 1 << 30;
    let mut room = 1 << 12;
    loop {
        let mut bytes = vec![0; room];
        match scene.to_bytes(&mut bytes).map(|written| written.len()) {
            Ok(written) => {
                bytes.truncate(written);
                return Ok(bytes);
            }
            Err(BytesError::NoRoom) if room < MOST => room *= 4,
            Err(error) => return Err(error),
        }
    }
}

/// The Rust source of a scene ([`bake::scene`]), for a program that computes in fixed point or in `f32`.
///
/// # Errors
/// The scene cannot be written as Rust source.
pub fn rust_source(scene: &Scene<'_>, is_fixed_point: bool) -> Result<String, BakeError> {
    if is_fixed_point { bake::scene::<Fixed>(scene) } else { bake::scene::<f32>(scene) }
}
