//! Scenes in the language of POV-Ray.
//!
//! POV-Ray renders the same picture as the core if the scene is written as follows:
//!
//! - Coordinates are written unchanged. POV-Ray is left-handed only where it derives one direction of the
//!   camera from the others, so all three are written; their lengths give the field of view.
//! - POV-Ray multiplies ambient and diffuse light by the share of light that the pigment does not transmit,
//!   so both are divided by that share.
//! - The picture may have any shape: its width is the height of the view times POV-Ray's own `image_width`
//!   over `image_height`.
//! - A light that falls off as the inverse square has a `fade_distance` close to 0. The core's lights are
//!   never brighter than without falloff; surfaces that are so close to a lamp differ.
//! - Textures are functions of x, y and z, see `pattern`; images are files beside the scene. A texture on
//!   surfaces is written for each object, with the formulas of its shape's u and v.
//! - Schlick's approximation for metals is written for each degree, with POV-Ray's pattern of the angle of
//!   incidence, which interpolates between degrees. POV-Ray's `metallic` highlights have nearly the core's
//!   color.
//! - POV-Ray keeps a list of the interiors that a ray is inside of. So the faces of one material are written
//!   as a union with one interior, which makes a closed solid of them. POV-Ray's indices of refraction are
//!   absolute. The index of a material with an `outside` is absolute, too; a sphere inside of a transparent
//!   sphere gets the product of both indices. Bodies that are made of open surfaces with a medium on each
//!   side cannot be expressed by POV-Ray's list.
//! - In POV-Ray a transmitted ray does not count as a bounce if the index is exactly 1, so a slightly larger
//!   index is written.
//! - Under total internal reflection POV-Ray mirrors all light, but the core mirrors reflectance plus
//!   transmittance. Both agree if these add up to 1, and in bodies without total internal reflection, such as
//!   a glass ball that is seen from outside.
//! - Where the normal of a smooth triangle mirrors a ray into the surface, both renderers follow it there.
//!
//! Render with `File_Gamma=1` and without anti-aliasing. The picture then equals that of
//! [`Transfer::Linear`](rayline::Transfer::Linear) but for rounding.

use rayline::shape::{Cone, CsgStep, Cylinder, Model, Shape, Sphere};
use rayline::{Background, Camera, Lens, Light, LinearRgb, Material, Object, Scene, Settings, Sky, Vec3};

use super::images::Images;
use super::light::{ambient, ball_lamp, light};
use super::literal::{rgb, unit, xyz};
use super::material::{interior, is_on_surface, texture};
use super::pattern::{Coordinates, Pattern};
use super::shape::{corners, shape};
use super::surface::coordinates;
use super::{Lack, PovrayError};
use crate::Pictures;

/// Writes a scene for POV-Ray, with the bounces and the cut-off of these settings. Its images are `pictures`,
/// which must be written beside it.
///
/// # Errors
/// The part of the scene that cannot be written.
pub fn to_povray<'a>(
    scene: &Scene<'a>,
    settings: &Settings,
    pictures: &mut Pictures<'a>,
) -> Result<String, PovrayError> {
    let images = Images::new(pictures);
    let head = format!(
        "#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level {} adc_bailout {} ambient_light \
         rgb {} }}\n",
        u32::from(settings.bounces) + 1,
        settings.cutoff,
        rgb(ambient(scene))
    );
    let mut text = background(&scene.background, &images).map_err(PovrayError::Background)?;
    if !scene.motions.is_empty() {
        return Err(PovrayError::Motions(Lack::Motion));
    }
    text += &camera(&scene.camera).map_err(PovrayError::Camera)?;
    let extent = extent(scene);
    for (index, source) in scene.lights.iter().enumerate() {
        text += &light(scene, source, extent).map_err(|lack| PovrayError::Light { index, lack })?;
    }
    for (index, material) in scene.materials.iter().enumerate().filter(|(_, one)| !is_on_surface(one)) {
        let texture = texture(material, &Coordinates::SPACE, &images);
        let texture = texture.map_err(|lack| PovrayError::Material { index, lack })?;
        text += &format!("#declare Material{index} = texture {{{texture}\n}}\n");
    }
    text += &objects(scene, &images)?;
    // Images are declared in front of their uses.
    Ok(head + &images.declarations() + &text)
}

