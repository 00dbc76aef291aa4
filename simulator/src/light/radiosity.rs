//! Radiosity: the light that matte surfaces scatter onto each other, by progressive refinement (Cohen, Chen,
//! Wallace and Greenberg, "A Progressive Refinement Approach to Fast Radiosity Image Generation", SIGGRAPH
//! 1988).
//!
//! 1. Each texel scatters the light of lamps that it receives, also over mirrors and through glass, and emits
//!    light of its own: its *unshot* light.
//! 2. The patch with the most unshot light, a block of texels, sends it to all other texels. A texel receives
//!    the light times the form factor of the patch ([`form_factor`](super::form_factor)), times the share of
//!    the way that is free, which a ray finds; it scatters what it received, which is unshot again.
//! 3. Step 2 is repeated until little light is left.
//!
//! A patch that is large as seen from a texel is divided, down to its own texels (Hanrahan, Salzman and
//! Aupperle, "A Rapid Hierarchical Radiosity Algorithm", SIGGRAPH 1991): each part has its own light and its
//! own ray.

use rayon::prelude::*;

use super::lattice::{Lattice, Texel};
use super::probe::LightProbe;
use super::{Light, Vector, form_factor};

/// The patches along an edge of a face.
const PATCHES: usize = 8;
/// The share of all light that is left when the solution is done.
const REST: f64 = 1e-3;
/// A patch is divided if its area is larger than this share of its squared distance.
const LARGE: f64 = 0.25;
/// A patch counts as a point if its area is smaller than this share of its squared distance.
const SMALL: f64 = 0.02;

/// The surfaces of a scene that scatter light.
pub(super) struct Surfaces {
    pub(super) lattices: Vec<Lattice>,
    /// The vertices of meshes, each list with its object.
    pub(super) meshes: Vec<(usize, Vec<Texel>)>,
}

/// Some texels that send their light together.
#[derive(Clone, Debug)]
struct Patch {
    surface: usize,
    texels: Vec<usize>,
    columns: usize,
}

/// A part of the patch that sends its light.
struct Sender {
    point: Vector,
    normal: Vector,
    /// The area that can be seen.
    area: f64,
    /// The corners of a part of a face, and their area.
    outline: Option<([Vector; 4], f64)>,
    light: Light,
    parts: Vec<Sender>,
}

impl Surfaces {
    fn texels(&self, surface: usize) -> &[Texel] {
        let meshes = || self.meshes[surface - self.lattices.len()].1.as_slice();
        self.lattices.get(surface).map_or_else(meshes, |lattice| lattice.texels.as_slice())
    }

    /// The places at which light is computed.
    pub(super) fn points(&self) -> impl Iterator<Item = Vector> {
        let meshes = self.meshes.iter().map(|(_, texels)| texels);
        let all = self.lattices.iter().map(|lattice| &lattice.texels).chain(meshes);
        all.flatten().map(|texel| texel.point)
    }

    fn all(&mut self) -> impl Iterator<Item = &mut Vec<Texel>> {
        let meshes = self.meshes.iter_mut().map(|(_, texels)| texels);
        self.lattices.iter_mut().map(|lattice| &mut lattice.texels).chain(meshes)
    }

