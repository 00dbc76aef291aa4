//! The picture's scene, size, bounces and quality, which `build.rs` wrote.

use rayline::{PreparedScene, Settings};

include!(concat!(env!("OUT_DIR"), "/picture.rs"));
include!(concat!(env!("OUT_DIR"), "/mode.rs"));

/// The number system that the program computes in.
pub(crate) type Number = rayline::math::Fixed;

/// The prepared scene.
pub(crate) type Prepared = PreparedScene<'static, Number, Set>;

/// Memory for the prepared scene.
pub(crate) type Workspace = rayline::Workspace<PREPARED_BYTES>;

const _: () = assert!(!IS_PREVIEW, "this program draws no previews: set RAYLINE_MODE to another mode");

/// How the picture is rendered.
pub(crate) const SETTINGS: Settings =
    Settings { bounces: BOUNCES, area_lights: AREA_LIGHTS, ..Settings::new(WIDTH as u32, HEIGHT as u32) };

/// Lines of a band, which is traced and sent at once. A band consists of whole cells of realtime quality's
/// grid. 120 lines are three bands of the same size, so that neither core waits for the other. Bands of 24
/// lines take 5 % longer, because some samples are traced twice where bands meet; bands of 32 lines take 16 %
/// longer, because the last one is shorter.
pub(crate) const LINES: usize = 40;
