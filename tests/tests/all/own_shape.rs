//! A shape and a distance field that are defined outside of the core: they join a set of shapes, and are
//! drawn, shaded, shadowed and refused like built-in ones.

use std::mem::MaybeUninit;
use std::path::Path;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use rayline::math::{Aabb, Extent, Fixed, Interval, Ray, Scale};
use rayline::shape::{
    Distance, DistanceField, Geometry, Implicit, Intersect, Plane, Quadric, Shape, Silhouette, Sphere,
};
use rayline::{
    Arena, Background, Camera, Fault, Light, LinearRgb, Material, Object, Part, PreparedScene, Real,
    Renderer, Scene, Settings, Surface, Texture, Through, Vec3, prepared_bytes,
};
use rayline_tests::{Picture, assert_alike, settings};

/// A dish that is open above: x² + z² = y · radius² / depth.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Dish {
    /// Its lowest point.
    bottom: Vec3,
    /// The radius of the rim.
    radius: f32,
    /// The height of the rim above the bottom: a sixteenth of the radius or more.
    depth: f32,
}

/// [`Dish`], prepared.
#[derive(Clone, Copy, Debug)]
struct PreparedDish<'m, R>(&'m DishData<R>);

/// The data of a [`PreparedDish`]. Radius, depth and bend are measured in `unit`.
#[derive(Clone, Copy, Debug)]
struct DishData<R> {
    bottom: Vec3<R>,
    middle: Vec3<R>,
    /// The distance from the middle to the rim. Squares of numbers that are measured in it keep their digits.
    unit: R,
    magnitude: R,
    radius: R,
    depth: R,
    /// radius² / depth / 2.
    half_bend: R,
}

impl Dish {
    const fn const_bytes<R: Real>(&self) -> usize {
        Arena::bytes::<DishData<R>>(1)
    }
}

impl Geometry for Dish {
    type Prepared<'m, R: Real> = PreparedDish<'m, R>;

    fn bytes<R: Real>(&self) -> usize {
        self.const_bytes::<R>()
    }

    fn extent(&self) -> Extent {
        Extent::solid(self.bottom.magnitude() + self.radius.larger(self.depth))
    }

    fn prepare<'m, R: Real>(&self, scale: Scale, memory: &mut Arena<'m>) -> Result<PreparedDish<'m, R>, Fault>
    where
        Self: 'm,
    {
        let Self { bottom, radius, depth } = *self;
        if !(bottom.magnitude() + radius + depth).is_finite() {
            return Err(Fault::NotFinite);
        }
        if !(radius > 0.0) {
            return Err(Fault::RadiusNotPositive);
        }
        if !(depth >= radius / 16.0) {
            return Err(Fault::Own {
                why: "a dish is too flat; make it deeper than a sixteenth of its radius",
            });
        }
        let (radius, depth) = (R::Setup::from_f32(radius), R::Setup::from_f32(depth));
        let (bottom, half) = (bottom.to::<R::Setup>(), R::Setup::from_f32(0.5));
        let unit = Vec3::new(radius, depth * half, R::Setup::ZERO).length();
        let body = DishData {
            bottom: scale.point(bottom),
            middle: scale.point(bottom + Vec3::new(R::Setup::ZERO, depth * half, R::Setup::ZERO)),
            unit: scale.length(unit),
            magnitude: scale.length(bottom.magnitude() + unit),
            radius: R::from_setup(radius / unit),
            depth: R::from_setup(depth / unit),
            half_bend: R::from_setup(radius * radius / depth / unit * half),
        };
        memory.store(body).map(PreparedDish)
    }
}

impl<R: Real> DishData<R> {
    /// A point relative to the bottom, in units.
    fn inside(&self, point: Vec3<R>) -> Vec3<R> {
        let Vec3 { x, y, z } = point - self.bottom;
        Vec3::new(x / self.unit, y / self.unit, z / self.unit)
    }
}

