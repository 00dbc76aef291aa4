//! Scenes as Rust source, for flash: a `static` scene with a set of only those shapes that occur in it, so
//! that the linker drops the code of all others.
//!
//! A build script or `rayline bake` writes the source, and a program includes it with `include!`.
//!
//! Meshes are written in their prepared form, with their hierarchies, so that they take no RAM. For that,
//! name the number system in which the program computes.
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

/// The reason why a scene cannot be written as Rust source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BakeError(String);

impl fmt::Display for BakeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for BakeError {}

/// Writes a scene as Rust source, for a module of your own.
///
/// The source defines `SCENE`, the scene; `Shapes`, its set of shapes; `Set`, that set with its lifetime; and
/// `prepared_bytes`, the bytes of memory that the prepared scene takes. A scene with meshes can be prepared
/// only for the number system `N`.
///
/// # Errors
/// The scene has no objects, and so no set of shapes; or a mesh cannot be prepared.
pub fn scene<N: BakedNumber>(scene: &Scene<'_>) -> Result<String, BakeError> {
    if scene.objects.is_empty() {
        return Err(BakeError("the scene has no objects; add one".to_string()));
    }
    let description = Literal::of(scene)?;
    let meshes = mesh::all::<N>(scene)?;
    let names: BTreeMap<&str, Kind> = scene.objects.iter().map(|object| name(&object.shape)).collect();
    Ok(format!(
        "// Written by rayline: change the scene and write it again.
/// The description of the scene. Only the parts of it that are used take flash.
pub const DESCRIPTION: rayline::Scene<'static> = {{
    #[allow(unused_imports)]
    use rayline::{{*, shape::*}};
    {description}
}};

{set}{meshes}{objects}",
        set = set_source::<N>(&names),
        objects = objects_source(&names, scene.objects.len()),
    ))
}

/// The type of the set of shapes, with this lifetime if a shape borrows.
fn shapes(names: &BTreeMap<&str, Kind>, lifetime: &str) -> String {
    let borrows = names.values().any(|kind| *kind == Kind::Borrowing);
    if borrows { format!("Shapes<{lifetime}>") } else { "Shapes".to_string() }
}

/// Source for the set of shapes.
fn set_source<N: BakedNumber>(names: &BTreeMap<&str, Kind>) -> String {
    let variants = names.iter().map(|(name, kind)| {
        let shape = match kind {
            Kind::Owned => format!("rayline::shape::{name}"),
            Kind::Borrowing => format!("rayline::shape::{name}<'a>"),
            Kind::Baked => format!("&'static rayline::shape::Baked{name}<{}>", N::NAME),
        };
        format!("        /// A built-in shape.\n        {name}({shape}),\n")
    });
    format!(
        "rayline::shape_set! {{
    /// The shapes of the scene, and no others.
    pub enum {declared};
    /// The prepared shapes of the scene.
    pub enum PreparedShapes {{
{variants}    }}
}}

",
        declared = shapes(names, "'a"),
        variants = variants.collect::<String>(),
    )
}

/// Source for the objects of these shapes, and for the items that depend on them.
fn objects_source(names: &BTreeMap<&str, Kind>, count: usize) -> String {
    let arms = names.iter().map(|(name, kind)| match kind {
        Kind::Baked => format!("        rayline::shape::Shape::{name}(_) => Shapes::{name}(mesh(object)),\n"),
        _ => format!("        rayline::shape::Shape::{name}(shape) => Shapes::{name}(shape),\n"),
    });
    format!(
        "const fn narrowed(object: usize) -> {set} {{
    match DESCRIPTION.objects[object].shape {{
{arms}        #[allow(unreachable_patterns)]
        _ => panic!(\"the scene has no such shape\"),
    }}
}}

static OBJECTS: [rayline::Object<{set}>; {count}] = {{
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
pub static SCENE: rayline::Scene<'static, {set}> = rayline::Scene {{
    camera: DESCRIPTION.camera,
    background: DESCRIPTION.background,
    objects: &OBJECTS,
    materials: DESCRIPTION.materials,
    lights: DESCRIPTION.lights,
    motions: DESCRIPTION.motions,
}};

/// The set of shapes, with its lifetime.
pub type Set = {set};

/// The bytes of memory that the prepared scene takes in the number system `R`.
pub const fn prepared_bytes<R: rayline::Real>() -> usize {{
    rayline::prepared_bytes!(R, SCENE)
}}
",
        set = shapes(names, "'static"),
        arms = arms.collect::<String>(),
    )
}

/// The form in which a shape is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// The shape's own type, without a lifetime.
    Owned,
    /// A type that borrows a part of its description.
    Borrowing,
    /// The prepared shape.
    Baked,
}

/// The name of the shape, which is also that of its variant in [`Shape`], and the form in which it is
/// written.
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
