//! Drawing of the scene in the window, and its moving camera.

use core::marker::PhantomData;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{BinaryColor, Rgb888};
use embedded_graphics_simulator::{OutputSettings, OutputSettingsBuilder, SimulatorDisplay};
use rayline::math::Fixed;
use rayline::shape::Shape;
use rayline::{
    Camera, DisplayColor, Frame, LineError, PixelSum, PreparedScene, Preview, PreviewPixel, Progressive,
    Quality, RayCounts, Real, Renderer, Sample, Scene, Settings,
};

use super::request::Request;
use super::screen::Screen;
use super::{Save, Watched, WindowError};
use crate::display::ForColor;
use crate::picture::memory_for;
use crate::preview::facets;
use crate::realtime::quality_for;
use crate::{LoadedScene, Mode, Number, Orbit, RenderOptions};

/// The largest width and height of a window, in pixels: any graphics card has textures of this size.
const MAX_WINDOW: u32 = 4096;

/// Small pictures are enlarged to about this size, in pixels.
const COMFORTABLE: u32 = 640;

/// The time of drawing between two updates of the window.
const PATIENCE: Duration = Duration::from_millis(15);

/// The time between two looks at the scene's file, when there is nothing to draw.
const REST: Duration = Duration::from_millis(100);

/// The rays between two readings of the clock.
const BUDGET_RAYS: u32 = 1000;

/// The way to go on after the window has shown something; of several, the last one counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Next {
    /// Draw with the camera that was moved.
    Moved,
    /// Draw in another number system, mode or color.
    Switched,
    /// Read the file again, which has changed.
    ReadAgain,
    Close,
}

/// The window with everything that stays when the scene's file is read again.
pub(super) struct View<'w> {
    screen: Screen,
    options: RenderOptions,
    panel: Option<OutputSettings>,
    save: &'w mut Save<'w>,
    /// The scene's own camera, and where the user moved it.
    moved: Option<(Camera, Orbit)>,
}

impl<'w> View<'w> {
    pub(super) fn new(
        screen: Screen,
        options: RenderOptions,
        panel: Option<OutputSettings>,
        save: &'w mut Save<'w>,
    ) -> Self {
        Self { screen, options, panel, save, moved: None }
    }

    /// Draws with the settings of a new version of the scene.
    pub(super) fn set_settings(&mut self, settings: Settings) {
        self.options.settings = settings;
    }

    /// Shows one version of the scene until its file changes, or the window is to be closed.
    pub(super) fn show(&mut self, scene: &LoadedScene<'_>, file: &mut Watched) -> Result<Next, WindowError> {
        loop {
            let display = self.options.display;
            let next = match self.options.number {
                Number::F32 => display.color(Drawing::<f32>::new(self, scene, file)),
                Number::Fixed => display.color(Drawing::<Fixed>::new(self, scene, file)),
                Number::F64 => display.color(Drawing::<f64>::new(self, scene, file)),
            }?;
            if next != Next::Switched {
                return Ok(next);
            }
        }
    }

    /// Shows an error over the last picture until the file changes, or the window is to be closed.
    pub(super) fn tell(&mut self, error: &WindowError, file: &mut Watched) -> Result<Next, WindowError> {
        self.screen.write(&error.to_string())?;
        loop {
            if self.screen.requests(REST)?.contains(&Request::Close) {
                return Ok(Next::Close);
            }
            if file.has_changed() {
                return Ok(Next::ReadAgain);
            }
        }
    }

    /// The look of the panel: small pictures are enlarged, so that their pixels can be seen.
    fn panel(&self) -> OutputSettings {
        let side = self.options.settings.width.max(self.options.settings.height);
        let scale = COMFORTABLE.checked_div(side).unwrap_or(1).max(1);
        self.panel.unwrap_or_else(|| OutputSettingsBuilder::new().scale(scale).build())
    }

    /// The user's camera. It stays if a new version of the file has the camera of the last one.
    fn camera(&self, scene: &LoadedScene<'_>) -> Camera {
        let own = scene.scene.camera;
        self.moved.filter(|(of, _)| *of == own).map_or(own, |(_, orbit)| orbit.camera())
    }

    /// Moves the user's camera.
    fn orbit(&mut self, scene: &LoadedScene<'_>) -> Result<&mut Orbit, WindowError> {
        let own = scene.scene.camera;
        let moved = match self.moved.filter(|(of, _)| *of == own) {
            Some(moved) => moved,
            None => {
                let refused = |error| WindowError::of_scene(scene, &error);
                (own, Orbit::around(&scene.scene).map_err(refused)?)
            }
        };
        Ok(&mut self.moved.insert(moved).1)
    }
}

