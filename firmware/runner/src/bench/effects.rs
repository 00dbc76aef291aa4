//! `cargo boards --effects`: the costs of distributed ray tracing, beside the same scenes without it.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use anyhow::{Context, Result};
use rayline::shape::{Geometry, Luminaire, Shape};
use rayline::{Camera, Light, LinearRgb, Material, Optics, Scene};

use super::entries::{LARGE_M0, M3, M4F};
use super::measured::Measured;
use super::{gallery, measure_all, write_page};
use crate::board::Board;
use crate::convert;
use crate::picture::{Mode, Number, Size};
use crate::request::Request;
use crate::session::Session;
use crate::table::{Align, Table, with_commas};

/// Size of the pictures.
const SIZE: Size = Size { width: 160, height: 120 };

/// The boards, with the number system that each computes in.
const ON: [(&str, &str, Number); 3] =
    [("M4F, `f32`", M4F, Number::F32), ("M3", M3, Number::Fixed), ("M0", LARGE_M0, Number::Fixed)];

/// An effect, and the scene that shows it: one of the gallery, or [`CLASSIC`].
struct Effect {
    name: &'static str,
    scene: &'static str,
    /// The ways with and without the effect.
    ways: [Way; 2],
}

const fn effect(name: &'static str, scene: &'static str) -> Effect {
    Effect { name, scene, ways: [Way::Sampled, Way::Plain] }
}

/// An effect in closed form.
const fn closed_form(name: &'static str, scene: &'static str) -> Effect {
    Effect { name, scene, ways: [Way::ClosedForm, Way::Plain] }
}

/// The built-in scene.
const CLASSIC: &str = "classic";

const EFFECTS: [Effect; 9] = [
    effect("lens", "camera-lens"),
    effect("motion", "camera-motion"),
    effect("gloss", "material-gloss"),
    effect("translucency", "material-translucent"),
    effect("two lamps, by rays", "light-area"),
    closed_form("two lamps, closed form", "light-area"),
    effect("two lamps among balls, by rays", "light-closed-form"),
    closed_form("two lamps among balls, closed form", "light-closed-form"),
    Effect { name: "smooth edges, realtime", scene: CLASSIC, ways: [Way::Smooth, Way::Stepped] },
];

const HEAD: &str = "\
# The costs of distributed ray tracing

A command writes this page; do not edit it: `cargo boards --effects docs/effects.md`.

Rays and instructions of one sample a pixel, 160x120, exact, beside those of the same scene without the
effect: with a pinhole, at rest, with sharp mirrors and glass, and with points in place of lamps. Several
samples cost as many times as much. The last row is `classic` in realtime quality, with smooth edges and with
stepped ones. The Pico's processor executes the M0's instructions.
";

/// A way in which a scene is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Plain,
    Sampled,
    ClosedForm,
    Stepped,
    Smooth,
}

impl Way {
    fn mode(self) -> Mode {
        match self {
            Self::Plain | Self::Sampled | Self::ClosedForm => Mode::Exact,
            Self::Stepped => Mode::Realtime,
            Self::Smooth => Mode::Smooth,
        }
    }
}

/// The programs: each scene in each of its ways once, on each board.
fn programs() -> Vec<(&'static str, Way, usize)> {
    let mut programs = Vec::new();
    for effect in &EFFECTS {
        for way in effect.ways {
            for board in 0..ON.len() {
                let program = (effect.scene, way, board);
                if !programs.contains(&program) {
                    programs.push(program);
                }
            }
        }
    }
    programs
}

/// Measures all effects, and writes the page.
pub(crate) fn run(file: &Path, timeout: Duration) -> Result<()> {
    let folder = tempfile::tempdir()?;
    let programs = programs();
    let scenes: Vec<PathBuf> = (EFFECTS.iter().filter(|effect| effect.scene != CLASSIC))
        .map(|effect| gallery().join(effect.scene).with_extension("ron"))
        .collect();
    for bytes in convert::to_bytes(&scenes, folder.path())? {
        plain(&bytes)?;
    }
    let mut sessions = Vec::new();
    for &(scene, way, on) in &programs {
        let (_, board, number) = ON.get(on).copied().context("there is no such board")?;
        let board = Board::named(board)?;
        let plain = if way == Way::Plain { PLAIN } else { "" };
        let bytes = folder.path().join(format!("{scene}{plain}.rayline"));
        let file = bytes.to_str().context("a path that is not UTF-8")?;
        let source = if scene == CLASSIC { CLASSIC } else { file };
        let (size, mode, closed_form) = (Some(SIZE), way.mode(), way == Way::ClosedForm);
        let request = Request { size, number, mode, closed_form, ..Request::new(source)? };
        sessions.push(Session::new(board, request.on(board), timeout));
    }
    let measured = measure_all(&sessions, folder.path())?;
    write_page(file, HEAD, &table(&programs, &measured))
}

/// The table, of the figures of these programs.
fn table(programs: &[(&str, Way, usize)], measured: &[Measured]) -> Table {
    let mut headings = vec![("effect", Align::Left), ("rays/pixel", Align::Right), ("without", Align::Right)];
    for (name, ..) in ON {
        headings.extend([(name, Align::Right), ("without", Align::Right)]);
    }
    let mut table = Table::new(headings);
    for effect in &EFFECTS {
        let figures = |way, board| {
            let place = programs.iter().position(|program| *program == (effect.scene, way, board))?;
            measured.get(place)
        };
        let rays = |figures: &Measured| format!("{:.2}", figures.rays_per_pixel());
        let instructions = |figures: &Measured| with_commas(figures.instructions_per_pixel().round() as u64);
        let ways = effect.ways;
        let cell =
            |text: &dyn Fn(&Measured) -> String, way, board| figures(way, board).map_or("-".into(), text);
        let mut row = vec![effect.name.to_owned()];
        row.extend(ways.map(|way| cell(&rays, way, 0)));
        for board in 0..ON.len() {
            row.extend(ways.map(|way| cell(&instructions, way, board)));
        }
        table.push(row);
    }
    table
}

/// The end of the name of a scene without effects.
const PLAIN: &str = "-plain";

/// Writes a scene without what needs samples beside it.
fn plain(file: &Path) -> Result<()> {
    let bytes = fs::read(file)?;
    let mut memory = rayline_build_support::memory_for(&bytes);
    let scene = Scene::<Shape<'_>>::from_bytes(&bytes, &mut memory)?;
    let optics: Vec<Option<Optics>> = (scene.materials.iter())
        .map(|material| Some(Optics { gloss: None, translucency: None, ..*material.optics? }))
        .collect();
    let materials: Vec<Material<'_>> = (scene.materials.iter().zip(&optics))
        .map(|(material, optics)| Material { optics: optics.as_ref(), ..*material })
        .collect();
    let point = |light: &Light| {
        let Light::Object(object) = light else { return *light };
        let object = scene.objects.get(usize::from(object.0));
        let Some(luminaire) = object.and_then(|object| object.shape.luminaire()) else { return *light };
        let position = match luminaire {
            Luminaire::Ball { center, .. } | Luminaire::Disc { center, .. } => center,
            Luminaire::Rectangle { corner, right, up } => corner + (right + up) * 0.5,
            _ => return *light,
        };
        Light::Point { position, color: LinearRgb::gray(0.7) }
    };
    let lights: Vec<Light> = scene.lights.iter().map(point).collect();
    let camera = Camera { lens: None, ..scene.camera };
    let plain = Scene { camera, materials: &materials, lights: &lights, motions: &[], ..scene };
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    convert::write(&plain, &file.with_file_name(format!("{stem}{PLAIN}.rayline")))
}
