//! Tests with texts that are scenes and texts that are not.

use core::mem::MaybeUninit;
use std::fs;
use std::path::Path;

use bumpalo::Bump;
use rayline::shape::{
    Blob, Cone, ConvexPolyhedron, Csg, CsgStep, Cuboid, Cylinder, Disc, Ellipsoid, Instances, Mesh,
    Metaballs, Model, Plane, Polygon, Pose, Quadric, Rectangle, Shape, Solid, Sphere, Torus, Triangle,
};
use rayline::{
    Adaptive, Background, Brick, Camera, Checker, Dither, Encoding, Ends, Falloff, Figure, Filter, Fresnel,
    Gradient, Highlight, Image, Lamp, Lens, Light, LightCone, LinearRgb, Map, Marble, Material, Medium,
    Motion, Noise, Object, ObjectId, Onto, Optics, Panorama, Part, Pixels, Placed, Placement, Sampler,
    Sampling, Scene, Settings, Sides, Sky, Space, Squares, Stripes, Texture, Vec3, Wood, builtin,
};

use rayline_formats::Pictures;
use rayline_scenes::ron::{FileSettings, Import, Position, RonFault, read, write, write_beside};
use rayline_scenes::{FILE_SETTINGS, LoadedScene};

use crate::check;

const UP: Vec3 = Vec3::new(0.0, 1.0, 0.0);
const GRAY: LinearRgb = LinearRgb::gray(0.25);
const PLANE: Plane = Plane::new(Vec3::ZERO, UP);
const SPHERE: Sphere = Sphere::new(Vec3::new(0.0, 0.1, -1e-7), 1e6);
const CONE: Cone = Cone { base: Vec3::ZERO, base_radius: 0.0, top: UP, top_radius: 1.0, capped: true };
const CYLINDER: Cylinder = Cylinder { base: Vec3::ZERO, top: UP, radius: 0.5, capped: false };
const TORUS: Torus = Torus { center: UP, axis: UP, major_radius: 1.0, minor_radius: 0.3 };
const CUBOID: Cuboid = Cuboid::aligned(Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0));
const QUADRIC: Quadric = Quadric {
    center: UP,
    coefficients: [1.0, -1.0, 0.5, 0.0, 1e-9, 2e9, 0.0, 0.0, 0.0, -1.0],
    min: Vec3::ZERO,
    max: UP,
    capped: true,
};
const MESH: Mesh<'static> = Mesh {
    vertices: &[Vec3::ZERO, UP, Vec3::new(1.0, 0.0, 0.0)],
    triangles: &[[0, 1, 2], [2, 1, 0]],
    normals: Some(&[UP, UP, UP]),
    uvs: Some(&[[0.0, 0.0], [0.0, 1.0], [1.0, -59.0]]),
    colors: Some(&[[0, 128, 255], [1, 2, 3], [9, 8, 7]]),
    smooth_terminator: true,
};

/// Every kind of shape.
const SHAPES: [Shape<'static>; 18] = [
    Shape::Instances(Instances::new(&Model::Quadric(QUADRIC), &[Pose::at(UP)]).sized(2.0)),
    Shape::Metaballs(Metaballs::new(&[Blob { center: UP, radius: 1.0, strength: -0.5 }])),
    Shape::Sphere(SPHERE),
    Shape::Plane(PLANE),
    Shape::Disc(Disc::ring(Vec3::ZERO, UP, 0.5, 1.0)),
    Shape::Rectangle(Rectangle::new(Vec3::ZERO, UP, Vec3::new(1.0, 0.0, 0.0))),
    Shape::Triangle(Triangle::flat(Vec3::ZERO, UP, Vec3::new(1.0, 0.0, 0.0))),
    Shape::Triangle(Triangle { vertices: [UP; 3], normals: Some([UP; 3]) }),
    Shape::Polygon(Polygon::new(&[Vec3::ZERO, UP, Vec3::new(1.0, 0.0, 0.0), Vec3::new(1.0, -1.0, 0.0)])),
    Shape::Cylinder(CYLINDER),
    Shape::Cone(CONE),
    Shape::Ellipsoid(Ellipsoid::new(UP, Vec3::new(1.0, 2.0, 3.0))),
    Shape::Quadric(QUADRIC),
    Shape::Torus(TORUS),
    Shape::Cuboid(CUBOID),
    Shape::ConvexPolyhedron(ConvexPolyhedron::new(&[PLANE, PLANE])),
    Shape::Mesh(MESH),
    Shape::Csg(Csg::new(&[
        CsgStep::Solid(Solid::Sphere(SPHERE)),
        CsgStep::Solid(Solid::ConvexPolyhedron(ConvexPolyhedron::new(&[PLANE]))),
        CsgStep::Difference,
        CsgStep::Solid(Solid::Torus(TORUS)),
        CsgStep::Union,
    ])),
];

