//! Tests of every statement and of every error message.

use rayline::shape::{Cone, Cylinder, Polygon, Shape, Sphere, Triangle};
use rayline::{Background, Fault, Light, LinearRgb, Material, PreparedScene, SceneError, Texture, Vec3};

use super::*;
use crate::model::view;

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
    assert_eq!(import.notes, [""; 0]);
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
    assert_eq!(bad("s 0 0 0 2e9"), (Fault::TooFar, Some(6)));
    assert_eq!(bad("f 1 1 1 1 0 0 .5 0"), (Fault::IorNotPositive, Some(6)));
    assert_eq!(bad("l 0 0 0 -1 0 0"), (Fault::NegativeColor { given: -1.0 }, Some(6)));
    assert_eq!(bad("b 0 0 -1"), (Fault::NegativeColor { given: -1.0 }, Some(6)));
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
        ("p -3 0 0 0", "line 4: expected the number of vertices, found `-3`"),
        ("pp 3.0 0 0 0", "line 4: expected the number of vertices, found `3.0`"),
        ("p 4000000000 0 0 0", "line 4: the file ends where a vertex of the polygon must follow"),
        ("p 99999999999 0 0 0", "line 4: expected the number of vertices, found `99999999999`"),
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

/// A file is not read beyond the last object that a scene can have.
#[test]
fn more_objects_than_can_be_numbered() {
    let balls = "s 0 0 0 1\n".repeat(65_535);
    assert_eq!(parse_ok(&Bump::new(), &format!("{VIEW}{GRAY}{balls}")).scene.objects.len(), 65_535);
    let error = error_of(&format!("{VIEW}{GRAY}{balls}s 0 0 0 1\nnever read"));
    assert_eq!(error, NffError { line: 65_538, fault: NffFault::TooManyObjects { most: 65_535 } });
    assert_eq!(error.to_string(), "line 65538: the file has more than 65535 objects; use fewer");
}

/// The shapes of these statements and the notes about them.
fn made<'a>(arena: &'a Bump, statements: &str) -> (Vec<Shape<'a>>, Vec<String>) {
    let import = parse_ok(arena, &format!("{VIEW}{GRAY}l 0 0 9\n{statements}"));
    assert_eq!(crate::check(&import.scene), Ok(()));
    (import.scene.objects.iter().map(|object| object.shape).collect(), import.notes)
}

#[test]
fn shapes_without_area_are_left_out_with_a_note() {
    let arena = Bump::new();
    let ball = Shape::Sphere(Sphere::new(Vec3::new(0.0, 0.0, 1.0), 0.5));
    for (degenerate, note) in [
        ("p 3 0 0 0 1 0 0 2 0 0", "line 4: a polygon without area is left out"),
        ("p 3 0 0 0 1 0 0 1 0 0", "line 4: a polygon without area is left out"),
        ("p 4 0 0 0 1 0 0 2 0 0 3 0 0", "line 4: a polygon without area is left out"),
        ("p 4 1 1 1 1 1 1 1 1 1 1 1 1", "line 4: a polygon without area is left out"),
        ("pp 3 0 0 0 0 0 1 1 1 1 0 0 1 2 2 2 0 0 1", "line 4: a polygon without area is left out"),
        ("p 2 0 0 0 1 1 1", "line 4: a polygon with fewer than three corners is left out"),
        ("p 0", "line 4: a polygon with fewer than three corners is left out"),
        ("pp 2 0 0 0 0 0 1 1 1 1 0 0 1", "line 4: a polygon with fewer than three corners is left out"),
        ("s 0 0 0 0", "line 4: a sphere of radius 0 is left out"),
        ("s 0 0 0 -0", "line 4: a sphere of radius 0 is left out"),
        ("c 0 0 0 0 1 0 0 0", "line 4: a cone of radius 0 is left out"),
        ("c 1 2 3 4 1 2 3 5", "line 4: a cone without length is left out"),
        ("c 0 0 0 -1 1 0 0 1", "line 4: a cone whose radii have different signs is left out"),
    ] {
        let both = made(&arena, &format!("{degenerate}\ns 0 0 1 .5"));
        assert_eq!(both, (vec![ball], vec![note.to_owned()]), "{degenerate}");
    }
    let (shapes, notes) = made(&arena, "s 0 0 0 0\ns 0 0 1 .5\ns 9 9 9 0 s 1 1 1 0\ns 0 0 1 .5");
    assert_eq!(shapes, [ball, ball]);
    assert_eq!(notes, ["line 4, and 2 more: a sphere of radius 0 is left out"]);
}

#[test]
fn normals_without_length_are_those_of_the_plane() {
    let arena = Bump::new();
    let (up, down) = (Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.0, 0.0, -1.0));
    for (first, second, third, expected) in [
        ("0 0 0", "0 0 0", "0 0 0", [up, up, up]),
        ("0 0 0", "0 0 -1", "0 0 -1", [down, down, down]),
        ("0 0 2", "NaN 0 1", "0 inf 0", [up * 2.0, up, up]),
    ] {
        let text = format!("pp 3 0 0 0 {first} 1 0 0 {second} 0 1 0 {third}");
        let (shapes, notes) = made(&arena, &text);
        let [Shape::Triangle(triangle)] = *shapes else { panic!("{shapes:?}") };
        assert_eq!(triangle.normals, Some(expected), "{text}");
        assert_eq!(notes, ["line 4: a normal without length is replaced by that of the plane"]);
    }
}

