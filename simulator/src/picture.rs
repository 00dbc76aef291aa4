//! Pictures of scenes: the core's lines, rendered by several threads.
//!
//! A line is a pure function of scene and settings, so threads share nothing but the prepared scene, and the
//! bytes are the same for any number of them.

use core::fmt;
use core::mem::MaybeUninit;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use rayline::limits::LINES_AT_ONCE;
use rayline::math::Fixed;
use rayline::shape::Shape;
use rayline::{
    DisplayColor, Light16, LineError, Object, PreparedScene, Preview, PreviewError, Quantizer, RayCounts,
    Real, Renderer, Scene, SceneError, Settings, SettingsError,
};

use crate::display::ForColor;
use crate::distinct::distinct;
use crate::parts::render_parts;
use crate::preview::{draw_lines, facets};
use crate::realtime::Bands;
use crate::{Mode, Number, RenderOptions, Show};

/// A picture as a display shows it, with the numbers of its rays and its memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// The width in pixels.
    pub width: u32,
    /// The height in lines.
    pub height: u32,
    /// Red, green and blue of each pixel, from the upper left, line by line.
    pub rgb: Vec<u8>,
    /// The numbers of rays that were traced and that were cut.
    pub rays: RayCounts,
    /// The memory that was lent for the prepared scene, in bytes.
    pub prepared_bytes: usize,
}

impl Picture {
    /// The peak signal-to-noise ratio in decibels against a reference picture of the same size; `None` if
    /// both are equal.
    pub fn psnr(&self, reference: &Self) -> Option<f64> {
        let square = |(a, b): (&u8, &u8)| f64::from(a.abs_diff(*b)).powi(2);
        let sum: f64 = self.rgb.iter().zip(&reference.rgb).map(square).sum();
        (sum > 0.0).then(|| 10.0 * (255.0 * 255.0 * self.rgb.len() as f64 / sum).log10())
    }

    /// The peak signal-to-noise ratio as text in decibels, or `same bytes`.
    pub(crate) fn decibels(&self, reference: &Self) -> String {
        match self.psnr(reference) {
            Some(decibels) => format!("{decibels:.1}"),
            None => "same bytes".to_owned(),
        }
    }
}

/// The reason why a scene cannot be rendered.
#[derive(Debug)]
#[non_exhaustive]
pub enum RenderError {
    /// The scene was refused. Correct the part that the error names.
    Scene(SceneError),
    /// A setting is out of range. Change it.
    Settings(SettingsError),
    /// The picture does not have these lines. Use lines that it has.
    Line(LineError),
    /// The scene has no preview: it has too many facets, or the picture is too large.
    Preview(PreviewError),
    /// The picture is too large for this machine's memory. Render fewer lines at a time.
    Memory {
        /// The memory that the picture takes, in bytes.
        needed: u64,
    },
    /// The system cannot start this number of threads. Use fewer.
    Threads(rayon::ThreadPoolBuildError),
}

/// Renders a picture of a scene.
///
/// ```
/// use rayline::{Settings, builtin::CLASSIC};
/// use rayline_simulator::{RenderOptions, render};
/// let picture = render(&CLASSIC, &RenderOptions::new(Settings::new(64, 48)))?;
/// assert_eq!(picture.rgb.len(), 64 * 48 * 3);
/// # Ok::<(), rayline_simulator::RenderError>(())
/// ```
///
/// # Errors
/// The scene or an option was refused. No ray was traced then.
pub fn render(scene: &Scene<'_>, options: &RenderOptions) -> Result<Picture, RenderError> {
    render_watched(scene, options, &|| ())
}

/// Renders a picture like [`render`], and calls `line_done` after each line, in no particular order.
///
/// # Errors
/// The errors of [`render`].
pub fn render_watched(
    scene: &Scene<'_>,
    options: &RenderOptions,
    line_done: &(dyn Fn() + Sync),
) -> Result<Picture, RenderError> {
    match options.number {
        Number::F32 => render_in::<f32>(scene, options, line_done),
        Number::Fixed => render_in::<Fixed>(scene, options, line_done),
        Number::F64 => render_in::<f64>(scene, options, line_done),
    }
}

