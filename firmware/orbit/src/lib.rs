//! A camera that goes around a scene, frame after frame.
//!
//! Board and host both take the camera from here, so that their pictures are the same bytes.

#![cfg_attr(not(test), no_std)]

use core::f32::consts::TAU;

use rayline::shape::Shape;
use rayline::{Camera, Scene, Vec3};

/// A camera that goes around the vertical axis through the middle of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// The scene's own camera.
    start: Camera,
    /// A point of the axis.
    middle: Vec3,
}

impl Orbit {
    /// Frames of one turn, which takes nine seconds at ten frames a second.
    pub const FRAMES: u32 = 90;

    /// An orbit that starts at the scene's own camera. Its axis goes through the mean center of the scene's
    /// spheres, or through the camera's target if there is no sphere.
    pub fn around(scene: &Scene<'_>) -> Self {
        let (mut sum, mut spheres) = (Vec3::new(0.0, 0.0, 0.0), 0.0);
        for object in scene.objects {
            if let Shape::Sphere(sphere) = object.shape {
                sum = sum + sphere.center;
                spheres += 1.0;
            }
        }
        let middle = if spheres > 0.0 { sum * (1.0 / spheres) } else { scene.camera.target };
        Self { start: scene.camera, middle }
    }

    /// The camera of a frame. Frame 0 has the scene's own camera.
    pub fn camera(&self, frame: u32) -> Camera {
        let step = frame % Self::FRAMES;
        if step == 0 {
            return self.start;
        }
        let angle = step as f32 * (TAU / Self::FRAMES as f32);
        let (sine, cosine) = (libm::sinf(angle), libm::cosf(angle));
        let turned = |vector: Vec3| {
            Vec3::new(cosine * vector.x + sine * vector.z, vector.y, cosine * vector.z - sine * vector.x)
        };
        let moved = |point: Vec3| self.middle + turned(point - self.middle);
        Camera {
            eye: moved(self.start.eye),
            target: moved(self.start.target),
            up: turned(self.start.up),
            ..self.start
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayline::builtin;
    use rayline::math::Fixed;

    fn distance(a: Vec3, b: Vec3) -> f32 {
        (a - b).length()
    }

    #[test]
    fn the_first_frame_of_each_turn_is_the_scenes_own() {
        for builtin in &builtin::ALL {
            let orbit = Orbit::around(builtin.scene);
            assert_eq!(orbit.camera(0), builtin.scene.camera);
            assert_eq!(orbit.camera(3 * Orbit::FRAMES), builtin.scene.camera);
            assert_eq!(orbit.camera(Orbit::FRAMES + 7), orbit.camera(7));
        }
    }

    #[test]
    fn the_camera_keeps_its_distance_and_its_height() {
        let orbit = Orbit::around(&builtin::CLASSIC);
        let start = orbit.camera(0);
        for frame in 0..Orbit::FRAMES {
            let camera = orbit.camera(frame);
            assert_eq!((camera.eye.y, camera.up), (start.eye.y, start.up));
            assert!((distance(camera.eye, orbit.middle) - distance(start.eye, orbit.middle)).abs() < 1e-4);
            assert!((distance(camera.eye, camera.target) - distance(start.eye, start.target)).abs() < 1e-4);
        }
    }

    #[test]
    fn half_a_turn_is_opposite() {
        let orbit = Orbit::around(&builtin::CLASSIC);
        let (start, half) = (orbit.camera(0).eye, orbit.camera(Orbit::FRAMES / 2).eye);
        let opposite = orbit.middle * 2.0 - start;
        assert!((half.x - opposite.x).abs() < 1e-4 && (half.z - opposite.z).abs() < 1e-4);
    }

    #[test]
    fn every_frame_can_be_prepared() {
        for builtin in &builtin::ALL {
            let mut memory = vec![core::mem::MaybeUninit::uninit(); builtin.scene.bytes::<Fixed>()];
            let mut scene = rayline::PreparedScene::<Fixed, _>::new(builtin.scene, &mut memory).unwrap();
            let orbit = Orbit::around(builtin.scene);
            for frame in 0..Orbit::FRAMES {
                scene.set_camera(&orbit.camera(frame)).unwrap();
            }
        }
    }
}
