//! This chapter teaches what becomes of a ray at a mirror and at glass: which rays go on, how much light each
//! of them carries, and where a renderer may stop.
//!
//! A camera ray that meets glass splits into a mirrored and a refracted ray. Each of them may meet glass
//! again, so the rays of one pixel form a tree: its root is the camera ray, its leaves see the background, a
//! matte surface, or so little light that nobody would notice. Whitted ("An Improved Illumination Model for
//! Shaded Display", CACM 1980) walks this tree by recursion. Firmware needs a bound on its stack, so this
//! renderer walks the tree with a loop.
//!
//! # The formulas
//!
//! Vectors have length 1. d is the direction of the ray, N the normal on the side that the ray comes from,
//! `c = -d·N` the cosine of the angle of incidence θ1. n1 and n2 are the indices of refraction (no unit) on
//! the side of the ray and beyond the surface; √k is cos θ2, where θ2 is the angle of the refracted ray.
//!
//! ```text
//! mirrored direction   r = d + 2 c N
//! Snell's law          n1 sin θ1 = n2 sin θ2,    η = n1 / n2
//! refracted direction  t = η d + (η c - √k) N,   k = 1 - η² (1 - c²)
//! total reflection     where k < 0, that is where sin θ1 > n2 / n1
//! Fresnel              F = (s² + p²) / 2,   s = (η c - √k) / (η c + √k),   p = (c - η √k) / (c + η √k)
//! Schlick              F ≈ F0 + (1 - F0) (1 - c)⁵,   F0 = ((n1 - n2) / (n1 + n2))²
//! Beer                 T = exp(-a x)
//! the tree             L(d) = T · (local + F L(r) + (1 - F) L(t))
//! ```
//!
//! F is the mirrored share of unpolarized light, 0 to 1; Schlick's c is the cosine on the thinner side. a is
//! the coefficient of absorption per unit of length, x the length of the ray in the medium, T the share of
//! light that is left. L is linear light in three channels, *local* the light of lamps at the hit. (Snell:
//! Glassner (ed.), "An Introduction to Ray Tracing", 1989, p. 289. Fresnel: Born and Wolf, "Principles of
//! Optics", §1.5.2. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", Eurographics 1994,
//! eq. 15.)
//!
//! # In the code
//!
//! | formula | item | file |
//! |---|---|---|
//! | mirrored direction | `ShadedHit::new` | `integrator/shaded_hit.rs` |
//! | Snell, total reflection | `ShadedHit::refracted` | `integrator/shaded_hit.rs` |
//! | Fresnel, Schlick | [`Fresnel`](crate::Fresnel) | `material/fresnel.rs` |
//! | the shares F and 1 - F | [`Optics`](crate::Optics) | `material/optics.rs` |
//! | Beer | [`Medium`](crate::Medium) | `material/medium.rs` |
//! | the tree | `Path::finish`, `Path::branch` | `integrator/path.rs` |
//! | its ends | [`Settings`](crate::Settings), [`Cut`](crate::Cut) | `integrator/path.rs` |
//!
//! A recursive program multiplies by T and F when a call returns. Here each ray carries its *throughput*, the
//! product of all shares on the way to the pixel, and its light is added to the pixel at once.
//!
//! ```text
//! next = camera ray, throughput 1
//! loop: trace next; pixel += throughput · (local light, or background)
//!       push the refracted ray; next = mirrored ray, or else pop; if there is none: done
//! ```
//!
//! - **No recursion, bounded memory.** While a refracted ray waits, only descendants of its mirrored twin are
//!   traced, which have more bounces. So at most one ray waits for each bounce: 16 places
//!   ([`MAX_BOUNCES`](crate::limits::MAX_BOUNCES)) are enough, of about 50 bytes each in `f32` on 32 bits.
//! - **Three ends.** `bounces` (4 by default) bounds the depth. A ray whose throughput is below `cutoff`
//!   (1/256) in all channels is left out. `rays_per_pixel` (4096, shadow rays included) bounds the time of a
//!   pixel. Every cut is counted in [`RayCounts`](crate::RayCounts).
//! - **A surface names the media on both sides**: [`Material::ior`](crate::Material::ior) behind it,
//!   [`Optics::outside`](crate::Optics::outside) in front. The geometric normal says which side is which. A
//!   textbook ray keeps a list of the bodies that it is in; here it keeps none.
//! - **The shares are constant by default**, as in Whitted's paper:
//!   [`Material::reflectance`](crate::Material) and `transmittance`. Under total reflection their sum is
//!   mirrored.
//! - **Fixed point.** A coefficient of absorption beyond the range of [`Fixed`](crate::math::Fixed) is halved
//!   until it fits, and its product with the distance is doubled as often.
//! - **Shadow rays are not bent.** Each surface in the way multiplies the light by its transmittance, its
//!   color and T. Beyond 8 surfaces ([`MAX_SHADOW_LAYERS`](crate::limits::MAX_SHADOW_LAYERS)) the light
//!   counts as blocked. So glass focuses no light: there are no caustics.
//!
//! # Try it
//!
//! `cargo run --release -- render docs/gallery/material-glass.ron -o glass.png`
//!
#![doc = concat!("![A glass ball](data:image/png;base64,", include_str!("pictures/material-glass.b64"), ")")]
//!
//! - `cargo run --release -- pixel docs/gallery/material-glass.ron 280,260` prints the tree of one pixel of
//!   the ball, indented by bounces: six rays, and one that is below the cutoff.
//! - Add `settings: (bounces: 1)` to the scene: ball and pane turn dark, because a ray needs a second bounce
//!   to leave them. With 2 they are clear, but the pane keeps dark edges, whose rays are mirrored inside
//!   first.
//! - Let the material be `"glass": (diffuse: 0, transmittance: 1, ior: 1.5)`: the ball no longer mirrors what
//!   is before it, as its reflectance is 0 at all angles. With `ior: 1` it vanishes.
//!
//! `cargo boards mps2-an386 --gallery` draws all scenes of the gallery on an emulated board, at 24x18 pixels,
//! and compares them with this computer's pictures.
//!
//! # Two tests
//!
//! Straight through a glass ball of radius 1, all rays lie on one line: F is 0.04, T is exp(-2 a). Before a
//! background of 1, b bounces give the first b terms of F + (1 - F)² T + (1 - F)² T (F T) + …:
//!
//! ```
//! # use rayline::{Background, Camera, LinearRgb, Material, Object, Optics, PreparedScene, RayCounts};
//! # use rayline::{Renderer, Scene, Settings, Vec3, shape::{Shape, Sphere}};
//! # let (eye, target, up) = (Vec3::new(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0));
//! # let camera = Camera { eye, target, up, vertical_fov: 0.5, lens: None };
//! let optics = Optics { absorption: LinearRgb::gray(0.3), ..Optics::CLEAR };
//! let matte = Material::matte(LinearRgb::WHITE);
//! let glass = Material { diffuse: 0.0, transmittance: 1.0, ior: 1.5, optics: Some(&optics), ..matte };
//! let (objects, materials) = ([Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0)), 0)], [glass]);
//! # let (background, lights, motions) = (Background::gray(1.0), &[], &[]);
//! let scene = Scene { camera, background, objects: &objects, materials: &materials, lights, motions };
//! # let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f64>()];
//! # if cfg!(feature = "optics") {
//! let prepared = PreparedScene::<f64, _>::new(&scene, &mut memory).unwrap();
//! let (f, t) = (0.04, (-0.3f64 * 2.0).exp());
//! let (mut expected, mut next) = (0.0, f);
//! for bounces in 0..=6 {
//!     let settings = Settings { bounces, cutoff: 0.0, ..Settings::new(1, 1) };
//!     let mut rays = RayCounts::default();
//!     let (light, _) = Renderer::new(&prepared, settings).unwrap().pixel(0, 0, &mut rays);
//!     assert!((light.g - expected).abs() < 1e-6, "{bounces}: {light:?}, not {expected}");
//!     assert_eq!(rays.total(), 1 + 2 * u64::from(bounces));
//!     (expected, next) = (expected + next, if bounces == 0 { (1.0 - f).powi(2) * t } else { next * f * t });
//! }
//! # }
//! ```
//!
//! A glass wall is turned by θ1. A white ball stands where r or t goes, so the pixel shows the share of that
//! ray, and 0 if the direction is wrong. From inside, 41° is below the critical angle, and 42° is beyond it:
//!
//! ```
//! # use rayline::{Background, Camera, LinearRgb, Material, Object, Optics, PreparedScene, Renderer};
//! # use rayline::{Scene, Settings, Vec3, shape::{Plane, Shape, Sphere}};
//! # let (eye, target, up) = (Vec3::new(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0));
//! # let camera = Camera { eye, target, up, vertical_fov: 0.5, lens: None };
//! # let dark = Material { diffuse: 0.0, ..Material::matte(LinearRgb::WHITE) };
//! # let glass = Material { transmittance: 1.0, ior: 1.5, optics: Some(&Optics::CLEAR), ..dark };
//! # let materials = [glass, Material { ambient: 1.0, ..dark }];
//! let shown = |front: Vec3, ball: Vec3| {
//!     let (wall, ball) = (Plane::new(Vec3::ZERO, front), Sphere::new(ball, 0.01));
//!     let objects = [Object::new(Shape::Plane(wall), 0), Object::new(Shape::Sphere(ball), 1)];
//! #   let (background, lights, motions) = (Background::BLACK, &[], &[]);
//! #   let scene = Scene { camera, background, objects: &objects, materials: &materials, lights, motions };
//! #   let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f64>()];
//!     let prepared = PreparedScene::<f64, _>::new(&scene, &mut memory).unwrap();
//!     Renderer::new(&prepared, Settings::new(1, 1)).unwrap().pixel(0, 0, &mut ()).0.g as f32
//! };
//! # if cfg!(feature = "optics") {
//! for (degrees, eta) in [(20f32, 1.0 / 1.5), (65.0, 1.0 / 1.5), (41.0, 1.5), (42.0, 1.5)] {
//!     let (sine, c) = degrees.to_radians().sin_cos();
//!     let (d, n) = (Vec3::new(0.0, 0.0, -1.0), Vec3::new(sine, 0.0, c));
//!     let (front, k) = (if eta < 1.0 { n } else { n * -1.0 }, 1.0 - eta * eta * (1.0 - c * c));
//!     let mut f = 1.0; // total reflection
//!     if k >= 0.0 {
//!         let root = k.sqrt();
//!         let (s, p) = ((eta * c - root) / (eta * c + root), (c - eta * root) / (c + eta * root));
//!         f = (s * s + p * p) / 2.0;
//!         let t = d * eta + n * (eta * c - root);
//!         assert!((shown(front, t * 3.0) - (1.0 - f)).abs() < 1e-4, "{degrees}");
//!     }
//!     assert!((shown(front, (d + n * (2.0 * c)) * 3.0) - f).abs() < 1e-4, "{degrees}");
//! }
//! # }
//! ```
//!
//! # Exercises
//!
//! 1. How many rays can a tree have with b bounces and no lamps? *2ᵇ⁺¹ - 1: 31 with b = 4.*
//! 2. Why does the ball above take only 1 + 2 b rays? *The mirrored ray outside and each ray that leaves see
//!    the background, so only one ray of each pair splits again.*
//! 3. How many bounces does a cutoff of 1/256 leave between two mirrors of reflectance 0.5? *8, since 0.5⁸ is
//!    exactly 1/256 and only smaller shares are left out.*
