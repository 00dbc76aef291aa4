//! The arguments of `rayline`.

use std::ffi::OsString;
use std::ops::Range;
use std::path::PathBuf;
use std::str::FromStr;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, value_parser};
use rayline::limits::{MAX_BOUNCES, MAX_SEGMENTS, MAX_SIDE, MIN_SEGMENTS};
use rayline::{
    Adaptive, AreaLights, Contours, Dither, Edges, Gooch, Integrator, Look, Reconstruction, Sampler,
    Sampling, Settings, Tones, Transfer,
};
use rayline_simulator::files::limits;
use rayline_simulator::{
    BOARDS, Bench, BinaryColorTheme, Display, Exposure, Format, LightTexels, LoadedScene, Mode, ModelView,
    Number, OpenOptions, OutputSettings, OutputSettingsBuilder, RenderOptions, SAMPLERS, Show, Up, most_rays,
};

/// Renders ray-traced pictures as a microcontroller's display would show them.
///
/// Without a command, it renders the scene `classic`, shows it in the terminal and writes rayline.png.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100, after_long_help = limits())]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a scene into a file
    Render(Render),
    /// Record a film of a scene: the camera orbits once, or camera, objects and lights follow a script
    ///
    /// A script has key frames in the notation of .ron files: see the page of the module
    /// `rayline_scenes::animation`, and docs/classic.film.ron for an example.
    Record(Record),
    /// List the built-in scenes
    Scenes,
    /// Report everything about one pixel: rays, hits, lights, colors
    Pixel(Pixel),
    /// Write a scene in another format
    ///
    /// The extension of the output selects the format: .ron is Rayline's own text format, .rayline its binary
    /// form for SceneBuf::from_bytes, .pov the language of POV-Ray, and .rs Rust source as written by `bake`.
    Convert(Convert),
    /// Write a scene as Rust source for a program's flash
    ///
    /// The source defines SCENE, with a set of only those shapes that the scene has, so that no other code is
    /// linked. Include it with include!.
    ///
    /// With --light, the light of the scene is computed once and stored in textures, which a device looks up:
    /// by radiosity on rectangles, triangles, polygons, boxes and meshes, and by an irradiance volume for all
    /// other objects. Photons find the light that mirrors and glass send onto these surfaces. The output may
    /// then be in any format of `convert`.
    Bake(Bake),
    /// Check whether a scene can be drawn and fits boards: flash, RAM, rays and time
    ///
    /// The memory of the scene and the number of rays are computed. Flash and time are estimated from
    /// instructions and cycles that were counted on emulated boards; `cargo boards --scene FILE.rayline`
    /// measures them exactly.
    Check(CheckArgs),
    /// Draw a scene by ray tracing and by scan conversion, side by side
    ///
    /// Scan conversion, as in --mode preview, cuts all objects into facets and keeps the nearest facet at
    /// each pixel of a line. It is fast, but draws no shadows, and only the background in mirrors and glass.
    /// The table has the time and the memory of both methods, on one thread, and their growth with the pixels
    /// and with the objects of the scene.
    Compare(CompareArgs),
    /// Render all .ron scenes of a directory, and write a page that shows them
    ///
    /// Each scene gets a .png beside it. README.md shows all pictures, and how well they agree with the
    /// reference in f64 and with POV-Ray 3.7, if that is installed.
    Gallery(GalleryArgs),
    /// Show a scene in a window, and read its file again when it changes
    ///
    /// Arrow keys or dragging with the mouse orbit; +, - or the wheel change the distance; Home returns to
    /// the scene's own camera. N, M and C switch the number system, the mode and the color of the display. S
    /// saves a picture, Q quits. The title shows the rays and the time of the last picture.
    Window(Window),
    /// Measure the speed of rendering, and print tables in Markdown
    ///
    /// The first table has the built-in scenes, exact and in realtime quality, in all number systems. If
    /// POV-Ray 3.7 is installed, the second table has three scenes by Rayline and POV-Ray in turn, on one
    /// thread each. Run no other programs meanwhile.
    Bench(BenchArgs),
}