fn render_in<R: Real>(
    scene: &Scene<'_>,
    options: &RenderOptions,
    line_done: &(dyn Fn() + Sync),
) -> Result<Picture, RenderError> {
    let kept = distinct(scene);
    let seen = seen(scene, kept.as_deref());
    let mut memory = memory_for::<R>(&seen);
    let prepared_bytes = memory.len();
    let prepared = prepared::<R>(scene, &seen, &mut memory)?;
    let renderer = Renderer::new(&prepared, options.settings).map_err(RenderError::Settings)?;
    let lines = options.lines.clone().unwrap_or(0..renderer.height());
    if lines.end > renderer.height() {
        let error = LineError::NoSuchLine { line: lines.end.saturating_sub(1), height: renderer.height() };
        return Err(RenderError::Line(error));
    }
    let (width, height, pool) = (renderer.width(), lines.len() as u32, pool(options)?);
    let mut rgb = blank(width, height)?;
    let (renderer, rgb_lines) = (&renderer, &mut rgb[..]);
    let rays = pool.install(|| match options.mode {
        Mode::Realtime if options.show == Show::Colors => {
            let edges = options.edges;
            let bands = Bands { renderer, lines, edges, rgb: rgb_lines, line_done };
            options.display.color(bands).map_err(RenderError::Line)
        }
        Mode::Preview if options.show == Show::Colors => {
            let mut facets = facets();
            let preview = Preview::new(renderer, options.segments, &mut facets);
            let mut preview = preview.map_err(RenderError::Preview)?;
            let (first, pixels) = (lines.start, u64::from(width) * u64::from(height));
            let mut lights = many(pixels, Light16::BLACK)?;
            draw_lines(&mut preview, renderer, lines, &mut lights, line_done).map_err(RenderError::Line)?;
            let RenderOptions { display, settings, .. } = options;
            display.color(Lights { lights: &lights, settings, first, rgb: rgb_lines });
            Ok(RayCounts::default())
        }
        _ => {
            let picture = Lines { renderer, options, first: lines.start, line_done };
            picture.render(rgb_lines).map_err(RenderError::Line)
        }
    })?;
    Ok(Picture { width, height, rgb, rays, prepared_bytes })
}

/// The threads that render.
pub(crate) fn pool(options: &RenderOptions) -> Result<rayon::ThreadPool, RenderError> {
    rayon::ThreadPoolBuilder::new().num_threads(options.threads).build().map_err(RenderError::Threads)
}

/// The scene with only these of its objects, if any are given: those that [`distinct`] keeps.
pub(crate) fn seen<'a>(scene: &Scene<'a>, kept: Option<&'a [Object<Shape<'a>>]>) -> Scene<'a> {
    Scene { objects: kept.unwrap_or(scene.objects), ..*scene }
}

/// Prepares what is `seen` of a scene; errors name the parts of the whole scene.
pub(crate) fn prepared<'m, R: Real>(
    scene: &Scene<'_>,
    seen: &Scene<'m>,
    memory: &'m mut [MaybeUninit<u8>],
) -> Result<PreparedScene<'m, R>, RenderError> {
    PreparedScene::new(seen, memory).map_err(|error| {
        let whole = PreparedScene::<R, _>::new(scene, &mut memory_for::<R>(scene)).map(|_| ());
        RenderError::Scene(whole.err().unwrap_or(error))
    })
}

/// Memory to lend for a prepared scene.
pub(crate) fn memory_for<R: Real>(scene: &Scene<'_>) -> Vec<MaybeUninit<u8>> {
    vec![MaybeUninit::uninit(); scene.bytes::<R>()]
}

/// A black picture of this size.
pub(crate) fn blank(width: u32, height: u32) -> Result<Vec<u8>, RenderError> {
    many(u64::from(width) * u64::from(height) * 3, 0)
}

