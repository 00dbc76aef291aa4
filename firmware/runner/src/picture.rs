//! The picture that a program renders: scene, size, bounces, number system and mode.

use std::fmt;
use std::fs;
use std::path::Path;
use std::str::FromStr;

use anyhow::{Context, Error, Result, ensure};
use rayline::builtin::{self, Builtin};
use rayline::{AreaLights, Realtime, Scene, Settings};

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
        let (width, height) = text.split_once('x').context("write width and height, such as 320x240")?;
        let side = |text: &str| match text.parse() {
            Ok(0) | Err(_) => Err(Error::msg("width and height are numbers from 1 to 65535")),
            Ok(side) => Ok(side),
        };
        Ok(Self { width: side(width)?, height: side(height)? })
    }
}

/// The number system of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Number {
    /// 32-bit floating point, in software on a processor without an FPU
    F32,
    /// 32-bit fixed point
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

/// The way in which the picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Mode {
    /// Traces every pixel
    Exact,
    /// Traces pixels whose neighbors differ, and interpolates the others
    Realtime,
    /// As `realtime`, with smooth edges
    Smooth,
    /// Scan conversion in place of rays
    Preview,
}

impl Mode {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Realtime => "realtime",
            Self::Smooth => "smooth",
            Self::Preview => "preview",
        }
    }
}

/// A scene that programs can be built for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SceneSource {
    pub(crate) name: &'static str,
    /// The value of `RAYLINE_SCENE` for build scripts: the name of a built-in scene, or the path of a file.
    pub(crate) source: &'static str,
    pub(crate) scene: &'static Scene<'static>,
    /// Bounces that the scene is designed for.
    pub(crate) bounces: u8,
}

impl SceneSource {
    /// Finds a built-in scene, or reads a `.rayline` file.
    pub(crate) fn open(source: &str) -> Result<Self> {
        if source.ends_with(".rayline") {
            return Self::read(Path::new(source));
        }
        let path = Path::new(source);
        ensure!(
            path.extension().is_none(),
            "boards read .rayline files: run `rayline convert {source} {bytes}`, then use --scene {bytes}",
            bytes = path.with_extension("rayline").display()
        );
        let Builtin { name, scene, bounces, .. } =
            *builtin::all().find(|builtin| builtin.name == source).with_context(|| {
                let names: Vec<&str> = builtin::ALL.iter().map(|builtin| builtin.name).collect();
                format!(
                    "there is no built-in scene {source:?}: name one of {}, or a .rayline file",
                    names.join(", ")
                )
            })?;
        Ok(Self { name, source: name, scene, bounces })
    }

    fn read(path: &Path) -> Result<Self> {
        let shown = path.display().to_string();
        // The scene is used until the end of this program.
        let bytes = &*fs::read(path).with_context(|| shown.clone())?.leak();
        let scene = Scene::from_bytes(bytes, rayline_build_support::memory_for(bytes).leak())
            .with_context(|| shown.clone())?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        // Build scripts run in another folder: they need the whole path.
        let source = fs::canonicalize(path)?.into_os_string().into_string();
        let source = source.ok().with_context(|| format!("{shown}: its path is not UTF-8, rename it"))?;
        let bounces = rayline_build_support::BOUNCES_OF_FILES;
        Ok(Self { name: name.leak(), source: source.leak(), scene: Box::leak(Box::new(scene)), bounces })
    }
}

/// A picture of one board.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Picture {
    pub(crate) scene: SceneSource,
    pub(crate) size: Size,
    pub(crate) bounces: u8,
    pub(crate) number: Number,
    pub(crate) mode: Mode,
    /// Whether the program leaves out the features that only make exact pictures faster.
    pub(crate) small: bool,
    /// Whether lamps with a size light by formulas.
    pub(crate) closed_form: bool,
}

impl fmt::Display for Picture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {} {}", self.scene.name, self.size, self.number.name(), self.mode.name())?;
        f.write_str(if self.small { " small" } else { "" })
    }
}

impl Picture {
    /// The realtime quality that it is drawn in; `None` for other pictures.
    pub(crate) fn quality(&self) -> Option<Realtime> {
        match self.mode {
            Mode::Exact | Mode::Preview => None,
            Mode::Realtime => Some(Realtime::new()),
            Mode::Smooth => Some(Realtime::new().smooth()),
        }
    }

    /// The settings of the renderer, which are the program's.
    pub(crate) fn settings(&self) -> Settings {
        let Size { width, height } = self.size;
        let area_lights = if self.closed_form { AreaLights::ClosedForm } else { AreaLights::Sampled };
        Settings { bounces: self.bounces, area_lights, ..Settings::new(width.into(), height.into()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_say_how_to_name_a_scene() {
        let error = |source: &str| SceneSource::open(source).unwrap_err().to_string();
        assert_eq!(
            error("a/ball.ron"),
            "boards read .rayline files: run `rayline convert a/ball.ron a/ball.rayline`, then use --scene \
             a/ball.rayline"
        );
        assert!(error("clasic").starts_with("there is no built-in scene \"clasic\": name one of classic, "));
        assert!(SceneSource::open("classic").is_ok());
    }
}
