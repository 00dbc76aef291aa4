//! The photon map: where light arrives that mirrors and glass sent on, and how bright it is there (Jensen,
//! "Global Illumination using Photon Maps", EGWR 1996).
//!
//! Jensen's method searches for the photons that are nearest to a place. Here each photon spreads its flux
//! over the texels around it, with the weights of Jensen's cone filter. The texels receive the whole flux: no
//! light is lost at the rims of surfaces. The radius of a photon is the distance of its [`NEIGHBORS`]th
//! neighbor among the photons of the same way (Breiman, Meisel and Purcell, "Variable Kernel Estimates of
//! Multivariate Densities", Technometrics 1977). So the radius shrinks where light is gathered, and with the
//! number of photons.

use rayon::prelude::*;

use super::emission::scaled;
use super::nearby::Nearby;
use super::{Light, Vector};

/// The photons over which a photon is spread.
const NEIGHBORS: usize = 24;
/// The smallest cosine between the normals of a photon's surface and of a texel that receives it.
const ALIKE: f64 = 0.3;

/// A photon that arrives at a surface behind a mirror or glass.
#[derive(Clone, Copy, Debug)]
pub(super) struct Photon {
    /// The object that it meets.
    pub(super) object: usize,
    pub(super) point: Vector,
    /// The unit normal, on the side from which it comes.
    pub(super) normal: Vector,
    pub(super) flux: Light,
    /// The beam of the photon, and the record of its bounces. Photons of the same way left the lamp as
    /// neighbors.
    pub(super) way: (usize, u32),
}

/// A part of a photon's way through free space, behind a mirror or glass.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight {
    pub(super) from: Vector,
    pub(super) direction: Vector,
    /// Infinite for a photon that leaves the scene.
    pub(super) length: f64,
    pub(super) flux: Light,
}

/// Where photons can arrive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) point: Vector,
    pub(super) normal: Vector,
    /// The area that it stands for; places without one receive no light.
    pub(super) area: f64,
}

/// All photons that arrived.
#[derive(Clone, Debug, Default)]
pub(super) struct PhotonMap {
    /// Sorted by object and way, each with its radius.
    photons: Vec<(Photon, f64)>,
    /// The parts of their ways through free space.
    pub(super) flights: Vec<Flight>,
}

impl PhotonMap {
    pub(super) fn new(mut photons: Vec<Photon>, flights: Vec<Flight>) -> Self {
        photons.sort_by_key(|photon| (photon.object, photon.way));
        let groups: Vec<_> = photons.chunk_by(|a, b| (a.object, a.way) == (b.object, b.way)).collect();
        let with_radius = |group: &&[Photon]| -> Vec<(Photon, f64)> {
            let points: Vec<_> = group.iter().map(|photon| photon.point).collect();
            let nearby = Nearby::new(&points);
            // The photon itself is the nearest.
            let radius = |photon: &Photon| nearby.distance(photon.point, NEIGHBORS + 1);
            group.par_iter().map(|photon| (*photon, radius(photon))).collect()
        };
        let photons = groups.par_iter().flat_map_iter(with_radius).collect();
        Self { photons, flights }
    }

    /// The light that photons bring to the places of an object, each spread over this distance at least. If
    /// all places lie on one face, `face` is its normal.
    pub(super) fn light(
        &self,
        (object, face): (usize, Option<Vector>),
        places: &[Place],
        least: f64,
    ) -> Vec<Light> {
        let mut light = vec![Light::BLACK; places.len()];
        let first = self.photons.partition_point(|(photon, _)| photon.object < object);
        let end = self.photons.partition_point(|(photon, _)| photon.object <= object);
        let is_on_face =
            |(photon, _): &&(Photon, f64)| face.is_none_or(|normal| normal.dot(photon.normal) > ALIKE);
        let photons: Vec<_> = self.photons[first..end].iter().filter(is_on_face).collect();
        let seen: Vec<_> = (0..places.len()).filter(|place| places[*place].area > 0.0).collect();
        if photons.is_empty() || seen.is_empty() {
            return light;
        }
        let points: Vec<_> = seen.iter().map(|place| places[*place].point).collect();
        let nearby = Nearby::new(&points);
        let farthest = nearby.distance(points[0], points.len());
        let mut shares = Vec::new();
        for (photon, radius) in photons {
            shares.clear();
            let mut radius = radius.max(least);
            // Between the vertices of a large triangle, none may be near.
            let most = 2.0 * ((photon.point - points[0]).length() + farthest).max(radius);
            while shares.is_empty() && radius <= most {
                nearby.within(photon.point, radius, &mut |position, distance| {
                    let place = &places[seen[position]];
                    if place.normal.dot(photon.normal) > ALIKE {
                        shares.push((seen[position], 1.0 - distance / radius));
                    }
                });
                radius *= 2.0;
            }
            let all: f64 = shares.iter().map(|(place, share)| share * places[*place].area).sum();
            for (place, share) in &shares {
                light[*place] = light[*place] + scaled(photon.flux, share / all);
            }
        }
        light
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: Vector = Vector::new(0.0, 1.0, 0.0);

    fn photon(x: f64, z: f64, normal: Vector) -> Photon {
        let flux = Light::new(1e-4, 0.0, 0.0);
        Photon { object: 1, point: Vector::new(x, 0.0, z), normal, flux, way: (0, 1) }
    }

    /// 10000 photons that fall evenly on a square make it as bright everywhere but at its rims, and none of
    /// their flux is lost.
    #[test]
    fn an_even_rain_of_photons_is_evenly_bright() {
        let at = |index: usize, count: usize| (index as f64 + 0.5) / count as f64;
        let rain = (0..10_000).map(|index| photon(at(index % 100, 100), at(index / 100, 100), UP));
        // Light that comes from below, or to another object, arrives elsewhere.
        let others = [photon(0.5, 0.5, -UP), Photon { object: 0, ..photon(0.5, 0.5, UP) }];
        let map = PhotonMap::new(rain.chain(others[1..].iter().copied()).collect(), Vec::new());
        for count in [8, 32] {
            let place = |index: usize| Place {
                point: Vector::new(at(index % count, count), 0.0, at(index / count, count)),
                normal: UP,
                area: 1.0 / (count * count) as f64,
            };
            let places: Vec<_> = (0..count * count).map(place).collect();
            let light = map.light((1, Some(UP)), &places, 1.25 / count as f64);
            let flux: f64 = light.iter().zip(&places).map(|(light, place)| light.r * place.area).sum();
            assert!((flux - 1.0).abs() < 1e-9, "{flux}");
            for (index, light) in light.iter().enumerate() {
                let is_inside = |place: usize| place >= 2 && place < count - 2;
                let most = if is_inside(index % count) && is_inside(index / count) { 0.02 } else { 0.25 };
                assert!((light.r - 1.0).abs() < most, "{count}, {index}: {}", light.r);
            }
        }
        // The nearest place on the same side receives a photon, however far away it is.
        let far = Place { point: Vector::new(9.0, 0.0, 0.0), normal: UP, area: 2.0 };
        let places = [Place { normal: -UP, point: Vector::ZERO, ..far }, far, Place { area: 0.0, ..far }];
        let light = map.light((0, None), &places, 0.1).iter().map(|light| light.r).collect::<Vec<_>>();
        assert!(light[0] == 0.0 && (light[1] - 0.5e-4).abs() < 1e-12 && light[2] == 0.0, "{light:?}");
        assert!(map.light((2, None), &places, 0.1).iter().all(|light| light.r == 0.0));
    }
}
