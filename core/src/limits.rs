//! Every bound on time and memory, with its reason.

use crate::math::FOUR_AT_ONCE;

/// The largest [`Settings::bounces`](crate::Settings).
///
/// Each bounce takes one pending ray on the stack: about 50 bytes in `f32` on a processor with 32 bits.
/// Sixteen mirrors that reflect 80 % leave 3 % of the light.
pub const MAX_BOUNCES: u8 = 16;

/// The most layers, which are transparent surfaces, that one shadow ray passes before the light counts as
/// blocked.
///
/// Eight surfaces are four glass balls in a row. A shadow ray that is cut here is counted
/// ([`Cut`](crate::Cut)).
pub const MAX_SHADOW_LAYERS: u8 = 8;

/// The most backs of one object with [`Sides::Front`](crate::Sides::Front) that a ray passes through. A ray
/// that meets more of them passes the object.
pub const MAX_BACKS: u8 = 32;

/// The fewest sides of the polygon that takes the place of a circle in scan conversion.
pub const MIN_SEGMENTS: u16 = 6;

/// The most sides of the polygon that takes the place of a circle in scan conversion.
pub const MAX_SEGMENTS: u16 = 64;

/// The most facets of a [`Preview`](crate::Preview): their numbers have 16 bits, and one value stands for no
/// facet.
pub const MAX_PREVIEW_FACETS: usize = u16::MAX as usize;

/// The longest side of a picture that [`Preview`](crate::Preview) draws, in pixels.
pub const MAX_PREVIEW_SIDE: u16 = 4095;

/// The rays toward each lamp with a size and into the sky, from each hit of one of several samples.
///
/// In a pixel of one sample, a lamp takes as many first, and [`MAX_AREA_RAYS`] in its penumbra.
pub const AREA_RAYS: u16 = 4;

/// The most rays toward each lamp with a size and into the sky, from each hit in a pixel of one sample.
pub const MAX_AREA_RAYS: u16 = 16;

/// The largest coordinate, radius or distance in a scene: at 1e6, `f32` resolves 1/16 of a unit.
pub const MAX_COORDINATE: f32 = 1e6;

/// The smallest size of [instances](crate::shape::Instances): a model as large as [`MAX_COORDINATE`] is then
/// one unit large.
pub const MIN_SIZE: f32 = 1e-6;

/// The most objects, materials or lights in a scene: each is numbered by a `u16`.
pub const MAX_COUNT: usize = 65_535;

/// The most faces of a convex polyhedron: every ray is tested against each face, and the time to prepare one
/// grows with the cube of their number.
pub const MAX_FACES: usize = 64;

/// The largest width or height of a picture in pixels: a coordinate is a `u16`.
pub const MAX_SIDE: u32 = 65_535;

/// The most lines that [`Renderer::lines`](crate::Renderer::lines) traces side by side; more lines at once
/// are no faster.
///
/// Groups of pixels are then squares. Eight lines on processors that compute four numbers at once, else four.
pub const LINES_AT_ONCE: usize = if FOUR_AT_ONCE { 8 } else { 4 };

/// The most objects of a scene without a hierarchy: a set of objects has 32 bits, one for each.
pub const FEW_OBJECTS: usize = 32;

/// The depth of a scene's hierarchy: the most nodes, one inside the other, around an object. Each level takes
/// 24 bytes of stack in `f32`, and 56 on processors that compute four numbers at once.
///
/// The first twelve levels are split where the cost is least. Eight more levels of four equal parts separate
/// [`MAX_COUNT`] objects even if the first twelve separated none.
pub const MAX_HIERARCHY_DEPTH: usize = 20;

/// The most blobs of [`Metaballs`](crate::shape::Metaballs): the blobs along a ray take up to a kilobyte of
/// stack.
pub const MAX_BLOBS: usize = 32;

/// The most steps of a ray through the box around an [implicit surface](crate::shape::Implicit) or
/// [`Metaballs`](crate::shape::Metaballs). A ray finds every part of the surface inside of which it stays for
/// a 512th of its way through the box. It finds a ball as wide as the box unless it passes the center at more
/// than 0.999998 of the radius.
pub const MAX_TRACE_STEPS: u32 = 512;

/// The most solids in one [`Csg`](crate::shape::Csg): a word of 32 bits holds which solids a ray is inside
/// of.
///
/// A ray may enter and leave each solid twice, which takes a kilobyte of stack in `f32`. A die takes 23
/// solids: a box, a ball and 21 pips.
pub const MAX_CSG_SOLIDS: usize = 32;
