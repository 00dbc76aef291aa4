//! Tests of bad input: every bad number is refused with its part, and every accepted scene renders finite
//! pixels.

use std::mem::MaybeUninit;

use proptest::prelude::*;
use rayline::builtin::{CLASSIC, PRISM};
use rayline::shape::{
    Blob, Cone, Csg, CsgStep, Cylinder, Ellipsoid, Instances, Metaballs, Model, Plane, Polygon, Pose,
    Quadric, Shape, Solid, Sphere, Torus, Triangle,
};
use rayline::{
    Background, Camera, Coefficient, Encoding, Ends, Fault, Figure, Filter, Image, Light, LinearRgb,
    Material, Medium, Object, ObjectId, Optics, Panorama, Part, Pixels, Placed, Placement, PreparedScene,
    RayCounts, Renderer, Scene, SceneBuf, SceneError, Settings, Sky, Stripes, Texture, Vec3,
};
use rayline_tests::{
    Watch, assert_alike, backgrounds, core_picture, lights, maps, numbers, optics, shapes, textures, vectors,
};

fn prepare(scene: &Scene) -> Result<(), SceneError> {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
    PreparedScene::<f32, _>::new(scene, &mut memory).map(|_| ())
}

/// Asserts that the classic scene with one object, material or light replaced is refused for that part.
#[track_caller]
fn assert_refused(change: impl FnOnce(&mut Parts), part: Part, fault: Fault) {
    let mut parts = Parts {
        camera: CLASSIC.camera,
        background: CLASSIC.background,
        objects: CLASSIC.objects.to_vec(),
        materials: CLASSIC.materials.to_vec(),
        lights: CLASSIC.lights.to_vec(),
    };
    assert_eq!(prepare(&parts.scene()), Ok(()));
    change(&mut parts);
    let error = prepare(&parts.scene()).expect_err("refused");
    assert_eq!(error, SceneError { part, fault });
    let message = error.to_string();
    assert!(message.contains(": ") && message.contains(';'), "no cause and remedy: {message}");
}

struct Parts {
    camera: Camera,
    background: Background<'static>,
    objects: Vec<Object<Shape<'static>>>,
    materials: Vec<Material<'static>>,
    lights: Vec<Light>,
}

impl Parts {
    fn scene(&self) -> Scene<'_> {
        Scene {
            camera: self.camera,
            background: self.background,
            objects: &self.objects,
            materials: &self.materials,
            lights: &self.lights,
            motions: &[],
        }
    }
}

const PICTURE: Image = Image {
    width: 1,
    height: 1,
    pixels: Pixels::Rgb565(&[7]),
    encoding: Encoding::Srgb,
    filter: Filter::Nearest,
    ends: Ends::Repeat,
};

const BAD: [(f32, Fault); 5] = [
    (f32::NAN, Fault::NotFinite),
    (f32::INFINITY, Fault::NotFinite),
    (f32::NEG_INFINITY, Fault::NotFinite),
    (1.0001e6, Fault::TooFar),
    (-3e38, Fault::TooFar),
];

/// A model for instances.
static TILE: Model = Model::Polygon(Polygon::new(&[
    Vec3::new(0.0, 0.0, 0.0),
    Vec3::new(1.0, 0.0, 0.0),
    Vec3::new(0.0, 1.0, 0.0),
]));

#[test]
fn numbers_out_of_range_are_refused_with_kind_and_index() {
    for (bad, fault) in BAD {
        let point = Vec3::new(1.0, bad, 2.0);
        let color = LinearRgb::new(0.1, 0.2, bad);
        let number = Number { bad, fault, point, color };
        refuse_camera_and_background(number);
        refuse_shapes(number);
        refuse_lights_and_materials(number);
    }
}

/// A bad number, the fault of a length with this value, and a point and a color that contain it.
#[derive(Clone, Copy)]
struct Number {
    bad: f32,
    fault: Fault,
    point: Vec3,
    color: LinearRgb,
}

