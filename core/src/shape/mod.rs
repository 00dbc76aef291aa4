//! Shapes: what each must say of itself, and the set of those built in.
//!
//! A shape is two types: its description ([`Geometry`], `f32`, `const`) and its prepared form
//! ([`Intersect`], in the kernel's number system). The kernel is generic over the description's type, so it
//! contains the code of just the shapes that a scene's type names: a `Scene<Sphere>` links no polygon.
//! [`shape_set!`](crate::shape_set) makes a closed set out of any shapes, yours among them; [`Shape`] is
//! the set of all that are built in.
//!
//! # A shape of your own
//! Write its two types and name the first in a set: the kernel makes no difference between them and those of this crate.
//!
//! ```
//! use rayline::math::{Aabb, Extent, Interval, Ray, Scale};
//! use rayline::shape::{Geometry, Intersect, Plane, PreparedSphere, Sphere};
//! use rayline::{Arena, Fault, Object, Real, Surface, Vec3};
//!
//! /// The lower half of a sphere.
//! #[derive(Clone, Copy, Debug, PartialEq)]
//! pub struct Bowl(Sphere);
//!
//! /// [`Bowl`], prepared.
//! #[derive(Clone, Copy, Debug)]
//! pub struct PreparedBowl<R: Real> {
//!     sphere: PreparedSphere<R>,
//!     rim: R,
//! }
//!
//! impl Geometry for Bowl {
//!     type Prepared<'m, R: Real> = PreparedBowl<R>;
//!
//!     fn extent(&self) -> Extent {
//!         self.0.extent()
//!     }
//!
//!     fn prepare<'m, R: Real>(&self, scale: Scale, memory: &mut Arena<'m>) -> Result<PreparedBowl<R>, Fault>
//!     where
//!         Self: 'm,
//!     {
//!         // The sphere checks the numbers of both.
//!         let sphere = self.0.prepare(scale, memory)?;
//!         Ok(PreparedBowl { sphere, rim: scale.length(R::Setup::from_f32(self.0.center.y)) })
//!     }
//! }
//!
//! impl<R: Real> Intersect<R> for PreparedBowl<R> {
//!     fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
//!         let inside = self.sphere.spans(ray);
//!         let ends = inside.as_slice().iter().flat_map(|part| [part.min, part.max]);
//!         ends.filter(|t| range.contains(*t)).find(|t| ray.at(*t).y < self.rim)
//!     }
//!
//!     fn bounds(&self) -> Option<Aabb<R>> {
//!         let Aabb { min, max } = self.sphere.bounds()?;
//!         let rim = self.rim + R::offset(max.magnitude());
//!         Some(Aabb { min, max: Vec3::new(max.x, rim, max.z) })
//!     }
//!
//!     fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
//!         self.sphere.surface(ray, t)
//!     }
//!
//!     fn uv(&self, surface: &Surface<R>, scale: Scale) -> [R; 2] {
//!         self.sphere.uv(surface, scale)
//!     }
//! }
//!
//! rayline::shape_set! {
//!     /// Bowls on a table.
//!     pub enum Table;
//!     /// `Table`, prepared.
//!     pub enum PreparedTable {
//!         /// A bowl.
//!         Bowl(Bowl),
//!         /// The table.
//!         Top(Plane),
//!     }
//! }
//!
//! // As always from here on: see the crate's page.
//! static OBJECTS: [Object<Table>; 2] = [
//!     Object::new(Table::Bowl(Bowl(Sphere::new(Vec3::new(0.0, 1.0, 0.0), 1.0))), 0),
//!     Object::new(Table::Top(Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0))), 1),
//! ];
//! // For two objects, two materials, no lights, and nothing more: see below.
//! let mut memory = rayline::Workspace::<{ rayline::prepared_bytes::<f32, Table>(2, 2, 0, 0) }>::new();
//! # let camera = rayline::Camera {
//! #     eye: Vec3::new(0.0, 3.0, 4.0), target: Vec3::ZERO, up: Vec3::new(0.0, 1.0, 0.0), vertical_fov: 0.7,
//! # };
//! # let white = rayline::LinearRgb::WHITE;
//! # let materials = [rayline::Material::matte(white); 2];
//! # let scene = rayline::Scene { camera, background: white.into(), objects: &OBJECTS, materials: &materials, lights: &[] };
//! # assert!(rayline::PreparedScene::<f32, _>::new(&scene, memory.lend()).is_ok());
//! ```
//!
//! What it owes the kernel:
//!
//! - [`prepare`](Geometry::prepare) refuses what could fail later, with [`Fault::Own`] where no other fault says it. What is large
//!   goes into the [`Arena`], and [`bytes`](Geometry::bytes) tells how much that is ([`Arena::bytes`]).
//! - [`intersect`](Intersect::intersect) computes from the point of the ray that is nearest to the shape ([`Ray::nearest_to`]), in steps
//!   whose number is bounded, and gives the same distance whatever the range is.
//! - [`bounds`](Intersect::bounds) hold all that it gives, by definition: a distance whose point lies outside
//!   is no hit.
//! - [`surface`](Intersect::surface) moves the point back onto the shape, and tells the largest number that it was computed from: a ray
//!   that leaves there must not meet the shape at once.
//! - For [`Fixed`](crate::math::Fixed) no sum or product may exceed 128, where the scene was scaled so that curved shapes lie within 1/2.
//!
//! # How much memory to lend
//! For a scene of all built-in shapes, [`Scene::bytes`](crate::Scene::bytes) tells. For another set `S` it is
//! [`prepared_bytes::<R, S>(objects, materials, lights, more)`](crate::prepared_bytes): the first three numbers are how many there are, and
//! `more` is the sum of what single ones take beyond what each of its kind does, 0 for most scenes. These take more:
//!
//! - most shapes but spheres, planes, discs, rectangles, cylinders, cones and tori; materials with placed textures, optics or maps; lamps;
//!   backgrounds that are no solid color. Of those, [`Scene::part_bytes`](crate::Scene::part_bytes) tells the sum: make a constant of a
//!   `Scene` that has them, and no shape of your own.
//! - shapes of your own that store something in the [`Arena`]: as much as their [`bytes`](Geometry::bytes) says. Write it as a `const fn`, too.
//!
//! All of that is known when the program is built, so that it can be `static`:
//!
//! ```
//! # use rayline::math::{Aabb, Extent, Interval, Ray, Scale};
//! # use rayline::shape::{Intersect, Plane};
//! # use rayline::{Falloff, Surface};
//! use rayline::shape::{Geometry, Polygon, Shape};
//! use rayline::{
//!     Arena, Background, Camera, Fault, Lamp, Light, LinearRgb, Material, Object, PreparedScene, Real, Scene, Vec3,
//!     Workspace, prepared_bytes,
//! };
//!
//! /// Balls of one size, in a list.
//! #[derive(Clone, Copy, Debug, PartialEq)]
//! pub struct Beads {
//!     centers: &'static [Vec3],
//!     radius: f32,
//! }
//!
//! /// [`Beads`], prepared: the centers lie in the memory that is lent.
//! #[derive(Clone, Copy, Debug)]
//! pub struct PreparedBeads<'m, R: Real> {
//!     centers: &'m [Vec3<R>],
//!     radius: R,
//! }
//!
//! impl Beads {
//!     /// As [`Geometry::bytes`], in constants.
//!     const fn const_bytes<R: Real>(&self) -> usize {
//!         Arena::bytes::<Vec3<R>>(self.centers.len())
//!     }
//! #
//! #   fn reach(&self) -> f32 {
//! #       self.centers.iter().fold(0.0, |most: f32, center| most.larger(center.magnitude())) + self.radius
//! #   }
//! }
//!
//! impl Geometry for Beads {
//!     type Prepared<'m, R: Real> = PreparedBeads<'m, R>;
//!
//!     fn bytes<R: Real>(&self) -> usize {
//!         self.const_bytes::<R>()
//!     }
//! #
//! #   fn extent(&self) -> Extent {
//! #       Extent::solid(self.reach())
//! #   }
//!
//!     fn prepare<'m, R: Real>(&self, scale: Scale, memory: &mut Arena<'m>) -> Result<PreparedBeads<'m, R>, Fault>
//!     where
//!         Self: 'm,
//!     {
//! #       if !(self.radius > 0.0) {
//! #           return Err(Fault::RadiusNotPositive);
//! #       }
//! #       if !self.reach().is_finite() {
//! #           return Err(Fault::NotFinite);
//! #       }
//! #       let center = |index| self.centers.get(index).map_or(Vec3::ZERO, |center: &Vec3| scale.point(center.to()));
//!         let centers = memory.store_with(self.centers.len(), center)?; // takes no more than `bytes` says
//!         Ok(PreparedBeads { centers, radius: scale.length(R::Setup::from_f32(self.radius)) })
//!     }
//! }
//! #
//! # impl<R: Real> Intersect<R> for PreparedBeads<'_, R> {
//! #     fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
//! #         let met = |center: &Vec3<R>| {
//! #             let (from_center, advance) = ray.nearest_to(*center);
//! #             let room = self.radius * self.radius - from_center.length_squared();
//! #             let half = if room > R::ZERO { room.sqrt() } else { return None };
//! #             [advance - half, advance + half].into_iter().find(|t| range.contains(*t))
//! #         };
//! #         self.centers.iter().filter_map(met).reduce(|a, b| if b < a { b } else { a })
//! #     }
//! #
//! #     fn bounds(&self) -> Option<Aabb<R>> {
//! #         None
//! #     }
//! #
//! #     fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
//! #         let point = ray.at(t);
//! #         let outward = self.centers.iter().map(|center| point - *center);
//! #         let outward = outward.reduce(|a, b| if b.length_squared() < a.length_squared() { b } else { a });
//! #         let normal = outward.and_then(Vec3::normalized).unwrap_or(Vec3::ZERO);
//! #         Surface { point, normal, shading_normal: normal, magnitude: point.magnitude(), part: 0 }
//! #     }
//! #
//! #     fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
//! #         [surface.normal.x, surface.normal.y]
//! #     }
//! # }
//!
//! rayline::shape_set! {
//!     /// What lies in the shop's window.
//!     pub enum Window<'a>;
//!     /// `Window`, prepared.
//!     pub enum PreparedWindow {
//!         /// Beads.
//!         Beads(Beads),
//!         /// The price tag.
//!         Tag(Polygon<'a>),
//!         /// What all lies on.
//!         Top(Plane),
//!     }
//! }
//!
//! const BEADS: Beads = Beads { centers: &[Vec3::new(-1.0, 0.5, 0.0), Vec3::new(0.0, 0.5, 0.0)], radius: 0.5 };
//! const TAG: Polygon =
//!     Polygon::new(&[Vec3::new(1.0, 0.0, 0.0), Vec3::new(2.0, 0.0, 0.0), Vec3::new(1.5, 1.0, 0.0)]);
//! # const TOP: Plane = Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0));
//! # const CAMERA: Camera = Camera {
//! #     eye: Vec3::new(0.0, 3.0, 4.0), target: Vec3::ZERO, up: Vec3::new(0.0, 1.0, 0.0), vertical_fov: 0.7,
//! # };
//! # const LAMP: Lamp =
//! #     Lamp { position: Vec3::new(0.0, 4.0, 0.0), color: LinearRgb::WHITE, falloff: Falloff::inverse_square(4.0), cone: None };
//!
//! static OBJECTS: [Object<Window>; 3] =
//!     [Object::new(Window::Beads(BEADS), 0), Object::new(Window::Tag(TAG), 0), Object::new(Window::Top(TOP), 0)];
//! const MATERIALS: &[Material] = &[Material::matte(LinearRgb::WHITE)];
//! const LIGHTS: &[Light] = &[Light::Lamp(LAMP)];
//!
//! /// What takes more and is built in: the tag and the lamp.
//! const BUILT_IN: Scene = Scene {
//!     camera: CAMERA,
//!     background: Background::BLACK,
//!     objects: &[Object::new(Shape::Polygon(TAG), 0)],
//!     materials: MATERIALS,
//!     lights: LIGHTS,
//! };
//! const MORE: usize = BUILT_IN.part_bytes::<f32>() + BEADS.const_bytes::<f32>();
//! const BYTES: usize = prepared_bytes::<f32, Window>(OBJECTS.len(), MATERIALS.len(), LIGHTS.len(), MORE);
//!
//! let mut memory = Workspace::<BYTES>::new();
//! let scene = Scene {
//!     camera: CAMERA, background: Background::BLACK, objects: &OBJECTS, materials: MATERIALS, lights: LIGHTS,
//! };
//! # #[cfg(feature = "optics")]
//! assert!(PreparedScene::<f32, _>::new(&scene, memory.lend()).is_ok());
//! # let mut less = Workspace::<{ BYTES - 1 }>::new();
//! # assert!(PreparedScene::<f32, _>::new(&scene, less.lend()).is_err());
//! ```
//!
//! Where a scene is put together at run time, lend for the largest: with [`SceneBuf`](crate::SceneBuf), its three capacities. Too little is
//! refused, with the number that was needed ([`Fault::Memory`]).
//!
mod chord;
mod cone;
mod csg;
mod cuboid;
mod cylinder;
mod disc;
mod ellipsoid;
mod hull;
mod implicit;
mod instances;
mod mesh;
mod patch;
mod plane;
mod polygon;
mod polyhedron;
mod quadric;
mod rectangle;
mod set;
mod solid;
mod spans;
mod sphere;
#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;
mod torus;
mod triangle;
mod uv;

