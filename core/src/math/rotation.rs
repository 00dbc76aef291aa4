//! Rotations about the axes.

use super::{Real, Vec3, float};

/// A rotation about the x axis, then about y, then about z: counterclockwise, as seen from the axis' end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rotation<R> {
    rows: [Vec3<R>; 3],
}

impl<R: Real> Rotation<R> {
    /// The rotation by these angles, in radians.
    pub(crate) fn new(angles: Vec3) -> Self {
        let cosine_and_sine = |angle: f32| {
            let (sine, cosine) = float::set_up_sin_cos(angle);
            let (sine, cosine) = (R::from_f32(sine), R::from_f32(cosine));
            // Sine and cosine have the digits of `f32`. Scale them so that their squares add up to 1 in all
            // digits of `R`.
            let length = (sine * sine + cosine * cosine).sqrt();
            (cosine / length, sine / length)
        };
        let angles = [angles.x, angles.y, angles.z].map(cosine_and_sine);
        let (one, none) = (R::ONE, R::ZERO);
        let axes = [Vec3::new(one, none, none), Vec3::new(none, one, none), Vec3::new(none, none, one)];
        let [x, y, z] = axes.map(|axis| turned(axis, angles));
        let rows = [Vec3::new(x.x, y.x, z.x), Vec3::new(x.y, y.y, z.y), Vec3::new(x.z, y.z, z.z)];
        Self { rows }
    }

    /// The rows of its matrix.
    pub(crate) fn rows(&self) -> [Vec3<R>; 3] {
        self.rows
    }

    /// The vector, turned.
    #[inline]
    pub(crate) fn turn(&self, vector: Vec3<R>) -> Vec3<R> {
        let [x, y, z] = self.rows;
        Vec3::new(x.dot(vector), y.dot(vector), z.dot(vector))
    }

    /// The vector, turned by the opposite rotation.
    #[inline]
    pub(crate) fn back(&self, vector: Vec3<R>) -> Vec3<R> {
        let [x, y, z] = self.rows;
        let column = |a: R, b: R, c: R| Vec3::new(a, b, c).dot(vector);
        Vec3::new(column(x.x, y.x, z.x), column(x.y, y.y, z.y), column(x.z, y.z, z.z))
    }

    /// The rotation, rounded to another number system.
    pub(crate) fn rounded<T: Real<Setup = R>>(&self) -> Rotation<T> {
        Rotation { rows: self.rows.map(Vec3::from_setup) }
    }
}

/// A vector, turned about x, y and z by the angles of these cosines and sines.
pub(crate) fn turned<R: Real>(vector: Vec3<R>, [about_x, about_y, about_z]: [(R, R); 3]) -> Vec3<R> {
    let turn = |(cosine, sine): (R, R), a: R, b: R| (a * cosine - b * sine, a * sine + b * cosine);
    let Vec3 { x, y, z } = vector;
    let (y, z) = turn(about_x, y, z);
    let (z, x) = turn(about_y, z, x);
    let (x, y) = turn(about_z, x, y);
    Vec3::new(x, y, z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    const ANGLES: Vec3 = Vec3::new(0.5, -1.25, 2.0);

    #[test]
    fn about_x_then_y_then_z() {
        let quarter = core::f32::consts::FRAC_PI_2;
        let turned = |angles: Vec3, vector: Vec3<f64>| {
            let Vec3 { x, y, z } = Rotation::<f64>::new(angles).turn(vector);
            [x, y, z].map(|x| (x * 1e6).round() / 1e6 + 0.0)
        };
        let vector = Vec3::new(1.0, 2.0, 3.0);
        assert_eq!(turned(Vec3::new(quarter, 0.0, 0.0), vector), [1.0, -3.0, 2.0]);
        assert_eq!(turned(Vec3::new(0.0, quarter, 0.0), vector), [3.0, 2.0, -1.0]);
        assert_eq!(turned(Vec3::new(0.0, 0.0, quarter), vector), [-2.0, 1.0, 3.0]);
        // First to (1, -3, 2), then to (3, 1, 2).
        assert_eq!(turned(Vec3::new(quarter, 0.0, quarter), vector), [3.0, 1.0, 2.0]);
    }

    #[test]
    fn back_again_in_all_digits() {
        fn off<R: Real>() -> f32 {
            let rotation = Rotation::<R::Setup>::new(ANGLES).rounded::<R>();
            let vector = Vec3::new(0.25, -0.5, 0.125).to::<R>();
            (rotation.back(rotation.turn(vector)) - vector).magnitude().to_f32()
        }
        assert!(off::<f64>() < 1e-15 && off::<f32>() < 2e-7 && off::<Fixed>() < 3e-7);
    }
}