#[derive(Debug, Args)]
pub(crate) struct Render {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The file to write: .png or .ppm; - for a PNG to standard output [default: the scene's name with .png]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    /// Show the colors, or how many samples each pixel takes: black for none, white for all
    #[arg(long, value_name = "WHAT", default_value = "colors", value_enum, conflicts_with = "mode")]
    pub(crate) show: Show,
    /// Draw in passes, each with one more sample of every pixel, and show them in the terminal; the file has
    /// the same bytes as without this option
    #[arg(long, conflicts_with_all = ["mode", "show", "lines"])]
    pub(crate) passes: bool,
    /// The number of threads; the picture does not depend on it [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Render only the lines from A up to but not including B, into a picture of B-A lines
    #[arg(long, value_name = "A..B", value_parser = lines)]
    pub(crate) lines: Option<Range<u32>>,
    /// Write statistics of the picture as JSON: rays by kind, rays that were cut, seconds, bytes; - for
    /// standard output
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
    /// Print nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Record {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The file to write: .gif with 256 colors in each frame, or .png or .apng with all colors; - for a GIF
    /// to standard output [default: the scene's name with .gif]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// A file with key frames, which also has the length of the film
    #[arg(long, value_name = "FILE.ron", conflicts_with_all = ["seconds", "frames_per_second"])]
    pub(crate) script: Option<PathBuf>,
    /// The seconds of an orbit
    #[arg(long, value_name = "S", default_value_t = 3.0)]
    pub(crate) seconds: f32,
    /// The frames in a second
    #[arg(long, value_name = "N", default_value_t = 12.0)]
    pub(crate) frames_per_second: f32,
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    /// Print nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Pixel {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The pixel, counted from 0,0 in the upper left corner
    #[arg(value_name = "X,Y", value_parser = pixel)]
    pub(crate) pixel: (i64, i64),
    #[command(flatten)]
    pub(crate) look: Appearance,
}

#[derive(Debug, Args)]
pub(crate) struct Convert {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The file to write; - for RON to standard output, or for Rust source with `bake`
    #[arg(value_name = "OUT")]
    pub(crate) output: PathBuf,
    /// For Rust source: the number system of the program, `f32` or `fixed`; meshes are prepared for it
    #[arg(long, value_name = "TYPE", value_enum, default_value_t)]
    pub(crate) number: Number,
    /// Print nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Bake {
    #[command(flatten)]
    pub(crate) convert: Convert,
    /// Bake light: all of it, so that no lamp shines on the device, or only the light that surfaces scatter,
    /// beside lamps with their shadows and highlights
    #[arg(long, value_name = "WHAT", value_enum, num_args = 0..=1, default_missing_value = "all")]
    pub(crate) light: Option<BakedPart>,
    /// The most bytes of textures of light
    #[arg(long, value_name = "BYTES", default_value_t = 65_536, requires = "light")]
    pub(crate) budget: usize,
    /// The photons that follow light of lamps over mirrors and through glass: caustics; 0 for none. Beside
    /// lamps that stay, only mirrors make caustics, because the device's light goes straight through glass
    #[arg(long, value_name = "NUMBER", default_value_t = 200_000, requires = "light")]
    #[arg(value_parser = clap::value_parser!(u32).range(..=5_000_000))]
    pub(crate) photons: u32,
    /// The texels of textures of light: 3 or 2 bytes each
    #[arg(long, value_name = "TEXELS", value_enum, default_value_t, requires = "light")]
    pub(crate) texels: LightTexels,
    /// The points of the irradiance volume, each of 24 bytes
    #[arg(long, value_name = "XxYxZ", default_value = "4x4x4", value_parser = grid, requires = "light")]
    pub(crate) grid: [u8; 3],
    /// The objects that will move: names or numbers, counted from 0; they throw no shadows that are baked
    #[arg(long, value_name = "OBJECTS", value_delimiter = ',', requires = "light")]
    pub(crate) moving: Vec<String>,
}

/// The part of the light that is baked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum BakedPart {
    /// All light.
    All,
    /// The light that surfaces scatter.
    Indirect,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// Check one board, and fail if the scene does not fit it [default: all known boards]
    #[arg(
        long,
        value_name = "NAME",
        value_parser = PossibleValuesParser::new(BOARDS.map(|board| board.name)),
    )]
    pub(crate) board: Option<String>,
    /// Width and height of the picture
    #[arg(long, value_name = "WxH", default_value = "160x120", value_parser = size)]
    pub(crate) size: (u32, u32),
    /// Width and height of the board's display; if they differ from --size, the part that fits is reported
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub(crate) panel: Option<(u32, u32)>,
    /// The most reflections and refractions along a path of light, 0 to 16 [default: the scene's own; 6 for
    /// .ron and .rayline files, 4 for others]
    #[arg(long, value_name = "N", value_parser = value_parser!(u8).range(0..=i64::from(MAX_BOUNCES)))]
    pub(crate) bounces: Option<u8>,
}