const PALETTE: &[[u8; 3]] = &[[0, 1, 2], [253, 254, 255]];
const FIGURES: [Figure<'static>; 10] = [
    Figure::Squares(Squares { even: GRAY, odd: LinearRgb::WHITE }),
    Figure::Stripes(Stripes { first: GRAY, second: LinearRgb::WHITE, width: 0.5 }),
    Figure::Gradient(Gradient { from: GRAY, to: LinearRgb::WHITE, ends: Ends::Mirror }),
    Figure::Noise(Noise { low: GRAY, high: LinearRgb::WHITE, octaves: 3 }),
    Figure::Marble(Marble { stone: GRAY, vein: LinearRgb::WHITE, turbulence: 2.0, octaves: 4 }),
    Figure::Wood(Wood { early: GRAY, late: LinearRgb::WHITE, turbulence: 0.1, octaves: 2 }),
    Figure::Brick(Brick { brick: GRAY, mortar: LinearRgb::WHITE, gap: [0.1, 0.2] }),
    image(Pixels::Rgb565(&[0, 65_535])),
    image(Pixels::Rgb888(&[0, 1, 34, 92, 254, 255])),
    image(Pixels::Palette8 { indices: &[0, 1], palette: PALETTE }),
];

const fn image(pixels: Pixels<'static>) -> Figure<'static> {
    Figure::Image(Image {
        width: 2,
        height: 1,
        pixels,
        encoding: Encoding::Linear,
        filter: Filter::Bilinear,
        ends: Ends::RepeatExtend,
    })
}

/// A scene with every kind of shape, figure, material property and light.
fn everything(arena: &Bump) -> Scene<'_> {
    let placement =
        Placement { space: Space::Scene, size: UP, rotation: Vec3::ZERO, origin: Vec3::new(1.0, 2.0, 3.0) };
    let textures = FIGURES.map(|figure| Texture::Placed(arena.alloc(Placed { figure, placement })));
    let packed = image(Pixels::Palette4 { indices: &[16], palette: PALETTE });
    let more = [
        Texture::Solid(GRAY),
        Texture::Checker(Checker { even: GRAY, odd: GRAY, cells_per_unit: UP }),
        Texture::Placed(arena.alloc(Placed { figure: packed, placement })),
    ];
    let onto = [
        Onto::Ambient,
        Onto::Diffuse,
        Onto::Specular,
        Onto::Reflectance,
        Onto::Transmittance,
        Onto::Bump { height: 0.1, step: 0.2 },
    ];
    let maps = onto.map(|onto| Map { onto, texture: Texture::Solid(GRAY) });
    let optics = Optics {
        highlight: Highlight::BlinnPhong,
        fresnel: Fresnel::Exact,
        reflection_color: GRAY,
        transmission_color: GRAY,
        absorption: GRAY,
        emission: GRAY,
        emission_sides: Sides::Front,
        reflection_falloff: Falloff { constant: 1.0, linear: 0.5, quadratic: 0.25 },
        outside: Medium { ior: 1.25, absorption: GRAY },
        gloss: Some(30.0),
        translucency: Some(0.5),
        sides: Sides::Front,
        thin: false,
    };
    let materials = textures.into_iter().chain(more).map(|color| Material {
        color,
        ambient: 0.1,
        diffuse: 0.2,
        specular: 0.3,
        shininess: 4.0,
        reflectance: 0.5,
        transmittance: 0.25,
        ior: 1.25,
        optics: Some(arena.alloc(optics)),
        maps: arena.alloc_slice_copy(&maps),
    });
    let materials: Vec<_> = materials.chain([Material::matte(GRAY)]).collect();
    let lamp =
        |cone| Light::Lamp(Lamp { position: UP, color: GRAY, falloff: Falloff::inverse_square(3.0), cone });
    let lights = [
        Light::Point { position: UP, color: GRAY },
        Light::Directional { direction: UP, color: GRAY },
        lamp(None),
        lamp(Some(LightCone { direction: UP, bright: 0.1, dark: 0.2 })),
        Light::Ambient { color: GRAY },
        Light::Object(ObjectId(2)),
        Light::Sky,
    ];
    let lens = Some(Lens { radius: 0.1, focus: 4.0, blades: 6 });
    let camera = Camera { eye: Vec3::ZERO, target: UP, up: UP, vertical_fov: 0.7, lens };
    Scene {
        camera,
        background: Background::Gradient(
            arena.alloc(Sky { up: Vec3::new(0.5, 1.0, 0.0), ..Sky::new(GRAY, LinearRgb::WHITE) }),
        ),
        objects: arena.alloc_slice_fill_iter(SHAPES.map(|shape| Object::new(shape, 7))),
        materials: arena.alloc_slice_copy(&materials),
        lights: arena.alloc_slice_copy(&lights),
        motions: arena.alloc_slice_copy(&[
            Motion::of_object(1, UP),
            Motion::of_camera(UP).spinning(Vec3::ZERO, UP, 0.5),
        ]),
    }
}

