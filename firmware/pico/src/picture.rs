//! The picture: scene, size, bounces and quality, chosen when the program is built.

use rayline::{PreparedScene, Settings};
use rayline_show::Number;

include!(concat!(env!("OUT_DIR"), "/picture.rs"));
include!(concat!(env!("OUT_DIR"), "/mode.rs"));

/// The scene, prepared.
pub(crate) type Prepared = PreparedScene<'static, Number, Set>;

/// Memory for the prepared scene.
pub(crate) type Workspace = rayline::Workspace<PREPARED_BYTES>;

/// How the picture is rendered.
pub(crate) const SETTINGS: Settings =
    Settings { bounces: BOUNCES, ..Settings::new(WIDTH as u32, HEIGHT as u32) };

/// Lines that are traced and sent at once: whole cells of the realtime quality's grid, and as many in each band, so that no core waits for
/// the other: three of 120 lines. In bands of 24, tracing takes 5 % longer, because some samples are traced twice where bands meet; in
/// bands of 32, of which the last is shorter, 16 %.
pub(crate) const LINES: usize = 40;
