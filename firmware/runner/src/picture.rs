//! What is rendered: scene, size, bounces, number system and mode.

use std::fmt;
use std::fs;
use std::path::Path;
use std::str::FromStr;

use anyhow::{Context, Error, Result, ensure};
use rayline::builtin::{self, Builtin};
use rayline::{Scene, Settings};

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

/// A scene that programs can be built for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source {
    pub(crate) name: &'static str,
    /// What build scripts are told: the name of a built-in scene, or the path of a file.
    pub(crate) source: &'static str,
    pub(crate) scene: &'static Scene<'static>,
    /// How often it is meant to be mirrored.
    pub(crate) bounces: u8,
}

impl Source {
    /// Finds a built-in scene, or reads a `.rayline` file.
    fn open(source: &str) -> Result<Self> {
        if source.ends_with(".rayline") {
            return Self::read(Path::new(source));
        }
        let path = Path::new(source);
        ensure!(
            path.extension().is_none(),
            "boards take the bytes of scenes: write them with `rayline convert {source} {bytes}`, and name {bytes}",
            bytes = path.with_extension("rayline").display()
        );
        let Builtin { name, scene, bounces, .. } =
            *builtin::all().find(|builtin| builtin.name == source).with_context(|| {
                let names: Vec<&str> = builtin::ALL.iter().map(|builtin| builtin.name).collect();
                format!(
                    "no built-in scene is called {source:?}: there are {}; files end in .rayline",
                    names.join(", ")
                )
            })?;
        Ok(Self { name, source: name, scene, bounces })
    }

    fn read(path: &Path) -> Result<Self> {
        let shown = path.display().to_string();
        // Scenes stay until the end of this program.
        let bytes = &*fs::read(path).with_context(|| shown.clone())?.leak();
        let scene = Scene::from_bytes(bytes, rayline_choice::memory_for(bytes).leak())
            .with_context(|| shown.clone())?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        // Build scripts run in another folder.
        let source = fs::canonicalize(path)?.into_os_string().into_string();
        let source = source.ok().with_context(|| format!("{shown}: its path is not UTF-8"))?;
        let bounces = rayline_choice::USUAL_BOUNCES;
        Ok(Self { name: name.leak(), source: source.leak(), scene: Box::leak(Box::new(scene)), bounces })
    }
}

/// What the user wants to see, on any board.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request {
    pub(crate) scene: Source,
    /// By default what the board can render in a second or so.
    pub(crate) size: Option<Size>,
    /// By default as often as the scene is meant to be seen.
    pub(crate) bounces: Option<u8>,
    pub(crate) number: Number,
    pub(crate) mode: Mode,
    /// Without what only makes it faster.
    pub(crate) small: bool,
}

impl Request {
    /// A scene, exact and in f32.
    pub(crate) fn new(scene: &str) -> Result<Self> {
        Ok(Self {
            scene: Source::open(scene)?,
            size: None,
            bounces: None,
            number: Number::F32,
            mode: Mode::Exact,
            small: false,
        })
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
            small: self.small,
        }
    }
}

/// A picture: what the program for a board is built to render.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Picture {
    pub(crate) scene: Source,
    pub(crate) size: Size,
    pub(crate) bounces: u8,
    pub(crate) number: Number,
    pub(crate) mode: Mode,
    /// Whether the program goes without what only makes it faster.
    pub(crate) small: bool,
}

impl fmt::Display for Picture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {} {}", self.scene.name, self.size, self.number.name(), self.mode.name())?;
        f.write_str(if self.small { " small" } else { "" })
    }
}

impl Picture {
    /// The settings that the program uses as well.
    pub(crate) fn settings(&self) -> Settings {
        let Size { width, height } = self.size;
        Settings { bounces: self.bounces, ..Settings::new(width.into(), height.into()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_that_are_no_bytes_are_answered_with_how_to_make_them() {
        let error = |source: &str| Source::open(source).unwrap_err().to_string();
        assert_eq!(
            error("a/ball.ron"),
            "boards take the bytes of scenes: write them with `rayline convert a/ball.ron a/ball.rayline`, and name a/ball.rayline"
        );
        assert!(error("clasic").starts_with("no built-in scene is called \"clasic\": there are classic"));
        assert!(Source::open("classic").is_ok());
    }
}
