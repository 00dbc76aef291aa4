//! Tests of every statement and of every error message.

use rayline::{Background, Fault, PreparedScene, SceneError};

use super::*;

const VIEW: &str = "v from 0 0 5 at 0 0 0 up 0 1 0 angle 90 hither 1 resolution 40 30\n";
const GRAY: &str = "f .5 .5 .5 1 0 0 0 0\n";

fn parse_ok<'a>(arena: &'a Bump, text: &str) -> Import<'a> {
    parse(arena, text).unwrap_or_else(|error| panic!("{error}"))
}

fn error_of(text: &str) -> NffError {
    parse(&Bump::new(), text).unwrap_err()
}

/// The fault for which the core refuses the scene, and the line of the refused part.
fn refused(text: &str) -> (Fault, Option<usize>) {
    let arena = Bump::new();
    let import = parse_ok(&arena, text);
    let mut memory = vec![core::mem::MaybeUninit::uninit(); import.scene.bytes::<f32>()];
    let SceneError { part, fault } = PreparedScene::<f32, _>::new(&import.scene, &mut memory).unwrap_err();
    (fault, import.line_of(part))
}

#[test]
fn view_and_background() {
    let arena = Bump::new();
    let import = parse_ok(&arena, &format!("# a comment\n{VIEW}b .1 .2 .3 # v"));
    assert_eq!(import.resolution, (40, 30));
    let Scene { camera, background, objects: [], materials: [], lights: [], .. } = import.scene else {
        panic!()
    };
    assert_eq!(camera.eye, Vec3::new(0.0, 0.0, 5.0));
    assert_eq!(camera.target, Vec3::new(0.0, 0.0, 0.0));
    assert_eq!(camera.up, Vec3::new(0.0, 1.0, 0.0));
    assert_eq!(camera.vertical_fov, core::f32::consts::FRAC_PI_2);
    assert_eq!(background, Background::Solid(LinearRgb::new(0.1, 0.2, 0.3)));
}

#[test]
fn lines_may_be_broken_anywhere() {
    let arena = Bump::new();
    let whole = parse_ok(&arena, &format!("{VIEW}{GRAY}s 1 2 3 4"));
    let broken = parse_ok(&arena, &format!("{VIEW}{GRAY}s 1 2 3 4").replace(' ', "\r\n\t# x y\n"));
    assert_eq!(whole.scene, broken.scene);
}

#[test]
fn lights_without_color_share_the_intensity() {
    let arena = Bump::new();
    let import = parse_ok(&arena, &format!("l 1 2 3\n{VIEW}l 4 5 6 .7 .8 .9 l -1 0 0\nl 0 0 9"));
    let light = |x, y, z, color| Light::Point { position: Vec3::new(x, y, z), color };
    let half = LinearRgb::gray(0.5);
    assert_eq!(
        import.scene.lights,
        [
            light(1.0, 2.0, 3.0, half),
            light(4.0, 5.0, 6.0, LinearRgb::new(0.7, 0.8, 0.9)),
            light(-1.0, 0.0, 0.0, half),
            light(0.0, 0.0, 9.0, half)
        ]
    );
}

#[test]
fn materials_apply_to_the_objects_that_follow() {
    let arena = Bump::new();
    let text = format!("{VIEW}f .1 .2 .3 .4 .5 60 .3 1.5 s 0 0 0 1 s 1 0 0 1 f 1 1 1 1 0 9 0 0 s 2 0 0 1");
    let import = parse_ok(&arena, &text);
    let ids: Vec<u16> = import.scene.objects.iter().map(|object| object.material.0).collect();
    assert_eq!(ids, [0, 0, 1]);
    let glass = Material {
        color: Texture::Solid(LinearRgb::new(0.1, 0.2, 0.3)),
        ambient: 0.0,
        diffuse: 0.4,
        specular: 0.5,
        shininess: 60.0,
        reflectance: 0.5,
        transmittance: 0.3,
        ior: 1.5,
        optics: None,
        maps: &[],
    };
    let matte = Material { shininess: 9.0, ..Material::matte(LinearRgb::WHITE) };
    assert_eq!(import.scene.materials, [glass, matte]);
}

