//! The places at which light is computed: the texels of a face's texture, or the vertices of a mesh.

use rayline::LinearRgb;
use rayline::shape::Mesh;
use rayon::prelude::*;

use super::face::Face;
use super::photon_map::Place as Receiver;
use super::probe::LightProbe;
use super::{Light, Vector, vector};

/// A place at which light is computed: a patch of radiosity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Texel {
    pub(super) point: Vector,
    pub(super) normal: Vector,
    /// The area that can be seen: 0 for a texel beside its face, or inside of a body.
    pub(super) area: f64,
    /// The share of light that is scattered.
    pub(super) reflectance: Light,
    /// The light that the surface emits, if it is no lamp.
    pub(super) emission: Light,
    /// The light that arrives from lamps.
    pub(super) direct: Light,
    /// The light of lamps that arrives over mirrors and through glass.
    pub(super) caustic: Light,
    /// The light that arrives from other surfaces, which scatter it.
    pub(super) scattered: Light,
    /// The light that leaves the texel, and was not sent on yet.
    pub(super) unshot: Light,
}

/// The texels of a face, line after line from below.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    pub(super) face: Face,
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) texels: Vec<Texel>,
}

/// A place on a texel where light is measured.
type Place = (Vector, Vector);

/// The places on a texel, along each of its edges.
const PLACES: usize = 2;
/// A photon is spread at least so many times the length of a texel: over several, as a texture is smooth.
const REACH: f64 = 1.25;

impl Lattice {
    pub(super) fn new(face: Face, [width, height]: [usize; 2], probe: &LightProbe<'_>) -> Self {
        let area = face.whole_area() / (width * height * PLACES * PLACES) as f64;
        // A surface this close above a texel hides it, such as a lamp below a ceiling.
        let reach = area.sqrt() * 0.5;
        let texel = |index: usize| {
            let (column, line) = (index % width, index / width);
            let mut places = Vec::new();
            for place in 0..PLACES * PLACES {
                let within = |place: usize| (place as f64 + 0.5) / PLACES as f64;
                let x = (column as f64 + within(place % PLACES)) / width as f64;
                let y = (line as f64 + within(place / PLACES)) / height as f64;
                let point = face.point([x, y]);
                if face.has([x, y]) && !probe.is_hidden((point, face.normal), reach) {
                    places.push((point, face.normal));
                }
            }
            let center = [(column as f64 + 0.5) / width as f64, (line as f64 + 0.5) / height as f64];
            Texel::new((face.point(center), face.normal), &places, area * places.len() as f64, index, probe)
        };
        let mut texels: Vec<_> = (0..width * height).into_par_iter().map(texel).collect();
        let longest = (face.right.length() / width as f64).max(face.up.length() / height as f64);
        receive_photons(&mut texels, (face.object, Some(face.normal)), longest * REACH, probe);
        Self { face, width, height, texels }
    }

    /// The lattice with texels of half the size.
    pub(super) fn finer(&self, probe: &LightProbe<'_>) -> Self {
        Self::new(self.face.clone(), [self.width * 2, self.height * 2], probe)
    }

    /// The corners of a texel, around from the lower left, and its whole area.
    pub(super) fn outline(&self, index: usize) -> ([Vector; 4], f64) {
        let (column, line) = (index % self.width, index / self.width);
        let corner = |right: usize, up: usize| {
            let x = (column + right) as f64 / self.width as f64;
            self.face.point([x, (line + up) as f64 / self.height as f64])
        };
        let area = self.face.whole_area() / (self.width * self.height) as f64;
        ([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)], area)
    }

    /// How much the light of lamps on texels, also over mirrors and through glass, differs from what texels
    /// of twice the size would show: summed over their area.
    pub(super) fn roughness(&self) -> f64 {
        let coarser = self.coarser();
        let seen = self.texels.iter().enumerate().filter(|(_, texel)| texel.area > 0.0);
        seen.map(|(index, texel)| {
            let x = ((index % self.width) as f64 + 0.5) / self.width as f64;
            let y = ((index / self.width) as f64 + 0.5) / self.height as f64;
            let LinearRgb { r, g, b } = coarser.light_at(x, y);
            let here = texel.arriving();
            let apart = (r - here.r).abs() + (g - here.g).abs() + (b - here.b).abs();
            apart * texel.area
        })
        .sum()
    }

    /// The lattice with the means of four texels each.
    fn coarser(&self) -> Self {
        let (width, height) = (self.width / 2, self.height / 2);
        let mean = |index: usize| {
            let (column, line) = (index % width * 2, index / width * 2);
            let four = [(0, 0), (1, 0), (0, 1), (1, 1)]
                .map(|(right, up)| self.texels[(line + up) * self.width + column + right]);
            let area: f64 = four.iter().map(|texel| texel.area).sum();
            let sum = four.iter().fold(Light::BLACK, |sum, texel| sum + texel.arriving() * texel.area);
            let direct = if area > 0.0 { sum * (1.0 / area) } else { sum };
            Texel { area, direct, caustic: Light::BLACK, ..four[0] }
        };
        let texels = (0..width * height).map(mean).collect();
        Self { face: self.face.clone(), width, height, texels }
    }

    /// The light between the centers of texels, as a bilinear texture shows it.
    fn light_at(&self, x: f64, y: f64) -> Light {
        let between = |at: f64, count: usize| {
            let at = (at * count as f64 - 0.5).clamp(0.0, (count - 1) as f64);
            let first = (at as usize).min(count.saturating_sub(2));
            (first, (first + 1).min(count - 1), at - first as f64)
        };
        let ((left, right, across), (low, high, up)) = (between(x, self.width), between(y, self.height));
        let mut sum = (Light::BLACK, 0.0);
        for (column, line, share) in [
            (left, low, (1.0 - across) * (1.0 - up)),
            (right, low, across * (1.0 - up)),
            (left, high, (1.0 - across) * up),
            (right, high, across * up),
        ] {
            let texel = &self.texels[line * self.width + column];
            if texel.area > 0.0 {
                sum = (sum.0 + texel.arriving() * share, sum.1 + share);
            }
        }
        if sum.1 > 0.0 { sum.0 * (1.0 / sum.1) } else { sum.0 }
    }
}

