//! The picture: scene, size and bounces, chosen when the program is built.

use rayline::{Scene, Settings, Workspace};

include!(concat!(env!("OUT_DIR"), "/picture.rs"));

/// The scene, in flash.
pub const SCENE: &Scene<'static> = BUILTIN.scene;

/// Memory for the prepared scene.
pub type Memory = Workspace<{ SCENE.bytes::<f32>() }>;

/// How the picture is rendered.
pub const SETTINGS: Settings = Settings { bounces: BOUNCES, ..Settings::new(WIDTH as u32, HEIGHT as u32) };