impl Number {
    /// The fault of a number that is no length: scaling the scene would not help with that.
    fn no_length(self) -> Fault {
        self.instead(Fault::TooLarge { given: self.bad })
    }

    /// The fault of a coefficient.
    fn share(self, coefficient: Coefficient) -> Fault {
        self.instead(Fault::OutsideUnit { coefficient, given: self.bad })
    }

    /// Another fault for a number that is too large; NaN and infinity have the same fault everywhere.
    fn instead(self, other: Fault) -> Fault {
        if self.fault == Fault::TooFar { other } else { self.fault }
    }
}

fn refuse_camera_and_background(of: Number) {
    let Number { bad, fault, point, color } = of;
    let number = of.no_length();
    assert_refused(|parts| parts.camera.eye = point, Part::Camera, fault);
    assert_refused(|parts| parts.camera.target = point, Part::Camera, fault);
    assert_refused(|parts| parts.camera.up = point, Part::Camera, number);
    let view = of.instead(Fault::FieldOfView);
    assert_refused(|parts| parts.camera.vertical_fov = bad, Part::Camera, view);
    assert_refused(|parts| parts.background = color.into(), Part::Background, number);
    let sky = Sky::new(color, LinearRgb::WHITE);
    assert_refused(
        |parts| parts.background = Background::Gradient(Box::leak(Box::new(sky))),
        Part::Background,
        number,
    );
    let panorama = Panorama { rotation: point, ..Panorama::new(PICTURE) };
    assert_refused(
        |parts| parts.background = Background::Image(Box::leak(Box::new(panorama))),
        Part::Background,
        number,
    );
}

fn refuse_shapes(of: Number) {
    static HERE: [Pose; 1] = [Pose::at(Vec3::ZERO)];
    let Number { bad, fault, point, .. } = of;
    let number = of.no_length();
    for (i, object) in [
        Shape::Sphere(Sphere::new(point, 1.0)),
        Shape::Plane(Plane::new(point, Vec3::new(0.0, 1.0, 0.0))),
        Shape::Triangle(Triangle::flat(point, Vec3::ZERO, Vec3::new(1.0, 0.0, 0.0))),
        Shape::Cylinder(Cylinder { base: Vec3::ZERO, top: point, radius: 1.0, capped: true }),
        Shape::Cone(Cone { base: point, base_radius: 1.0, top: Vec3::ZERO, top_radius: 0.0, capped: false }),
        Shape::Ellipsoid(Ellipsoid::new(Vec3::ZERO, point)),
        Shape::Torus(Torus {
            center: point,
            axis: Vec3::new(0.0, 1.0, 0.0),
            major_radius: 2.0,
            minor_radius: 1.0,
        }),
        Shape::Torus(Torus {
            center: Vec3::ZERO,
            axis: Vec3::new(0.0, 1.0, 0.0),
            major_radius: bad,
            minor_radius: 1.0,
        }),
        Shape::Quadric(Quadric {
            center: Vec3::ZERO,
            coefficients: [1.0; 10],
            min: Vec3::ZERO,
            max: point,
            capped: true,
        }),
        Shape::Metaballs(Metaballs::new(Box::leak(Box::new([Blob::new(point, 1.0)])))),
        Shape::Instances(Instances::new(&TILE, Box::leak(Box::new([Pose::at(point)])))),
    ]
    .into_iter()
    .enumerate()
    {
        let index = i % 5;
        assert_refused(|parts| parts.objects[index].shape = object, Part::Object(index), fault);
    }
    for object in [
        Shape::Plane(Plane::new(Vec3::ZERO, point)),
        Shape::Metaballs(Metaballs::new(Box::leak(Box::new([
            Blob::new(Vec3::ZERO, 1.0),
            Blob { strength: bad, ..Blob::new(Vec3::ZERO, 1.0) },
        ])))),
        Shape::Instances(Instances::new(&TILE, Box::leak(Box::new([Pose::at(Vec3::ZERO).turned(point)])))),
        Shape::Instances(Instances::new(&TILE, &HERE).sized(bad)),
    ] {
        assert_refused(|parts| parts.objects[2].shape = object, Part::Object(2), number);
    }
}

