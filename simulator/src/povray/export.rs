//! Scenes in the language of POV-Ray.
//!
//! POV-Ray computes what the core computes, where it is told so:
//!
//! - Coordinates are taken as they are. POV-Ray's are left-handed only where it derives one direction of the camera
//!   from the others, so all three are written out; their lengths give the field of view.
//! - The share of light that a pigment does not transmit is POV-Ray's factor of ambient and diffuse light, so both
//!   are divided by it.
//! - POV-Ray tells inside from outside by a list of the interiors that a ray is in. The faces of one material
//!   therefore share one interior, which makes a closed solid of them. In a list, indices are absolute: so are those
//!   of materials that say what is outside of them; another sphere within a transparent one gets the product of both. Where bodies are put
//!   together from open surfaces with one medium on each side, POV-Ray's list does not know what the core knows.
//! - A transmitted ray does not count as a bounce where the index is exactly 1, so that is written a little larger.
//! - Under total internal reflection POV-Ray mirrors all light, the core reflectance plus transmittance. The two
//!   agree where these add up to 1, and where it never happens: in a glass ball that is seen from outside.
//! - Where a smooth triangle's normal would mirror a ray into the surface, POV-Ray turns the ray out of it again; the
//!   core follows it.
//!
//! Render with `File_Gamma=1` and without anti-aliasing to get the bytes that
//! [`Transfer::Linear`](rayline::Transfer::Linear) gives, but for rounding.

use core::fmt;

use rayline::shape::{
    Blob, Cone, Csg, CsgStep, Cylinder, Instances, Mesh, Metaballs, Plane, Quadric, Rectangle, Shape, Sphere,
};
use rayline::{
    Background, Camera, Ends, Falloff, Figure, Fresnel, Gradient, Lamp, Light, LinearRgb, Material, Object,
    Optics, Placed, Placement, Scene, Settings, Sky, Space, Squares, Stripes, Texture, Vec3,
};

/// A part of a scene that POV-Ray cannot be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PovrayError {
    /// The background is a picture, which is in no file that POV-Ray could read. Replace it.
    Background,
    /// The light at this position falls off in a way that POV-Ray does not know: it needs a constant of 1 or more, and no linear
    /// term. Or it is of a kind that was added to the core since. Replace it.
    Light(usize),
    /// The material at this position has a texture that POV-Ray has not, or has in other forms: noise, marble, wood, bricks,
    /// images, what lies on surfaces, gradients that end, and maps. Replace it.
    Texture(usize),
    /// The material at this position has optics that POV-Ray has not, or others than these: Schlick's shares, colored surfaces of glass, Blinn's
    /// highlight, fading reflections. Leave them out.
    Optics(usize),
    /// The object at this position names a material that the scene does not have.
    UnknownMaterial(usize),
    /// The object at this position has steps that do not leave one solid.
    NotOneSolid(usize),
}

impl fmt::Display for PovrayError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Background => {
                write!(f, "a picture as a background cannot be written for POV-Ray; replace it")
            }
            Self::Light(index) => write!(f, "light {index} cannot be written for POV-Ray; replace it"),
            Self::Texture(index) => {
                write!(f, "the texture of material {index} cannot be written for POV-Ray; replace it")
            }
            Self::Optics(index) => {
                write!(f, "the optics of material {index} cannot be written for POV-Ray; leave them out")
            }
            Self::UnknownMaterial(index) => {
                write!(f, "object {index} names a material that the scene does not have")
            }
            Self::NotOneSolid(index) => {
                write!(f, "object {index} has steps that do not leave one solid; give each pair an operator")
            }
        }
    }
}

impl core::error::Error for PovrayError {}

/// Writes a scene for POV-Ray, with the bounces, the cutoff and the shape of the picture of these settings. Give
/// POV-Ray the same width and height.
///
/// # Errors
/// The part of the scene that cannot be written.
pub fn to_povray(scene: &Scene<'_>, settings: &Settings) -> Result<String, PovrayError> {
    let mut text = format!(
        "#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level {} adc_bailout {} ambient_light rgb {} }}\n",
        u32::from(settings.bounces) + 1,
        settings.cutoff,
        rgb(ambient(scene))
    );
    text += &background(&scene.background).ok_or(PovrayError::Background)?;
    text += &camera(&scene.camera, settings);
    let extent = extent(scene);
    for (index, source) in scene.lights.iter().enumerate() {
        text += &light(source, extent).ok_or(PovrayError::Light(index))?;
    }
    for (index, material) in scene.materials.iter().enumerate() {
        if !material.optics.is_none_or(is_known) {
            return Err(PovrayError::Optics(index));
        }
        text += &texture(index, material).ok_or(PovrayError::Texture(index))?;
    }
    text += &objects(scene)?;
    Ok(text)
}

