//! Intersections: where a ray meets a sphere, a plane, a triangle, a box, a quadric and a torus, how many
//! digits of that are true, and why a ray that leaves a surface begins beside it.
//!
//! A shape answers two questions. At which distance along the ray is its nearest hit? And what is the surface
//! there: point, normal, and the size of the numbers that went into them? Each answer is a formula in t, the
//! distance from the ray's origin. The number system rounds it, so half of the work is to choose the formula
//! whose rounding is small.
//!
#![doc = concat!("![Quadrics](data:image/png;base64,", include_str!("pictures/shape-quadric.b64"), ")")]
//!
//! # The formulas
//!
//! The ray is o + t d, with the origin o, the unit direction d and t > 0, a length in units of the scene.
//! "Glassner" is Glassner (ed.), "An Introduction to Ray Tracing", 1989.
//!
//! ```text
//! sphere    |o + t d - c|² = r²                      center c, radius r (Glassner, ch. 2)
//!           m = -(o - c) · d                         distance to the point nearest to c
//!           n = (o - c) + m d                        that point, seen from c
//!           t = m ± √(r² - n · n)                    (Haines et al., Ray Tracing Gems, 2019, ch. 7)
//! plane     N · p = D                                unit normal N, distance D from the origin
//!           t = (D - N · o) / (N · d)                (Glassner, ch. 2)
//! triangle  e₁ = B - A, e₂ = C - A, a = |e₁ × e₂|    corners A, B, C; N = (e₁ × e₂) / a
//!           u = (p - A) · (e₂ × N) / a               weight of B
//!           v = (p - A) · (N × e₁) / a               weight of C; inside: u ≥ 0, v ≥ 0, u + v ≤ 1
//!                                                    (Havel and Herout, IEEE TVCG 2010, eqs. 4-9)
//! box       t from (-h - o) / d to (h - o) / d       one axis; half-width h, o from the center
//!           from the last entry to the first exit    of three axes (Kay and Kajiya, SIGGRAPH 1986)
//! quadric   a t² + 2 b t + c = 0                     a polynomial of 2nd degree, along the ray
//!           q = -(b ± √(b² - a c))                   the sign of b, so that nothing cancels
//!           t₁ = c / q, t₂ = q / a                   (Press et al., Numerical Recipes, §5.6)
//! torus     (p·p + R² - r²)² = 4 R² (p·p - (p·w)²)   radii R and r, unit axis w, p from the center
//!           s² - r² + R² (2 k² - 1) = α              s: distance of the line, k = d · w
//!           2 R² h k = β                             h: height of the line's point nearest to the center
//!           t³ + α t + β = 0                         where a quarter of the quartic's derivative is 0
//!                                                    (Glassner, ch. 3)
//! offset    o' = p ± N ε M                           origin of a ray that leaves p; M: largest number in
//!                                                    p's computation; ε: see below
//!                                                    (Wächter and Binder, Ray Tracing Gems, 2019, ch. 6)
//! ```
//!
//! # In the code
//!
//! | formula | where |
//! |---|---|
//! | a shape | [`Geometry`](crate::shape::Geometry), [`Intersect`](crate::shape::Intersect) |
//! | sphere | [`Sphere`](crate::shape::Sphere); `PreparedSphere::chord` in `shape/sphere.rs` |
//! | plane | [`Plane`](crate::shape::Plane); `PreparedPlane::meet` in `shape/plane.rs` |
//! | triangle | [`Triangle`](crate::shape::Triangle); its u and v in `shape/patch.rs` |
//! | box | [`Cuboid`](crate::shape::Cuboid); `Chord::between` in `shape/chord.rs` |
//! | quadric | [`Quadric`](crate::shape::Quadric); `Polynomial::roots` in `shape/quadric/polynomial.rs` |
//! | torus | [`Torus`](crate::shape::Torus) in `shape/torus.rs`; steps to a root in `math/roots.rs` |
//! | offset | [`Ray::spawn`](crate::math::Ray::spawn), ε is [`Real::RAY_OFFSET`](crate::Real::RAY_OFFSET) |
//! | first hit of a scene | [`PreparedScene::closest_hit`](crate::PreparedScene::closest_hit) |
//!
//! Differences from the textbook:
//!
//! - **The discriminant of a sphere** is taken at the point n. The textbook's b² - c subtracts two large
//!   squares: in `f32`, hits from 100 radii away are off by 0.3 % of the radius.
//! - **A hit is put back onto the shape** (`Surface::point`): a sphere's point is c + N r, a plane's is
//!   projected onto it. The error of a long ray then does not grow from bounce to bounce.
//! - **No smallest t.** Textbooks drop hits nearer than some 0.001, which is too much for a scene in
//!   millimeters and too little for a landscape. Here all t > 0 count, and the origin moves by ε M along the
//!   normal. ε is 1e-5 in `f32`, 1e-10 in `f64`, and 2⁻¹⁷ in fixed point, plus 16 units of 2⁻²⁴. With 1e-5,
//!   10.8 million rays spawned on spheres of radius 1e-3 to 1e6 never met their own surface. In floating
//!   point, balls of a radius above 1024 take a 13th of it, so that things on a huge ball throw their shadows
//!   on it.
//! - **A torus is solved by separation.** The roots of the cubic separate those of the quartic. Between two,
//!   Newton's steps run on the squared distance from the tube's circle, because the quartic loses the digits
//!   of a thin tube. Where a step does not converge, the interval is halved: 32 steps at most, usually five.
//! - **Fixed point** has 24 bits after the point, and the scene is scaled until its solids lie within half a
//!   unit of the origin. Squares and the numbers they are compared with keep 64 bits. A box compares its
//!   entries and exits as fractions, by products, so that it takes at most two divisions.
//! - **Touching is missing**: a ray that only touches a curved outline misses the shape.
//!
//! # Try it
//!
//! ```text
//! cargo run --release -- render docs/gallery/shape-quadric.ron --size 320x240
//! ```
//!
//! - Change the last of the tower's coefficients, -1, to 0: the waist shrinks to a point, and the hyperboloid
//!   becomes a double cone. With 0.2 it falls into two bowls with a gap between.
//! - Set the tower's `capped` to true: the ends are closed, and the tower is a solid.
//! - Give the saddle's box a `max` of (0.8, 0.2, 0.8): both raised ends are cut off level.
//!
//! Add `--number fixed`: about one color value in 800 changes, nearly always by one level of 255. On an
//! emulated board without an FPU, and with all scenes of the gallery at once on one with an FPU:
//!
//! ```text
//! cargo run --release -- convert docs/gallery/shape-quadric.ron quadric.rayline
//! cargo boards mps2-an385 --number fixed --scene quadric.rayline --picture quadric.png
//! cargo boards mps2-an386 --gallery
//! ```
//!
//! # Examples
//!
//! A box, a torus and a plane, met by parallel rays:
//!
//! ```
//! use rayline::math::{Interval, Ray};
//! use rayline::shape::{Cuboid, Plane, Shape, Torus};
//! # use rayline::{Background, Camera, LinearRgb, Material, Object, PreparedScene, Scene, Vec3};
//! # let (eye, target, up) = (Vec3::new(0.0, 0.0, 6.0), Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0));
//! let cube = Cuboid::aligned(Vec3::new(-1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, 1.0));
//! let (center, axis) = (Vec3::new(5.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0));
//! let torus = Torus { center, axis, major_radius: 1.0, minor_radius: 0.5 };
//! let wall = Plane::new(Vec3::new(0.0, 0.0, -2.0), Vec3::new(0.0, 0.0, 1.0));
//! let objects = [Shape::Cuboid(cube), Shape::Torus(torus), Shape::Plane(wall)];
//! let objects = objects.map(|shape| Object::new(shape, 0));
//! # let camera = Camera { eye, target, up, vertical_fov: 0.5, lens: None };
//! # let (background, materials) = (Background::BLACK, &[Material::matte(LinearRgb::WHITE)]);
//! # let scene = Scene { camera, background, objects: &objects, materials, lights: &[], motions: &[] };
//! # let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f64>()];
//! # let scene = PreparedScene::<f64, _>::new(&scene, &mut memory).unwrap();
//!
//! let d = Vec3::new(-0.1, 0.05, -1.0).to::<f64>().normalized().unwrap();
//! let meet = |o: Vec3<f64>| scene.closest_hit(&Ray { origin: o, direction: d }, Interval::AHEAD).unwrap();
//! let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-6, "{a}, not {b}");
//!
//! let o = Vec3::new(0.5, 0.25, 6.0);
//! let entry = |o: f64, d: f64| ((-1.0 - o) / d).min((1.0 - o) / d);
//! near(meet(o).t, entry(o.x, d.x).max(entry(o.y, d.y)).max(entry(o.z, d.z)));
//! let o = Vec3::new(5.5, 0.25, 6.0);
//! let p = o + d * meet(o).t - center.to();
//! near((p.dot(p) + 1.0 - 0.25).powi(2), 4.0 * (p.dot(p) - p.y * p.y));
//! let o = Vec3::new(-4.0, 0.25, 6.0);
//! near(meet(o).t, (-2.0 - o.z) / d.z);
//! assert_eq!([0.5, 5.5, -4.0].map(|x| meet(Vec3::new(x, 0.25, 6.0)).object), [0, 1, 2]);
//! ```
//!
//! The discriminant, on a ball of radius 1 that is 1,000 units away, in `f32`: hits of the textbook's formula
//! lie up to 0.16 beside the ball, those of the renderer up to 0.00025.
//!
//! ```
//! # use rayline::math::{Interval, Ray};
//! # use rayline::{Background, Camera, LinearRgb, Material, Object, PreparedScene, Scene, Vec3};
//! # use rayline::shape::{Shape, Sphere};
//! # let (eye, target, up) = (Vec3::new(0.0, 0.0, 6.0), Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0));
//! # let camera = Camera { eye, target, up, vertical_fov: 0.5, lens: None };
//! # let objects = [Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0)), 0)];
//! # let (background, materials) = (Background::BLACK, &[Material::matte(LinearRgb::WHITE)]);
//! # let scene = Scene { camera, background, objects: &objects, materials, lights: &[], motions: &[] };
//! # let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f32>()];
//! # let scene = PreparedScene::<f32, _>::new(&scene, &mut memory).unwrap();
//! let (o, mut textbook, mut renderer) = (Vec3::new(352.0, -48.0, 935.0f32), 0f64, 0f64);
//! for i in 0..100u8 {
//!     let aim = Vec3::new(f32::from(i) * 0.007, 0.1, 0.0);
//!     let d = (aim - o).normalized().unwrap();
//!     let (b, c) = (o.dot(d), o.dot(o) - 1.0);
//!     let beside = |t: f32| ((o.to::<f64>() + d.to::<f64>() * f64::from(t)).length() - 1.0).abs();
//!     textbook = textbook.max(beside(-b - (b * b - c).max(0.0).sqrt()));
//!     let hit = scene.closest_hit(&Ray { origin: o, direction: d }, Interval::AHEAD).unwrap();
//!     renderer = renderer.max(beside(hit.t));
//! }
//! assert!(renderer < 5e-4 && textbook > 0.05, "{renderer} and {textbook}");
//! ```
//!
//! # Exercises
//!
//! 1. Why does the plane need no square root, and the sphere none for the question whether it is met? *A
//!    plane is linear in t; a sphere is met if r² - n · n is positive, which is known before the root.*
//! 2. A ray begins inside a ball. Which of the two roots counts? *The second: the first is negative, and only
//!    t > 0 counts.*
//! 3. Suppose that ε were 1e-8 in `f32`. What would the lit side of a torus show? *Speckle: ε M is then below
//!    the rounding of the point, so that a third of the shadow rays begin inside and meet the torus again.*