/// One version of the scene in one number system, mode and color.
struct Drawing<'v, 'w, 's, R> {
    view: &'v mut View<'w>,
    scene: &'s LoadedScene<'s>,
    file: &'v mut Watched,
    number: PhantomData<R>,
}

/// The simulator's display, with the look of the panel.
struct Canvas<C> {
    display: SimulatorDisplay<C>,
    panel: OutputSettings,
}

impl<'v, 'w, 's, R: Real> Drawing<'v, 'w, 's, R> {
    fn new(view: &'v mut View<'w>, scene: &'s LoadedScene<'s>, file: &'v mut Watched) -> Self {
        Self { view, scene, file, number: PhantomData }
    }

    /// Draws until the user or the file changes something. Calls `refine` whenever the picture is complete,
    /// which says whether there is more to draw.
    fn show<'r, 'm, C: DisplayColor + Into<Rgb888> + From<Rgb888>, Q: Quality<R, Color = C>>(
        &mut self,
        frame: &mut Frame<'r, 'm, R, Shape<'m>, Q>,
        refine: impl Fn(&mut Frame<'r, 'm, R, Shape<'m>, Q>) -> Result<bool, LineError>,
        canvas: &mut Canvas<C>,
    ) -> Result<Next, WindowError> {
        let (mut rays, mut busy, mut is_complete) = (RayCounts::default(), Duration::ZERO, false);
        loop {
            if !is_complete {
                let start = Instant::now();
                let is_drawn = draw_for_a_while(frame, &mut canvas.display, &mut rays)?;
                busy += start.elapsed();
                if is_drawn {
                    self.view.screen.set_title(&self.title(rays, busy));
                    is_complete = !refine(frame).map_err(|error| WindowError::Draw(error.into()))?;
                }
                let picture = canvas.display.to_rgb_output_image(&canvas.panel);
                self.view.screen.show(picture, canvas.display.output_size(&canvas.panel))?;
            }
            // Carry out all waiting requests before the next picture, so that a held key does not lag.
            let mut next = None;
            for request in self.view.screen.requests(if is_complete { REST } else { Duration::ZERO })? {
                next = next.max(self.obey(request)?);
            }
            if next.is_none() && self.file.has_changed() {
                next = Some(Next::ReadAgain);
            }
            if let Some(next) = next {
                return Ok(next);
            }
        }
    }

    /// The title of the window: how the picture was made, its rays and its time.
    fn title(&self, rays: RayCounts, time: Duration) -> String {
        let RenderOptions { number, mode, display, .. } = &self.view.options;
        let (count, milliseconds) = (rays.total(), time.as_secs_f64() * 1000.0);
        format!(
            "rayline: {}, {number} {mode} {display}, {count} rays in {milliseconds:.0} ms",
            self.scene.name
        )
    }

    /// Carries out a request. Returns the way to go on, if the picture changes.
    fn obey(&mut self, request: Request) -> Result<Option<Next>, WindowError> {
        let options = &mut self.view.options;
        Ok(Some(match request {
            Request::Turn { right, up } => {
                self.view.orbit(self.scene)?.turn(right, up);
                Next::Moved
            }
            Request::Dolly(scale) => {
                self.view.orbit(self.scene)?.dolly(scale);
                Next::Moved
            }
            Request::Home => {
                self.view.moved = None;
                Next::Moved
            }
            Request::NextNumber => {
                options.number = following(options.number);
                Next::Switched
            }
            Request::NextMode => {
                options.mode = following(options.mode);
                Next::Switched
            }
            Request::NextColor => {
                options.display = following(options.display);
                Next::Switched
            }
            Request::Save => {
                let seen = Scene { camera: self.view.camera(self.scene), ..self.scene.scene };
                (self.view.save)(&seen, &self.view.options).map_err(WindowError::Save)?;
                return Ok(None);
            }
            Request::Close => Next::Close,
        }))
    }

    /// Draws in the quality of the options.
    fn draw<C: DisplayColor + Into<Rgb888> + From<Rgb888> + From<BinaryColor>>(
        &mut self,
        renderer: &Renderer<'_, '_, R>,
        canvas: &mut Canvas<C>,
    ) -> Result<Next, WindowError> {
        let RenderOptions { settings, mode, edges, segments, .. } = self.view.options;
        let (lines, width) = (0..settings.height, settings.width as usize);
        let failed = |error: LineError| WindowError::Draw(error.into());
        let black = C::from(BinaryColor::Off);
        match mode {
            Mode::Realtime => {
                let quality = quality_for(settings.width, edges);
                let mut colors = vec![black; quality.colors(settings.width as u16)];
                let mut samples = vec![Sample::BLANK; quality.samples(settings.width as u16)];
                let lent = quality.lend(&mut colors, &mut samples);
                let mut frame = renderer.frame(lines, lent).map_err(failed)?;
                self.show(&mut frame, |_| Ok(false), canvas)
            }
            Mode::Preview => {
                let mut facets = facets();
                let preview = Preview::new(renderer, segments, &mut facets);
                let mut preview = preview.map_err(WindowError::Preview)?;
                let (mut buffer, mut pixels) = (vec![black; width], vec![PreviewPixel::BLANK; width]);
                let lent = preview.lend(&mut buffer, &mut pixels);
                let mut frame = renderer.frame(lines, lent).map_err(failed)?;
                self.show(&mut frame, |_| Ok(false), canvas)
            }
            Mode::Exact if settings.sampling.samples > 1 => {
                let mut buffer = vec![black; width];
                let mut sums = vec![PixelSum::<R>::EMPTY; width * settings.height as usize];
                let quality = Progressive::lend(&mut buffer, &mut sums);
                let mut frame = renderer.frame(lines.clone(), quality).map_err(failed)?;
                // While the camera rests, each pass adds a sample to every pixel.
                let refine = |frame: &mut Frame<'_, '_, _, _, Progressive<'_, C, R>>| {
                    if frame.is_refined() { Ok(false) } else { frame.set_lines(lines.clone()).map(|()| true) }
                };
                self.show(&mut frame, refine, canvas)
            }
            Mode::Exact => {
                let mut buffer = vec![black; width];
                let mut frame = renderer.frame(lines, &mut buffer[..]).map_err(failed)?;
                self.show(&mut frame, |_| Ok(false), canvas)
            }
        }
    }
}

