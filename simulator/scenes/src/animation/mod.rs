//! Animations of scenes: key frames of the camera, of objects and of lights, in Rusty Object Notation.
//!
//! ```text
//! Animation(
//!     seconds: 4,
//!     frames_per_second: 20,
//!     camera: [
//!         (at: 0, eye: (0, 2, 6), target: (0, 1, 0)),
//!         (at: 4, eye: (6, 2, 0), target: (0, 1, 0), ease: true),
//!     ],
//!     objects: {
//!         "ball": [(at: 0), (at: 1, by: (0, 2, 0)), (at: 2)],
//!         "top": [(at: 0, about: (3, 0, 0)), (at: 4, about: (3, 0, 0), rotation: (0, 6.283, 0))],
//!     },
//!     lights: {
//!         0: [(at: 0, color: (1, 1, 1)), (at: 4, color: (1, 0.5, 0.2))],
//!     },
//! )
//! ```
//!
//! Objects and lights are given by their name or their number in the scene, from 0 on. A key frame holds
//! `at`, in seconds, and these fields:
//!
//! | of | field | a field that is left out |
//! |---|---|---|
//! | all | `ease`: the way to this key frame begins and ends at rest | `false`: constant speed |
//! | camera | `eye`, `target`, `up`, `vertical_fov` | as in the scene |
//! | object | `by`: moves it | 0 |
//! | | `rotation`: turns it, by angles as those of [`Pose`](rayline::shape::Pose) | 0 |
//! | | `about`: the point that the rotation leaves in place | the origin of the scene |
//! | light | `position`, `direction`, `color`, as far as the light has them | as in the scene |
//!
//! Between two key frames all numbers change evenly; before the first and after the last they stay. Colors of
//! lights get the exposure of the scene. `frames_per_second` may be left out: 20. Textures that are patterns
//! in space do not move with an object.

mod error;
mod keys;
mod placement;
mod track;

use core::fmt;
use std::collections::BTreeMap;
use std::path::Path;

use bumpalo::Bump;
use rayline::shape::Shape;
use rayline::{Camera, Light, Object, Scene};
use rayline_formats::nearest::nearest;
use serde::Deserialize;
use serde::de::{self, Deserializer, Visitor};

use crate::LoadedScene;
use crate::ron;

pub use error::{AnimationError, AnimationFault};
use keys::{CameraKey, LightKey, ObjectKey};
use placement::Placement;
use track::Track;

/// The longest animation, in seconds.
const MAX_SECONDS: f32 = 3600.0;

/// The most frames in a second: viewers take a GIF's delay of one hundredth of a second for a tenth.
const MAX_FRAMES_PER_SECOND: f32 = 50.0;

/// The most frames.
const MAX_FRAMES: f32 = 10_000.0;

/// The length of an animation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length {
    seconds: f32,
    frames_per_second: f32,
}

impl Length {
    /// An animation of this length, with so many frames in a second.
    ///
    /// # Errors
    /// The length is not between 0 and an hour, there are not between 0 and 50 frames in a second, or there
    /// is no frame, or more than 10,000.
    pub fn new(seconds: f32, frames_per_second: f32) -> Result<Self, AnimationFault> {
        let is_within = |value: f32, most: f32| value > 0.0 && value <= most;
        if !is_within(seconds, MAX_SECONDS) {
            return Err(AnimationFault::Seconds { most: MAX_SECONDS });
        }
        if !is_within(frames_per_second, MAX_FRAMES_PER_SECOND) {
            return Err(AnimationFault::FramesPerSecond { most: MAX_FRAMES_PER_SECOND });
        }
        let frames = (seconds * frames_per_second).round();
        if !(1.0..=MAX_FRAMES).contains(&frames) {
            return Err(AnimationFault::Frames { frames, most: MAX_FRAMES });
        }
        Ok(Self { seconds, frames_per_second })
    }

    /// The number of frames: 1 or more.
    pub fn frames(&self) -> u32 {
        (self.seconds * self.frames_per_second).round() as u32
    }

    /// The length in seconds.
    pub fn seconds(&self) -> f32 {
        self.seconds
    }

    /// The time of a frame in seconds. After the last frame, the first may follow: no frame shows the end.
    pub fn time(&self, frame: u32) -> f32 {
        self.seconds * frame as f32 / self.frames() as f32
    }
}

/// An animation of one scene.
#[derive(Clone, Debug)]
pub struct Animation {
    length: Length,
    camera: Option<Track<Camera>>,
    objects: Vec<(usize, Track<Placement>)>,
    lights: Vec<(usize, Track<Light>)>,
}

/// The contents of a file.
#[derive(Deserialize)]
#[serde(rename = "Animation", deny_unknown_fields)]
struct File {
    seconds: f32,
    #[serde(default = "usual_frames_per_second")]
    frames_per_second: f32,
    camera: Option<Vec<CameraKey>>,
    #[serde(default)]
    objects: BTreeMap<Name, Vec<ObjectKey>>,
    #[serde(default)]
    lights: BTreeMap<Name, Vec<LightKey>>,
}

