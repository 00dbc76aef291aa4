//! A scene in a window, drawn line by line through embedded-graphics' simulator as a board would draw it.

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
use rayline::{
    Camera, DisplayColor, DrawError, Frame, PreparedScene, Real, Renderer, Scene, SceneError, SettingsError,
};

use crate::display::ForColor;
use crate::picture::memory_for;
use crate::{LoadedScene, Number, Orbit, RenderOptions};

/// Why there is no window, or no longer one.
#[derive(Debug)]
#[non_exhaustive]
pub enum WindowError {
    /// The system has no display to open a window on. Start it from a desktop session.
    NoDisplay(String),
    /// The picture is too large for a window. Choose a smaller size.
    TooLarge {
        /// The longest side that fits.
        most: u32,
    },
    /// The scene was refused. Mend the part that it names.
    Scene(SceneError),
    /// A setting is out of range. Change it.
    Settings(SettingsError),
    /// A line could not be drawn.
    Draw(DrawError<Infallible>),
    /// The picture could not be saved.
    Save(Box<dyn Error>),
}

/// Saves a picture of a scene as it is seen in the window.
pub type Save<'s> = dyn FnMut(&Scene<'_>) -> Result<(), Box<dyn Error>> + 's;

/// The longest side of a window: textures of this size work on any graphics card.
const MAX_WINDOW: u32 = 4096;

/// Small displays are enlarged to about this.
const COMFORTABLE: u32 = 640;

/// One press of an arrow key, in radians: 5°.
const TURN: f64 = 0.087;

/// One press of plus or minus.
const DOLLY: f64 = 1.1;

/// How long is drawn before the window is looked after.
const PATIENCE: Duration = Duration::from_millis(15);

/// Rays between two looks at the clock.
const BUDGET_RAYS: u32 = 1000;

/// Shows a scene in a window until it is closed or Q is pressed. Arrow keys go around the point in the middle of
/// the picture, plus and minus come closer and go away, S calls `save`.
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

/// Looks for a display that people can see: without one, the simulator's window would panic, or be shown to nobody
/// forever.
fn check_display() -> Result<(), WindowError> {
    let video = sdl2::init().and_then(|context| context.video()).map_err(WindowError::NoDisplay)?;
    match video.current_video_driver() {
        "dummy" | "offscreen" | "evdev" => Err(WindowError::NoDisplay("there is no display".to_owned())),
        _ => Ok(()),
    }
}

/// A scene that is looked at.
struct View<'s, 'k, R> {
    scene: &'s LoadedScene<'s>,
    options: &'s RenderOptions,
    save: &'s mut Save<'k>,
    orbit: Orbit,
    number: core::marker::PhantomData<R>,
}

/// What a person asked for.
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
        // A camera that was prepared has a line of sight.
        let orbit = Orbit::new(camera, distance).ok_or(WindowError::Scene(SceneError {
            part: rayline::Part::Camera,
            fault: rayline::Fault::EyeAtTarget,
        }))?;
        Ok(Self { scene, options, save, orbit, number: core::marker::PhantomData })
    }

    /// Does what a person asked for, and tells whether the picture must be drawn anew; `None`: the end.
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

    /// Draws a picture until the camera is moved; tells whether to go on.
    fn show<C: DisplayColor + Into<Rgb888> + From<Rgb888>>(
        &mut self,
        frame: &mut Frame<'_, '_, R, rayline::shape::Shape<'_>, &mut [C]>,
        display: &mut SimulatorDisplay<C>,
        window: &mut Window,
    ) -> Result<bool, WindowError> {
        loop {
            draw_for_a_while(frame, display)?;
            window.update(display);
            // All that has happened, before the next picture: a held key must not fall behind.
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
        'scene: loop {
            let mut prepared = PreparedScene::<R, _>::new(&scene, &mut memory).map_err(WindowError::Scene)?;
            loop {
                // The camera stays where it is when it would be refused.
                let seen = self.orbit;
                let renderer = Renderer::new(&prepared, settings).map_err(WindowError::Settings)?;
                let mut frame = renderer
                    .frame(0..settings.height, &mut buffer[..])
                    .map_err(|error| WindowError::Draw(error.into()))?;
                if !self.show(&mut frame, &mut display, &mut window)? {
                    return Ok(());
                }
                let camera = self.orbit.camera();
                if prepared.set_camera(&camera).is_ok() {
                    continue;
                }
                // Another scale may be right for it, in fixed point.
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

/// Draws until the window needs to be looked after, or the picture is complete.
fn draw_for_a_while<R: Real, C: DisplayColor>(
    frame: &mut Frame<'_, '_, R, rayline::shape::Shape<'_>, &mut [C]>,
    display: &mut SimulatorDisplay<C>,
) -> Result<(), WindowError> {
    let start = Instant::now();
    while start.elapsed() < PATIENCE {
        if frame.step(display, BUDGET_RAYS).map_err(WindowError::Draw)?.is_done() {
            break;
        }
    }
    Ok(())
}

/// What a key means.
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

/// How far away the object is that the camera looks at.
fn distance_ahead<R: Real>(prepared: &PreparedScene<'_, R>, camera: &Camera) -> Option<f32> {
    let unit = prepared.scale();
    let direction = (camera.target - camera.eye).normalized()?.to();
    let ray = Ray { origin: (camera.eye * unit).to(), direction };
    prepared.closest_hit(&ray, Interval::AHEAD).map(|hit| hit.t.to_f32() / unit)
}

fn display_side(settings: &rayline::Settings) -> u32 {
    settings.width.max(settings.height)
}

/// Shows small displays large enough to see their pixels.
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
