//! Figures and their placement, the textures that need the feature `textures`.

use super::checker::mark;
use super::gradient::Gradient;
use super::image::{Image, PreparedImage};
use super::irradiance_volume::IrradianceVolume;
use super::marble::Marble;
use super::noise::Noise;
use super::placement::{Placement, PreparedPlacement};
use super::stripes::Stripes;
use super::wood::Wood;
use super::{Brick, Squares};
use crate::arena::Arena;
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::math::{LatticeCoordinate, Real, Scale};
use crate::surface::Surface;

/// A proof that the feature `textures` is on. Without the feature this type has no values, so that the
/// compiler drops all code that needs one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Present(
    #[cfg(feature = "textures")] (),
    #[cfg(not(feature = "textures"))] core::convert::Infallible,
);

/// The proof that `textures` is on, or [`Fault::WithoutFeature`].
pub(crate) const fn present() -> Result<Present, Fault> {
    #[cfg(feature = "textures")]
    return Ok(Present(()));
    #[cfg(not(feature = "textures"))]
    Err(Fault::WithoutFeature { feature: "textures" })
}

/// A reference to a value that needs the feature `textures`. Without the feature this type has no values and
/// no size: an enum with one such variant is then never that variant, and no code tests for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Needing<'m, T> {
    present: Present,
    #[cfg(feature = "textures")]
    reference: &'m T,
    #[cfg(not(feature = "textures"))]
    reference: core::marker::PhantomData<&'m T>,
}

impl<'m, T> Needing<'m, T> {
    #[cfg_attr(not(feature = "textures"), allow(unused_variables))]
    pub(crate) const fn new(reference: &'m T, present: Present) -> Self {
        Self {
            present,
            #[cfg(feature = "textures")]
            reference,
            #[cfg(not(feature = "textures"))]
            reference: core::marker::PhantomData,
        }
    }

    #[inline]
    pub(crate) const fn get(&self) -> &'m T {
        #[cfg(feature = "textures")]
        return self.reference;
        #[cfg(not(feature = "textures"))]
        match self.present.0 {}
    }
}

/// A figure with its placement.
///
/// ```
/// use rayline::{Figure, LinearRgb, Marble, Material, Placed, Placement, Texture};
/// static STONE: Placed = Placed::new(
///     Figure::Marble(Marble {
///         stone: LinearRgb::gray(0.9),
///         vein: LinearRgb::gray(0.1),
///         turbulence: 1.5,
///         octaves: 4,
///     }),
///     Placement::in_scene(0.5),
/// );
/// let _material = Material { color: Texture::Placed(&STONE), ..Material::matte(LinearRgb::WHITE) };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Placed<'a> {
    /// The figure.
    pub figure: Figure<'a>,
    /// Its position, rotation and size.
    pub placement: Placement,
}

#[cfg(feature = "serde")]
crate::read::read_struct!([] Placed as Placed<'m> { figure, placement = Placement::SURFACE });

/// A pattern or an image, in its own coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Figure<'a> {
    /// Cells of two colors that alternate.
    Squares(Squares),
    /// Stripes of two colors.
    Stripes(Stripes),
    /// A gradient from one color to another.
    Gradient(Gradient),
    /// Clouds of gradient noise.
    Noise(Noise),
    /// Marble veins.
    Marble(Marble),
    /// The rings of wood.
    Wood(Wood),
    /// Bricks and mortar.
    Brick(Brick),
    /// An image.
    Image(Image<'a>),
    /// An image for each [part](Surface::part) of a surface, such as the six faces of a
    /// [`Cuboid`](crate::shape::Cuboid): at least one. The last also holds for all parts behind it.
    Parts(&'a [Image<'a>]),
    /// Light from all around at the points of a grid: for [`Onto::AmbientLight`](super::Onto::AmbientLight).
    IrradianceVolume(IrradianceVolume<'a>),
}

#[cfg(feature = "serde")]
crate::read::read_enum! {
    [] Figure as Figure<'m> {
        Squares(Squares), Stripes(Stripes), Gradient(Gradient), Noise(Noise), Marble(Marble), Wood(Wood),
        Brick(Brick), Image(Image<'m>), Parts(&'m [Image<'m>]), IrradianceVolume(IrradianceVolume<'m>),
    }
}

impl<'a> Placed<'a> {
    /// The figure in this placement.
    pub const fn new(figure: Figure<'a>, placement: Placement) -> Self {
        Self { figure, placement }
    }

    /// The most bytes that [`prepare`](Self::prepare) takes.
    pub(super) const fn bytes<R: Real>(&self) -> usize {
        match self.figure {
            Figure::Parts(images) => Arena::bytes::<PreparedImage<'_, R>>(images.len()),
            _ => 0,
        }
    }

    pub(super) fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedPlaced<'m, R>, Fault>
    where
        'a: 'm,
    {
        let figure = match self.figure {
            Figure::Squares(squares) => PreparedFigure::Squares(squares.prepare()?),
            Figure::Stripes(stripes) => PreparedFigure::Stripes(stripes.prepare()?),
            Figure::Gradient(gradient) => PreparedFigure::Gradient(gradient.prepare()?),
            Figure::Noise(noise) => PreparedFigure::Noise(noise.prepare()?),
            Figure::Marble(marble) => PreparedFigure::Marble(marble.prepare()?),
            Figure::Wood(wood) => PreparedFigure::Wood(wood.prepare()?),
            Figure::Brick(brick) => PreparedFigure::Brick(brick.prepare()?),
            Figure::Image(image) => PreparedFigure::Image(image.prepare()?),
            Figure::Parts([]) => return Err(Fault::NoImage),
            Figure::Parts(images) => {
                PreparedFigure::Parts(memory.try_store_with(images.len(), |index, _| {
                    // Every index has an image, so this fault never occurs.
                    images.get(index).ok_or(Fault::NoImage)?.prepare()
                })?)
            }
            Figure::IrradianceVolume(volume) => {
                volume.check(&self.placement)?;
                PreparedFigure::IrradianceVolume(volume)
            }
        };
        Ok(PreparedPlaced { figure, placement: self.placement.prepare(scale)? })
    }
}

/// A [`Placed`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedPlaced<'m, R: Real> {
    figure: PreparedFigure<'m, R>,
    placement: PreparedPlacement<R>,
}

