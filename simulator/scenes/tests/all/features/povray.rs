//! A scene for each row about the export to POV-Ray.

use std::path::Path;

use rayline::shape::{Csg, CsgStep, Instances, Mesh, Model, Pose, Shape, Solid, Sphere};
use rayline::{
    Background, Camera, Encoding, Ends, Falloff, Figure, Filter, Fresnel, Image, Lamp, Lens, Light,
    LightCone, LinearRgb, Map, Material, Motion, Mover, Noise, Object, Onto, Optics, Pixels, Placed,
    Placement, Scene, Settings, Sides, Texture, Vec3,
};
use rayline_formats::Pictures;
use rayline_formats::povray::to_povray;

use super::table::{Seen, compare};

const TOWARD: Vec3 = Vec3::new(0.0, 0.0, -1.0);
const AT: Vec3 = Vec3::new(0.0, 3.0, 4.0);
const MESH: Mesh<'static> =
    Mesh::new(&[Vec3::ZERO, Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)], &[[0, 1, 2]]);
const MOVING: &[Motion] = &[Motion { of: Mover::Camera, by: AT, spin: None }];
const IMAGE: Image<'static> = Image {
    width: 1,
    height: 1,
    pixels: Pixels::Rgb888(&[9, 99, 199]),
    encoding: Encoding::Srgb,
    filter: Filter::Nearest,
    ends: Ends::Repeat,
};

fn matte() -> Material<'static> {
    Material::matte(LinearRgb::WHITE)
}

fn ball() -> Shape<'static> {
    Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0))
}