fn refuse_lights_and_materials(of: Number) {
    let Number { bad, fault, point, color } = of;
    let number = of.no_length();
    for (index, (light, fault)) in [
        (Light::Point { position: point, color: LinearRgb::WHITE }, fault),
        (Light::Directional { direction: point, color: LinearRgb::WHITE }, number),
        (Light::Point { position: Vec3::ZERO, color }, number),
    ]
    .into_iter()
    .enumerate()
    {
        assert_refused(|parts| parts.lights[index] = light, Part::Light(index), fault);
    }
    type Field = for<'m> fn(&'m mut Material<'static>) -> &'m mut f32;
    let fields: [(Field, Fault); 7] = [
        (|material| &mut material.ambient, of.share(Coefficient::Ambient)),
        (|material| &mut material.diffuse, of.share(Coefficient::Diffuse)),
        (|material| &mut material.specular, of.share(Coefficient::Specular)),
        (|material| &mut material.shininess, number),
        (|material| &mut material.reflectance, of.share(Coefficient::Reflectance)),
        (|material| &mut material.transmittance, of.share(Coefficient::Transmittance)),
        (|material| &mut material.ior, number),
    ];
    for (field, fault) in fields {
        assert_refused(|parts| *field(&mut parts.materials[3]) = bad, Part::Material(3), fault);
    }
    let channel = of.share(Coefficient::Color);
    assert_refused(|parts| parts.materials[4].color = Texture::Solid(color), Part::Material(4), channel);
    let checker = Texture::checker_xz(LinearRgb::WHITE, color, 1.0);
    assert_refused(|parts| parts.materials[4].color = checker, Part::Material(4), channel);
}

/// Earlier versions called cells of size 0 not finite, and blamed the scale of the scene for tiny ones.
#[test]
fn cells_of_a_checker_that_are_too_small_are_told_so() {
    for size in [0.0, -0.0, 1e-7, -1e-7] {
        let checker = Texture::checker_xz(LinearRgb::WHITE, LinearRgb::WHITE, size);
        assert_refused(|parts| parts.materials[4].color = checker, Part::Material(4), Fault::PatternSize);
    }
    let nan = Texture::checker_xz(LinearRgb::WHITE, LinearRgb::WHITE, f32::NAN);
    assert_refused(|parts| parts.materials[4].color = nan, Part::Material(4), Fault::NotFinite);
    assert!(
        Fault::PatternSize.to_string().contains("the cells of a checker are smaller than 1e-6; enlarge them")
    );
}

/// Earlier errors had neither the name nor the value of the coefficient.
#[test]
fn a_coefficient_outside_0_to_1_is_named() {
    const TINTED: Optics = Optics { transmission_color: LinearRgb::new(0.5, -1.0, 0.5), ..Optics::PLAIN };
    static WIDE: Placed = Placed::new(
        Figure::Stripes(Stripes { first: LinearRgb::WHITE, second: LinearRgb::WHITE, width: 2.0 }),
        Placement::SURFACE,
    );
    let told = |change: fn(&mut Material)| {
        let mut materials = CLASSIC.materials.to_vec();
        change(&mut materials[1]);
        prepare(&Scene { materials: &materials, ..CLASSIC }).expect_err("refused").to_string()
    };
    for (change, message) in [
        (
            (|glass| glass.specular = 1.5) as fn(&mut Material),
            "material 1: `specular` is 1.5, outside 0 to 1; scale it",
        ),
        (|glass| glass.ambient = 1e7, "material 1: `ambient` is 10000000.0, outside 0 to 1; scale it"),
        (
            |glass| glass.color = LinearRgb::new(0.5, 200.0, 0.5).into(),
            "material 1: a component of `color` is 200.0, outside 0 to 1; scale it (of 255 levels, divide by \
             255)",
        ),
        (
            |glass| glass.optics = Some(&TINTED),
            "material 1: a component of `transmission_color` is -1.0, outside 0 to 1; scale it (of 255 \
             levels, divide by 255)",
        ),
        (
            |glass| glass.color = Texture::Placed(&WIDE),
            "material 1: `width` is 2.0, outside 0 to 1; scale it",
        ),
    ] {
        assert_eq!(told(change), message);
    }
}

