//! This chapter teaches how a pixel gets its color from few rays: what goes wrong with one, where to put
//! more, how to weigh them, and when to stop.
//!
//! A pixel is an area, but a ray sees a point. One ray for each pixel turns edges into stairs and fine
//! patterns into coarse ones that are not there: *aliasing*. More rays, spread over the area, approximate its
//! mean. Their places decide which error is left: regular places leave patterns, random places leave noise,
//! and places that are irregular but even leave little of either.
//!
//! # The formulas
//!
//! ```text
//! aliasing        f periods a pixel, sampled once a pixel, look like |f - round(f)| periods a pixel
//! pixel           L = ∫ w(x) L(x) dx  ≈  (1/n) Σ L(xi),   xi with the density w
//! random          error = √(s (1 - s) / n)         at an edge that covers the share s of a pixel
//! jittered        error = √(p (1 - p) √n) / n      at an upright edge, in √n × √n cells, p = frac(s √n)
//! R2              xi = frac(x0 + i / g),   yi = frac(y0 + i / g²),   g³ = g + 1,   g = 1.32471…
//! box, tent       w = 1 for |x| < 1/2;     w = 1 - |x| for |x| < 1
//! Gaussian        w ~ exp(-2 x²) for |x| < 3/2
//! adaptive        more samples where (max - min) / (max + min) > 0.3
//! ```
//!
//! x is the distance from the center of a pixel in pixels; w is written for one axis, and the weight of a
//! place is the product of those of both axes. n is the number of samples, the error a standard deviation,
//! frac the part behind the point, max and min those of the light of the first samples. (Aliasing, random,
//! jittered, Poisson: Cook, "Stochastic Sampling in Computer Graphics", ACM TOG 1986, and his chapter 5 of
//! Glassner (ed.), "An Introduction to Ray Tracing", 1989. R2: Roberts, "The Unreasonable Effectiveness of
//! Quasirandom Sequences", 2018. Adaptive: Mitchell, "Generating Antialiased Images at Low Sampling
//! Densities", 1987.)
//!
//! # The six distributions
//!
//! | [`Sampler`](crate::Sampler) | places | error at 1, 16 and 256 samples | slope |
//! |---|---|--:|--:|
//! | `Random` | each by itself: noise and clusters | 5.4 %, 1.83 %, 0.49 % | -0.49 |
//! | `Grid` | centers of cells, alike in all pixels: steps at edges | 5.4 %, 1.24 %, 0.15 % | -0.65 |
//! | `Jittered` | one in each cell | 5.4 %, 1.01 %, 0.11 % | -0.77 |
//! | `Poisson` | none near another | 5.4 %, 1.00 %, 0.18 % | -0.65 |
//! | `R2` | a sequence that fills gaps, shifted in each pixel | 5.4 %, 1.00 %, 0.11 % | -0.77 |
//! | `Sobol` | a net: one in each box of many shapes, scrambled | 5.4 %, 0.70 %, 0.08 % | -0.79 |
//!
//! The root mean square error of the scene `classic`, in linear light, falls as n to the power of the slope;
//! the command `cargo run --release -- bench --convergence error.svg` measures the table and draws it. Random
//! samples keep to -1/2. Edges limit all others to about -3/4 (Mitchell, "Consequences of Stratified Sampling
//! in Graphics", 1996).
//!
//! # In the code
//!
//! | formula | item | file |
//! |---|---|---|
//! | R2, random | [`Sampling`](crate::Sampling), `PixelSample::pair` | `sampling/mod.rs` |
//! | grid, jittered | `grid`, `jittered` | `sampling/strata.rs` |
//! | Poisson, Sobol | `point` | `sampling/poisson.rs`, `sampling/sobol.rs` |
//! | filters | [`Reconstruction`](crate::Reconstruction) | `sampling/reconstruction.rs` |
//! | adaptive | [`Adaptive`](crate::Adaptive), `Spread` | `render/pixel.rs` |
//! | the mean | `Renderer::add_sample` | `render/pixel.rs` |
//!
//! - **No generator, no state.** A number is a pure function of pixel, sample, use and seed, in 65536ths. So
//!   lines can be drawn in any order and on any core, and all number systems have the same samples.
//! - **Filters without neighbors.** A textbook weighs the samples of several pixels. Here the samples lie as
//!   densely as w (Ernst, Stamminger and Greiner, "Filter Importance Sampling", 2006) and count alike, so
//!   that no frame buffer is needed. The Gaussian is a table of 65 quantiles.
//! - **A Poisson disk that is stored.** Dart throwing repeats until a point fits. Here a tile of 256 points,
//!   512 bytes, is shifted in each pixel; each point is the farthest of many candidates from those before it.
//! - **Adaptive without subdivision.** [`Adaptive::at_first`](crate::Adaptive) samples come first (4). If
//!   they met different objects, facets or shadows, or if their contrast is above 0.3 in green, 0.4 in red or
//!   0.6 in blue light, all others follow. Nothing is split recursively, and `samples` bounds the time.
//! - **Fixed point** weighs each sample before it adds it, because the sum of many may overflow.
//! - **One sample** lies in the center of the pixel. For this place, the outlines in the picture give the
//!   objects that the sample can show. R2 and the box are in every build; all else needs the feature
//!   `distributed`.
//!
//! # Try it
//!
//! `cargo run --release -- render docs/gallery/texture-checker.ron --samples 16 -o checkers.png`
//!
#![doc = concat!("![Checkers](data:image/png;base64,", include_str!("pictures/texture-checker.b64"), ")")]
//!
//! - Write `cells_per_unit: (40, 40, 40)` for `"checkered"`. `--samples 1` shows spots and rings that the
//!   checkers do not have; 16 samples show a color that is nearly even, with fainter rings.
//! - `--sampler grid` and `--sampler random` beside the default R2: patterns, and noise.
//! - `--filter gaussian` shows softer edges, `--filter box` the sharpest.
//! - `--samples 64 --adaptive --show samples` in the scene as it was draws how many samples each pixel takes:
//!   white lines along edges and shadows.
//!
//! `cargo boards mps2-an386 --gallery` draws all scenes of the gallery on an emulated board. Its program
//! takes one sample a pixel, whatever a scene says, so its pictures show the aliasing.
//!
//! # Two tests
//!
//! A white wall covers 0.3 of each of 512 pixels, but not their centers: one sample shows black. With 16, R2
//! gives every pixel a share that its formula gives for some shift, and no other:
//!
//! ```
//! use rayline::{Sampling, Settings};
//! # use rayline::{Background, Camera, LinearRgb, Material, Object, PreparedScene, Renderer, Scene, Vec3};
//! # use rayline::shape::{Rectangle, Shape};
//! # fn column(share: f32, sampling: Sampling) -> Vec<f32> {
//! #     let (eye, target, up) = (Vec3::ZERO, Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.0, 1.0, 0.0));
//! #     let pixel = 2.0 * 0.25f32.tan() / 512.0;
//! #     let corner = Vec3::new((share - 0.5) * pixel - 1.0, -1.0, -1.0);
//! #     let wall = Rectangle::new(corner, Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 2.0, 0.0));
//! #     let white = Material { ambient: 1.0, diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) };
//! #     let (objects, materials) = ([Object::new(Shape::Rectangle(wall), 0)], [white]);
//! #     let camera = Camera { eye, target, up, vertical_fov: 0.5, lens: None };
//! #     let (background, lights, motions) = (Background::BLACK, &[], &[]);
//! #     let scene = Scene { camera, background, objects: &objects, materials: &materials, lights, motions };
//! #     let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f64>()];
//! #     let prepared = PreparedScene::<f64, _>::new(&scene, &mut memory).unwrap();
//! #     let renderer = Renderer::new(&prepared, Settings { sampling, ..Settings::new(1, 512) }).unwrap();
//! #     (0..512).map(|y| renderer.pixel(0, y, &mut ()).0.g as f32).collect()
//! # }
//! assert!(column(0.3, Sampling::new(1)).iter().all(|light| *light == 0.0));
//! let g = 1.324_717_957_f64; // g³ = g + 1
//! let covered = |shift: f64| (0..16).filter(|i| (shift + f64::from(*i) / g).fract() < 0.3).count();
//! let by_formula: Vec<_> = (0..1000).map(|step| covered(f64::from(step) / 1000.0) as f32 / 16.0).collect();
//! let drawn = column(0.3, Sampling::new(16));
//! assert!(drawn.iter().all(|light| by_formula.contains(light)));
//! assert!(by_formula.iter().all(|light| drawn.contains(light)));
//! ```
//!
//! With the feature `distributed`: the variance of random and of jittered samples, the one error of a grid in
//! all pixels, and the filters at an edge half a pixel beside the center, where 0.8423 is the integral of the
//! Gaussian:
//!
//! ```
//! use rayline::{Reconstruction, Sampler, Sampling};
//! # use rayline::{Background, Camera, LinearRgb, Material, Object, PreparedScene, Renderer, Scene};
//! # use rayline::{Settings, Vec3, shape::{Rectangle, Shape}};
//! # fn column(share: f32, sampling: Sampling) -> Vec<f32> {
//! #     let (eye, target, up) = (Vec3::ZERO, Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.0, 1.0, 0.0));
//! #     let pixel = 2.0 * 0.25f32.tan() / 512.0;
//! #     let corner = Vec3::new((share - 0.5) * pixel - 1.0, -1.0, -1.0);
//! #     let wall = Rectangle::new(corner, Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 2.0, 0.0));
//! #     let white = Material { ambient: 1.0, diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) };
//! #     let (objects, materials) = ([Object::new(Shape::Rectangle(wall), 0)], [white]);
//! #     let camera = Camera { eye, target, up, vertical_fov: 0.5, lens: None };
//! #     let (background, lights, motions) = (Background::BLACK, &[], &[]);
//! #     let scene = Scene { camera, background, objects: &objects, materials: &materials, lights, motions };
//! #     let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f64>()];
//! #     let prepared = PreparedScene::<f64, _>::new(&scene, &mut memory).unwrap();
//! #     let renderer = Renderer::new(&prepared, Settings { sampling, ..Settings::new(1, 512) }).unwrap();
//! #     (0..512).map(|y| renderer.pixel(0, y, &mut ()).0.g as f32).collect()
//! # }
//! # if cfg!(feature = "distributed") {
//! let of = |sampler| column(0.3, Sampling { sampler, ..Sampling::new(16) });
//! let variance = |sampler| of(sampler).iter().map(|light| (light - 0.3).powi(2)).sum::<f32>() / 512.0;
//! let random = 0.3 * (1.0 - 0.3) / 16.0;
//! let jittered = 0.2 * (1.0 - 0.2) * 4.0 / 256.0; // 0.3 · 4 = 1.2 columns
//! assert!((variance(Sampler::Random) / random - 1.0).abs() < 0.15);
//! assert!((variance(Sampler::Jittered) / jittered - 1.0).abs() < 0.15);
//! assert!(of(Sampler::Grid).iter().all(|light| *light == 0.25));
//! for (filter, share) in [
//!     (Reconstruction::Box, 1.0),
//!     (Reconstruction::Tent, 1.0 - 0.5 * 0.5 * 0.5),
//!     (Reconstruction::Gaussian, 0.8423),
//! ] {
//!     let drawn = column(1.0, Sampling { filter, sampler: Sampler::Sobol, ..Sampling::new(256) });
//!     assert!(drawn.iter().all(|light| (light - share).abs() < 0.01), "{filter:?}");
//! }
//! # }
//! ```
//!
//! # Exercises
//!
//! 1. How many random samples halve an error, and how many halve that of R2 at a slope of -0.77? *Four times
//!    as many, and 2 to the power of 1 / 0.77, which is 2.5 times as many.*
//! 2. How does a pattern of 0.9 periods a pixel look with one sample a pixel? *As one of 0.1 periods, ten
//!    pixels wide.*
//! 3. Adaptive sampling misses a thin wire that none of the first four samples meets; how often, if the wire
//!    covers 5 % of the pixel and samples are random? *With 0.95⁴, in 81 of 100 pixels.*
