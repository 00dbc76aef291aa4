//! Which part of a scene was refused.

use core::fmt;

use crate::fault::Fault;

/// A scene was refused: which part, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneError {
    /// The part that is wrong.
    pub part: Part,
    /// What is wrong with it, and what to do.
    pub fault: Fault,
}

/// A part of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Part {
    /// The camera.
    Camera,
    /// The background.
    Background,
    /// The object at this position in [`Scene::objects`](crate::Scene::objects).
    Object(usize),
    /// The material at this position in [`Scene::materials`](crate::Scene::materials).
    Material(usize),
    /// The light at this position in [`Scene::lights`](crate::Scene::lights).
    Light(usize),
    /// The memory that was lent for the prepared scene.
    Memory,
}

impl Part {
    /// Makes a fault of this part an error.
    pub(crate) fn error(self) -> impl FnOnce(Fault) -> SceneError {
        move |fault| SceneError { part: self, fault }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.part {
            Part::Camera => f.write_str("camera: ")?,
            Part::Background => f.write_str("background: ")?,
            Part::Object(index) => write!(f, "object {index}: ")?,
            Part::Material(index) => write!(f, "material {index}: ")?,
            Part::Light(index) => write!(f, "light {index}: ")?,
            Part::Memory => f.write_str("memory: ")?,
        }
        self.fault.fmt(f)
    }
}

impl core::error::Error for SceneError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.fault)
    }
}
