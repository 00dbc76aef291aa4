//! The picture: scene, size, bounces and number system, chosen when the program is built.

use rayline::{Scene, Settings, Workspace};

include!(concat!(env!("OUT_DIR"), "/picture.rs"));
include!(concat!(env!("OUT_DIR"), "/number.rs"));

/// The scene, in flash.
pub const SCENE: &Scene<'static> = BUILTIN.scene;

/// Memory for the prepared scene.
pub type Memory = Workspace<{ SCENE.bytes::<Number>() }>;

/// How the picture is rendered.
pub const SETTINGS: Settings = Settings { bounces: BOUNCES, ..Settings::new(WIDTH as u32, HEIGHT as u32) };