/// What rays see that meet nothing.
fn background(background: &Background<'_>) -> Option<String> {
    Some(match *background {
        Background::Solid(color) => format!("background {{ rgb {} }}\n", rgb(color)),
        Background::Gradient(&Sky { up, zenith, horizon, nadir }) => {
            let up = up.to::<f64>();
            let Vec3 { x, y, z } = up * up.length().recip();
            // Heights from -1 to 1 come to lie from 1/4 to 3/4: a pattern begins anew at 1.
            format!(
                "sky_sphere {{ pigment {{ function {{ (x*({x}) + y*({y}) + z*({z}) + 2) / 4 }} color_map {{ [0.25 rgb {}] \
                 [0.5 rgb {}] [0.75 rgb {}] }} }} }}\n",
                rgb(nadir),
                rgb(horizon),
                rgb(zenith)
            )
        }
        _ => return None,
    })
}

/// The directions of the picture plane at distance 1, in full.
fn camera(camera: &Camera, settings: &Settings) -> String {
    let unit = |vector: Vec3<f64>| vector * vector.length().recip();
    let forward = unit((camera.target - camera.eye).to::<f64>());
    let right = unit(forward.cross(camera.up.to::<f64>()));
    let height = 2.0 * (f64::from(camera.vertical_fov) / 2.0).tan();
    let width = height * f64::from(settings.width) / f64::from(settings.height);
    format!(
        "camera {{ perspective location {} direction {} right {} up {} }}\n",
        xyz(camera.eye.to::<f64>()),
        xyz(forward),
        xyz(right * width),
        xyz(right.cross(forward) * height)
    )
}

/// The largest coordinate that the scene's parts name: how far away from the origin anything lies.
fn extent(scene: &Scene<'_>) -> f64 {
    let shapes = scene.objects.iter().flat_map(|object| places(&object.shape));
    shapes.chain([scene.camera.eye]).map(|point| f64::from(point.magnitude())).fold(1.0, f64::max)
}

/// Places that a shape names.
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
        // What its planes enclose may be farther away than these points, or nearer.
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

/// A light; a directional one stands far outside of the scene.
fn light(light: &Light, extent: f64) -> Option<String> {
    Some(match *light {
        Light::Point { position, color } => {
            format!("light_source {{ {} rgb {} }}\n", xyz(position.to::<f64>()), rgb(color))
        }
        Light::Directional { direction, color } => {
            let direction = direction.to::<f64>();
            let away = direction * (-100.0 * extent * direction.length().recip());
            format!("light_source {{ {} rgb {} parallel point_at 0 }}\n", xyz(away), rgb(color))
        }
        // It is a setting.
        Light::Ambient { .. } => String::new(),
        Light::Lamp(lamp) => lamp_source(&lamp)?,
        _ => return None,
    })
}

/// The sum of the ambient lights; white where there are none.
fn ambient(scene: &Scene<'_>) -> LinearRgb {
    let colors = scene.lights.iter().filter_map(|light| match light {
        Light::Ambient { color } => Some(*color),
        _ => None,
    });
    colors.reduce(|a, b| a + b).unwrap_or(LinearRgb::WHITE)
}

/// A lamp. POV-Ray's falls off as 2 / (1 + (d / distance)²), and between two angles like ours.
fn lamp_source(lamp: &Lamp) -> Option<String> {
    let Falloff { constant, linear, quadratic } = lamp.falloff;
    if linear != 0.0 || constant < 1.0 {
        return None;
    }
    let (mut brightness, mut fade) = (1.0 / f64::from(constant), String::new());
    if quadratic > 0.0 {
        brightness /= 2.0;
        let distance = (f64::from(constant) / f64::from(quadratic)).sqrt();
        fade = format!(" fade_distance {distance} fade_power 2");
    }
    let color = [lamp.color.r, lamp.color.g, lamp.color.b].map(|channel| f64::from(channel) * brightness);
    let cone = lamp.cone.map_or(String::new(), |cone| {
        let target = lamp.position.to::<f64>() + cone.direction.to::<f64>();
        // Where the bright part has no size, POV-Ray takes the edge for a sharp one.
        let (bright, dark) =
            (f64::from(cone.bright).to_degrees().max(1e-3), f64::from(cone.dark).to_degrees());
        format!(" spotlight radius {bright} falloff {dark} tightness 0 point_at {}", xyz(target))
    });
    Some(format!("light_source {{ {} rgb {}{cone}{fade} }}\n", xyz(lamp.position.to::<f64>()), list(&color)))
}

