//! A ray tracer for microcontroller displays: `no_std`, no allocation, no frame buffer, line by line into any
//! embedded-graphics [`DrawTarget`](embedded_graphics::draw_target::DrawTarget).
//!
//! ```
//! use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8};
//! use rayline::shape::Sphere;
//! use rayline::{
//!     Background, Camera, Light, LinearRgb, Material, Object, PreparedScene, Renderer, Scene, Settings,
//!     Vec3, Workspace, prepared_bytes,
//! };
//!
//! static SCENE: Scene<Sphere> = Scene {
//!     camera: Camera {
//!         eye: Vec3::new(0.0, 0.0, 4.0),
//!         target: Vec3::new(0.0, 0.0, 0.0),
//!         up: Vec3::new(0.0, 1.0, 0.0),
//!         vertical_fov: 0.7,
//!         lens: None,
//!     },
//!     background: Background::gray(0.05),
//!     objects: &[Object::new(Sphere::new(Vec3::new(0.0, 0.0, 0.0), 1.0), 0)],
//!     materials: &[Material::matte(LinearRgb::gray(0.9))],
//!     lights: &[Light::Point { position: Vec3::new(3.0, 4.0, 5.0), color: LinearRgb::WHITE }],
//!     motions: &[],
//! };
//!
//! # fn main() -> Result<(), Box<dyn core::error::Error>> {
//! let mut memory = Workspace::<{ prepared_bytes!(f32, SCENE) }>::new();
//! let scene = PreparedScene::<f32, _>::new(&SCENE, memory.lend())?;
//! let renderer = Renderer::new(&scene, Settings::new(64, 64))?;
//!
//! let mut display = MockDisplay::<Gray8>::new(); // yours here
//! let mut line = [Gray8::new(0); 64];
//! renderer.draw(&mut display, &mut line)?;
//! # Ok(())
//! # }
//! ```
//!
//! # The way of the data
//!
//! | step | what it is | where |
//! |---|---|---|
//! | [`Scene`] | what to draw, in `f32`, in flash or in a [`SceneBuf`] | [`shape`], [`Material`], [`Light`] |
//! | [`PreparedScene`] | the scene, checked and converted, in lent memory | `prepared` |
//! | radiance | the light that comes along a ray | `integrator` |
//! | [`Renderer`] | any line of the picture, into a slice or a display | `render` |
//!
//! Modules use only what stands before them: `math`, `limits`, `fault`, `arena`, `read`, `hierarchy`,
//! `color`, `falloff`, `sampling`, `throughput`, `surface`, `texture`, `material`, `shape`, `light`, `lens`,
//! `motion`, `camera`, `background`, `scene`, `prepared`, `probe`, `integrator`, `render`, `builtin`, `bake`,
//! `book`.
//!
//! [The book](book) teaches ray tracing along this crate: formulas, their sources, their places in the code,
//! and exercises.
//!
//! # Number systems
//!
//! A scene is described in `f32` and prepared for one number system, the `R` of signatures ([`Real`]).
//!
//! | type | for |
//! |---|---|
//! | `f32` | chips with an FPU, and the desktop |
//! | [`Fixed`](math::Fixed) | chips without: ten times as fast there as `f32` in software |
//! | `f64` | the reference, with which pictures of the others are compared |
//!
//! # Exact and realtime
//!
//! [`Renderer::draw`] draws exactly if it is lent a line of colors: it traces every pixel. Acceleration never
//! changes a byte. Objects, and their shadows on the floor, have outlines in the picture, from which the
//! objects that each line can show are computed. The objects that can shade a surface are listed for each
//! light. More than 32 objects lie in a hierarchy of boxes. In floating point, neighboring pixels go through
//! the hierarchy together.
//!
//! If the memory comes from [`Realtime::lend`], [`Renderer::draw`] traces a grid of pixels, traces more
//! pixels where neighbors differ, and interpolates the rest. [`Realtime`] describes what this gains and what
//! can be lost.
//!
//! # Conventions
//!
//! Coordinates are right-handed, in any unit. Angles are in radians. Colors are linear light with the
//! primaries of sRGB. Pixel (0, 0) is at the upper left and has its center at (0.5, 0.5). A surface has two
//! sides; its normal says which is the front.
//!
//! # What always holds
//!
//! - No allocation, no recursion, no panic between a prepared scene and the display.
//! - The same scene and settings give the same bytes on every processor, unless the feature `micromath` is
//!   on.
//! - Once scene, settings and buffers are accepted, only the display can fail.
//! - A trace of a pixel spends at most [`Settings::rays_per_pixel`] rays, and what was left out is counted
//!   ([`RayCounts`]). Realtime quality traces some pixels twice, and the rays of contours (feature `looks`)
//!   come on top.
//!
//! # Features and profiles
//!
//! The comments in `Cargo.toml` of this crate say what each feature does, and what it costs in flash and
//! stack. [`Scene::features`] lists those that a scene needs.
//!
//! The tracer is generic, so it is compiled in your crate, by your profiles:
//!
//! ```toml
//! [profile.release]
//! lto = "fat"
//! codegen-units = 1
//!
//! [profile.dev]
//! opt-level = 2
//! ```