/// An earlier version reported the fault of a solid or a model as one of the whole object.
#[test]
fn a_fault_inside_of_a_shape_names_the_part() {
    const BALL: Solid = Solid::Sphere(Sphere::new(Vec3::new(0.0, 0.0, -9.0), 1.0));
    const POINT: Solid = Solid::Sphere(Sphere::new(Vec3::new(0.0, 0.0, -9.0), 0.0));
    const STEPS: &[CsgStep] = &[
        CsgStep::Solid(BALL),
        CsgStep::Solid(BALL),
        CsgStep::Union,
        CsgStep::Solid(POINT),
        CsgStep::Difference,
    ];
    static CUT: Model = Model::Csg(Csg::new(STEPS));
    static LINE: Model = Model::Polygon(Polygon::new(&[Vec3::ZERO, Vec3::ZERO]));
    static HERE: [Pose; 1] = [Pose::at(Vec3::ZERO)];
    static NOWHERE: [Pose; 1] = [Pose::at(Vec3::new(f32::NAN, 0.0, 0.0))];
    for (shape, part, fault, place) in [
        (
            Shape::Csg(Csg::new(STEPS)),
            Part::Solid { object: 3, solid: 2 },
            Fault::RadiusNotPositive,
            "object 3, solid 2: the radius",
        ),
        (
            Shape::Instances(Instances::new(&CUT, &HERE)),
            Part::Solid { object: 3, solid: 2 },
            Fault::RadiusNotPositive,
            "object 3, solid 2: the radius",
        ),
        (
            Shape::Instances(Instances::new(&LINE, &HERE)),
            Part::Model(3),
            Fault::NoArea,
            "object 3, model: the polygon",
        ),
        (
            Shape::Instances(Instances::new(&CUT, &NOWHERE)),
            Part::Object(3),
            Fault::NotFinite,
            "object 3: a number",
        ),
    ] {
        assert_refused(|parts| parts.objects[3].shape = shape, part, fault);
        let message = SceneError { part, fault }.to_string();
        assert!(message.starts_with(place), "{message}");
    }
}

#[test]
fn degenerate_shapes_are_refused() {
    let refused = |shape: Shape<'static>, fault| {
        assert_refused(|parts| parts.objects[2].shape = shape, Part::Object(2), fault);
    };
    for radius in [0.0, -1.0] {
        refused(Shape::Sphere(Sphere::new(Vec3::ZERO, radius)), Fault::RadiusNotPositive);
        let top = Vec3::new(0.0, 1.0, 0.0);
        let cylinder = Cylinder { base: Vec3::ZERO, top, radius, capped: false };
        refused(Shape::Cylinder(cylinder), Fault::RadiusNotPositive);
    }
    let line = [0.0, 1.0, 2.0].map(|x| Vec3::new(x, x, x));
    let [a, b, c] = line;
    refused(Shape::Triangle(Triangle::flat(a, b, c)), Fault::Collinear);
    static LINE: [Vec3; 3] = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 1.0), Vec3::new(2.0, 2.0, 2.0)];
    refused(Shape::Polygon(Polygon::new(&LINE)), Fault::NoArea);
    refused(Shape::Plane(Plane::new(Vec3::ZERO, Vec3::ZERO)), Fault::ZeroLength);
    refused(Shape::Csg(Csg::new(&[CsgStep::Union])), Fault::NotOneSolid);
    refused(Shape::Metaballs(Metaballs::new(&[])), Fault::TooWeak);
    refused(Shape::Instances(Instances::new(&TILE, &[])), Fault::NoPoses);
}

