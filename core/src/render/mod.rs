//! From light to the display, line by line.

mod digest;
mod display_color;
mod error;
mod frame;
mod groups;
mod interleave;
mod line_candidates;
mod outline;
mod outlines;
mod painter;
mod pattern;
mod quantize;
mod realtime;
mod settings;
mod span;
mod tone;
mod unchanged;

pub use digest::Digest;
pub use display_color::DisplayColor;
pub use error::{DrawError, LineError, SettingsError};
pub use frame::{Frame, Progress};
pub use interleave::Interleave;
pub use pattern::Pattern;
pub use quantize::{Dither, Light16, Quantizer, Transfer};
pub use realtime::{Grid, Realtime, RealtimeBuffer, RealtimeFrame, Sample};
pub use settings::Settings;
pub use tone::Tone;

use core::ops::Range;

use groups::Groups;
use outlines::Outlines;
use painter::LinePainter;

use embedded_graphics::draw_target::DrawTarget;

use crate::camera::Viewport;
use crate::color::LinearRgb;
use crate::integrator::{Bounds, RayBudget, Sight, radiance};
use crate::math::Real;
use crate::prepared::PreparedScene;
use crate::probe::Probe;
use crate::sampler::sample_position;
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
    bounds: Bounds<R>,
    sample_weight: R,
    settings: Settings,
    /// Where objects and shadows can be seen. Outlines hold for the centers of pixels.
    outlines: Outlines,
}