#![cfg_attr(not(any(feature = "std", test)), no_std)]
// docs.rs sets this: each item that needs a feature names it.
#![cfg_attr(docsrs, feature(doc_cfg))]
// The limit is in clippy.toml.
#![cfg_attr(not(test), warn(clippy::too_many_lines))]

mod arena;
mod background;
#[cfg(feature = "bake")]
pub mod bake;
#[cfg(any(doc, doctest))]
pub mod book;
pub mod builtin;
mod camera;
mod color;
mod falloff;
mod fault;
mod hierarchy;
mod integrator;
mod lens;
mod light;
pub mod limits;
mod material;
pub mod math;
mod motion;
mod prepared;
mod probe;
#[cfg(feature = "serde")]
pub mod read;
mod render;
mod sampling;
mod scene;
pub mod shape;
mod surface;
mod texture;
mod throughput;

pub use arena::{Arena, Workspace};
pub use background::{Background, Panorama, Sky};
pub use camera::Camera;
pub use color::LinearRgb;
pub use falloff::Falloff;
pub use fault::{Coefficient, Fault};
#[cfg(feature = "looks")]
pub use integrator::Gooch;
pub use integrator::{AreaLights, Integrator};
pub use lens::Lens;
pub use light::{Lamp, Light, LightCone, ObjectId};
pub use material::{Fresnel, Highlight, Material, Medium, Optics, Sides, presets as materials};
pub use math::{Real, Vec3};
pub use motion::{Motion, Mover, Spin};
pub use prepared::{Hit, Part, PreparedScene, SceneError, Through, prepared_bytes};
pub use probe::{Cut, Event, Probe, RayCounts, RayKind};
#[cfg(feature = "looks")]
pub use render::{Contours, Look, Palette, Tones};
pub use render::{
    Digest, DisplayColor, Dither, DrawError, Edges, Frame, Grid, Interleave, Light16, LineError, Pattern,
    PixelSum, Preview, PreviewBuffer, PreviewError, PreviewFacet, PreviewPixel, Progress, Progressive,
    Quality, Quantizer, Realtime, RealtimeBuffer, RenderedImage, Renderer, Sample, Settings, SettingsError,
    Tone, ToneScale, Transfer,
};
pub use sampling::{Adaptive, Reconstruction, Sampler, Sampling};
#[cfg(feature = "serde")]
pub use scene::BytesError;
pub use scene::{FASTER, Full, MaterialId, Object, Scene, SceneBuf};
pub use surface::Surface;
pub use texture::{
    Brick, Checker, Encoding, Ends, Figure, Filter, Gradient, Image, IrradianceVolume, MAX_OCTAVES, Map,
    Marble, Noise, Onto, Pixels, Placed, Placement, Space, Squares, Stripes, Texture, Wood,
};

/// The example of the crate's README compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
