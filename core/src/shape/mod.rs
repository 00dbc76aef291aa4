//! Shapes: the traits that every shape implements, the built-in shapes, and sets of shapes.
//!
//! A shape is two types: its description ([`Geometry`], `f32`, `const`) and its prepared form ([`Intersect`]
//! and [`Silhouette`], in the kernel's number system). The kernel is generic over the description, so a
//! program contains the code of the shapes that its scenes name and of no others: a `Scene<Sphere>` links no
//! polygon. The macro [`shape_set!`](crate::shape_set) makes one shape out of several; [`Shape`] is the set
//! of all built-in shapes.
//!
//! To add a shape of your own, implement these traits; each has one impl, and the third is empty:
//!
//! | trait | for | methods to write |
//! |---|---|---|
//! | [`Geometry`] | the description | `extent`, `prepare` |
//! | [`Intersect`] | the prepared form | `intersect`, `bounds`, `surface`, `uv` |
//! | [`Silhouette`] | the prepared form | none: the defaults work |
//!
//! [The guide](guide) has a complete example, and tells how much memory to lend to a scene.

mod chord;
mod circle;
mod clip;
mod cone;
mod csg;
mod cuboid;
mod cylinder;
mod disc;
mod ellipsoid;
mod facet;
#[cfg(test)]
mod facet_tests;
mod form;
pub mod guide;
mod implicit;
mod instances;
mod luminaire;
mod marching;
mod mesh;
mod patch;
mod plane;
mod polygon;
mod polyhedron;
mod quadric;
mod rectangle;
mod set;
mod silhouette;
mod solid;
mod spans;
mod sphere;
mod tessellate;
#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;
mod torus;
mod trapezoids;
mod triangle;
mod uv;

use core::fmt::Debug;

pub use crate::hierarchy::Node as BoxNode;
pub(crate) use clip::{cut, list};
pub use cone::{Cone, PreparedCone};
pub use csg::{Csg, CsgStep, PreparedCsg};
pub use cuboid::{Cuboid, PreparedCuboid};
pub use cylinder::Cylinder;
pub use disc::{Disc, PreparedDisc};
pub use ellipsoid::{Ellipsoid, PreparedEllipsoid};
pub use facet::{Facet, Tessellation};
pub use form::Form;
pub use implicit::{Blob, Distance, DistanceField, Implicit, Metaballs, PreparedImplicit, PreparedMetaballs};
pub use instances::{Instances, Model, Pose, PreparedInstances, PreparedModel};
pub use luminaire::Luminaire;
pub use mesh::{BakedMesh, BakedParts, Mesh, PreparedMesh, SmallNormal};
pub use plane::{Plane, PreparedPlane};
pub use polygon::{Polygon, PreparedPolygon};
pub use polyhedron::{ConvexPolyhedron, PreparedPolyhedron};
pub use quadric::{PreparedQuadric, Quadric};
pub use rectangle::{PreparedRectangle, Rectangle};
pub use silhouette::{Bend, Hull, Rim, Silhouette, Tip};
pub use solid::{PreparedSolid, Solid};
pub use spans::Spans;
pub use sphere::{PreparedSphere, Sphere};
pub use torus::{PreparedTorus, Torus};
pub use triangle::{PreparedTriangle, Triangle};
pub(crate) use uv::globe;