#[derive(Debug, Args)]
pub(crate) struct CompareArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The picture to write: traced on the left, scan-converted on the right [default: the scene's name with
    /// -compare.png]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Write the times as a plot
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) plot: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) segments: SegmentsArg,
    #[command(flatten)]
    pub(crate) look: Appearance,
    /// Print nothing but the table and errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// How round scan conversion draws.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct SegmentsArg {
    /// Draw circles as polygons of N sides in a preview, 6 to 64
    #[arg(
        long,
        value_name = "N",
        default_value_t = 32,
        value_parser = value_parser!(u16).range(i64::from(MIN_SEGMENTS)..=i64::from(MAX_SEGMENTS)),
    )]
    pub(crate) segments: u16,
}

#[derive(Debug, Args)]
pub(crate) struct GalleryArgs {
    /// The directory with the scenes
    #[arg(value_name = "DIR")]
    pub(crate) directory: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct Window {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
}

#[derive(Debug, Args)]
pub(crate) struct BenchArgs {
    /// How many times each picture is rendered
    #[arg(
        long,
        value_name = "N",
        default_value_t = Bench::FULL.runs as u16,
        value_parser = value_parser!(u16).range(1..=999),
    )]
    pub(crate) runs: u16,
    /// Render small pictures once each, to test the command; the times mean nothing
    #[arg(long, conflicts_with = "runs")]
    pub(crate) quick: bool,
    /// Measure instead how the error of a scene's picture falls with the number of samples, print a table,
    /// and write a plot
    #[arg(long, value_name = "FILE.svg", conflicts_with = "runs")]
    pub(crate) convergence: Option<PathBuf>,
    /// The scene for --convergence
    #[arg(value_name = "SCENE", default_value = "classic", requires = "convergence")]
    pub(crate) source: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct SceneArgs {
    /// The name of a built-in scene, or a file: Rayline's own (.ron, .rayline), NFF (.nff), Wavefront
    /// OBJ (.obj) or glTF (.gltf, .glb); - for standard input
    #[arg(value_name = "SCENE", long_help = scene_help())]
    pub(crate) source: PathBuf,
    /// The axis that points up in a model without a camera of its own [default: y]
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true, value_parser = named(&AXES))]
    up: Option<Up>,
    /// The direction from which a model without a camera of its own is seen, in degrees: 0,0 in front of it,
    /// 90,0 to the right, 180,0 behind it, 0,90 above [default: about 24,20]
    #[arg(
        long,
        value_name = "AZIMUTH,ELEVATION",
        allow_hyphen_values = true,
        value_parser = direction,
    )]
    from: Option<(f32, f32)>,
    /// Make all light of the scene brighter or darker by this number of stops, -20 to 20: 1 doubles it, -1
    /// halves it [default: the scene's own, else 0]
    ///
    /// The number applies to the light of lamps, of surfaces that emit light, and of the background, and to
    /// ambient light. The lights of a glTF file have no measure in the picture: without this option, they are
    /// exposed for what the camera sees, and a note states the factor. With this option, 0 means that the
    /// lights make a white surface in the middle of the scene white.
    #[arg(
        long,
        value_name = "STOPS",
        allow_negative_numbers = true,
        value_parser = Exposure::from_str,
    )]
    exposure: Option<Exposure>,
    /// The format of the scene, for standard input and files with another extension [default: by the
    /// extension; for standard input by its first bytes, unless it is NFF or OBJ]
    #[arg(long, value_name = "FORMAT", value_parser = named(&Format::EXTENSIONS))]
    format: Option<Format>,
    /// Let the scene refer to files outside of its own folder
    #[arg(long)]
    allow_paths: bool,
}

