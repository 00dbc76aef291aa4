//! This chapter teaches pictures that look drawn: lines along edges, few tones, and dots or lines in place of
//! gray.
//!
//! A photograph shows light. A drawing shows what matters: where one thing ends and the next begins, and
//! which way a surface turns. Saito and Takahashi ("Comprehensible Rendering of 3-D Shapes", SIGGRAPH 1990)
//! found that a renderer computes both at each pixel, and that lines and tones can be made from these data
//! afterwards. Drawings suit small displays: a line of one pixel is sharp on an OLED of 128 by 64 pixels,
//! where a gradient is noise.
//!
//! # The formulas
//!
//! ```text
//! contour     object(x, y) ≠ object(x + 1, y),  or the same with (x, y + 1)
//! crease      N · N' < cos(angle),              of two parts of one object
//! step        |N · (P' - P)| > depth · t   and  |N' · (P' - P)| > depth · t
//! toon        (k / n)²,                         k = the nearest whole number to n · √light,  n = steps - 1
//! Gooch       w (yellow + warm · color) + (1 - w) (blue + cool · color),    w = (1 + N · L) / 2
//! dithering   level = ⌊light · levels + threshold(x, y)⌋
//! palette     color i = the one nearest to light + (light · i - the colors before it),   i = 1 … 16
//! ```
//!
//! P and N are the point and the normal that a pixel sees at the distance t, P' and N' those of its neighbor;
//! L is the direction of the lamp. A slanted plane has points at very different distances, but all of them
//! lie on it, so that a step is measured along both normals. Gooch, Gooch, Shirley and Cohen ("A
//! Non-Photorealistic Lighting Model for Automatic Technical Illustration", SIGGRAPH 1998, eq. 2) let N · L
//! run to -1: the side turned away from the lamp shows its form in blues, where a photograph is black.
//! Thresholds are the ranks of the pixels in a pattern (Ulichney, "Digital Halftoning", 1987): Bayer's
//! matrix, blue noise by his method of voids and clusters (1993), dots by the sequence R2, or hatching.
//!
//! # In the code
//!
//! | formula | item | file |
//! |---|---|---|
//! | contour, crease, step | [`Contours`](crate::Contours), `Mark::differs` | `render/contours.rs` |
//! | toon | [`Tones::Toon`](crate::Tones::Toon), `toned` | `render/toon.rs` |
//! | Gooch | [`Gooch`](crate::Gooch), `ShadedHit::gooch_light` | `integrator/gooch.rs` |
//! | dithering | [`Dither`](crate::Dither), `blue_noise` | `render/thresholds.rs` |
//! | palette | [`Palette`](crate::Palette), `Palette::parts` | `render/palette.rs` |
//!
//! - **No frame buffer.** Filters of the papers read a buffer of depths and normals. Here the neighbors of a
//!   pixel are traced by rays without light (Choudhury and Parker, "Ray Tracing NPR-Style Feature Lines",
//!   NPAR 2009). From left to right, the neighbor to the right is the next pixel: two rays a pixel are left,
//!   and none where the outlines of objects show that there is only sky. A square of 16 pixels that is traced
//!   at once takes 24 rays.
//! - **Any order of lines.** The ink of a pixel depends on nothing but the scene and its place, so that lines
//!   and cores exchange no data.
//! - **Realtime quality** searches for ink where neighbors on its grid differ. Digests of 7 bits are not
//!   enough: a ball and the sky once had the same digest, and the ball had no line. So the things that rays
//!   meet at the corners of each cell are compared, too.
//! - **Toon tones are made of single samples**, not of the mean of a pixel. The mean of a white sample and a
//!   black one would be a gray step: a rim around each thing.
//! - **Gooch's tones need the normal**, so they are made where surfaces are shaded. They have no shadows, and
//!   so take no shadow rays.
//! - **Coherence.** Contours are lines of the scene, and move with it; patterns stand still on the display. A
//!   test turns a box by a degree from frame to frame:
//!
//! | measure | drawing | random dots |
//! |---|--:|--:|
//! | ink that has ink within a pixel in the next frame | 100 % | 28 % |
//! | pixels that flip, over the fewest that can | 0.99 to 1.02 | 174 |
//! | pixels that change where nothing moves | 0 | - |
//!
//! Contours take 0.86 rays a pixel of 320x240 in `classic` and 1.24 in `flake`, and in realtime quality 0.57
//! and 0.72; a photograph takes 2.39, 4.57, 0.46 and 1.21. What each look costs, in nanoseconds a pixel of
//! 640x480 on one thread of a desktop that was not idle (the best of nine):
//!
//! | scene | quality | photo | toon | Gooch | contours |
//! |---|---|--:|--:|--:|--:|
//! | `classic` | exact | 219 | 256 | 184 | 272 |
//! | | realtime | 53 | 54 | 32 | 71 |
//! | `flake` | exact | 393 | 402 | 276 | 603 |
//! | | realtime | 329 | 344 | 168 | 515 |
//! | teapot of 2,120 triangles | exact | 898 | 921 | 578 | 1,549 |
//! | | realtime | 294 | 276 | 149 | 497 |
//!
//! # Try it
//!
//! `cargo run --release -- render docs/gallery/look-gooch.ron -o drawing.png`
//!
#![doc = concat!("![A part](data:image/png;base64,", include_str!("pictures/look-gooch.b64"), ")")]
//!
//! - `--look photo` shows the same part as a photograph, and `--look contours` as one with lines.
//! - `docs/gallery/look-toon.ron` is a cartoon: `--look toon:2,contours` leaves black and white tones.
//! - `--color mono --transfer linear --dither hatching --look contours` draws with a pen; `stippling` and
//!   `blue-noise` with dots.
//! - `--color black-white-red --dither blue-noise` shows e-paper with red ink.
//!
//! # A test
//!
//! The middle of a white ball faces the eye. With the lamp behind the ball, w is 0 and the tone is the cool
//! one, with the lamp beside the eye the warm one; toon tones of three steps have light of 0, 1/4 and 1:
//!
//! ```
//! use rayline::{Gooch, Light, Look, Settings, Tones};
//! # use rayline::{Background, Camera, LinearRgb, Material, Object, PreparedScene, Renderer, Scene, Vec3};
//! # use rayline::shape::{Shape, Sphere};
//! # let (eye, up) = (Vec3::new(0.0, 0.0, 5.0), Vec3::new(0.0, 1.0, 0.0));
//! # let camera = Camera { eye, target: Vec3::ZERO, up, vertical_fov: 0.01, lens: None };
//! # let (background, motions) = (Background::BLACK, &[]);
//! let objects = &[Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0)), 0)];
//! let materials = &[Material::matte(LinearRgb::WHITE)];
//! let light_of = |toward: Vec3, tones| {
//!     let lights = &[Light::Directional { direction: -toward, color: LinearRgb::WHITE }];
//!     let scene = Scene { camera, background, objects, materials, lights, motions };
//! #   let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f64>()];
//!     let prepared = PreparedScene::<f64, _>::new(&scene, &mut memory).unwrap();
//!     let look = Look { tones, contours: None };
//!     let settings = Settings { look, ..Settings::new(1, 1) };
//!     let (light, rays) = Renderer::new(&prepared, settings).unwrap().pixel(0, 0, &mut ());
//!     (light.to_f32().channels(), rays)
//! };
//! let tones = Tones::Gooch(Gooch { blue: 0.5, yellow: 0.25, cool: 0.125, warm: 0.75 });
//! let near = |(found, rays): ([f32; 3], u32), expected: [f32; 3]| {
//!     rays == 1 && found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-6)
//! };
//! assert!(near(light_of(Vec3::new(0.0, 0.0, 1.0), tones), [1.0, 1.0, 0.75]));
//! assert!(near(light_of(Vec3::new(0.0, 0.0, -1.0), tones), [0.125, 0.125, 0.625]));
//!
//! // cos 60° = 0.5, whose root is nearest to the middle step; cos 53° = 0.6, whose root is nearest to white.
//! for (toward, step) in [(Vec3::new(0.75f32.sqrt(), 0.0, 0.5), 0.25), (Vec3::new(0.8, 0.0, 0.6), 1.0)] {
//!     let (found, _) = light_of(toward, Tones::Toon { steps: 3 });
//!     assert!((found[1] - step).abs() < 1e-4, "{found:?}");
//! }
//! ```
//!
//! # Exercises
//!
//! 1. Why is there no ink at the edges of a checker, although its colors differ? Which line of
//!    `Mark::differs` would have to change?
//! 2. A cylinder of 24 flat sides has edges of 15°. Which `crease` shows them, and which hides them?
//! 3. Count the rays of `ink_of_group` for a group of 1 by 16 pixels, and compare them with those for 4 by 4.
//! 4. Draw a ball with Gooch's tones and two lamps, one red on the left and one green on the right. Why is
//!    neither color seen? What would you change, and what would the paper's authors say?
//! 5. Dithered by random numbers, an area keeps its mean, too. Which row of the table above tells why no film
//!    is dithered in that way?
