//! Every bound on time and memory, with its reason.

use crate::math::FOUR_AT_ONCE;

/// The most bounces that [`Settings::bounces`](crate::Settings) may ask for.
///
/// Each costs one pending ray on the stack: 32 bytes in `f32`. Sixteen levels of mirrors that reflect 80 %
/// leave 3 % of the light.
pub const MAX_BOUNCES: u8 = 16;

/// The most transparent surfaces that one shadow ray passes before the light counts as blocked.
///
/// Four glass balls in a row; beyond that the cut is counted.
pub const MAX_SHADOW_LAYERS: u8 = 8;

/// The largest coordinate, radius or distance that a scene may name: beyond it `f32` resolves no more than
/// 1/16 of a unit.
pub const MAX_COORDINATE: f32 = 1e6;

/// The smallest size of [instances](crate::shape::Instances): of the largest model a unit is left.
pub const MIN_SIZE: f32 = 1e-6;

/// The most objects, materials or lights in a scene: they are numbered by `u16`.
pub const MAX_COUNT: usize = 65_535;

/// The most faces of a convex polyhedron: a ray is tested against each, and preparing takes steps that go with the cube of
/// their number.
pub const MAX_FACES: usize = 64;

/// The largest width or height of a picture in pixels: a coordinate is a `u16`.
pub const MAX_SIDE: u32 = 65_535;

/// How many lines [`Renderer::lines`](crate::Renderer::lines) traces side by side, at most: more at once save nothing.
///
/// What is traced side by side is a square of pixels then. Eight where a processor computes four numbers at once, else four.
pub const LINES_AT_ONCE: usize = if FOUR_AT_ONCE { 8 } else { 4 };

/// The most objects of a scene that needs no hierarchy: so many fit in a set of 32 bits.
pub const FEW_OBJECTS: usize = 32;

/// The most nodes, one inside the other, that a scene's hierarchy has around an object: each costs a ray 24 bytes of
/// stack in `f32`, and 56 on processors that compute four numbers at once.
///
/// Twelve where the cuts cost least, and eight more if all [`MAX_COUNT`] objects are still together.
pub const MAX_HIERARCHY_DEPTH: usize = 20;

/// The most blobs of [`Metaballs`](crate::shape::Metaballs): those that a ray meets take up to a kilobyte of its stack.
pub const MAX_BLOBS: usize = 32;

/// The most steps of a ray through the box around an [implicit surface](crate::shape::Implicit) or
/// [`Metaballs`](crate::shape::Metaballs). No part of the surface is missed where a ray runs inside for a 512th of its way through
/// the box, and of a ball as wide as the box a ray does so up to 0.999998 of the radius.
pub const MAX_TRACE_STEPS: u32 = 512;

/// The most solids that one [`Csg`](crate::shape::Csg) is made of: whether a ray is in each is a bit of a word.
///
/// A ray may enter and leave each twice: a kilobyte of stack in `f32`. A die takes 23: a box, a ball and 21 dots.
pub const MAX_CSG_SOLIDS: usize = 32;