impl SceneArgs {
    /// The options for opening the scene.
    pub(crate) const fn options(&self) -> OpenOptions {
        let view = ModelView { up: self.up, from: self.from };
        OpenOptions { view, format: self.format, exposure: self.exposure, allow_paths: self.allow_paths }
    }
}

fn scene_help() -> String {
    format!(
        "The name of a built-in scene, or a file: Rayline's own (.ron, .rayline), NFF (.nff), Wavefront OBJ \
         (.obj) or glTF (.gltf, .glb); - for standard input.\n\n\
         A scene may refer to files in its own folder and below: for standard input, in the current folder. \
         Symbolic links are followed, but not out of it. With --allow-paths, it may refer to all \
         files.\n\n{}",
        limits()
    )
}

/// The options that decide the colors of the pixels.
#[derive(Debug, Args)]
pub(crate) struct Appearance {
    /// Width and height in pixels [default: the size in an .nff file or in the camera of a .gltf file, else
    /// 640x480]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// The most reflections and refractions along a path of light, 0 to 16 [default: the scene's own; 6 for
    /// .ron and .rayline files, 4 for others]
    #[arg(long, value_name = "N", value_parser = value_parser!(u8).range(0..=i64::from(MAX_BOUNCES)))]
    bounces: Option<u8>,
    /// The number system to compute in
    #[arg(long, value_name = "TYPE", default_value_t, value_enum)]
    number: Number,
    /// The colors of the display that the picture is made for [default: rgb888; mono with --theme]
    #[arg(long, value_name = "DISPLAY", value_enum)]
    color: Option<Display>,
    /// As a photograph, or as a drawing: toon for tones in 4 steps, toon:N for 2 to 16 steps, gooch for tones
    /// from cool to warm, contours for dark lines along edges, also with tones: toon,contours [default: the
    /// scene's own, else photo]
    #[arg(long, value_name = "LOOK", value_parser = drawn)]
    look: Option<Look>,
    /// Rounding of light to the display's levels: to the nearest, or by a pattern that keeps the mean of
    /// areas: ordered, without a pattern, or as drawn by hand with dots or lines [default: the scene's own,
    /// else none]
    #[arg(long, value_name = "HOW", value_parser = dither())]
    dither: Option<Dither>,
    /// The curve from light to the display's codes: that of sRGB, or linear [default: the scene's own; linear
    /// for .nff files, whose colors are meant so, else srgb]
    #[arg(long, value_name = "CURVE", value_parser = transfer())]
    transfer: Option<Transfer>,
    #[command(flatten)]
    sampling: SamplingArgs,
    /// Follow mirrored and refracted rays alone, or also scattered rays, by which surfaces light each other:
    /// path-tracing takes 64 samples, and as many rays as these need, unless other options set these numbers
    /// [default: the scene's own, else whitted]
    #[arg(long, value_name = "HOW", value_parser = named(&INTEGRATORS))]
    integrator: Option<Integrator>,
    /// Light lamps with a size by rays, or by formulas: without noise, and with soft shadows of opaque balls
    /// only [default: the scene's own, else sampled]
    #[arg(long, value_name = "HOW", value_parser = named(&AREA_LIGHTS))]
    area_lights: Option<AreaLights>,
    /// The most rays for one pixel, shadow rays included [default: the scene's own, else 4096]
    #[arg(
        long,
        value_name = "N",
        value_parser = value_parser!(u32).range(1..=i64::from(u32::MAX)),
    )]
    rays_per_pixel: Option<u32>,
    /// Leave out rays whose share in the pixel is smaller, 0 to 1 [default: the scene's own, else 1/256]
    #[arg(long, value_name = "SHARE", value_parser = share)]
    cutoff: Option<f32>,
}