fn parsed<'a>(arena: &'a Bump, text: &str) -> Result<Import<'a>, (Position, RonFault)> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.ron");
    fs::write(&path, text).unwrap();
    read(arena, &path).map_err(|error| (error.position.unwrap(), *error.fault))
}

#[test]
fn written_scenes_are_read_back() {
    let arena = Bump::new();
    let builtins = builtin::ALL.map(|builtin| *builtin.scene);
    let Figure::Image(image) = FIGURES[9] else { panic!() };
    let panorama = Panorama { image, rotation: UP };
    let around = Scene { background: Background::Image(&panorama), ..*builtin::ALL[0].scene };
    for scene in builtins.into_iter().chain([everything(&arena), around]) {
        let text = write(&scene, &FILE_SETTINGS, &FILE_SETTINGS).unwrap();
        match parsed(&arena, &text) {
            Ok(import) => assert_eq!(import.scene, scene),
            Err((position, fault)) => panic!("{position:?} {fault}\n{text}"),
        }
    }
}

#[test]
fn settings_are_read_and_written_back() {
    let arena = Bump::new();
    let end = SMALL.rfind("\n)").unwrap();
    let with = |settings: &str| format!("{}\n    settings: {settings},{}", &SMALL[..end], &SMALL[end..]);
    let text = with(
        "(size: (64, 48), bounces: 3, sampling: (samples: 16, sampler: Sobol, adaptive: ()), \
         dither: Stippling)",
    );
    let import = parsed(&arena, &text).unwrap();
    let sampling = Sampling { sampler: Sampler::Sobol, adaptive: Some(Adaptive::NEW), ..Sampling::new(16) };
    let dither = Dither::Stippling;
    let meant = Settings { width: 64, height: 48, bounces: 3, sampling, dither, ..FILE_SETTINGS };
    assert_eq!(import.settings.over(FILE_SETTINGS), meant);
    assert_eq!(parsed(&arena, SMALL).unwrap().settings, FileSettings::default());

    let again = parsed(&arena, &write(&import.scene, &meant, &FILE_SETTINGS).unwrap()).unwrap();
    assert_eq!(again.scene, import.scene);
    // The size is that of the picture at hand, not of the scene.
    assert_eq!(again.settings, FileSettings { size: None, ..import.settings });

    for (settings, said) in [
        ("(sampels: 4)", "there is no field of FileSettings `sampels`"),
        ("(sampling: (samples: -1))", "out of bounds"),
        ("(sampling: (sampler: Halton))", "there is no variant of Sampler `Halton`"),
    ] {
        let (position, fault) = parsed(&arena, &with(settings)).unwrap_err();
        assert!(position.line == 16 && fault.to_string().contains(said), "{position:?} {fault}");
    }
}