    /// Scatters light between the surfaces until little of it is left to scatter; `progress` is called with
    /// the finished share.
    pub(super) fn solve(&mut self, probe: &LightProbe<'_>, progress: &dyn Fn(f64)) {
        for texel in self.all().flatten() {
            texel.unshot = texel.arriving() * texel.reflectance + texel.emission;
        }
        let patches = self.patches();
        let all: f64 = patches.iter().map(|patch| self.power(patch)).sum();
        let mut left = all;
        while left > all * REST {
            let powers = patches.iter().map(|patch| self.power(patch));
            let most = powers.enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b));
            let Some((brightest, _)) = most else { break };
            self.shoot(&patches[brightest], probe);
            left = patches.iter().map(|patch| self.power(patch)).sum();
            progress((left / all).ln() / REST.ln());
        }
    }

    /// All patches: blocks of the texels of faces, and each vertex of a mesh by itself.
    fn patches(&self) -> Vec<Patch> {
        let mut patches = Vec::new();
        for (surface, lattice) in self.lattices.iter().enumerate() {
            let (wide, high) = (lattice.width.div_ceil(PATCHES), lattice.height.div_ceil(PATCHES));
            for line in (0..lattice.height).step_by(high) {
                for column in (0..lattice.width).step_by(wide) {
                    let columns = column..(column + wide).min(lattice.width);
                    let lines = line..(line + high).min(lattice.height);
                    let texels = lines
                        .flat_map(|line| columns.clone().map(move |column| line * lattice.width + column));
                    patches.push(Patch { surface, texels: texels.collect(), columns: columns.len() });
                }
            }
        }
        for (index, (_, texels)) in self.meshes.iter().enumerate() {
            let surface = self.lattices.len() + index;
            let patch = |texel| Patch { surface, texels: vec![texel], columns: 1 };
            patches.extend((0..texels.len()).map(patch));
        }
        patches
    }

    /// The unshot light of a patch, times its area.
    fn power(&self, patch: &Patch) -> f64 {
        let texels = self.texels(patch.surface);
        let power = |texel: &usize| {
            let Texel { unshot: Light { r, g, b }, area, .. } = texels[*texel];
            (r + g + b) * area
        };
        patch.texels.iter().map(power).sum()
    }

    /// Sends the unshot light of a patch to all other surfaces.
    fn shoot(&mut self, patch: &Patch, probe: &LightProbe<'_>) {
        let lines = patch.texels.len() / patch.columns.max(1);
        let sender = self.sender(patch, 0..patch.columns, 0..lines);
        let mut surfaces: Vec<_> = self.all().collect();
        for texel in &patch.texels {
            surfaces[patch.surface][*texel].unshot = Light::BLACK;
        }
        let is_flat = sender.outline.is_some();
        for (index, texels) in surfaces.into_iter().enumerate() {
            // A flat face sends nothing to itself.
            if is_flat && index == patch.surface {
                continue;
            }
            texels.par_iter_mut().filter(|texel| texel.area > 0.0).for_each(|texel| {
                let received = sender.light_at(texel, probe);
                texel.scattered = texel.scattered + received;
                texel.unshot = texel.unshot + received * texel.reflectance;
            });
        }
    }

    /// The sender of a block of a patch's texels, down to single texels.
    fn sender(
        &self,
        patch: &Patch,
        columns: core::ops::Range<usize>,
        lines: core::ops::Range<usize>,
    ) -> Sender {
        let texels = self.texels(patch.surface);
        if let (1, 1) = (columns.len(), lines.len()) {
            let index = patch.texels[lines.start * patch.columns + columns.start];
            let Texel { point, normal, area, unshot: light, .. } = texels[index];
            let outline = self.lattices.get(patch.surface).map(|lattice| lattice.outline(index));
            return Sender { point, normal, area, outline, light, parts: Vec::new() };
        }
        let is_wide = columns.len() >= lines.len();
        let halves = if is_wide {
            let middle = columns.start + columns.len() / 2;
            [(columns.start..middle, lines.clone()), (middle..columns.end, lines)]
        } else {
            let middle = lines.start + lines.len() / 2;
            [(columns.clone(), lines.start..middle), (columns, middle..lines.end)]
        };
        let parts = halves.map(|(columns, lines)| self.sender(patch, columns, lines));
        let area = parts.iter().map(|part| part.area).sum::<f64>();
        let share = |part: &Sender| if area > 0.0 { part.area / area } else { 0.5 };
        let [first, second] = &parts;
        // The corners run around from the lower left; the second half lies to the right, or above.
        let outline = match (&first.outline, &second.outline) {
            (Some(([a, b, _, d], one)), Some(([_, f, g, h], other))) => {
                Some((if is_wide { [*a, *f, *g, *d] } else { [*a, *b, *g, *h] }, one + other))
            }
            _ => None,
        };
        Sender {
            point: first.point * share(first) + second.point * share(second),
            normal: first.normal,
            area,
            outline,
            light: first.light * share(first) + second.light * share(second),
            parts: parts.into(),
        }
    }
}

impl Sender {
    /// The light that arrives at a texel.
    fn light_at(&self, texel: &Texel, probe: &LightProbe<'_>) -> Light {
        if !(self.area > 0.0) || (self.light.r + self.light.g + self.light.b) <= 0.0 {
            return Light::BLACK;
        }
        let place = (texel.point, texel.normal);
        let squared = (self.point - texel.point).length_squared();
        if self.area > squared * LARGE && !self.parts.is_empty() {
            return self.parts.iter().fold(Light::BLACK, |sum, part| sum + part.light_at(texel, probe));
        }
        let share = match &self.outline {
            Some((corners, area)) if self.area > squared * SMALL => {
                // The side of the face that sends no light is dark.
                if self.normal.dot(texel.point - corners[0]) <= 0.0 {
                    return Light::BLACK;
                }
                form_factor::of_polygon(place, corners) * (self.area / area)
            }
            Some(_) => form_factor::of_point(place, (self.point, self.normal, self.area)),
            // A vertex sends its light as from a disc of its area, which has no pole close by (Wallace,
            // Elmquist and Haines, "A Ray Tracing Algorithm for Progressive Radiosity", SIGGRAPH 1989).
            None => {
                let far = form_factor::of_point(place, (self.point, self.normal, self.area));
                far / (1.0 + self.area / (core::f64::consts::PI * squared))
            }
        };
        if !(share > 0.0) {
            return Light::BLACK;
        }
        let from = texel.point + texel.normal * probe.short;
        probe.through(from, self.point + self.normal * probe.short) * self.light * share
    }
}
