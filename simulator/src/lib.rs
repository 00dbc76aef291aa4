//! Rayline on the desktop: pictures on several threads, scene files, and what can be measured and watched.
//!
//! - [`render`] makes a [`Picture`] of any [`Scene`](rayline::Scene), through any display color;
//! - [`ron`] reads and writes scene files, [`nff`], [`obj`] and [`gltf`] read those of others, and [`LoadedScene`] finds a scene by name or file;
//! - [`SceneFile`] writes scenes, also as Rust source and for POV-Ray;
//! - [`Demands`] tells whether a scene fits boards;
//! - [`PictureFile`] writes PNG and PPM, [`Stats`] the measurements;
//! - [`Gallery`] renders a directory of scenes and holds them against other number systems and POV-Ray;
//! - [`report_pixel`] tells all that happened to one pixel;
//! - [`Bench`] measures how fast pictures are, and [`povray`] has another renderer draw them;
//! - [`half_blocks`] shows a picture in a terminal;
//! - [`Orbit`] moves a camera around what it looks at.
//!
//! The program `rayline` is a thin shell around these.

mod bench;
mod check;
mod convert;
mod display;
mod file;
mod gallery;
pub mod gltf;
mod loaded;
mod model;
mod nearest;
pub mod nff;
pub mod obj;
mod options;
mod orbit;
mod picture;
pub mod povray;
mod realtime;
mod report;
pub mod ron;
mod stats;
mod table;
mod terminal;
mod text;
#[cfg(feature = "window")]
mod window;

pub use bench::{Bench, BenchError};
pub use check::{BOARDS, Board, Demand, Demands, check};
pub use convert::{ConvertError, SceneFile};
pub use display::Display;
pub use file::{FileError, PictureFile, check_apart, check_writable, write_file};
pub use gallery::{Gallery, GalleryError};
pub use loaded::{LoadError, LoadedScene};
pub use options::{Mode, Number, RenderOptions};
pub use orbit::Orbit;
pub use picture::{Picture, RenderError, render, render_watched};
pub use report::{ReportError, report_pixel};
pub use stats::{Cuts, Hits, Rays, Stats};
pub use terminal::half_blocks;
#[cfg(feature = "window")]
pub use window::{Save, WindowError, show_window};
