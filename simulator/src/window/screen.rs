//! The window of the system, by winit and softbuffer. It shows the simulator's pictures.

use core::num::NonZeroU32;
use std::rc::Rc;
use std::time::Duration;

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::mono_font::MonoTextStyleBuilder;
use embedded_graphics::mono_font::ascii::FONT_7X13;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::text::{Baseline, Text};
use embedded_graphics_simulator::OutputImage;
use softbuffer::{Context, Surface};
use winit::application::ApplicationHandler;
use winit::dpi::{PhysicalPosition, PhysicalSize};
use winit::event::{ElementState, MouseButton, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::platform::pump_events::EventLoopExtPumpEvents;
use winit::window::{Window, WindowId};

use super::WindowError;
use super::request::Request;

/// An open window.
pub(super) struct Screen {
    events: EventLoop<()>,
    state: State,
}

/// The parts of the window that its events change.
struct State {
    title: String,
    window: Option<Rc<Window>>,
    surface: Option<Surface<Rc<Window>, Rc<Window>>>,
    /// The reason why the window could not open, or cannot show a picture.
    failure: Option<String>,
    /// The last picture, and its size.
    picture: Option<(OutputImage<Rgb888>, Size)>,
    requests: Vec<Request>,
    pointer: Option<PhysicalPosition<f64>>,
    is_dragging: bool,
}

impl Screen {
    pub(super) fn open(title: &str) -> Result<Self, WindowError> {
        let mut events = EventLoop::new().map_err(|error| WindowError::NoDisplay(error.to_string()))?;
        events.set_control_flow(ControlFlow::Wait);
        let mut state = State {
            title: title.to_owned(),
            window: None,
            surface: None,
            failure: None,
            picture: None,
            requests: Vec::new(),
            pointer: None,
            is_dragging: false,
        };
        while state.surface.is_none() {
            events.pump_app_events(Some(Duration::from_millis(10)), &mut state);
            if let Some(reason) = state.failure.take() {
                return Err(WindowError::NoDisplay(reason));
            }
        }
        Ok(Self { events, state })
    }

    /// Gives the window the size of its pictures.
    pub(super) fn resize(&mut self, Size { width, height }: Size) {
        if let Some(window) = &self.state.window {
            // If the system takes its time or gives another size, pictures stand in the middle.
            let size = PhysicalSize::new(width, height);
            window.set_min_inner_size(Some(size));
            window.set_max_inner_size(Some(size));
            let _ = window.request_inner_size(size);
        }
    }

    pub(super) fn set_title(&self, title: &str) {
        if let Some(window) = &self.state.window {
            window.set_title(title);
        }
    }

    /// Shows a picture of the simulator.
    pub(super) fn show(&mut self, picture: OutputImage<Rgb888>, size: Size) -> Result<(), WindowError> {
        self.state.picture = Some((picture, size));
        self.state.present();
        self.state.result()
    }

    /// Writes a message over the last picture.
    pub(super) fn write(&mut self, message: &str) -> Result<(), WindowError> {
        if let Some((picture, size)) = &mut self.state.picture {
            write_over(picture, *size, message);
        }
        self.state.present();
        self.state.result()
    }

    /// The requests that came meanwhile, or within this time.
    pub(super) fn requests(&mut self, patience: Duration) -> Result<Vec<Request>, WindowError> {
        self.events.pump_app_events(Some(patience), &mut self.state);
        self.state.result()?;
        Ok(core::mem::take(&mut self.state.requests))
    }
}

impl State {
    fn open(&mut self, events: &ActiveEventLoop) -> Result<(), Box<dyn std::error::Error>> {
        let attributes = Window::default_attributes().with_title(&self.title);
        let window = Rc::new(events.create_window(attributes)?);
        let context = Context::new(window.clone())?;
        self.surface = Some(Surface::new(&context, window.clone())?);
        self.window = Some(window);
        Ok(())
    }

    fn result(&mut self) -> Result<(), WindowError> {
        self.failure.take().map_or(Ok(()), |reason| Err(WindowError::Show(reason)))
    }

    /// Copies the last picture to the window.
    fn present(&mut self) {
        if let Err(error) = self.try_to_present() {
            self.failure = Some(error.to_string());
        }
    }

    fn try_to_present(&mut self) -> Result<(), softbuffer::SoftBufferError> {
        let (Some(window), Some(surface), Some((picture, size))) =
            (&self.window, &mut self.surface, &self.picture)
        else {
            return Ok(());
        };
        let PhysicalSize { width, height } = window.inner_size();
        // A window that is minimized has no size.
        let (Some(across), Some(down)) = (NonZeroU32::new(width), NonZeroU32::new(height)) else {
            return Ok(());
        };
        surface.resize(across, down)?;
        let mut buffer = surface.buffer_mut()?;
        buffer.fill(0);
        let picture = picture.as_image_buffer();
        let [left, top] =
            [(width, size.width), (height, size.height)].map(|(room, side)| room.saturating_sub(side) / 2);
        let lines = picture.as_raw().chunks(size.width as usize * 3);
        for (line, shown) in lines.zip(buffer.chunks_mut(width as usize).skip(top as usize)) {
            for (&[r, g, b], pixel) in line.as_chunks().0.iter().zip(shown.iter_mut().skip(left as usize)) {
                *pixel = u32::from_be_bytes([0, r, g, b]);
            }
        }
        window.pre_present_notify();
        buffer.present()
    }
}

impl ApplicationHandler for State {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.window.is_none() {
            self.failure = self.open(events).err().map(|error| error.to_string());
        }
    }

    fn window_event(&mut self, _events: &ActiveEventLoop, _window: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested => self.requests.push(Request::Close),
            WindowEvent::RedrawRequested | WindowEvent::Resized(_) => self.present(),
            WindowEvent::KeyboardInput { event, .. } => self.requests.extend(Request::of_key(&event)),
            WindowEvent::MouseWheel { delta, .. } => self.requests.push(Request::of_wheel(delta)),
            WindowEvent::MouseInput { state, button: MouseButton::Left, .. } => {
                self.is_dragging = state == ElementState::Pressed;
            }
            WindowEvent::CursorMoved { position, .. } => {
                if let Some(before) = self.pointer.replace(position)
                    && self.is_dragging
                {
                    self.requests.push(Request::of_drag(position.x - before.x, position.y - before.y));
                }
            }
            _ => {}
        }
    }
}

/// Writes a message into the upper part of a picture, in lines that fit into its width.
fn write_over(picture: &mut OutputImage<Rgb888>, size: Size, message: &str) {
    let columns = (size.width / FONT_7X13.character_size.width).max(1) as usize;
    let characters: Vec<char> = message.chars().collect();
    let lines: Vec<String> = characters.chunks(columns).map(|line| line.iter().collect()).collect();
    let style = MonoTextStyleBuilder::new()
        .font(&FONT_7X13)
        .text_color(Rgb888::WHITE)
        .background_color(Rgb888::new(160, 0, 0))
        .build();
    let text = lines.join("\n");
    let text = Text::with_baseline(&text, Point::zero(), style, Baseline::Top);
    // An image in memory takes all pixels.
    let _ = embedded_graphics::Drawable::draw(&text, picture);
}
