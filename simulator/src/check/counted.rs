//! Estimates from instructions that were counted on emulated boards.

use rayline::builtin::{CLASSIC, FLAKE, FLAKE_10, FLAKE_820};
use rayline::limits::FEW_OBJECTS;
use rayline::shape::{Model, Shape};
use rayline::{Object, Scene};
use serde::Deserialize;

use super::boards::Core;

/// The table of counts in the repository, written by `cargo boards --bench --update`.
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
    /// The cycles of a frame on one core while all cores work, if the emulator counts them.
    cycles: Option<u64>,
    text_bytes: u64,
    stack_bytes: u64,
}

/// The counts for one kind of processor.
pub(super) struct Counted {
    /// The counts of `classic`, a program that draws balls and a polygon.
    classic: Figures,
    /// The size of code relative to that for an M4F.
    length: f64,
    /// The counts of scenes with one kind of shape each, on an M4F.
    spheres: Figures,
    torus: Figures,
    csg: Figures,
    mesh: Figures,
    many: Figures,
    /// The bytes of code that the hierarchy takes more than the candidates. In fixed point it is 0, because
    /// pixels are not traced side by side.
    hierarchy: f64,
    /// The instructions of a ray, relative to those on an M4F.
    slowness: f64,
    /// The instructions of a ray on an M4F for several numbers of balls, in ascending order.
    growth: [Growth; 4],
    /// The cycles of an instruction.
    cycles: f64,
}

/// The instructions of a ray in a scene with this number of objects.
#[derive(Clone, Copy)]
struct Growth {
    objects: f64,
    per_ray: f64,
}

#[derive(Clone, Copy, Default)]
struct Figures {
    text: f64,
    per_ray: f64,
    stack: f64,
}

impl Counted {
    pub(super) fn new(core: Core) -> Self {
        // The table is part of the program, and a test checks that it can be read.
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
        let growth = |scene: &str, objects: &[Object<Shape<'_>>]| Growth {
            objects: objects.len() as f64,
            per_ray: figures(M4F, scene).per_ray,
        };
        // From 91 to 820 balls only the data of the scene grows, which gives the bytes of an object. From 10
        // to 91 balls the code grows as well, by the hierarchy.
        let [few, many, most] = [(FLAKE_10, "flake-10"), (FLAKE, "flake-91"), (FLAKE_820, "flake-820")]
            .map(|(scene, name)| (scene.objects.len() as f64, figures(M4F, name).text));
        let per_object = (most.1 - many.1) / (most.0 - many.0);
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
            hierarchy: if core.has_fpu() { many.1 - few.1 - (many.0 - few.0) * per_object } else { 0.0 },
            slowness: classic.per_ray / figures(M4F, "classic").per_ray,
            growth: [
                growth("classic", CLASSIC.objects),
                growth("flake-10", FLAKE_10.objects),
                growth("flake-91", FLAKE.objects),
                growth("flake-820", FLAKE_820.objects),
            ],
            cycles: find(PICO, "classic").map_or(1.0, |count| {
                (PICO_CORES * count.cycles.unwrap_or(count.instructions)) as f64 / count.instructions as f64
            }),
        }
    }

    /// The counts of those measured kinds of shapes that the scene has.
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

    /// The bytes of code, for the measured kinds of shapes.
    pub(super) fn code(&self, scene: &Scene<'_>) -> u64 {
        let more: f64 = self.kinds(scene).map(|figures| (figures.text - self.spheres.text).max(0.0)).sum();
        let hierarchy = if scene.objects.len() > FEW_OBJECTS { self.hierarchy } else { 0.0 };
        (self.classic.text + more * self.length + hierarchy) as u64
    }

    /// An estimate of the stack in bytes: that of `classic`, multiplied by the relative stack of the scene's
    /// most expensive kind of shape or of the hierarchy.
    pub(super) fn stack(&self, scene: &Scene<'_>) -> u64 {
        let many = (scene.objects.len() > FEW_OBJECTS).then_some(self.many);
        let dearest = self.kinds(scene).chain(many).map(|figures| figures.stack / self.spheres.stack);
        (self.classic.stack * dearest.fold(1.0, f64::max)) as u64
    }

    /// An estimate of the cycles of a ray: those for this number of balls, or those for the scene's most
    /// expensive kind of shape, whichever is larger.
    pub(super) fn cycles_per_ray(&self, scene: &Scene<'_>) -> f64 {
        let kinds = self.kinds(scene).map(|figures| figures.per_ray);
        kinds.fold(self.per_ray_among(scene.objects.len() as f64), f64::max) * self.slowness * self.cycles
    }

    /// The instructions of a ray on an M4F in a scene of `objects` balls. Between the measured numbers, and
    /// beyond the largest, a power law is used.
    fn per_ray_among(&self, objects: f64) -> f64 {
        let [fewest, few, more, most] = self.growth;
        let (from, to) = match objects {
            _ if objects < few.objects => (fewest, few),
            _ if objects < more.objects => (few, more),
            _ => (more, most),
        };
        let power = (to.per_ray / from.per_ray).ln() / (to.objects / from.objects).ln();
        from.per_ray * (objects.max(fewest.objects) / from.objects).powf(power)
    }
}

const M4F: &str = "mps2-an386";

/// The board whose cycles are counted in addition to its instructions. All boards are assumed to need as many
/// cycles for an instruction.
const PICO: &str = "pico-dual";
const PICO_CORES: u64 = 2;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_what_is_asked_for() {
        for core in [Core::M0, Core::M3, Core::M4F] {
            let counted = Counted::new(core);
            let Counted {
                classic,
                spheres,
                torus,
                csg,
                mesh,
                many,
                hierarchy,
                length,
                slowness,
                growth,
                cycles,
            } = counted;
            for figures in [classic, spheres, torus, csg, mesh, many] {
                assert!(figures.text > 8192.0 && figures.per_ray > 50.0 && figures.stack > 1024.0);
            }
            // With the groups of neighboring pixels.
            let expected = if core.has_fpu() { 13e3..15e3 } else { 0.0..1.0 };
            assert!(expected.contains(&hierarchy), "{hierarchy}");
            assert!(length >= 1.0 && slowness >= 1.0);
            // The balls and the floor.
            assert_eq!(growth.map(|growth| growth.objects), [5.0, 11.0, 92.0, 821.0]);
            assert!(growth.is_sorted_by(|a, b| a.per_ray < b.per_ray));
            assert!((1.2..1.6).contains(&cycles), "{cycles}");
        }
    }

    #[test]
    fn rays_cost_as_measured_for_the_measured_numbers_of_objects() {
        let counted = Counted::new(Core::M4F);
        for Growth { objects, per_ray } in counted.growth {
            assert!((counted.per_ray_among(objects) / per_ray - 1.0).abs() < 1e-9);
        }
        // Scenes with fewer balls than the smallest take as much, scenes with more take more.
        let among = |objects| counted.per_ray_among(objects);
        assert_eq!(among(1.0), among(5.0));
        assert!(among(50.0) > among(11.0) && among(50.0) < among(92.0) && among(5000.0) > among(821.0));
    }
}
