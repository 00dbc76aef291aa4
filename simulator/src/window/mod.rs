//! The window: a scene that is drawn line by line, as on a board, into embedded-graphics' simulator.
//!
//! - `screen` opens the window, shows the simulator's pictures in it, and collects the user's input;
//! - `request` translates keys and the mouse;
//! - `view` draws the scene, and moves its camera.
//!
//! The scene's file is read again whenever it changes.

mod request;
mod screen;
mod view;

use core::convert::Infallible;
use core::fmt;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use bumpalo::Bump;
use embedded_graphics_simulator::OutputSettings;
use rayline::{DrawError, PreviewError, Scene, SceneError, SettingsError};

use crate::{LoadError, LoadedScene, OpenOptions, RenderOptions};
use screen::Screen;
use view::{Next, View};

/// The reason why the window cannot open, or closed.
#[derive(Debug)]
#[non_exhaustive]
pub enum WindowError {
    /// The system has no display to open a window on. Start it from a desktop session.
    NoDisplay(String),
    /// The window cannot show a picture. The system's text says why.
    Show(String),
    /// The picture is too large for a window. Choose a smaller size.
    TooLarge {
        /// The largest width and height, in pixels.
        most: u32,
    },
    /// The scene cannot be read.
    Load(LoadError),
    /// The scene was refused. Correct the part that the message names.
    Scene(String),
    /// A setting is out of range. Change it.
    Settings(SettingsError),
    /// A line could not be drawn.
    Draw(DrawError<Infallible>),
    /// The scene has no preview.
    Preview(PreviewError),
    /// The picture could not be saved.
    Save(Box<dyn Error>),
}

/// A function that saves a picture of the scene as the window shows it.
pub type Save<'s> = dyn FnMut(&Scene<'_>, &RenderOptions) -> Result<(), Box<dyn Error>> + 's;

/// The scene that a window shows, and how.
pub struct WindowScene<'w> {
    /// The name of a built-in scene, or the file, which is watched.
    pub source: &'w Path,
    /// How the file is opened.
    pub open: OpenOptions,
    /// The options for a scene that was read: called for each version of the file. Keys change some of them.
    pub options: &'w dyn Fn(&LoadedScene<'_>) -> RenderOptions,
    /// The look of the panel; `None`: small pictures are enlarged.
    pub panel: Option<OutputSettings>,
    /// Saves pictures.
    pub save: &'w mut Save<'w>,
}

/// Shows a scene in a window until it is closed or Q is pressed.
///
/// Arrow keys or the mouse orbit the point in the middle of the picture; plus, minus or the wheel change the
/// distance to it; Home brings the scene's own camera back. N, M and C switch the number system, the mode and
/// the color of the display. S saves. The title shows the time and the rays of the last picture. If a new
/// version of the file is broken, the last picture stays, with the error over it.
///
/// # Errors
/// There is no display, the first version of the scene is refused, or `save` failed.
pub fn show_window(window: WindowScene<'_>) -> Result<(), WindowError> {
    let WindowScene { source, open, options, panel, save } = window;
    let mut file = Watched::new(source);
    let arena = Bump::new();
    let scene = LoadedScene::open_with(source, &open, &arena).map_err(WindowError::Load)?;
    let screen = Screen::open(&format!("rayline: {}", scene.name))?;
    let mut view = View::new(screen, options(&scene), panel, save);
    let mut next = view.show(&scene, &mut file)?;
    while next != Next::Close {
        let arena = Bump::new();
        let shown =
            LoadedScene::open_with(source, &open, &arena).map_err(WindowError::Load).and_then(|scene| {
                view.set_settings(options(&scene).settings);
                view.show(&scene, &mut file)
            });
        next = match shown {
            Err(error) if error.is_of_the_scene() => view.tell(&error, &mut file)?,
            shown => shown?,
        };
    }
    Ok(())
}

impl WindowError {
    /// Whether another version of the scene's file may be without this error.
    fn is_of_the_scene(&self) -> bool {
        matches!(self, Self::Load(_) | Self::Scene(_) | Self::Settings(_) | Self::TooLarge { .. })
    }

    /// The error of a scene, with its position in the file.
    fn of_scene(scene: &LoadedScene<'_>, error: &SceneError) -> Self {
        Self::Scene(scene.explain(error))
    }
}

/// A file that may change.
struct Watched {
    path: PathBuf,
    seen: Option<(SystemTime, u64)>,
}

impl Watched {
    fn new(path: &Path) -> Self {
        let mut file = Self { path: path.to_owned(), seen: None };
        file.has_changed();
        file
    }

    /// Whether the file was changed since the last time. A file that is not there has not changed: many
    /// editors remove it for a moment.
    fn has_changed(&mut self) -> bool {
        let now = self.path.metadata().and_then(|data| Ok((data.modified()?, data.len()))).ok();
        let changed = now.is_some() && now != self.seen;
        self.seen = now.or(self.seen);
        changed
    }
}

impl fmt::Display for WindowError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoDisplay(reason) => {
                write!(f, "cannot open a window: {reason}; start it from a desktop session")
            }
            Self::Show(reason) => write!(f, "the window cannot show a picture: {reason}"),
            Self::TooLarge { most } => write!(f, "a window has at most {most}x{most} pixels; use --size"),
            Self::Load(error) => error.fmt(f),
            Self::Scene(message) => f.write_str(message),
            Self::Settings(error) => error.fmt(f),
            Self::Draw(error) => error.fmt(f),
            Self::Preview(error) => error.fmt(f),
            Self::Save(error) => error.fmt(f),
        }
    }
}

impl Error for WindowError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::NoDisplay(_) | Self::Show(_) | Self::TooLarge { .. } | Self::Scene(_) => None,
            Self::Load(error) => Some(error),
            Self::Settings(error) => Some(error),
            Self::Draw(error) => Some(error),
            Self::Preview(error) => Some(error),
            Self::Save(error) => Some(&**error),
        }
    }
}