use crate::arena::Arena;
use crate::color::LinearRgb;
use crate::fault::Fault;
use crate::math::{Aabb, Extent, FourRays, Interval, Product, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// The description of a shape: plain `f32` data, `Copy` and small.
pub trait Geometry: Copy + Debug {
    /// The prepared form in the number system `R`. It may refer to more data in the lent memory.
    type Prepared<'m, R: Real>: Intersect<R> + Silhouette<R> + Copy + Debug + Send + Sync
    where
        Self: 'm;

    /// The names of a set's shapes, in order; empty for a single shape. Scenes in bytes identify a shape by
    /// its index in this list.
    const NAMES: &'static [&'static str] = &[];

    /// How far the shape extends. Scenes are scaled by it into the range of the number system.
    fn extent(&self) -> Extent;

    /// Checks every number, scales the shape and converts it. Compute in floating point ([`Real::Setup`]) and
    /// round last.
    ///
    /// # Errors
    /// A [`Fault`] that says what is wrong with the description.
    fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<Self::Prepared<'m, R>, Fault>
    where
        Self: 'm;

    /// The most bytes that [`prepare`](Self::prepare) takes from the lent memory: 0 by default.
    fn bytes<R: Real>(&self) -> usize {
        0
    }

    /// Whether the shape has an inside, so that it can be a part of a [`Csg`]; then [`Intersect::spans`] must
    /// be written, too. `false` by default.
    fn is_solid(&self) -> bool {
        false
    }

    /// The surface by which the shape can light a scene, see [`Light::Object`](crate::Light::Object). `None`
    /// by default.
    fn luminaire(&self) -> Option<Luminaire> {
        None
    }
}

/// A prepared shape, which rays can meet.
pub trait Intersect<R: Real> {
    /// Whether [`Surface::shading_normal`] may differ from [`Surface::normal`]: then mirrored rays are kept
    /// out of the body. `false` by default.
    const IS_SMOOTHED: bool = false;

    /// The distance to the nearest hit inside `range`. A ray that merely touches a curved outline misses the
    /// shape.
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R>;

    /// A box that contains every hit of the shape; `None` if the shape has no end.
    ///
    /// If [`intersect`](Self::intersect) returns `t`, then [`ray.at(t)`](Ray::at) must lie in the box, or no
    /// farther outside than its rounding: [`Real::offset`] of the largest coordinate of that point and of the
    /// ray's origin. This holds for thin and for long shapes, too: if rounding puts a hit elsewhere, it must
    /// not be returned. Acceleration relies on the box, and without this rule pictures would change with it.
    fn bounds(&self) -> Option<Aabb<R>>;

    /// The surface at distance `t` along a ray, where [`intersect`](Self::intersect) returned `t`.
    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R>;

    /// Whether the ray meets the front of the surface at distance `t`, where [`intersect`](Self::intersect)
    /// returned `t`.
    fn is_front(&self, ray: &Ray<R>, t: R) -> bool {
        !(self.surface(ray, t).normal.dot(ray.direction) > R::ZERO)
    }

    /// The coordinates u and v of a place on the surface, for textures: most often from 0 to 1 across the
    /// whole shape. Only textures that are placed by u and v call it, also for points beside the surface. A
    /// shape without bounds returns lengths in units of the scene, of which there are `scale` to one of
    /// `surface` ([`Scale::unscaled`]).
    fn uv(&self, surface: &Surface<R>, scale: Scale) -> [R; 2];

    /// Whether surfaces of the shape may lie beside the places where rays meet it, as those of a mesh with a
    /// smooth terminator do. No transparent material may have such a shape. `false` by default.
    fn is_lifted(&self) -> bool {
        false
    }

    /// Whether the shape has colors of its own, as a mesh with colors at its vertices has: then
    /// [`tint`](Self::tint) is called. `false` by default.
    fn is_tinted(&self) -> bool {
        false
    }

    /// The color of the shape itself at a place on its surface, by which the color of the material is
    /// multiplied. White by default.
    fn tint(&self, _surface: &Surface<R>) -> LinearRgb<R> {
        LinearRgb::even(R::ONE)
    }

    /// The kind of the shape, if it is a ball or flat: then some rays need not be tested. By default nothing
    /// is known.
    fn form(&self) -> Form<R> {
        Form::Any
    }

    /// The parts of a ray's whole line that lie inside the shape, also those behind the origin. None by
    /// default, as for shapes that are not [solid](Geometry::is_solid).
    fn spans(&self, _ray: &Ray<R>) -> Spans<R> {
        Spans::NONE
    }