use core::fmt::Debug;

pub use crate::hierarchy::Node as BoxNode;
pub use cone::{Cone, PreparedCone};
pub use csg::{Csg, CsgStep, PreparedCsg};
pub use cuboid::{Cuboid, PreparedCuboid};
pub use cylinder::Cylinder;
pub use disc::{Disc, PreparedDisc};
pub use ellipsoid::{Ellipsoid, PreparedEllipsoid};
pub use hull::{Bend, Hull, Rim, Tip};
pub use implicit::{Blob, Distance, DistanceField, Implicit, Metaballs, PreparedImplicit, PreparedMetaballs};
pub use instances::{Instances, Model, Pose, PreparedInstances, PreparedModel};
pub use mesh::{BakedMesh, BakedParts, Mesh, PreparedMesh, SmallNormal};
pub use plane::{Plane, PreparedPlane};
pub use polygon::{Polygon, PreparedPolygon};
pub use polyhedron::{ConvexPolyhedron, PreparedPolyhedron};
pub use quadric::{PreparedQuadric, Quadric};
pub use rectangle::{PreparedRectangle, Rectangle};
pub use solid::{PreparedSolid, Solid};
pub use spans::Spans;
pub use sphere::{PreparedSphere, Sphere};
pub use torus::{PreparedTorus, Torus};
pub use triangle::{PreparedTriangle, Triangle};
pub(crate) use uv::globe;

