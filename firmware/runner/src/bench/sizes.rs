//! `cargo boards --sizes`: flash and stack of small programs, by shapes, features and levels of optimization.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use anyhow::{Context, Result};
use rayline::builtin::SPHERES;
use rayline::shape::{Geometry, Shape, Sphere};
use rayline::{Object, Scene, Vec3};

use super::entries::{LARGE_M0, M3, M4F};
use super::measured::Measured;
use super::{gallery, measure_all, write_page};
use crate::board::Board;
use crate::convert;
use crate::picture::{Number, Size};
use crate::request::Request;
use crate::session::Session;
use crate::table::{Align, Table, with_commas};
use crate::toolchain::{Compilation, LEVELS};

/// Size of the pictures.
const SIZE: Size = Size { width: 32, height: 24 };

/// The boards, with the number system that each computes in.
const ON: [(&str, &str, Number); 4] = [
    ("M0", LARGE_M0, Number::Fixed),
    ("M3", M3, Number::Fixed),
    ("M4F", M4F, Number::F32),
    ("RISC-V", "riscv32", Number::Fixed),
];

/// The sets of features: their name, whether those that only make pictures faster are left out, and those
/// that the scenes do not need.
const FEATURES: [(&str, bool, &[&str]); 3] = [
    ("none", true, &[]),
    ("`candidates`", false, &[]),
    ("default", false, &["candidates", "hierarchy", "optics", "textures"]),
];

/// The scenes: their names, and the names of their files.
const SCENES: [(&str, &str); 2] = [("sphere", "sphere"), ("all", "all-shapes")];

/// The only shape of the smallest program.
const SPHERE: Shape<'static> = Shape::Sphere(Sphere::new(Vec3::new(0.0, 0.8, 0.0), 0.8));

const HEAD: &str = "\
# The sizes of programs

A command writes this page; do not edit it: `cargo boards --sizes docs/sizes.md`.

Bytes of flash and of stack of a program that draws one exact picture and links only the shapes of its scene,
one sphere or all shapes that files can have: by the features of the crate `rayline`, and by the profile's
`opt-level`, with `lto = \"fat\"` and one codegen unit. The M4F computes in `f32`, the others in fixed point.
Flash includes the scene, and the start-up code and output of the program, but no driver of a display.

At level 3 the compiler computes what a small scene makes of the checks before drawing, and leaves them out;
at `s` and `z` they are functions that are called. So one sphere in `f32` is smaller at 3: `Texture::prepare`
takes 1.3 KB there at `s`, and nothing at 3. A scene that is built at run time takes these functions anyway.
";

/// Measures all programs, and writes the page.
pub(crate) fn run(file: &Path, timeout: Duration) -> Result<()> {
    let folder = tempfile::tempdir()?;
    for ((_, name), shapes) in SCENES.into_iter().zip([vec![SPHERE], all_shapes()?]) {
        let objects: Vec<_> = shapes.into_iter().map(|shape| Object::new(shape, 1)).collect();
        let scene = Scene { objects: &objects, ..SPHERES };
        convert::write(&scene, &folder.path().join(name).with_extension("rayline"))?;
    }
    let mut sessions = Vec::new();
    for (_, scene) in SCENES {
        let scene = folder.path().join(scene).with_extension("rayline");
        let scene = scene.to_str().context("a path that is not UTF-8")?;
        for (_, small, features) in FEATURES {
            for level in LEVELS {
                for (_, board, number) in ON {
                    let board = Board::named(board)?;
                    let request = Request { size: Some(SIZE), number, small, ..Request::new(scene)? };
                    let compilation = Compilation { level, has_fast_core: false, features };
                    let session = Session::new(board, request.on(board), timeout);
                    sessions.push(Session { compilation, ..session });
                }
            }
        }
    }
    let measured = measure_all(&sessions, folder.path())?;
    write_page(file, HEAD, &table(&measured))
}

/// The table, of the figures of all programs in the order in which they were built.
fn table(measured: &[Measured]) -> Table {
    let mut headings = vec![("shapes", Align::Left), ("features", Align::Left), ("level", Align::Left)];
    for (name, ..) in ON {
        headings.extend([(name, Align::Right), ("stack", Align::Right)]);
    }
    let mut table = Table::new(headings);
    let mut figures = measured.iter();
    for (scene, _) in SCENES {
        for (features, ..) in FEATURES {
            for level in LEVELS {
                let mut row: Vec<String> = [scene, features, level].map(Into::into).into();
                for program in figures.by_ref().take(ON.len()) {
                    row.extend([program.text_bytes, program.stack_bytes].map(with_commas));
                }
                table.push(row);
            }
        }
    }
    table
}

/// One shape of each kind that the gallery has: the one that takes least memory.
fn all_shapes() -> Result<Vec<Shape<'static>>> {
    let folder = tempfile::tempdir()?;
    let mut scenes: Vec<PathBuf> = fs::read_dir(gallery())?
        .map(|entry| Ok(entry?.path()))
        .filter(|path| path.as_ref().is_ok_and(|path| path.extension().is_some_and(|end| end == "ron")))
        .collect::<Result<_>>()?;
    scenes.sort();
    let mut shapes: Vec<Shape<'static>> = Vec::new();
    for bytes in convert::to_bytes(&scenes, folder.path())? {
        // The shapes are used until the end of this program.
        let bytes = &*fs::read(bytes)?.leak();
        let memory = rayline_build_support::memory_for(bytes).leak();
        for object in Scene::<Shape<'static>>::from_bytes(bytes, memory)?.objects {
            let kind = std::mem::discriminant(&object.shape);
            match shapes.iter_mut().find(|known| std::mem::discriminant(*known) == kind) {
                None => shapes.push(object.shape),
                Some(known) if object.shape.bytes::<f32>() < known.bytes::<f32>() => *known = object.shape,
                Some(_) => {}
            }
        }
    }
    Ok(shapes)
}