/// The options that decide how a picture is drawn.
#[derive(Debug, Args)]
pub(crate) struct PictureArgs {
    #[command(flatten)]
    look: Appearance,
    /// Trace every pixel, interpolate pixels whose neighbors hit the same, or trace none: a preview has no
    /// shadows, and its mirrors and glass show the background
    #[arg(long, value_name = "MODE", default_value_t, value_enum)]
    mode: Mode,
    /// Draw edges in realtime mode in steps of a pixel, or smooth without samples; with --samples, those
    /// edges that are not known take them
    #[arg(long, value_name = "HOW", default_value = "stepped", value_parser = named(&EDGES))]
    edges: Edges,
    #[command(flatten)]
    segments: SegmentsArg,
    #[command(flatten)]
    panel: PanelArgs,
}

impl PictureArgs {
    /// The options for a picture of this scene.
    pub(crate) fn options(&self, scene: &LoadedScene<'_>) -> RenderOptions {
        let options = self.look.options(scene);
        let color = if self.panel.theme.is_some() { Display::Mono } else { options.display };
        let segments = self.segments.segments;
        RenderOptions { mode: self.mode, edges: self.edges, segments, display: color, ..options }
    }

    /// The look of the panel that shows the picture, if any is asked for.
    ///
    /// # Errors
    /// The options name a theme of two colors, and a display of more colors.
    pub(crate) fn panel(&self) -> Result<Option<OutputSettings>, String> {
        match (self.panel.theme, self.look.color) {
            (Some(_), Some(color)) if color != Display::Mono => {
                Err(format!("--theme has two colors, but --color {color} has more; leave out one of them"))
            }
            _ => Ok(self.panel.settings()),
        }
    }
}

/// The options that decide how a panel looks.
#[derive(Debug, Args)]
struct PanelArgs {
    /// Show the picture in the two colors of a panel; it is then made in black and white
    #[arg(long, value_name = "THEME", value_parser = named(&THEMES))]
    theme: Option<BinaryColorTheme>,
    /// Show each pixel of the panel as N by N pixels [default: 1; 3 with --theme]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=64))]
    scale: Option<u32>,
    /// Leave N pixels between the pixels of the panel [default: 0; 1 with --theme]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(0..=64))]
    pixel_spacing: Option<u32>,
}

impl PanelArgs {
    /// The look of the panel, if any of these options is given.
    fn settings(&self) -> Option<OutputSettings> {
        let Self { theme, scale, pixel_spacing } = *self;
        let builder = OutputSettingsBuilder::new();
        let builder = match theme {
            Some(theme) => builder.theme(theme),
            None if scale.is_none() && pixel_spacing.is_none() => return None,
            None => builder,
        };
        let settings = builder.build();
        Some(OutputSettings {
            scale: scale.unwrap_or(settings.scale),
            pixel_spacing: pixel_spacing.unwrap_or(settings.pixel_spacing),
            ..settings
        })
    }
}