#[test]
fn every_kind_of_object() {
    let arena = Bump::new();
    let text = format!(
        "{VIEW}{GRAY}s 1 2 3 4\nc 0 0 0 1 0 0 2 1\nc 0 0 0 1 0 0 2 .5\np 3 0 0 0 1 0 0 0 1 0\n\
         p 4 0 0 0 1 0 0 1 1 0 0 1 0\n"
    );
    let import = parse_ok(&arena, &text);
    let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    let (base, top) = (a, Vec3::new(0.0, 0.0, 2.0));
    let shapes: Vec<_> = import.scene.objects.iter().map(|object| object.shape).collect();
    assert_eq!(
        shapes,
        [
            Shape::Sphere(Sphere::new(Vec3::new(1.0, 2.0, 3.0), 4.0)),
            Shape::Cylinder(Cylinder { base, top, radius: 1.0, capped: false }),
            Shape::Cone(Cone { base, base_radius: 1.0, top, top_radius: 0.5, capped: false }),
            Shape::Triangle(Triangle::flat(a, b, d)),
            Shape::Polygon(Polygon::new(&[a, b, c, d])),
        ]
    );
}

#[test]
fn a_patch_is_a_fan_without_its_flat_triangles() {
    let arena = Bump::new();
    // The third vertex repeats the second, and the last lies on the line from the first to the fifth.
    let text = format!(
        "{VIEW}{GRAY}pp 6 0 0 0 0 0 1  1 0 0 0 1 1  1 0 0 0 1 1  1 1 0 1 0 1  0 2 0 0 0 2  0 1 0 0 0 3"
    );
    let import = parse_ok(&arena, &text);
    let triangle = |[a, b, c]: [[f32; 3]; 3], [na, nb, nc]: [[f32; 3]; 3]| {
        let vector = |[x, y, z]: [f32; 3]| Vec3::new(x, y, z);
        Shape::Triangle(Triangle { vertices: [a, b, c].map(vector), normals: Some([na, nb, nc].map(vector)) })
    };
    let shapes: Vec<_> = import.scene.objects.iter().map(|object| object.shape).collect();
    let (a, b, c, d) = ([0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 2.0, 0.0]);
    let (up, tilted, right) = ([0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]);
    assert_eq!(
        shapes,
        [triangle([a, b, c], [up, tilted, right]), triangle([a, c, d], [up, right, [0.0, 0.0, 2.0]])]
    );
}

#[test]
fn parts_that_the_core_refuses_are_found_in_the_file() {
    let bad = |statement: &str| refused(&format!("# first\n{VIEW}{GRAY}\ns 0 0 0 1\n{statement}"));
    assert_eq!(bad("s 0 0 0 -1"), (Fault::RadiusNotPositive, Some(6)));
    assert_eq!(bad("f 1 1 1 1 0 0 .5 0"), (Fault::IorNotPositive, Some(6)));
    assert_eq!(bad("l 0 0 0 -1 0 0"), (Fault::NegativeColor { given: -1.0 }, Some(6)));
    assert_eq!(bad("b 0 0 -1"), (Fault::NegativeColor { given: -1.0 }, Some(6)));
    assert_eq!(bad("p 3 0 0 0 1 1 1 2 2 2"), (Fault::Collinear, Some(6)));
    assert_eq!(bad("pp 3 0 0 0 0 0 0 1 0 0 0 0 1 0 1 0 0 0 1"), (Fault::ZeroLength, Some(6)));
    assert_eq!(refused(&format!("\n{}", VIEW.replace("90", "180"))), (Fault::FieldOfView, Some(2)));
    assert_eq!(
        refused(&format!("\n{}", VIEW.replace("at 0 0 0", "at 0 0 5"))),
        (Fault::EyeAtTarget, Some(2))
    );
}

