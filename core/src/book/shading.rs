//! Shading: the light that a surface sends to the eye, from ambient light and from lamps, the falloff of a
//! lamp, and shadows, also those of colored glass.
//!
//! A ray has met a surface. How bright is that place? The model of Phong adds three parts: ambient light,
//! which lights every place alike; light that a rough surface scatters evenly to all sides (Lambert,
//! "Photometria", 1760); and a highlight, the blurred image of a lamp in a shiny surface. Only the second
//! part is physics, but each has one number to turn, and the sum costs one ray for each lamp: the shadow ray,
//! which tells whether the lamp is seen from there.
//!
#![doc = concat!("![Highlights](data:image/png;base64,", include_str!("pictures/material-glossy.b64"), ")")]
//!
//! # The formulas
//!
//! ```text
//! I = ka C A + Σ S F E (kd C (N · L) + ks (R · L)^n)       sum over the lamps with N · L > 0
//!     (Phong, "Illumination for Computer Generated Pictures", CACM 1975; shadows: Whitted, CACM 1980)
//! R = D - 2 (N · D) N                                      mirrored ray
//! H = (L - D) / |L - D|, and (N · H)^n for (R · L)^n       highlight after Blinn (SIGGRAPH 1977)
//! F = min(1, 1 / (c + l s + q s²))                         falloff (Hall and Greenberg, IEEE CG&A 1983)
//! F = 3 x² - 2 x³                                          edge of a spot light, times its falloff;
//! x = (cos γ - cos dark) / (cos bright - cos dark)         x is cut to 0 to 1
//! S = Π T K                                                product over the surfaces in the way
//! ```
//!
//! | symbol | meaning | field |
//! |---|---|---|
//! | I | linear light toward the eye | |
//! | C | color of the surface, 0 to 1 in each channel | [`Material::color`](crate::Material::color) |
//! | ka, kd, ks | coefficients, 0 to 1 | `ambient`, `diffuse`, `specular` of [`Material`](crate::Material) |
//! | n | exponent of the highlight | [`Material::shininess`](crate::Material::shininess) |
//! | A | ambient light: white, or the sum of those of the scene | [`Light::Ambient`](crate::Light::Ambient) |
//! | E | color and intensity of the lamp | `color` of a [`Light`](crate::Light) |
//! | N, L, D | unit vectors: normal, toward the lamp, direction of the ray | |
//! | s | distance of the lamp, in units of the scene | |
//! | c, l, q | coefficients of falloff; 1, 0, 0 is none | [`Falloff`](crate::Falloff) |
//! | γ | angle between the axis of a spot light and its light, radians | [`LightCone`](crate::LightCone) |
//! | T | share of light that a surface lets through | `transmittance` of [`Material`](crate::Material) |
//! | K | color of that light | `transmission_color` of [`Optics`](crate::Optics) |
//!
//! # In the code
//!
//! | formula | where |
//! |---|---|
//! | I | `ShadedHit::local_light`, `LampLight::add` and `reflected_light` in `integrator/shaded_hit.rs` |
//! | N · L, L, s | `PreparedLight::seen_from` in `light/mod.rs` |
//! | the power | `material/shininess.rs`; in fixed point, `math/fixed/power.rs` |
//! | Phong or Blinn | [`Highlight`](crate::Highlight) in `material/optics.rs` |
//! | F | [`Falloff`](crate::Falloff) in `falloff.rs`, [`Lamp`](crate::Lamp) in `light/lamp.rs` |
//! | S | [`PreparedScene::light_through`](crate::PreparedScene::light_through) in `prepared/shadow.rs` |
//!
//! Differences from the textbook:
//!
//! - **N faces the eye.** A surface has two sides, and the normal is turned to that of the incoming ray.
//! - **No shadow ray in vain.** No shadow ray is traced to a lamp behind the surface, to a lamp whose falloff
//!   or cone leaves no light, or, without diffuse light, where (R · L)^n is below 2⁻²⁴. In scenes of up to
//!   32 objects, the objects that can stand between each surface and each lamp are listed (feature
//!   `candidates`).
//! - **Shadow rays end at the lamp.** Objects behind it have no effect. An opaque surface ends the search at
//!   once; only glass needs its hits in order.
//! - **A colored shadow is a product, not an image.** A shadow ray goes straight through glass, at most 8
//!   surfaces, and T and K count at each: twice for a ball. Real glass bends the light and gathers it to
//!   bright lines (caustics), which are left out. With [`Optics::absorption`](crate::Optics::absorption), the
//!   way through the body counts, too (Beer's law).
//! - **A point light is as bright at any distance**, see [`Light::Point`](crate::Light::Point). The inverse
//!   square is c = l = 0, and F ends at 1, because 1 / s² has no bound near the lamp.
//! - **Metals color highlights**: ks is multiplied by `reflection_color` of [`Optics`](crate::Optics).
//! - **Powers have the same bits everywhere.** The crate computes them itself, with an error below 2e-7 in
//!   `f32`. In fixed point the direction of a light is exact to an angle of 2⁻¹³, and I saturates at 128.
//!
//! # Try it
//!
//! ```text
//! cargo run --release -- render docs/gallery/material-glossy.ron --size 320x240
//! ```
//!
//! - Set `shininess` of "plastic" from 40 to 10: the spot has twice the diameter. `specular` is its strength.
//! - Give "plastic" `optics: (highlight: BlinnPhong)`: the spot is as large as with a `shininess` of 10, as
//!   Blinn's exponent must be four times Phong's. On a floor under a low lamp the two differ in shape, too:
//!   `docs/gallery/material-blinn-phong.ron`.
//! - Set the light's `color` to (1, 0.5, 0.2): the blue balls turn gray, and their highlights orange, because
//!   ks has no color of its own.
//!
//! Then draw `docs/gallery/material-colored-glass.ron`, and set `transmission_color` of "red" to (1, 1, 1):
//! the ball has no shadow left, because T is 1. On an emulated board, and with all scenes of the gallery:
//!
//! ```text
//! cargo run --release -- convert docs/gallery/material-glossy.ron glossy.rayline
//! cargo boards mps2-an386 --scene glossy.rayline --picture glossy-on-board.png
//! cargo boards mps2-an386 --gallery
//! ```
//!
//! # Examples
//!
//! A wall is lit from the side. The eye, 5 units away, sees the three parts, by Phong and by Blinn; then the
//! shadow of a ball of colored glass, which light enters and leaves:
//!
#![cfg_attr(feature = "optics", doc = "```")]
#![cfg_attr(not(feature = "optics"), doc = "```ignore")]
//! # use core::mem::MaybeUninit;
//! use rayline::shape::{Plane, Shape, Sphere};
//! use rayline::{Falloff, Highlight, Lamp, Light, LinearRgb, Material, Object, Optics, Vec3};
//! # use rayline::{Background, Camera, PreparedScene, Renderer, Scene, Settings};
//!
//! # fn look(objects: &[Object<Shape>], materials: &[Material], lights: &[Light]) -> LinearRgb {
//! #     let (eye, target, up) = (Vec3::new(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0));
//! #     let camera = Camera { eye, target, up, vertical_fov: 0.5, lens: None };
//! #     let background = Background::BLACK;
//! #     let scene = Scene { camera, background, objects, materials, lights, motions: &[] };
//! #     let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
//! #     let prepared = PreparedScene::<f32, _>::new(&scene, &mut memory).unwrap();
//! #     Renderer::new(&prepared, Settings::new(1, 1)).unwrap().pixel(0, 0, &mut ()).0
//! # }
//! let near = |a: f32, b: f32| assert!((a - b).abs() < 1e-5, "{a}, not {b}");
//! let wall = Object::new(Shape::Plane(Plane::new(Vec3::ZERO, Vec3::new(0.0, 0.0, 1.0))), 0);
//! // Toward the lamp: 3 to the right, 4 to the front. Half of the light is left at 5 units.
//! let (color, falloff) = (LinearRgb::gray(2.0), Falloff { constant: 0.0, linear: 0.4, quadratic: 0.0 });
//! let lamp = Light::Lamp(Lamp { position: Vec3::new(3.0, 0.0, 4.0), color, falloff, cone: None });
//! let white = Material::matte(LinearRgb::gray(0.6));
//! let shiny = Material { ambient: 0.1, diffuse: 0.7, specular: 0.5, shininess: 8.0, ..white };
//! let (ambient, light, cosine) = (0.1 * 0.6, 2.0 * 0.5, 4.0 / 5.0f32);
//! let phong = ambient + light * (0.7 * 0.6 * cosine + 0.5 * cosine.powi(8));
//! near(look(&[wall], &[shiny], &[lamp]).g, phong);
//! // Half of the angle: its cosine is the root of (1 + cosine) / 2.
//! let blinn = Optics { highlight: Highlight::BlinnPhong, ..Optics::PLAIN };
//! let half = ((1.0 + cosine) / 2.0).powi(4);
//! let seen = look(&[wall], &[Material { optics: Some(&blinn), ..shiny }], &[lamp]).g;
//! near(seen, ambient + light * (0.7 * 0.6 * cosine + 0.5 * half));
//!
//! let tint = Optics { transmission_color: LinearRgb::new(1.0, 0.5, 0.25), ..Optics::PLAIN };
//! let glass = Material { diffuse: 0.0, transmittance: 0.8, ior: 1.5, optics: Some(&tint), ..white };
//! let ball = Object::new(Shape::Sphere(Sphere::new(Vec3::new(1.5, 0.0, 2.0), 0.5)), 1);
//! let (lit, shadow) = (look(&[wall], &[white], &[lamp]), look(&[wall, ball], &[white, glass], &[lamp]));
//! near(shadow.r, lit.r * (0.8f32 * 1.0).powi(2));
//! near(shadow.g, lit.g * (0.8f32 * 0.5).powi(2));
//! near(shadow.b, lit.b * (0.8f32 * 0.25).powi(2));
//! ```
//!
//! # Exercises
//!
//! 1. A lamp stands 4 units above a floor. How far from its foot is the floor half as bright as below it,
//!    without falloff? *Where N · L is 1/2, at 60°: 4 tan 60° = 6.9 units.*
//! 2. With the inverse square, is the answer larger or smaller? *Smaller: 3.1 units, where the cube of the
//!    cosine is 1/2, as s is 4 over the cosine.*
//! 3. A red and a green lamp light a white floor. Which color has the shadow from the red lamp? *Green: only
//!    the light of the red lamp is missing there.*
