//! Realtime quality: few pixels are traced, the rest is interpolated where nothing can lie in between.
//!
//! Every eighth pixel of every eighth line is traced. Between two that differ, the one in the middle is looked at too,
//! and so on down to the pixel; between two that do not, colors are interpolated, in integers (Akimoto, Mase and Suenaga,
//! "Pixel-Selected Ray Tracing", IEEE CG&A 1991; Whitted, "An Improved Illumination Model for Shaded Display", CACM
//! 1980, refines in the same way below the pixel). Two pixels differ if their colors do, or what they saw: which objects,
//! in which order, which cells of a texture, which lights were in the way. Of that they keep digests of 7 bits each, so
//! that a sample takes 8 bytes. What is seen by rays of less than 1/8 does not count, or every faint reflection would be
//! traced; color alone decides there.
//!
//! Three things keep the traced pixels few where there are edges:
//! - *Edges are straight* within four pixels: where the sides of a square change in two places and no other, the line
//!   between the two places parts it (as marching squares do, Lorensen and Cline, 1987), and each part has the colors of
//!   its side. Only what is less than 5/16 of a pixel from the line is looked at: places are known to half a pixel.
//!   Without that look `classic` has 4 dB less.
//! - *A look needs no lights.* Between two pixels that met something else under the same lights, two pixels apart, the
//!   one in the middle is traced in a scene without lights, only to see which of the two it is like. That saves a sixth
//!   of all rays, and all their shading.
//! - *Where nothing can be seen*, as each cell knows before the first ray, nothing is traced.
//!
//! Colors are interpolated as tones ([`DisplayColor::tone`](crate::DisplayColor::tone)): on the display's own scale,
//! after its curve, which only traced pixels go through.
//!
//! Five kinds of things that lie between the points of the grid and leave no mark on them are looked for (others are lost, as [`Realtime`] says):
//! - *Thin objects.* Each shape knows what holds it, or parts of it ([`Hull`](crate::shape::Hull)). Cells that can show one which is
//!   less than two cells wide or high, or aslant less than one, are traced in full. Among more than 32 objects those count that are less
//!   than one cell wide: 91 balls of 9 to 14 pixels would take 1.6 times the rays with the others.
//! - *Their shadows and mirror images*. Around the ray of a point of the grid is the cone of those that it stands for. Where something thin is in that, or in the one of a shadow ray, the cell is looked at more closely, and squares of four
//!   pixels that it is as near to are traced in full. In scenes without thin objects that costs 2 to 3 %. Among more than 32
//!   objects only sticks are looked for, eight times as long as wide: with all, those 91 balls would take an M4F more instructions than their exact picture.
//! - *Low shadows* on a floor that is seen aslant, *and tips*: the [points of the grid near them](close) are known. In scenes without them
//!   that costs less than 1 %. Of a cone, a triangle and a star, whose tips have 20° to 50°, an eighth to a third is lost of what was.
//! - *Thin parts of meshes* and their shadows, near the [rims](rims) of these.
//! - *Highlights*. Along a surface that is curved, mirrored directions [sweep](sweep) over others, as shapes tell by their normals beside
//!   a hit. Where the sweep around a point of the grid passes by a light, and the highlight is small beside it, the cell is looked at more
//!   closely; where it is smaller still, the squares around that point are traced in full. That is asked of what the eye sees directly: of
//!   mirrored highlights too, `classic` would take 0.75 rays a pixel.
//!
//! What a side of a cell looks like depends on its two ends alone, not on what is found inside. So a band of lines needs
//! nothing of the others: the row of samples that it hands to the one below only saves tracing it again, and lines are
//! the same bytes in any order. The grid ends beyond the picture: the camera sees on.
//!
//! Measured at 320×240 against the exact picture in 8-bit sRGB (tests/tests/all/realtime.rs prints this table), of
//! [`Realtime::new`] and [`Realtime::fine`]:
//!
//! | scene | PSNR, new | traced pixels | rays a pixel | fine | traced | rays | exact |
//! |---|---|---|---|---|---|---|---|
//! | classic | 45.8 dB | 0.105 | 0.45 | 48.5 dB | 0.120 | 0.52 | 2.29 |
//! | whitted | 45.7 dB | 0.140 | 0.94 | 46.7 dB | 0.161 | 1.12 | 4.67 |
//! | flake | 36.9 dB | 0.199 | 1.21 | 38.0 dB | 0.237 | 1.38 | 4.57 |
//! | prism | 40.6 dB | 0.353 | 1.57 | 40.6 dB | 0.370 | 1.63 | 5.21 |
//!
//! Of 24 frames around `classic` the worst has 41.0 dB, around `prism` 36.9 dB; at 160×120, where everything is smaller,
//! the fine ones 39.4 and 36.6 dB.
//!
//! In instructions per pixel of `classic` at 320×240: 261 instead of 562 on Cortex-M4F in `f32`, 361 instead of 920 on
//! Cortex-M3 and 649 instead of 1,702 on Cortex-M0 in fixed point. Three quarters of them trace; of what is left, a
//! third compares samples along the sides of cells.
//!
//! What is lost: on balls, rods and tori of 11 pixels and more, with a light anywhere before them, no frame of a rotation has a quarter more
//! or less of a highlight than a usual one has in all, up to a shininess of 300 (balls of 12 pixels: 100); `prism` and `flake`, where edges
//! are everywhere, are the ones below 38 dB.
//!
//! A budget below what a frame wants (34,777 rays for `classic`) is used up to 92 % or more, and is kept to but for the pixel
//! that is traced last: 38,000 allowed rays give 45.8 dB, 34,000 33.9, 25,000 27.0 and 18,000 26.0. As no band knows what
//! those below will want, it takes up to a tenth more than a frame wants for nothing to be lost.
//!
//! Rejected: tracing nearly every pixel of a cell with an edge, as before (0.205 of `classic` for 59.9 dB, 0.93 rays
//! a pixel); leaving out rays of less than 1/16 of their light (38 dB for 0.03 rays); reading off colors at the edges
//! four pixels away instead of two (42.5 dB for 0.02 rays, and flickers); straight edges across cells of eight pixels, most of which
//! hold more than one edge (44.3 dB for 2.5 % of the rays); looks without lights where shades differ too (39.3 dB for 4 %), or with
//! only those lights (43.6 dB for 3 %, and more rays than before in the other three scenes: what is like neither of the two is traced
//! again); no look at the middle of a square where the points on either side of it do not differ (43.7 dB for 7 % of the rays, and tips and highlights
//! flicker); no look between pixels that saw different things in much the same color (34.9 dB for 0.02 rays); twice the threshold, or none
//! (44.6 dB for 0.02, 40.7 for 0.05); twice the threshold two pixels apart, in place of one and a half times (0.2 dB for 1.5 % of
//! the rays, but 1.5 dB at 160×120); a third channel of 11 bits for longer digests (0.2 dB more, but even areas may be off by a level).