/// The background.
fn background<'a>(background: &Background<'a>, images: &Images<'_, 'a>) -> Result<String, Lack> {
    Ok(match *background {
        Background::Solid(color) => format!("background {{ rgb {} }}\n", rgb(color)),
        Background::Gradient(&Sky { up, zenith, horizon, nadir }) => {
            let Vec3 { x, y, z } = unit(up.to::<f64>());
            // Map heights from -1 to 1 to 1/4 to 3/4, because a pattern wraps around at 1.
            format!(
                "sky_sphere {{ pigment {{ function {{ (x*({x}) + y*({y}) + z*({z}) + 2) / 4 }} color_map {{ \
                 [0.25 rgb {}] [0.5 rgb {}] [0.75 rgb {}] }} }} }}\n",
                rgb(nadir),
                rgb(horizon),
                rgb(zenith)
            )
        }
        Background::Image(panorama) => {
            let color = |color| Ok(format!("rgb {}", rgb(color)));
            let pigment = Pattern::panorama(panorama, images)?.pigment(&color)?;
            format!("sky_sphere {{ pigment {{ {pigment} }} }}\n")
        }
        _ => return Err(Lack::New),
    })
}

/// The camera, by the vectors of the picture plane at distance 1.
fn camera(camera: &Camera) -> Result<String, Lack> {
    let forward = unit((camera.target - camera.eye).to::<f64>());
    let right = unit(forward.cross(camera.up.to::<f64>()));
    let height = 2.0 * (f64::from(camera.vertical_fov) / 2.0).tan();
    let eye = camera.eye.to::<f64>();
    let blur = match camera.lens {
        None => String::new(),
        Some(Lens { blades: 1.., .. }) => return Err(Lack::Blades),
        Some(Lens { radius, focus, .. }) => format!(
            " aperture {} focal_point {} blur_samples {BLUR_SAMPLES} confidence 0.99 variance 0",
            f64::from(radius) * APERTURE,
            xyz(eye + forward * f64::from(focus))
        ),
    };
    Ok(format!(
        "camera {{ perspective location {} direction {} right {}*image_width/image_height up {}{blur} }}\n",
        xyz(eye),
        xyz(forward),
        xyz(right * height),
        xyz(right.cross(forward) * height)
    ))
}

/// POV-Ray's `aperture` for a lens of radius 1: with this number, pictures are most alike.
const APERTURE: f64 = 4.0;
/// The samples of each pixel that POV-Ray takes for a lens.
const BLUR_SAMPLES: u32 = 400;

/// The largest coordinate in the scene, at least 1.
fn extent(scene: &Scene<'_>) -> f64 {
    let shapes = scene.objects.iter().flat_map(|object| places(&object.shape));
    shapes.chain([scene.camera.eye]).map(|point| f64::from(point.magnitude())).fold(1.0, f64::max)
}

