//! The window: it draws a scene line by line, as a board would, through embedded-graphics' simulator.

use core::convert::Infallible;
use core::fmt;
use std::error::Error;
use std::time::{Duration, Instant};

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{BinaryColor, Rgb888};
use embedded_graphics_simulator::sdl2::Keycode;
use embedded_graphics_simulator::{
    OutputSettings, OutputSettingsBuilder, SimulatorDisplay, SimulatorEvent, Window,
};
use rayline::math::{Fixed, Interval, Ray};
use rayline::shape::Shape;
use rayline::{
    Camera, DisplayColor, DrawError, Frame, LineError, PixelSum, PreparedScene, Progressive, Quality, Real,
    Renderer, Scene, SceneError, SettingsError,
};

use crate::display::ForColor;
use crate::picture::memory_for;
use crate::{LoadedScene, Number, Orbit, RenderOptions};

/// The reason why the window cannot open, or closed.
#[derive(Debug)]
#[non_exhaustive]
pub enum WindowError {
    /// The system has no display to open a window on. Start it from a desktop session.
    NoDisplay(String),
    /// The picture is too large for a window. Choose a smaller size.
    TooLarge {
        /// The largest width and height, in pixels.
        most: u32,
    },
    /// The scene was refused. Correct the part that the error names.
    Scene(SceneError),
    /// A setting is out of range. Change it.
    Settings(SettingsError),
    /// A line could not be drawn.
    Draw(DrawError<Infallible>),
    /// The picture could not be saved.
    Save(Box<dyn Error>),
}

/// A function that saves a picture of the scene as the window shows it.
pub type Save<'s> = dyn FnMut(&Scene<'_>) -> Result<(), Box<dyn Error>> + 's;

/// The largest width and height of a window, in pixels: any graphics card has textures of this size.
const MAX_WINDOW: u32 = 4096;

/// Small pictures are enlarged to about this size, in pixels.
const COMFORTABLE: u32 = 640;

/// The angle of one press of an arrow key, in radians: 5°.
const TURN: f64 = 0.087;

/// The factor of the distance for one press of plus or minus.
const DOLLY: f64 = 1.1;

/// The time of drawing between two updates of the window.
const PATIENCE: Duration = Duration::from_millis(15);

/// The rays between two readings of the clock.
const BUDGET_RAYS: u32 = 1000;

/// Shows a scene in a window until it is closed or Q is pressed. Arrow keys orbit the point in the middle of
/// the picture, plus and minus change the distance to it, and S calls `save`.
///
/// # Errors
/// There is no display, the scene is refused, or `save` failed.
pub fn show_window(
    scene: &LoadedScene<'_>,
    options: &RenderOptions,
    save: &mut Save<'_>,
) -> Result<(), WindowError> {
    let most = MAX_WINDOW;
    if options.settings.width > most || options.settings.height > most {
        return Err(WindowError::TooLarge { most });
    }
    check_display()?;
    match options.number {
        Number::F32 => options.display.color(View::<f32>::new(scene, options, save)?),
        Number::Fixed => options.display.color(View::<Fixed>::new(scene, options, save)?),
        Number::F64 => options.display.color(View::<f64>::new(scene, options, save)?),
    }
}

/// Checks that there is a visible display. Without one, the simulator's window would panic, or run invisibly
/// forever.
fn check_display() -> Result<(), WindowError> {
    let video = sdl2::init().and_then(|context| context.video()).map_err(WindowError::NoDisplay)?;
    match video.current_video_driver() {
        "dummy" | "offscreen" | "evdev" => {
            Err(WindowError::NoDisplay("there is no display; start it from a desktop session".to_owned()))
        }
        _ => Ok(()),
    }
}

/// The state of the window: a scene with a moving camera.
struct View<'s, 'k, R> {
    scene: &'s LoadedScene<'s>,
    options: &'s RenderOptions,
    save: &'s mut Save<'k>,
    orbit: Orbit,
    number: core::marker::PhantomData<R>,
}

/// A request from the keyboard or the window.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Request {
    Turn { right: f64, up: f64 },
    Dolly(f64),
    Save,
    Quit,
}

