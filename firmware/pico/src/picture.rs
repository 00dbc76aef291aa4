//! The picture: scene, size and bounces, chosen when the program is built.

use rayline::{PreparedScene, Scene, Settings, Workspace};
use rayline_show::Number;

use crate::panel_color::PanelColor;

include!(concat!(env!("OUT_DIR"), "/picture.rs"));

/// The scene, in flash.
pub(crate) const SCENE: &Scene<'static> = BUILTIN.scene;

/// The scene, prepared.
pub(crate) type Prepared = PreparedScene<'static, Number>;

/// Memory for the prepared scene.
pub(crate) type Memory = Workspace<{ SCENE.bytes::<Number>() }>;

/// How the picture is rendered.
pub(crate) const SETTINGS: Settings =
    Settings { bounces: BOUNCES, ..Settings::new(WIDTH as u32, HEIGHT as u32) };

/// Processor cores that trace.
pub(crate) const CORES: usize = if cfg!(feature = "second-core") { 2 } else { 1 };

/// One line, as the panel takes it.
pub(crate) type Line = [PanelColor; WIDTH];

/// One line from each core: what is sent at once.
pub(crate) type Band = [Line; CORES];

/// A band without light.
pub(crate) const BLACK: Band = [[PanelColor::BLACK; WIDTH]; CORES];

const _: () = assert!(HEIGHT.is_multiple_of(CORES), "two cores trace an even number of lines");
