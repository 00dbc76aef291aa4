//! The sizes of textures: faces on which the light of lamps changes fast get finer texels.

use super::Light;
use super::face::Face;
use super::lattice::{Lattice, Texel};
use super::probe::LightProbe;

/// The most texels along an edge.
const MOST: usize = 512;
/// The share of the budget that all faces get alike, for their areas.
const ALIKE: f64 = 0.25;
/// A face is fine enough if coarser texels would take away or add this share of all light.
const ENOUGH: f64 = 1e-4;

/// The lattices of faces, of so many texels in all.
///
/// # Errors
/// Even the smallest lattices have more texels: how many.
pub(super) fn lattices(
    faces: Vec<Face>,
    most_texels: usize,
    probe: &LightProbe<'_>,
    progress: &dyn Fn(f64),
) -> Result<Vec<Lattice>, usize> {
    let area: f64 = faces.iter().map(Face::whole_area).sum();
    let edge = (area / (most_texels as f64 * ALIKE)).sqrt();
    let sizes: Vec<_> = faces.iter().map(|face| size(face, edge)).collect();
    let mut spent: usize = sizes.iter().map(|[width, height]| width * height).sum();
    if spent > most_texels {
        return Err(faces.len() * 4);
    }
    let mut lattices = Vec::new();
    for (face, size) in faces.into_iter().zip(sizes) {
        let lattice = Lattice::new(face, size, probe);
        lattices.push((lattice.roughness(), lattice));
    }
    let light = |texel: &Texel| {
        let Light { r, g, b } = texel.arriving();
        (r + g + b) * texel.area
    };
    let all: f64 = lattices.iter().flat_map(|(_, lattice)| &lattice.texels).map(light).sum();
    loop {
        progress(spent as f64 / most_texels as f64);
        // Three more texels for each that there is.
        let may_grow = |lattice: &Lattice| {
            lattice.texels.len() * 3 <= most_texels - spent && lattice.width.max(lattice.height) < MOST
        };
        let open = lattices.iter_mut().filter(|(_, lattice)| may_grow(lattice));
        let Some((error, roughest)) = open.max_by(|(a, _), (b, _)| a.total_cmp(b)) else { break };
        if *error <= all * ENOUGH {
            break;
        }
        spent += roughest.texels.len() * 3;
        *roughest = roughest.finer(probe);
        *error = roughest.roughness();
    }
    Ok(lattices.into_iter().map(|(_, lattice)| lattice).collect())
}

/// The texels along the edges of a face: powers of two, of about this length, and 2 at least.
fn size(face: &Face, edge: f64) -> [usize; 2] {
    [face.right, face.up].map(|side| {
        let count = (side.length() / edge).max(2.0);
        // Rounded down, so that all together stay within their share.
        let power = count.min((MOST / 2) as f64).log2() as u32;
        1 << power
    })
}
