//! This chapter teaches soft shadows, depth of field, motion blur and blurred reflections: all of them are
//! means over many rays, and some of the means can be computed without rays.
//!
//! Cook, Porter and Carpenter ("Distributed Ray Tracing", SIGGRAPH 1984) found that the several samples of a
//! pixel can serve for more than edges. Sample i starts at another place on the lens, at another time, goes
//! on in another direction of a lobe, and sends shadow rays to another point of each lamp. The mean of all
//! samples then has every blur at once, and no effect multiplies the number of rays of another.
//!
//! # The formulas
//!
//! ```text
//! pixel         L = ∫ L(place, lens, time, lobes, lamps)  ≈  (1/k) Σ L(sample i),   i = 1 … k
//! ball lamp     E = e sin²α cos θ,           sin α = R / D
//! polygon lamp  E = e / 2π · Σ γi (N · mi)   over the edges i
//! ball in front E · (1 - A / π α²),          A = area that discs of radii α and β share
//! lens          C = 2 r |d - f| / d
//! motion        share = time in which the object covers the place / time in which the shutter is open
//! gloss         density ~ cosⁿ φ,            share inside of the angle φ = 1 - cosⁿ⁺¹ φ
//!               cos φ = (1 - u)^(1 / (n + 1)) for a number u spread over 0 to 1
//! ```
//!
//! k is the number of samples. E is the light of a white surface, e the emission of the lamp, both linear in
//! three channels; a surface that sees nothing but the lamp shows e. A ball of radius R at the distance D has
//! the angular radius α, and its middle stands at the angle θ from the normal N; a ball in front of it has
//! the angular radius β. γi is the angle that an edge spans, mi the normal of the plane through it and the
//! point (Lambert; Baum, Rushmeier and Winget, "Improving Radiosity Solutions", SIGGRAPH 1989). C is the
//! diameter of the circle of confusion in the plane in focus, r the radius of the aperture, f the distance in
//! focus, d that of the object, all in units of the scene (Potmesil and Chakravarty, "A Lens and Aperture
//! Camera Model", SIGGRAPH 1981). n is the exponent of the lobe, φ the angle to the mirrored or refracted
//! direction (Lafortune and Willems, "Using the Modified Phong Reflectance Model", 1994, eq. 10).
//!
//! # In the code
//!
//! | formula | item | file |
//! |---|---|---|
//! | lamps by rays | [`Light::Object`](crate::Light::Object) | `integrator/area_light.rs`, `light/area.rs` |
//! | lamps and balls in closed form | [`AreaLights`](crate::AreaLights) | `light/closed_form.rs` |
//! | lens | [`Lens`](crate::Lens), `Viewport::through_lens` | `lens.rs`, `camera.rs` |
//! | motion | [`Motion`](crate::Motion) | `motion/moved.rs` |
//! | gloss, translucency | [`Optics::gloss`](crate::Optics::gloss), `lobe` | `sampling/warp.rs` |
//! | a pair of numbers for each use | `Dimension` | `sampling/dimension.rs` |
//!
//! - **Numbers by name.** Each use has a number of its own: 0 the place, 1 the lens, 2 the time, three more
//!   for each bounce, and one for each lamp and bounce. Two uses never share a pair, so that no blur follows
//!   another one and makes a pattern.
//! - **Four rays for each lamp.** Cook sends one for each sample; here a hit sends 4
//!   ([`AREA_RAYS`](crate::limits::AREA_RAYS)). In a pixel of one sample a hit sends 16 where the first 4
//!   disagree, which makes a penumbra smooth, and narrower by a few percent of its width.
//! - **Rays move, not objects.** All rays of a sample have one time. A ray is moved back to where the object
//!   was described, and its hit is moved on to where the object is by then.
//! - **Lobes lose nothing.** The part of a lobe that lies behind the surface is turned around to the front.
//! - **Lenses that nobody sees** cost nothing: if all circles of confusion are smaller than half a pixel, the
//!   camera is a pinhole.
//! - **Closed forms** take one ray for each lamp, and have no noise. Errors are left: up to sin α / 20 where
//!   the horizon cuts a ball; light that two balls hide is taken off twice; only opaque balls throw soft
//!   shadows, in scenes of up to 32 objects. Tests hold the scene below, with matte materials, to a mean
//!   error of 0.002 and a largest one of 0.03.
//! - **Fixed point.** A flat lamp counts as at least an eighth of its radius away: nearer, its solid angle
//!   would be out of range.
//!
//! | two lamps among balls, one sample a pixel | rays | Cortex-M4F, `f32` | Cortex-M0, fixed |
//! |---|--:|--:|--:|
//! | points in place of lamps | 2.85 | 1,243 | 3,726 instructions |
//! | closed form | 2.89 | 4,930 | 26,069 |
//! | by rays | 11.40 | 11,770 | 49,365 |
//!
//! (docs/effects.md has these and the other effects. All need the feature `distributed`: 10 KB of flash, in
//! fixed point 22 KB.)
//!
//! # Try it
//!
//! `cargo run --release -- render docs/gallery/light-closed-form.ron -o lamps.png`
//!
#![doc = concat!("![Shadows](data:image/png;base64,", include_str!("pictures/light-closed-form.b64"), ")")]
//!
//! - `--area-lights sampled` draws the lamps by rays: the shadows agree, with noise, which `--samples 64`
//!   removes.
//! - Give the `"bulb"` the radius 0.1, not 0.4: its light falls to a sixteenth, and its shadows sharpen.
//! - `docs/gallery/camera-lens.ron` with `--samples 4` shows noise out of focus. With `focus: 4.5` the first
//!   ball is the sharp one. `camera-motion.ron`, `material-gloss.ron` and `material-translucent.ron` have the
//!   other effects.
//!
//! On an emulated board: `cargo run --release -- convert docs/gallery/light-closed-form.ron lamps.rayline`,
//! and then `cargo boards mps2-an386 --scene lamps.rayline --closed-form --picture board.png`.
//!
//! # Two tests, with the feature `distributed`
//!
//! A ball lamp with sin α = 0.2 and cos θ = 0.8 lights a white floor; then a ball with sin β = 0.1 stands in
//! the middle of the way, which takes off about (β / α)². Rays and closed form agree with both formulas:
//!
//! ```
//! use rayline::{AreaLights, Light, ObjectId, Sampler, Sampling, Settings};
//! # use rayline::{Background, Camera, LinearRgb, Material, Object, Optics, PreparedScene, Renderer, Scene};
//! # use rayline::{Vec3, shape::{Plane, Shape, Sphere}};
//! let ball = |center, radius, material| Object::new(Shape::Sphere(Sphere::new(center, radius)), material);
//! # let (eye, up) = (Vec3::new(0.0, 1.0, 3.0), Vec3::new(0.0, 1.0, 0.0));
//! # let camera = Camera { eye, target: Vec3::ZERO, up, vertical_fov: 0.001, lens: None };
//! # let (background, motions) = (Background::BLACK, &[]);
//! let emission = Optics { emission: LinearRgb::gray(10.0), ..Optics::PLAIN };
//! let white = Material::matte(LinearRgb::WHITE);
//! let materials = [white, Material { diffuse: 0.0, optics: Some(&emission), ..white }];
//! let toward = Vec3::new(0.6, 0.8, 0.0);
//! let floor = Object::new(Shape::Plane(Plane::new(Vec3::ZERO, up)), 0);
//! let objects = [ball(toward * 2.0, 0.4, 1), floor, ball(toward, 0.1, 0)];
//! let lights = &[Light::Object(ObjectId(0))];
//! # if cfg!(feature = "distributed") {
//! for (area_lights, bound) in [(AreaLights::ClosedForm, 1e-4), (AreaLights::Sampled, 2e-3)] {
//!     let covered = (0.1f64.asin() / 0.2f64.asin()).powi(2);
//!     for (objects, left) in [(&objects[..2], 1.0), (&objects[..], 1.0 - covered)] {
//!         let scene = Scene { camera, background, objects, materials: &materials, lights, motions };
//! #       let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f64>()];
//!         let sampling = Sampling { sampler: Sampler::Sobol, ..Sampling::new(1024) };
//!         let settings = Settings { sampling, area_lights, rays_per_pixel: 1 << 16, ..Settings::new(1, 1) };
//!         let prepared = PreparedScene::<f64, _>::new(&scene, &mut memory).unwrap();
//!         let light = Renderer::new(&prepared, settings).unwrap().pixel(0, 0, &mut ()).0.g;
//!         let expected = 10.0 * 0.2 * 0.2 * 0.8 * left;
//!         assert!((light - expected).abs() < bound, "{area_lights:?}: {light}, not {expected}");
//!     }
//! }
//! # }
//! ```
//!
//! Half a wall out of focus, whose edge lies at half the radius of the circle of confusion; a strip that
//! passes in 0.4 of the time; a lamp with tan φ = 1.5 / 4.1 around the direction of a glossy mirror:
//!
//! ```
//! use rayline::{Camera, Lens, Material, Motion, Optics, Sampler, Sampling, Scene, Settings};
//! # use rayline::{Background, LinearRgb, Object, PreparedScene, Renderer, Vec3};
//! # use rayline::shape::{Disc, Plane, Rectangle, Shape};
//! # let white = Material { ambient: 1.0, diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) };
//! let gloss = Optics { gloss: Some(10.0), ..Optics::PLAIN };
//! let materials = [white, Material { ambient: 0.0, reflectance: 1.0, optics: Some(&gloss), ..white }];
//! let seen = |lens, shapes: &[Shape], motions: &[Motion]| {
//! #   let (eye, target, up) = (Vec3::ZERO, Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.0, 1.0, 0.0));
//! #   let camera = Camera { eye, target, up, vertical_fov: 0.0005, lens };
//! #   let objects = shapes.iter().zip(0..).map(|(shape, material)| Object::new(*shape, material));
//! #   let objects: Vec<_> = objects.collect();
//! #   let (background, lights) = (Background::BLACK, &[]);
//! #   let scene = Scene { camera, background, objects: &objects, materials: &materials, lights, motions };
//! #   let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f64>()];
//! #   let prepared = PreparedScene::<f64, _>::new(&scene, &mut memory).unwrap();
//!     let sampling = Sampling { sampler: Sampler::Sobol, ..Sampling::new(1024) };
//!     let settings = Settings { sampling, ..Settings::new(1, 1) };
//!     Renderer::new(&prepared, settings).unwrap().pixel(0, 0, &mut ()).0.g
//! };
//! let strip = |left, width, z| {
//!     let corner = Vec3::new(left, -5.0, z);
//!     Shape::Rectangle(Rectangle::new(corner, Vec3::new(width, 0.0, 0.0), Vec3::new(0.0, 10.0, 0.0)))
//! };
//! # if cfg!(feature = "distributed") {
//! // C = 2 · 0.2 · 5 / 5 = 0.4 in focus, which is 0.2 on the wall at half the distance: the radius is 0.1.
//! let half = 0.5 + (0.5 * 0.75f64.sqrt() + 0.5f64.asin()) / core::f64::consts::PI;
//! assert!((seen(Some(Lens::round(0.2, 10.0)), &[strip(-4.95, 5.0, -5.0)], &[]) - half).abs() < 5e-3);
//! let motion = [Motion::of_object(0, Vec3::new(1.0, 0.0, 0.0))];
//! assert!((seen(None, &[strip(-0.7, 0.4, -5.0)], &motion) - 0.4).abs() < 5e-3);
//! let lamp = Disc::new(Vec3::new(0.0, 0.0, 0.1), Vec3::new(0.0, 0.0, 1.0), 1.5);
//! let mirror = Plane::new(Vec3::new(0.0, 0.0, -4.0), Vec3::new(0.0, 0.0, 1.0));
//! let share = 1.0 - (4.1 / 4.1f64.hypot(1.5)).powi(11);
//! assert!((seen(None, &[Shape::Disc(lamp), Shape::Plane(mirror)], &[]) - share).abs() < 5e-3);
//! # }
//! ```
//!
//! # Exercises
//!
//! 1. A lamp of radius 0.2 hangs 4 above an edge, which is 4 above the floor: how wide is the penumbra? *As
//!    wide as the lamp times 4 / 4, which is 0.4.*
//! 2. Why does a lens not blur what is in focus? *C is 0 there: the rays of all places on the lens meet in
//!    one point.*
//! 3. Which exponent puts half of a lobe inside of 10°? *44.3, because 1 - cosⁿ⁺¹ 10° = 1/2 gives n + 1 = ln
//!    2 / -ln cos 10° = 45.3.*