/// Whether POV-Ray has these optics.
fn is_known(optics: &Optics) -> bool {
    let Optics { fresnel, emission, reflection_color, absorption, outside, .. } = *optics;
    let known = Optics { fresnel, emission, reflection_color, absorption, outside, ..Optics::PLAIN };
    *optics == known && fresnel != Fresnel::Schlick
}

/// A material's colors and finish, under a name that objects refer to.
fn texture(index: usize, material: &Material) -> Option<String> {
    if !material.maps.is_empty() {
        return None;
    }
    // A surface that lets everything through has no color of its own in POV-Ray, but may have one here.
    let transmit = f64::from(material.transmittance).min(0.999_999);
    let opacity = 1.0 - transmit;
    let pigment = match material.color {
        Texture::Solid(color) => rgbt(color, transmit),
        Texture::Checker(checker) => {
            let cells = checker.cells_per_unit.to::<f64>();
            let axes = [cells.x, cells.y, cells.z];
            // An axis that does not count lies in the middle of one huge cell.
            let offset = axes.map(|cells| if cells == 0.0 { -0.5 } else { 0.0 });
            let size = axes.map(|cells| if cells == 0.0 { 1e12 } else { cells.recip() });
            format!(
                "checker {}, {} translate {} scale {}",
                rgbt(checker.even, transmit),
                rgbt(checker.odd, transmit),
                list(&offset),
                list(&size)
            )
        }
        Texture::Placed(placed) => self::placed(placed, transmit)?,
        _ => return None,
    };
    let optics = material.optics.unwrap_or(&Optics::PLAIN);
    let LinearRgb { r, g, b } = optics.reflection_color;
    let is_exact = optics.fresnel == Fresnel::Exact;
    let share = material.reflectance + if is_exact { material.transmittance } else { 0.0 };
    let mirrored = list(&[r, g, b].map(|channel| f64::from(channel * share)));
    let reflection = if is_exact {
        format!("reflection {{ rgb 0 rgb {mirrored} fresnel on }} conserve_energy")
    } else {
        format!("reflection rgb {mirrored}")
    };
    Some(format!(
        "#declare Material{index} = texture {{\n  pigment {{ {pigment} }}\n  finish {{ ambient {} diffuse {} phong {} \
         phong_size {} {reflection} emission rgb {} }}\n}}\n",
        f64::from(material.ambient) / opacity,
        f64::from(material.diffuse) / opacity,
        material.specular,
        material.shininess,
        rgb(optics.emission),
    ))
}

/// A figure in space that POV-Ray has as well.
fn placed(placed: &Placed<'_>, transmit: f64) -> Option<String> {
    let Placement { space, size, rotation, origin } = placed.placement;
    if space != Space::Scene {
        return None;
    }
    let map = |stops: &[(f64, LinearRgb)]| {
        let stops: String =
            stops.iter().map(|(at, color)| format!(" [{at} {}]", rgbt(*color, transmit))).collect();
        format!("color_map {{{stops} }}")
    };
    let figure = match placed.figure {
        Figure::Squares(Squares { even, odd }) => {
            format!("checker {}, {}", rgbt(even, transmit), rgbt(odd, transmit))
        }
        Figure::Stripes(Stripes { first, second, width }) => {
            let width = f64::from(width);
            format!("gradient x {}", map(&[(0.0, first), (width, first), (width, second), (1.0, second)]))
        }
        Figure::Gradient(Gradient { from, to, ends: Ends::Repeat }) => {
            format!("gradient x {}", map(&[(0.0, from), (1.0, to)]))
        }
        // There and back takes two units.
        Figure::Gradient(Gradient { from, to, ends: Ends::Mirror }) => {
            format!("gradient x {} scale <2, 1, 1>", map(&[(0.0, from), (0.5, to), (1.0, from)]))
        }
        _ => return None,
    };
    let degrees = rotation.to::<f64>() * (180.0 / core::f64::consts::PI);
    Some(format!("{figure} scale {} rotate {} translate {}", point(size), xyz(degrees), point(origin)))
}