#[test]
fn negative_radii_are_drawn_from_both_sides_with_a_note() {
    let arena = Bump::new();
    let (shapes, notes) = made(&arena, "s .7 0 0 -.8\nc -1 -.9 0 -.4 -1 .9 0 -.4\nc 0 0 0 0 0 1 0 -2");
    let v = Vec3::new;
    let (base, top) = (v(-1.0, -0.9, 0.0), v(-1.0, 0.9, 0.0));
    let [origin, up] = [v(0.0, 0.0, 0.0), v(0.0, 1.0, 0.0)];
    assert_eq!(
        shapes,
        [
            Shape::Sphere(Sphere::new(v(0.7, 0.0, 0.0), 0.8)),
            Shape::Cylinder(Cylinder { base, top, radius: 0.4, capped: false }),
            Shape::Cone(Cone { base: origin, base_radius: 0.0, top: up, top_radius: 2.0, capped: false }),
        ]
    );
    let note = "line 4, and 2 more: a negative radius asks for the inside alone; both sides are drawn";
    assert_eq!(notes, [note]);
}

#[test]
fn polygons_that_are_not_flat_become_triangles() {
    let arena = Bump::new();
    let (shapes, notes) = made(&arena, "p 4 -1 0 1 1 .3 1 1 0 -1 -1 .3 -1");
    let [a, b, c, d] = [(-1.0, 0.0, 1.0), (1.0, 0.3, 1.0), (1.0, 0.0, -1.0), (-1.0, 0.3, -1.0)]
        .map(|(x, y, z)| Vec3::new(x, y, z));
    assert_eq!(shapes, [[a, b, c], [a, c, d]].map(|[a, b, c]| Shape::Triangle(Triangle::flat(a, b, c))));
    assert_eq!(notes, ["line 4: a polygon that is not flat is drawn as triangles"]);
    // The notch of an arrowhead stays open: its corner is in both triangles.
    let (shapes, _) = made(&arena, "p 4 0 0 0 2 1 .2 0 2 0 .5 1 0");
    let notch = Vec3::new(0.5, 1.0, 0.0);
    let has_notch =
        |shape: &Shape<'_>| matches!(shape, Shape::Triangle(triangle) if triangle.vertices.contains(&notch));
    assert!(shapes.len() == 2 && shapes.iter().all(has_notch), "{shapes:?}");
    // A vertex that is off by less than rounding leaves the polygon whole.
    let (shapes, notes) = made(&arena, "p 4 -1 0 1 1 .001 1 1 0 -1 -1 0 -1");
    assert!(matches!(*shapes, [Shape::Polygon(_)]) && notes.is_empty(), "{shapes:?} {notes:?}");
}

#[test]
fn reflectance_and_transmittance_above_one_are_scaled() {
    let arena = Bump::new();
    let share = |material: &Material<'_>| [material.reflectance, material.transmittance, material.specular];
    let text =
        format!("{VIEW}l 0 0 9\nf 1 .5 0 .9 .9 10 .5 1.5\ns 0 0 0 1 f 1 1 1 0 3 9 0 0 f 1 1 1 1 .5 9 .5 2");
    let import = parse_ok(&arena, &text);
    let shares: Vec<_> = import.scene.materials.iter().map(share).collect();
    for (found, expected) in shares.iter().zip([[0.642_857, 0.357_143, 0.9], [1.0, 0.0, 1.0], [0.5; 3]]) {
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{found:?} {expected:?}");
    }
    assert_eq!(import.notes, ["line 3, and 1 more: Ks + T is above 1; both are scaled to a sum of 1"]);
    assert_eq!(crate::check(&import.scene), Ok(()));
    // A diffuse share above 1 goes into the color.
    let import = parse_ok(&arena, &format!("{VIEW}f .5 .25 1 2 0 0 0 1"));
    let [material] = import.scene.materials else { panic!() };
    assert_eq!((material.diffuse, material.color), (1.0, Texture::Solid(LinearRgb::new(1.0, 0.5, 2.0))));
}

#[test]
fn objects_before_a_material_are_white() {
    let arena = Bump::new();
    let import = parse_ok(&arena, &format!("{VIEW}l 0 0 9\ns 0 0 0 1\ns 1 0 0 1\n{GRAY}s 2 0 0 1"));
    let gray = Material::matte(LinearRgb::gray(0.5));
    assert_eq!(import.scene.materials, [Material::matte(LinearRgb::WHITE), gray]);
    let ids: Vec<u16> = import.scene.objects.iter().map(|object| object.material.0).collect();
    assert_eq!(ids, [0, 0, 1]);
    assert_eq!(import.notes, ["line 3: there is no material (`f`) before it; it is white and matte"]);
}

#[test]
fn files_without_light_or_view_get_one() {
    let arena = Bump::new();
    let import = parse_ok(&arena, &format!("{VIEW}{GRAY}s 0 0 0 1"));
    assert_eq!(import.notes, ["the file: it has no light (`l`); lit from beside the camera and by a sky"]);
    let [key, _] = view::lights(&import.scene.camera);
    assert_eq!(import.scene.lights, [key]);
    let import = parse_ok(&arena, &format!("{GRAY}l 0 0 9 s 0 0 0 1 c 4 0 0 1 6 0 0 1"));
    let expected = "the file: it has no view (`v`); the whole model is seen from the front, slightly from \
                    the right and above (y is up)";
    assert_eq!(import.notes, [expected]);
    assert_eq!((import.resolution, import.scene.camera.target), ((640, 480), Vec3::new(3.0, 0.0, 0.0)));
    assert_eq!(import.line_of(Part::Camera), None);
    assert_eq!(crate::check(&import.scene), Ok(()));
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
