//! Keys and the mouse, as requests of the user.

use winit::event::{ElementState, KeyEvent, MouseScrollDelta};
use winit::keyboard::{Key, NamedKey};

/// A request from the keyboard or the mouse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Request {
    /// Orbit by these angles in radians.
    Turn {
        right: f64,
        up: f64,
    },
    /// Multiply the distance by this factor.
    Dolly(f64),
    /// Return to the scene's own camera.
    Home,
    NextNumber,
    NextMode,
    NextColor,
    Save,
    Close,
}

/// The angle of one press of an arrow key, in radians: 5°.
const TURN: f64 = 0.087;

/// The angle for a drag across a pixel of the window, in radians: 640 pixels are half a turn.
const DRAG: f64 = core::f64::consts::PI / 640.0;

/// The factor of the distance for one press of plus or minus, or one step of the wheel.
const DOLLY: f64 = 1.1;

/// The pixels that a touchpad scrolls for one step of a wheel.
const PIXELS_PER_STEP: f64 = 40.0;

impl Request {
    /// The request of a key that was pressed.
    pub(super) fn of_key(event: &KeyEvent) -> Option<Self> {
        if event.state != ElementState::Pressed {
            return None;
        }
        let turn = |right, up| Self::Turn { right: right * TURN, up: up * TURN };
        Some(match &event.logical_key {
            Key::Named(NamedKey::ArrowLeft) => turn(-1.0, 0.0),
            Key::Named(NamedKey::ArrowRight) => turn(1.0, 0.0),
            Key::Named(NamedKey::ArrowUp) => turn(0.0, 1.0),
            Key::Named(NamedKey::ArrowDown) => turn(0.0, -1.0),
            Key::Named(NamedKey::Home) => Self::Home,
            Key::Character(text) => match text.to_lowercase().as_str() {
                "+" | "=" => Self::Dolly(1.0 / DOLLY),
                "-" => Self::Dolly(DOLLY),
                "n" => Self::NextNumber,
                "m" => Self::NextMode,
                "c" => Self::NextColor,
                "s" => Self::Save,
                "q" => Self::Close,
                _ => return None,
            },
            _ => return None,
        })
    }

    /// The request of the mouse that drags by so many pixels to the right and down: the scene follows it.
    pub(super) fn of_drag(right: f64, down: f64) -> Self {
        Self::Turn { right: -right * DRAG, up: down * DRAG }
    }

    /// The request of the wheel: forward comes closer.
    pub(super) fn of_wheel(delta: MouseScrollDelta) -> Self {
        let steps = match delta {
            MouseScrollDelta::LineDelta(_, lines) => f64::from(lines),
            MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_PER_STEP,
        };
        Self::Dolly(DOLLY.powf(-steps))
    }
}