/// The options that decide where the rays of a pixel go.
#[derive(Debug, Args)]
struct SamplingArgs {
    /// Samples for each pixel; more make edges smooth [default: the scene's own, else 1]
    #[arg(
        long,
        value_name = "N",
        value_parser = value_parser!(u16).range(1..=i64::from(u16::MAX)),
    )]
    samples: Option<u16>,
    /// How the samples are spread [default: the scene's own, else r2]
    #[arg(long, value_name = "HOW", value_parser = named(&SAMPLERS))]
    sampler: Option<Sampler>,
    /// The weight of the light around the center of a pixel [default: the scene's own, else box]
    #[arg(long, value_name = "FILTER", value_parser = named(&FILTERS))]
    filter: Option<Reconstruction>,
    /// Take N samples of each pixel, 2 or more, and the others only where these differ [default: the
    /// scene's own; 4 if no N is given]
    #[arg(
        long,
        value_name = "N",
        num_args = 0..=1,
        default_missing_value = "4",
        value_parser = value_parser!(u16).range(2..=i64::from(u16::MAX)),
    )]
    adaptive: Option<u16>,
    /// Seed of the samples; in scenes without a lens, lobes and lamps with a size it has no effect unless
    /// --samples is above 1 [default: the scene's own, else 0]
    #[arg(long, value_name = "N")]
    seed: Option<u32>,
}

const AXES: [(&str, Up); 6] =
    [("x", Up::X), ("y", Up::Y), ("z", Up::Z), ("-x", Up::MinusX), ("-y", Up::MinusY), ("-z", Up::MinusZ)];

const INTEGRATORS: [(&str, Integrator); 2] =
    [("whitted", Integrator::Whitted), ("path-tracing", Integrator::PathTracing)];

/// The samples of a path-traced picture.
const PATHS: u16 = 64;

const AREA_LIGHTS: [(&str, AreaLights); 2] =
    [("sampled", AreaLights::Sampled), ("closed-form", AreaLights::ClosedForm)];

const THEMES: [(&str, BinaryColorTheme); 6] = [
    ("inverted", BinaryColorTheme::Inverted),
    ("lcd-white", BinaryColorTheme::LcdWhite),
    ("lcd-green", BinaryColorTheme::LcdGreen),
    ("lcd-blue", BinaryColorTheme::LcdBlue),
    ("oled-white", BinaryColorTheme::OledWhite),
    ("oled-blue", BinaryColorTheme::OledBlue),
];

const EDGES: [(&str, Edges); 2] = [("stepped", Edges::Stepped), ("smooth", Edges::Smooth)];

const FILTERS: [(&str, Reconstruction); 3] =
    [("box", Reconstruction::Box), ("tent", Reconstruction::Tent), ("gaussian", Reconstruction::Gaussian)];

/// A parser of values that have names.
fn named<T: Copy + Send + Sync>(values: &'static [(&'static str, T)]) -> impl TypedValueParser<Value = T> {
    let names = PossibleValuesParser::new(values.iter().map(|(name, _)| *name));
    names.try_map(|given| {
        let value = values.iter().find(|(name, _)| *name == given);
        value.map(|(_, value)| *value).ok_or("the name is unknown")
    })
}

impl SamplingArgs {
    /// The sampling `own` of the scene, with the changes of these options.
    fn over(&self, own: Sampling) -> Sampling {
        let adaptive = self.adaptive.map(|at_first| Adaptive { at_first, ..Adaptive::NEW });
        Sampling {
            samples: self.samples.unwrap_or(own.samples),
            sampler: self.sampler.unwrap_or(own.sampler),
            filter: self.filter.unwrap_or(own.filter),
            adaptive: adaptive.or(own.adaptive),
            seed: self.seed.unwrap_or(own.seed),
        }
    }
}