#[test]
fn impossible_materials_are_refused() {
    let refused = |change: fn(&mut Material), fault| {
        assert_refused(|parts| change(&mut parts.materials[1]), Part::Material(1), fault);
    };
    refused(|glass| glass.reflectance = 0.3, Fault::EnergyAboveOne);
    refused(
        |glass| glass.diffuse = 1.1,
        Fault::OutsideUnit { coefficient: Coefficient::Diffuse, given: 1.1 },
    );
    refused(
        |glass| glass.specular = -0.1,
        Fault::OutsideUnit { coefficient: Coefficient::Specular, given: -0.1 },
    );
    refused(|glass| glass.ior = 0.0, Fault::IorNotPositive);
    refused(|glass| glass.ior = -1.5, Fault::IorNotPositive);
    const IN_NOTHING: Optics = Optics { outside: Medium::clear(0.0), ..Optics::PLAIN };
    const IN_LIGHT: Optics =
        Optics { outside: Medium { ior: 1.0, absorption: LinearRgb::gray(-1.0) }, ..Optics::PLAIN };
    refused(|glass| glass.optics = Some(&IN_NOTHING), Fault::IorNotPositive);
    refused(|glass| glass.optics = Some(&IN_LIGHT), Fault::NegativeColor { given: -1.0 });
    refused(|glass| glass.shininess = -1.0, Fault::NegativeShininess);
    let color = |given| Fault::OutsideUnit { coefficient: Coefficient::Color, given };
    refused(|glass| glass.color = LinearRgb::gray(-0.1).into(), color(-0.1));
    refused(|glass| glass.color = LinearRgb::gray(1.1).into(), color(1.1));
    let black_hole = Light::Point { position: Vec3::ZERO, color: LinearRgb::gray(-1.0) };
    assert_refused(
        |parts| parts.lights[2] = black_hole,
        Part::Light(2),
        Fault::NegativeColor { given: -1.0 },
    );
    assert_refused(
        |parts| parts.background = Background::gray(-0.5),
        Part::Background,
        Fault::NegativeColor { given: -0.5 },
    );
}

#[test]
fn an_unknown_material_is_refused() {
    let unknown = Fault::UnknownMaterial { named: 5, materials: 5 };
    assert_refused(|parts| parts.objects[3].material.0 = 5, Part::Object(3), unknown);
    assert_refused(
        |parts| parts.materials.clear(),
        Part::Object(0),
        Fault::UnknownMaterial { named: 0, materials: 0 },
    );
}

#[test]
fn too_many_are_refused() {
    let given = 65_536;
    assert_refused(
        |parts| parts.lights.resize(given, CLASSIC.lights[0]),
        Part::Light(65_535),
        Fault::TooMany { given },
    );
}

#[test]
fn too_little_memory_is_refused_and_just_enough_is_enough() {
    for scene in [&CLASSIC, &PRISM] {
        let needed = scene.bytes::<f32>();
        for lent in [0, 1, needed / 2, needed - 1] {
            let mut memory = vec![MaybeUninit::uninit(); lent];
            let error = PreparedScene::<f32, _>::new(scene, &mut memory).expect_err("refused");
            assert_eq!(error, SceneError { part: Part::Memory, fault: Fault::Memory { needed, lent } });
        }
        // Memory of any alignment is accepted.
        for offset in 0..16 {
            let mut memory = vec![MaybeUninit::uninit(); needed + offset];
            assert!(PreparedScene::<f32, _>::new(scene, &mut memory[offset..]).is_ok());
        }
    }
}

#[test]
fn a_refused_camera_leaves_the_old_one() {
    let mut memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<f32>()];
    let mut prepared = PreparedScene::<f32, _>::new(&CLASSIC, &mut memory).expect("a legal scene");
    let before = Renderer::new(&prepared, Settings::new(9, 9)).expect("legal").pixel(4, 4, &mut ()).0;
    let blind = Camera { target: CLASSIC.camera.eye, ..CLASSIC.camera };
    let error = prepared.set_camera(&blind).expect_err("refused");
    assert_eq!(error, SceneError { part: Part::Camera, fault: Fault::EyeAtTarget });
    let after = Renderer::new(&prepared, Settings::new(9, 9)).expect("legal").pixel(4, 4, &mut ()).0;
    assert_eq!(before, after);
}