/// All objects with their materials; transparent faces of one material are one object.
fn objects(scene: &Scene<'_>) -> Result<String, PovrayError> {
    let mut text = String::new();
    let mut faces = vec![String::new(); scene.materials.len()];
    for (index, object) in scene.objects.iter().enumerate() {
        let number = usize::from(object.material.0);
        let (Some(material), Some(faces)) = (scene.materials.get(number), faces.get_mut(number)) else {
            return Err(PovrayError::UnknownMaterial(index));
        };
        let (kind, geometry) = shape(&object.shape).ok_or(PovrayError::NotOneSolid(index))?;
        if material.transmittance > 0.0 && is_face(&object.shape) {
            *faces += &format!("  {kind} {{ {geometry} }}\n");
        } else {
            let interior = interior(material, absolute_ior(scene, object));
            text += &format!("{kind} {{ {geometry} texture {{ Material{number} }}{interior} }}\n");
        }
    }
    for (number, (faces, material)) in faces.iter().zip(scene.materials).enumerate() {
        if !faces.is_empty() {
            let interior = interior(material, f64::from(material.ior));
            text += &format!("union {{\n{faces}  texture {{ Material{number} }}{interior}\n}}\n");
        }
    }
    Ok(text)
}

/// Whether the shape is flat and bounded, so that several can enclose a space.
fn is_face(shape: &Shape<'_>) -> bool {
    matches!(shape, Shape::Disc(_) | Shape::Rectangle(_) | Shape::Triangle(_) | Shape::Polygon(_))
}

/// What lies behind a surface that lets light through, or that mirrors by its index, where that is `ior`.
fn interior(material: &Material, ior: f64) -> String {
    let optics = material.optics.unwrap_or(&Optics::PLAIN);
    if material.transmittance == 0.0 && optics.fresnel != Fresnel::Exact {
        return String::new();
    }
    let ior = if ior == 1.0 { 1.000_001 } else { ior };
    let LinearRgb { r, g, b } = optics.absorption;
    let most = f64::from(r.max(g).max(b));
    // With a power of 1000 or more, exp(-(1 - color) d / distance) is left.
    let fade = if most > 0.0 {
        let color = [r, g, b].map(|coefficient| 1.0 - f64::from(coefficient) / most);
        format!(" fade_power 1001 fade_distance {} fade_color rgb {}", most.recip(), list(&color))
    } else {
        String::new()
    };
    format!(" interior {{ ior {ior}{fade} }}")
}

/// The index of what an object is made of. Where its material does not say what is outside, its index is that over the index of
/// the smallest transparent sphere around it.
fn absolute_ior(scene: &Scene<'_>, object: &Object<Shape<'_>>) -> f64 {
    let material = |object: &Object<Shape<'_>>| scene.materials.get(usize::from(object.material.0));
    let Some(own) = material(object) else { return 1.0 };
    let ior = f64::from(own.ior);
    let is_stated = own.optics.is_some_and(|optics| optics.outside.ior != 1.0);
    let (false, Shape::Sphere(inner)) = (is_stated, object.shape) else { return ior };
    let encloses = |outer: &Sphere| (outer.center - inner.center).length() + inner.radius < outer.radius;
    let around = scene.objects.iter().filter_map(|object| match object.shape {
        Shape::Sphere(outer) if encloses(&outer) => Some((outer.radius, object)),
        _ => None,
    });
    let transparent = around.filter(|(_, object)| material(object).is_some_and(|m| m.transmittance > 0.0));
    let next = transparent.min_by(|(a, _), (b, _)| a.total_cmp(b));
    // Larger each time: it ends.
    ior * next.map_or(1.0, |(_, outer)| absolute_ior(scene, outer))
}