/// So many equal values.
pub(crate) fn many<T: Clone>(count: u64, value: T) -> Result<Vec<T>, RenderError> {
    let mut values = Vec::new();
    match usize::try_from(count) {
        Ok(count) if values.try_reserve_exact(count).is_ok() => values.resize(count, value),
        _ => return Err(RenderError::Memory { needed: count.saturating_mul(size_of::<T>() as u64) }),
    }
    Ok(values)
}

/// Some lines to be rendered in exact quality. They are traced as light: the tracer is compiled once for all
/// displays.
struct Lines<'j, 'm, R: Real> {
    renderer: &'j Renderer<'j, 'm, R>,
    options: &'j RenderOptions,
    first: u32,
    line_done: &'j (dyn Fn() + Sync),
}

impl<R: Real> Lines<'_, '_, R> {
    fn render(&self, rgb: &mut [u8]) -> Result<RayCounts, LineError> {
        let width = self.renderer.width() as usize;
        render_parts(rgb, width * LINES_AT_ONCE * 3, &|number, rgb| {
            let y = self.first + (number * LINES_AT_ONCE) as u32;
            let rays = match self.options.show {
                Show::Colors => self.colors(y, rgb)?,
                Show::Samples => self.sample_counts(y, rgb),
            };
            (0..rgb.len() / (width * 3)).for_each(|_| (self.line_done)());
            Ok(rays)
        })
    }

    /// Lines from `y` on, in the display's colors.
    fn colors(&self, y: u32, rgb: &mut [u8]) -> Result<RayCounts, LineError> {
        let mut lights = vec![Light16::BLACK; rgb.len() / 3];
        let mut rays = RayCounts::default();
        self.renderer.lines(y, &mut lights, &mut rays)?;
        let RenderOptions { display, settings, .. } = self.options;
        display.color(Lights { lights: &lights, settings, first: y, rgb });
        Ok(rays)
    }

    /// Lines from `y` on, which show how many samples their pixels take.
    fn sample_counts(&self, y: u32, rgb: &mut [u8]) -> RayCounts {
        let most = f64::from(self.options.settings.sampling.samples);
        let mut sum = RayCounts::default();
        let places = (y..).flat_map(|y| (0..self.renderer.width()).map(move |x| (x as u16, y as u16)));
        for (pixel, (x, y)) in rgb.chunks_exact_mut(3).zip(places) {
            let mut rays = RayCounts::default();
            self.renderer.pixel(x, y, &mut rays);
            pixel.fill((rays.camera as f64 / most * 255.0).round() as u8);
            sum += rays;
        }
        sum
    }
}

/// Lines of light that are to be turned into a display's colors.
pub(crate) struct Lights<'l> {
    pub(crate) lights: &'l [Light16],
    pub(crate) settings: &'l Settings,
    pub(crate) first: u32,
    pub(crate) rgb: &'l mut [u8],
}

impl ForColor for Lights<'_> {
    type Output = ();

    fn with<C: DisplayColor + Into<Rgb888>>(self) {
        let width = self.settings.width;
        let places = (self.first..).flat_map(|y| (0..width).map(move |x| (x as u16, y as u16)));
        for ((light, pixel), (x, y)) in self.lights.iter().zip(self.rgb.chunks_exact_mut(3)).zip(places) {
            let color: Rgb888 = C::from_light(*light, &Quantizer::new(self.settings, x, y)).into();
            pixel.copy_from_slice(&[color.r(), color.g(), color.b()]);
        }
    }
}

impl fmt::Display for RenderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Settings(error) => error.fmt(f),
            Self::Line(error) => error.fmt(f),
            Self::Preview(error) => error.fmt(f),
            Self::Memory { needed } => {
                write!(f, "a picture of {needed} bytes does not fit in memory; render fewer lines at a time")
            }
            Self::Threads(error) => write!(f, "cannot start the threads: {error}"),
        }
    }
}

impl core::error::Error for RenderError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Scene(error) => Some(error),
            Self::Settings(error) => Some(error),
            Self::Line(error) => Some(error),
            Self::Preview(error) => Some(error),
            Self::Memory { .. } => None,
            Self::Threads(error) => Some(error),
        }
    }
}
