//! Scenes that are put together from choices: all shapes, extreme sizes, surfaces that touch or lie in one
//! plane, lights on surfaces, and cameras inside of things.

mod looks;
mod shapes;

use bumpalo::Bump;
use rayline::shape::{Disc, Rectangle, Shape, Sphere};
use rayline::{
    Camera, Falloff, Lamp, Lens, Light, LightCone, LinearRgb, Material, Motion, Object, ObjectId, Optics,
    Scene, Sides, Vec3,
};

use crate::choices::Choices;

/// Puts a scene together in `arena`. Nearly all can be drawn.
pub(crate) fn scene<'a>(choices: &mut Choices<'_>, arena: &'a Bump) -> Scene<'a> {
    choices.choose_lengths();
    let count = match choices.below(32) {
        0 => 0,
        // More than a set holds: these scenes get a hierarchy.
        1..=3 => choices.between(33, 70),
        4..=6 => choices.between(9, 32),
        _ => choices.between(1, 6),
    };
    let mut maker = Maker { choices, arena, places: Vec::new(), ways: Vec::new() };
    maker.make(count)
}

/// A scene that is being put together.
struct Maker<'c, 'b, 'a> {
    choices: &'c mut Choices<'b>,
    arena: &'a Bump,
    /// Points on and inside of what is there already: what comes next touches it.
    places: Vec<Vec3>,
    /// Directions of what is there already: what comes next is parallel.
    ways: Vec<Vec3>,
}