mod budget;
mod cell;
mod close;
mod cone;
mod edge;
mod frame;
mod limits;
mod paint;
mod places;
mod rims;
mod sample;
mod seen;
mod stadium;
mod strip;
mod sweep;
mod taper;
mod thin;
mod tiny;
mod tracer;

pub use frame::RealtimeFrame;
pub use sample::Sample;

use core::ops::Range;

use embedded_graphics::draw_target::DrawTarget;

use super::{DisplayColor, DrawError, LineError, Renderer};
use crate::math::Real;
use crate::shape::Geometry;

/// How much realtime quality may differ from the exact picture.
///
/// Every fourth or eighth pixel of every fourth or eighth line is traced; what lies between them is interpolated where they saw the
/// same, and looked at where they did not. So what lies between them and leaves no mark on any can be lost, in one frame and not in the
/// next:
/// - *thin things that are parts of something larger*. What is thin as a whole is traced, and so are parts of tori, rings, instances and what
///   is put together. Thin parts of meshes are looked for and followed: of slats a pixel wide a tenth is lost, of their mirror images and of
///   meshes that stand there as more than 32 instances it may be more;
/// - *the very ends of tips*: of triangles, polygons and cones that taper off by less than 53° three pixels are lost, where they are a pixel
///   wide, and of their shadows on the largest flat object. Of corners that are blunter, of outlines of more than 64 vertices, of more than
///   32 instances, and in scenes of more than 32 objects, it may be what is narrower than a cell;
/// - in scenes of more than 32 objects, *shadows and mirror images of thin things* that are less than eight times as long as wide;
/// - *low shadows*, on what is seen aslant. On the largest flat object of a scene of up to 32 objects, with one sample a pixel, those that
///   are lower than a cell are looked for; the tails of others can be cut off;
/// - *highlights of a pixel or two*, as those of shininess 1000 on a ball, rod or torus of 11 pixels' radius, on a grid of eight; those that
///   are mirrored; and on shapes of one's own that do not tell [`normal_beside`](crate::shape::Silhouette::normal_beside);
/// - *polygons seen edgewise*, unless they are four times as long as wide, and *the shadows of plates that stand edgewise to a light*;
/// - what is smaller than a cell in *smooth textures*, as noise, marble, wood and blended images, in color and in maps; of images that
///   are not blended, spots of less than a third of a cell on even ground; and shadows that fall through maps of transmittance. Squares,
///   stripes, bricks and texels leave the mark of the one that was seen, in maps too.
///
/// Draw such scenes exactly, or with a finer grid. A `threshold` of 0 does not make pictures exact, as edges within four pixels stay
/// straight lines. A scene of four balls on a floor keeps 45.8 dB of the exact picture for a fifth of its rays.
///
/// The smaller a picture, the more of it is thin, and traced in full. Instructions per pixel of those four balls on a Cortex-M3:
///
/// | size | exact | grid of eight | grid of four |
/// |---|---|---|---|
/// | 320×240 | 920 | 361 | 429 |
/// | 160×120 | 940 | 569 | 620 |
/// | 128×96 | 943 | 884 | 730 |
/// | 64×48 | 991 | 1,310 | 1,182 |
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Realtime {
    /// How far apart the pixels are that are always traced.
    pub grid: Grid,
    /// Neighbors on the grid may differ by this much, in units of 1/65536 of what the display can show, without a look
    /// at what lies between them.
    pub threshold: u16,
    /// The most rays for a frame; `u32::MAX`: as many as it takes. As a rule, a tenth more than a frame takes costs it nothing; with less
    /// than it takes, its lower part is drawn more coarsely. The pixel that is traced last may take more, no
    /// other. Where bands of lines take more than their share, those below are drawn more coarsely, so that the
    /// frame is done in time; and where there are too few rays even for the pixels of the grid, rows of these are
    /// left out, and what is above is shown in their place. Then what a line looks like depends on those that the same frame has
    /// drawn before.
    pub budget_rays: u32,
}

