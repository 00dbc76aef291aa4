//! The settings of realtime quality.

use super::grid::Grid;
use crate::render::pixel::Aim;

/// How much realtime quality may differ from the exact picture.
///
/// Every second, fourth or eighth pixel of as many lines is traced ([`Grid`]). The pixels between two
/// neighbors are interpolated if both neighbors saw the same things in a similar color, and traced if not. A
/// thing that lies between the traced pixels and is seen by none of them can be lost, in one frame and not in
/// the next. Small things are searched for before the first ray, but these can still be lost:
/// - **Thin parts of a larger object.** Objects that are thin as a whole are traced in full, and so are thin
///   parts of tori, rings, instances and compound objects. Thin parts of meshes are searched for and
///   followed: of slats one pixel wide, a tenth is lost. More is lost of their mirror images, and of meshes
///   that are instanced more than 32 times.
/// - **The ends of tips.** Of triangles, polygons and cones that taper at less than 53°, the last three
///   pixels are lost where the tip is one pixel wide; the same is true of their shadows on the largest flat
///   object. Up to a cell is lost of blunter corners, of polygons with more than 64 vertices, of objects that
///   are instanced more than 32 times, and in scenes of more than 32 objects.
/// - **Shadows and mirror images of thin things** in scenes of more than 32 objects, unless the thing is at
///   least eight times as long as wide.
/// - **Low shadows** on surfaces that are seen at a grazing angle. Shadows lower than a cell are searched for
///   on the largest flat object, in scenes of up to 32 objects and with one sample per pixel. The ends of
///   other shadows can be cut off.
/// - **Highlights of one or two pixels**, for example of shininess 1000 on a ball of 11 pixels' radius with a
///   grid of eight; mirrored highlights; and highlights on your own shapes that do not implement
///   [`normal_beside`](crate::shape::Silhouette::normal_beside).
/// - **Polygons seen from their edge**, unless they are four times as long as wide, and **the shadows of
///   plates** whose edge points at a light.
/// - **Details smaller than a cell in smooth textures**: noise, marble, wood and blended images, as colors
///   and as maps; in images that are not blended, spots of less than a third of a cell on even ground; and
///   shadows of objects with a map of transmittance. Checkers, stripes, bricks and texels are found, in maps
///   too.
///
/// Draw such scenes exactly, or with a finer grid. A `threshold` of 0 does not make pictures exact: edges
/// within four pixels are still drawn as straight lines. A scene of four balls on a floor keeps 45.8 dB of
/// the exact picture for a fifth of its rays.
///
/// The smaller a picture, the more of it is thin, and traced in full. Instructions per pixel for four balls
/// on a floor, on a Cortex-M3:
///
/// | size | exact | grid of eight | grid of four |
/// |---|---|---|---|
/// | 320×240 | 911 | 363 | 429 |
/// | 160×120 | 930 | 568 | 620 |
/// | 128×96 | 933 | 877 | 730 |
/// | 64×48 | 980 | 1,305 | 1,182 |
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Realtime {
    /// The distance of the pixels that are traced first.
    pub grid: Grid,
    /// The largest difference in color between two traced neighbors that is interpolated, in any channel and
    /// in units of 1/65536 of what the display can show.
    pub threshold: u16,
    /// The most rays for a frame; `u32::MAX` sets no limit. A budget a tenth above what a frame takes changes
    /// nothing, as a rule. With a smaller budget, bands of lines that come after expensive ones are drawn
    /// more coarsely, so that the frame is finished within the budget; only the pixel that is traced last may
    /// exceed it. If the budget is too small even for the pixels of the grid, rows of the grid are left out,
    /// and the row above is shown in their place. With a budget, a line depends on the lines that were drawn
    /// before it in the same frame.
    pub budget_rays: u32,
    /// The edges of objects, shadows and textures.
    pub edges: Edges,
}

/// How edges are drawn in realtime quality.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Edges {
    /// In steps of a pixel: a pixel shows what its center shows.
    #[default]
    Stepped,
    /// Without steps, and without samples: a pixel shows the mean of what is on both sides of an edge. Needs
    /// the feature `distributed`.
    ///
    /// Rays go through the corners of pixels, so that each serves four pixels. Where the corners of a pixel
    /// saw two different things, a straight edge parts the pixel. It crosses the pixel's sides where the
    /// outline of a ball does, the horizon of a plane, the shadow of a ball on something flat, or the edge of
    /// a checker there; other edges are taken to cross in the middle between two corners.
    ///
    /// In a scene of two balls and their shadows, pixels at edges are off by 54 of 255 levels with one
    /// sample, and by 3 with smooth edges. Errors against 64 samples, and rays a pixel, of pictures of
    /// 320×240:
    ///
    /// | scene | stepped | smooth | rays, stepped | smooth | smooth, 4 to 16 samples | rays |
    /// |---|---|---|---|---|---|---|
    /// | `classic` | 34.7 dB | 40.7 dB | 0.45 | 0.46 | 43.8 dB | 2.9 |
    /// | `whitted` | 31.3 dB | 37.0 dB | 0.77 | 0.78 | 42.1 dB | 8.3 |
    /// | `flake` | 32.5 dB | 35.4 dB | 1.21 | 1.21 | 40.6 dB | 15.1 |
    /// | `prism` | 32.7 dB | 34.9 dB | 1.47 | 1.47 | 39.6 dB | 13.4 |
    ///
    /// With several samples ([`Sampling`](crate::Sampling)), pixels with edges that are not known take them,
    /// and all other pixels are drawn as with one: from a few rays for a cell to all samples in a pixel. If
    /// samples draw more than their place (from lenses, lamps, lobes and motions), all rays take them.
    Smooth,
}

impl Default for Realtime {
    fn default() -> Self {
        Self::new()
    }
}

impl Realtime {
    /// For pictures of 320×240 and more: a grid of eight pixels and a threshold of 1/13.
    pub const fn new() -> Self {
        Self { grid: Grid::Eight, threshold: 5000, budget_rays: u32::MAX, edges: Edges::Stepped }
    }

    /// For small pictures, and where quality counts more than time: a grid of four pixels and a threshold of
    /// 1/26.
    pub const fn fine() -> Self {
        Self { grid: Grid::Four, threshold: 2500, ..Self::new() }
    }

    /// This quality with smooth edges. Needs the feature `distributed`.
    pub const fn smooth(self) -> Self {
        Self { edges: Edges::Smooth, ..self }
    }

    /// Whether edges are smooth. Without the feature `distributed`, this is a constant `false`.
    pub(super) const fn is_smooth(&self) -> bool {
        cfg!(feature = "distributed") && matches!(self.edges, Edges::Smooth)
    }

    /// Where the rays of pixels go.
    pub(super) const fn aim(&self) -> Aim {
        if self.is_smooth() { Aim::Corner } else { Aim::Area }
    }

    /// The number of colors to lend for a picture of this width: one band of lines.
    pub const fn colors(&self, width: u16) -> usize {
        width as usize * self.grid.pixels()
    }

    /// The number of samples to lend for a picture of this width: one line, up to the end of its last cell.
    pub const fn samples(&self, width: u16) -> usize {
        (width as usize).div_ceil(self.grid.pixels()) * self.grid.pixels() + 1
    }
}
