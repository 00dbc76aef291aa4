//! Shading of a surface and the recursion: Whitted's model with Phong's highlight.

use glam::{DQuat, DVec3};
use rayline::{Ends, Figure, Light, Material, Optics, Placed, Placement, Space, Texture};

use super::background::background;
use super::{Ray, Textbook, color, optics, vector};

impl Textbook<'_> {
    /// The light that comes along a ray after `bounces` bounces. The pixel receives the share `throughput` of
    /// it.
    pub(super) fn trace(&self, ray: Ray, bounces: u8, throughput: DVec3) -> DVec3 {
        let Some((object, crossing)) = self.nearest(ray) else {
            return background(&self.scene.background, ray.direction);
        };
        let material = &self.scene.materials[usize::from(object.material.0)];
        let optics = material.optics.unwrap_or(&Optics::PLAIN);
        let point = ray.origin + ray.direction * crossing.t + crossing.geometric * crossing.lift;
        let view = -ray.direction;
        let normal = if crossing.normal.dot(view) < 0.0 { -crossing.normal } else { crossing.normal };
        let local = self.local_light(material, optics, point, normal, view);

        let from_outside = crossing.geometric.dot(view) > 0.0;
        let ior = f64::from(material.ior);
        let before = f64::from(optics.outside.ior);
        let indices = if from_outside { (before, ior) } else { (ior, before) };
        let refraction = snell(ray.direction, normal, indices);
        let behind = refraction.map(|direction| -direction.dot(normal));
        let (mirror, glass) = optics::shares(material, optics, indices, normal.dot(view), behind);
        let follow = |share: DVec3, direction: DVec3, is_mirrored: bool| {
            let throughput = throughput * share;
            if bounces >= self.settings.bounces
                || share == DVec3::ZERO
                || throughput.max_element() < f64::from(self.settings.cutoff)
            {
                return DVec3::ZERO;
            }
            let next = Ray { origin: point, direction };
            let length = self.nearest(next).map(|(_, crossing)| crossing.t);
            let mut dimmed = DVec3::ONE;
            let is_behind = crossing.geometric.dot(direction) < 0.0;
            dimmed *= optics::absorbed(optics, is_behind, length.unwrap_or(1e30));
            if let (true, Some(length)) = (is_mirrored, length) {
                dimmed *= optics::faded(&optics.reflection_falloff, length);
            }
            share * dimmed * self.trace(next, bounces + 1, throughput * dimmed)
        };
        let mut refracted = DVec3::ZERO;
        if let Some(direction) = refraction {
            refracted = follow(glass, direction, false);
        }
        // A bent normal does not mirror rays into the body, but along its surface.
        let facing = if from_outside { crossing.geometric } else { -crossing.geometric };
        let mut mirrored = ray.direction.reflect(normal);
        let height = facing.dot(mirrored);
        if height < 0.0 {
            mirrored = (mirrored + facing * (1.0 / 4096.0 - height)).normalize();
        }
        local + follow(mirror, mirrored, true) + refracted
    }

    /// The light from a surface by ambient light and by the lights that are visible from the point.
    fn local_light(
        &self,
        material: &Material,
        optics: &Optics,
        point: DVec3,
        normal: DVec3,
        view: DVec3,
    ) -> DVec3 {
        assert!(material.maps.is_empty(), "the textbook renderer does not support maps");
        let pigment = pigment(&material.color, point);
        let ambient: Vec<DVec3> = (self.scene.lights.iter())
            .filter_map(
                |light| if let Light::Ambient { color: light } = light { Some(color(*light)) } else { None },
            )
            .collect();
        let ambient = if ambient.is_empty() { DVec3::ONE } else { ambient.into_iter().sum() };
        let mut sum = pigment * ambient * f64::from(material.ambient) + color(optics.emission);
        for light in self.scene.lights {
            let (toward, distance, emitted) = match *light {
                Light::Point { position, color: emitted } => {
                    let toward = vector(position) - point;
                    (toward.normalize(), toward.length(), color(emitted))
                }
                Light::Directional { direction, color: emitted } => {
                    (-vector(direction).normalize(), f64::INFINITY, color(emitted))
                }
                Light::Lamp(lamp) => {
                    let toward = vector(lamp.position) - point;
                    let (toward, distance) = (toward.normalize(), toward.length());
                    (toward, distance, optics::emitted(&lamp, toward, distance))
                }
                Light::Ambient { .. } => continue,
                _ => panic!("the textbook renderer does not support this light"),
            };
            let lambert = normal.dot(toward);
            if lambert <= 0.0 {
                continue;
            }
            let highlight = optics::highlight(optics, normal, view, toward).max(0.0);
            let highlight = highlight.powf(f64::from(material.shininess)) * f64::from(material.specular);
            let share =
                pigment * f64::from(material.diffuse) * lambert + color(optics.reflection_color) * highlight;
            sum += share * emitted * self.transmission(Ray { origin: point, direction: toward }, distance);
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
        Texture::Placed(placed) => figure(placed, point),
        _ => panic!("the textbook renderer does not support this texture"),
    }
}

/// The color of a figure that is placed in the scene.
fn figure(placed: &Placed<'_>, point: DVec3) -> DVec3 {
    let Placement { space, size, rotation, origin } = placed.placement;
    assert_eq!(space, Space::Scene, "the textbook renderer does not support textures on surfaces");
    let turned = DQuat::from_rotation_z(f64::from(rotation.z))
        * DQuat::from_rotation_y(f64::from(rotation.y))
        * DQuat::from_rotation_x(f64::from(rotation.x));
    let at = turned.inverse() * (point - vector(origin)) / vector(size);
    match placed.figure {
        Figure::Squares(squares) => {
            let even = at.floor().element_sum().rem_euclid(2.0) < 0.5;
            color(if even { squares.even } else { squares.odd })
        }
        Figure::Stripes(stripes) => {
            let is_first = at.x.rem_euclid(1.0) < f64::from(stripes.width);
            color(if is_first { stripes.first } else { stripes.second })
        }
        Figure::Gradient(gradient) => {
            let [across, _] = gradient.ends.axes();
            let share = match across {
                Ends::Mirror => 1.0 - (at.x.rem_euclid(2.0) - 1.0).abs(),
                Ends::Extend => at.x.clamp(0.0, 1.0),
                _ => at.x.rem_euclid(1.0),
            };
            color(gradient.from).lerp(color(gradient.to), share)
        }
        Figure::Brick(wall) => {
            let shift = at.y.floor().rem_euclid(2.0) / 2.0;
            let (x, y) = ((at.x + shift).rem_euclid(1.0), at.y.rem_euclid(1.0));
            let is_mortar = x < f64::from(wall.gap[0]) || y < f64::from(wall.gap[1]);
            color(if is_mortar { wall.mortar } else { wall.brick })
        }
        _ => panic!("the textbook renderer does not support this figure"),
    }
}

/// The refracted direction by Snell's law, `n₁ sin θ₁ = n₂ sin θ₂`, as the sum of its parts along the surface
/// and across it; `None` under total internal reflection. The normal faces the incoming ray.
fn snell(incoming: DVec3, normal: DVec3, (n1, n2): (f64, f64)) -> Option<DVec3> {
    let across = normal * incoming.dot(normal);
    let along = (incoming - across) * (n1 / n2);
    let sine = along.length();
    (sine <= 1.0).then(|| along - normal * (1.0 - sine * sine).sqrt())
}