impl<'a> Maker<'_, '_, 'a> {
    fn make(&mut self, count: usize) -> Scene<'a> {
        let mut materials: Vec<_> = (0..self.choices.between(1, 4)).map(|_| self.material()).collect();
        // Of many objects most are of one simple kind, or else they would take too long.
        let mut objects: Vec<_> = (0..count)
            .map(|_| {
                let shape = if count > 8 { self.small_shape() } else { self.shape() };
                Object::new(shape, self.choices.below(materials.len()) as u16)
            })
            .collect();
        let mut lights: Vec<_> =
            (0..self.choices.one_of([1, 1, 2, 1, 3, 0, 5])).map(|_| self.light()).collect();
        if self.choices.chance(12) {
            lights.push(Light::Object(ObjectId(objects.len() as u16)));
            objects.push(Object::new(self.luminaire(), materials.len() as u16));
            materials.push(self.emitting());
        }
        if self.choices.chance(8) {
            lights.push(Light::Sky);
        }
        let motions = if self.choices.chance(12) { self.motions(objects.len()) } else { Vec::new() };
        Scene {
            camera: self.camera(),
            background: self.background(),
            objects: self.arena.alloc_slice_copy(&objects),
            materials: self.arena.alloc_slice_copy(&materials),
            lights: self.arena.alloc_slice_copy(&lights),
            motions: self.arena.alloc_slice_copy(&motions),
        }
    }

    /// A point: one of those that there are, beside one, or any.
    fn place(&mut self) -> Vec3 {
        let known = self.choices.pick(&self.places);
        match (known, self.choices.below(8)) {
            (Some(known), 0..=2) => known,
            (Some(known), 3) => known + self.way() * self.choices.length(),
            (Some(known), 4) => {
                let least = self.choices.one_of([1e-5, 1e-4, 1e-3, 1e-6]);
                known + self.way() * (least * (1.0 + known.length()))
            }
            _ => self.choices.point(),
        }
    }

    /// A direction of length 1: one of those that there are, or any.
    fn way(&mut self) -> Vec3 {
        let known = self.choices.pick(&self.ways);
        match (known, self.choices.below(4)) {
            (Some(known), 0) => known,
            (Some(known), 1) => -known,
            _ => self.choices.direction(),
        }
    }

    /// Remembers a point.
    fn keep(&mut self, place: Vec3) -> Vec3 {
        if self.places.len() < 64 && place.magnitude() <= 1e6 {
            self.places.push(place);
        }
        place
    }

    /// Remembers a direction.
    fn keep_way(&mut self, way: Vec3) -> Vec3 {
        if self.ways.len() < 64 {
            self.ways.push(way);
        }
        way
    }

    fn camera(&mut self) -> Camera {
        let (eye, target) = if self.choices.chance(50) {
            let target = self.choices.pick(&self.places).unwrap_or(Vec3::ZERO);
            let distance = self.choices.one_of([8.0, 3.0, 15.0, 1.0, 100.0, 1e4]);
            let [x, y, z] = [(); 3].map(|()| self.choices.within(-1.0, 1.0));
            (target + Vec3::new(x, y + 0.2, z) * distance, target)
        } else {
            // Often on a surface, or inside of something.
            (self.place(), self.place())
        };
        let eye = held(eye);
        let target =
            if (target - eye).length() > 1e-3 { held(target) } else { eye + Vec3::new(0.3, -0.2, -1.0) };
        let forward = (target - eye).normalized().unwrap_or(Vec3::new(0.0, 0.0, -1.0));
        let up = self.choices.one_of([
            Vec3::new(0.0, 1.0, 0.0),
            Vec3::new(0.0, 0.0, 1.0),
            Vec3::new(0.3, 0.5, 0.8),
        ]);
        let up = if forward.cross(up).length() > 0.01 { up } else { self.choices.across(forward) };
        let vertical_fov = match self.choices.below(8) {
            0 => self.choices.one_of([0.01, 2.9, 0.001]),
            _ => self.choices.within(0.3, 1.6),
        };
        let lens = self.choices.chance(10).then(|| {
            let focus = self.choices.within(0.5, 20.0);
            let blades = self.choices.one_of([0, 0, 3, 6]);
            Lens { radius: focus * self.choices.one_of([0.01, 0.1, 1.0]), focus, blades }
        });
        Camera { eye, target, up, vertical_fov, lens }
    }

    /// A light: on a surface or inside of something, beside a plane, very far, or anywhere.
    fn light(&mut self) -> Light {
        let color = self.bright();
        let position = if self.choices.chance(10) {
            self.choices.direction() * self.choices.one_of([1e3, 1e5, 5e5])
        } else if self.choices.chance(30) {
            Vec3::new(
                self.choices.within(-9.0, 9.0),
                self.choices.within(1.0, 12.0),
                self.choices.within(-9.0, 9.0),
            )
        } else {
            self.place()
        };
        let position = held(position);
        match self.choices.below(10) {
            0..=5 => Light::Point { position, color },
            6..=7 => Light::Directional { direction: self.way(), color },
            8 => {
                let falloff = match self.choices.below(3) {
                    0 => Falloff::NONE,
                    1 => Falloff::inverse_square(self.choices.within(0.1, 20.0)),
                    _ => Falloff {
                        constant: 1.0,
                        linear: self.choices.share(),
                        quadratic: self.choices.share(),
                    },
                };
                let bright = self.choices.within(0.0, 1.2);
                let direction = self.way();
                let dark = bright + self.choices.one_of([0.3, 0.01, 0.0]) + 1e-3;
                let cone = self.choices.chance(60).then_some(LightCone { direction, bright, dark });
                Light::Lamp(Lamp { position, color, falloff, cone })
            }
            _ => Light::Ambient { color: color * 0.2 },
        }
    }

    /// Motions of up to two of so many objects, and now and then of the camera.
    fn motions(&mut self, objects: usize) -> Vec<Motion> {
        let mut motions = Vec::new();
        if self.choices.chance(30) {
            motions.push(Motion::of_camera(self.motion()));
        }
        let first = self.choices.below(objects.max(1));
        for object in (first..objects).take(self.choices.between(1, 2)) {
            let motion = Motion::of_object(object as u16, self.motion());
            motions.push(if self.choices.chance(40) {
                let angle = self.choices.one_of([0.1, 1.0, 6.0, -40.0]);
                motion.spinning(held(self.place()), self.way(), angle)
            } else {
                motion
            });
        }
        motions
    }

    /// How far something moves.
    fn motion(&mut self) -> Vec3 {
        self.way() * self.choices.one_of([0.0, 0.01, 0.5, 5.0])
    }

    /// A shape that can be a lamp: above the scene, or touching what is there.
    fn luminaire(&mut self) -> Shape<'a> {
        let center = if self.choices.chance(50) { self.place() } else { self.choices.direction() * 9.0 };
        let (center, radius) = (held(center), self.choices.one_of([0.5, 2.0, 0.05]));
        let normal = self.way();
        let across = self.choices.across(normal);
        match self.choices.below(3) {
            0 => Shape::Sphere(Sphere::new(center, radius)),
            1 => Shape::Disc(Disc::new(center, normal, radius)),
            _ => Shape::Rectangle(Rectangle::new(center, across * radius, normal * radius)),
        }
    }

    /// A material that emits light.
    fn emitting(&mut self) -> Material<'a> {
        let LinearRgb { r, g, b } = self.bright();
        let emission = LinearRgb::new(r + 0.1, g + 0.1, b + 0.1);
        let emission_sides = self.choices.one_of([Sides::Both, Sides::Front]);
        let optics = self.arena.alloc(Optics { emission, emission_sides, ..Optics::PLAIN });
        Material { optics: Some(optics), ..Material::matte(LinearRgb::WHITE) }
    }

    /// The color of a light.
    fn bright(&mut self) -> LinearRgb {
        let strength = self.choices.one_of([1.0, 0.5, 0.8, 3.0]);
        let [r, g, b] = [(); 3].map(|()| self.choices.share() * strength);
        LinearRgb::new(r, g, b)
    }
}

/// The nearest point that a scene may name.
fn held(point: Vec3) -> Vec3 {
    let most = rayline::limits::MAX_COORDINATE;
    let [x, y, z] = [point.x, point.y, point.z].map(|coordinate| coordinate.clamp(-most, most));
    Vec3::new(x, y, z)
}