/// Points whose coordinates show how far a shape extends.
fn places(shape: &Shape<'_>) -> Vec<Vec3> {
    match *shape {
        Shape::Sphere(sphere) => vec![sphere.center, Vec3::new(sphere.radius, 0.0, 0.0)],
        Shape::Plane(plane) => vec![plane.point],
        Shape::Disc(disc) => vec![disc.center, Vec3::new(disc.radius, 0.0, 0.0)],
        Shape::Rectangle(rectangle) => corners(&rectangle).to_vec(),
        Shape::Triangle(triangle) => triangle.vertices.to_vec(),
        Shape::Polygon(polygon) => polygon.vertices.to_vec(),
        Shape::Cylinder(Cylinder { base, top, radius, .. }) => vec![base, top, Vec3::new(radius, 0.0, 0.0)],
        Shape::Cone(Cone { base, base_radius, top, top_radius, .. }) => {
            vec![base, top, Vec3::new(base_radius, top_radius, 0.0)]
        }
        Shape::Ellipsoid(shape) => shape.axes.iter().map(|axis| shape.center + *axis).collect(),
        Shape::Quadric(shape) => vec![shape.center + shape.min, shape.center + shape.max],
        Shape::Torus(torus) => vec![torus.center, Vec3::new(torus.major_radius, torus.minor_radius, 0.0)],
        Shape::Cuboid(cuboid) => {
            let [a, b, c] = cuboid.axes;
            vec![cuboid.center + a + b + c, cuboid.center - a - b - c]
        }
        // The corners of the polyhedron may be nearer or farther away than these points.
        Shape::ConvexPolyhedron(polyhedron) => polyhedron.planes.iter().map(|plane| plane.point).collect(),
        Shape::Mesh(mesh) => mesh.vertices.to_vec(),
        Shape::Csg(csg) => {
            let solids = csg.steps.iter().filter_map(|step| match step {
                CsgStep::Solid(solid) => Some(places(&Shape::from(*solid))),
                _ => None,
            });
            solids.flatten().collect()
        }
        Shape::Metaballs(metaballs) => metaballs.blobs.iter().map(|blob| blob.center).collect(),
        Shape::Instances(instances) => {
            let model = places(&Shape::from(*instances.model));
            let reach = model.iter().map(|place| place.length()).fold(0.0, f32::max) * instances.size;
            let aside = Vec3::new(reach, reach, reach);
            instances.poses.iter().flat_map(|pose| [pose.origin - aside, pose.origin + aside]).collect()
        }
    }
}

/// Whether a mesh has colors at its vertices.
fn has_vertex_colors(shape: &Shape<'_>) -> bool {
    match shape {
        Shape::Mesh(mesh) => mesh.colors.is_some(),
        Shape::Instances(instances) => {
            matches!(instances.model, Model::Mesh(mesh) if mesh.colors.is_some())
        }
        _ => false,
    }
}

/// All objects with their materials. The transparent faces of one material are written as one object.
fn objects<'a>(scene: &Scene<'a>, images: &Images<'_, 'a>) -> Result<String, PovrayError> {
    let mut text = String::new();
    let mut faces = vec![String::new(); scene.materials.len()];
    for (index, object) in scene.objects.iter().enumerate() {
        let number = usize::from(object.material.0);
        let (Some(material), Some(faces)) = (scene.materials.get(number), faces.get_mut(number)) else {
            return Err(PovrayError::UnknownMaterial(index));
        };
        let (kind, geometry) = shape(&object.shape).ok_or(PovrayError::NotOneSolid(index))?;
        if has_vertex_colors(&object.shape) {
            return Err(PovrayError::Material { index: number, lack: Lack::VertexColors });
        }
        let own = if is_on_surface(material) {
            let texture = texture(material, &coordinates(&object.shape), images);
            let texture = texture.map_err(|lack| PovrayError::Material { index: number, lack })?;
            Some(format!("texture {{{texture} }}"))
        } else {
            None
        };
        if material.transmittance > 0.0 && is_face(&object.shape) {
            let own = own.map(|texture| format!("{texture} ")).unwrap_or_default();
            *faces += &format!("  {kind} {{ {geometry} {own}}}\n");
        } else {
            let texture = own.unwrap_or_else(|| format!("texture {{ Material{number} }}"));
            let interior = interior(material, absolute_ior(scene, object));
            text += &match lamp(scene, index, material) {
                Some((ball, emission)) => {
                    let look = format!("sphere {{ 0, {} {texture}{interior} }}", ball.radius);
                    ball_lamp(&ball, emission, &look)
                }
                None => format!("{kind} {{ {geometry} {texture}{interior} }}\n"),
            };
        }
    }
    for (number, (faces, material)) in faces.iter().zip(scene.materials).enumerate() {
        if !faces.is_empty() {
            let interior = interior(material, f64::from(material.ior));
            let texture = if is_on_surface(material) {
                String::new()
            } else {
                format!("texture {{ Material{number} }}")
            };
            text += &format!("union {{\n{faces}  {texture}{interior}\n}}\n");
        }
    }
    Ok(text)
}

