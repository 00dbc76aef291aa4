//! The lectures: ray tracing from the first ray to distributed light, as a course.
//!
//! Each chapter explains a part of the classic lectures with its formulas and their sources, says where they
//! are in the code and what this renderer does differently, draws a scene, computes one of its pixels by
//! hand, and ends with exercises. A scene of the gallery runs on the desktop and, with the same bytes, on a
//! board of five dollars.
//!
//! | chapter | teaches |
//! |---|---|
//! | [`rays`] | rays and pixels: camera, picture plane, light and the codes of a display |
//! | [`intersections`] | where a ray meets a surface, and how exactly |
//! | [`shading`] | the light of a surface: ambient, diffuse, specular; lamps and shadows |
//! | [`ray_tree`] | reflection and refraction, and the tree of rays without recursion |
//! | [`sampling`] | aliasing, distributions of samples, filters |
//! | [`distributed`] | soft shadows, depth of field, motion blur, gloss |
//! | [`global_light`] | light that surfaces scatter onto each other |
#![cfg_attr(feature = "looks", doc = "| [`looks`] | lines, tones and patterns of drawings |")]
//! | [`scan_conversion`] | the other way to draw: facets and a Z-buffer |
//! | [`acceleration`] | boxes, lists and fewer pixels |
//!
//! The chapters are documentation only: no program contains them.

pub mod acceleration;
pub mod distributed;
pub mod global_light;
pub mod intersections;
#[cfg(feature = "looks")]
pub mod looks;
pub mod ray_tree;
pub mod rays;
pub mod sampling;
pub mod scan_conversion;
pub mod shading;