impl<R: Real> Intersect<R> for PreparedDish<'_, R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let body = self.0;
        let (from_middle, advance) = ray.nearest_to(body.middle);
        if from_middle.length() > body.unit {
            return None;
        }
        let (p, d) = (body.inside(body.middle + from_middle), ray.direction);
        // a t² + 2 b t + c = 0, without cancellation (Press et al., "Numerical Recipes", §5.6).
        let a = d.x * d.x + d.z * d.z;
        let b = p.x * d.x + p.z * d.z - body.half_bend * d.y;
        let c = p.x * p.x + p.z * p.z - (body.half_bend + body.half_bend) * p.y;
        let discriminant = b * b - a * c;
        if discriminant < R::ZERO {
            return None;
        }
        let root = discriminant.sqrt();
        let sum = if b < R::ZERO { root - b } else { -root - b };
        let (one, other) = (sum / a, c / sum);
        let roots = if one < other { [one, other] } else { [other, one] };
        let is_on_dish = |t: &R| {
            let height = p.y + d.y * *t;
            t.abs() < R::from_u16(2) && height > R::ZERO && height < body.depth
        };
        roots.into_iter().filter(is_on_dish).map(|t| advance + t * body.unit).find(|t| range.contains(*t))
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        let DishData { bottom, unit, radius, depth, magnitude, .. } = *self.0;
        let (aside, up) = (radius * unit, depth * unit);
        let bounds = Aabb {
            min: bottom - Vec3::new(aside, R::ZERO, aside),
            max: bottom + Vec3::new(aside, up, aside),
        };
        Some(bounds.padded(R::offset(magnitude)))
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let body = self.0;
        let p = body.inside(ray.at(t));
        // Half the gradient of x² + z² - 2 y · half_bend. It points away from the axis and down.
        let (normal, half_slope) = Vec3::new(p.x, -body.half_bend, p.z).unit_and_length();
        let half_value = (p.x * p.x + p.z * p.z) * R::from_f32(0.5) - body.half_bend * p.y;
        let on_dish = p - normal * (half_value / half_slope);
        let point = body.bottom + on_dish * body.unit;
        Surface { point, normal, shading_normal: normal, magnitude: body.magnitude, part: 0 }
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        let DishData { radius, .. } = *self.0;
        let Vec3 { x, z, .. } = self.0.inside(surface.point);
        let half = R::from_f32(0.5);
        [x, z].map(|across| across / radius * half + half)
    }
}

impl<R: Real> Silhouette<R> for PreparedDish<'_, R> {}

/// A ball, as a distance field.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Round(Sphere);

/// [`Round`], prepared.
#[derive(Clone, Copy, Debug)]
struct PreparedRound<R> {
    center: Vec3<R>,
    radius: R,
}

impl DistanceField for Round {
    type Prepared<R: Real> = PreparedRound<R>;

    fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedRound<R>, Fault> {
        let radius = scale.length(R::Setup::from_f32(self.0.radius));
        Ok(PreparedRound { center: scale.point(self.0.center.to()), radius })
    }
}

impl<R: Real> Distance<R> for PreparedRound<R> {
    fn distance(&self, point: Vec3<R>) -> R {
        (point - self.center).length() - self.radius
    }
}

rayline::shape_set! {
    /// A set with a shape that borrows. It cannot be read from files, since the dish cannot.
    #[allow(dead_code)]
    enum Borrowing<'a>;
    /// [`Borrowing`], prepared.
    #[allow(dead_code)]
    enum PreparedBorrowing {
        /// The dish.
        Dish(Dish),
        /// A mesh.
        Mesh(rayline::shape::Mesh<'a>),
    }
}

rayline::shape_set! {
    /// A dish, a ball in it, and the floor.
    enum Table;
    /// [`Table`], prepared.
    enum PreparedTable {
        /// The dish.
        Dish(Dish),
        /// The ball.
        Ball(Implicit<Round>),
        /// The floor.
        Floor(Plane),
    }
}

const DISH: Dish = Dish { bottom: Vec3::new(0.25, 0.5, -0.25), radius: 1.5, depth: 1.0 };
const BALL: Sphere = Sphere::new(Vec3::new(0.25, 1.25, 0.0), 0.5);
const ROUND: Implicit<Round> = Implicit {
    field: Round(BALL),
    min: Vec3::new(-0.375, 0.625, -0.625),
    max: Vec3::new(0.875, 1.875, 0.625),
};
const FLOOR: Plane = Plane::new(Vec3::ZERO, Vec3::new(0.0, 1.0, 0.0));

const MATERIALS: [Material; 3] = [
    Material {
        specular: 0.3,
        shininess: 20.0,
        reflectance: 0.2,
        diffuse: 0.7,
        ..Material::matte(LinearRgb::new(0.8, 0.5, 0.2))
    },
    Material { reflectance: 0.5, diffuse: 0.4, ..Material::matte(LinearRgb::new(0.3, 0.5, 0.8)) },
    Material {
        color: Texture::checker_xz(LinearRgb::gray(0.7), LinearRgb::gray(0.4), 1.0),
        ..Material::matte(LinearRgb::WHITE)
    },
];

const LIGHTS: [Light; 1] = [Light::Point { position: Vec3::new(2.0, 6.0, 2.0), color: LinearRgb::gray(0.8) }];

const fn scene<S>(objects: &[Object<S>]) -> Scene<'_, S> {
    let camera = Camera {
        eye: Vec3::new(0.5, 4.0, 6.0),
        target: Vec3::new(0.0, 0.7, 0.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.7,
        lens: None,
    };
    Scene {
        camera,
        background: Background::gray(0.1),
        objects,
        materials: &MATERIALS,
        lights: &LIGHTS,
        motions: &[],
    }
}

const OBJECTS: [Object<Table>; 3] = [
    Object::new(Table::Dish(DISH), 0),
    Object::new(Table::Ball(ROUND), 1),
    Object::new(Table::Floor(FLOOR), 2),
];

/// Prepares the scene in as much memory as it needs.
fn prepare<'m, R: Real, S: Geometry + 'm>(
    scene: &Scene<'m, S>,
    memory: &'m mut Vec<MaybeUninit<u8>>,
) -> Result<PreparedScene<'m, R, S>, rayline::SceneError> {
    let more = scene.objects.iter().map(|object| object.shape.bytes::<R>()).sum();
    let bytes = prepared_bytes::<R, S>(scene.objects.len(), scene.materials.len(), scene.lights.len(), more);
    memory.resize(bytes, MaybeUninit::uninit());
    PreparedScene::new(scene, memory)
}