use crate::arena::Arena;
use crate::fault::Fault;
use crate::math::{Aabb, Extent, FourRays, Interval, Product, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// The description of a shape: plain `f32` data, `Copy` and small.
pub trait Geometry: Copy + Debug {
    /// What the description becomes in the number system `R`; it may keep more in lent memory.
    type Prepared<'m, R: Real>: Intersect<R> + Copy + Debug + Send + Sync
    where
        Self: 'm;

    /// Of a set: what its shapes are called, in order. Bytes of scenes know a shape by its place among them.
    const NAMES: &'static [&'static str] = &[];

    /// The most bytes that [`prepare`](Self::prepare) takes from the memory that the caller lends.
    fn bytes<R: Real>(&self) -> usize {
        0
    }

    /// Whether it has an inside, so that it can be put together with others: then [`Intersect::spans`] tells it.
    fn is_solid(&self) -> bool {
        false
    }

    /// How far the shape extends, for scenes that are scaled into the range of a number system.
    fn extent(&self) -> Extent;

    /// Checks every number, scales the shape and converts it. All is computed in floating point
    /// ([`Real::Setup`]) and rounded last.
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
}

/// A shape that rays can meet.
pub trait Intersect<R: Real> {
    /// Whether [`each_rim`](Self::each_rim) visits any: where no shape of a program has some, nothing of them is linked.
    const HAS_RIMS: bool = false;