impl<'s, 'k, R: Real> View<'s, 'k, R> {
    fn new(
        scene: &'s LoadedScene<'s>,
        options: &'s RenderOptions,
        save: &'s mut Save<'k>,
    ) -> Result<Self, WindowError> {
        let mut memory = memory_for::<R>(&scene.scene);
        let prepared = PreparedScene::<R, _>::new(&scene.scene, &mut memory).map_err(WindowError::Scene)?;
        let camera = scene.scene.camera;
        let fallback = (camera.target - camera.eye).length();
        let distance = distance_ahead(&prepared, &camera).unwrap_or(fallback);
        // The camera was prepared, so it has a line of sight and this error cannot occur.
        let orbit = Orbit::new(camera, distance).ok_or(WindowError::Scene(SceneError {
            part: rayline::Part::Camera,
            fault: rayline::Fault::EyeAtTarget,
        }))?;
        Ok(Self { scene, options, save, orbit, number: core::marker::PhantomData })
    }

    /// Carries out a request. Returns whether the camera moved, or `None` if the window is to be closed.
    fn obey(&mut self, request: Request) -> Result<Option<bool>, WindowError> {
        match request {
            Request::Turn { right, up } => self.orbit.turn(right, up),
            Request::Dolly(scale) => self.orbit.dolly(scale),
            Request::Save => {
                let scene = Scene { camera: self.orbit.camera(), ..self.scene.scene };
                (self.save)(&scene).map_err(WindowError::Save)?;
                return Ok(Some(false));
            }
            Request::Quit => return Ok(None),
        }
        Ok(Some(true))
    }

    /// Draws a picture until the camera is moved, and calls `refine` whenever the picture is complete.
    /// Returns false if the window is to be closed.
    fn show<'r, 'm, C: DisplayColor + Into<Rgb888> + From<Rgb888>, Q: Quality<R, Color = C>>(
        &mut self,
        frame: &mut Frame<'r, 'm, R, Shape<'m>, Q>,
        refine: impl Fn(&mut Frame<'r, 'm, R, Shape<'m>, Q>) -> Result<(), LineError>,
        display: &mut SimulatorDisplay<C>,
        window: &mut Window,
    ) -> Result<bool, WindowError> {
        loop {
            if draw_for_a_while(frame, display)? {
                refine(frame).map_err(|error| WindowError::Draw(error.into()))?;
            }
            window.update(display);
            // Carry out all waiting requests before the next picture, so that a held key does not lag.
            let requests: Vec<Request> = window.events().filter_map(request).collect();
            let mut moved = false;
            for request in requests {
                match self.obey(request)? {
                    Some(change) => moved |= change,
                    None => return Ok(false),
                }
            }
            if moved {
                return Ok(true);
            }
        }
    }
}

impl<R: Real> ForColor for View<'_, '_, R> {
    type Output = Result<(), WindowError>;

    fn with<C>(mut self) -> Self::Output
    where
        C: DisplayColor + Into<Rgb888> + From<Rgb888> + From<BinaryColor> + Send,
    {
        let settings = self.options.settings;
        let mut memory = memory_for::<R>(&self.scene.scene);
        let mut scene = self.scene.scene;
        let mut display = SimulatorDisplay::<C>::new(Size::new(settings.width, settings.height));
        let mut window =
            Window::new(&format!("rayline: {}", self.scene.name), &enlarged(display_side(&settings)));
        let mut buffer = vec![C::from(BinaryColor::Off); settings.width as usize];
        let pixels = if settings.sampling.samples > 1 { settings.width * settings.height } else { 0 };
        let mut sums = vec![PixelSum::<R>::EMPTY; pixels as usize];
        'scene: loop {
            let mut prepared = PreparedScene::<R, _>::new(&scene, &mut memory).map_err(WindowError::Scene)?;
            loop {
                // If the moved camera is refused, return to this one.
                let seen = self.orbit;
                let renderer = Renderer::new(&prepared, settings).map_err(WindowError::Settings)?;
                let lines = 0..settings.height;
                let failed = |error: LineError| WindowError::Draw(error.into());
                let is_open = if settings.sampling.samples > 1 {
                    sums.fill(PixelSum::EMPTY);
                    let quality = Progressive::lend(&mut buffer, &mut sums);
                    let mut frame = renderer.frame(lines.clone(), quality).map_err(failed)?;
                    // While the camera rests, each pass adds a sample to every pixel.
                    let refine = |frame: &mut Frame<'_, '_, _, _, Progressive<'_, C, R>>| {
                        if frame.is_refined() { Ok(()) } else { frame.set_lines(lines.clone()) }
                    };
                    self.show(&mut frame, refine, &mut display, &mut window)?
                } else {
                    let mut frame = renderer.frame(lines, &mut buffer[..]).map_err(failed)?;
                    self.show(&mut frame, |_| Ok(()), &mut display, &mut window)?
                };
                if !is_open {
                    return Ok(());
                }
                let camera = self.orbit.camera();
                if prepared.set_camera(&camera).is_ok() {
                    continue;
                }
                // In fixed point the scene may need another scale for this camera.
                let moved = Scene { camera, ..scene };
                if PreparedScene::<R, _>::new(&moved, &mut memory_for::<R>(&moved)).is_ok() {
                    scene = moved;
                    continue 'scene;
                }
                self.orbit = seen;
            }
        }
    }
}

