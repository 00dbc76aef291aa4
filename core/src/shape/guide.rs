//! Guide: how to write a shape of your own, and how much memory to lend to a scene.
//!
//! # A shape of your own
//!
//! Write a type for the description and a type for the prepared form, implement the three traits, and name
//! the description in a set of shapes. The kernel treats your shapes and the built-in ones alike. A bowl that
//! is open above:
//!
//! ```
//! use rayline::math::{Aabb, Extent, Interval, Ray, Scale};
//! use rayline::shape::{Geometry, Intersect, Plane, PreparedSphere, Silhouette, Sphere};
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
//!     /// The height at which the bowl ends.
//!     rim: R,
//! }
//!
//! impl Bowl {
//!     /// The bowl stores nothing beside its place in the list of objects: see below.
//!     pub const fn const_bytes<R: Real>(&self) -> usize {
//!         Arena::bytes::<R>(0)
//!     }
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
//!         // The sphere checks all numbers.
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
//! // The defaults will do. For scan conversion, `each_facet` then finds triangles by rays in a grid: if you
//! // know them, visit them yourself.
//! impl<R: Real> Silhouette<R> for PreparedBowl<R> {}
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
//! // From here on, a scene is made as always.
//! static OBJECTS: [Object<Table>; 2] = [
//!     Object::new(Table::Bowl(Bowl(Sphere::new(Vec3::new(0.0, 1.0, 0.0), 1.0))), 0),
//!     Object::new(Table::Top(Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0))), 1),
//! ];
//! // Memory for two objects, two materials, no lights, and nothing more: see below.
//! let mut memory = rayline::Workspace::<{ rayline::prepared_bytes::<f32, Table>(2, 2, 0, 0) }>::new();
//! # let camera = rayline::Camera {
//! #     eye: Vec3::new(0.0, 3.0, 4.0), target: Vec3::ZERO, up: Vec3::new(0.0, 1.0, 0.0), vertical_fov: 0.7,
//! #     lens: None,
//! # };
//! # let white = rayline::LinearRgb::WHITE;
//! # let materials = [rayline::Material::matte(white); 2];
//! # let background = white.into();
//! # let objects = &OBJECTS;
//! # let materials = &materials;
//! # let scene = rayline::Scene { camera, background, objects, materials, lights: &[], motions: &[] };
//! # assert!(rayline::PreparedScene::<f32, _>::new(&scene, memory.lend()).is_ok());
//! ```
//!
//! ## Rules
//!
//! - [`prepare`](super::Geometry::prepare) refuses every description that could fail later; [`Fault::Own`] is
//!   for reasons that no other fault names. It stores large data in the [`Arena`]; `const_bytes` and
//!   [`bytes`](super::Geometry::bytes) return the size of that data, by [`Arena::bytes`].
//! - [`intersect`](super::Intersect::intersect) takes a bounded number of steps, and returns the same
//!   distance whatever the range is. To keep digits, it computes from the point of the ray that is nearest to
//!   the shape ([`Ray::nearest_to`]).
//! - [`bounds`](super::Intersect::bounds) contains every hit: a distance whose point lies outside must not be
//!   returned.
//! - [`surface`](super::Intersect::surface) moves the point of the ray back onto the shape, and reports the
//!   largest number that the point was computed from: rays that leave the surface start at a distance that is
//!   derived from this number, so that they do not meet the same surface at once.
//! - With [`Fixed`], numbers lie between -128 and 128, and so must every sum and product. Scenes are scaled
//!   so that curved shapes ([`Extent::solid`]) lie within 1/2 of the origin along each axis, and flat ones
//!   ([`Extent::flat`]) within 8.
//!
//! # How much memory to lend
//!
//! The macro [`prepared_bytes!`](crate::prepared_bytes!) computes how many bytes
//! [`PreparedScene::new`](crate::PreparedScene::new) takes for a constant scene of any set of shapes. For
//! each shape the macro calls the method `const_bytes`, which returns the same number as
//! [`Geometry::bytes`](super::Geometry::bytes). This method is a `const fn` of the type itself, because a
//! trait cannot have a `const fn`. The example is a shape that stores a list:
//!
//! ```
//! # use rayline::math::{Aabb, Extent, Interval, Ray, Scale};
//! # use rayline::shape::{Intersect, Plane, Silhouette};
//! # use rayline::{Falloff, Surface};
//! use rayline::shape::{Geometry, Polygon};
//! use rayline::{
//!     Arena, Background, Camera, Fault, Lamp, Light, LinearRgb, Material, Object, PreparedScene, Real,
//!     Scene, Vec3, Workspace, prepared_bytes,
//! };
//!
//! /// Balls of one size, in a list.
//! #[derive(Clone, Copy, Debug, PartialEq)]
//! pub struct Beads {
//!     centers: &'static [Vec3],
//!     radius: f32,
//! }
//!
//! /// [`Beads`], prepared: the centers lie in the lent memory.
//! #[derive(Clone, Copy, Debug)]
//! pub struct PreparedBeads<'m, R: Real> {
//!     centers: &'m [Vec3<R>],
//!     radius: R,
//! }
//!
//! impl Beads {
//!     /// [`Geometry::bytes`], usable in constants.
//!     pub const fn const_bytes<R: Real>(&self) -> usize {
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
//!     fn prepare<'m, R: Real>(
//!         &self,
//!         scale: Scale,
//!         memory: &mut Arena<'m>,
//!     ) -> Result<PreparedBeads<'m, R>, Fault>
//!     where
//!         Self: 'm,
//!     {
//! #       if !(self.radius > 0.0) {
//! #           return Err(Fault::RadiusNotPositive);
//! #       }
//! #       if !self.reach().is_finite() {
//! #           return Err(Fault::NotFinite);
//! #       }
//! #       let scaled = |center: &Vec3| scale.point(center.to());
//! #       let center = |index| self.centers.get(index).map_or(Vec3::ZERO, scaled);
//!         // Takes no more than `bytes` says.
//!         let centers = memory.store_with(self.centers.len(), center)?;
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
//! #         let shorter = |a: Vec3<R>, b: Vec3<R>| if b.length() < a.length() { b } else { a };
//! #         let outward = outward.reduce(shorter);
//! #         let normal = outward.and_then(Vec3::normalized).unwrap_or(Vec3::ZERO);
//! #         Surface { point, normal, shading_normal: normal, magnitude: point.magnitude(), part: 0 }
//! #     }
//! #
//! #     fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
//! #         [surface.normal.x, surface.normal.y]
//! #     }
//! # }
//! #
//! # impl<R: Real> Silhouette<R> for PreparedBeads<'_, R> {}
//!
//! rayline::shape_set! {
//!     /// The shapes in a shop's window.
//!     pub enum Window<'a>;
//!     /// `Window`, prepared.
//!     pub enum PreparedWindow {
//!         /// Beads.
//!         Beads(Beads),
//!         /// The price tag.
//!         Tag(Polygon<'a>),
//!         /// The table.
//!         Top(Plane),
//!     }
//! }
//!
//! const BEADS: Beads =
//!     Beads { centers: &[Vec3::new(-1.0, 0.5, 0.0), Vec3::new(0.0, 0.5, 0.0)], radius: 0.5 };
//! const TAG: Polygon =
//!     Polygon::new(&[Vec3::new(1.0, 0.0, 0.0), Vec3::new(2.0, 0.0, 0.0), Vec3::new(1.5, 1.0, 0.0)]);
//! # const TOP: Plane = Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0));
//! # const CAMERA: Camera = Camera {
//! #     eye: Vec3::new(0.0, 3.0, 4.0), target: Vec3::ZERO, up: Vec3::new(0.0, 1.0, 0.0), vertical_fov: 0.7,
//! #     lens: None,
//! # };
//! # const FALLOFF: Falloff = Falloff::inverse_square(4.0);
//! # const LAMP: Lamp =
//! #     Lamp { position: Vec3::new(0.0, 4.0, 0.0), color: LinearRgb::WHITE, falloff: FALLOFF, cone: None };
//!
//! static SCENE: Scene<Window> = Scene {
//!     camera: CAMERA,
//!     background: Background::BLACK,
//!     objects: &[
//!         Object::new(Window::Beads(BEADS), 0),
//!         Object::new(Window::Tag(TAG), 0),
//!         Object::new(Window::Top(TOP), 0),
//!     ],
//!     materials: &[Material::matte(LinearRgb::WHITE)],
//!     lights: &[Light::Lamp(LAMP)],
//!     motions: &[],
//! };
//!
//! let mut memory = Workspace::<{ prepared_bytes!(f32, SCENE) }>::new();
//! # #[cfg(feature = "optics")]
//! assert!(PreparedScene::<f32, _>::new(&SCENE, memory.lend()).is_ok());
//! # let mut less = Workspace::<{ prepared_bytes!(f32, SCENE) - 1 }>::new();
//! # assert!(PreparedScene::<f32, _>::new(&SCENE, less.lend()).is_err());
//! ```
//!
//! If a scene is put together at run time, lend memory for the largest one: the function
//! [`prepared_bytes`](fn@crate::prepared_bytes) takes the numbers of objects, materials and lights, as the
//! three capacities of a [`SceneBuf`](crate::SceneBuf). Its last argument is the sum of what single items
//! take beyond that. Spheres, planes, discs, rectangles, cylinders, cones, tori, matte and shining materials,
//! point lights and backgrounds of one color take nothing more. Too little memory is refused with the number
//! of bytes that were needed ([`Fault::Memory`]).
//!
//! [`Arena`]: crate::Arena
//! [`Arena::bytes`]: crate::Arena::bytes
//! [`Extent::flat`]: crate::math::Extent::flat
//! [`Extent::solid`]: crate::math::Extent::solid
//! [`Fault::Memory`]: crate::Fault::Memory
//! [`Fault::Own`]: crate::Fault::Own
//! [`Fixed`]: crate::math::Fixed
//! [`Ray::nearest_to`]: crate::math::Ray::nearest_to
