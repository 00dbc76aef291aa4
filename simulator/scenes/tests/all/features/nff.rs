//! A file for each row about NFF.

use rayline::shape::Shape;
use rayline::{Background, Light, LinearRgb, Transfer};
use rayline_scenes::LoadedScene;

use super::table::{compare, material, near, open};

const VIEW: &str = "v from 0 0 9 at 0 0 0 up 0 1 0 angle 40 hither 1 resolution 40 30\nl 3 4 5\n";
const GRAY: &str = "f .5 .5 .5 1 0 0 0 0\n";
const BALL: &str = "s 0 0 0 1\n";

fn triangles(scene: &LoadedScene<'_>, count: usize) -> bool {
    let objects = scene.scene.objects;
    objects.len() == count && objects.iter().all(|object| matches!(object.shape, Shape::Triangle(_)))
}

#[test]
fn nff() {
    type Case<'c> = (&'c str, String, fn(&LoadedScene<'_>) -> bool);
    let lit = |more: &str| format!("{VIEW}{GRAY}{more}");
    let balls = |count| BALL.repeat(count);
    let cases: Vec<Case<'_>> = vec![
        ("`v`", lit(BALL), |scene| (scene.settings.width, scene.settings.height) == (40, 30)),
        ("`b`", lit(&format!("b 0.1 0.2 0.3\n{BALL}")), |scene| {
            scene.scene.background == Background::Solid(LinearRgb::new(0.1, 0.2, 0.3))
        }),
        ("`l`", lit(BALL), |scene| matches!(scene.scene.lights, [Light::Point { .. }])),
        ("`f`", format!("{VIEW}f 1 0 0 0.6 0.2 9 0.3 1.5\n{BALL}"), |scene| {
            let material = material(scene);
            near(material.diffuse, 0.6) && near(material.transmittance, 0.3) && material.ior == 1.5
        }),
        ("colors", lit(BALL), |scene| scene.settings.transfer == Transfer::Linear),
        ("`s`", lit(BALL), |scene| matches!(scene.scene.objects[0].shape, Shape::Sphere(_))),
        ("`c`", lit("c 0 0 0 1 0 0 2 1\nc 0 0 0 1 0 0 2 .5\n"), |scene| {
            let [a, b] = scene.scene.objects else { return false };
            matches!((a.shape, b.shape), (Shape::Cylinder(_), Shape::Cone(_)))
        }),
        ("`p`", lit("p 3 0 0 0 1 0 0 0 1 0\n"), |scene| triangles(scene, 1)),
        ("`pp`", lit("pp 4 0 0 0 0 0 1 1 0 0 0 0 1 1 1 0 0 0 1 0 1 0 0 0 1\n"), |scene| triangles(scene, 2)),
        ("no `v`", format!("l 3 4 5\n{GRAY}{BALL}"), |scene| scene.settings.width == 640),
        ("no `l`", format!("v {}\n{GRAY}{BALL}", &VIEW[2..VIEW.len() - 8]), |scene| {
            scene.scene.lights.len() == 1
        }),
        ("no `f`", format!("{VIEW}{BALL}"), |scene| material(scene).color.eq(&LinearRgb::WHITE.into())),
        ("Ks + T above 1", format!("{VIEW}f 1 0 0 0 1 9 1 1.5\n{BALL}"), |scene| {
            near(material(scene).reflectance, 0.5) && near(material(scene).transmittance, 0.5)
        }),
        ("a negative radius", lit("s 0 0 0 -1\n"), |scene| scene.scene.objects.len() == 1),
        ("a polygon that is not flat", lit("p 4 0 0 0 1 0 0 1 1 1 0 1 0\n"), |scene| triangles(scene, 2)),
        ("shapes without size", lit(&format!("s 0 0 0 0\n{BALL}")), |scene| scene.scene.objects.len() == 1),
        ("words that are none of these", lit("torus 1 2\n"), |_| true),
        ("more than 65,535 objects", lit(&balls(65_536)), |_| true),
    ];
    let seen =
        cases.into_iter().map(|(feature, file, holds)| (feature, open(&[("a.nff", file.as_bytes())], holds)));
    compare("NFF", 10, seen.collect());
}