/// A shape's keyword and numbers.
fn shape(shape: &Shape<'_>) -> Option<(&'static str, String)> {
    let open = |capped: bool| if capped { "" } else { " open" };
    Some(match shape {
        Shape::Sphere(sphere) => ("sphere", format!("{}, {}", point(sphere.center), sphere.radius)),
        Shape::Plane(plane) => ("plane", self::plane(plane)),
        Shape::Disc(disc) => (
            "disc",
            format!("{}, {}, {}, {}", point(disc.center), point(disc.normal), disc.radius, disc.hole),
        ),
        Shape::Rectangle(rectangle) => polygon(&corners(rectangle)),
        Shape::Triangle(triangle) => match triangle.normals {
            None => ("triangle", points(&triangle.vertices)),
            Some(normals) => {
                let corners =
                    triangle.vertices.iter().zip(&normals).flat_map(|(vertex, normal)| [*vertex, *normal]);
                ("smooth_triangle", points(&corners.collect::<Vec<_>>()))
            }
        },
        Shape::Polygon(polygon) => self::polygon(polygon.vertices),
        Shape::Cylinder(shape) => (
            "cylinder",
            format!("{}, {}{}", points(&[shape.base, shape.top]), shape.radius, open(shape.capped)),
        ),
        Shape::Cone(shape) => (
            "cone",
            format!(
                "{}, {}, {}, {}{}",
                point(shape.base),
                shape.base_radius,
                point(shape.top),
                shape.top_radius,
                open(shape.capped)
            ),
        ),
        Shape::Mesh(mesh) => ("mesh2", self::mesh(mesh)),
        Shape::Ellipsoid(shape) => {
            // The images of the axes, and of the origin.
            let [a, b, c] = shape.axes;
            ("sphere", format!("0, 1 {}", matrix([a, b, c, shape.center].map(Vec3::to))))
        }
        Shape::Quadric(shape) => quadric(shape),
        Shape::Cuboid(cuboid) => {
            let [a, b, c] = cuboid.axes;
            ("box", format!("-1, 1 {}", matrix([a, b, c, cuboid.center].map(Vec3::to))))
        }
        Shape::ConvexPolyhedron(polyhedron) => {
            let planes = polyhedron.planes.iter().map(|plane| format!("plane {{ {} }}", self::plane(plane)));
            ("intersection", planes.collect::<Vec<_>>().join(" "))
        }
        Shape::Torus(torus) => {
            // POV-Ray's lies across the y axis.
            let axis = torus.axis.to::<f64>();
            let up = axis * axis.length().recip();
            let aside = if up.x.abs() < 0.5 { Vec3::new(1.0, 0.0, 0.0) } else { Vec3::new(0.0, 1.0, 0.0) };
            let right = up.cross(aside);
            let right = right * right.length().recip();
            let turned = matrix([right, up, right.cross(up), torus.center.to()]);
            ("torus", format!("{}, {} {turned}", torus.major_radius, torus.minor_radius))
        }
        Shape::Csg(csg) => return self::csg(csg),
        Shape::Metaballs(metaballs) => ("isosurface", self::metaballs(metaballs)),
        Shape::Instances(instances) => return self::instances(instances),
    })
}

/// What turns the axes, and then the origin, into these.
fn matrix(images: [Vec3<f64>; 4]) -> String {
    let rows =
        images.map(|image| [image.x, image.y, image.z].map(|number| (number + 0.0).to_string()).join(", "));
    format!("matrix <{}>", rows.join(", "))
}

/// The model, over and over again.
fn instances(instances: &Instances<'_>) -> Option<(&'static str, String)> {
    let (kind, model) = shape(&Shape::from(*instances.model))?;
    let mut all = instances.poses.iter().map(|pose| {
        let degrees = pose.rotation.to::<f64>() * (180.0 / core::f64::consts::PI);
        format!("{model} scale {} rotate {} translate {}", instances.size, xyz(degrees), point(pose.origin))
    });
    if instances.poses.len() == 1 {
        return all.next().map(|only| (kind, only));
    }
    Some(("union", all.map(|one| format!("{kind} {{ {one} }}")).collect::<Vec<_>>().join("\n  ")))
}