#[test]
fn bytes_are_read_as_they_were_written() {
    let arena = Bump::new();
    let scene = everything(&arena);
    let mut room = [0; 8192];
    let bytes = scene.to_bytes(&mut room).unwrap();
    let mut memory = vec![MaybeUninit::uninit(); 16_384];
    assert_eq!(Scene::from_bytes(bytes, &mut memory), Ok(scene));
    // Shortened bytes are refused, and changed bytes never cause a panic.
    for end in 0..bytes.len() {
        assert!(Scene::<Shape<'_>>::from_bytes(&bytes[..end], &mut memory).is_err(), "{end}");
    }
    for changed in 0..bytes.len() {
        for bit in 0..8 {
            let mut strange = bytes.to_vec();
            strange[changed] ^= 1 << bit;
            let _ = Scene::<Shape<'_>>::from_bytes(&strange, &mut memory);
        }
    }
}

const SMALL: &str = r#"
// Two things on a floor.
Scene(
    camera: (eye: (0, 2, 6), target: (0, 1, 0), up: (0, 1, 0), vertical_fov: 0.7),
    objects: {
        "the floor": (shape: Plane(point: (0, 0, 0), normal: (0, 1, 0)), material: "floor"),
        "a ball": (shape: Sphere(center: (0, 1, 0), radius: 1), material: "ball"),
        "its moon": (shape: Sphere(center: (2, 1, 0), radius: 0.5), material: 0),
    },
    materials: {
        "floor": (color: Checker(even: (0.9, 0.9, 0.9), odd: (0.1, 0.1, 0.1), cells_per_unit: (1, 0, 1))),
        "ball": "gold",
        "glass": (reflectance: 0.1, transmittance: 0.9, optics: (fresnel: Exact)),
    },
    lights: [Lamp(position: (4, 6, 5), color: (1, 1, 1))],
)
"#;

#[test]
fn fields_may_be_left_out_and_items_named() {
    let arena = Bump::new();
    let import = parsed(&arena, SMALL).unwrap();
    let scene = import.scene;
    assert_eq!(scene.background, Background::BLACK);
    assert_eq!(scene.objects.iter().map(|object| object.material.0).collect::<Vec<_>>(), [0, 1, 0]);
    assert_eq!(scene.materials[1], rayline::materials::GOLD);
    let glass = scene.materials[2];
    assert_eq!(glass.optics, Some(&Optics { fresnel: Fresnel::Exact, ..Optics::PLAIN }));
    assert_eq!(
        Material { optics: None, ..glass },
        Material { reflectance: 0.1, transmittance: 0.9, ..Material::matte(LinearRgb::WHITE) }
    );
    let Light::Lamp(lamp) = scene.lights[0] else { panic!() };
    assert_eq!((lamp.falloff, lamp.cone), (Falloff::NONE, None));

    let line = |part| import.position_of(part).map(|position| position.line);
    assert_eq!(line(Part::Camera), Some(4));
    assert_eq!(line(Part::Object(0)), Some(6));
    assert_eq!(line(Part::Object(2)), Some(8));
    assert_eq!(line(Part::Material(1)), Some(12));
    assert_eq!(line(Part::Light(0)), Some(15));
    assert_eq!(line(Part::Background), None);
    assert_eq!(line(Part::Object(3)), None);

    let list = "Scene(camera: (eye: (0, 0, 9), target: (0, 0, 0), up: (0, 1, 0), vertical_fov: 1), \
                materials: [(ior: 1)], objects: [
        (shape: Sphere(center: (0, 0, 0), radius: 1), material: 0),
        (shape: Sphere(center: (0, 0, 0), radius: 1), material: 0),
    ])";
    let import = parsed(&arena, list).unwrap();
    let place =
        |index| import.position_of(Part::Object(index)).map(|position| (position.line, position.column));
    assert_eq!([place(0), place(1)], [Some((2, 9)), Some((3, 9))]);
}

