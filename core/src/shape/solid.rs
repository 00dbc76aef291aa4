//! The set of all built-in solids.

use super::{Cone, ConvexPolyhedron, Cuboid, Cylinder, Ellipsoid, Plane, Quadric, Shape, Sphere, Torus};

crate::shape_set! {
    /// The set of all built-in solids: the parts of a [`Csg`](super::Csg), unless you name a set of your own.
    pub enum Solid<'a>;
    /// [`Solid`], prepared.
    pub enum PreparedSolid {
        /// A ball.
        Sphere(Sphere),
        /// The half of space behind a plane.
        Plane(Plane),
        /// A capped cylinder.
        Cylinder(Cylinder),
        /// A capped cone or frustum.
        Cone(Cone),
        /// An ellipsoid.
        Ellipsoid(Ellipsoid),
        /// The inside of a quadric, cut off by a box.
        Quadric(Quadric),
        /// A torus.
        Torus(Torus),
        /// A box, along the axes or not.
        Cuboid(Cuboid),
        /// A convex solid with flat faces.
        ConvexPolyhedron(ConvexPolyhedron<'a>),
    }
}

impl<'a> From<Solid<'a>> for Shape<'a> {
    fn from(solid: Solid<'a>) -> Self {
        match solid {
            Solid::Sphere(sphere) => Self::Sphere(sphere),
            Solid::Plane(plane) => Self::Plane(plane),
            Solid::Cylinder(cylinder) => Self::Cylinder(cylinder),
            Solid::Cone(cone) => Self::Cone(cone),
            Solid::Ellipsoid(ellipsoid) => Self::Ellipsoid(ellipsoid),
            Solid::Quadric(quadric) => Self::Quadric(quadric),
            Solid::Torus(torus) => Self::Torus(torus),
            Solid::Cuboid(cuboid) => Self::Cuboid(cuboid),
            Solid::ConvexPolyhedron(polyhedron) => Self::ConvexPolyhedron(polyhedron),
        }
    }
}