    /// The distance to the nearest hit inside `range`. Merely touching a curved outline is a miss.
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R>;

    /// As [`intersect`](Self::intersect) ahead of the origins of four rays, each up to its own `max`: a bit for each ray that is met,
    /// and the same distances to the bit; what stands in place of others says nothing. For processors that compute four numbers at
    /// once, in floating point: write it where much time goes to a shape.
    #[inline(always)]
    fn intersect_four(&self, rays: &FourRays<R>, max: &[R; 4]) -> (u32, [R; 4]) {
        rays.one_by_one(max, |ray, range| self.intersect(ray, range))
    }

    /// What is known of the shape beforehand, so that rays need not be tested against it in vain.
    fn form(&self) -> Form<R> {
        Form::Any
    }

    /// A box that holds every point that a ray can meet; `None` where there is none.
    ///
    /// No hit lies outside: where [`intersect`](Self::intersect) gives `t`, [`ray.at(t)`](Ray::at) lies in
    /// the box, but for [`Real::offset`] of the largest coordinate of that point and the ray's origin, by
    /// which the point is rounded. A hit that rounding puts elsewhere is none, however thin or long the shape
    /// is: what makes rays faster trusts the box, and pictures would differ with it and without.
    fn bounds(&self) -> Option<Aabb<R>>;