impl Appearance {
    /// The options for a picture of this scene.
    pub(crate) fn options(&self, scene: &LoadedScene<'_>) -> RenderOptions {
        let (meant, own) = (RenderOptions::new(scene.settings), &scene.settings);
        let (width, height) = self.size.unwrap_or((own.width, own.height));
        let mut sampling = self.sampling.over(own.sampling);
        let integrator = self.integrator.unwrap_or(own.integrator);
        let traces_paths = integrator == Integrator::PathTracing;
        if traces_paths && self.sampling.samples.is_none() && own.sampling.samples == 1 {
            sampling.samples = PATHS;
        }
        let mut settings = Settings {
            width,
            height,
            bounces: self.bounces.unwrap_or(own.bounces),
            rays_per_pixel: self.rays_per_pixel.unwrap_or(own.rays_per_pixel),
            cutoff: self.cutoff.unwrap_or(own.cutoff),
            sampling,
            integrator,
            area_lights: self.area_lights.unwrap_or(own.area_lights),
            transfer: self.transfer.unwrap_or(own.transfer),
            dither: self.dither.unwrap_or(own.dither),
            look: self.look.unwrap_or(own.look),
        };
        if traces_paths && self.rays_per_pixel.is_none() {
            let needed = most_rays(&scene.scene, Settings { rays_per_pixel: u32::MAX, ..settings });
            settings.rays_per_pixel = own.rays_per_pixel.max(u32::try_from(needed).unwrap_or(u32::MAX));
        }
        RenderOptions { settings, number: self.number, display: self.color.unwrap_or_default(), ..meant }
    }
}

fn dither() -> impl TypedValueParser<Value = Dither> {
    let names = ["none", "ordered", "blue-noise", "stippling", "hatching"];
    PossibleValuesParser::new(names).map(|name| match &*name {
        "ordered" => Dither::Ordered,
        "blue-noise" => Dither::BlueNoise,
        "stippling" => Dither::Stippling,
        "hatching" => Dither::Hatching,
        _ => Dither::None,
    })
}

/// Parses a look: the names of tones and of contours, with a comma between them.
fn drawn(text: &str) -> Result<Look, &'static str> {
    const EXPECTED: &str = "expected photo, toon, toon:N or gooch, contours, or both: toon,contours";
    let mut look = Look::PHOTO;
    for part in text.split(',') {
        match part.split_once(':') {
            None if part == "photo" => look.tones = Tones::Light,
            None if part == "toon" => look.tones = Tones::Toon { steps: 4 },
            None if part == "gooch" => look.tones = Tones::Gooch(Gooch::NEW),
            None if part == "contours" => look.contours = Some(Contours::NEW),
            Some(("toon", steps)) => {
                look.tones = Tones::Toon { steps: steps.parse().map_err(|_| EXPECTED)? };
            }
            _ => return Err(EXPECTED),
        }
    }
    Ok(look)
}

fn transfer() -> impl TypedValueParser<Value = Transfer> {
    PossibleValuesParser::new(["srgb", "linear"]).map(|name| match &*name {
        "linear" => Transfer::Linear,
        _ => Transfer::Srgb,
    })
}

/// Parses two numbers with a separator between them.
fn pair<T: FromStr>(text: &str, separator: &str) -> Option<(T, T)> {
    let (first, second) = text.split_once(separator)?;
    Some((first.parse().ok()?, second.parse().ok()?))
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let side = 1..=MAX_SIDE;
    pair(text, "x")
        .filter(|(width, height)| side.contains(width) && side.contains(height))
        .ok_or_else(|| format!("expected a width and a height from 1 to {MAX_SIDE}, such as 320x240"))
}

/// Parses the points of a grid along x, y and z.
fn grid(text: &str) -> Result<[u8; 3], &'static str> {
    let counts = text.split('x').map(|count| count.parse().ok().filter(|count: &u8| *count > 0));
    let counts: Option<Vec<u8>> = counts.collect();
    counts
        .and_then(|counts| counts.try_into().ok())
        .ok_or("expected three numbers from 1 to 255, such as 4x4x4")
}

