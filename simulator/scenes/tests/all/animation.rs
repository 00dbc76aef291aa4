//! Tests of key frames.

use bumpalo::Bump;
use rayline::shape::Shape;
use rayline::{Light, LinearRgb, Object, Scene, Vec3};
use rayline_scenes::LoadedScene;
use rayline_scenes::animation::{Animation, AnimationError, Length};

const SCENE: &str = r#"Scene(
    camera: (eye: (0, 0, 6), target: (0, 0, 0), up: (0, 1, 0), vertical_fov: 0.7),
    materials: { "red": (diffuse: 0.5) },
    objects: {
        "ball": (shape: Sphere(center: (1, 0, 0), radius: 1), material: "red"),
        "tube": (shape: Cylinder(base: (0, 0, 0), top: (0, 2, 0), radius: 1, capped: true), material: "red"),
    },
    lights: { "sun": Directional(direction: (0, -1, 0), color: (1, 1, 1)), "sky": Ambient(color: (1, 1, 1)) },
)"#;

/// Reads a scene and an animation of it, and gives both to a function.
fn animate<T>(text: &str, then: impl FnOnce(&Scene<'_>, Result<Animation, AnimationError>) -> T) -> T {
    animate_in(SCENE, text, then)
}

fn animate_in<T>(
    scene_text: &str,
    text: &str,
    then: impl FnOnce(&Scene<'_>, Result<Animation, AnimationError>) -> T,
) -> T {
    let (folder, arena) = (tempfile::tempdir().unwrap(), Bump::new());
    let [scene, film] = ["scene.ron", "film.ron"].map(|name| folder.path().join(name));
    std::fs::write(&scene, scene_text).unwrap();
    std::fs::write(&film, text).unwrap();
    let scene = LoadedScene::open(&scene, &arena).unwrap();
    then(&scene.scene, Animation::read(&film, &scene))
}

fn refused(text: &str) -> String {
    let message = animate(text, |_, animation| animation.unwrap_err().to_string());
    let after_the_folder = message.split_once("film.ron").unwrap().1;
    after_the_folder.trim_start_matches(": ").to_owned()
}

#[test]
fn numbers_change_evenly_between_key_frames_and_stay_outside() {
    let text = r#"(
        seconds: 4,
        camera: [(at: 1, eye: (0, 0, 6)), (at: 3, eye: (2, 0, 4), vertical_fov: 0.9)],
        objects: {
            "ball": [(at: 0), (at: 2, by: (0, 4, 0), ease: true)],
            1: [(at: 0, rotation: (0, 0, 3.1415927))],
        },
        lights: { "sun": [(at: 0), (at: 4, color: (0, 0, 1))], 1: [(at: 0, color: (0.5, 0, 0))] },
    )"#;
    animate(text, |scene, animation| {
        let (animation, arena) = (animation.unwrap(), Bump::new());
        assert_eq!(animation.length(), Length::new(4.0, 20.0).unwrap());
        let at = |seconds| animation.scene_at(scene, seconds, &arena);
        assert_eq!(at(0.5).camera, scene.camera);
        assert_eq!(at(2.0).camera.eye, Vec3::new(1.0, 0.0, 5.0));
        assert!((at(2.0).camera.vertical_fov - 0.8).abs() < 1e-6);
        assert_eq!(at(9.0).camera.eye, Vec3::new(2.0, 0.0, 4.0));
        let height = |seconds| match at(seconds).objects {
            [Object { shape: Shape::Sphere(ball), .. }, _] => ball.center.y,
            objects => panic!("{objects:?}"),
        };
        // The cubic 3x² - 2x³ of the share of the way.
        assert_eq!([0.0, 0.5, 1.0, 2.0, 3.0].map(height), [0.0, 0.625, 2.0, 4.0, 4.0]);
        let [_, Object { shape: Shape::Cylinder(tube), .. }] = at(0.0).objects else { panic!() };
        assert!((tube.top - Vec3::new(0.0, -2.0, 0.0)).length() < 1e-5 && tube.base == Vec3::ZERO);
        let [Light::Directional { color, .. }, Light::Ambient { color: sky }] = at(2.0).lights else {
            panic!()
        };
        assert_eq!((*color, *sky), (LinearRgb::new(0.5, 0.5, 1.0), LinearRgb::new(0.5, 0.0, 0.0)));
    });
}

#[test]
fn colors_of_key_frames_get_the_exposure_of_the_scene() {
    let exposed = SCENE.replace("lights:", "settings: (exposure: 1), lights:");
    let film = "(seconds: 2, lights: { 0: [(at: 0), (at: 2, color: (0, 0, 1))] })";
    animate_in(&exposed, film, |scene, animation| {
        let (animation, arena) = (animation.unwrap(), Bump::new());
        let color = |seconds| match animation.scene_at(scene, seconds, &arena).lights {
            [Light::Directional { color, .. }, ..] => color.channels(),
            lights => panic!("{lights:?}"),
        };
        assert_eq!([0.0, 1.0, 2.0].map(color), [[2.0, 2.0, 2.0], [1.0, 1.0, 2.0], [0.0, 0.0, 2.0]]);
    });
}

#[test]
fn parts_without_key_frames_stay() {
    animate("(seconds: 1)", |scene, animation| {
        let (animation, arena) = (animation.unwrap(), Bump::new());
        assert_eq!(animation.scene_at(scene, 0.5, &arena), *scene);
    });
}

#[test]
fn what_is_refused_has_a_reason() {
    for (text, expected) in [
        ("(seconds: 0)", "the animation: the length must be above 0 and at most 3600 seconds"),
        ("(seconds: NaN)", "the animation: the length must be above 0 and at most 3600 seconds"),
        (
            "(seconds: 1, frames_per_second: 51)",
            "the animation: the frames in a second must be above 0 and at most 50",
        ),
        (
            "(seconds: 3600, frames_per_second: 50)",
            "the animation: it would have 180000 frames; between 1 and 10000 are possible",
        ),
        (
            r#"(seconds: 1, objects: { "bal": [] })"#,
            "object `bal`: the scene has none of this name; did you mean `ball`?",
        ),
        (
            "(seconds: 1, lights: { 2: [] })",
            "light 2: the scene has none of this name; numbers from 0 to 1 are possible",
        ),
        (
            "(seconds: 1, objects: { 0: [] })",
            "object 0: there is no key frame; add one, or leave this part out",
        ),
        (
            "(seconds: 1, camera: [(at: 0), (at: 0)])",
            "camera: the key frame at 0 is not later than the one before; times grow from 0 on",
        ),
        (
            "(seconds: 1, lights: { 0: [(at: 0, position: (0, 0, 0))] })",
            "light 0: a light of this kind has no position; leave it out",
        ),
        ("(camera: [])", ":1:12: the field `seconds` of Animation is missing; add it"),
        (
            "(seconds: 1, camera: [(at: 0, eyes: (0, 0, 0))])",
            ":1:31: there is no field of CameraKey `eyes`; did you mean `eye`?",
        ),
    ] {
        assert_eq!(refused(text), expected, "{text}");
    }
}
