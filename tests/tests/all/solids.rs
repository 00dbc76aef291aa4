//! Comparisons of pictures of curved solids: the core in all number systems with the textbook renderer, and
//! with POV-Ray if it is installed.

use std::path::Path;

use rayline::math::Fixed;
use rayline::shape::{
    Blob, Cone, Csg, CsgStep, Cuboid, Cylinder, Ellipsoid, Instances, Mesh, Metaballs, Model, Plane, Pose,
    Quadric, Shape, Solid, Sphere, Torus,
};
use rayline::{Background, Camera, Light, LinearRgb, Material, Object, Scene, Settings, Texture, Vec3};
use rayline_tests::textbook::Textbook;
use rayline_tests::{Picture, PovrayPicture, assert_alike, core_picture, settings};

const CAMERA: Camera = Camera {
    eye: Vec3::new(0.5, 4.5, 9.0),
    target: Vec3::new(0.0, 0.2, 0.0),
    up: Vec3::new(0.0, 1.0, 0.0),
    vertical_fov: 0.6,
    lens: None,
};

const LIGHTS: [Light; 2] = [
    Light::Point { position: Vec3::new(-6.0, 9.0, 7.0), color: LinearRgb::gray(0.7) },
    Light::Point { position: Vec3::new(8.0, 5.0, 4.0), color: LinearRgb::gray(0.3) },
];

const fn plastic(r: f32, g: f32, b: f32) -> Material<'static> {
    let color = Texture::Solid(LinearRgb::new(r, g, b));
    Material { ambient: 0.1, color, specular: 0.4, shininess: 40.0, ..Material::matte(LinearRgb::WHITE) }
}

const MATERIALS: [Material; 5] = [
    plastic(0.8, 0.3, 0.1),
    plastic(0.1, 0.5, 0.7),
    Material { reflectance: 0.6, diffuse: 0.3, ..plastic(0.8, 0.7, 0.4) },
    Material { transmittance: 0.8, diffuse: 0.1, reflectance: 0.2, ior: 1.5, ..plastic(1.0, 1.0, 1.0) },
    Material {
        color: Texture::checker_xz(LinearRgb::gray(0.7), LinearRgb::gray(0.3), 1.0),
        ..Material::matte(LinearRgb::WHITE)
    },
];

