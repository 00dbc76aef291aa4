//! Built-in scenes: `static`, so that firmware can draw them from flash.

mod classic;
mod costs;
mod flake;
mod prism;
mod table;
mod whitted;

pub use classic::CLASSIC;
pub use costs::{CSG, MESH, SPHERES, TORUS};
#[cfg(not(target_pointer_width = "16"))]
pub use flake::FLAKE_820;
pub use flake::{FLAKE, FLAKE_10};
pub use prism::PRISM;
pub use table::TABLE;
pub use whitted::WHITTED;

use crate::scene::Scene;

/// A built-in scene with its name.
#[derive(Clone, Copy, Debug)]
pub struct Builtin {
    /// The name.
    pub name: &'static str,
    /// A description in one line.
    pub description: &'static str,
    /// The scene.
    pub scene: &'static Scene<'static>,
    /// The number of bounces that the scene was made for.
    pub bounces: u8,
}

/// The scenes to look at.
pub static ALL: [Builtin; 5] = [
    Builtin {
        name: "classic",
        description: "four spheres of ivory, glass, rubber and mirror on a checkered floor",
        scene: &CLASSIC,
        bounces: 3,
    },
    Builtin {
        name: "whitted",
        description: "the picture of 1980: a hollow glass ball and a mirrored one over a checkered floor",
        scene: &WHITTED,
        bounces: 6,
    },
    Builtin { name: "flake", description: "the sphereflake: 91 mirroring balls", scene: &FLAKE, bounces: 4 },
    Builtin {
        name: "prism",
        description: "a glass prism among shapes of each kind",
        scene: &PRISM,
        bounces: 5,
    },
    Builtin {
        name: "table",
        description: "a die, gold, colored and clear glass, and lacquer under a lamp",
        scene: &TABLE,
        bounces: 6,
    },
];

/// The sphereflake with 10, 91 and 820 balls, to measure how the time grows with the number of objects.
pub static GROWTH: &[Builtin] = &[
    Builtin {
        name: "flake-10",
        description: "the sphereflake: 10 mirroring balls",
        scene: &FLAKE_10,
        bounces: 4,
    },
    Builtin {
        name: "flake-91",
        description: "the sphereflake: 91 mirroring balls",
        scene: &FLAKE,
        bounces: 4,
    },
    #[cfg(not(target_pointer_width = "16"))]
    Builtin {
        name: "flake-820",
        description: "the sphereflake: 820 mirroring balls",
        scene: &FLAKE_820,
        bounces: 4,
    },
];

/// Scenes with one kind of shape each, to measure its cost.
pub static COSTS: [Builtin; 4] = [
    Builtin { name: "spheres", description: "three balls on a plane", scene: &SPHERES, bounces: 3 },
    Builtin { name: "torus", description: "a torus on a plane", scene: &TORUS, bounces: 3 },
    Builtin { name: "csg", description: "a rounded cube with a hole, on a plane", scene: &CSG, bounces: 3 },
    Builtin { name: "mesh", description: "a ball of 80 triangles on a plane", scene: &MESH, bounces: 3 },
];

/// All built-in scenes: [`ALL`], [`GROWTH`] and [`COSTS`].
pub fn all() -> impl Iterator<Item = &'static Builtin> {
    ALL.iter().chain(GROWTH).chain(&COSTS)
}