fn draw<R: Real, S: Geometry>(prepared: &PreparedScene<'_, R, S>) -> Picture {
    let settings = Settings { width: 160, height: 120, ..settings(3) };
    let renderer = Renderer::new(prepared, settings).unwrap();
    let mut line = vec![Rgb888::BLACK; settings.width as usize];
    let mut pixels = vec![];
    for y in 0..settings.height {
        renderer.line(y, &mut line).unwrap();
        pixels.extend(line.iter().map(|color| [color.r(), color.g(), color.b()]));
    }
    Picture { width: settings.width, pixels }
}

#[test]
fn they_are_drawn_in_every_number_system_as_the_quadrics_that_they_are() {
    // The same scene, of built-in shapes.
    let bend = DISH.radius * DISH.radius / DISH.depth;
    let quadric = Quadric {
        center: DISH.bottom,
        coefficients: [1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -bend, 0.0, 0.0],
        min: Vec3::new(-2.0, -0.5, -2.0),
        max: Vec3::new(2.0, DISH.depth, 2.0),
        capped: false,
    };
    let objects = [
        Object::new(Shape::Quadric(quadric), 0),
        Object::new(Shape::Sphere(BALL), 1),
        Object::new(Shape::Plane(FLOOR), 2),
    ];
    let mut memory = vec![];
    let expected = draw(&prepare::<f64, _>(&scene(&objects), &mut memory).unwrap());

    fn check<R: Real>(name: &str, expected: &Picture) {
        let mut memory = vec![];
        let prepared = prepare::<R, _>(&scene(&OBJECTS), &mut memory).unwrap();
        let picture = draw(&prepared);
        assert_eq!(picture.pixels, draw(&prepared.without_acceleration()).pixels);
        let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
        picture.write(&directory.join(format!("own-shape-{name}.png")));
        assert_alike(directory, "own-shape", (name, &picture), ("quadrics", expected));
    }
    check::<f32>("f32", &expected);
    check::<f64>("f64", &expected);
    check::<Fixed>("fixed", &expected);
}

#[test]
fn it_stands_in_the_light() {
    let mut memory = vec![];
    let prepared = prepare::<f64, _>(&scene(&OBJECTS[..1]), &mut memory).unwrap();
    let up = |x: f64| Ray { origin: Vec3::new(x, 0.1, -0.25), direction: Vec3::new(0.0, 1.0, 0.0) };
    assert_eq!(prepared.light_through(&up(1.0), 5.0), Through::Nothing);
    assert_eq!(prepared.light_through(&up(1.0), 0.5), Through::All);
    assert_eq!(prepared.light_through(&up(1.8), 5.0), Through::All);
}

#[test]
fn it_is_refused_with_its_own_reason() {
    let refusal = |dish: Dish| {
        let objects = [OBJECTS[2], Object::new(Table::Dish(dish), 0)];
        let mut memory = vec![];
        prepare::<f32, _>(&scene(&objects), &mut memory).unwrap_err()
    };
    assert_eq!(refusal(Dish { radius: -1.0, ..DISH }).fault, Fault::RadiusNotPositive);
    assert_eq!(refusal(Dish { depth: f32::NAN, ..DISH }).fault, Fault::NotFinite);
    let flat = refusal(Dish { depth: 0.01, ..DISH });
    assert_eq!(flat.part, Part::Object(1));
    assert!(flat.to_string().contains("a dish is too flat"), "{flat}");
}
