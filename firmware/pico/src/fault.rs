//! Why the program cannot go on.

use rayline::{LineError, SceneError, SettingsError};

/// Why the program cannot go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// The scene or a camera was refused.
    Scene,
    /// The settings were refused.
    Settings,
    /// A buffer does not fit the picture.
    Line,
    /// The panel failed.
    Panel,
    /// Something that there is once was asked for twice.
    #[cfg(feature = "second-core")]
    Taken,
}

impl From<SceneError> for Fault {
    fn from(_: SceneError) -> Self {
        Self::Scene
    }
}

impl From<SettingsError> for Fault {
    fn from(_: SettingsError) -> Self {
        Self::Settings
    }
}

impl From<LineError> for Fault {
    fn from(_: LineError) -> Self {
        Self::Line
    }
}
