//! What is rendered: scene, size, bounces, number system and mode.

use std::fmt;
use std::str::FromStr;

use anyhow::{Context, Error, Result};
use rayline::Settings;
use rayline::builtin::{self, Builtin};

use crate::board::{Board, Emulator};

/// Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) width: u16,
    pub(crate) height: u16,
}

impl Size {
    pub(crate) fn pixels(self) -> usize {
        usize::from(self.width) * usize::from(self.height)
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

impl FromStr for Size {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let (width, height) = text.split_once('x').context("not such as 320x240")?;
        let side = |text: &str| match text.parse() {
            Ok(0) | Err(_) => Err(Error::msg("a side is a number from 1 to 65535")),
            Ok(side) => Ok(side),
        };
        Ok(Self { width: side(width)?, height: side(height)? })
    }
}

/// The number system that a program computes in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Number {
    /// 32-bit floating point, in software where there is no FPU.
    F32,
    /// Fixed point with 32 bits.
    Fixed,
}

impl Number {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::Fixed => "fixed",
        }
    }
}

/// How the picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Mode {
    /// Every pixel is traced.
    Exact,
    /// Pixels are traced where neighbors differ, and interpolated elsewhere.
    Realtime,
}

impl Mode {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Realtime => "realtime",
        }
    }
}

/// All scenes that programs can be built for.
pub(crate) fn scenes() -> impl Iterator<Item = &'static Builtin> {
    builtin::ALL.iter().chain(&builtin::GROWTH)
}

/// What the user wants to see, on any board.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request {
    pub(crate) scene: &'static Builtin,
    /// By default what the board can render in a second or so.
    pub(crate) size: Option<Size>,
    /// By default as often as the scene is meant to be seen.
    pub(crate) bounces: Option<u8>,
    pub(crate) number: Number,
    pub(crate) mode: Mode,
}

impl Request {
    /// A built-in scene, exact and in f32.
    pub(crate) fn new(scene: &str) -> Result<Self> {
        let scene = scenes().find(|builtin| builtin.name == scene).context("no such built-in scene")?;
        Ok(Self { scene, size: None, bounces: None, number: Number::F32, mode: Mode::Exact })
    }

    /// The picture that this board renders.
    pub(crate) fn on(&self, board: &Board) -> Picture {
        Picture {
            scene: self.scene,
            size: self.size.unwrap_or(board.size),
            bounces: self.bounces.unwrap_or(self.scene.bounces),
            number: match board.emulator {
                Emulator::Qemu { .. } => self.number,
                Emulator::Rp2040js { .. } => Number::Fixed,
            },
            mode: self.mode,
        }
    }
}

/// A picture: what the program for a board is built to render.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Picture {
    pub(crate) scene: &'static Builtin,
    pub(crate) size: Size,
    pub(crate) bounces: u8,
    pub(crate) number: Number,
    pub(crate) mode: Mode,
}

impl fmt::Display for Picture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {} {}", self.scene.name, self.size, self.number.name(), self.mode.name())
    }
}

impl Picture {
    /// The settings that the program uses as well.
    pub(crate) fn settings(&self) -> Settings {
        let Size { width, height } = self.size;
        Settings { bounces: self.bounces, ..Settings::new(width.into(), height.into()) }
    }
}