#[test]
fn a_full_scene_hands_back_what_does_not_fit() {
    let mut scene = SceneBuf::<Sphere, 2, 1, 1>::new(CLASSIC.camera, CLASSIC.background);
    let matte = scene.add_material(CLASSIC.materials[0]).expect("room");
    let full = scene.add_material(CLASSIC.materials[1]).expect_err("no room");
    assert_eq!((full.item, full.parameter), (CLASSIC.materials[1], "MATERIALS"));
    let message = "the scene has no room for one more; raise `MATERIALS` of its `SceneBuf`";
    assert_eq!(full.to_string(), message);
    let ball = |x| Sphere::new(Vec3::new(x, 0.0, -9.0), 1.0);
    assert_eq!(scene.add_object(ball(0.0), matte), Ok(ObjectId(0)));
    assert_eq!(scene.add_object(ball(1.0), matte), Ok(ObjectId(1)));
    let full = scene.add_object(ball(2.0), matte).expect_err("no room");
    assert_eq!((full.item, full.parameter), (Object { shape: ball(2.0), material: matte }, "OBJECTS"));
    assert_eq!(scene.add_light(CLASSIC.lights[0]), Ok(()));
    let full = scene.add_light(CLASSIC.lights[1]).expect_err("no room");
    assert_eq!((full.item, full.parameter), (CLASSIC.lights[1], "LIGHTS"));
    let Scene { objects, materials, lights, .. } = scene.as_scene();
    assert_eq!(objects.iter().map(|object| object.shape).collect::<Vec<_>>(), [ball(0.0), ball(1.0)]);
    assert_eq!((materials, lights), (&CLASSIC.materials[..1], &CLASSIC.lights[..1]));
    scene.clear();
    assert!(scene.as_scene().objects.is_empty());
}

/// Any float, and often a legal one.
fn number() -> BoxedStrategy<f32> {
    prop_oneof![1 => any::<f32>(), 24 => numbers()].boxed()
}

fn vector() -> BoxedStrategy<Vec3> {
    vectors(&number())
}

fn share() -> BoxedStrategy<f32> {
    prop_oneof![1 => any::<f32>(), 40 => 0.0f32..0.5, 5 => Just(0.0), 5 => Just(1.0)].boxed()
}

fn light_color() -> BoxedStrategy<LinearRgb> {
    [share(), share(), share()].prop_map(|[r, g, b]| LinearRgb::new(r, g, b)).boxed()
}

