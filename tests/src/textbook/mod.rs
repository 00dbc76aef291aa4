//! An independent renderer, written from the formulas of textbooks: recursive, on the heap, in `f64`, without
//! acceleration. It shares only the description of scenes with the core.
//!
//! Ray tracing is recursive, after Whitted ("An Improved Illumination Model for Shaded Display", CACM 1980).
//! Formulas are those of Glassner (ed.), "An Introduction to Ray Tracing", 1989, unless another source is
//! named.

mod background;
mod optics;
mod shading;
mod shapes;
mod solids;

use glam::{DMat4, DVec3};
use rayline::shape::Shape;
use rayline::{Background, LinearRgb, Object, Optics, Scene, Settings, Vec3};

use crate::Picture;

/// The smallest distance of a hit from the origin of a ray; nearer hits are on the surface that the ray
/// leaves. In `f64` and scenes of this size a point lies within about 1e-12 of its surface, and all parts are
/// larger than this distance.
const NEAR: f64 = 1e-7;

/// A renderer for one scene.
#[derive(Clone, Copy, Debug)]
pub struct Textbook<'s> {
    scene: &'s Scene<'s>,
    settings: Settings,
}

/// A half-line from `origin` along the unit vector `direction`.
#[derive(Clone, Copy, Debug)]
struct Ray {
    origin: DVec3,
    direction: DVec3,
}

/// An intersection of a ray with a surface.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    t: f64,
    /// The unit normal of the shape.
    geometric: DVec3,
    /// The unit normal to shade with.
    normal: DVec3,
    /// How far rays leave the surface beside the crossing, along the geometric normal.
    lift: f64,
}

impl<'s> Textbook<'s> {
    /// A renderer for this scene, with the size, bounces and cut-off of these settings.
    pub fn new(scene: &'s Scene<'s>, settings: Settings) -> Self {
        Self { scene, settings }
    }

    /// The picture in 8-bit linear light.
    pub fn picture(&self) -> Picture {
        let quantize = |light: f64| (light.clamp(0.0, 1.0) * 255.0).round() as u8;
        let pixels = self.radiance().into_iter().map(|light| light.to_array().map(quantize)).collect();
        Picture { width: self.settings.width, pixels }
    }

    /// The light at each pixel, line by line.
    pub fn radiance(&self) -> Vec<DVec3> {
        let Settings { width, height, .. } = self.settings;
        (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| self.pixel(x, y)).collect()
    }

    /// The light at one pixel.
    pub fn pixel(&self, x: u32, y: u32) -> DVec3 {
        let (width, height) = (f64::from(self.settings.width), f64::from(self.settings.height));
        let camera = &self.scene.camera;
        let eye = vector(camera.eye);
        let to_world = DMat4::look_at_rh(eye, vector(camera.target), vector(camera.up)).inverse();
        // The picture plane is at distance 1 from the eye; half its height is the tangent of half the angle
        // of view.
        let top = (f64::from(camera.vertical_fov) / 2.0).tan();
        let right = ((f64::from(x) + 0.5) / width * 2.0 - 1.0) * top * width / height;
        let up = (1.0 - (f64::from(y) + 0.5) / height * 2.0) * top;
        let direction = to_world.transform_vector3(DVec3::new(right, up, -1.0)).normalize();
        self.trace(Ray { origin: eye, direction }, 0, DVec3::ONE)
    }

    /// All intersections of a ray with an object, in no particular order.
    fn crossings(&self, ray: Ray, object: &'s Object<Shape<'s>>) -> Vec<Crossing> {
        let mut crossings = shapes::crossings(&object.shape, ray);
        crossings.retain(|crossing| crossing.t > NEAR);
        crossings
    }

    /// The first surface that a ray hits. If several are at the same distance, but for rounding, it is that
    /// of the first object.
    fn nearest(&self, ray: Ray) -> Option<(&'s Object<Shape<'s>>, Crossing)> {
        let objects = self.scene.objects.iter();
        let all: Vec<_> = objects
            .flat_map(|object| {
                self.crossings(ray, object).into_iter().map(move |crossing| (object, crossing))
            })
            .collect();
        let least = all.iter().map(|(_, crossing)| crossing.t).min_by(f64::total_cmp)?;
        all.into_iter().find(|(_, crossing)| crossing.t <= least + NEAR)
    }

    /// The share of light that passes along the first `distance` of a ray, after transmission at each surface
    /// and absorption between surfaces.
    fn transmission(&self, ray: Ray, distance: f64) -> DVec3 {
        let objects = self.scene.objects.iter();
        let mut all: Vec<_> = objects
            .flat_map(|object| {
                self.crossings(ray, object).into_iter().map(move |crossing| (object, crossing))
            })
            .filter(|(_, crossing)| crossing.t < distance)
            .collect();
        all.sort_by(|(_, a), (_, b)| a.t.total_cmp(&b.t));
        let (mut share, mut last) = (DVec3::ONE, 0.0);
        for (object, crossing) in all {
            let material = &self.scene.materials[usize::from(object.material.0)];
            let optics = material.optics.unwrap_or(&Optics::PLAIN);
            share *= color(optics.transmission_color) * f64::from(material.transmittance);
            let comes_from_behind = crossing.geometric.dot(ray.direction) > 0.0;
            share *= optics::absorbed(optics, comes_from_behind, crossing.t - last);
            last = crossing.t;
        }
        share
    }
}

/// The light of a background in this direction.
pub fn background_in(background: &Background<'_>, direction: Vec3) -> LinearRgb {
    let DVec3 { x, y, z } = background::background(background, vector(direction).normalize());
    LinearRgb::new(x as f32, y as f32, z as f32)
}

fn vector(vector: Vec3) -> DVec3 {
    DVec3::new(f64::from(vector.x), f64::from(vector.y), f64::from(vector.z))
}

fn color(color: LinearRgb) -> DVec3 {
    DVec3::new(f64::from(color.r), f64::from(color.g), f64::from(color.b))
}
