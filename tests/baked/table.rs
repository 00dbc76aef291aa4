// Written by rayline: change the scene and write it again.
/// The description of the scene. Only the parts of it that are used take flash.
pub const DESCRIPTION: rayline::Scene<'static> = {
    #[allow(unused_imports)]
    use rayline::{*, shape::*};
    Scene {
        camera: Camera {
            eye: Vec3::new(0.3, 3.1, 7.4),
            target: Vec3::new(0.15, 0.75, 0.0),
            up: Vec3::new(0.0, 1.0, 0.0),
            vertical_fov: 0.62831855,
            lens: None,
        },
        background: Background::Solid(LinearRgb::new(0.12, 0.15, 0.2)),
        objects: &[
            Object {
                shape: Shape::Rectangle(Rectangle {
                    corner: Vec3::new(-8.0, 0.0, 8.0),
                    right: Vec3::new(16.0, 0.0, 0.0),
                    up: Vec3::new(0.0, 0.0, -16.0),
                }),
                material: MaterialId(0),
            },
            Object {
                shape: Shape::Csg(Csg {
                    steps: &[CsgStep::Solid(Solid::Cuboid(Cuboid { center: Vec3::new(0.35, 0.7, -0.9), axes: [Vec3::new(0.606, 0.0, -0.35), Vec3::new(0.0, 0.7, 0.0), Vec3::new(0.35, 0.0, 0.606)] })), CsgStep::Solid(Solid::Sphere(Sphere { center: Vec3::new(0.35, 0.7, -0.9), radius: 0.98 })), CsgStep::Intersection, CsgStep::Solid(Solid::Sphere(Sphere { center: Vec3::new(0.35, 1.46, -0.9), radius: 0.16 })), CsgStep::Difference, CsgStep::Solid(Solid::Sphere(Sphere { center: Vec3::new(0.55, 0.95, -0.13999999), radius: 0.16 })), CsgStep::Difference, CsgStep::Solid(Solid::Sphere(Sphere { center: Vec3::new(0.908, 0.45, -0.34199995), radius: 0.16 })), CsgStep::Difference, CsgStep::Solid(Solid::Sphere(Sphere { center: Vec3::new(-0.110000014, 1.02, -0.27999997), radius: 0.16 })), CsgStep::Difference, CsgStep::Solid(Solid::Sphere(Sphere { center: Vec3::new(-0.22999999, 0.7, -0.49999997), radius: 0.16 })), CsgStep::Difference, CsgStep::Solid(Solid::Sphere(Sphere { center: Vec3::new(-0.35, 0.38, -0.7), radius: 0.16 })), CsgStep::Difference],
                }),
                material: MaterialId(1),
            },
            Object {
                shape: Shape::Torus(Torus {
                    center: Vec3::new(1.75, 0.3, 1.2),
                    axis: Vec3::new(0.0, 1.0, 0.0),
                    major_radius: 0.7,
                    minor_radius: 0.28,
                }),
                material: MaterialId(2),
            },
            Object {
                shape: Shape::Sphere(Sphere {
                    center: Vec3::new(-1.1, 0.75, 1.3),
                    radius: 0.73,
                }),
                material: MaterialId(3),
            },
            Object {
                shape: Shape::Ellipsoid(Ellipsoid {
                    center: Vec3::new(-2.2, 1.21, -0.9),
                    axes: [Vec3::new(0.7, 0.0, 0.0), Vec3::new(0.0, 1.2, 0.0), Vec3::new(0.0, 0.0, 0.7)],
                }),
                material: MaterialId(4),
            },
            Object {
                shape: Shape::Sphere(Sphere {
                    center: Vec3::new(0.45, 0.36, 2.2),
                    radius: 0.35,
                }),
                material: MaterialId(5),
            },
            Object {
                shape: Shape::Cone(Cone {
                    base: Vec3::new(2.6, 0.01, -1.5),
                    base_radius: 0.8,
                    top: Vec3::new(2.6, 1.9, -1.5),
                    top_radius: 0.15,
                    capped: true,
                }),
                material: MaterialId(5),
            },
        ],
        materials: &[
            Material {
                color: Texture::Checker(Checker {
                    even: LinearRgb::new(0.55, 0.4, 0.28),
                    odd: LinearRgb::new(0.25, 0.14, 0.08),
                    cells_per_unit: Vec3::new(1.0, 0.0, 1.0),
                }),
                ambient: 0.1,
                diffuse: 1.0,
                specular: 0.0,
                shininess: 0.0,
                reflectance: 0.0,
                transmittance: 0.0,
                ior: 1.0,
                optics: None,
                maps: &[],
            },
            Material {
                color: Texture::Solid(LinearRgb::new(0.85, 0.8, 0.7)),
                ambient: 0.1,
                diffuse: 1.0,
                specular: 0.3,
                shininess: 60.0,
                reflectance: 0.0,
                transmittance: 0.0,
                ior: 1.0,
                optics: None,
                maps: &[],
            },
            Material {
                color: Texture::Solid(LinearRgb::new(0.0, 0.0, 0.0)),
                ambient: 0.0,
                diffuse: 0.0,
                specular: 0.8,
                shininess: 150.0,
                reflectance: 0.9,
                transmittance: 0.0,
                ior: 1.0,
                optics: Some(&Optics {
                    highlight: Highlight::Phong,
                    fresnel: Fresnel::Constant,
                    reflection_color: LinearRgb::new(1.0, 0.782, 0.344),
                    transmission_color: LinearRgb::new(1.0, 1.0, 1.0),
                    absorption: LinearRgb::new(0.0, 0.0, 0.0),
                    emission: LinearRgb::new(0.0, 0.0, 0.0),
                    emission_sides: Sides::Both,
                    reflection_falloff: Falloff { constant: 1.0, linear: 0.0, quadratic: 0.0 },
                    outside: Medium { ior: 1.0, absorption: LinearRgb::new(0.0, 0.0, 0.0) },
                    gloss: None,
                    translucency: None,
                    sides: Sides::Both,
                    thin: false,
                }),
                maps: &[],
            },
            Material {
                color: Texture::Solid(LinearRgb::new(0.0, 0.0, 0.0)),
                ambient: 0.0,
                diffuse: 0.0,
                specular: 0.6,
                shininess: 600.0,
                reflectance: 0.0,
                transmittance: 1.0,
                ior: 1.5168,
                optics: Some(&Optics {
                    highlight: Highlight::Phong,
                    fresnel: Fresnel::Exact,
                    reflection_color: LinearRgb::new(1.0, 1.0, 1.0),
                    transmission_color: LinearRgb::new(1.0, 1.0, 1.0),
                    absorption: LinearRgb::new(0.0, 0.0, 0.0),
                    emission: LinearRgb::new(0.0, 0.0, 0.0),
                    emission_sides: Sides::Both,
                    reflection_falloff: Falloff { constant: 1.0, linear: 0.0, quadratic: 0.0 },
                    outside: Medium { ior: 1.0, absorption: LinearRgb::new(0.0, 0.0, 0.0) },
                    gloss: None,
                    translucency: None,
                    sides: Sides::Both,
                    thin: false,
                }),
                maps: &[],
            },
            Material {
                color: Texture::Solid(LinearRgb::new(0.0, 0.0, 0.0)),
                ambient: 0.0,
                diffuse: 0.0,
                specular: 0.6,
                shininess: 600.0,
                reflectance: 0.0,
                transmittance: 1.0,
                ior: 1.5168,
                optics: Some(&Optics {
                    highlight: Highlight::Phong,
                    fresnel: Fresnel::Exact,
                    reflection_color: LinearRgb::new(1.0, 1.0, 1.0),
                    transmission_color: LinearRgb::new(1.0, 1.0, 1.0),
                    absorption: LinearRgb::new(1.1, 0.12, 0.8),
                    emission: LinearRgb::new(0.0, 0.0, 0.0),
                    emission_sides: Sides::Both,
                    reflection_falloff: Falloff { constant: 1.0, linear: 0.0, quadratic: 0.0 },
                    outside: Medium { ior: 1.0, absorption: LinearRgb::new(0.0, 0.0, 0.0) },
                    gloss: None,
                    translucency: None,
                    sides: Sides::Both,
                    thin: false,
                }),
                maps: &[],
            },
            Material {
                color: Texture::Solid(LinearRgb::new(0.6, 0.04, 0.03)),
                ambient: 0.1,
                diffuse: 0.9,
                specular: 0.4,
                shininess: 120.0,
                reflectance: 1.0,
                transmittance: 0.0,
                ior: 1.5,
                optics: Some(&Optics {
                    highlight: Highlight::Phong,
                    fresnel: Fresnel::Exact,
                    reflection_color: LinearRgb::new(1.0, 1.0, 1.0),
                    transmission_color: LinearRgb::new(1.0, 1.0, 1.0),
                    absorption: LinearRgb::new(0.0, 0.0, 0.0),
                    emission: LinearRgb::new(0.0, 0.0, 0.0),
                    emission_sides: Sides::Both,
                    reflection_falloff: Falloff { constant: 1.0, linear: 0.0, quadratic: 0.0 },
                    outside: Medium { ior: 1.0, absorption: LinearRgb::new(0.0, 0.0, 0.0) },
                    gloss: None,
                    translucency: None,
                    sides: Sides::Both,
                    thin: false,
                }),
                maps: &[],
            },
        ],
        lights: &[
            Light::Lamp(Lamp {
                position: Vec3::new(-4.0, 7.0, 5.0),
                color: LinearRgb::new(2.6, 2.4, 2.0),
                falloff: Falloff {
                    constant: 1.0,
                    linear: 0.0,
                    quadratic: 0.015,
                },
                cone: Some(LightCone {
                    direction: Vec3::new(4.2, -6.5, -5.0),
                    bright: 0.3,
                    dark: 0.55,
                }),
            }),
            Light::Directional {
                direction: Vec3::new(-1.0, -1.2, -0.4),
                color: LinearRgb::new(0.2, 0.24, 0.3),
            },
            Light::Ambient {
                color: LinearRgb::new(0.8, 0.9, 1.0),
            },
        ],
        motions: &[],
    }
};

