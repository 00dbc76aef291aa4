//! A camera that orbits its target.

use rayline::math::{Interval, Ray};
use rayline::{Camera, Fault, Part, PreparedScene, Scene, SceneError, Vec3};

use crate::picture::memory_for;

/// A camera that orbits a point on its line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    camera: Camera,
}

/// The largest sine of the camera's elevation. At the poles its up vector would lie along the line of sight.
const STEEPEST: f64 = 0.98;

impl Orbit {
    /// An orbit around the point at `distance` in the middle of the camera's picture.
    ///
    /// `None` if the camera has no line of sight or no up direction, or if the distance is not positive.
    pub fn new(camera: Camera, distance: f32) -> Option<Self> {
        let eye: Vec3<f64> = camera.eye.to();
        let forward = (camera.target.to() - eye).normalized()?;
        camera.up.to::<f64>().normalized()?;
        let target = (eye + forward * f64::from(distance)).to_f32();
        (distance > 0.0).then_some(Self { camera: Camera { target, ..camera } })
    }

    /// An orbit around the point that the scene's camera sees in the middle of its picture; around the
    /// camera's target, if the camera sees no object there.
    ///
    /// # Errors
    /// The scene is refused.
    pub fn around(scene: &Scene<'_>) -> Result<Self, SceneError> {
        let mut memory = memory_for::<f64>(scene);
        let prepared = PreparedScene::<f64, _>::new(scene, &mut memory)?;
        let camera = scene.camera;
        let (unit, way) = (prepared.scale(), camera.target - camera.eye);
        let hit = way.normalized().and_then(|direction| {
            let ray = Ray { origin: (camera.eye * unit).to(), direction: direction.to() };
            prepared.closest_hit(&ray, Interval::AHEAD)
        });
        let distance = hit.map_or(way.length(), |hit| hit.t as f32 / unit);
        // The camera was prepared, so it has a line of sight, and this error cannot occur.
        Self::new(camera, distance).ok_or(SceneError { part: Part::Camera, fault: Fault::EyeAtTarget })
    }

    /// The camera at its current position.
    pub fn camera(&self) -> Camera {
        self.camera
    }

    /// Moves the camera around the target, to the right and up, by angles in radians. It stops before the
    /// poles.
    pub fn turn(&mut self, right: f64, up: f64) {
        let Camera { eye, target, up: pole, .. } = self.camera;
        let (center, from_center) = (target.to::<f64>(), (eye.to() - target.to()));
        let (Some(pole), radius) = (pole.to::<f64>().normalized(), from_center.length()) else { return };
        let from_center = rotate(from_center, pole, right);
        let Some(side) = pole.cross(from_center).normalized() else { return };
        let raised = rotate(from_center, side, -up);
        let height = |vector: Vec3<f64>| (pole.dot(vector) / radius).abs();
        let steeper = height(raised) > height(from_center);
        let from_center = if steeper && height(raised) > STEEPEST { from_center } else { raised };
        self.camera.eye = (center + from_center).to_f32();
    }

    /// Multiplies the distance to the target by `scale`.
    pub fn dolly(&mut self, scale: f64) {
        let center: Vec3<f64> = self.camera.target.to();
        self.camera.eye = (center + (self.camera.eye.to() - center) * scale).to_f32();
    }
}

/// Turns a vector around a unit axis by the right-hand rule (Rodrigues 1840).
fn rotate(vector: Vec3<f64>, axis: Vec3<f64>, angle: f64) -> Vec3<f64> {
    let (sine, cosine) = angle.sin_cos();
    vector * cosine + axis.cross(vector) * sine + axis * (axis.dot(vector) * (1.0 - cosine))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAMERA: Camera = Camera {
        eye: Vec3::new(0.0, 0.0, 5.0),
        target: Vec3::new(0.0, 0.0, 4.0),
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 1.0,
        lens: None,
    };

    fn assert_near(actual: Vec3, expected: Vec3) {
        assert!((actual - expected).length() < 1e-5, "{actual:?} is not {expected:?}");
    }

    #[test]
    fn turns_around_the_point_at_the_distance() {
        let mut orbit = Orbit::new(CAMERA, 3.0).unwrap();
        assert_near(orbit.camera().target, Vec3::new(0.0, 0.0, 2.0));
        orbit.turn(core::f64::consts::FRAC_PI_2, 0.0);
        assert_near(orbit.camera().eye, Vec3::new(3.0, 0.0, 2.0));
        orbit.turn(0.0, core::f64::consts::FRAC_PI_6);
        assert_near(orbit.camera().eye, Vec3::new(3.0 * 0.75f32.sqrt(), 1.5, 2.0));
        orbit.dolly(2.0);
        assert_near(orbit.camera().eye, Vec3::new(6.0 * 0.75f32.sqrt(), 3.0, 2.0));
    }

    #[test]
    fn stops_before_the_poles_and_comes_back() {
        let mut orbit = Orbit::new(CAMERA, 3.0).unwrap();
        for direction in [1.0, -1.0] {
            for _ in 0..100 {
                orbit.turn(0.3, direction * 0.1);
            }
            let height = orbit.camera().eye.y * direction as f32;
            assert!((2.8..2.95).contains(&height), "{height}");
            assert!(((orbit.camera().eye - orbit.camera().target).length() - 3.0).abs() < 1e-4);
        }
    }

    #[test]
    fn cameras_without_a_line_of_sight_have_no_orbit() {
        assert_eq!(Orbit::new(Camera { target: CAMERA.eye, ..CAMERA }, 1.0), None);
        assert_eq!(Orbit::new(Camera { up: Vec3::new(0.0, 0.0, 0.0), ..CAMERA }, 1.0), None);
        for distance in [0.0, -1.0, f32::NAN] {
            assert_eq!(Orbit::new(CAMERA, distance), None);
        }
    }
}
