//! This chapter teaches how the nearest hit of a ray is found without a test of every object, and how a
//! picture is drawn without tracing every pixel.
//!
#![doc = concat!(
    "![A forest of instances, which lie in a hierarchy of boxes](data:image/png;base64,",
    include_str!("pictures/show-landscape.b64"),
    ")"
)]
//!
//! # The idea
//!
//! Whitted found in 1980 that up to 95 % of the time of a ray tracer goes into intersections. A picture of
//! *p* pixels with *r* rays each and *n* objects takes p · r · n tests, if every ray is tested against
//! every object. There are three ways to take fewer: test boxes first, so that most objects are never
//! tested; use the known origin of a ray, so that most objects cannot be in its way; and trace fewer pixels.
//!
//! # Boxes
//!
//! A ray **o** + *t* **d** is inside the slab between two planes across the x axis from t₁ to t₂, and inside
//! a box while it is inside all three slabs (Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986):
//!
//! ```text
//! t₁ = (min.x - o.x) / d.x        t₂ = (max.x - o.x) / d.x        the same for y and z
//!
//! enters = max over the axes of min(t₁, t₂)
//! leaves = min over the axes of max(t₁, t₂)
//!
//! the ray meets the box if  enters ≤ leaves  and  leaves ≥ 0
//! ```
//!
//! Boxes around boxes make a hierarchy (Rubin and Whitted, "A 3-Dimensional Representation for Fast Rendering
//! of Complex Scenes", SIGGRAPH 1980). With *w* boxes in a node, a ray that meets one object goes through
//! about log *n* / log *w* nodes: a scene of 820 balls takes five nodes of four boxes instead of 820 tests.
//!
//! A hierarchy is good if its boxes are small. The chance that a ray which meets a box also meets a smaller
//! one inside is the ratio of their surfaces, so a node is split where
//!
//! ```text
//! surface(left) · objects(left) + surface(right) · objects(right)
//! ```
//!
//! is least (Goldsmith and Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", IEEE CG&A
//! 1987).
//!
//! # Known origins
//!
//! - A camera ray of line *y* lies in the plane of that line. Objects have outlines in the picture, from
//!   which the objects that a line can show are computed (`render/outline`).
//! - A shadow ray runs between a surface and a light. For each pair of these, the objects that reach into the
//!   space around both are listed once (Haines and Greenberg, "The Light Buffer", IEEE CG&A 1986). A list is
//!   a word of 32 bits, one for each object.
//! - Rays of neighboring pixels go almost the same way: a beam around them goes through the hierarchy once
//!   for all (Reshetov, Soupikov and Hurley, "Multi-Level Ray Tracing Algorithm", SIGGRAPH 2005).
//!
//! # Fewer pixels
//!
//! Realtime quality traces every eighth pixel of every eighth line. Where two neighbors saw different things,
//! the pixel between them is traced too, and so on; where they saw the same, colors between are interpolated
//! (Akimoto, Mase and Suenaga, "Pixel-Selected Ray Tracing", IEEE CG&A 1991). A ray costs the same as before,
//! but most pixels have none. [`Realtime`](crate::Realtime) says what this gains and what can be lost.
//!
//! # In the code
//!
//! | idea | place |
//! |---|---|
//! | boxes against rays, in floating and fixed point | `hierarchy/slabs.rs`, `hierarchy/segment.rs` |
//! | building the hierarchy | `hierarchy/build.rs` |
//! | lists of what can be in the way | `prepared/candidates.rs` |
//! | outlines of objects in the picture | `render/outline` |
//! | beams of neighboring rays | `integrator/group`, `hierarchy/beam.rs` |
//! | fewer pixels | `render/realtime`, [`Realtime`](crate::Realtime) |
//!
//! Textbooks accept that a picture changes a little with its acceleration. This renderer does not: no box,
//! list or beam leaves out a hit, and of several hits at one distance the object with the lowest index
//! counts. So exact pictures have the same bytes with and without the features `candidates` and `hierarchy`.
//! The price is room: boxes are enlarged by the rounding of rays ([`Real::offset`](crate::Real::offset)), and
//! every shape promises that its hits lie in its box
//! ([`Intersect::bounds`](crate::shape::Intersect::bounds)).
//!
//! # By hand
//!
//! Eighty-one balls lie in a hierarchy of boxes. Asking every ball gives the same picture:
//!
//! ```
//! use rayline::shape::{Shape, Sphere};
//! use rayline::{
//!     Background, Camera, LinearRgb, Material, Object, PreparedScene, Renderer, Scene, Settings, Vec3,
//! };
//!
//! // Balls that only show their color: 0.25, 0.5 or 0.75.
//! let shown = |level| Material { ambient: 1.0, diffuse: 0.0, ..Material::matte(LinearRgb::gray(level)) };
//! let centers = (0..81u16).map(|i| {
//!     let (x, y) = (f32::from(i % 9) - 4.0, f32::from(i / 9) - 4.0);
//!     (Vec3::new(x, y, -f32::from(i % 5)), i % 3)
//! });
//! let ball = |(center, material)| Object::new(Shape::Sphere(Sphere::new(center, 0.6)), material);
//! let balls: Vec<_> = centers.clone().map(ball).collect();
//! let scene = Scene {
//!     camera: Camera {
//!         eye: Vec3::new(0.0, 0.0, 10.0),
//!         target: Vec3::ZERO,
//!         up: Vec3::new(0.0, 1.0, 0.0),
//!         vertical_fov: 0.9,
//!         lens: None,
//!     },
//!     background: Background::BLACK,
//!     objects: &balls,
//!     materials: &[shown(0.25), shown(0.5), shown(0.75)],
//!     lights: &[],
//!     motions: &[],
//! };
//! let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f32>()];
//! let prepared = PreparedScene::<f32, _>::new(&scene, &mut memory)?;
//! let renderer = Renderer::new(&prepared, Settings::new(20, 20))?;
//!
//! for (x, y) in (0..20u16).flat_map(|y| (0..20u16).map(move |x| (x, y))) {
//!     // The ray through the center of the pixel.
//!     let half = (0.9f32 / 2.0).tan();
//!     let at = |pixel: u16| ((f32::from(pixel) + 0.5) / 10.0 - 1.0) * half;
//!     let way = Vec3::new(at(x), -at(y), -1.0);
//!     let way = way * way.length().recip();
//!     let nearest = centers.clone().filter_map(|(center, material)| {
//!         let from = scene.camera.eye - center;
//!         let (middle, square) = (-from.dot(way), from.dot(from) - 0.6 * 0.6);
//!         let root = middle * middle - square;
//!         (root > 0.0).then(|| (middle - root.sqrt(), material))
//!     });
//!     let expected = nearest
//!         .min_by(|(a, _), (b, _)| a.total_cmp(b))
//!         .map_or(0.0, |(_, material)| f32::from(material + 1) * 0.25);
//!     assert_eq!(renderer.pixel(x, y, &mut ()).0.r, expected, "pixel {x}, {y}");
//! }
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # Try it
//!
//! ```text
//! cargo run --release -- render docs/gallery/show-landscape.ron
//! cargo run --release -- render docs/gallery/show-landscape.ron --mode realtime
//! cargo run --release -- check docs/gallery/show-landscape.ron
//! ```
//!
//! The first two print their time and their rays; the third estimates both for boards. `rayline bench` draws
//! how the time grows with the number of objects.
//!
//! # Exercises
//!
//! 1. Which box is best around a long, thin cylinder that lies across the axes? *None along the axes is good:
//!    most of the box is empty, and rays through the empty part are tested against the cylinder in vain.*
//! 2. Why do both neighbors have to see the same shadows before the pixels between them are interpolated?
//!    *The edge of a shadow on one object lies between them otherwise.*
//! 3. A box is tested with d.x = 0. Which numbers are t₁ and t₂? *Both are infinite; their signs say whether
//!    the origin lies in the slab, and are equal if it does not.*
