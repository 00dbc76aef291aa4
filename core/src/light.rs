//! Where light comes from.

use crate::color::LinearRgb;
use crate::fault::{Fault, check_coordinate, check_direction, check_point};
use crate::math::{Real, Vec3};

/// A light without size: shadows have sharp edges. Intensity does not fall off with distance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Light {
    /// Shines from one point in all directions.
    Point {
        /// Where the light is.
        position: Vec3,
        /// Its color and intensity, 0 or more.
        color: LinearRgb,
    },
    /// Shines from infinitely far away, like the sun.
    Directional {
        /// The way the light travels; any length but 0.
        direction: Vec3,
        /// Its color and intensity, 0 or more.
        color: LinearRgb,
    },
}

impl Light {
    /// Checks every number and converts it.
    pub(crate) fn prepare<R: Real>(&self) -> Result<PreparedLight<R>, Fault> {
        let (source, color) = match *self {
            Self::Point { position, color } => {
                check_point(position)?;
                (Source::At(position.to()), color)
            }
            Self::Directional { direction, color } => (Source::Toward(-check_direction(direction)?), color),
        };
        check_emission(color)?;
        Ok(PreparedLight { source, color: color.to() })
    }
}

/// Refuses emitted light that is negative or not finite; it may be above 1.
pub(crate) fn check_emission(color: LinearRgb) -> Result<(), Fault> {
    for value in [color.r, color.g, color.b] {
        check_coordinate(value)?;
        if value < 0.0 {
            return Err(Fault::NegativeColor);
        }
    }
    Ok(())
}

/// A light that was checked and converted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedLight<R> {
    pub(crate) source: Source<R>,
    pub(crate) color: LinearRgb<R>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Source<R> {
    At(Vec3<R>),
    /// Unit vector toward the light.
    Toward(Vec3<R>),
}

impl<R: Real> PreparedLight<R> {
    /// The unit direction from a point toward the light, how far the light is along it, and the cosine of its
    /// angle with a unit normal; `None` where the light is behind the surface, or the point is the light's own.
    #[inline]
    pub(crate) fn seen_from(&self, point: Vec3<R>, normal: Vec3<R>) -> Option<(Vec3<R>, R, R)> {
        match self.source {
            Source::At(position) => {
                let toward = position - point;
                // Lights behind the surface are the most frequent: find them before the root and the division.
                let height = toward.dot(normal);
                if !(height > R::ZERO) {
                    return None;
                }
                let distance = toward.length();
                if !(distance > R::ZERO) {
                    return None;
                }
                let scale = distance.recip();
                Some((toward * scale, distance, height * scale))
            }
            Source::Toward(direction) => {
                let cosine = direction.dot(normal);
                (cosine > R::ZERO).then_some((direction, R::FARTHEST, cosine))
            }
        }
    }
}
