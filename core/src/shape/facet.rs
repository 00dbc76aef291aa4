//! Shapes as triangles, for scan conversion.

use crate::math::{Real, Vec3};

/// A triangle of a shape's surface, or of an approximation of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet<R> {
    /// The corners, on the surface; counterclockwise, seen from the front.
    pub corners: [Vec3<R>; 3],
    /// The unit normals to shade with at the corners.
    pub normals: [Vec3<R>; 3],
    /// The part of the shape that the facet belongs to, see [`Surface::part`](crate::Surface::part).
    pub part: u32,
    /// Whether the surface is closed, so that the back is never seen from outside.
    pub is_closed: bool,
}

/// How a shape is cut into facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tessellation<R> {
    /// The sides of the polygon that takes the place of a circle, from
    /// [`MIN_SEGMENTS`](crate::limits::MIN_SEGMENTS) to [`MAX_SEGMENTS`](crate::limits::MAX_SEGMENTS).
    pub segments: u16,
    /// The eye: infinite planes are cut where they are seen.
    pub eye: Vec3<R>,
}

impl<R: Real> Facet<R> {
    /// A flat facet, which is not closed. The normal is a unit vector.
    pub fn flat(corners: [Vec3<R>; 3], normal: Vec3<R>) -> Self {
        Self { corners, normals: [normal; 3], part: 0, is_closed: false }
    }
}