fn usual_frames_per_second() -> f32 {
    20.0
}

impl Animation {
    /// Reads an animation of a scene from a file.
    ///
    /// # Errors
    /// The file cannot be read or breaks the grammar, the scene has not one of its objects or lights, or the
    /// times of its key frames do not grow.
    pub fn read(path: &Path, scene: &LoadedScene<'_>) -> Result<Self, AnimationError> {
        let file: File = ron::read_value(path).map_err(AnimationError::Ron)?;
        let refuse = |of: String, fault| AnimationError::Refused { path: path.to_owned(), of, fault };
        let length = Length::new(file.seconds, file.frames_per_second)
            .map_err(|fault| refuse("the animation".to_owned(), fault))?;
        let own = scene.scene.camera;
        let camera = file.camera.map(|keys| {
            let keys = keys.iter().map(|key| (key.at, key.ease, key.of(&own)));
            Track::new(keys).map_err(|fault| refuse("camera".to_owned(), fault))
        });
        let mut objects = Vec::new();
        let names = scene.names_of("objects");
        for (name, keys) in &file.objects {
            let refuse = |fault| refuse(format!("object {name}"), fault);
            let index = name.index(&names, scene.scene.objects.len()).map_err(refuse)?;
            let keys = keys.iter().map(|key| (key.at, key.ease, key.placement()));
            objects.push((index, Track::new(keys).map_err(refuse)?));
        }
        let mut lights = Vec::new();
        let names = scene.names_of("lights");
        for (name, keys) in &file.lights {
            let refuse = |fault| refuse(format!("light {name}"), fault);
            let index = name.index(&names, scene.scene.lights.len()).map_err(refuse)?;
            let Some(own) = scene.scene.lights.get(index) else { continue };
            let keys: Result<Vec<_>, _> =
                keys.iter().map(|key| Ok((key.at, key.ease, key.of(own, scene.exposure())?))).collect();
            lights.push((index, Track::new(keys.map_err(refuse)?.into_iter()).map_err(refuse)?));
        }
        Ok(Self { length, camera: camera.transpose()?, objects, lights })
    }

    /// The length.
    pub fn length(&self) -> Length {
        self.length
    }

    /// The scene at a time in seconds. New parts of it are kept in `arena`.
    pub fn scene_at<'a>(&self, scene: &Scene<'a>, seconds: f32, arena: &'a Bump) -> Scene<'a> {
        let mut moved = *scene;
        if let Some(track) = &self.camera {
            moved.camera = track.at(seconds);
        }
        if !self.objects.is_empty() {
            let objects: &mut [Object<Shape<'a>>] = arena.alloc_slice_copy(scene.objects);
            for (index, track) in &self.objects {
                if let Some(object) = objects.get_mut(*index) {
                    object.shape = track.at(seconds).placed(&object.shape, arena);
                }
            }
            moved.objects = objects;
        }
        if !self.lights.is_empty() {
            let lights = arena.alloc_slice_copy(scene.lights);
            for (index, track) in &self.lights {
                if let Some(light) = lights.get_mut(*index) {
                    *light = track.at(seconds);
                }
            }
            moved.lights = lights;
        }
        moved
    }
}

/// The name or the number of a part of the scene.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Name {
    Number(u64),
    Text(String),
}

impl Name {
    /// The position of the part in a list of so many parts, which may have names.
    fn index(&self, names: &[String], count: usize) -> Result<usize, AnimationFault> {
        let index = match self {
            Self::Number(number) => usize::try_from(*number).ok().filter(|index| *index < count),
            Self::Text(text) => names.iter().position(|name| name == text),
        };
        index.ok_or_else(|| AnimationFault::Unknown {
            nearest: match self {
                Self::Number(_) => None,
                Self::Text(text) => nearest(text, names.iter().map(String::as_str)).map(str::to_owned),
            },
            count,
        })
    }
}

impl<'de> Deserialize<'de> for Name {
    fn deserialize<D: Deserializer<'de>>(name: D) -> Result<Self, D::Error> {
        struct NameVisitor;

        impl Visitor<'_> for NameVisitor {
            type Value = Name;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a name in quotes, or a number from 0 on")
            }

            fn visit_u64<E: de::Error>(self, number: u64) -> Result<Name, E> {
                Ok(Name::Number(number))
            }

            fn visit_str<E: de::Error>(self, name: &str) -> Result<Name, E> {
                Ok(Name::Text(name.to_owned()))
            }
        }

        name.deserialize_any(NameVisitor)
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(f),
            Self::Text(text) => write!(f, "`{}`", text.escape_debug()),
        }
    }
}