fn material() -> BoxedStrategy<Material<'static>> {
    let shares = (share(), share(), share(), share(), share());
    let optics = optics(&share());
    let checker = (light_color(), light_color(), vector()).prop_map(|(even, odd, cells_per_unit)| {
        Texture::Checker(rayline::Checker { even, odd, cells_per_unit })
    });
    let texture = proptest::option::of(prop_oneof![checker, textures(&share(), &light_color())]);
    (light_color(), shares, number(), number(), texture, (optics, maps(&share(), &light_color())))
        .prop_map(
            |(
                color,
                (ambient, diffuse, specular, reflectance, transmittance),
                shininess,
                ior,
                texture,
                (optics, maps),
            )| {
                Material {
                    color: texture.unwrap_or(color.into()),
                    ambient,
                    diffuse,
                    specular,
                    shininess,
                    reflectance,
                    transmittance,
                    ior,
                    optics,
                    maps,
                }
            },
        )
        .boxed()
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 20_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_scene_is_refused_or_renders_finite_pixels(
        camera in (vector(), vector(), vector(), 0.01f32..3.0),
        background in backgrounds(&number(), &light_color()),
        shapes in proptest::collection::vec((shapes(&number()), 0..3u16), 0..5),
        materials in proptest::collection::vec(material(), 3),
        lights in proptest::collection::vec(lights(&number(), &light_color()), 0..3),
    ) {
        let (eye, target, up, vertical_fov) = camera;
        // Leave out the refused parts, so that most cases render a picture.
        let camera = Camera { eye, target, up, vertical_fov, lens: None };
        let accepted = |scene: &Scene| prepare(scene).is_ok();
        let empty = Scene { objects: &[], materials: &[], lights: &[], ..CLASSIC };
        let camera = if accepted(&Scene { camera, ..empty }) { camera } else { CLASSIC.camera };
        let background =
            if accepted(&Scene { background, ..empty }) { background } else { Background::gray(0.5) };
        let materials: Vec<_> = materials
            .into_iter()
            .map(|material| {
                let is_accepted = accepted(&Scene { materials: &[material], ..empty });
                if is_accepted { material } else { CLASSIC.materials[1] }
            })
            .collect();
        let objects: Vec<_> = shapes
            .into_iter()
            .map(|(shape, material)| Object::new(shape, material))
            .filter(|object| accepted(&Scene { objects: &[*object], materials: &materials, ..empty }))
            .collect();
        let lights: Vec<_> =
            lights.into_iter().filter(|light| accepted(&Scene { lights: &[*light], ..empty })).collect();
        let scene = Scene { camera, background, objects: &objects, materials: &materials, lights: &lights, motions: &[] };

        let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<f32>()];
        let prepared = PreparedScene::<f32, _>::new(&scene, &mut memory).expect("every part was accepted");
        let settings = Settings { bounces: 8, rays_per_pixel: 300, ..Settings::new(5, 5) };
        let renderer = Renderer::new(&prepared, settings).expect("legal settings");
        let mut counts = RayCounts::default();
        for (x, y) in (0..5).flat_map(|y| (0..5).map(move |x| (x, y))) {
            let (light, rays) = renderer.pixel(x, y, &mut Watch(&mut counts));
            prop_assert!(rays <= 300);
            for value in [light.r, light.g, light.b] {
                prop_assert!(value.is_finite() && value >= 0.0, "{light:?} at {x}, {y}");
            }
        }
        prop_assert_eq!(counts.camera, 25);
    }
}

/// On a ground that is a ball of radius 1e5, as scenes of textbooks have it, a ball throws its shadow. In
/// `f32` the ground's coordinates are known to 0.008, and rays leave it by 0.08.
#[test]
fn things_on_a_huge_ball_throw_shadows() {
    let sphere = |y: f32, radius: f32| Shape::Sphere(Sphere::new(Vec3::new(0.0, y, 0.0), radius));
    let matte = |color| Material { ambient: 0.1, ..Material::matte(color) };
    let materials = [matte(LinearRgb::gray(0.8)), matte(LinearRgb::new(0.7, 0.2, 0.11))];
    let direction = Vec3::new(3.0, -1.0, -1.0);
    let camera = Camera {
        eye: Vec3::new(0.0, 1.5, 6.0),
        target: Vec3::new(0.0, 0.5, 0.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.6,
        lens: None,
    };
    for radius in [1.1e3, 5e3, 1e5] {
        let objects = [Object::new(sphere(-radius, radius), 0), Object::new(sphere(1.0, 1.0), 1)];
        let scene = Scene {
            camera,
            background: Background::Solid(LinearRgb::new(0.2, 0.3, 0.42)),
            objects: &objects,
            materials: &materials,
            lights: &[Light::Directional { direction, color: LinearRgb::WHITE }],
            motions: &[],
        };
        let settings = Settings::new(200, 150);
        let (f32, f64) = (core_picture::<f32>(&scene, settings), core_picture::<f64>(&scene, settings));
        let directory = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
        assert_alike(directory, &format!("huge-{radius}"), ("f32", &f32), ("f64", &f64));
    }
}
