//! This chapter teaches light that comes from other surfaces: the rendering equation, and paths that solve
//! it.
//!
//! Whitted's rays bring only light that comes straight from a lamp, or over mirrors and glass. All other
//! light is one constant, the ambient light. But a ceiling whose lamp shines down is bright, a red wall makes
//! the floor beside it red, and a glass ball gathers light in a spot below it. In all three cases, surfaces
//! scatter light onto each other.
//!
//! # The formulas
//!
//! ```text
//! rendering equation   L(x, ω) = e(x, ω) + ∫ f(ω', ω) L(y, -ω') cos θ' dω'
//! radiosity            B = e + ρ B of all around = e (1 + ρ + ρ² + …),   in a closed room
//! chance               pᵢ = mᵢ / (m₁ + m₂ + m₃),   light of way i counts 1 / pᵢ times
//! roulette             p = min(1, m₁ + m₂ + m₃)
//! scattered ray        density cos θ / π:   throughput · color · diffuse
//! power heuristic      w = d² / (d² + d'²)
//! ```
//!
//! L is the light at the point x toward ω, e the emission there, y the point that is seen from x along ω', f
//! the share that the surface sends from ω' to ω (Kajiya, "The Rendering Equation", SIGGRAPH 1986, eq. 1). B
//! is the light of matte surfaces that all have the albedo ρ (Goral, Torrance, Greenberg and Battaile,
//! "Modeling the Interaction of Light Between Diffuse Surfaces", SIGGRAPH 1984). mᵢ is the largest channel of
//! the throughput that the ray would have on way i: scattered, mirrored or refracted. Roulette ends a path
//! with the probability 1 - p (Arvo and Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990). d and
//! d' are the densities with which two kinds of rays find the same point of a lamp (Veach and Guibas,
//! "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995, eq. 19 with β = 2).
//!
//! # In the code
//!
//! | formula | item | file |
//! |---|---|---|
//! | all of them | [`Integrator::PathTracing`](crate::Integrator) | `integrator/path_tracing.rs` |
//! | ways, roulette | `Ways::new`, `Path::scatter` | `integrator/path_tracing.rs` |
//! | scattered ray | `hemisphere` | `sampling/warp.rs` |
//! | power heuristic | `share_of_lamp` | `integrator/path_tracing.rs` |
//!
//! - **One path for each sample.** At a hit, Whitted's tree follows a mirrored and a refracted ray. A path
//!   follows one ray, so it needs no stack; which one is drawn by chance.
//! - **One shadow ray for each lamp**, at each hit. A lamp without a size can be found in no other way. A
//!   lamp with a size can be met by a scattered ray as well: the power heuristic divides its light between
//!   both.
//! - **Glass.** Shadow rays to lamps with a size end at glass, because paths that refract bring the light
//!   behind it: caustics. The light of lamps without a size passes glass in a straight line, as in Whitted's
//!   pictures.
//! - **What is left out**: ambient light, which path tracing replaces; `Light::Sky`, because scattered rays
//!   see the background themselves; closed forms.
//! - **Fixed point** has 16 digits for shares, and they end at 2: a path brings at most 1.99 times what it
//!   found. Glossy lobes are found by their own rays alone. The Cornell box in `Fixed` differs from `f64` by
//!   less than its noise.
//! - **Noise** falls with the square root of the number of samples, and small bright lamps behind glass have
//!   most of it.
//!
//! # Try it
//!
//! `cargo run --release -- render docs/gallery/light-indirect.ron -o box.png`
//!
#![doc = concat!("![A box](data:image/png;base64,", include_str!("pictures/light-indirect.b64"), ")")]
//!
//! - `--integrator whitted` shows the lamp's light alone: a black ceiling, and no light below the glass.
//! - `--bounces 1` adds the light that was scattered once; each bounce more adds less.
//! - `--integrator path-tracing` draws any other scene so, with 64 samples unless `--samples` says otherwise.
//! - `rayline window` refines the picture while the camera rests, and `render --passes` in the terminal.
//!
//! The programs for emulated boards compute a path-traced picture among their digests of arithmetic, and must
//! find the bytes of the desktop: `cargo boards mps2-an386 --gallery`.
//!
//! # Two tests, with the feature `path-tracing`
//!
//! In a closed room with the emission 0.2 and the albedo 0.7, light that has been scattered up to three times
//! is 0.2 · (1 + 0.7 + 0.49 + 0.343). All paths find the same, so a single one is enough:
//!
//! ```
//! # #[cfg(feature = "path-tracing")] {
//! use rayline::{Integrator, Material, Optics, Settings};
//! # use rayline::{Background, Camera, LinearRgb, Object, PreparedScene, Renderer, Scene};
//! # use rayline::{Vec3, shape::{Shape, Sphere}};
//! # let (target, up) = (Vec3::new(0.3, 0.2, 1.0), Vec3::new(0.0, 1.0, 0.0));
//! # let camera = Camera { eye: Vec3::ZERO, target, up, vertical_fov: 0.5, lens: None };
//! let emission = Optics { emission: LinearRgb::gray(0.2), ..Optics::PLAIN };
//! let wall = Material { diffuse: 0.7, optics: Some(&emission), ..Material::matte(LinearRgb::WHITE) };
//! let room = [Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 3.0)), 0)];
//! # let (background, lights, motions) = (Background::BLACK, &[], &[]);
//! # let scene = Scene { camera, background, objects: &room, materials: &[wall], lights, motions };
//! # let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f64>()];
//! let settings = Settings { integrator: Integrator::PathTracing, bounces: 3, ..Settings::new(1, 1) };
//! let prepared = PreparedScene::<f64, _>::new(&scene, &mut memory).unwrap();
//! let light = Renderer::new(&prepared, settings).unwrap().pixel(0, 0, &mut ()).0.g;
//! assert!((light - 0.2 * (1.0 + 0.7 + 0.49 + 0.343)).abs() < 1e-6);
//! # }
//! ```
//!
//! Two squares that face each other at the distance of their side exchange the share 0.1998 of their light
//! (Siegel and Howell, "Thermal Radiation Heat Transfer"). A point in the middle of one sees the share 0.2394
//! of the other: 4 / π · h · atan h for h = 1 / √(1 + 4) of each quarter, twice.
//!
//! ```
//! # #[cfg(feature = "path-tracing")] {
//! use rayline::{Integrator, Light, ObjectId, Sampling, Settings};
//! # use rayline::{Background, Camera, LinearRgb, Material, Object, Optics, PreparedScene, Renderer, Scene};
//! # use rayline::{Vec3, shape::{Rectangle, Shape}};
//! # let (eye, up) = (Vec3::new(0.0, 0.4, 0.9), Vec3::new(0.0, 1.0, 0.0));
//! # let camera = Camera { eye, target: Vec3::ZERO, up, vertical_fov: 0.001, lens: None };
//! # let emission = Optics { emission: LinearRgb::WHITE, ..Optics::PLAIN };
//! # let white = Material::matte(LinearRgb::WHITE);
//! # let materials = [white, Material { diffuse: 0.0, optics: Some(&emission), ..white }];
//! # let (right, back) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 1.0));
//! # let square = |y| Rectangle::new(Vec3::new(-0.5, y, -0.5), right, back);
//! let squares = [0.0, 1.0].map(|height| Shape::Rectangle(square(height)));
//! # let objects = [Object::new(squares[0], 0), Object::new(squares[1], 1)];
//! # let (background, motions) = (Background::BLACK, &[]);
//! let h = 1.0 / 5f64.sqrt();
//! let share = 4.0 / core::f64::consts::PI * h * h.atan();
//! // With the upper square as a lamp of the scene, and found by scattered rays alone.
//! for lights in [&[Light::Object(ObjectId(1))][..], &[]] {
//! #   let scene = Scene { camera, background, objects: &objects, materials: &materials, lights, motions };
//! #   let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f64>()];
//!     let sampling = Sampling::new(4096);
//!     let settings = Settings {
//!         integrator: Integrator::PathTracing, sampling, rays_per_pixel: 1 << 16, ..Settings::new(1, 1)
//!     };
//! #   let prepared = PreparedScene::<f64, _>::new(&scene, &mut memory).unwrap();
//! #   let light = Renderer::new(&prepared, settings).unwrap().pixel(0, 0, &mut ()).0.g;
//!     assert!((light - share).abs() < 4e-3, "{light}, not {share}");
//! }
//! # }
//! ```
//!
//! # Radiosity, and light that is baked
//!
//! A path finds the light of one pixel. Where surfaces are matte, their light is the same from all sides, and
//! is found once for all pictures: that is radiosity (Goral and others, 1984). Surfaces are divided into
//! patches; the light that arrives at patch i is a sum over all others,
//!
//! ```text
//! Eᵢ = Eᵢ⁰ + Σⱼ Fᵢⱼ ρⱼ Eⱼ,   Fᵢⱼ = 1 / Aᵢ ∫∫ cos θ cos θ' / (π r²) V dAⱼ dAᵢ
//! ```
//!
//! where E⁰ is the light of lamps, ρ the albedo, and the form factor F the share of the light around i that
//! comes from j; V is 0 where something is between. Progressive refinement (Cohen and others, 1988) solves
//! it by shooting: the brightest patch sends its light to all others, until little is left.
//!
//! `rayline bake --light` does so, and writes the light into images: [`Onto::AmbientLight`] takes the place
//! of the constant ambient light, [`Figure::Parts`] holds an image for each face of a box, and
//! [`IrradianceVolume`] holds the light in between, for balls and for things that move. No lamp is left: a
//! pixel takes one ray and four texels, also on a processor that traces no paths in a lifetime.
//!
//! Radiosity has no mirrors and no glass; photons bring the light that comes over both (Jensen, "Global
//! Illumination using Photon Maps", EGWR 1996). A photon is a ray that leaves a lamp toward a mirror or
//! glass, with a share of the lamp's flux Φ. Photons are mirrored, refracted and absorbed like rays from the
//! eye. Where photons end on a matte surface,
//!
//! ```text
//! E(x) = Σ ΔΦ k(|x - xₚ| / r) / A,   k(d) = 1 - d,   A = Σ k A_texel
//! ```
//!
//! is the light that the photons bring. Each photon spreads its flux over the texels around it by Jensen's
//! cone filter, within the distance r of its 24th neighbor. So a caustic is sharp where photons gather, and
//! smooth where they are few. Radiosity then scatters this light on. `--photons` sets how many photons leave.
//!
//! No light may count twice. A shadow ray goes straight through glass; beside photons, glass ends it, as in
//! path tracing. But with `--light indirect` the device sends shadow rays of its own, and so photons that
//! meet glass are left out there: then only mirrors make caustics. Light of surfaces that are no lamps still
//! goes straight through glass, and ends at mirrors.
//!
//! `cargo run --release -- bake docs/gallery/light-indirect.ron room.ron --light indirect`
//!
//! [`Onto::AmbientLight`]: crate::Onto::AmbientLight
//! [`Figure::Parts`]: crate::Figure::Parts
//! [`IrradianceVolume`]: crate::IrradianceVolume
//!
//! # Exercises
//!
//! 1. A closed white room has the albedo 0.9. How much brighter than its lamp alone would make it is it? *1 /
//!    (1 - 0.9) = 10 times.*
//! 2. Why does a path that survives roulette count more? *It stands for those that ended: with the
//!    probability p, one path in place of 1 / p.*
//! 3. A shadow ray draws points of a small far lamp. Why is it better than a scattered ray there, and worse
//!    at a large lamp close by? *A scattered ray rarely meets a small lamp. Close to a large one, points of
//!    equal area differ much in the light that they bring; directions by the cosine do not.*
//! 4. Why is a mirror not baked? *Its light is another one from each side.*
//! 5. A caustic of sunlight is a hundred times brighter than the floor around it. How much closer to each
//!    other are photons there? *Ten times: there are a hundred times as many on the same area.*