/// Adds the light that photons bring to the texels of an object, or of its face with this normal, each
/// photon spread over this distance at least.
fn receive_photons(
    texels: &mut [Texel],
    surface: (usize, Option<Vector>),
    least: f64,
    probe: &LightProbe<'_>,
) {
    let place = |texel: &Texel| Receiver { point: texel.point, normal: texel.normal, area: texel.area };
    let places: Vec<_> = texels.iter().map(place).collect();
    let light = probe.photons.light(surface, &places, least);
    texels.iter_mut().zip(light).for_each(|(texel, light)| texel.caustic = light);
}

/// The vertices of a mesh, which is this object, as texels.
pub(super) fn vertices(mesh: &Mesh<'_>, object: usize, probe: &LightProbe<'_>) -> Vec<Texel> {
    let mut places: Vec<Vec<(Place, f64)>> = vec![Vec::new(); mesh.vertices.len()];
    for triangle in mesh.triangles {
        let corners = triangle.map(|corner| mesh.vertices.get(usize::from(corner)).copied());
        let [Some(a), Some(b), Some(c)] = corners else { continue };
        let corners = [a, b, c].map(vector);
        let across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let Some(normal) = across.normalized() else { continue };
        let middle = (corners[0] + corners[1] + corners[2]) * (1.0 / 3.0);
        for (corner, index) in corners.into_iter().zip(triangle) {
            // Close to the vertex, but surely on the triangle.
            let point = corner + (middle - corner) * 0.125;
            places[usize::from(*index)].push(((point, normal), across.length() / 6.0));
        }
    }
    let texel = |(index, places): (usize, &Vec<(Place, f64)>)| {
        let corner = vector(mesh.vertices[index]);
        let sum = places.iter().fold(Vector::ZERO, |sum, ((_, normal), area)| sum + *normal * *area);
        let normal = sum.normalized().unwrap_or(Vector::new(0.0, 1.0, 0.0));
        let is_seen = |((point, normal), _): &&(Place, f64)| !probe.is_hidden((*point, *normal), 0.0);
        let seen: Vec<_> = places.iter().filter(is_seen).collect();
        let area = seen.iter().map(|(_, area)| area).sum();
        let places: Vec<Place> = seen.into_iter().map(|(place, _)| *place).collect();
        Texel::new((corner, normal), &places, area, index, probe)
    };
    let mut texels: Vec<_> = places.par_iter().enumerate().map(texel).collect();
    receive_photons(&mut texels, (object, None), 0.0, probe);
    texels
}

impl Texel {
    /// All light that arrives.
    pub(super) fn arriving(&self) -> Light {
        self.direct + self.sent_by_surfaces()
    }

    /// The light that arrives from other surfaces, which scatter it, mirror it or let it through.
    pub(super) fn sent_by_surfaces(&self) -> Light {
        self.caustic + self.scattered
    }

    /// A texel with a middle, of which these places can be seen.
    fn new(
        (point, normal): Place,
        places: &[Place],
        area: f64,
        index: usize,
        probe: &LightProbe<'_>,
    ) -> Self {
        let mean = |light: &dyn Fn(&Place) -> Light| {
            let sum = places.iter().map(light).fold(Light::BLACK, |sum, light| sum + light);
            if places.is_empty() { Light::BLACK } else { sum * (1.0 / places.len() as f64) }
        };
        let emission = mean(&|place| probe.emission(*place));
        // A middle inside of a body sees nothing.
        let (point, normal) = match places {
            [first, ..] if probe.is_hidden((point, normal), 0.0) => *first,
            _ => (point, normal),
        };
        Self {
            point,
            normal,
            area,
            reflectance: mean(&|place| probe.reflectance(*place)),
            emission,
            direct: probe.shown(places, index) + emission * -1.0,
            caustic: Light::BLACK,
            scattered: Light::BLACK,
            unshot: Light::BLACK,
        }
    }
}
