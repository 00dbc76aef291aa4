//! The scene with a set of just the shapes that it names, so that the program links no others.

use std::collections::BTreeMap;

use rayline::Scene;
use rayline::shape::Shape;

/// Rust code that defines `Shapes`, the set; `SCENE`, the scene `BUILTIN` in it; and `PREPARED_BYTES`, the memory that it takes.
pub(crate) fn scene(scene: &Scene<'_>) -> String {
    let named: BTreeMap<String, bool> =
        scene.objects.iter().map(|object| (name(&object.shape), borrows(&object.shape))).collect();
    let lifetime = |borrows, lifetime| if borrows { lifetime } else { "" };
    let any_borrows = named.values().any(|borrows| *borrows);
    let (declared, used) = (lifetime(any_borrows, "<'a>"), lifetime(any_borrows, "<'static>"));
    let (mut variants, mut arms) = (String::new(), String::new());
    for (name, borrows) in named {
        let borrowed = lifetime(borrows, "<'a>");
        variants += &format!("/// From the library.\n{name}(rayline::shape::{name}{borrowed}),\n");
        arms += &format!("rayline::shape::Shape::{name}(shape) => Shapes::{name}(shape),\n");
    }
    format!(
        "rayline::shape_set! {{
            /// The shapes of the picture, and no others.
            pub enum Shapes{declared};
            /// The same, prepared.
            pub enum PreparedShapes {{
                {variants}
            }}
        }}
        const fn narrowed(shape: rayline::shape::Shape<'static>) -> Shapes{used} {{
            match shape {{
                {arms}
                #[allow(unreachable_patterns)]
                _ => panic!(\"the picture has no such shape\"),
            }}
        }}
        static OBJECTS: [rayline::Object<Shapes{used}>; {count}] = {{
            let all = BUILTIN.scene.objects;
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
            camera: BUILTIN.scene.camera,
            background: BUILTIN.scene.background,
            objects: &OBJECTS,
            materials: BUILTIN.scene.materials,
            lights: BUILTIN.scene.lights,
        }};
        /// The set that the scene is prepared with.
        pub type Set = Shapes{used};
        /// Memory that the prepared scene takes.
        pub const PREPARED_BYTES: usize = rayline::prepared_bytes::<Number, Set>(
            {count},
            BUILTIN.scene.materials.len(),
            BUILTIN.scene.lights.len(),
            BUILTIN.scene.part_bytes::<Number>(),
        );\n",
        count = scene.objects.len(),
    )
}

/// What the shape and its variant in the set of all shapes are called.
fn name(shape: &Shape<'_>) -> String {
    format!("{shape:?}").split('(').next().unwrap_or_default().to_owned()
}

/// Whether the shape borrows a part of its description.
fn borrows(shape: &Shape<'_>) -> bool {
    matches!(
        shape,
        Shape::Polygon(_)
            | Shape::ConvexPolyhedron(_)
            | Shape::Mesh(_)
            | Shape::Csg(_)
            | Shape::Metaballs(_)
            | Shape::Instances(_)
    )
}