    /// What holds the shape, so that what is thin is known to be: by number 0 the whole of it. A shape of several parts, or one that no
    /// parallelepiped is close to, has more, numbered from 1 on, that hold it together; `None` for other numbers. Where a shape says
    /// nothing, its bounds hold it.
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        match self.form() {
            _ if part > 0 => None,
            Form::Ball { center, radius } => Some(Hull::ball(center, radius)),
            _ => self.bounds().map(Hull::aligned),
        }
    }

    /// Where the shape tapers off, so that what is thin there is known to be: numbered from 0 on, `None` for other numbers.
    fn tip(&self, _number: usize) -> Option<Tip<R>> {
        None
    }

    /// Visits the lines where a shape of many parts may end as it is seen, so that what is thin of it alone is known to be. Is
    /// asked where [`HAS_RIMS`](Self::HAS_RIMS) is set.
    fn each_rim(&self, _visit: impl FnMut(Rim<R>)) {}

    /// The parts of a ray's whole line that lie inside, also behind its origin. A shape that is not
    /// [solid](Geometry::is_solid) has none.
    fn spans(&self, _ray: &Ray<R>) -> Spans<R> {
        Spans::NONE
    }

    /// The surface at distance `t` of a ray, where [`intersect`](Self::intersect) gave `t`.
    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R>;

    /// The unit normal to shade with a small `step` along the surface away from a place of it, where the shape is curved: it tells how
    /// much. Where a shape says nothing, it is that of the place itself.
    fn normal_beside(&self, surface: &Surface<R>, _step: Vec3<R>) -> Vec3<R> {
        surface.shading_normal
    }

    /// The place of a surface in two numbers, for what is put on it: most often from 0 to 1 across all of it. Is asked
    /// only by textures that are placed so, and of points next to the surface as well. What has
    /// no bounds gives lengths in units of the scene, of which there are `scale` to one of `surface`
    /// ([`Scale::unscaled`]).
    fn uv(&self, surface: &Surface<R>, scale: Scale) -> [R; 2];
}

/// What is known of a shape beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form<R> {
    /// Nothing.
    Any,
    /// It is the surface of a ball and its normals point outward: a ray that leaves it outward never meets it
    /// again, and a ray that starts inside meets it before anything that lies outside.
    Ball {
        /// The middle.
        center: Vec3<R>,
        /// From there to the surface.
        radius: R,
    },
    /// It lies in the plane of all p with `normal · p = distance`: a ray that leaves it never meets it again.
    Flat {
        /// Unit normal.
        normal: Vec3<R>,
        /// Distance of the plane from the origin, along the normal.
        distance: R,
    },
}