/// Replaces a part of [`SMALL`], and returns the line, column and text of the error.
fn refusal(from: &str, to: &str) -> (usize, usize, String) {
    assert!(SMALL.contains(from), "{from}");
    let (position, fault) = parsed(&Bump::new(), &SMALL.replace(from, to)).unwrap_err();
    (position.line, position.column, fault.to_string())
}

/// An earlier version reported the fault of a solid as one of the whole object.
#[test]
fn a_refused_solid_is_reported_by_its_number() {
    let told = |shape: &str| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cut.ron");
        let from = "(shape: Sphere(center: (2, 1, 0), radius: 0.5)";
        assert!(SMALL.contains(from));
        std::fs::write(&path, SMALL.replace(from, &format!("(shape: {shape}"))).unwrap();
        let arena = Bump::new();
        let loaded = LoadedScene::open(&path, &arena).unwrap();
        let error = check(&loaded.scene).unwrap_err();
        loaded.explain(&error).replace(&format!("{}/", folder.path().display()), "")
    };
    let csg = "Csg(steps: [
        Solid(Sphere(center: (0, 0, 0), radius: 1)), Solid(Sphere(center: (0, 1, 0), radius: 0)), Difference,
    ])";
    assert!(told(csg).starts_with("cut.ron:"), "{}", told(csg));
    assert_eq!(told(csg).split(": ").nth(1), Some("solid 1"));
    let model = "Instances(model: Polygon(vertices: [(0, 0, 0), (1, 0, 0)]), poses: [(origin: (0, 0, 0))])";
    assert_eq!(told(model).split(": ").nth(1), Some("model"));
}

#[test]
fn errors_are_reported_at_their_positions() {
    let found = [
        refusal("Sphere(center: (2", "Sphre(center: (2"),
        refusal("radius: 0.5", "raduis: 0.5"),
        refusal("material: \"ball\"", "material: \"bal\""),
        refusal("\"gold\"", "\"glod\""),
        refusal("material: \"ball\"", "material: \"xyz\""),
        refusal("\"glass\":", "\"floor\":"),
        refusal(", radius: 0.5", ""),
    ];
    let expected = [
        (8, 29, "there is no variant of Shape `Sphre`; did you mean `Sphere`?"),
        (8, 55, "there is no field of Sphere `raduis`; did you mean `radius`?"),
        (7, 76, "there is no material in this file `bal`; did you mean `ball`?"),
        (12, 18, "there is no preset for a material `glod`; did you mean `gold`?"),
        (7, 76, "there is no material in this file `xyz`; the known ones are `floor`, `ball`, `glass`"),
        (13, 18, "two materials have the name `floor`; rename one"),
        (8, 53, "the field `radius` of Sphere is missing; add it"),
    ];
    assert_eq!(found, expected.map(|(line, column, reason)| (line, column, reason.to_owned())));
    let (line, _, reason) = refusal("(4, 6, 5)", "(4, 6)");
    assert!(line == 15 && reason.contains('3'), "{line} {reason}");
    let (line, _, reason) = refusal("radius: 1)", "radius: x)");
    assert!(line == 7 && reason.contains("float"), "{line} {reason}");
    let (line, _, reason) = refusal("\"gold\",", "\"gold\"");
    assert!(line >= 12 && reason.contains("omma"), "{line} {reason}");
    let (_, _, reason) =
        refusal("    camera: (eye: (0, 2, 6), target: (0, 1, 0), up: (0, 1, 0), vertical_fov: 0.7),\n", "");
    assert!(reason.contains("camera"), "{reason}");
}

