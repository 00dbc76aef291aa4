//! The reasons why the program stops.

use rayline::{LineError, SceneError, SettingsError};

/// The reason why the program stops.
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
    /// The second core was started twice.
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
