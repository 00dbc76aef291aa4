//! This chapter teaches the other way to draw: polygon scan conversion with a Z-buffer, and when to choose
//! which.
//!
//! Ray tracing takes one pixel after the other and finds the surface behind it. Scan conversion, the method
//! of graphics processors, takes one surface after the other and finds the pixels in front of it. In scan
//! conversion a sphere is no sphere but a polyhedron, and a point in shadow is lit, because each surface is
//! drawn without regard to the others; in return a facet costs hardly more than the pixels that it covers.
//!
//! # The formulas
//!
//! ```text
//! clipping        keep z ≥ near,  |x| ≤ z · w,  |y| ≤ z · h;     a cut lies at d / (d - d')
//! projection      x' = x / (z · w),   y' = y / (z · h)
//! coverage        left edge ≤ x' < right edge of the facet, at the middle of the line
//! depth           1/z is linear in x' and y':   1/z = a + b · x' + c · y'
//! visibility      the facet with the largest 1/z
//! Gouraud         light = α · light₁ + β · light₂ + γ · light₃,     α + β + γ = 1
//! perspective     P = eye + z · (forward + x' · w · right + y' · h · up)
//! ```
//!
//! x, y and z are a point's distances to the right, up and along the line of sight; w and h are half the
//! width and height of the picture at the distance 1; d and d' are the distances of an edge's ends from a
//! plane. Facets are clipped before they are projected (Sutherland and Hodgman, "Reentrant Polygon Clipping",
//! CACM 1974): behind the eye, z is negative and the quotients mean nothing. The three numbers α, β and γ are
//! linear in the picture, which is wrong in perspective. In light, this error is not noticed (Gouraud,
//! "Continuous Shading of Curved Surfaces", IEEE Transactions on Computers 1971). In textures it is plain, so
//! textures are evaluated at the point P in space.
//!
//! # In the code
//!
//! | formula | item | file |
//! |---|---|---|
//! | facets | [`Silhouette::each_facet`](crate::shape::Silhouette::each_facet) | `shape/` |
//! | light of a corner | `unshadowed` | `integrator/unshadowed.rs` |
//! | clipping | `clipped` | `render/preview/clip.rs` |
//! | projection | `Corner::place` | `render/preview/corner.rs` |
//! | depth | `sloped` | `render/preview/setup.rs` |
//! | coverage, visibility | `cover` | `render/preview/scan.rs` |
//! | Gouraud, perspective | `Shade`, `LinePalette::texture` | `render/preview/painter.rs` |
//!
//! - **One line of depth.** A Z-buffer of a whole picture of 320 by 240 pixels takes 300 KB. Here facets are
//!   sorted by the first line that they cover, and each line finds its own (Wylie, Romney, Evans and Erdahl,
//!   "Half-Tone Perspective Drawings by Computer", AFIPS 1967): 2.5 KB for a line, but memory for all facets.
//! - **Each pixel is colored once**, after the line's facets are known, by the one that is seen.
//! - **Facets that share an edge share no pixel and leave none out**: both compute the edge by the same whole
//!   numbers, and a pixel in the middle of an edge belongs to the facet on its right.
//! - **Any solid has facets.** Shapes that have no formula for them are cut by marching tetrahedra (Doi and
//!   Koide, "An Efficient Method of Triangulating Equi-Valued Surfaces by Using Tetrahedral Cells", IEICE
//!   1991), whose corners are found by rays along the edges of a grid.
//!
//! # Which way to draw
//!
//! | | ray tracing | scan conversion |
//! |---|---|---|
//! | time grows with | pixels, rays, and the logarithm of the objects | facets, and pixels times layers |
//! | shadows, mirrors, glass | follow from the rays | need tricks for each |
//! | curved shapes | exact | polyhedra |
//! | memory beside the scene | none | all facets that are seen |
//! | order | pixels in any order | facets in any order, then lines |
//!
//! # Try it
//!
//! `cargo run --release -- compare docs/gallery/show-teapot.ron --plot teapot.svg`
//!
#![doc = concat!("![Teapot](data:image/png;base64,", include_str!("pictures/preview-show-teapot.b64"), ")")]
//!
//! writes both pictures beside each other, and a table of times and memory for smaller pictures and for fewer
//! objects. `render --mode preview` draws by scan conversion alone, and `--segments` says how round. In the
//! window, M switches the mode. On a board: `cargo boards mps2-an386 --mode preview`.
//!
//! # A test
//!
//! Two upright squares cross each other before the eye. At the middle of the picture both have the depth 4;
//! on the left one is nearer, on the right the other:
//!
//! ```
//! use rayline::{Preview, PreviewFacet, PreviewPixel};
//! # use rayline::{Background, Camera, LinearRgb, Material, Object, PreparedScene, Renderer, Scene};
//! # use rayline::{Settings, Vec3};
//! # use rayline::shape::{Rectangle, Shape};
//! # let (eye, up) = (Vec3::new(0.0, 0.0, 4.0), Vec3::new(0.0, 1.0, 0.0));
//! # let camera = Camera { eye, target: Vec3::ZERO, up, vertical_fov: 0.5, lens: None };
//! # let square = |z: f32| Rectangle {
//! #     corner: Vec3::new(-2.0, -2.0, -z),
//! #     right: Vec3::new(4.0, 0.0, 2.0 * z),
//! #     up: Vec3::new(0.0, 4.0, 0.0),
//! # };
//! let squares = [square(1.0), square(-1.0)].map(|square| Object::new(Shape::Rectangle(square), 0));
//! # let scene = Scene {
//! #     camera,
//! #     background: Background::BLACK,
//! #     objects: &squares,
//! #     materials: &[Material::matte(LinearRgb::WHITE)],
//! #     lights: &[],
//! #     motions: &[],
//! # };
//! # let mut memory = vec![core::mem::MaybeUninit::uninit(); scene.bytes::<f32>()];
//! # let prepared = PreparedScene::<f32, _>::new(&scene, &mut memory).unwrap();
//! let renderer = Renderer::new(&prepared, Settings::new(64, 48)).unwrap();
//! let mut facets = [PreviewFacet::BLANK; 16];
//! let mut preview = Preview::new(&renderer, 16, &mut facets).unwrap();
//! let mut pixels = [PreviewPixel::BLANK; 64];
//! preview.scan(24, &mut pixels);
//! let seen: Vec<_> = pixels.iter().map(|pixel| preview.object(*pixel)).collect();
//! assert!(seen[..32].iter().all(|object| *object == Some(1)));
//! assert!(seen[32..].iter().all(|object| *object == Some(0)));
//! ```
//!
//! # Exercises
//!
//! 1. Why is 1/z linear in the picture, and z not? Begin with the plane a · x + b · y + c · z = 1.
//! 2. A shadow could be drawn by scan conversion, too: from where would you look, and what would you keep
//!    (Williams, "Casting Curved Shadows on Curved Surfaces", SIGGRAPH 1978)?
//! 3. Draw `flake-820` in both ways with `rayline compare`. Which curve is steeper over the objects, and from
//!    how many objects on would you trace?
//! 4. A highlight in the middle of a large facet is lost. Which line of `painter.rs` would you change to show
//!    it (Phong, "Illumination for Computer Generated Pictures", CACM 1975), and what does each pixel pay?