/// The distance of the pixels that are always traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grid {
    /// Every second pixel of every second line.
    Two,
    /// Every fourth pixel of every fourth line.
    Four,
    /// Every eighth pixel of every eighth line.
    Eight,
}

impl Grid {
    /// The distance in pixels.
    pub const fn pixels(self) -> usize {
        match self {
            Self::Two => 2,
            Self::Four => 4,
            Self::Eight => 8,
        }
    }
}

impl Default for Realtime {
    fn default() -> Self {
        Self::new()
    }
}

impl Realtime {
    /// For pictures of 320×240 and more: a grid of eight pixels and a threshold of 1/13.
    pub const fn new() -> Self {
        Self { grid: Grid::Eight, threshold: 5000, budget_rays: u32::MAX }
    }

    /// For small pictures, and where quality counts more than time: a grid of four pixels and a threshold of 1/26.
    pub const fn fine() -> Self {
        Self { grid: Grid::Four, threshold: 2500, ..Self::new() }
    }

    /// How many colors to lend for a picture of this width: a band of lines.
    pub const fn colors(&self, width: u16) -> usize {
        width as usize * self.grid.pixels()
    }

    /// How many samples to lend for a picture of this width: a line of points.
    pub const fn samples(&self, width: u16) -> usize {
        if width == 0 {
            return 0;
        }
        (width as usize).div_ceil(self.grid.pixels()) * self.grid.pixels() + 1
    }
}

/// The memory that realtime quality is drawn in.
#[derive(Debug)]
pub struct RealtimeBuffer<'b, C> {
    /// A band of lines: [`Realtime::colors`].
    pub colors: &'b mut [C],
    /// What is known of one line: [`Realtime::samples`].
    pub samples: &'b mut [Sample],
}

impl<'p, 'm, R: Real, S: Geometry + 'm> Renderer<'p, 'm, R, S> {
    /// As [`draw`](Self::draw), in realtime quality: one `fill_contiguous` per band of lines.
    ///
    /// # Errors
    /// A buffer of the wrong length, before the first pixel; or the display's own error.
    pub fn draw_realtime<D>(
        &self,
        quality: Realtime,
        display: &mut D,
        buffer: RealtimeBuffer<'_, D::Color>,
    ) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget,
        D::Color: DisplayColor,
    {
        let mut frame = self.realtime_frame(0..self.height(), quality, buffer)?;
        while !frame.step(display, u32::MAX)?.is_done() {}
        Ok(())
    }

    /// As [`frame`](Self::frame), in realtime quality. The lines may begin and end anywhere.
    ///
    /// # Errors
    /// Where a buffer has the wrong length, or the picture has no such lines.
    pub fn realtime_frame<'r, 'b, C: DisplayColor>(
        &'r self,
        lines: Range<u32>,
        quality: Realtime,
        buffer: RealtimeBuffer<'b, C>,
    ) -> Result<RealtimeFrame<'r, 'm, 'b, R, S, C>, LineError> {
        RealtimeFrame::new(self, lines, quality, buffer)
    }
}
