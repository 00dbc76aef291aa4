//! The background, seen by rays that hit nothing: one color, a sky gradient, or a panorama image.
//!
//! The background is infinitely far away: its color depends on the direction of a ray alone. Camera rays,
//! mirrored rays and refracted rays see it alike. It does not light objects.

mod panorama;
mod sky;

pub use panorama::Panorama;
pub use sky::Sky;

use crate::arena::Arena;
use crate::color::{LinearRgb, check_emission};
use crate::fault::Fault;
use crate::math::{Real, Vec3};
use crate::texture::{Needing, level_mark, present};
use panorama::PreparedPanorama;
use sky::PreparedSky;

/// The background: the color of rays that hit nothing.
///
/// ```
/// use rayline::{Background, LinearRgb, Sky};
/// const NIGHT: Background = Background::gray(0.02);
/// static BLUE: Sky = Sky::new(LinearRgb::gray(0.8), LinearRgb::new(0.1, 0.3, 0.8));
/// const DAY: Background = Background::Gradient(&BLUE);
/// assert_eq!(NIGHT, Background::Solid(LinearRgb::gray(0.02)));
/// # assert_ne!(NIGHT, DAY);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Background<'a> {
    /// One color for all directions; channels are 0 or more.
    Solid(LinearRgb),
    /// A gradient by the height above the horizon. Needs the feature `textures`.
    Gradient(&'a Sky),
    /// An image all around the scene. Needs the feature `textures`.
    Image(&'a Panorama<'a>),
}

#[cfg(feature = "serde")]
crate::read::read_enum! {
    [] Background as Background<'m> { Solid(LinearRgb), Gradient(&'m Sky), Image(&'m Panorama<'m>) }
}

impl<'a> Background<'a> {
    /// No light.
    pub const BLACK: Self = Self::gray(0.0);

    /// The gray of this value, 0 or more, in all directions.
    pub const fn gray(value: f32) -> Self {
        Self::Solid(LinearRgb::gray(value))
    }

    /// Whether the background needs the feature `textures`.
    pub(crate) const fn needs_textures(&self) -> bool {
        !matches!(self, Self::Solid(_))
    }

    /// The most bytes that [`prepare`](Self::prepare) takes.
    pub(crate) const fn bytes<R: Real>(&self) -> usize {
        match self {
            Self::Solid(_) => 0,
            Self::Gradient(_) | Self::Image(_) => Arena::bytes::<Surroundings<'_, R>>(1),
        }
    }

    /// Checks the background and converts it.
    pub(crate) fn prepare<'m, R: Real>(
        &self,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedBackground<'m, R>, Fault>
    where
        'a: 'm,
    {
        let (surroundings, present) = match self {
            Self::Solid(color) => {
                check_emission::<R>(*color)?;
                return Ok(PreparedBackground::Solid(color.to()));
            }
            Self::Gradient(sky) => {
                let present = present()?;
                (Surroundings::Sky(sky.prepare()?), present)
            }
            Self::Image(panorama) => {
                let present = present()?;
                (Surroundings::Panorama(panorama.prepare()?), present)
            }
        };
        Ok(PreparedBackground::Varying(Needing::new(memory.store(surroundings)?, present)))
    }
}

impl From<LinearRgb> for Background<'_> {
    fn from(color: LinearRgb) -> Self {
        Self::Solid(color)
    }
}

/// A background that was checked and converted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PreparedBackground<'m, R: Real> {
    Solid(LinearRgb<R>),
    /// Never made without the feature `textures`; the compiler then drops the code for it.
    Varying(Needing<'m, Surroundings<'m, R>>),
}

/// A background that depends on the direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Surroundings<'m, R: Real> {
    Sky(PreparedSky<R>),
    Panorama(PreparedPanorama<'m, R>),
}

impl<R: Real> PreparedBackground<'_, R> {
    /// The color that is seen along `direction`, a unit vector.
    #[inline]
    pub(crate) fn color(&self, direction: Vec3<R>) -> LinearRgb<R> {
        match self {
            Self::Solid(color) => *color,
            Self::Varying(surroundings) => surroundings.get().color(direction),
        }
    }

    /// The color of a background that is the same in all directions.
    #[inline]
    pub(crate) fn solid(&self) -> Option<LinearRgb<R>> {
        match self {
            Self::Solid(color) => Some(*color),
            Self::Varying(_) => None,
        }
    }

    /// Whether [`light_on`](Self::light_on) has a formula.
    #[cfg(feature = "distributed")]
    pub(crate) fn has_closed_form(&self) -> bool {
        match self {
            Self::Solid(_) => true,
            Self::Varying(surroundings) => matches!(surroundings.get(), Surroundings::Sky(_)),
        }
    }

    /// The light that comes from all directions above a white surface with this unit normal: the mean of the
    /// colors, weighted by the cosine. A ground with this unit normal is black. `None` for a panorama.
    #[cfg(feature = "distributed")]
    pub(crate) fn light_on(&self, normal: Vec3<R>, ground: Option<Vec3<R>>) -> Option<LinearRgb<R>> {
        let above = ground.map(|ground| share_above(ground, normal));
        match self {
            Self::Solid(color) => Some(above.map_or(*color, |above| color.scaled(above))),
            Self::Varying(surroundings) => match surroundings.get() {
                Surroundings::Sky(sky) => Some(sky.light_on(normal, ground.zip(above))),
                Surroundings::Panorama(_) => None,
            },
        }
    }

    /// A number for the part of the background that is seen along `direction`, in this color. Two directions
    /// have different numbers where interpolating between their two colors would be wrong. A solid background
    /// has the number 0.
    #[inline]
    pub(crate) fn mark(&self, direction: Vec3<R>, color: LinearRgb<R>) -> u32 {
        match self {
            Self::Solid(_) => 0,
            Self::Varying(surroundings) => match surroundings.get() {
                Surroundings::Sky(sky) => u32::from(sky.is_below(direction)),
                Surroundings::Panorama(_) => level_mark(color),
            },
        }
    }

    /// Whether two backgrounds are surely equal. Panoramas are compared by address, not pixel by pixel.
    pub(crate) fn is_same(&self, other: &PreparedBackground<'_, R>) -> bool {
        match (self, other) {
            (Self::Solid(one), PreparedBackground::Solid(other)) => one == other,
            (Self::Varying(one), PreparedBackground::Varying(other)) => match (one.get(), other.get()) {
                (Surroundings::Sky(one), Surroundings::Sky(other)) => one == other,
                (Surroundings::Panorama(one), Surroundings::Panorama(other)) => one.is_same(other),
                _ => false,
            },
            _ => false,
        }
    }
}

/// The share of an even sky that is above a plane, on a surface with this normal.
#[cfg(feature = "distributed")]
pub(crate) fn share_above<R: Real>(plane: Vec3<R>, normal: Vec3<R>) -> R {
    (R::ONE + plane.dot(normal)).larger(R::ZERO) * R::from_f32(0.5)
}

impl<R: Real> Surroundings<'_, R> {
    /// Not inlined, so that all callers share one copy of the code.
    #[inline(never)]
    fn color(&self, direction: Vec3<R>) -> LinearRgb<R> {
        match self {
            Self::Sky(sky) => sky.color(direction),
            Self::Panorama(panorama) => panorama.color(direction),
        }
    }
}
