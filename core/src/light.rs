//! Where light comes from.

use crate::color::LinearRgb;
use crate::fault::{Fault, check_coordinate, check_direction, check_held, check_point};
use crate::math::{Real, Scale, Vec3};

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
    pub(crate) fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedLight<R>, Fault> {
        let (source, color) = match *self {
            Self::Point { position, color } => {
                check_point(position)?;
                (Source::point(position, scale), color)
            }
            Self::Directional { direction, color } => {
                let direction: Vec3<R::Setup> = check_direction(direction)?;
                (Source::Toward(Vec3::from_setup(-direction)), color)
            }
        };
        check_emission::<R>(color)?;
        Ok(PreparedLight { source, color: color.to() })
    }
}

/// Refuses emitted light that is negative or not finite; it may be above 1.
pub(crate) fn check_emission<R: Real>(color: LinearRgb) -> Result<(), Fault> {
    for value in [color.r, color.g, color.b] {
        check_coordinate(value)?;
        if value < 0.0 {
            return Err(Fault::NegativeColor);
        }
        check_held::<R>(R::Setup::from_f32(value))?;
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
    /// Beyond what the number system reaches: the place of the light and the factor that brought it near, a power of
    /// two. Never in floating point.
    Far(Vec3<R>, R),
    /// Unit vector toward the light.
    Toward(Vec3<R>),
}

impl<R: Real> Source<R> {
    fn point(position: Vec3, scale: Scale) -> Self {
        if scale.is_near::<R>(position) {
            return Self::At(scale.point(position.to()));
        }
        let shrink = scale.shrink(position);
        Self::Far(scale.point((position * shrink).to()), R::from_f32(shrink))
    }
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
                let (direction, distance, cosine) = R::polar_with([toward.x, toward.y, toward.z], height);
                let [x, y, z] = direction;
                (distance > R::ZERO).then_some((Vec3::new(x, y, z), distance, cosine))
            }
            Source::Far(position, shrink) => {
                // The direction is the same in every scale.
                let (direction, _) = (position - point * shrink).polar();
                let cosine = direction.dot(normal);
                (cosine > R::ZERO).then_some((direction, R::FARTHEST, cosine))
            }
            Source::Toward(direction) => {
                let cosine = direction.dot(normal);
                (cosine > R::ZERO).then_some((direction, R::FARTHEST, cosine))
            }
        }
    }
}