/// A [`Figure`], prepared. Most figures keep their type and change only their number system.
#[derive(Clone, Copy, Debug, PartialEq)]
enum PreparedFigure<'m, R: Real> {
    Squares(Squares<R>),
    Stripes(Stripes<R>),
    Gradient(Gradient<R>),
    Noise(Noise<R>),
    Marble(Marble<R>),
    Wood(Wood<R>),
    Brick(Brick<R>),
    Image(PreparedImage<'m, R>),
    Parts(&'m [PreparedImage<'m, R>]),
    IrradianceVolume(IrradianceVolume<'m>),
}

impl<R: Real> PreparedPlaced<'_, R> {
    /// The color at a point of the surface.
    #[inline]
    pub(super) fn color(&self, surface: &Surface<R>, uv: impl FnOnce() -> [R; 2]) -> LinearRgb<R> {
        self.figure.color(self.placement.coordinates(self.placement.place(surface.point, uv)), surface)
    }

    /// See [`PreparedTexture::step`](super::PreparedTexture::step).
    pub(super) fn step(&self, surface: &Surface<R>, uv: impl FnOnce() -> [R; 2]) -> Option<u32> {
        let at = || self.placement.coordinates(self.placement.place(surface.point, uv));
        let numbers = match self.figure {
            PreparedFigure::Squares(_) | PreparedFigure::Stripes(_) => {
                at().map(|coordinate| coordinate.index)
            }
            PreparedFigure::Brick(_) => {
                let [x, y, _] = Brick::in_row(at());
                // Bricks are constant along z.
                [x.index, y.index, 0]
            }
            PreparedFigure::Image(image) if image.has_steps() => image.step(at()),
            PreparedFigure::Parts(images) => match image_of(images, surface) {
                Some(image) if image.has_steps() => image.step(at()),
                _ => return None,
            },
            _ => return None,
        };
        Some(mark(numbers))
    }
}

/// A number for a color, which changes with every sixteenth of a channel. Colors that differ by less are
/// interpolated.
pub(crate) fn level_mark<R: Real>(color: LinearRgb<R>) -> u32 {
    mark([color.r, color.g, color.b].map(|channel| channel.to_q16() as i32 >> 12))
}

impl<R: Real> PreparedFigure<'_, R> {
    /// Not inlined, so that all callers share one copy of the code.
    #[inline(never)]
    fn color(&self, at: [LatticeCoordinate<R>; 3], surface: &Surface<R>) -> LinearRgb<R> {
        match self {
            Self::Squares(squares) => squares.color(at),
            Self::Stripes(stripes) => stripes.color(at),
            Self::Gradient(gradient) => gradient.color(at),
            Self::Noise(noise) => noise.color(at),
            Self::Marble(marble) => marble.color(at),
            Self::Wood(wood) => wood.color(at),
            Self::Brick(brick) => brick.color(at),
            Self::Image(image) => image.color(at),
            Self::Parts(images) => {
                image_of(images, surface).map_or(LinearRgb::BLACK, |image| image.color(at))
            }
            Self::IrradianceVolume(volume) => volume.color(at, surface.shading_normal),
        }
    }
}

/// The image of the part of a surface; not `None`, because no list is empty.
fn image_of<'i, 'm, R: Real>(
    images: &'i [PreparedImage<'m, R>],
    surface: &Surface<R>,
) -> Option<&'i PreparedImage<'m, R>> {
    images.get(surface.part as usize).or(images.last())
}
