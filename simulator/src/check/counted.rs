//! What was counted on emulated boards.

use rayline::Scene;
use rayline::limits::FEW_OBJECTS;
use rayline::shape::{Model, Shape};
use serde::Deserialize;

use super::boards::Core;

/// The table that is kept with the source, as `cargo boards --bench --update` wrote it.
const TABLE: &str = include_str!("../../../firmware/boards.json");

#[derive(Deserialize)]
struct Counts {
    measured: Vec<Count>,
}

#[derive(Deserialize)]
struct Count {
    board: String,
    scene: String,
    mode: String,
    small: bool,
    rays: u64,
    instructions: u64,
    text_bytes: u64,
    stack_bytes: u64,
}

/// What a kind of processor takes.
pub(super) struct Counted {
    /// Of the program that draws balls and a polygon.
    classic: Figures,
    /// By how much code for another core is longer than for an M4F.
    length: f64,
    /// The scenes of one kind of shape each, on an M4F.
    spheres: Figures,
    torus: Figures,
    csg: Figures,
    mesh: Figures,
    many: Figures,
}

#[derive(Clone, Copy, Default)]
struct Figures {
    text: f64,
    per_ray: f64,
    stack: f64,
}

impl Counted {
    pub(super) fn new(core: Core) -> Self {
        // The table is part of the program: a test reads it.
        let counts = serde_json::from_str(TABLE).unwrap_or(Counts { measured: Vec::new() });
        let find = |board: &str, scene: &str| {
            let is_it = |count: &&Count| {
                count.board == board && count.scene == scene && count.mode == "exact" && !count.small
            };
            counts.measured.iter().find(is_it)
        };
        let figures = |board: &str, scene: &str| {
            find(board, scene).map_or(Figures::default(), |count| Figures {
                text: count.text_bytes as f64,
                per_ray: count.instructions as f64 / count.rays as f64,
                stack: count.stack_bytes as f64,
            })
        };
        let board = match core {
            Core::M0 => "microbit",
            Core::M3 => "mps2-an385",
            Core::M4F => M4F,
        };
        let classic = figures(board, "classic");
        Self {
            classic,
            length: classic.text / figures(M4F, "classic").text,
            spheres: figures(M4F, "spheres"),
            torus: figures(M4F, "torus"),
            csg: figures(M4F, "csg"),
            mesh: figures(M4F, "mesh"),
            many: figures(M4F, "flake-91"),
        }
    }

    /// The kinds of shapes that were measured, and whether the scene has them.
    fn kinds(&self, scene: &Scene<'_>) -> impl Iterator<Item = Figures> {
        let has = |is_it: fn(&Shape<'_>) -> bool| scene.objects.iter().any(|object| is_it(&object.shape));
        let is_csg = |shape: &Shape<'_>| match shape {
            Shape::Csg(_) => true,
            Shape::Instances(instances) => matches!(instances.model, Model::Csg(_)),
            _ => false,
        };
        let is_mesh = |shape: &Shape<'_>| match shape {
            Shape::Mesh(_) => true,
            Shape::Instances(instances) => matches!(instances.model, Model::Mesh(_)),
            _ => false,
        };
        let kinds = [
            (self.torus, has(|shape| matches!(shape, Shape::Torus(_)))),
            (self.csg, has(is_csg)),
            (self.mesh, has(is_mesh)),
        ];
        kinds.into_iter().filter_map(|(figures, is_there)| is_there.then_some(figures))
    }

    /// Bytes of code, as far as was measured.
    pub(super) fn code(&self, scene: &Scene<'_>) -> u64 {
        let more: f64 = self.kinds(scene).map(|figures| (figures.text - self.spheres.text).max(0.0)).sum();
        (self.classic.text + more * self.length) as u64
    }

    /// Bytes of stack, about: those of `classic`, and as many times more as the scene's dearest kind of shape takes, or the hierarchy.
    pub(super) fn stack(&self, scene: &Scene<'_>) -> u64 {
        let many = (scene.objects.len() > FEW_OBJECTS).then_some(self.many);
        let dearest = self.kinds(scene).chain(many).map(|figures| figures.stack / self.spheres.stack);
        (self.classic.stack * dearest.fold(1.0, f64::max)) as u64
    }

    /// Instructions of a ray, about: those of `classic`, and as many times more as the scene's dearest kind of shape takes.
    pub(super) fn instructions_per_ray(&self, scene: &Scene<'_>) -> f64 {
        let dearest =
            self.kinds(scene).map(|figures| figures.per_ray / self.spheres.per_ray).fold(1.0, f64::max);
        self.classic.per_ray * dearest
    }
}

const M4F: &str = "mps2-an386";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_what_is_asked_for() {
        for core in [Core::M0, Core::M3, Core::M4F] {
            let counted = Counted::new(core);
            let Counted { classic, spheres, torus, csg, mesh, many, length } = counted;
            for figures in [classic, spheres, torus, csg, mesh, many] {
                assert!(figures.text > 8192.0 && figures.per_ray > 50.0 && figures.stack > 1024.0);
            }
            assert!(length >= 1.0);
        }
    }
}