    /// [`intersect`](Self::intersect) for four rays, each ahead of its origin and up to its own `max`.
    /// Returns a bit for each ray that meets the shape, and the distances, which are the same to the bit; the
    /// distance of a ray that misses is arbitrary. Only processors that compute four floating-point numbers
    /// at once call it. By default the rays are tested one by one: write it for a shape that takes much of
    /// the time.
    #[inline]
    fn intersect_four(&self, rays: &FourRays<R>, max: &[R; 4]) -> (u32, [R; 4]) {
        rays.one_by_one(max, |ray, range| self.intersect(ray, range))
    }
}

#[cfg(feature = "serde")]
crate::read::plain!(
    Sphere, Plane, Disc, Rectangle, Triangle, Cylinder, Cone, Ellipsoid, Quadric, Torus, Cuboid
);

crate::shape_set! {
    /// The set of all built-in shapes.
    pub enum Shape<'a>;
    /// [`Shape`], prepared.
    pub enum PreparedShape {
        /// A sphere.
        Sphere(Sphere),
        /// An infinite plane.
        Plane(Plane),
        /// A disc or ring.
        Disc(Disc),
        /// A rectangle or parallelogram.
        Rectangle(Rectangle),
        /// A triangle.
        Triangle(Triangle),
        /// A planar polygon.
        Polygon(Polygon<'a>),
        /// A cylinder, open or capped.
        Cylinder(Cylinder),
        /// A cone or frustum, open or capped.
        Cone(Cone),
        /// An ellipsoid.
        Ellipsoid(Ellipsoid),
        /// A quadric in a box, open or capped.
        Quadric(Quadric),
        /// A torus.
        Torus(Torus),
        /// A box, along the axes or not.
        Cuboid(Cuboid),
        /// A convex solid with flat faces.
        ConvexPolyhedron(ConvexPolyhedron<'a>),
        /// A mesh of triangles.
        Mesh(Mesh<'a>),
        /// A solid that is combined from other solids.
        Csg(Csg<'a>),
        /// Balls that flow into each other.
        Metaballs(Metaballs<'a>),
        /// A shape in several places.
        Instances(Instances<'a>),
    }
}

/// Shapes that take no memory beside their place in the list of objects.
macro_rules! takes_no_memory {
    ($($Type:ty),+) => {
        $(impl $Type {
            /// [`Geometry::bytes`], usable in constants.
            pub const fn const_bytes<R: Real>(&self) -> usize {
                0
            }
        })+
    };
}

takes_no_memory!(Sphere, Plane, Disc, Rectangle, Cylinder, Cone, Torus);

/// The box around the points of a flat shape, padded by the rounding of a hit.
fn bounds_of<R: Real>(points: impl Iterator<Item = Vec3<R>>) -> Option<Aabb<R>> {
    let bounds = points.map(Aabb::point).reduce(Aabb::union)?;
    Some(bounds.padded(R::offset(bounds.magnitude())))
}

/// [`Silhouette::normal_beside`] of a shape whose [`Intersect::surface`] also works for points beside the
/// surface.
fn normal_after_step<R: Real>(shape: &impl Intersect<R>, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
    let ray = Ray { origin: surface.point + step, direction: -surface.normal };
    shape.surface(&ray, R::ZERO).shading_normal
}

/// The point of the plane `normal · p = distance` that is nearest to `point`.
pub(crate) fn project_onto_plane<R: Real>(point: Vec3<R>, normal: Vec3<R>, distance: R) -> Vec3<R> {
    point - normal * (normal.dot_sparse(point) - distance)
}

/// How far a disc of radius 1 with this unit normal reaches along each coordinate axis.
fn reach_across<R: Real>(normal: Vec3<R>) -> Vec3<R> {
    // √(1 - x²) would be rounded to 0 for a normal that is almost parallel to x; √(y² + z²) is not.
    let hypotenuse = |a: R, b: R| (a.times(a) + b.times(b)).sqrt();
    let Vec3 { x, y, z } = normal;
    Vec3::new(hypotenuse(y, z), hypotenuse(z, x), hypotenuse(x, y))
}