/// Parses an azimuth and an elevation.
fn direction(text: &str) -> Result<(f32, f32), &'static str> {
    pair(&text.replace(MINUS, "-"), ",")
        .filter(|(azimuth, elevation): &(f32, f32)| azimuth.abs() <= 360.0 && elevation.abs() <= 90.0)
        .ok_or("expected an azimuth from -360 to 360 and an elevation from -90 to 90 degrees, such as 30,20")
}

/// Parses any column and line. The size of the picture, which is not known here, decides whether the pixel
/// exists.
fn pixel(text: &str) -> Result<(i64, i64), &'static str> {
    pair(&text.replace(MINUS, "-"), ",").ok_or("expected a column and a line, such as 160,120")
}

/// A minus sign in place of `-`, so that clap does not take a negative column for an option.
const MINUS: char = '\u{2212}';

/// The arguments of the program. A pixel such as -1,2 is marked, so that it is not taken for an option and
/// gets its own error.
pub(crate) fn arguments() -> impl Iterator<Item = OsString> {
    std::env::args_os().map(|argument| match argument.to_str().and_then(|text| text.strip_prefix('-')) {
        Some(rest) if pair::<i64>(rest, ",").is_some() => format!("{MINUS}{rest}").into(),
        _ => argument,
    })
}

fn lines(text: &str) -> Result<Range<u32>, &'static str> {
    pair(text, "..")
        .filter(|(first, end)| first < end)
        .map(|(first, end)| first..end)
        .ok_or("expected the first line and the one after the last, such as 0..120")
}

fn share(text: &str) -> Result<f32, &'static str> {
    text.parse().ok().filter(|share| (0.0..=1.0).contains(share)).ok_or("expected a number from 0 to 1")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_well_formed() {
        use clap::CommandFactory;
        Cli::command().debug_assert();
    }

    #[test]
    fn sizes_lines_pixels_and_shares() {
        assert_eq!(size("320x240"), Ok((320, 240)));
        assert_eq!(size("65535x1"), Ok((65_535, 1)));
        for bad in ["", "320", "0x240", "320x0", "65536x1", "-1x5", "320X240", "3.5x2", "1x2x3"] {
            assert!(size(bad).is_err(), "{bad}");
        }
        assert_eq!(lines("3..7"), Ok(3..7));
        for bad in ["", "3", "7..3", "3..3", "3..=7", "..7"] {
            assert!(lines(bad).is_err(), "{bad}");
        }
        assert_eq!(pixel("0,7"), Ok((0, 7)));
        assert_eq!(pixel("-1,0"), Ok((-1, 0)));
        for bad in ["7", "--x", "1,2,3"] {
            assert!(pixel(bad).is_err(), "{bad}");
        }
        assert_eq!(direction("-30.5,90"), Ok((-30.5, 90.0)));
        // A minus sign that was marked for clap.
        assert_eq!(direction(&format!("{MINUS}30,-5")), Ok((-30.0, -5.0)));
        for bad in ["30", "361,0", "0,91", "nan,0", "0,inf", "1,2,3"] {
            assert!(direction(bad).is_err(), "{bad}");
        }
        let (tones, contours) = (Tones::Toon { steps: 3 }, Some(Contours::NEW));
        assert_eq!(drawn("contours,toon:3"), Ok(Look { tones, contours }));
        assert_eq!(drawn("photo"), Ok(Look::PHOTO));
        for bad in ["", "toon:", "toon:256", "Toon", "gooch:3", "toon contours", "toon,", "photo:1"] {
            assert!(drawn(bad).is_err(), "{bad}");
        }
        assert_eq!(share("0.25"), Ok(0.25));
        for bad in ["NaN", "-0.1", "1.1", "x"] {
            assert!(share(bad).is_err(), "{bad}");
        }
    }
}
