//! From light to the display, line by line.
//!
//! A [`Renderer`] is one picture: scene, settings and size. [`pixel`] traces the samples of one pixel.
//! [`line`] traces the pixels of a line in exact quality, each by itself; [`groups`] traces neighboring
//! pixels of large scenes together; [`progressive`] adds one sample of each pixel after the other;
//! [`realtime`] traces few pixels and interpolates the rest; [`preview`] traces none. Pixels leave the tracer
//! as [`LinearRgb`], become [`Light16`] and then a [`DisplayColor`], by a [`Quantizer`].
//!
//! A [`Frame`] sends complete bands of lines to the display. The tracing is done by a [`painter`] of one
//! [`Quality`].
//!
//! Nothing below `Renderer::light_in` is generic over the color. With the feature `hierarchy`, the code
//! that traces a pixel is therefore compiled once for all colors; without it, that code is inlined into each
//! painter, which is faster on small processors.

#[cfg(feature = "looks")]
mod contours;
mod digest;
mod display_color;
mod error;
mod exact;
mod frame;
mod groups;
mod image;
mod interleave;
mod line;
mod line_candidates;
#[cfg(feature = "looks")]
mod look;
mod outline;
mod outlines;
mod painter;
#[cfg(feature = "looks")]
mod palette;
mod pattern;
mod pixel;
mod pixel_sum;
mod preview;
mod progressive;
mod quality;
mod quantize;
mod realtime;
mod region;
mod settings;
mod span;
#[cfg(feature = "looks")]
mod thresholds;
mod tone;
#[cfg(feature = "looks")]
mod toon;
mod unchanged;

pub use digest::Digest;
pub use display_color::DisplayColor;
pub use error::{DrawError, LineError, PreviewError, SettingsError};
pub use frame::{Frame, Progress};
pub use image::RenderedImage;
pub use interleave::Interleave;
#[cfg(feature = "looks")]
pub use look::{Contours, Look, Tones};
#[cfg(feature = "looks")]
pub use palette::Palette;
pub use pattern::Pattern;
pub use pixel_sum::PixelSum;
pub use preview::{Preview, PreviewBuffer, PreviewFacet, PreviewPixel};
pub use progressive::Progressive;
pub use quality::Quality;
pub use quantize::{Light16, Quantizer};
pub use realtime::{Edges, Grid, Realtime, RealtimeBuffer, Sample};
pub use settings::{Dither, Settings, Transfer};
pub use tone::{Tone, ToneScale};

use core::ops::Range;

#[cfg(feature = "looks")]
use contours::PreparedContours;
use exact::trace_region;
use outlines::Outlines;
use region::Region;

use embedded_graphics::draw_target::DrawTarget;

use crate::camera::Viewport;
use crate::color::LinearRgb;
use crate::integrator::{AreaLights, Integrator, RayLimits, Sight};
use crate::math::Real;
use crate::prepared::PreparedScene;
use crate::probe::Probe;
use crate::sampling::Sampling;
use crate::shape::{Geometry, Shape};

/// Renders any line of one picture, of a size that is fixed when the renderer is made.
///
/// A picture is a pure function of scene and settings: its lines can be rendered in any order, and by any
/// number of cores that each have a `&Renderer`.
#[derive(Clone, Copy, Debug)]
pub struct Renderer<'p, 'm, R: Real, S: Geometry + 'm = Shape<'m>> {
    scene: &'p PreparedScene<'m, R, S>,
    viewport: Viewport<R>,
    width: u16,
    height: u16,
    limits: RayLimits<R>,
    /// The share of each sample in the light of its pixel.
    sample_weight: R,
    settings: Settings,
    #[cfg(feature = "looks")]
    contours: Option<PreparedContours<R>>,
    /// Whether the rays of a sample draw numbers.
    is_distributed: bool,
    /// The places at which objects and shadows can be seen. They are known for the centers of pixels, so
    /// for one sample a pixel.
    outlines: Outlines,
}

