//! Scenes to start with: `static`, so that firmware can draw them from flash.

mod classic;

pub use classic::CLASSIC;

use crate::scene::Scene;

/// A scene with a name.
#[derive(Clone, Copy, Debug)]
pub struct Builtin {
    /// What to call it.
    pub name: &'static str,
    /// What it shows, in a line.
    pub description: &'static str,
    /// The scene.
    pub scene: &'static Scene<'static>,
    /// How many bounces it is meant to be seen with.
    pub bounces: u8,
}

/// All scenes of this module.
pub static ALL: [Builtin; 1] = [Builtin {
    name: "classic",
    description: "four spheres of ivory, glass, rubber and mirror on a checkered floor",
    scene: &CLASSIC,
    bounces: 3,
}];
