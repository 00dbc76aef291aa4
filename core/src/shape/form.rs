//! The kinds of shapes for which the number of hits on a ray is known in advance.

use crate::math::Vec3;

/// The kind of a shape, as far as it saves tests of rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form<R> {
    /// Nothing is known.
    Any,
    /// The surface of a ball, with outward normals: a ray that leaves it outward never meets it again, and a
    /// ray that starts inside meets it before anything that lies outside.
    Ball {
        /// The middle.
        center: Vec3<R>,
        /// The distance from the center to the surface.
        radius: R,
    },
    /// A part of the plane of all points p with `normal · p = distance`: a ray that leaves it never meets it
    /// again.
    Flat {
        /// Unit normal.
        normal: Vec3<R>,
        /// Distance of the plane from the origin, along the normal.
        distance: R,
    },
}

impl<R> Form<R> {
    /// Whether a ray that leaves the shape may meet it again. `outward` tells whether the ray leaves to the
    /// side of the normal.
    pub(crate) const fn is_met_again(&self, outward: bool) -> bool {
        match self {
            Self::Any => true,
            Self::Ball { .. } => !outward,
            Self::Flat { .. } => false,
        }
    }

    /// The most hits that a ray can have, if that is known.
    pub(crate) const fn most_hits(&self) -> Option<u8> {
        match self {
            Self::Any => None,
            Self::Ball { .. } => Some(2),
            Self::Flat { .. } => Some(1),
        }
    }

    /// Whether a part of a ray meets the shape only if the whole ray does, whatever is rounded. A shape that
    /// searches for roots may find other roots where the search begins elsewhere.
    pub(crate) const fn is_missed_by_parts(&self) -> bool {
        self.most_hits().is_some()
    }
}
