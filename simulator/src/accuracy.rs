//! Losses by rounding in scenes that are too large for a number system, or too far from the origin.
//!
//! Rays leave a surface by a distance in proportion to its coordinates ([`Real::offset`]): 1e-5 of the
//! coordinates in `f32`, and a 13th of this distance from huge balls. Things nearer to the surface throw no
//! shadow on it, and are not mirrored in it. As long as the distance is less than a pixel or two, the scene
//! need not be moved.

use rayline::math::Fixed;
use rayline::shape::{Geometry as _, Shape, Sphere};
use rayline::{Real, Scene};

use crate::Number;

/// A lost distance is reported beyond this share of the way from the eye to the camera's target: about two
/// lines of a picture with 240 lines.
const SEEN: f32 = 1.0 / 256.0;

/// Balls of a larger radius or place are huge: see `shape/sphere.rs` of the core.
const HUGE_BALL: f32 = 1024.0;

/// Notes about distances that are lost in a number system, with what to do.
pub fn rounding_notes(scene: &Scene<'_>, number: Number) -> Vec<String> {
    match number {
        Number::F32 => notes_in::<f32>(scene, number),
        Number::Fixed => notes_in::<Fixed>(scene, number),
        Number::F64 => notes_in::<f64>(scene, number),
    }
}

fn notes_in<R: Real>(scene: &Scene<'_>, number: Number) -> Vec<String> {
    let camera = scene.camera;
    let seen = SEEN * (camera.target - camera.eye).length();
    let offset = |magnitude: f32| R::RAY_OFFSET.to_f32() * magnitude;
    let mut notes = Vec::new();
    let eye = offset(camera.eye.magnitude());
    if eye > seen {
        notes.push(format!(
            "the camera is far from the origin: in {number}, shadows and mirrored things nearer than \
             {eye:.2} to a surface are lost there; move the scene to the origin, or use --number f64"
        ));
    }
    let offsets = scene.objects.iter().map(|object| match object.shape {
        // In floating point the core computes hits of huge balls more exactly than those of other shapes.
        Shape::Sphere(Sphere { center, radius })
            if !R::IS_FIXED_POINT && center.magnitude().max(radius) > HUGE_BALL =>
        {
            offset(center.magnitude().max(radius) * (5.0 / 64.0))
        }
        _ => offset(object.shape.extent().solid),
    });
    let worst = offsets.enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b));
    if let Some((index, worst)) = worst.filter(|(_, offset)| *offset > seen && *offset > 2.0 * eye) {
        notes.push(format!(
            "object {index} is huge: in {number}, shadows and mirrored things nearer than {worst:.2} to it \
             are lost; make it smaller, or use --number f64"
        ));
    }
    notes
}

#[cfg(test)]
mod tests {
    use rayline::builtin::CLASSIC;
    use rayline::{Camera, Object, Vec3};

    use super::*;

    const CAMERA: Camera = Camera {
        eye: Vec3::new(0.0, 1.5, 6.0),
        target: Vec3::new(0.0, 0.5, 0.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.6,
        lens: None,
    };

    fn ball(center: Vec3, radius: f32) -> Object<Shape<'static>> {
        Object::new(Shape::Sphere(Sphere::new(center, radius)), 0)
    }

    #[test]
    fn huge_things_are_told_with_the_distance() {
        let ground = |radius: f32| [ball(Vec3::new(0.0, -radius, 0.0), radius)];
        let told = |objects: &[Object<Shape<'static>>], camera, number| {
            rounding_notes(&Scene { camera, objects, ..CLASSIC }, number)
        };
        assert_eq!(told(&ground(1e3), CAMERA, Number::F32), [""; 0]);
        assert_eq!(told(&ground(1e5), CAMERA, Number::F64), [""; 0]);
        // 5/64 of 1e-5 of the radius; in fixed point 2^-17 of twice the radius.
        for (number, lost) in
            [(Number::F32, "f32"), (Number::Fixed, "fixed")].into_iter().zip(["0.08", "1.53"])
        {
            let [note] = &told(&ground(1e5), CAMERA, number.0)[..] else { panic!("no note") };
            let expected = format!(
                "object 0 is huge: in {}, shadows and mirrored things nearer than {lost} to it",
                number.1
            );
            assert!(note.starts_with(&expected), "{note}");
        }
        let away = Vec3::new(1e5, 0.0, 0.0);
        let camera = Camera { eye: CAMERA.eye + away, target: CAMERA.target + away, ..CAMERA };
        let [note] = &told(&[ball(away, 1.0)], camera, Number::F32)[..] else { panic!("no note") };
        assert!(note.starts_with("the camera is far from the origin: in f32, shadows"), "{note}");
        assert!(note.contains("nearer than 1.00 to a surface"), "{note}");
        assert_eq!(told(&[ball(away, 1.0)], camera, Number::F64), [""; 0]);
    }

    /// The built-in scenes get no notes.
    #[test]
    fn usual_scenes_have_no_notes() {
        for builtin in rayline::builtin::ALL {
            for number in [Number::F32, Number::Fixed] {
                assert_eq!(rounding_notes(builtin.scene, number), [""; 0], "{}", builtin.name);
            }
        }
    }
}