impl<R> Form<R> {
    /// Whether a ray that leaves it to this side may meet it again.
    pub(crate) const fn is_met_again(&self, outward: bool) -> bool {
        match self {
            Self::Any => true,
            Self::Ball { .. } => !outward,
            Self::Flat { .. } => false,
        }
    }

    /// How often a ray meets it at most, if that is known.
    pub(crate) const fn most_hits(&self) -> Option<u8> {
        match self {
            Self::Any => None,
            Self::Ball { .. } => Some(2),
            Self::Flat { .. } => Some(1),
        }
    }

    /// Whether no part of a ray meets it where the whole does not, whatever is rounded. Where a search for roots begins elsewhere, it may
    /// find others.
    pub(crate) const fn is_missed_by_parts(&self) -> bool {
        self.most_hits().is_some()
    }
}

#[cfg(feature = "serde")]
crate::read::plain!(
    Sphere, Plane, Disc, Rectangle, Triangle, Cylinder, Cone, Ellipsoid, Quadric, Torus, Cuboid
);

crate::shape_set! {
    /// The set of all built-in shapes.
    pub enum Shape<'a>;
    /// [`Shape`] as the kernel sees it.
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
        /// A solid that is made of others.
        Csg(Csg<'a>),
        /// Balls that flow into each other.
        Metaballs(Metaballs<'a>),
        /// One of some of these shapes, in several places.
        Instances(Instances<'a>),
    }
}

impl Shape<'_> {
    /// [`Geometry::bytes`], usable in constants.
    pub(crate) const fn const_bytes<R: Real>(&self) -> usize {
        match self {
            Self::Triangle(triangle) => triangle.const_bytes::<R>(),
            Self::Polygon(polygon) => polygon.const_bytes::<R>(),
            Self::Ellipsoid(_) => Ellipsoid::const_bytes::<R>(),
            Self::Quadric(_) => Quadric::const_bytes::<R>(),
            Self::Cuboid(cuboid) => cuboid.const_bytes::<R>(),
            Self::ConvexPolyhedron(polyhedron) => polyhedron.const_bytes::<R>(),
            Self::Mesh(mesh) => mesh.const_bytes::<R>(),
            Self::Csg(csg) => csg.const_bytes::<R>(),
            Self::Metaballs(metaballs) => metaballs.const_bytes::<R>(),
            Self::Instances(instances) => instances.const_bytes::<R>(),
            Self::Sphere(_)
            | Self::Plane(_)
            | Self::Disc(_)
            | Self::Rectangle(_)
            | Self::Cylinder(_)
            | Self::Cone(_)
            | Self::Torus(_) => 0,
        }
    }
}

/// The box around points of a flat shape, with room for the rounding of a hit.
fn bounds_of<R: Real>(points: impl Iterator<Item = Vec3<R>>) -> Option<Aabb<R>> {
    let bounds = points.map(Aabb::point).reduce(Aabb::union)?;
    Some(bounds.padded(R::offset(bounds.magnitude())))
}

/// [`Intersect::normal_beside`] of a shape that tells the surface of points that lie beside it too.
fn beside<R: Real>(shape: &impl Intersect<R>, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
    let ray = Ray { origin: surface.point + step, direction: -surface.normal };
    shape.surface(&ray, R::ZERO).shading_normal
}

/// The point of a plane nearest to `point`, where `normal · p = distance` is the plane.
fn project_onto_plane<R: Real>(point: Vec3<R>, normal: Vec3<R>, distance: R) -> Vec3<R> {
    point - normal * (normal.dot_of_few(point) - distance)
}

/// How far a disc of radius 1 reaches along each coordinate axis, across the unit vector `normal`.
fn reach_across<R: Real>(normal: Vec3<R>) -> Vec3<R> {
    // √(y² + z²) is √(1 - x²), but not rounded to 0 where the normal lies almost along x.
    let hypotenuse = |a: R, b: R| (a.times(a) + b.times(b)).sqrt();
    let Vec3 { x, y, z } = normal;
    Vec3::new(hypotenuse(y, z), hypotenuse(z, x), hypotenuse(x, y))
}