impl<'p, 'm, R: Real, S: Geometry + 'm> Renderer<'p, 'm, R, S> {
    /// A renderer of this scene.
    ///
    /// # Errors
    /// If a setting is out of range: which one.
    pub fn new(scene: &'p PreparedScene<'m, R, S>, settings: Settings) -> Result<Self, SettingsError> {
        let (width, height) = settings.check()?;
        let viewport = Viewport::new(scene.camera(), width, height);
        #[cfg(feature = "distributed")]
        let viewport = viewport.without_hidden_lens(|viewport| scene.nearest_depth(viewport));
        let Sampling { samples, .. } = settings.sampling;
        let mut renderer = Self {
            scene,
            viewport,
            width,
            height,
            limits: RayLimits {
                bounces: settings.bounces,
                cutoff: R::from_f32(settings.cutoff),
                #[cfg(feature = "distributed")]
                area_lights: settings.area_lights,
                #[cfg(feature = "path-tracing")]
                integrator: settings.integrator,
                #[cfg(feature = "looks")]
                gooch: match settings.look.tones {
                    Tones::Gooch(gooch) => Some(gooch),
                    _ => None,
                },
            },
            sample_weight: R::from_setup(R::Setup::from_u16(samples).recip()),
            settings,
            #[cfg(feature = "looks")]
            contours: settings.look.contours.as_ref().map(PreparedContours::new),
            is_distributed: viewport.has_lens()
                || settings.integrator != Integrator::Whitted
                || scene.is_distributed(settings.area_lights == AreaLights::Sampled),
            outlines: Outlines::UNKNOWN,
        };
        // Several samples lie beside outlines.
        if samples == 1 && renderer.has_sharp_outlines() {
            renderer.outlines.find(scene, &renderer.viewport);
            renderer.outlines.find_shadows(scene, &renderer.viewport);
        }
        Ok(renderer)
    }

    /// Whether the camera has no lens and does not move, so that each object has one outline in the picture.
    fn has_sharp_outlines(&self) -> bool {
        !(self.viewport.has_lens() || self.scene.moves_camera())
    }

    /// Width of the picture in pixels.
    pub fn width(&self) -> u32 {
        u32::from(self.width)
    }

    /// Height of the picture in pixels.
    pub fn height(&self) -> u32 {
        u32::from(self.height)
    }

    /// The light that pixel (x, y) receives, and the rays that it took: at most
    /// [`Settings::rays_per_pixel`].
    ///
    /// Pixels beside the picture are defined too; with [`Fixed`](crate::math::Fixed), up to 16 times its
    /// width and height.
    pub fn pixel(&self, x: u16, y: u16, probe: &mut impl Probe<R>) -> (LinearRgb<R>, u32) {
        self.light_at(self.pixel_at(x, y), Sight::among(self.scene.all()), probe)
    }

    /// Adds to a pixel what one pass of [`Progressive`] adds, and returns the color of its samples so far. If
    /// the sum is [complete](PixelSum::is_complete), that is the color of the picture that is drawn at once.
    pub fn refine<C: DisplayColor>(
        &self,
        x: u16,
        y: u16,
        sum: &mut PixelSum<R>,
        probe: &mut impl Probe<R>,
    ) -> C {
        self.color(self.refined(self.pixel_at(x, y), sum, probe), x, y)
    }

    /// Renders line `y` into the first pixels of a slice, which is as long as the picture is wide or longer.
    ///
    /// # Errors
    /// If the slice is shorter or the picture has no such line; no pixel is then rendered.
    pub fn line<C: DisplayColor>(&self, y: u32, line: &mut [C]) -> Result<(), LineError> {
        let pixels = line.len().min(usize::from(self.width));
        self.lines(y, line.get_mut(..pixels).unwrap_or_default(), &mut ())
    }

    /// Renders as many whole lines as a slice holds, from line `y` on. The probe records what happens.
    ///
    /// A multiple of [`LINES_AT_ONCE`](crate::limits::LINES_AT_ONCE) lines may take less time than one line
    /// after the other.
    ///
    /// # Errors
    /// If the slice does not hold one whole line, or the picture has no such lines; no pixel is then
    /// rendered.
    pub fn lines<C: DisplayColor>(
        &self,
        y: u32,
        lines: &mut [C],
        probe: &mut impl Probe<R>,
    ) -> Result<(), LineError> {
        self.check_line(lines.len())?;
        let height = u32::try_from(lines.len() / usize::from(self.width).max(1)).unwrap_or(u32::MAX);
        let last = y.saturating_add(height.saturating_sub(1));
        if last >= self.height() {
            return Err(LineError::NoSuchLine { line: last, height: self.height() });
        }
        let region = Region { top: y, bottom: last.saturating_add(1), ..self.whole() };
        let pixels = height as usize * usize::from(self.width);
        trace_region(self, &region, lines.get_mut(..pixels).unwrap_or_default(), &mut 0, u32::MAX, probe);
        Ok(())
    }

    /// Whether this many pixels hold a line of the picture.
    fn check_line(&self, pixels: usize) -> Result<(), LineError> {
        if pixels < usize::from(self.width) {
            return Err(LineError::BufferLength { given: pixels, width: self.width() });
        }
        Ok(())
    }

    /// The whole picture.
    fn whole(&self) -> Region {
        Region::whole(self.width, self.height)
    }

    /// The lines of a range that are to be drawn; `0..0` if there is nothing to draw.
    fn lines_of(&self, lines: Range<u32>) -> Result<Range<u32>, LineError> {
        // An empty range may begin anywhere.
        if lines.is_empty() {
            return Ok(0..0);
        }
        if lines.end > self.height() {
            return Err(LineError::NoSuchLine { line: lines.end.wrapping_sub(1), height: self.height() });
        }
        Ok(lines)
    }

    /// Draws the picture with its upper left corner at (0, 0): one `fill_contiguous` for each band of lines.
    /// The lent memory says in which [`Quality`]: `&mut line` draws exactly, with one line or as many whole
    /// lines as are to be sent together.
    ///
    /// Only what lies in the display's `bounding_box()` is traced and sent. The box may begin elsewhere, as
    /// the box of a `translated` display does: `display.translated(display.bounding_box().top_left)` has
    /// (0, 0) in the upper left corner of `display`.
    ///
    /// # Errors
    /// Memory of the wrong length, before the first pixel; or the display's own error, with the line from
    /// which a [`frame`](Self::frame) goes on.
    pub fn draw<D, Q>(&self, display: &mut D, quality: Q) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget,
        Q: Quality<R, Color = D::Color>,
    {
        quality.check(self)?;
        // A frame is large: in a `Result`, it would be copied.
        Frame::new(self, 0..self.height(), quality).draw(display)
    }

    /// Begins to draw some lines of the picture, each where it belongs. [`Frame::draw`] draws them at once,
    /// and [`Frame::step`] in steps of bounded work.
    ///
    /// # Errors
    /// Memory of the wrong length, or lines that the picture does not have.
    pub fn frame<Q: Quality<R>>(
        &self,
        lines: Range<u32>,
        quality: Q,
    ) -> Result<Frame<'_, 'm, R, S, Q>, LineError> {
        let lines = self.lines_of(lines)?;
        quality.check(self)?;
        Ok(Frame::new(self, lines, quality))
    }
}
