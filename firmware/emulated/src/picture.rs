//! The picture's scene, size, bounces, number system and mode, which `build.rs` wrote.

use embedded_graphics::prelude::PixelColor;
use rayline::limits::LINES_AT_ONCE;
use rayline::{PreviewFacet, PreviewPixel, Sample, Settings, Workspace};

include!(concat!(env!("OUT_DIR"), "/picture.rs"));
include!(concat!(env!("OUT_DIR"), "/number.rs"));
include!(concat!(env!("OUT_DIR"), "/mode.rs"));

/// Memory for the prepared scene.
pub type Memory = Workspace<PREPARED_BYTES>;

/// Lines that are drawn at once: several where pixels are traced side by side, which needs many objects and
/// floating point.
pub const LINES: usize = if cfg!(feature = "hierarchy") && IS_FLOAT { LINES_AT_ONCE } else { 1 };

/// The settings of the renderer.
pub const SETTINGS: Settings =
    Settings { bounces: BOUNCES, area_lights: AREA_LIGHTS, ..Settings::new(WIDTH as u32, HEIGHT as u32) };

/// Number of colors in the buffer: those of [`LINES`], of the band of lines that realtime quality needs, or
/// of one line of a preview.
const COLORS: usize = match QUALITY {
    None if IS_PREVIEW => WIDTH,
    None => WIDTH * LINES,
    Some(quality) => quality.colors(WIDTH as u16),
};

/// Number of samples in the buffer, which realtime quality needs.
const SAMPLES: usize = match QUALITY {
    None => 0,
    Some(quality) => quality.samples(WIDTH as u16),
};

/// Number of pixels with their depth in the buffer, which a preview needs.
const PIXELS: usize = if IS_PREVIEW { WIDTH } else { 0 };

/// Memory for the lines that are being drawn.
#[derive(Debug)]
pub struct Buffer<C> {
    /// Colors of whole lines.
    pub colors: [C; COLORS],
    /// Samples of one line.
    pub samples: [Sample; SAMPLES],
    /// Facets of a preview.
    pub facets: [PreviewFacet; FACETS],
    /// Pixels of a line of a preview.
    pub pixels: [PreviewPixel; PIXELS],
}

impl<C: PixelColor> Buffer<C> {
    /// A buffer whose pixels have this color.
    pub const fn new(color: C) -> Self {
        let facets = [PreviewFacet::BLANK; FACETS];
        let pixels = [PreviewPixel::BLANK; PIXELS];
        Self { colors: [color; COLORS], samples: [Sample::BLANK; SAMPLES], facets, pixels }
    }
}
