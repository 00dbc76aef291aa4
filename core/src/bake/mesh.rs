//! Prepared meshes as Rust source.

use core::fmt::Write;
use std::format;
use std::string::String;
use std::vec::Vec;

use super::BakeError;
use crate::math::{Fixed, Real, Vec3};
use crate::scene::Scene;
use crate::shape::{BakedParts, Mesh, Shape, SmallNormal};

/// A number system that meshes can be baked for: `f32` and [`Fixed`].
pub trait BakedNumber: Real {
    /// The path of the number's type.
    const NAME: &'static str;
    /// The name of the integer type that holds its bits.
    const BITS: &'static str;

    /// The number as an argument of the function `n` in the written source.
    fn argument(self) -> String;
}

impl BakedNumber for f32 {
    const NAME: &'static str = "f32";
    const BITS: &'static str = "u32";

    fn argument(self) -> String {
        format!("{:#x}", self.to_bits())
    }
}

impl BakedNumber for Fixed {
    const NAME: &'static str = "rayline::math::Fixed";
    const BITS: &'static str = "i32";

    fn argument(self) -> String {
        format!("{}", self.to_bits())
    }
}

/// Source for all meshes of a scene, and for a function `mesh` from the number of an object to its mesh.
/// Empty for a scene without meshes.
pub(super) fn all<N: BakedNumber>(scene: &Scene<'_>) -> Result<String, BakeError> {
    let meshes = scene.objects.iter().enumerate().filter_map(|(index, object)| match &object.shape {
        Shape::Mesh(mesh) => Some((index, mesh)),
        _ => None,
    });
    let (mut source, mut arms) = (String::new(), String::new());
    for (index, mesh) in meshes {
        source.push_str(&one::<N>(scene, index, mesh)?);
        _ = writeln!(arms, "        {index} => &MESH_{index},");
    }
    if arms.is_empty() {
        return Ok(source);
    }
    let (number, bits) = (N::NAME, N::BITS);
    Ok(format!(
        "const fn n(bits: {bits}) -> {number} {{
    {number}::from_bits(bits)
}}

const fn v(x: {bits}, y: {bits}, z: {bits}) -> rayline::Vec3<{number}> {{
    rayline::Vec3::new(n(x), n(y), n(z))
}}

{source}const fn mesh(object: usize) -> &'static rayline::shape::BakedMesh<{number}> {{
    match object {{
{arms}        _ => panic!(\"the object is no mesh\"),
    }}
}}

"
    ))
}

/// Source for the mesh of one object.
fn one<N: BakedNumber>(scene: &Scene<'_>, index: usize, mesh: &Mesh<'_>) -> Result<String, BakeError> {
    let vector =
        |Vec3 { x, y, z }: Vec3<N>| format!("v({}, {}, {})", x.argument(), y.argument(), z.argument());
    let row =
        |numbers: &[N; 4]| format!("[{}]", joined(numbers, |number| format!("n({})", number.argument())));
    let source = mesh.bake(scene.scale::<N>(), |parts| {
        let BakedParts { triangles, uvs, colors, vertices, normals, bounds, lift, .. } = parts;
        let BakedParts { order, nodes, scale, extent, .. } = parts;
        let [min, max] = bounds;
        let nodes = joined(nodes, |node| {
            let [lower, upper] = node.planes().map(|planes| joined(&planes, row));
            format!("rayline::shape::BoxNode::new([{lower}], [{upper}], {:?})", node.contents())
        });
        format!(
            "static MESH_{index}: rayline::shape::BakedMesh<{}> = \
rayline::shape::BakedMesh::new(rayline::shape::BakedParts {{
    triangles: &{triangles:?},
    uvs: &{uvs:?},
    colors: &{colors:?},
    vertices: &[{}],
    normals: &[{}],
    order: &{order:?},
    nodes: &[{nodes}],
    bounds: [{}, {}],
    lift: n({}),
    scale: {scale:?},
    extent: {extent:?},
}});

",
            N::NAME,
            joined(vertices, |vertex| vector(*vertex)),
            joined(normals, |SmallNormal(normal)| format!("rayline::shape::SmallNormal({normal:?})")),
            vector(min),
            vector(max),
            lift.argument(),
        )
    });
    source.map_err(|fault| BakeError(format!("object {index}: {fault}")))
}

/// The elements of a list, with commas between them.
fn joined<T>(list: &[T], written: impl Fn(&T) -> String) -> String {
    list.iter().map(written).collect::<Vec<_>>().join(", ")
}