impl<'p, 'm, R: Real, S: Geometry + 'm> Renderer<'p, 'm, R, S> {
    /// A renderer of this scene.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(scene: &'p PreparedScene<'m, R, S>, settings: Settings) -> Result<Self, SettingsError> {
        let (width, height) = settings.check()?;
        let viewport = Viewport::new(scene.camera(), width, height);
        let mut renderer = Self {
            scene,
            viewport,
            width,
            height,
            bounds: Bounds { bounces: settings.bounces, cutoff: R::from_f32(settings.cutoff) },
            sample_weight: R::from_setup(R::Setup::from_u16(settings.samples_per_pixel).recip()),
            settings,
            outlines: Outlines::UNKNOWN,
        };
        if settings.samples_per_pixel == 1 {
            renderer.outlines.find(scene, &renderer.viewport);
            renderer.outlines.find_shadows(scene, &renderer.viewport);
        }
        Ok(renderer)
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
    /// [`Settings::rays_per_pixel`]. Pixels outside the picture are defined too: the camera sees on (with [`Fixed`](crate::math::Fixed)
    /// for 16 times the picture's width and height).
    pub fn pixel(&self, x: u16, y: u16, probe: &mut impl Probe<R>) -> (LinearRgb<R>, u32) {
        self.light_at(x, y, Sight::among(self.scene.all()), probe)
    }

    /// As [`pixel`](Self::pixel), with what is known of it.
    fn light_at(&self, x: u16, y: u16, sight: Sight<'_>, probe: &mut impl Probe<R>) -> (LinearRgb<R>, u32) {
        self.light_in(self.scene, &self.bounds, (x, y), sight, probe)
    }

    /// As [`light_at`](Self::light_at), in another scene and with other bounds.
    #[inline(always)]
    fn light_in(
        &self,
        scene: &PreparedScene<'m, R, S>,
        bounds: &Bounds<R>,
        (x, y): (u16, u16),
        sight: Sight<'_>,
        probe: &mut impl Probe<R>,
    ) -> (LinearRgb<R>, u32) {
        let Settings { samples_per_pixel: samples, seed, rays_per_pixel, .. } = self.settings;
        let mut rays = RayBudget(rays_per_pixel);
        let mut light = LinearRgb::BLACK;
        // The sum of many samples may be out of reach, where their mean is not.
        let weighs_first = R::REACH.is_some() && samples > 1;
        let mut sample = 0;
        loop {
            let (right, down) = sample_position(x, y, sample, samples, seed);
            let ray = self.viewport.ray((x, right), (y, down));
            let shown = radiance(scene, ray, sight, bounds, &mut rays, probe);
            if samples <= 1 {
                return (shown, rays_per_pixel.saturating_sub(rays.0));
            }
            light = light + if weighs_first { shown.scaled(self.sample_weight) } else { shown };
            sample += 1;
            if sample >= samples {
                break;
            }
        }
        if !weighs_first {
            light = light.scaled(self.sample_weight);
        }
        (light, rays_per_pixel.saturating_sub(rays.0))
    }

    /// Renders line `y` into a slice of the picture's width.
    ///
    /// # Errors
    /// Before the first pixel, where the slice has another length or the picture has no such line.
    pub fn line<C: DisplayColor>(&self, y: u32, line: &mut [C]) -> Result<(), LineError> {
        if line.len() != usize::from(self.width) {
            return Err(LineError::BufferLength { given: line.len(), width: self.width() });
        }
        self.lines(y, line, &mut ())
    }

    /// Renders as many whole lines as a slice holds, from line `y` on, and tells `probe` what happens.
    /// [`LINES_AT_ONCE`](crate::limits::LINES_AT_ONCE), or a multiple, may take less time than one after the other.
    ///
    /// # Errors
    /// Before the first pixel, where the slice does not hold one whole line or several, or the picture has no such lines.
    pub fn lines<C: DisplayColor>(
        &self,
        y: u32,
        lines: &mut [C],
        probe: &mut impl Probe<R>,
    ) -> Result<(), LineError> {
        let count = self.whole_lines(lines.len())?;
        let last = y.saturating_add(count.saturating_sub(1));
        let Some(y) = u16::try_from(y).ok().filter(|_| last < self.height()) else {
            return Err(LineError::NoSuchLine { line: last, height: self.height() });
        };
        if let Some(mut groups) = Groups::new(self, probe) {
            groups.trace(y, lines, &mut 0, u32::MAX, probe);
            return Ok(());
        }
        for (down, line) in lines.chunks_mut(usize::from(self.width).max(1)).enumerate() {
            LinePainter::new(self, y.wrapping_add(down as u16)).paint(0, line, u32::MAX, probe);
        }
        Ok(())
    }

    /// How many whole lines so many pixels are: one, or several. A picture without columns needs no pixels.
    fn whole_lines(&self, pixels: usize) -> Result<u32, LineError> {
        let lines = match pixels.checked_rem(usize::from(self.width)) {
            Some(0) if pixels > 0 => pixels.checked_div(usize::from(self.width)),
            None if pixels == 0 => Some(1),
            _ => None,
        };
        let lines = lines.map(|lines| u32::try_from(lines).unwrap_or(u32::MAX));
        lines.ok_or(LineError::BufferLength { given: pixels, width: self.width() })
    }

    /// The lines of a range that are to be drawn; `0..0` where there is nothing to draw.
    fn lines_of(&self, lines: Range<u32>) -> Result<Range<u32>, LineError> {
        // No line of none is missing.
        if lines.is_empty() {
            return Ok(0..0);
        }
        if lines.end > self.height() {
            return Err(LineError::NoSuchLine { line: lines.end.wrapping_sub(1), height: self.height() });
        }
        Ok(if self.width == 0 { 0..0 } else { lines })
    }

    /// Draws the whole picture with its upper left corner at the display's origin, one `fill_contiguous` per
    /// buffer. The buffer holds one line, or as many whole lines as shall be sent at once.
    ///
    /// # Errors
    /// A buffer that does not hold whole lines, before the first pixel; or the display's own error, with the
    /// line at which [`draw_lines`](Self::draw_lines) goes on.
    pub fn draw<D>(&self, display: &mut D, buffer: &mut [D::Color]) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget,
        D::Color: DisplayColor,
    {
        self.draw_lines(0..self.height(), display, buffer)
    }

    /// Draws some lines of the picture, each where it belongs.
    ///
    /// # Errors
    /// As [`draw`](Self::draw).
    pub fn draw_lines<D>(
        &self,
        lines: Range<u32>,
        display: &mut D,
        buffer: &mut [D::Color],
    ) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget,
        D::Color: DisplayColor,
    {
        let mut frame = self.frame(lines, buffer)?;
        while !frame.step(display, u32::MAX)?.is_done() {}
        Ok(())
    }

    /// Begins to draw some lines of the picture step by step, each step a bounded amount of work.
    ///
    /// # Errors
    /// Where the buffer does not hold one whole line or several, or the picture has no such lines.
    pub fn frame<'b, C: DisplayColor>(
        &self,
        lines: Range<u32>,
        buffer: &'b mut [C],
    ) -> Result<Frame<'p, 'm, 'b, R, S, C>, LineError> {
        Frame::new(*self, lines, buffer)
    }
}
