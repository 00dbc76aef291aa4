//! Textures: colors that vary over a surface.
//!
//! [`Texture::Solid`] and [`Texture::Checker`] are always available. All other textures are a [`Placed`]: a
//! [`Figure`] with its placement in space or on the surface. They need the cargo feature `textures`. Without
//! it there is no code for them, and a scene with one is refused.

// Without the feature, no figure is ever evaluated.
#![cfg_attr(not(feature = "textures"), allow(dead_code))]

mod brick;
mod checker;
mod gradient;
mod image;
mod irradiance_volume;
mod map;
mod marble;
mod noise;
mod pixels;
mod placed;
mod placement;
mod srgb;
mod stripes;
#[cfg(all(test, feature = "textures"))]
mod tests;
mod wood;

pub use brick::Brick;
pub use checker::{Checker, Squares};
pub use gradient::{Ends, Gradient};
pub(crate) use image::PreparedImage;
pub use image::{Filter, Image};
pub use irradiance_volume::IrradianceVolume;
pub(crate) use map::{Coefficients, OpticsShares, PreparedMaps};
pub use map::{Map, Onto};
pub use marble::Marble;
pub use noise::{MAX_OCTAVES, Noise};
pub use pixels::{Encoding, Pixels};
pub use placed::{Figure, Placed};
pub(crate) use placed::{Needing, PreparedPlaced, level_mark, present};
pub use placement::{Placement, Space};
pub use stripes::Stripes;
pub use wood::Wood;

use crate::arena::Arena;
use crate::color::LinearRgb;
use crate::fault::{Coefficient, Fault, check_share};
use crate::math::{Real, Scale};
use crate::surface::Surface;
use checker::PreparedChecker;

/// The color of a material as a function of the point on its surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Texture<'a> {
    /// The same color everywhere.
    Solid(LinearRgb),
    /// Two colors in alternating cells in space.
    Checker(Checker),
    /// A figure, placed in space or on the surface. Needs the feature `textures`.
    Placed(&'a Placed<'a>),
}

#[cfg(feature = "serde")]
crate::read::read_enum! {
    [] Texture as Texture<'m> { Solid(LinearRgb), Checker(Checker), Placed(&'m Placed<'m>) }
}

impl<'a> Texture<'a> {
    /// A checker of squares with sides of `size` units in the x-z plane.
    pub const fn checker_xz(even: LinearRgb, odd: LinearRgb, size: f32) -> Self {
        Self::Checker(Checker::xz(even, odd, size))
    }

    /// The most bytes that [`prepare`](Self::prepare) takes.
    pub(crate) const fn bytes<R: Real>(&self) -> usize {
        match self {
            Self::Solid(_) | Self::Checker(_) => 0,
            Self::Placed(placed) => {
                Arena::bytes::<PreparedPlaced<'_, R>>(1).saturating_add(placed.bytes::<R>())
            }
        }
    }

    /// Checks the texture and converts it.
    pub(crate) fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedTexture<'m, R>, Fault>
    where
        'a: 'm,
    {
        Ok(match self {
            Self::Solid(color) => PreparedTexture::Solid(check_reflectivity(*color)?),
            Self::Checker(checker) => PreparedTexture::Checker(checker.prepare(scale)?),
            Self::Placed(pattern) => {
                let present = present()?;
                let prepared = pattern.prepare(scale, memory)?;
                PreparedTexture::Placed(Needing::new(memory.store(prepared)?, present))
            }
        })
    }
}

impl From<LinearRgb> for Texture<'_> {
    fn from(color: LinearRgb) -> Self {
        Self::Solid(color)
    }
}

#[cfg(feature = "serde")]
crate::read::plain!(
    Checker, Squares, Stripes, Gradient, Noise, Marble, Wood, Brick, Placement, Onto, Encoding, Filter, Ends
);

/// Refuses a color with a channel outside 0..=1.
fn check_reflectivity<R: Real>(color: LinearRgb) -> Result<LinearRgb<R>, Fault> {
    for channel in color.channels() {
        check_share(Coefficient::Color, channel)?;
    }
    Ok(color.to())
}

/// Refuses a number outside 0..=1.
fn check_unit<R: Real>(coefficient: Coefficient, value: f32) -> Result<R, Fault> {
    check_share(coefficient, value)?;
    Ok(R::from_f32(value))
}

/// The linear interpolation between two colors: `from` at share 0, `to` at share 1.
pub(crate) fn blend<R: Real>(from: LinearRgb<R>, to: LinearRgb<R>, share: R) -> LinearRgb<R> {
    from.scaled(R::ONE - share) + to.scaled(share)
}

/// A texture that was checked and converted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PreparedTexture<'m, R: Real> {
    Solid(LinearRgb<R>),
    Checker(PreparedChecker<R>),
    Placed(Needing<'m, PreparedPlaced<'m, R>>),
}

impl<R: Real> PreparedTexture<'_, R> {
    /// A number for the part of the texture that a ray hit, in this color. It changes at the edges of cells,
    /// and where the color differs by a sixteenth. `None` for a texture of one color.
    pub(crate) fn mark(
        &self,
        surface: &Surface<R>,
        color: LinearRgb<R>,
        uv: impl FnOnce() -> [R; 2],
    ) -> Option<u32> {
        let step = self.step(surface, uv);
        match self {
            Self::Placed(_) => {
                let level = level_mark(color);
                Some(step.map_or(level, |step| step ^ level.rotate_left(16)))
            }
            Self::Solid(_) | Self::Checker(_) => step,
        }
    }

    /// A number for the cell that a ray hit, of a texture with sharp edges: neighboring cells have different
    /// numbers. `None` for a smooth texture.
    pub(crate) fn step(&self, surface: &Surface<R>, uv: impl FnOnce() -> [R; 2]) -> Option<u32> {
        match self {
            Self::Solid(_) => None,
            Self::Checker(checker) => Some(checker.cell(surface.point)),
            Self::Placed(pattern) => pattern.get().step(surface, uv),
        }
    }

    /// The color at the point where a ray hit a surface. `uv` computes its texture coordinates and is called
    /// only by textures that use them.
    #[inline]
    pub(crate) fn color(&self, surface: &Surface<R>, uv: impl FnOnce() -> [R; 2]) -> LinearRgb<R> {
        match self {
            Self::Solid(color) => *color,
            Self::Checker(checker) => checker.color(surface.point),
            #[cfg(feature = "textures")]
            Self::Placed(pattern) => pattern.get().color(surface, uv),
            // There is no such pattern. A call that is never reached kept all of `surface` in memory, and
            // took `classic` on an M4F 5 instructions a pixel.
            #[cfg(not(feature = "textures"))]
            Self::Placed(pattern) => {
                pattern.get();
                uv();
                LinearRgb::BLACK
            }
        }
    }
}
