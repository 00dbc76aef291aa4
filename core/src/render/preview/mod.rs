//! A preview by scan conversion: facets in place of surfaces, a Z-buffer of one line in place of rays.
//!
//! Ray tracing finds for each pixel the surface behind it; scan conversion finds for each surface the pixels
//! in front of it. The time of scan conversion grows with the facets and with the pixels that they cover, and
//! hardly with the product of both numbers. But scan conversion draws no shadows, mirror images or
//! refraction. Here it draws what a slow chip shows while things move, before a picture is traced:
//!
//! 1. [`setup`] cuts every object of the prepared scene into facets
//!    ([`each_facet`](crate::shape::Silhouette::each_facet)), lights their [`corner`]s without shadow rays,
//!    and clips them by the sides of the picture ([`clip`]; Sutherland and Hodgman, "Reentrant Polygon
//!    Clipping", CACM 1974).
//! 2. What is left is projected and kept as [`PreviewFacet`]s in lent memory, sorted by the first line that
//!    they cover.
//! 3. For each line, [`scan`] finds the pixels that each facet covers there, and keeps the nearest facet of
//!    each pixel: a Z-buffer (Catmull, "A Subdivision Algorithm for Computer Display of Curved Surfaces",
//!    1974) of one line (Wylie, Romney, Evans and Erdahl, "Half-Tone Perspective Drawings by Computer",
//!    AFIPS 1967). Facets that reach the next line stay in a list.
//! 4. [`painter`] colors each pixel once, by the facet that is seen there: light is interpolated between the
//!    corners (Gouraud, "Continuous Shading of Curved Surfaces", IEEE ToC 1971). Textures are evaluated at
//!    the point of the scene that follows from the pixel's depth, so their perspective is right.
//!
//! # Depth
//! Along a line, not the depth z of a plane is linear but 1/z, so the buffer holds 1/z: as a whole number in
//! units of 2⁻³⁰ of that of the nearest depth. Steps 3 and 4 compute in integers and `f32` whatever the
//! scene's number system is; they are compiled once for all.

mod clip;
mod corner;
mod facet;
mod painter;
mod scan;
mod setup;

pub use facet::{PreviewFacet, PreviewPixel};
pub use painter::PreviewBuffer;

use super::{DisplayColor, PreviewError, Renderer};
use crate::limits::{MAX_PREVIEW_SIDE, MAX_SEGMENTS, MIN_SEGMENTS};
use crate::math::Real;
use crate::shape::Geometry;

/// A picture by scan conversion, ready to be drawn: the facets of a scene as its camera sees them.
///
/// There are no shadows and no soft light: each lamp lights all that faces it. Mirrors and glass show the
/// background. Curved shapes have corners, highlights are as coarse as the facets, and an infinite plane ends
/// before the horizon. Things that move are where they were described, and the lens is a pinhole. Of a
/// material's maps, those of color are shown at each pixel, those of ambient light at corners, others not. A
/// user's own shape is cut by rays in a grid, unless it has [facets](crate::shape::Silhouette::each_facet) of
/// its own.
///
/// Memory: 68 bytes for each facet, and for each pixel of one line 8 bytes and its color.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8};
/// use rayline::{Preview, PreviewFacet, PreviewPixel, Real, Renderer};
///
/// fn preview<R: Real>(renderer: &Renderer<'_, '_, R>, display: &mut MockDisplay<Gray8>) {
///     let mut facets = [PreviewFacet::BLANK; 600];
///     let mut pixels = [PreviewPixel::BLANK; 64];
///     let mut line = [Gray8::new(0); 64];
///     match Preview::new(renderer, 16, &mut facets) {
///         Ok(mut preview) => {
///             let _ = renderer.draw(display, preview.lend(&mut line, &mut pixels));
///         }
///         // Tells how many facets are needed.
///         Err(error) => println!("{error}"),
///     }
/// }
/// ```
#[derive(Debug)]
pub struct Preview<'f> {
    /// Sorted by their first line.
    facets: &'f mut [PreviewFacet],
    /// The depth at which the inverse depth is 2³⁰, in units of the traced scene.
    nearest: f32,
    /// Width and height of the picture.
    size: (u16, u16),
    scan: scan::Scan,
}

impl<'f> Preview<'f> {
    /// Cuts the renderer's scene into facets. A circle becomes a polygon of so many `segments`: 16 is a good
    /// start, 32 looks round.
    ///
    /// # Errors
    /// Too few or too many segments, a picture that is too large, or too little memory: the error tells how
    /// much is needed. More than [`MAX_PREVIEW_FACETS`](crate::limits::MAX_PREVIEW_FACETS) are never used.
    pub fn new<R: Real, S: Geometry>(
        renderer: &Renderer<'_, '_, R, S>,
        segments: u16,
        memory: &'f mut [PreviewFacet],
    ) -> Result<Self, PreviewError> {
        if !(MIN_SEGMENTS..=MAX_SEGMENTS).contains(&segments) {
            return Err(PreviewError::Segments { given: segments });
        }
        let size @ (width, height) = (renderer.width, renderer.height);
        let side = width.max(height);
        if side > MAX_PREVIEW_SIDE {
            return Err(PreviewError::Size { side });
        }
        let (facets, nearest) = setup::facets(renderer, segments, memory)?;
        scan::sort(facets);
        Ok(Self { facets, nearest, size, scan: scan::Scan::BEGIN })
    }

    /// How many facets are kept: those that can be seen.
    pub fn facets(&self) -> usize {
        self.facets.len()
    }

    /// Lends memory for a line: colors, and pixels with their depth.
    pub fn lend<'b, C: DisplayColor>(
        &'b mut self,
        line: &'b mut [C],
        pixels: &'b mut [PreviewPixel],
    ) -> PreviewBuffer<'b, C> {
        // The buffer changes the list of facets, so the scan begins anew here, too.
        self.scan = scan::Scan::BEGIN;
        let Self { nearest, size, scan, .. } = *self;
        PreviewBuffer { preview: Preview { facets: self.facets, nearest, size, scan }, line, pixels }
    }

    /// Finds what is seen at the pixels of a line, from the left: as many as the slice has.
    pub fn scan(&mut self, y: u16, pixels: &mut [PreviewPixel]) {
        self.scan.line(self.facets, y, 0, pixels);
    }

    /// The position of the object that a pixel of the [scanned](Self::scan) line shows, in
    /// [`Scene::objects`](crate::Scene::objects); `None` for the background.
    pub fn object(&self, pixel: PreviewPixel) -> Option<usize> {
        Some(self.seen(pixel)?.object.into())
    }

    /// The facet that is seen at a pixel.
    fn seen(&self, pixel: PreviewPixel) -> Option<&PreviewFacet> {
        self.facets.get(usize::from(pixel.facet)).filter(|_| pixel.inverse_depth > 0)
    }
}