#[test]
fn broken_statements_are_reported_with_line_and_expectation() {
    let message = |statement: &str| error_of(&format!("{VIEW}{GRAY}\n{statement}")).to_string();
    for (statement, expected) in [
        ("s 1 2 3", "line 4: the file ends where the radius of the sphere must follow"),
        ("s 1 2\nx 4", "line 5: expected the center of the sphere, found `x`"),
        ("s 1 2 3 1e99", "line 4: the radius of the sphere is not a finite number: `1e99`"),
        ("s 1 2 NaN 1", "line 4: the center of the sphere is not a finite number: `NaN`"),
        ("l 0 0 0 inf 1 1", "line 4: the color of the light is not a finite number: `inf`"),
        ("l 0 0 0 1 1", "line 4: the file ends where the color of the light must follow"),
        ("p 2 0 0 0 1 1 1", "line 4: expected the number of vertices, 3 or more, found `2`"),
        ("p -3 0 0 0", "line 4: expected the number of vertices, 3 or more, found `-3`"),
        ("pp 3.0 0 0 0", "line 4: expected the number of vertices, 3 or more, found `3.0`"),
        ("p 4000000000 0 0 0", "line 4: the file ends where a vertex of the polygon must follow"),
        ("p 99999999999 0 0 0", "line 4: expected the number of vertices, 3 or more, found `99999999999`"),
        ("sphere 0 0 0 1", "line 4: unknown keyword `sphere`; the keywords are v, b, l, f, s, c, p and pp"),
        ("\u{1b}[2J", "line 4: unknown keyword `\\u{1b}[2J`; the keywords are v, b, l, f, s, c, p and pp"),
        (VIEW, "line 4: there is a second `v`; keep one"),
        ("b 0 0 0\nb 0 0 0", "line 5: there is a second `b`; keep one"),
    ] {
        assert_eq!(message(statement), expected);
    }
    let long = "x".repeat(1000);
    assert_eq!(message(&long).len(), message(&"x".repeat(33)).len());
}

#[test]
fn broken_files() {
    assert_eq!(error_of(""), NffError { line: 1, fault: NffFault::NoView });
    assert_eq!(error_of("b 0 0 0\n#\n"), NffError { line: 2, fault: NffFault::NoView });
    assert_eq!(error_of("\ns 0 0 0 1"), NffError { line: 2, fault: NffFault::NoMaterial });
    for (good, bad, expected) in [
        ("from", "form", "line 1: expected `from`, found `form`"),
        ("40 30", "0 30", "line 1: expected the width in pixels, 1 to 65535, found `0`"),
        ("40 30", "40 65536", "line 1: expected the height in pixels, 1 to 65535, found `65536`"),
        ("hither 1", "hither", "line 1: expected the distance of the hither plane, found `resolution`"),
    ] {
        assert_eq!(error_of(&VIEW.replace(good, bad)).to_string(), expected);
    }
    let error = parse_bytes(&Bump::new(), b"# one\n# two\n# \xff\n").unwrap_err();
    assert_eq!(error, NffError { line: 3, fault: NffFault::NotUtf8 });
}

#[test]
fn more_materials_than_can_be_numbered() {
    let text = format!("{VIEW}{}", GRAY.repeat(65_536));
    assert_eq!(
        error_of(&text),
        NffError { line: 65_537, fault: NffFault::TooManyMaterials { most: 65_535 } }
    );
}

proptest::proptest! {
    #[test]
    fn any_text_gives_a_scene_or_an_error(
        words in proptest::collection::vec(
            "[vblfscp#\n]|pp|from|at|up|angle|hither|resolution|[0-9.e-]{1,4}|\\PC*",
            0..40,
        ),
        cut in 0usize..400,
    ) {
        let text = format!("{VIEW}{GRAY}{}", words.join(" "));
        let text: String = text.chars().skip(cut / 4 * usize::from(cut % 4 == 0)).collect();
        if let Err(error) = parse(&Bump::new(), &text) {
            assert!(error.line >= 1 && error.line <= text.lines().count().max(1));
            assert_eq!(error.to_string().lines().count(), 1);
        }
    }
}
