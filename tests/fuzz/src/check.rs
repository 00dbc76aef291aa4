//! The body of every search: draws one scene in all ways that must agree.

use core::fmt;

use rayline::Scene;
use rayline::math::Fixed;

use crate::case::{Case, Number};
use crate::pictures::{self, Light, Room, Stop, differing};

/// Memory that is reused by all executions, so that none allocates much.
#[derive(Debug, Default)]
pub struct Bench {
    room: Room,
    bytes: Vec<u8>,
    with: Vec<Light>,
    without: Vec<Light>,
    realtime: [Vec<Light>; 2],
}

/// The outcome of an execution that kept all promises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// The scene was refused, by both programs with the same words.
    Refused,
    /// All pictures were drawn.
    Drawn,
}

/// A broken promise.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// The exact picture changes with acceleration.
    Difference {
        /// The first pixel that differs.
        at: (u32, u32),
        /// Its light, with acceleration.
        with: Light,
        /// Its light, without.
        without: Light,
        /// How many pixels differ.
        pixels: usize,
        /// Whether the difference is that of hierarchies inside of meshes or instances.
        is_inside: bool,
    },
    /// One program refuses the scene, and the other draws it or gives another reason.
    Refusal {
        /// The words of the program with acceleration, if it refuses.
        with: Option<String>,
        /// The refusal of the program without acceleration.
        without: Option<String>,
    },
    /// A promise was broken: the reason.
    Broken(String),
    /// The program panicked: message and place.
    Panic(String),
    /// The execution took this many seconds.
    Slow(u64),
}

impl Finding {
    /// Whether another finding is of the same kind: what a smaller scene must show in order to stand for
    /// the larger one.
    pub fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Difference { is_inside, .. }, Self::Difference { is_inside: other, .. }) => {
                is_inside == other
            }
            (Self::Panic(one), Self::Panic(other)) => one == other,
            _ => core::mem::discriminant(self) == core::mem::discriminant(other),
        }
    }

    /// A word for the name of a file.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Difference { is_inside: false, .. } => "difference",
            Self::Difference { is_inside: true, .. } => "inside",
            Self::Refusal { .. } => "refusal",
            Self::Broken(_) => "broken",
            Self::Panic(_) => "panic",
            Self::Slow(_) => "slow",
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Difference { at: (x, y), with, without, pixels, is_inside } => {
                let inside =
                    if *is_inside { ", by the hierarchy inside of a mesh or of instances" } else { "" };
                write!(
                    f,
                    "{pixels} pixels change with acceleration{inside}; the first is {x},{y}: \
                     with {with:?}, without {without:?}"
                )
            }
            Self::Refusal { with, without } => {
                let said = |words: &Option<String>| words.clone().unwrap_or_else(|| "no reason".to_owned());
                write!(f, "refused with acceleration for {}, without for {}", said(with), said(without))
            }
            Self::Broken(reason) => f.write_str(reason),
            Self::Panic(message) => write!(f, "panic: {message}"),
            Self::Slow(seconds) => write!(f, "it took {seconds} s"),
        }
    }
}

impl Bench {
    /// Draws a scene exactly with and without acceleration, and in realtime quality where the case has one.
    ///
    /// # Errors
    /// The promise that was broken.
    pub fn check(&mut self, scene: &Scene<'_>, case: &Case) -> Result<Held, Finding> {
        match case.number {
            Number::F32 => self.check_in::<f32, f32>(scene, case),
            Number::Fixed => self.check_in::<Fixed, rayline_plain::math::Fixed>(scene, case),
            Number::F64 => self.check_in::<f64, f64>(scene, case),
        }
    }

    fn check_in<R: rayline::Real, P: rayline_plain::Real>(
        &mut self,
        scene: &Scene<'_>,
        case: &Case,
    ) -> Result<Held, Finding> {
        write_bytes(scene, &mut self.bytes)?;
        let Case { settings, portions, realtime, .. } = *case;
        let Self { room, with, without, .. } = self;
        let refusal = |stop| match stop {
            Stop::Refused(words) => Ok(Some(words)),
            Stop::Broken(reason) => Err(Finding::Broken(reason)),
        };
        let with_refusal = pictures::accelerated::<R>(scene, settings, portions, room, with);
        let with_refusal = with_refusal.map_or_else(refusal, |()| Ok(None))?;
        let without_refusal = pictures::plain::<P>(&self.bytes, settings, room, without);
        let without_refusal = without_refusal.map_or_else(refusal, |()| Ok(None))?;
        if with_refusal != without_refusal {
            return Err(Finding::Refusal { with: with_refusal, without: without_refusal });
        }
        if with_refusal.is_some() {
            return Ok(Held::Refused);
        }
        if let Some(first) = differing(with, without) {
            let pixels = with.iter().zip(&*without).filter(|(one, other)| one != other).count();
            let light = |picture: &[Light]| picture.get(first).copied().unwrap_or(Light::NONE);
            let (with, without) = (light(with), light(without));
            let at = (first as u32 % settings.width.max(1), first as u32 / settings.width.max(1));
            let half = pictures::half_accelerated::<R>(scene, settings, room, &mut self.with);
            let is_inside = half.is_ok() && differing(&self.with, &self.without).is_some();
            return Err(Finding::Difference { at, with, without, pixels, is_inside });
        }
        if let Some(quality) = realtime {
            let drawn = pictures::realtime::<R>(scene, settings, quality, room, &mut self.realtime);
            drawn.map_or_else(refusal, |()| Ok(None))?;
        }
        Ok(Held::Drawn)
    }
}

/// Writes a scene as bytes, in as much room as it takes.
///
/// # Errors
/// Not even 64 MB are enough.
pub(crate) fn write_bytes(scene: &Scene<'_>, bytes: &mut Vec<u8>) -> Result<(), Finding> {
    let mut room = bytes.capacity().max(1 << 14);
    loop {
        bytes.resize(room, 0);
        match scene.to_bytes(bytes).map(|bytes| bytes.len()) {
            Ok(length) => {
                bytes.truncate(length);
                return Ok(());
            }
            Err(_) if room < 1 << 26 => room *= 2,
            Err(error) => return Err(Finding::Broken(error.to_string())),
        }
    }
}
