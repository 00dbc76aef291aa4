//! The set of all built-in shapes that instances can save memory for.

use super::super::{ConvexPolyhedron, Csg, Mesh, Metaballs, Polygon, Quadric, Shape};

crate::shape_set! {
    /// The set of models of [`Instances`](super::Instances), unless you name a set of your own: all built-in
    /// shapes that borrow their description, and quadrics, whose box cannot be turned in another way. Other
    /// shapes are simply described again in another place.
    pub enum Model<'a>;
    /// [`Model`], prepared.
    pub enum PreparedModel {
        /// A planar polygon.
        Polygon(Polygon<'a>),
        /// A quadric in a box, open or capped.
        Quadric(Quadric),
        /// A convex solid with flat faces.
        ConvexPolyhedron(ConvexPolyhedron<'a>),
        /// A mesh of triangles.
        Mesh(Mesh<'a>),
        /// A solid that is combined from other solids.
        Csg(Csg<'a>),
        /// Balls that flow into each other.
        Metaballs(Metaballs<'a>),
    }
}

impl<'a> From<Model<'a>> for Shape<'a> {
    fn from(model: Model<'a>) -> Self {
        match model {
            Model::Polygon(polygon) => Self::Polygon(polygon),
            Model::Quadric(quadric) => Self::Quadric(quadric),
            Model::ConvexPolyhedron(polyhedron) => Self::ConvexPolyhedron(polyhedron),
            Model::Mesh(mesh) => Self::Mesh(mesh),
            Model::Csg(csg) => Self::Csg(csg),
            Model::Metaballs(metaballs) => Self::Metaballs(metaballs),
        }
    }
}
