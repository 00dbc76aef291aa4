//! Realtime quality: few pixels are traced, and the rest is interpolated where nothing can lie in between.
//!
//! Every eighth pixel of every eighth line is traced: the *grid*. If two neighbors on the grid differ, the
//! pixel in the middle is traced too, and so on for both halves, down to the pixel. If they do not differ,
//! the pixels between them are interpolated (Akimoto, Mase and Suenaga, "Pixel-Selected Ray Tracing", IEEE
//! CG&A 1991; Whitted, "An Improved Illumination Model for Shaded Display", CACM 1980, refines in the same
//! way below the pixel). Two pixels differ if their colors do, or the things that their rays met: which
//! objects in which order, which cells of a texture, which shadows.
//!
//! Three ideas save more pixels:
//! - **Edges are straight** within four pixels. If the sides of a square of four pixels change in two places,
//!   the line between the two places parts the square (like marching squares: Lorensen and Cline, "Marching
//!   Cubes", SIGGRAPH 1987). Each part has the colors of its side, and only pixels close to the line are
//!   traced.
//! - **A pixel between two neighbors needs no lights** if they met different objects under the same lights,
//!   and are two pixels apart. It is traced without lights, only to find out which of the two it is like.
//! - **Where no object can be seen** before a background of one color, nothing is traced. For most cells,
//!   this is computed before the first ray.
//!
//! A fourth one makes edges smooth without samples, if wanted ([`Edges`]): rays go through the **corners of
//! pixels**, and a pixel whose corners differ shows a mixture of what is on both sides of the edge
//! (`smooth`).
//!
//! # The way of a band
//!
//! A *cell* is the square between four neighboring pixels of the grid; a *band* is the row of cells, and so
//! the lines, between two rows of the grid. [`painter`] draws one band after another:
//! 1. [`budget`] sets how many rays the band may take, and so how closely it is drawn.
//! 2. [`strip`] finds the objects that each cell of the band can show, and [`small`] the things in it that
//!    are so small that no pixel of the grid may see them.
//! 3. [`band`] goes through the cells from left to right. The corners of a cell are traced, unless the cell
//!    to the left or the band above has traced them already.
//! 4. [`tracer`] traces a pixel, and returns a [`sample`]: a tone, and two digests of what the rays met. The
//!    digests are made by [`marks`], a probe that watches the rays. Small things beside the rays are found at
//!    the same time.
//! 5. [`plan`] compares the corners within a [`tolerance`], and decides how the cell is drawn. If no corners
//!    differ and nothing thin is seen, all pixels are interpolated. If something thin is seen, all are
//!    traced.
//! 6. Else [`refine`] draws the sides of the [`cell`], and then the inside in squares of four pixels, along
//!    straight [`edge`]s or by tracing their middles. It gets pixels from the tracer through
//!    [`pixel_source`].
//! 7. If the rim of a mesh may be seen, [`verify`] traces a few pixels of the drawn cell and follows what was
//!    missed.
//! 8. [`paint`] turns the tones of the cell into colors of the band's lines; with smooth edges, `smooth`
//!    finds the tone of each pixel from the points at its corners. The bottom row of the cell is handed to
//!    the band below, the right column to the next cell.
//! 9. Once all cells of the band are drawn, its lines go to the display.
//!
//! # What is kept
//!
//! A band leaves one row of samples to the band below. It saves tracing the row again, and nothing depends on
//! it: the points on a side of a cell follow from its two ends alone, not from what lies inside. So lines
//! have the same bytes in whatever order they are drawn (without a budget of rays). The grid ends beyond the
//! picture's right and lower side; pixels there are traced too.
//!
//! Colors are interpolated as [tones](crate::Tone): in integers, on the display's own
//! [scale](crate::DisplayColor::TONES) and after its curve.
//!
//! [`Realtime`] lists the details that can be lost. The project's `docs/experiments.md` lists
//! measurements, and the ideas that were tried and rejected.

mod band;
mod budget;
mod buffer;
mod cell;
mod edge;
mod grid;
mod marks;
mod paint;
mod painter;
mod pixel_source;
mod plan;
mod quality;
mod refine;
mod sample;
mod side;
mod small;
#[cfg(feature = "distributed")]
mod smooth;
mod strip;
mod tolerance;
mod tracer;
mod verify;

pub use buffer::RealtimeBuffer;
pub use grid::Grid;
pub use quality::{Edges, Realtime};
pub use sample::Sample;
