//! Scenes as Rust source, for flash: a `static` in a set of just the shapes that the scene has, so that the linker drops all others.
//!
//! A program takes it in with `include!`. Written by a build script, or by `rayline bake`.
//!
//! Meshes are written as they are prepared, with their hierarchies: they take no RAM. That is why a number system must be chosen, the
//! one that the program computes in.
//!
//! ```
//! let source = rayline::bake::scene::<f32>(&rayline::builtin::CLASSIC)?;
//! assert!(source.contains("pub static SCENE"));
//! # Ok::<(), rayline::bake::BakeError>(())
//! ```

mod literal;
mod mesh;

use core::fmt;
use std::collections::BTreeMap;
use std::format;
use std::string::{String, ToString};

use literal::Literal;
pub use mesh::BakedNumber;

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
/// any time; and `prepared_bytes`, the memory that it takes in a number system, which is `N` if it has meshes.
///
/// # Errors
/// It has no objects, and so no set of shapes; or a mesh cannot be prepared.
pub fn scene<N: BakedNumber>(scene: &Scene<'_>) -> Result<String, BakeError> {
    if scene.objects.is_empty() {
        return Err(BakeError("the scene has no objects; add one".to_string()));
    }
    let description = Literal::of(scene)?;
    let meshes = mesh::all::<N>(scene)?;
    let names: BTreeMap<&str, Kind> = scene.objects.iter().map(|object| name(&object.shape)).collect();
    let lifetime = |is_there: bool, lifetime| if is_there { lifetime } else { "" };
    let borrows = names.values().any(|kind| *kind == Kind::Borrowing);
    let (declared, used) = (lifetime(borrows, "<'a>"), lifetime(borrows, "<'static>"));
    let variants = names.iter().map(|(name, kind)| {
        let shape = match kind {
            Kind::Owned => format!("rayline::shape::{name}"),
            Kind::Borrowing => format!("rayline::shape::{name}<'a>"),
            Kind::Baked => format!("&'static rayline::shape::Baked{name}<{}>", N::NAME),
        };
        format!("        /// From the library.\n        {name}({shape}),\n")
    });
    let arms = names.iter().map(|(name, kind)| match kind {
        Kind::Baked => format!("        rayline::shape::Shape::{name}(_) => Shapes::{name}(mesh(object)),\n"),
        _ => format!("        rayline::shape::Shape::{name}(shape) => Shapes::{name}(shape),\n"),
    });
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

{meshes}const fn narrowed(object: usize) -> Shapes{used} {{
    match DESCRIPTION.objects[object].shape {{
{arms}        #[allow(unreachable_patterns)]
        _ => panic!(\"the scene has no such shape\"),
    }}
}}

static OBJECTS: [rayline::Object<Shapes{used}>; {count}] = {{
    let all = DESCRIPTION.objects;
    let mut objects = [rayline::Object::new(narrowed(0), all[0].material.0); {count}];
    let mut i = 1;
    while i < {count} {{
        objects[i] = rayline::Object::new(narrowed(i), all[i].material.0);
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
        DESCRIPTION.part_bytes_baked::<R>(),
    )
}}
",
        count = scene.objects.len(),
        variants = variants.collect::<String>(),
        arms = arms.collect::<String>(),
    ))
}

/// How a shape is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// By itself.
    Owned,
    /// It borrows a part of its description.
    Borrowing,
    /// As it is prepared.
    Baked,
}

/// What the shape and its variant in the set of all shapes are called, and how it is written.
const fn name(shape: &Shape<'_>) -> (&'static str, Kind) {
    match shape {
        Shape::Sphere(_) => ("Sphere", Kind::Owned),
        Shape::Plane(_) => ("Plane", Kind::Owned),
        Shape::Disc(_) => ("Disc", Kind::Owned),
        Shape::Rectangle(_) => ("Rectangle", Kind::Owned),
        Shape::Triangle(_) => ("Triangle", Kind::Owned),
        Shape::Polygon(_) => ("Polygon", Kind::Borrowing),
        Shape::Cylinder(_) => ("Cylinder", Kind::Owned),
        Shape::Cone(_) => ("Cone", Kind::Owned),
        Shape::Ellipsoid(_) => ("Ellipsoid", Kind::Owned),
        Shape::Quadric(_) => ("Quadric", Kind::Owned),
        Shape::Torus(_) => ("Torus", Kind::Owned),
        Shape::Cuboid(_) => ("Cuboid", Kind::Owned),
        Shape::ConvexPolyhedron(_) => ("ConvexPolyhedron", Kind::Borrowing),
        Shape::Mesh(_) => ("Mesh", Kind::Baked),
        Shape::Csg(_) => ("Csg", Kind::Borrowing),
        Shape::Metaballs(_) => ("Metaballs", Kind::Borrowing),
        Shape::Instances(_) => ("Instances", Kind::Borrowing),
    }
}
