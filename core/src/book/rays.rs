//! Rays and pixels: where the ray of a pixel goes, in which order pixels are drawn, and how light becomes the
//! level of a display.
//!
//! A pinhole camera lets one ray of light into each pixel. Ray tracing follows that ray backward, from the
//! eye through the pixel's center into the scene, to what it meets first (Appel, "Some Techniques for Shading
//! Machine Renderings of Solids", SJCC 1968; Whitted, "An Improved Illumination Model for Shaded Display",
//! CACM 1980). This chapter is about both ends of the ray: the camera that makes it, and the display that
//! shows the light it brought. The chapters that follow are about all that lies between.
//!
#![doc = concat!("![Three balls](data:image/png;base64,", include_str!("pictures/shape-sphere.b64"), ")")]
//!
//! # The formulas
//!
//! The frame of the camera, and the ray through a pixel (Glassner (ed.), "An Introduction to Ray Tracing",
//! 1989, ch. 1 and 7):
//!
//! ```text
//! f = (target - eye) / |target - eye|         line of sight, a unit vector
//! r = f × up / |f × up|                       to the right in the picture
//! u = r × f                                   up in the picture
//! p = 2 tan(fov / 2) / H                      side of a pixel at distance 1 from the eye
//! d = f + r p (x + 1/2 - W/2) - u p (y + 1/2 - H/2)
//! ray: o = eye, direction d / |d|
//! ```
//!
//! W and H are the width and the height of the picture in pixels, x and y the column and the line of the
//! pixel, counted from 0 at the upper left, and fov the full vertical angle of view in radians. Pixels are
//! square, so that one p serves both directions.
//!
//! The light of the pixel, L, is linear: two lamps are twice as bright as one. Displays expect a code that is
//! closer to the eye's sense of lightness (IEC 61966-2-1, 1999, sRGB), and have N levels, 0 to N - 1:
//!
//! ```text
//! code(L) = 12.92 L                           for L ≤ 0.0031308
//!         = 1.055 L^(1/2.4) - 0.055           above, up to L = 1; brighter light is cut to 1
//! level   = floor(code (N - 1) + 1/2)         to the nearest level
//! level   = floor(code (N - 1) + (b + 1/2) / 64)       with ordered dithering
//! Y       = 0.2126 R + 0.7152 G + 0.0722 B    light of a gray display (ITU-R BT.709)
//! ```
//!
//! b is the number at (x mod 8, y mod 8) in Bayer's matrix, 0 to 63 ("An Optimum Method for Two-Level
//! Rendition of Continuous-Tone Pictures", 1973). Of 64 neighboring pixels, as many are rounded up as it
//! takes to keep the mean.
//!
//! # In the code
//!
//! | formula | where |
//! |---|---|
//! | f, r, u, fov | [`Camera`](crate::Camera); checked and converted by `Camera::prepare` in `camera.rs` |
//! | p, d, the ray | `Viewport::new` and `Viewport::ray` in `camera.rs` |
//! | x + 1/2, y + 1/2 | `Aim::place` in `render/pixel.rs`, in 65536ths of a pixel |
//! | L of one pixel | [`Renderer::pixel`](crate::Renderer::pixel), as [`LinearRgb`](crate::LinearRgb) |
//! | lines of pixels | [`Renderer::line`](crate::Renderer::line), [`Frame::step`](crate::Frame::step) |
//! | L, cut to 0 to 1 | [`Light16`](crate::Light16): integers from 0 to 65536 |
//! | code, level, b | [`Quantizer`](crate::Quantizer) in `render/quantize.rs` |
//! | colors of displays | [`DisplayColor`](crate::DisplayColor) in `render/display_color.rs` |
//!
//! The textbook traces a picture into a frame buffer and copies that to a screen. Differences:
//!
//! - **No frame buffer.** A line of colors is lent, filled and sent, then filled again: 640 bytes for 320
//!   pixels of `Rgb565`, where the picture would take 153,600. A line depends on no other one, so that a
//!   picture can be drawn in any order of lines, and by several cores.
//! - **d is a sum, not a matrix.** The corner of the picture, the step to the right and the step down are
//!   vectors that are computed once. A line adds its part once, a pixel takes one product and two additions
//!   for each coordinate, and the direction is then made a unit vector.
//! - **Fixed point keeps digits.** The length of d does not matter before that, so `Viewport::new` scales it
//!   by a power of two, up to 16, and counts pixels in a unit of 2^shift pixels.
//! - **The curve is a table.** The power in code(L) is computed when the crate is compiled, at 513 places (1
//!   KB of flash). Between these it is interpolated in integers, with an error below 0.2 of 255 levels, and
//!   with the same bytes on every processor.
//! - **Some pixels take no ray.** If a scene has up to 32 objects and a background of one color, and the
//!   picture takes one sample a pixel and is not dithered, outlines show where on a line no object can be
//!   seen. These pixels get the color of the background without a ray (`render/line.rs`; feature
//!   `candidates`).
//!
//! # Try it
//!
//! ```text
//! cargo run --release -- render docs/gallery/shape-sphere.ron --size 320x240
//! ```
//!
//! - Set `vertical_fov` to 1: the balls have less than half their size, as tan(0.5) is 2.1 tan(0.25). Each
//!   still hides the same parts of the others, because only the place of the eye decides that.
//! - Then move the eye to (0.75, 1.95, 3.25), halfway to the target. The large ball is about as large as
//!   before, but the small one in front has grown: this is perspective.
//! - Add `--color mono --dither ordered`, then leave out `--dither ordered`: with 2 levels, Bayer's pattern
//!   keeps the shading of the balls, and rounding to the nearest level drops it.
//! - Add `--transfer linear` for codes in proportion to light, as LED matrices expect them: on a screen the
//!   picture is too dark.
//!
//! `cargo run --release -- pixel docs/gallery/shape-sphere.ron 320,240` reports the ray of the pixel, what it
//! met, and its color. On an emulated board with an FPU, and all scenes of the gallery at once:
//!
//! ```text
//! cargo run --release -- convert docs/gallery/shape-sphere.ron sphere.rayline
//! cargo boards mps2-an386 --scene sphere.rayline --picture sphere-on-board.png
//! cargo boards mps2-an386 --gallery
//! ```
//!
//! # Examples
//!
//! The ray of one pixel, by the formula and as the renderer reports it to a [`Probe`](crate::Probe):
//!
//! ```
//! # use core::mem::MaybeUninit;
//! # use rayline::{Background, Camera, Event, PreparedScene, Probe, Renderer, Scene, Settings, Vec3};
//! #[derive(Default)]
//! struct FirstRay(Option<Vec3<f64>>);
//! impl Probe<f64> for FirstRay {
//!     fn record(&mut self, event: Event<f64>) {
//!         if let Event::Ray { ray, .. } = event {
//!             self.0.get_or_insert(ray.direction);
//!         }
//!     }
//! }
//!
//! let (eye, target, up) = (Vec3::new(1.5, 3.0, 6.5), Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0));
//! let camera = Camera { eye, target, up, vertical_fov: 0.5, lens: None };
//! let background = Background::BLACK;
//! let scene = Scene { camera, background, objects: &[], materials: &[], lights: &[], motions: &[] };
//! let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f64>()];
//! let prepared = PreparedScene::<f64, _>::new(&scene, &mut memory).unwrap();
//! let renderer = Renderer::new(&prepared, Settings::new(32, 24)).unwrap();
//!
//! for (x, y) in [(0u16, 0u16), (31, 5), (20, 23)] {
//!     let mut probe = FirstRay::default();
//!     renderer.pixel(x, y, &mut probe);
//!     let f = (target - eye).to::<f64>().normalized().unwrap();
//!     let r = f.cross(up.to()).normalized().unwrap();
//!     let u = r.cross(f);
//!     let p = 2.0 * 0.25f64.tan() / 24.0;
//!     let (right, down) = (f64::from(x) + 0.5 - 16.0, f64::from(y) + 0.5 - 12.0);
//!     let d = f + r * (p * right) - u * (p * down);
//!     let off = (probe.0.unwrap() - d.normalized().unwrap()).length();
//!     assert!(off < 1e-7, "{off}");
//! }
//! ```
//!
//! The level of light 0.2 on displays of several kinds:
//!
//! ```
//! use embedded_graphics::pixelcolor::{BinaryColor, Gray8, Rgb565, RgbColor};
//! use rayline::{DisplayColor, Dither, Light16, Quantizer, Settings, Transfer};
//!
//! let light = (0.2f64 * 65536.0).round() as u32;
//! let gray = Light16 { r: light, g: light, b: light };
//! let nearest = Quantizer::new(&Settings::new(8, 8), 0, 0);
//! let code = 1.055 * 0.2f64.powf(1.0 / 2.4) - 0.055;
//! assert_eq!(Gray8::from_light(gray, &nearest), Gray8::new((code * 255.0).round() as u8));
//! assert_eq!(Rgb565::from_light(gray, &nearest).g(), (code * 63.0).round() as u8);
//!
//! // Black and white, dithered for LEDs: a fifth of 64 pixels is lit.
//! let settings = Settings { transfer: Transfer::Linear, dither: Dither::Ordered, ..Settings::new(8, 8) };
//! let places = (0..8u16).flat_map(|y| (0..8u16).map(move |x| (x, y)));
//! let lit = places.filter(|&(x, y)| {
//!     BinaryColor::from_light(gray, &Quantizer::new(&settings, x, y)) == BinaryColor::On
//! });
//! assert_eq!(lit.count(), (0.2f64 * 64.0).round() as usize);
//! ```
//!
//! # Exercises
//!
//! 1. A picture is made twice as wide, and the angle of view stays. Does the picture show more of the scene,
//!    or the same part in more pixels? *More of the scene to the left and right: the angle is the vertical
//!    one, and p depends on H only.*
//! 2. Which ray goes exactly along f in a picture of 320×240 pixels? *None: f passes the corner that the four
//!    pixels in the middle share, and rays go through centers.*
//! 3. Which level of 256 shows half of the light of level 255? *Level 188: 1.055 · 0.5^(1/2.4) - 0.055 =
//!    0.735.*
