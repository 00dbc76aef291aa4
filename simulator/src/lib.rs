//! Rayline on the desktop: multi-threaded pictures, scene files, a window, reports and measurements.
//!
//! - [`render`] makes a [`Picture`] of any [`Scene`](rayline::Scene), through any display color;
//! - [`render_in_passes`] shows a picture early, and adds samples to it;
//! - [`ron`] reads and writes Rayline's scene files, [`nff`], [`obj`] and [`gltf`] read other formats, and
//!   [`LoadedScene`] opens a scene by name or file;
//! - [`SceneFile`] writes scenes in several formats, among them Rust source and POV-Ray's language;
//! - [`bake_light`] computes the light of a scene and stores it in textures;
//! - [`Comparison`] draws a scene by ray tracing and by scan conversion;
//! - [`Demands`] estimates whether a scene fits boards;
//! - [`PictureFile`] writes PNG and PPM files, [`FilmFile`] GIF and animated PNG files, and [`raster`] reads
//!   image files;
//! - [`Stats`] holds the ray counts, time and memory of a picture;
//! - [`Gallery`] renders a directory of scenes and compares them with other number systems and POV-Ray;
//! - [`report_pixel`] describes every ray of one pixel;
//! - [`Bench`] measures the speed of rendering, and [`povray`] renders the same scenes with POV-Ray;
//! - [`half_blocks`] shows a picture in a terminal, and [`on_panel`] as it looks on a display's panel;
//! - [`Orbit`] moves a camera around its target.
//!
//! The program `rayline` is a thin shell around this library.

mod accuracy;
mod bench;
mod canvas;
mod check;
mod compare;
mod convert;
mod display;
mod distinct;
mod file;
mod film;
mod gallery;
mod light;
mod options;
mod orbit;
mod panel;
mod parts;
mod passes;
mod picture;
mod plot;
mod preview;
mod realtime;
mod report;
mod stats;
mod table;
mod terminal;
#[cfg(feature = "window")]
mod window;

pub use accuracy::rounding_notes;
pub use bench::{Bench, BenchError, Convergence};
pub use check::{BOARDS, Board, Demand, Demands, check, most_rays};
pub use compare::{Comparison, Cost, Costs, Visibility};
pub use convert::{ConvertError, SceneContents, SceneFile};
pub use display::Display;
pub use embedded_graphics_simulator::{BinaryColorTheme, OutputSettings, OutputSettingsBuilder};
pub use file::{FileError, PictureFile, check_apart, check_writable, is_standard_output, write_file};
pub use film::FilmFile;
pub use gallery::{Gallery, GalleryError};
pub use light::{BakedLight, LightError, LightOptions, LightStep, LightTexels, bake_light};
pub use options::{Mode, Number, RenderOptions, SAMPLERS, Show};
pub use orbit::Orbit;
pub use panel::on_panel;
pub use passes::{Pass, PassError, render_in_passes};
pub use picture::{Picture, RenderError, render, render_watched};
pub use rayline_formats::{
    Exposure, ExposureError, Format, ModelView, OpenOptions, Up, files, gltf, nff, obj, povray, raster,
};
pub use rayline_scenes::{LoadError, LoadedScene, animation, ron};
pub use report::{ReportError, report_pixel};
pub use stats::{Cuts, Hits, Rays, Stats};
pub use terminal::half_blocks;
#[cfg(feature = "window")]
pub use window::{Save, WindowError, WindowScene, show_window};