/// Asserts that all pictures of solids with these materials on a floor are alike.
#[track_caller]
fn check(name: &str, solids: &[(Shape<'_>, u16)]) {
    check_with(settings(4), name, solids);
}

/// Asserts the same for pictures of this size.
#[track_caller]
fn check_with(settings: Settings, name: &str, solids: &[(Shape<'_>, u16)]) {
    let floor = Shape::Plane(Plane::new(Vec3::new(0.0, -1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)));
    let objects: Vec<_> =
        solids.iter().chain([&(floor, 4)]).map(|(shape, material)| Object::new(*shape, *material)).collect();
    let background = Background::Solid(LinearRgb::new(0.2, 0.3, 0.5));
    let scene = Scene {
        camera: CAMERA,
        background,
        objects: &objects,
        materials: &MATERIALS,
        lights: &LIGHTS,
        motions: &[],
    };
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let single = core_picture::<f32>(&scene, settings);
    let against = |other: &str, picture: &Picture| {
        picture.write(&directory.join(format!("{name}-{other}.png")));
        assert_alike(directory, name, ("f32", &single), (other, picture));
    };
    against("textbook", &Textbook::new(&scene, settings).picture());
    against("f64", &core_picture::<f64>(&scene, settings));
    against("fixed", &core_picture::<Fixed>(&scene, settings));
    if let Some(povray) = PovrayPicture::render(&scene, settings, &directory.join("povray"), name) {
        against("povray", &povray.picture);
    }
}

/// The quadric x² + z² = y² / 2 + 1/4, up to 1 above and below its center.
const fn waisted(center: Vec3, capped: bool) -> Quadric {
    let coefficients = [1.0, -0.5, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.25];
    Quadric { center, coefficients, min: Vec3::new(-2.0, -1.0, -2.0), max: Vec3::new(2.0, 1.0, 2.0), capped }
}

#[test]
fn ellipsoids_and_quadrics() {
    let slanted = Ellipsoid {
        center: Vec3::new(-1.6, 0.0, 1.6),
        axes: [Vec3::new(0.9, 0.3, 0.2), Vec3::new(-0.1, 0.6, 0.1), Vec3::new(-0.2, 0.2, 0.5)],
    };
    // The paraboloid y = x² + z² - 1, filled with glass up to 1/2.
    let bowl = Quadric {
        center: Vec3::new(1.5, 0.0, 2.0),
        coefficients: [1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, -0.99],
        min: Vec3::new(-2.0, -2.0, -2.0),
        max: Vec3::new(2.0, 0.5, 2.0),
        capped: true,
    };
    // The hyperbolic cylinder x z = 0.04.
    let saddle = Quadric {
        center: Vec3::new(0.0, 0.0, -2.5),
        coefficients: [0.0, -0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.1, 0.0, -0.04],
        min: Vec3::new(-0.8, -0.99, -0.8),
        max: Vec3::new(0.8, 1.0, 0.8),
        capped: true,
    };
    let pebble = Ellipsoid::new(Vec3::new(0.0, -0.5, 3.0), Vec3::new(0.7, 0.2, 0.4));
    check(
        "quadrics",
        &[
            (Shape::Ellipsoid(slanted), 0),
            (Shape::Quadric(bowl), 3),
            (Shape::Quadric(waisted(Vec3::new(-2.2, 0.001, -1.5), true)), 1),
            (Shape::Quadric(waisted(Vec3::new(2.5, 0.001, -1.5), false)), 2),
            (Shape::Quadric(saddle), 0),
            (Shape::Ellipsoid(pebble), 2),
        ],
    );
}

#[test]
fn tori() {
    let ring = |center: Vec3, axis: Vec3, major_radius: f32, minor_radius: f32| {
        Shape::Torus(Torus { center, axis, major_radius, minor_radius })
    };
    let up = Vec3::new(0.0, 1.0, 0.0);
    check(
        "tori",
        &[
            (ring(Vec3::new(-1.6, -0.6, 1.5), up, 0.8, 0.4), 0),
            (ring(Vec3::new(-1.3, 0.0, 1.5), Vec3::new(0.3, 0.2, 1.0), 0.8, 0.15), 2),
            (ring(Vec3::new(1.4, -0.3, 2.0), Vec3::new(0.2, 1.0, 0.5), 0.6, 0.35), 3),
            (ring(Vec3::new(1.5, 0.2, -1.5), Vec3::new(1.0, 0.0, 0.7), 1.1, 0.03), 1),
            (ring(Vec3::new(-2.0, -0.1, -2.0), Vec3::new(0.1, 0.9, 0.7), 0.45, 0.44), 1),
        ],
    );
}

#[test]
fn metaballs() {
    let drop = |x: f32, y: f32, z: f32, radius: f32| Blob::new(Vec3::new(x, y, z), radius);
    let bitten = [
        drop(-2.2, 0.0, -0.5, 1.4),
        drop(-1.2, 0.2, -0.2, 1.3),
        drop(-0.4, -0.1, -0.7, 1.5),
        Blob { strength: -0.8, ..drop(-0.6, 0.0, 0.3, 0.8) },
    ];
    let glass = [drop(1.2, -0.4, 1.8, 1.0), drop(1.8, -0.2, 1.9, 0.9)];
    let ring: Vec<Blob> = (0..6u8)
        .map(|bead| {
            let (sine, cosine) = (f32::from(bead) * core::f32::consts::TAU / 6.0).sin_cos();
            drop(2.0 + cosine, 0.3 * sine, sine - 1.8, 0.9)
        })
        .collect();
    // POV-Ray takes a thousand times as long for a pixel of these as for one of a sphere, so the pictures are
    // small.
    check_with(
        Settings { width: 96, height: 96, ..settings(4) },
        "metaballs",
        &[
            (Shape::Metaballs(Metaballs::new(&bitten)), 0),
            (Shape::Metaballs(Metaballs::new(&glass)), 3),
            (Shape::Metaballs(Metaballs::new(&ring)), 1),
        ],
    );
}

#[test]
fn instances() {
    // An arrow along x, with smooth sides and flat ends.
    let vertices = [
        Vec3::new(1.0, 0.0, 0.0),
        Vec3::new(-0.5, 0.4, 0.4),
        Vec3::new(-0.5, -0.4, 0.4),
        Vec3::new(-0.5, -0.4, -0.4),
        Vec3::new(-0.5, 0.4, -0.4),
    ];
    let triangles = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1], [1, 4, 3], [1, 3, 2]];
    let arrow = Model::Mesh(Mesh::new(&vertices, &triangles));
    let around: Vec<Pose> = (0..7u8)
        .map(|index| {
            let angle = f32::from(index) * core::f32::consts::TAU / 7.0;
            let origin = Vec3::new(3.0 * angle.cos(), 0.1 * f32::from(index), -3.0 * angle.sin());
            Pose::at(origin).turned(Vec3::new(0.4 * f32::from(index), angle, 0.2))
        })
        .collect();
    let steps = [
        CsgStep::Solid(Solid::Sphere(Sphere::new(Vec3::ZERO, 1.0))),
        CsgStep::Solid(Solid::Cylinder(Cylinder {
            base: Vec3::new(0.0, -2.0, 0.0),
            top: Vec3::new(0.0, 2.0, 0.0),
            radius: 0.5,
            capped: true,
        })),
        CsgStep::Difference,
    ];
    let bead = Model::Csg(Csg::new(&steps));
    let beads = [
        Pose::at(Vec3::new(-1.0, -0.2, 0.5)).turned(Vec3::new(0.0, 0.0, 0.5)),
        Pose::at(Vec3::new(1.0, -0.2, 0.5)).turned(Vec3::new(1.2, 0.5, 0.0)),
    ];
    let saddle = Model::Quadric(waisted(Vec3::ZERO, true));
    let lying = [Pose::at(Vec3::new(0.2, 0.0, -1.0)).turned(Vec3::new(0.0, 0.3, 1.5))];
    check(
        "instances",
        &[
            (Shape::Instances(Instances::new(&arrow, &around).sized(0.8)), 1),
            (Shape::Instances(Instances::new(&bead, &beads).sized(0.7)), 3),
            (Shape::Instances(Instances::new(&saddle, &lying).sized(0.5)), 0),
        ],
    );
}

#[test]
fn solids_put_together() {
    const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);
    let ball = |center: Vec3, radius: f32| CsgStep::Solid(Solid::Sphere(Sphere::new(center, radius)));
    let behind = |point: Vec3, normal: Vec3| CsgStep::Solid(Solid::Plane(Plane::new(point, normal)));
    let pillar = |base: Vec3, top: Vec3, radius: f32| {
        CsgStep::Solid(Solid::Cylinder(Cylinder { base, top, radius, capped: true }))
    };
    let (join, common, take_away) = (CsgStep::Union, CsgStep::Intersection, CsgStep::Difference);
    // A magnifying glass.
    let middle = Vec3::new(1.4, 0.1, 3.0);
    let toward = Vec3::new(-0.1, 0.5, 0.85);
    let lens = [ball(middle - toward * 1.6, 1.9), ball(middle + toward * 1.6, 1.9), common];
    // A ball with a bore along each axis.
    let center = Vec3::new(-1.9, 0.2, -1.5);
    let bore = |along: Vec3| pillar(center - along * 2.0, center + along * 2.0, 0.55);
    let along = Vec3::new(0.7, 0.0, 0.7);
    let across = Vec3::new(0.7, 0.0, -0.7);
    let bored = [ball(center, 1.1), bore(UP), take_away, bore(along), take_away, bore(across), take_away];
    // A glass bowl: a hollow ball without its upper half.
    let center = Vec3::new(1.9, 0.0, -1.0);
    let bowl = [ball(center, 0.99), ball(center, 0.85), take_away, behind(center + UP * 0.2, UP), common];
    // A mug with a handle that does not reach into it.
    let base = Vec3::new(-1.6, -0.99, 2.3);
    let wall = pillar(base, base + UP * 1.2, 0.55);
    let inside = pillar(base + UP * 0.1, base + UP * 2.0, 0.47);
    let handle = CsgStep::Solid(Solid::Torus(Torus {
        center: base + Vec3::new(0.55, 0.6, 0.2),
        axis: Vec3::new(-0.3, 0.0, 1.0),
        major_radius: 0.35,
        minor_radius: 0.08,
    }));
    let mug = [wall, handle, join, inside, take_away];
    // A cone with a part cut out.
    let cone = CsgStep::Solid(Solid::Cone(Cone {
        base: Vec3::new(0.2, -0.99, -3.0),
        base_radius: 0.9,
        top: Vec3::new(0.2, 1.0, -3.0),
        top_radius: 0.2,
        capped: true,
    }));
    let bitten = [cone, ball(Vec3::new(0.5, 0.2, -2.3), 0.6), take_away];
    // A die, with pips on the visible faces.
    let center = Vec3::new(0.1, -0.49, 0.6);
    let half = Vec3::new(0.5, 0.5, 0.5);
    let mut die = vec![CsgStep::Solid(Solid::Cuboid(Cuboid::aligned(center - half, center + half)))];
    die.extend([ball(center, 0.72), common]);
    let dots = [(0.0, 0.55, 0.0), (-0.2, -0.2, 0.55), (0.2, 0.2, 0.55), (0.55, 0.2, 0.2), (0.55, -0.2, -0.2)];
    for (x, y, z) in dots {
        die.extend([ball(center + Vec3::new(x, y, z), 0.12), take_away]);
    }
    check(
        "solids",
        &[
            (Shape::Csg(Csg::new(&die)), 1),
            (Shape::Csg(Csg::new(&lens)), 3),
            (Shape::Csg(Csg::new(&bored)), 0),
            (Shape::Csg(Csg::new(&bowl)), 3),
            (Shape::Csg(Csg::new(&mug)), 1),
            (Shape::Csg(Csg::new(&bitten)), 2),
        ],
    );
}