/// The export of a scene with one object and one light, after a change; whether it has these texts.
fn written(
    shape: Shape<'_>,
    material: Material<'_>,
    light: Light,
    change: impl Fn(&mut Scene<'_>),
    has: &[&str],
) -> Seen {
    let camera = Camera {
        eye: Vec3::new(0.0, 0.0, 9.0),
        target: Vec3::ZERO,
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.7,
        lens: None,
    };
    let (objects, materials, lights) = ([Object::new(shape, 0)], [material], [light]);
    let mut scene = Scene {
        camera,
        background: Background::BLACK,
        objects: &objects,
        materials: &materials,
        lights: &lights,
        motions: &[],
    };
    change(&mut scene);
    let mut pictures = Pictures::beside(Path::new("a.pov"));
    let text = to_povray(&scene, &Settings::new(40, 30), &mut pictures).map_err(|error| error.to_string())?;
    let files: Vec<_> = pictures.files().map(|(path, _)| path.display().to_string()).collect();
    let all = text + &files.concat();
    Ok((Vec::new(), has.iter().all(|part| all.contains(part))))
}

const SUN: Light = Light::Directional { direction: TOWARD, color: LinearRgb::WHITE };

fn of_shape(shape: Shape<'_>, has: &[&str]) -> Seen {
    written(shape, matte(), SUN, |_| {}, has)
}

fn of_light(light: Light, has: &[&str]) -> Seen {
    written(ball(), matte(), light, |_| {}, has)
}

fn of_material(material: Material<'_>, has: &[&str]) -> Seen {
    written(ball(), material, SUN, |_| {}, has)
}

fn of_optics(optics: Optics, has: &[&str]) -> Seen {
    of_material(Material { transmittance: 0.5, ior: 1.5, optics: Some(&optics), ..matte() }, has)
}

fn written_rows() -> Vec<(&'static str, Seen)> {
    let model = Model::Mesh(MESH);
    let [large, small] = [(Vec3::ZERO, 1.0), (TOWARD, 0.5)]
        .map(|(center, radius)| CsgStep::Solid(Solid::Sphere(Sphere::new(center, radius))));
    let steps = [large, small, CsgStep::Difference];
    let cut = Csg::new(&steps);
    let poses = [Pose::at(Vec3::ZERO), Pose::at(AT)];
    let lamp = Lamp { position: AT, color: LinearRgb::WHITE, falloff: Falloff::NONE, cone: None };
    let far = Lamp { falloff: Falloff::inverse_square(2.0), ..lamp };
    let spot = Lamp { cone: Some(LightCone { direction: TOWARD, bright: 0.2, dark: 0.4 }), ..lamp };
    let picture = Placed::new(Figure::Image(IMAGE), Placement::SURFACE);
    let absorbing = Optics { absorption: LinearRgb::new(0.1, 0.2, 0.3), ..Optics::CLEAR };
    let lens = Some(Lens { radius: 0.1, focus: 9.0, blades: 0 });
    vec![
        ("shapes", of_shape(ball(), &["sphere {"])),
        ("meshes", of_shape(Shape::Mesh(MESH), &["mesh"])),
        ("solids cut out of each other", of_shape(Shape::Csg(cut), &["difference {"])),
        ("instances", of_shape(Shape::Instances(Instances::new(&model, &poses)), &["<0, 3, 4>"])),
        (
            "point lights",
            of_light(Light::Point { position: AT, color: LinearRgb::WHITE }, &["light_source { <0, 3, 4>"]),
        ),
        ("directional lights", of_light(SUN, &["parallel"])),
        ("spot lights", of_light(Light::Lamp(spot), &["spotlight"])),
        ("falloff by the inverse square", of_light(Light::Lamp(far), &["fade_power 2"])),
        (
            "images",
            of_material(Material { color: Texture::Placed(&picture), ..matte() }, &["image_map", "a-1.png"]),
        ),
        ("Fresnel terms", of_optics(Optics::CLEAR, &["fresnel"])),
        ("absorption", of_optics(absorbing, &["fade_color"])),
        ("emission", of_optics(Optics { emission: LinearRgb::WHITE, ..Optics::PLAIN }, &["emission"])),
        ("lenses", written(ball(), matte(), SUN, |scene| scene.camera.lens = lens, &["aperture"])),
    ]
}

fn refused_rows() -> Vec<(&'static str, Seen)> {
    let bump =
        [Map { onto: Onto::Bump { height: 0.1, step: 0.1 }, texture: Texture::Solid(LinearRgb::WHITE) }];
    let colored = [Map { onto: Onto::Emission, texture: Texture::Solid(LinearRgb::WHITE) }];
    let noise = Figure::Noise(Noise { low: LinearRgb::BLACK, high: LinearRgb::WHITE, octaves: 1 });
    let noise = Placed::new(noise, Placement::SURFACE);
    let blades = Some(Lens { radius: 0.1, focus: 9.0, blades: 6 });
    let opaque = |optics: Optics| of_material(Material { optics: Some(&optics), ..matte() }, &[]);
    let tinted = Mesh { colors: Some(&[[255, 0, 0]; 3]), ..MESH };
    vec![
        ("bump and normal maps", of_material(Material { maps: &bump, ..matte() }, &[])),
        (
            "maps of colors of optics",
            of_material(Material { maps: &colored, optics: Some(&Optics::PLAIN), ..matte() }, &[]),
        ),
        ("gloss, translucency", of_optics(Optics { gloss: Some(9.0), ..Optics::PLAIN }, &[])),
        ("lenses with blades", written(ball(), matte(), SUN, |scene| scene.camera.lens = blades, &[])),
        ("motion", written(ball(), matte(), SUN, |scene| scene.motions = MOVING, &[])),
        ("one-sided surfaces", opaque(Optics { sides: Sides::Front, ..Optics::PLAIN })),
        (
            "thin sheets that mirror by Fresnel's equations",
            of_optics(Optics { thin: true, fresnel: Fresnel::Exact, ..Optics::PLAIN }, &[]),
        ),
        ("colors of vertices", of_shape(Shape::Mesh(tinted), &[])),
        ("noise, marble, wood", of_material(Material { color: Texture::Placed(&noise), ..matte() }, &[])),
        ("the light of the sky", of_light(Light::Sky, &[])),
    ]
}

#[test]
fn povray() {
    compare("POV-Ray (export)", 10, written_rows().into_iter().chain(refused_rows()).collect());
}