/// The steps carried out on pieces of text.
fn csg(csg: &Csg<'_>) -> Option<(&'static str, String)> {
    let mut stack: Vec<(&'static str, String)> = vec![];
    for step in csg.steps {
        let piece = match step {
            CsgStep::Solid(solid) => shape(&Shape::from(*solid))?,
            operator => {
                let ((right, right_text), (left, left_text)) = (stack.pop()?, stack.pop()?);
                // A merge is a union that has no walls inside.
                let kind = match operator {
                    CsgStep::Intersection => "intersection",
                    CsgStep::Difference => "difference",
                    _ => "merge",
                };
                (kind, format!("{left} {{ {left_text} }} {right} {{ {right_text} }}"))
            }
        };
        stack.push(piece);
    }
    let whole = stack.pop()?;
    stack.is_empty().then_some(whole)
}

/// Cut out of a box by it, or clipped by it.
fn quadric(shape: &Quadric) -> (&'static str, String) {
    let [squares @ .., constant] = &shape.coefficients;
    let equation = squares.chunks(3).map(list).collect::<Vec<_>>().join(", ");
    let equation = format!("{equation}, {constant} translate {}", point(shape.center));
    let corners = format!("box {{ {} }}", points(&[shape.center + shape.min, shape.center + shape.max]));
    if shape.capped {
        ("intersection", format!("quadric {{ {equation} }} {corners}"))
    } else {
        ("quadric", format!("{equation} clipped_by {{ {corners} }}"))
    }
}

/// The sum as a function, in the box around all that the blobs reach. POV-Ray's own blobs have another kernel.
fn metaballs(metaballs: &Metaballs<'_>) -> String {
    let term = |blob: &Blob| {
        let Vec3 { x, y, z } = blob.center;
        let squared = format!("(pow(x - ({x}), 2) + pow(y - ({y}), 2) + pow(z - ({z}), 2))");
        let share = format!("min(1, {squared} / {})", f64::from(blob.radius).powi(2));
        format!(" - ({}) * pow(1 - {share}, 2) * (1 - {share} * 4 / 9)", blob.strength)
    };
    let terms: String = metaballs.blobs.iter().map(term).collect();
    let corner = |side: f32| {
        let reach = |blob: &Blob| blob.center + Vec3::new(1.0, 1.0, 1.0) * (blob.radius * side);
        let farther = |a: f32, b: f32| if (b - a) * side > 0.0 { b } else { a };
        let farthest = metaballs
            .blobs
            .iter()
            .map(reach)
            .reduce(|a, b| Vec3::new(farther(a.x, b.x), farther(a.y, b.y), farther(a.z, b.z)));
        point(farthest.unwrap_or(Vec3::ZERO))
    };
    // The kernel's steepest slope, of all that can be around one point: these overlap with each of them.
    let steepest = |at: &Blob| -> f32 {
        let overlaps = |blob: &&Blob| (blob.center - at.center).length() < blob.radius + at.radius;
        metaballs.blobs.iter().filter(overlaps).map(|blob| 1.6 * blob.strength.abs() / blob.radius).sum()
    };
    let gradient = metaballs.blobs.iter().map(steepest).fold(0.0, f32::max);
    // POV-Ray's own accuracy, a thousandth of a unit, turns normals by several levels of a display.
    let accuracy = metaballs.blobs.iter().map(|blob| blob.radius).fold(1.0, f32::min) * 1e-4;
    format!(
        "function {{ 0.5{terms} }} contained_by {{ box {{ {}, {} }} }} accuracy {accuracy} max_gradient {gradient}",
        corner(-1.0),
        corner(1.0)
    )
}

fn plane(plane: &Plane) -> String {
    let normal = plane.normal.to::<f64>();
    let normal = normal * normal.length().recip();
    format!("{}, {}", xyz(normal), normal.dot(plane.point.to()))
}

fn polygon(vertices: &[Vec3]) -> (&'static str, String) {
    // POV-Ray wants the first point again at the end.
    let closed: Vec<_> = vertices.iter().chain(vertices.first()).copied().collect();
    ("polygon", format!("{}, {}", closed.len(), points(&closed)))
}

fn corners(rectangle: &Rectangle) -> [Vec3; 4] {
    let Rectangle { corner, right, up } = *rectangle;
    [corner, corner + right, corner + right + up, corner + up]
}

fn mesh(mesh: &Mesh<'_>) -> String {
    let vectors = |name, vectors: &[Vec3]| format!("{name} {{ {}, {} }}", vectors.len(), points(vectors));
    let faces: Vec<_> = mesh.triangles.iter().map(|triangle| list(triangle)).collect();
    let normals = mesh.normals.map_or(String::new(), |normals| vectors("normal_vectors", normals) + " ");
    format!(
        "{} {normals}face_indices {{ {}, {} }}",
        vectors("vertex_vectors", mesh.vertices),
        faces.len(),
        faces.join(", ")
    )
}

fn points(vertices: &[Vec3]) -> String {
    vertices.iter().copied().map(point).collect::<Vec<_>>().join(", ")
}

fn point(point: Vec3) -> String {
    list(&[point.x, point.y, point.z])
}

fn xyz(vector: Vec3<f64>) -> String {
    // -0 + 0 is 0, which reads better.
    list(&[vector.x, vector.y, vector.z].map(|number| number + 0.0))
}

fn rgb(color: LinearRgb) -> String {
    list(&[color.r, color.g, color.b])
}

fn rgbt(color: LinearRgb, transmit: f64) -> String {
    format!("rgbt <{}, {}, {}, {transmit}>", color.r, color.g, color.b)
}

fn list<T: fmt::Display>(numbers: &[T]) -> String {
    format!("<{}>", numbers.iter().map(T::to_string).collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayline::shape::{Ellipsoid, Model, Polygon, Pose, Solid, Torus, Triangle};
    use rayline::{Map, Onto};

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
        };
        Scene {
            camera,
            background: Background::Solid(LinearRgb::new(0.1, 0.2, 0.3)),
            objects,
            materials,
            lights,
        }
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
        let text = to_povray(&scene(&objects, &materials, &lights), &settings).unwrap();
        assert_eq!(
            text,
            "\
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 4 adc_bailout 0.25 ambient_light rgb <1, 1, 1> }
background { rgb <0.1, 0.2, 0.3> }
camera { perspective location <0, 0, 5> direction <0, 0, -1> right <4.000000174845564, 0, 0> up <0, 2.000000087422782, 0> }
light_source { <0, 500, 0> rgb <1, 1, 1> parallel point_at 0 }
#declare Material0 = texture {
  pigment { checker rgbt <1, 1, 1, 0>, rgbt <0.5, 0.5, 0.5, 0> translate <0, -0.5, 0> scale <2, 1000000000000, 2> }
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
    fn ellipsoids_and_quadrics() {
        let egg = Ellipsoid::new(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.5, 1.0, 2.0));
        let (kind, text) = shape(&Shape::Ellipsoid(egg)).unwrap();
        assert_eq!((kind, text.as_str()), ("sphere", "0, 1 matrix <0.5, 0, 0, 0, 1, 0, 0, 0, 2, 1, 2, 3>"));
        let corner = Vec3::new(1.0, 1.0, 1.0);
        let bowl = Quadric {
            center: UP,
            coefficients: [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, -10.0],
            min: -corner,
            max: corner,
            capped: true,
        };
        let equation = "<1, 2, 3>, <4, 5, 6>, <7, 8, 9>, -10 translate <0, 1, 0>";
        let corners = "box { <-1, 0, -1>, <1, 2, 1> }";
        let (kind, text) = shape(&Shape::Quadric(bowl)).unwrap();
        assert_eq!((kind, text), ("intersection", format!("quadric {{ {equation} }} {corners}")));
        let (kind, text) = shape(&Shape::Quadric(Quadric { capped: false, ..bowl })).unwrap();
        assert_eq!((kind, text), ("quadric", format!("{equation} clipped_by {{ {corners} }}")));
    }

    #[test]
    fn metaballs_are_a_function() {
        let blobs = [Blob::new(UP, 2.0), Blob { strength: -0.5, ..Blob::new(Vec3::ZERO, 1.0) }];
        let (kind, text) = shape(&Shape::Metaballs(Metaballs::new(&blobs))).unwrap();
        let first = "min(1, (pow(x - (0), 2) + pow(y - (1), 2) + pow(z - (0), 2)) / 4)";
        let second = "min(1, (pow(x - (0), 2) + pow(y - (0), 2) + pow(z - (0), 2)) / 1)";
        let first = format!("(1) * pow(1 - {first}, 2) * (1 - {first} * 4 / 9)");
        let second = format!("(-0.5) * pow(1 - {second}, 2) * (1 - {second} * 4 / 9)");
        let within = "contained_by { box { <-2, -1, -2>, <2, 3, 2> } } accuracy 0.0001 max_gradient 1.6";
        assert_eq!((kind, text), ("isosurface", format!("function {{ 0.5 - {first} - {second} }} {within}")));
    }

    #[test]
    fn instances_are_enlarged_turned_and_moved() {
        let blobs = [Blob::new(Vec3::ZERO, 2.0)];
        let model = Model::Metaballs(Metaballs::new(&blobs));
        let (_, ball) = shape(&Shape::from(model)).unwrap();
        let places = [Pose::at(UP).turned(Vec3::new(0.0, core::f32::consts::PI, 0.0)), Pose::at(Vec3::ZERO)];
        let pair = Instances::new(&model, &places).sized(0.5);
        let first = format!("{ball} scale 0.5 rotate <0, 180.00000500895632, 0> translate <0, 1, 0>");
        let second = format!("{ball} scale 0.5 rotate <0, 0, 0> translate <0, 0, 0>");
        let all = format!("isosurface {{ {first} }}\n  isosurface {{ {second} }}");
        assert_eq!(shape(&Shape::Instances(pair)), Some(("union", all)));
        let alone = Instances { poses: &places[..1], ..pair };
        assert_eq!(shape(&Shape::Instances(alone)), Some(("isosurface", first)));
    }

    #[test]
    fn tori_are_turned() {
        let axis = Vec3::new(0.0, 0.0, 2.0);
        let ring = Torus { center: UP, axis, major_radius: 2.0, minor_radius: 0.5 };
        let (kind, text) = shape(&Shape::Torus(ring)).unwrap();
        assert_eq!((kind, text.as_str()), ("torus", "2, 0.5 matrix <0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0>"));
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
            let text = to_povray(&scene(&[Object::new(shape, 0)], &[GLASS], &[sun]), &Settings::new(8, 8));
            assert!(text.unwrap().contains("light_source { <0, 90000, 0>"), "{shape:?}");
        }
    }

    #[test]
    fn meshes_keep_their_shared_vertices() {
        let corners = [Vec3::ZERO, Vec3::new(1.0, 0.0, 0.0), UP, Vec3::new(1.0, 1.0, 0.0)];
        let mesh = Mesh { vertices: &corners, triangles: &[[0, 1, 2], [2, 1, 3]], normals: None, uvs: None };
        let flat = "vertex_vectors { 4, <0, 0, 0>, <1, 0, 0>, <0, 1, 0>, <1, 1, 0> }";
        let faces = "face_indices { 2, <0, 1, 2>, <2, 1, 3> }";
        assert_eq!(shape(&Shape::Mesh(mesh)), Some(("mesh2", format!("{flat} {faces}"))));
        let smooth = Shape::Mesh(Mesh { normals: Some(&[UP; 4]), ..mesh });
        let normals = "normal_vectors { 4, <0, 1, 0>, <0, 1, 0>, <0, 1, 0>, <0, 1, 0> }";
        assert_eq!(shape(&smooth), Some(("mesh2", format!("{flat} {normals} {faces}"))));
    }

    #[test]
    fn solids_are_put_together() {
        let ball = |radius: f32| CsgStep::Solid(Solid::Sphere(Sphere::new(Vec3::ZERO, radius)));
        let steps = [
            ball(1.0),
            ball(2.0),
            CsgStep::Union,
            ball(3.0),
            ball(4.0),
            CsgStep::Intersection,
            CsgStep::Difference,
        ];
        let (kind, text) = shape(&Shape::Csg(Csg::new(&steps))).unwrap();
        let sphere = |radius: u8| format!("sphere {{ <0, 0, 0>, {radius} }}");
        let pair = |kind: &str, a: u8, b: u8| format!("{kind} {{ {} {} }}", sphere(a), sphere(b));
        assert_eq!(kind, "difference");
        assert_eq!(text, format!("{} {}", pair("merge", 1, 2), pair("intersection", 3, 4)));
        let objects = [Object::new(Shape::Csg(Csg::new(&steps[..4])), 0)];
        let error = to_povray(&scene(&objects, &[GLASS], &[]), &Settings::new(8, 8)).unwrap_err();
        assert_eq!(error, PovrayError::NotOneSolid(0));
    }

    #[test]
    fn indices_of_nested_spheres_are_absolute() {
        let objects = [0.5, 1.0].map(|radius| Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, radius)), 0));
        let text = to_povray(&scene(&objects, &[GLASS], &[]), &Settings::new(8, 8)).unwrap();
        assert!(text.contains("0.5 texture { Material0 } interior { ior 2.25 }"), "{text}");
        assert!(text.contains("1 texture { Material0 } interior { ior 1.5 }"), "{text}");
    }

    #[test]
    fn figures_in_space_are_written_and_others_refused() {
        let gradient = Gradient { from: LinearRgb::gray(0.0), to: LinearRgb::WHITE, ends: Ends::Mirror };
        let placement = Placement::in_scene(0.5).at(UP);
        let textured = |figure, placement| {
            let placed = Placed::new(figure, placement);
            texture(0, &Material { color: Texture::Placed(&placed), ..Material::matte(LinearRgb::WHITE) })
        };
        let text = textured(Figure::Gradient(gradient), placement).unwrap();
        let expected = "gradient x color_map { [0 rgbt <0, 0, 0, 0>] [0.5 rgbt <1, 1, 1, 0>] [1 rgbt <0, 0, 0, 0>] } \
                        scale <2, 1, 1> scale <0.5, 0.5, 0.5> rotate <0, 0, 0> translate <0, 1, 0>";
        assert!(text.contains(expected), "{text}");
        assert_eq!(textured(Figure::Gradient(gradient), Placement::SURFACE), None);
        let ends = Figure::Gradient(Gradient { ends: Ends::Extend, ..gradient });
        assert_eq!(textured(ends, placement), None);
        let maps = [Map { onto: Onto::Diffuse, texture: Texture::Solid(LinearRgb::WHITE) }];
        assert_eq!(texture(0, &Material { maps: &maps, ..Material::matte(LinearRgb::WHITE) }), None);
    }

    #[test]
    fn unknown_materials_are_refused() {
        let objects = [Object::new(Shape::Sphere(Sphere::new(Vec3::ZERO, 1.0)), 1)];
        let error = to_povray(&scene(&objects, &[GLASS], &[]), &Settings::new(8, 8)).unwrap_err();
        assert_eq!(error, PovrayError::UnknownMaterial(0));
    }
}
