//! Which part of a scene was refused.

use core::fmt;

use crate::fault::{Fault, Inner};

/// A scene was refused: which part, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SceneError {
    /// The part that is wrong.
    pub part: Part,
    /// What is wrong with it, and what to do.
    pub fault: Fault,
}

/// A part of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Part {
    /// The camera.
    Camera,
    /// The background.
    Background,
    /// The object at this position in [`Scene::objects`](crate::Scene::objects).
    Object(usize),
    /// A solid of a [`Csg`](crate::shape::Csg), which the object itself is or its model.
    Solid {
        /// The object, by its position in [`Scene::objects`](crate::Scene::objects).
        object: usize,
        /// Which of its solids, in the order of the steps, from 0.
        solid: usize,
    },
    /// The model of the object at this position, which is [`Instances`](crate::shape::Instances) of it.
    Model(usize),
    /// The material at this position in [`Scene::materials`](crate::Scene::materials).
    Material(usize),
    /// The light at this position in [`Scene::lights`](crate::Scene::lights).
    Light(usize),
    /// The motion at this position in [`Scene::motions`](crate::Scene::motions).
    Motion(usize),
    /// The memory that was lent for the prepared scene.
    Memory,
}

impl Part {
    /// What lies in this part.
    pub(crate) fn inner(self, inner: Option<Inner>) -> Self {
        match (self, inner) {
            (Self::Object(object), Some(Inner::Solid(solid))) => Self::Solid { object, solid },
            (Self::Object(object), Some(Inner::Model)) => Self::Model(object),
            (part, _) => part,
        }
    }

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
            Part::Solid { object, solid } => write!(f, "object {object}, solid {solid}: ")?,
            Part::Model(index) => write!(f, "object {index}, model: ")?,
            Part::Material(index) => write!(f, "material {index}: ")?,
            Part::Light(index) => write!(f, "light {index}: ")?,
            Part::Motion(index) => write!(f, "motion {index}: ")?,
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
