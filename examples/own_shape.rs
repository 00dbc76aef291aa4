//! A shape of your own: a bowl, the lower half of a sphere. `rayline::shape::guide` explains each function.

use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};
use rayline::builtin::CLASSIC;
use rayline::math::{Aabb, Extent, Interval, Ray, Scale};
use rayline::shape::{Geometry, Intersect, Plane, PreparedSphere, Silhouette, Sphere};
use rayline::{Arena, Camera, Fault, Object, PreparedScene, Real, Renderer, Scene, Settings};
use rayline::{Surface, Vec3, Workspace, prepared_bytes};

#[derive(Clone, Copy, Debug, PartialEq)]
struct Bowl(Sphere);

#[derive(Clone, Copy, Debug)]
struct PreparedBowl<R: Real>(PreparedSphere<R>, R); // and the height at which the bowl ends

impl Bowl {
    const fn const_bytes<R: Real>(&self) -> usize {
        Arena::bytes::<R>(0) // `prepare` stores nothing
    }
}

impl Geometry for Bowl {
    type Prepared<'m, R: Real> = PreparedBowl<R>;
    fn extent(&self) -> Extent {
        self.0.extent()
    }
    fn prepare<'m, R: Real>(&self, scale: Scale, memory: &mut Arena<'m>) -> Result<PreparedBowl<R>, Fault>
    where
        Self: 'm,
    {
        let sphere = self.0.prepare(scale, memory)?; // checks all numbers
        Ok(PreparedBowl(sphere, scale.length(R::Setup::from_f32(self.0.center.y))))
    }
}

impl<R: Real> Intersect<R> for PreparedBowl<R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let inside = self.0.spans(ray);
        let ends = inside.as_slice().iter().flat_map(|part| [part.min, part.max]);
        ends.filter(|t| range.contains(*t)).find(|t| ray.at(*t).y < self.1)
    }
    fn bounds(&self) -> Option<Aabb<R>> {
        self.0.bounds() // a box that is larger than the shape costs time, and no pixel
    }
    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        self.0.surface(ray, t)
    }
    fn uv(&self, surface: &Surface<R>, scale: Scale) -> [R; 2] {
        self.0.uv(surface, scale)
    }
}

impl<R: Real> Silhouette<R> for PreparedBowl<R> {} // the defaults will do
rayline::shape_set! {
    enum Table;
    enum PreparedTable {
        Bowl(Bowl),
        Ball(Sphere),
        Top(Plane),
    }
}

static OBJECTS: [Object<Table>; 3] = [
    Object::new(Table::Bowl(Bowl(Sphere::new(Vec3::new(0.0, 0.6, 0.0), 1.2))), 0),
    Object::new(Table::Ball(Sphere::new(Vec3::new(0.1, 0.05, 0.1), 0.6)), 2),
    Object::new(Table::Top(Plane::new(Vec3::new(0.0, -0.6, 0.0), Vec3::new(0.0, 1.0, 0.0))), 4),
];

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let Scene { background, materials, lights, motions, .. } = CLASSIC;
    let camera = Camera { eye: Vec3::new(0.0, 2.0, 3.0), target: Vec3::ZERO, ..CLASSIC.camera };
    let scene = Scene { camera, background, objects: &OBJECTS, materials, lights, motions };
    let mut memory = Workspace::<{ prepared_bytes::<f32, Table>(3, 5, 3, 0) }>::new();
    let scene = PreparedScene::<f32, _>::new(&scene, memory.lend())?;
    let mut display = SimulatorDisplay::new(Size::new(160, 120));
    Renderer::new(&scene, Settings::new(160, 120))?.draw(&mut display, &mut [Rgb565::BLACK; 160])?;
    rayline_examples::save(&display, &OutputSettings::default(), "own_shape.png")
}