rayline::shape_set! {
    /// The shapes of the scene, and no others.
    pub enum Shapes<'a>;
    /// The prepared shapes of the scene.
    pub enum PreparedShapes {
        /// A built-in shape.
        Cone(rayline::shape::Cone),
        /// A built-in shape.
        Csg(rayline::shape::Csg<'a>),
        /// A built-in shape.
        Ellipsoid(rayline::shape::Ellipsoid),
        /// A built-in shape.
        Rectangle(rayline::shape::Rectangle),
        /// A built-in shape.
        Sphere(rayline::shape::Sphere),
        /// A built-in shape.
        Torus(rayline::shape::Torus),
    }
}

const fn narrowed(object: usize) -> Shapes<'static> {
    match DESCRIPTION.objects[object].shape {
        rayline::shape::Shape::Cone(shape) => Shapes::Cone(shape),
        rayline::shape::Shape::Csg(shape) => Shapes::Csg(shape),
        rayline::shape::Shape::Ellipsoid(shape) => Shapes::Ellipsoid(shape),
        rayline::shape::Shape::Rectangle(shape) => Shapes::Rectangle(shape),
        rayline::shape::Shape::Sphere(shape) => Shapes::Sphere(shape),
        rayline::shape::Shape::Torus(shape) => Shapes::Torus(shape),
        #[allow(unreachable_patterns)]
        _ => panic!("the scene has no such shape"),
    }
}

static OBJECTS: [rayline::Object<Shapes<'static>>; 7] = {
    let all = DESCRIPTION.objects;
    let mut objects = [rayline::Object::new(narrowed(0), all[0].material.0); 7];
    let mut i = 1;
    while i < 7 {
        objects[i] = rayline::Object::new(narrowed(i), all[i].material.0);
        i += 1;
    }
    objects
};

/// The scene, in flash.
pub static SCENE: rayline::Scene<'static, Shapes<'static>> = rayline::Scene {
    camera: DESCRIPTION.camera,
    background: DESCRIPTION.background,
    objects: &OBJECTS,
    materials: DESCRIPTION.materials,
    lights: DESCRIPTION.lights,
    motions: DESCRIPTION.motions,
};

/// The set of shapes, with its lifetime.
pub type Set = Shapes<'static>;

/// The bytes of memory that the prepared scene takes in the number system `R`.
pub const fn prepared_bytes<R: rayline::Real>() -> usize {
    rayline::prepared_bytes!(R, SCENE)
}
