//! Light at a surface, and the recursion: Whitted's model with Phong's highlight.

use glam::DVec3;
use rayline::{Light, Material, Texture};

use super::{Ray, Textbook, color, vector};

impl Textbook<'_> {
    /// The light that comes along a ray, after so many bounces, of which the pixel gets the share `throughput`.
    pub(super) fn trace(&self, ray: Ray, bounces: u8, throughput: f64) -> DVec3 {
        let Some((object, crossing)) = self.nearest(ray) else {
            return color(self.scene.background);
        };
        let material = &self.scene.materials[usize::from(object.material.0)];
        let point = ray.origin + ray.direction * crossing.t;
        let view = -ray.direction;
        let normal = if crossing.normal.dot(view) < 0.0 { -crossing.normal } else { crossing.normal };
        let local = self.local_light(material, point, normal, view);

        let mirrored = ray.direction.reflect(normal);
        let from_outside = crossing.geometric.dot(view) > 0.0;
        let mut reflectance = f64::from(material.reflectance);
        let transmittance = f64::from(material.transmittance);
        let follow = |share: f64, direction: DVec3| {
            let throughput = throughput * share;
            if bounces >= self.settings.bounces
                || share == 0.0
                || throughput < f64::from(self.settings.cutoff)
            {
                return DVec3::ZERO;
            }
            share * self.trace(Ray { origin: point, direction }, bounces + 1, throughput)
        };
        let mut refracted = DVec3::ZERO;
        if transmittance > 0.0 {
            match snell(ray.direction, normal, f64::from(material.ior), from_outside) {
                Some(direction) => refracted = follow(transmittance, direction),
                None => reflectance += transmittance,
            }
        }
        local + follow(reflectance, mirrored) + refracted
    }

    /// Ambient light, and what the lights that are seen from a point bring.
    fn local_light(&self, material: &Material, point: DVec3, normal: DVec3, view: DVec3) -> DVec3 {
        let pigment = pigment(&material.color, point);
        let mut sum = pigment * f64::from(material.ambient);
        for light in self.scene.lights {
            let (toward, distance, emitted) = match *light {
                Light::Point { position, color: emitted } => {
                    let toward = vector(position) - point;
                    (toward.normalize(), toward.length(), emitted)
                }
                Light::Directional { direction, color: emitted } => {
                    (-vector(direction).normalize(), f64::INFINITY, emitted)
                }
                _ => panic!("the textbook knows no such light"),
            };
            let lambert = normal.dot(toward);
            if lambert <= 0.0 {
                continue;
            }
            // The view ray, mirrored: 2 (N·V) N - V.
            let mirrored = 2.0 * normal.dot(view) * normal - view;
            let phong = mirrored.dot(toward).max(0.0).powf(f64::from(material.shininess));
            let share =
                pigment * f64::from(material.diffuse) * lambert + f64::from(material.specular) * phong;
            sum += share
                * color(emitted)
                * self.transmission(Ray { origin: point, direction: toward }, distance);
        }
        sum
    }
}

/// The color of a texture at a point.
fn pigment(texture: &Texture, point: DVec3) -> DVec3 {
    match texture {
        Texture::Solid(solid) => color(*solid),
        Texture::Checker(checker) => {
            let cell = (point * vector(checker.cells_per_unit)).floor();
            let even = cell.element_sum().rem_euclid(2.0) < 0.5;
            color(if even { checker.even } else { checker.odd })
        }
        _ => panic!("the textbook knows no such texture"),
    }
}

/// The refracted direction by Snell's law, `n₁ sin θ₁ = n₂ sin θ₂`, put together from its parts along the surface
/// and across it; `None` where there is no such angle. The normal faces the incoming ray.
fn snell(incoming: DVec3, normal: DVec3, ior: f64, from_outside: bool) -> Option<DVec3> {
    let (n1, n2) = if from_outside { (1.0, ior) } else { (ior, 1.0) };
    let across = normal * incoming.dot(normal);
    let along = (incoming - across) * (n1 / n2);
    let sine = along.length();
    (sine <= 1.0).then(|| along - normal * (1.0 - sine * sine).sqrt())
}