/// Draws until the window has to be updated or the picture is complete. Returns whether it is complete.
fn draw_for_a_while<R: Real, C: DisplayColor, Q: Quality<R, Color = C>>(
    frame: &mut Frame<'_, '_, R, Shape<'_>, Q>,
    display: &mut SimulatorDisplay<C>,
) -> Result<bool, WindowError> {
    let start = Instant::now();
    while start.elapsed() < PATIENCE {
        if frame.step(display, BUDGET_RAYS).map_err(WindowError::Draw)?.is_done() {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The request of an event, if it is one.
fn request(event: SimulatorEvent) -> Option<Request> {
    let keycode = match event {
        SimulatorEvent::Quit => return Some(Request::Quit),
        SimulatorEvent::KeyDown { keycode, .. } => keycode,
        _ => return None,
    };
    match keycode {
        Keycode::Left => Some(Request::Turn { right: -TURN, up: 0.0 }),
        Keycode::Right => Some(Request::Turn { right: TURN, up: 0.0 }),
        Keycode::Up => Some(Request::Turn { right: 0.0, up: TURN }),
        Keycode::Down => Some(Request::Turn { right: 0.0, up: -TURN }),
        Keycode::Plus | Keycode::Equals | Keycode::KpPlus => Some(Request::Dolly(1.0 / DOLLY)),
        Keycode::Minus | Keycode::KpMinus => Some(Request::Dolly(DOLLY)),
        Keycode::S => Some(Request::Save),
        Keycode::Q => Some(Request::Quit),
        _ => None,
    }
}

/// The distance to the object in the middle of the picture, if there is one.
fn distance_ahead<R: Real>(prepared: &PreparedScene<'_, R>, camera: &Camera) -> Option<f32> {
    let unit = prepared.scale();
    let direction = (camera.target - camera.eye).normalized()?.to();
    let ray = Ray { origin: (camera.eye * unit).to(), direction };
    prepared.closest_hit(&ray, Interval::AHEAD).map(|hit| hit.t.to_f32() / unit)
}

fn display_side(settings: &rayline::Settings) -> u32 {
    settings.width.max(settings.height)
}

/// Enlarges small pictures, so that their pixels can be seen.
fn enlarged(side: u32) -> OutputSettings {
    let scale = COMFORTABLE.checked_div(side).unwrap_or(1).max(1);
    OutputSettingsBuilder::new().scale(scale).build()
}

impl fmt::Display for WindowError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoDisplay(reason) => write!(f, "cannot open a window: {reason}"),
            Self::TooLarge { most } => write!(f, "a window has at most {most}x{most} pixels; use --size"),
            Self::Scene(error) => error.fmt(f),
            Self::Settings(error) => error.fmt(f),
            Self::Draw(error) => error.fmt(f),
            Self::Save(error) => error.fmt(f),
        }
    }
}

impl Error for WindowError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::NoDisplay(_) | Self::TooLarge { .. } => None,
            Self::Scene(error) => Some(error),
            Self::Settings(error) => Some(error),
            Self::Draw(error) => Some(error),
            Self::Save(error) => Some(&**error),
        }
    }
}