/// An earlier version reported unknown fields of a material as fields of the scene.
#[test]
fn unknown_fields_are_reported_with_their_own_struct() {
    let glass = "(reflectance: 0.1, transmittance: 0.9, optics: (fresnel: Exact))";
    let found = |text: &str| refusal(glass, text).2;
    assert_eq!(
        found("(reflectence: 0.1)"),
        "there is no field of Material `reflectence`; did you mean `reflectance`?"
    );
    assert_eq!(
        found("(optics: (fresnal: Exact))"),
        "there is no field of Optics `fresnal`; did you mean `fresnel`?"
    );
    assert_eq!(found("(ior: 1, ior: 2)"), "the field `ior` is given twice; remove one");
    let image = "(color: Placed(figure: Image(width: 1, hight: 1, pixels: Rgb888([0, 0, 0]))))";
    assert_eq!(found(image), "there is no field of Image `hight`; did you mean `height`?");
    let around = "    lights: [";
    let background =
        "    background: Image(image: (width: 1, hight: 1, pixels: Rgb888([0, 0, 0]))), lights: [";
    let (line, _, reason) = refusal(around, background);
    assert_eq!((line, &*reason), (15, "there is no field of Image `hight`; did you mean `height`?"));
    let (line, _, reason) = refusal("    lights: [", "    light: [");
    assert_eq!((line, &*reason), (15, "there is no field of Scene `light`; did you mean `lights`?"));
}

/// Presets may replace descriptions of materials, but objects refer to materials of the file.
#[test]
fn a_preset_must_be_in_the_list_of_materials_before_objects_use_it() {
    let told = refusal("material: \"ball\"", "material: \"silver\"");
    let hint = "there is no material in this file `silver`; it is a preset: add it to `materials`, as in \
                `\"silver\": \"silver\"`";
    assert_eq!(told, (7, 76, hint.to_owned()));
    // The change that the message suggests makes the scene valid.
    let text = SMALL.replace("material: \"ball\"", "material: \"silver\"");
    let text = text.replace("    materials: {", "    materials: {\n\"silver\": \"silver\",");
    assert!(parsed(&Bump::new(), &text).is_ok());
    let nothing =
        "(camera: (eye: (0, 0, 9), target: (0, 0, 0), up: (0, 1, 0), vertical_fov: 1), objects: [])";
    let (_, fault) = parsed(&Bump::new(), nothing).unwrap_err();
    assert_eq!(fault.to_string(), "the field `materials` of Scene is missing; add it");
}

#[test]
fn other_texts_are_refused() {
    for text in [
        "",
        "()",
        "Scene",
        "[",
        "Scene(objects: 3)",
        "(camera: \"x\", materials: [], objects: [])",
        "\u{feff}",
    ] {
        assert!(parsed(&Bump::new(), text).is_err(), "{text:?}");
    }
    let mut text = String::from("(camera: ");
    text.push_str(&"[".repeat(100_000));
    assert!(parsed(&Bump::new(), &text).is_err());
}

#[test]
fn texts_that_are_nested_too_deeply_are_refused_in_plain_words() {
    for open in ["(a: ", "["] {
        let text = format!("Scene(camera: {}", open.repeat(200));
        let (_, fault) = parsed(&Bump::new(), &text).unwrap_err();
        assert_eq!(
            fault.to_string(),
            "parentheses, brackets and braces are nested more than 128 deep; remove some, a scene needs \
             about a dozen"
        );
    }
}

