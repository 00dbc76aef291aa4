//! Scenes as Rust source, for flash: a `static` in a set of just the shapes that the scene has, so that the linker drops all others.
//!
//! A program takes it in with `include!`. Written by a build script, or by `rayline bake`.
//!
//! ```
//! let source = rayline::bake::scene(&rayline::builtin::CLASSIC)?;
//! assert!(source.contains("pub static SCENE"));
//! # Ok::<(), rayline::bake::BakeError>(())
//! ```

mod literal;

use core::fmt;
use std::collections::BTreeMap;
use std::format;
use std::string::{String, ToString};

use literal::Literal;

use crate::scene::Scene;
use crate::shape::Shape;

/// A scene could not be written as Rust.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BakeError(String);

impl fmt::Display for BakeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for BakeError {}

/// Rust source that defines, in a module of your own: `SCENE`, the scene; `Shapes`, its set of shapes, and `Set`, that for
/// any time; and `prepared_bytes`, the memory that it takes in a number system.
///
/// # Errors
/// It has no objects, and so no set of shapes.
pub fn scene(scene: &Scene<'_>) -> Result<String, BakeError> {
    if scene.objects.is_empty() {
        return Err(BakeError("the scene has no objects; add one".to_string()));
    }
    let description = Literal::of(scene)?;
    let names: BTreeMap<&str, bool> = scene.objects.iter().map(|object| name(&object.shape)).collect();
    let lifetime = |is_there: bool, lifetime| if is_there { lifetime } else { "" };
    let borrows = names.values().any(|borrows| *borrows);
    let (declared, used) = (lifetime(borrows, "<'a>"), lifetime(borrows, "<'static>"));
    let variants = names.iter().map(|(name, borrows)| {
        format!(
            "        /// From the library.\n        {name}(rayline::shape::{name}{}),\n",
            lifetime(*borrows, "<'a>")
        )
    });
    let arms = names
        .keys()
        .map(|name| format!("        rayline::shape::Shape::{name}(shape) => Shapes::{name}(shape),\n"));
    Ok(format!(
        "// Written by rayline: change the scene and write it again.
/// The scene as it was described: nothing of it is in flash unless it is used.
pub const DESCRIPTION: rayline::Scene<'static> = {{
    #[allow(unused_imports)]
    use rayline::{{*, shape::*}};
    {description}
}};

rayline::shape_set! {{
    /// The shapes of the scene, and no others.
    pub enum Shapes{declared};
    /// The same, prepared.
    pub enum PreparedShapes {{
{variants}    }}
}}

const fn narrowed(shape: rayline::shape::Shape<'static>) -> Shapes{used} {{
    match shape {{
{arms}        #[allow(unreachable_patterns)]
        _ => panic!(\"the scene has no such shape\"),
    }}
}}

static OBJECTS: [rayline::Object<Shapes{used}>; {count}] = {{
    let all = DESCRIPTION.objects;
    let mut objects = [rayline::Object::new(narrowed(all[0].shape), all[0].material.0); {count}];
    let mut i = 1;
    while i < {count} {{
        objects[i] = rayline::Object::new(narrowed(all[i].shape), all[i].material.0);
        i += 1;
    }}
    objects
}};

/// The scene, in flash.
pub static SCENE: rayline::Scene<'static, Shapes{used}> = rayline::Scene {{
    camera: DESCRIPTION.camera,
    background: DESCRIPTION.background,
    objects: &OBJECTS,
    materials: DESCRIPTION.materials,
    lights: DESCRIPTION.lights,
}};

/// The set that the scene is prepared with.
pub type Set = Shapes{used};

/// Bytes of memory that the scene takes when it is prepared for a number system.
pub const fn prepared_bytes<R: rayline::Real>() -> usize {{
    rayline::prepared_bytes::<R, Set>(
        DESCRIPTION.objects.len(),
        DESCRIPTION.materials.len(),
        DESCRIPTION.lights.len(),
        DESCRIPTION.part_bytes::<R>(),
    )
}}
",
        count = scene.objects.len(),
        variants = variants.collect::<String>(),
        arms = arms.collect::<String>(),
    ))
}

/// What the shape and its variant in the set of all shapes are called, and whether it borrows a part of its description.
const fn name(shape: &Shape<'_>) -> (&'static str, bool) {
    match shape {
        Shape::Sphere(_) => ("Sphere", false),
        Shape::Plane(_) => ("Plane", false),
        Shape::Disc(_) => ("Disc", false),
        Shape::Rectangle(_) => ("Rectangle", false),
        Shape::Triangle(_) => ("Triangle", false),
        Shape::Polygon(_) => ("Polygon", true),
        Shape::Cylinder(_) => ("Cylinder", false),
        Shape::Cone(_) => ("Cone", false),
        Shape::Ellipsoid(_) => ("Ellipsoid", false),
        Shape::Quadric(_) => ("Quadric", false),
        Shape::Torus(_) => ("Torus", false),
        Shape::Cuboid(_) => ("Cuboid", false),
        Shape::ConvexPolyhedron(_) => ("ConvexPolyhedron", true),
        Shape::Mesh(_) => ("Mesh", true),
        Shape::Csg(_) => ("Csg", true),
        Shape::Metaballs(_) => ("Metaballs", true),
        Shape::Instances(_) => ("Instances", true),
    }
}