impl<R: Real> ForColor for Drawing<'_, '_, '_, R> {
    type Output = Result<Next, WindowError>;

    fn with<C>(mut self) -> Self::Output
    where
        C: DisplayColor + Into<Rgb888> + From<Rgb888> + From<BinaryColor> + Send,
    {
        let (settings, panel) = (self.view.options.settings, self.view.panel());
        let side = u64::from(settings.width.max(settings.height));
        if side * (u64::from(panel.scale) + u64::from(panel.pixel_spacing)) > u64::from(MAX_WINDOW) {
            return Err(WindowError::TooLarge { most: MAX_WINDOW });
        }
        let display = SimulatorDisplay::<C>::new(Size::new(settings.width, settings.height));
        self.view.screen.resize(display.output_size(&panel));
        let mut canvas = Canvas { display, panel };
        let mut scene = Scene { camera: self.view.camera(self.scene), ..self.scene.scene };
        let mut memory = memory_for::<R>(&scene);
        'scene: loop {
            let mut prepared = match PreparedScene::<R, _>::new(&scene, &mut memory) {
                Ok(prepared) => prepared,
                // The user's camera may be out of the range of another number system.
                Err(_) if self.view.moved.take().is_some() => {
                    scene.camera = self.scene.scene.camera;
                    continue;
                }
                Err(error) => return Err(WindowError::of_scene(self.scene, &error)),
            };
            loop {
                // If the moved camera is refused, return to this one.
                let before = self.view.moved;
                let renderer = Renderer::new(&prepared, settings).map_err(WindowError::Settings)?;
                let next = self.draw(&renderer, &mut canvas)?;
                if next != Next::Moved {
                    return Ok(next);
                }
                let camera = self.view.camera(self.scene);
                if prepared.set_camera(&camera).is_ok() {
                    continue;
                }
                // In fixed point the scene may need another scale for this camera.
                let moved = Scene { camera, ..scene };
                if PreparedScene::<R, _>::new(&moved, &mut memory_for::<R>(&moved)).is_ok() {
                    scene = moved;
                    continue 'scene;
                }
                self.view.moved = before;
            }
        }
    }
}

/// Draws until the window has to be updated or the picture is complete. Returns whether it is complete.
fn draw_for_a_while<R: Real, C: DisplayColor, Q: Quality<R, Color = C>>(
    frame: &mut Frame<'_, '_, R, Shape<'_>, Q>,
    display: &mut SimulatorDisplay<C>,
    rays: &mut RayCounts,
) -> Result<bool, WindowError> {
    let start = Instant::now();
    while start.elapsed() < PATIENCE {
        if frame.step_watched(display, BUDGET_RAYS, rays).map_err(WindowError::Draw)?.is_done() {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The value after this one, in the order of `--help`; after the last comes the first.
fn following<T: ValueEnum + PartialEq>(value: T) -> T {
    let values = T::value_variants();
    let next = values.iter().skip_while(|other| **other != value).nth(1).or(values.first());
    next.cloned().unwrap_or(value)
}