/// Writes a scene with its pictures into a folder, and reads it back.
fn beside<'a>(arena: &'a Bump, scene: &Scene<'a>, folder: &Path) -> (String, Scene<'a>) {
    let path = folder.join("scene.ron");
    let mut pictures = Pictures::beside(&path);
    let text = write_beside(scene, &FILE_SETTINGS, &FILE_SETTINGS, &mut pictures, arena).unwrap();
    for (path, bytes) in pictures.files() {
        fs::write(path, bytes).unwrap();
    }
    fs::write(&path, &text).unwrap();
    let import = read(arena, &path).unwrap_or_else(|error| panic!("{error}\n{text}"));
    (text, import.scene)
}

#[test]
fn pictures_are_files_with_the_same_pixels() {
    let (arena, folder) = (Bump::new(), tempfile::tempdir().unwrap());
    let Figure::Image(striped) = FIGURES[9] else { panic!() };
    let panorama =
        Panorama { image: Image { encoding: Encoding::Srgb, ends: Ends::Repeat, ..striped }, rotation: UP };
    let scene = Scene { background: Background::Image(&panorama), ..everything(&arena) };
    let (text, again) = beside(&arena, &scene, folder.path());
    // The picture of the panorama is also that of a material.
    assert!(text.contains("image: \"scene-1.png\""), "{text}");
    for (number, count) in [(1, 2), (2, 1), (3, 1), (4, 1), (5, 0)] {
        assert_eq!(text.matches(&format!("\"scene-{number}.png\"")).count(), count, "{number}: {text}");
    }
    assert!(text.contains("file: \"scene-2.png\"") && !text.contains("pixels"), "{text}");
    // Pixels of 16 bits become 24 bits, and all others stay.
    let mut materials = scene.materials.to_vec();
    let wide = Placed::new(image(Pixels::Rgb888(&[0, 0, 0, 255, 255, 255])), placement_of(&materials[7]));
    materials[7].color = Texture::Placed(&wide);
    assert_eq!(again, Scene { materials: &materials, ..scene });
}

/// The placement of a material's texture.
fn placement_of(material: &Material<'_>) -> Placement {
    let Texture::Placed(placed) = material.color else { panic!() };
    placed.placement
}

#[test]
fn fields_beside_a_file_overrule_it() {
    let (arena, folder) = (Bump::new(), tempfile::tempdir().unwrap());
    let png = rayline_formats::raster::to_png((2, 1), 3, &[1, 2, 3, 4, 5, 6]).unwrap();
    fs::write(folder.path().join("a.png"), png).unwrap();
    let named = Image {
        width: 2,
        height: 1,
        pixels: Pixels::Rgb888(&[1, 2, 3, 4, 5, 6]),
        encoding: Encoding::Srgb,
        filter: Filter::Bilinear,
        ends: Ends::Repeat,
    };
    for (written, expected) in [
        ("\"a.png\"", named),
        ("file: \"a.png\"", named),
        ("ends: Mirror, file: \"a.png\"", Image { ends: Ends::Mirror, ..named }),
        (
            "file: \"a.png\", filter: Nearest, encoding: Linear",
            Image { filter: Filter::Nearest, encoding: Encoding::Linear, ..named },
        ),
    ] {
        let path = folder.path().join("scene.ron");
        let material = format!("(color: Placed(figure: Image({written})))");
        fs::write(&path, SMALL.replace("\"gold\"", &material)).unwrap();
        let import = read(&arena, &path).unwrap_or_else(|error| panic!("{error}"));
        let Texture::Placed(placed) = import.scene.materials[1].color else { panic!() };
        assert_eq!(placed.figure, Figure::Image(expected), "{written}");
    }
}