/// The ball and its emission, if a light of the scene is this object.
fn lamp(scene: &Scene<'_>, index: usize, material: &Material<'_>) -> Option<(Sphere, LinearRgb)> {
    let is_it = |light: &Light| matches!(light, Light::Object(object) if usize::from(object.0) == index);
    match scene.objects.get(index)?.shape {
        Shape::Sphere(ball) if scene.lights.iter().any(is_it) => Some((ball, material.optics?.emission)),
        _ => None,
    }
}

/// Whether the shape is flat and bounded, so that several of them can enclose a space.
fn is_face(shape: &Shape<'_>) -> bool {
    matches!(shape, Shape::Disc(_) | Shape::Rectangle(_) | Shape::Triangle(_) | Shape::Polygon(_))
}

/// The absolute index of refraction of an object. For a sphere whose material does not state the medium
/// outside, it is the product of its index with that of the smallest transparent sphere around it.
fn absolute_ior(scene: &Scene<'_>, object: &Object<Shape<'_>>) -> f64 {
    let Some(own) = scene.material_of(object) else { return 1.0 };
    let ior = f64::from(own.ior);
    let is_stated = own.optics.is_some_and(|optics| optics.outside.ior != 1.0);
    let (false, Shape::Sphere(inner)) = (is_stated, object.shape) else { return ior };
    let encloses = |outer: &Sphere| (outer.center - inner.center).length() + inner.radius < outer.radius;
    let around = scene.objects.iter().filter_map(|object| match object.shape {
        Shape::Sphere(outer) if encloses(&outer) => Some((outer.radius, object)),
        _ => None,
    });
    let transparent =
        around.filter(|(_, object)| scene.material_of(object).is_some_and(|m| m.transmittance > 0.0));
    let next = transparent.min_by(|(a, _), (b, _)| a.total_cmp(b));
    // Each sphere is larger than the one before, so the recursion ends.
    ior * next.map_or(1.0, |(_, outer)| absolute_ior(scene, outer))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use rayline::shape::{Csg, Polygon, Solid, Torus, Triangle};
    use rayline::{Light, LinearRgb, Material, Texture};

    const GLASS: Material = Material {
        transmittance: 0.75,
        diffuse: 0.125,
        reflectance: 0.25,
        ior: 1.5,
        ..Material::matte(LinearRgb::WHITE)
    };
    const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);

    fn scene<'a>(
        objects: &'a [Object<Shape<'a>>],
        materials: &'a [Material<'a>],
        lights: &'a [Light],
    ) -> Scene<'a> {
        let camera = Camera {
            eye: Vec3::new(0.0, 0.0, 5.0),
            target: Vec3::ZERO,
            up: Vec3::new(0.0, 2.0, 1.0),
            vertical_fov: core::f32::consts::FRAC_PI_2,
            lens: None,
        };
        Scene {
            camera,
            background: Background::Solid(LinearRgb::new(0.1, 0.2, 0.3)),
            objects,
            materials,
            lights,
            motions: &[],
        }
    }

    fn written(scene: &Scene<'_>, settings: &Settings) -> Result<String, PovrayError> {
        to_povray(scene, settings, &mut Pictures::beside(Path::new("no folder/scene.pov")))
    }

    #[test]
    fn a_small_scene_in_full() {
        let corners = [Vec3::ZERO, Vec3::new(1.0, 0.0, 0.0), UP];
        let objects = [
            Object::new(Shape::Sphere(Sphere::new(Vec3::new(0.0, 0.5, -1.0), 0.1)), 0),
            Object::new(Shape::Polygon(Polygon::new(&corners)), 1),
            Object::new(Shape::Triangle(Triangle { vertices: corners, normals: Some([UP; 3]) }), 0),
            Object::new(
                Shape::Cylinder(Cylinder { base: Vec3::ZERO, top: UP, radius: 0.5, capped: false }),
                0,
            ),
        ];
        let checkered = Material {
            color: Texture::checker_xz(LinearRgb::WHITE, LinearRgb::gray(0.5), 2.0),
            specular: 0.5,
            shininess: 20.0,
            ..Material::matte(LinearRgb::WHITE)
        };
        let lights = [Light::Directional { direction: Vec3::new(0.0, -2.0, 0.0), color: LinearRgb::WHITE }];
        let materials = [checkered, GLASS];
        let settings = Settings { bounces: 3, cutoff: 0.25, ..Settings::new(200, 100) };
        let text = written(&scene(&objects, &materials, &lights), &settings).unwrap();
        assert_eq!(
            text,
            "\
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 4 adc_bailout 0.25 ambient_light rgb <1, 1, 1> }
background { rgb <0.1, 0.2, 0.3> }
camera { perspective location <0, 0, 5> direction <0, 0, -1> right <2.000000087422782, 0, 0>*image_width/image_height up <0, 2.000000087422782, 0> }
light_source { <0, 500, 0> rgb <1, 1, 1> parallel point_at 0 }
#declare Material0 = texture {
  pigment { function { mod(abs(floor(x*0.5 + 1e-6) + floor(z*0.5 + 1e-6)), 2) } pigment_map { [0 rgbt <1, 1, 1, 0>] [1 rgbt <0.5, 0.5, 0.5, 0>] } }
  finish { ambient 0 diffuse 1 phong 0.5 phong_size 20 reflection rgb <0, 0, 0> emission rgb <0, 0, 0> }
}
#declare Material1 = texture {
  pigment { rgbt <1, 1, 1, 0.75> }
  finish { ambient 0 diffuse 0.5 phong 0 phong_size 0 reflection rgb <0.25, 0.25, 0.25> emission rgb <0, 0, 0> }
}
sphere { <0, 0.5, -1>, 0.1 texture { Material0 } }
smooth_triangle { <0, 0, 0>, <0, 1, 0>, <1, 0, 0>, <0, 1, 0>, <0, 1, 0>, <0, 1, 0> texture { Material0 } }
cylinder { <0, 0, 0>, <0, 1, 0>, 0.5 open texture { Material0 } }
union {
  polygon { 4, <0, 0, 0>, <1, 0, 0>, <0, 1, 0>, <0, 0, 0> }
  texture { Material1 } interior { ior 1.5 }
}
"
        );
    }

    #[test]
    fn the_sun_stands_outside_of_wide_shapes() {
        let shapes = [
            Shape::Cylinder(Cylinder { base: Vec3::ZERO, top: UP, radius: 900.0, capped: true }),
            Shape::Cone(Cone {
                base: Vec3::ZERO,
                base_radius: 1.0,
                top: UP,
                top_radius: 900.0,
                capped: true,
            }),
            Shape::Torus(Torus { center: Vec3::ZERO, axis: UP, major_radius: 900.0, minor_radius: 1.0 }),
        ];
        let sun = Light::Directional { direction: -UP, color: LinearRgb::WHITE };
        for shape in shapes {
            let text = written(&scene(&[Object::new(shape, 0)], &[GLASS], &[sun]), &Settings::new(8, 8));
            assert!(text.unwrap().contains("light_source { <0, 90000, 0>"), "{shape:?}");
        }
    }

    #[test]
    fn steps_must_combine_into_one_solid() {
        let ball = CsgStep::Solid(Solid::Sphere(Sphere::new(Vec3::ZERO, 1.0)));
        let steps = [ball, ball];
        let objects = [Object::new(Shape::Csg(Csg::new(&steps)), 0)];
        let error = written(&scene(&objects, &[GLASS], &[]), &Settings::new(8, 8)).unwrap_err();
        assert_eq!(error, PovrayError::NotOneSolid(0));
    }

    #[test]
    fn indices_of_nested_spheres_are_absolute() {
        let objects = [0.5, 1.0].map(|radius| Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, radius)), 0));
        let text = written(&scene(&objects, &[GLASS], &[]), &Settings::new(8, 8)).unwrap();
        assert!(text.contains("0.5 texture { Material0 } interior { ior 2.25 }"), "{text}");
        assert!(text.contains("1 texture { Material0 } interior { ior 1.5 }"), "{text}");
    }

    #[test]
    fn unknown_materials_are_refused() {
        let objects = [Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0)), 1)];
        let error = written(&scene(&objects, &[GLASS], &[]), &Settings::new(8, 8)).unwrap_err();
        assert_eq!(error, PovrayError::UnknownMaterial(0));
    }
}
