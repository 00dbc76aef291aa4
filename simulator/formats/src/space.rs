//! Vectors and rotations in `f64`.

use glam::{DMat3, DVec3, EulerRot};
use rayline::Vec3;

/// A vector in `f64`.
pub fn vector(vector: Vec3) -> DVec3 {
    DVec3::new(vector.x.into(), vector.y.into(), vector.z.into())
}

/// The rotation by angles in radians about x, then about y, then about z.
pub fn rotation(angles: Vec3) -> DMat3 {
    let DVec3 { x, y, z } = vector(angles);
    DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x)
}

/// The angles of a [`rotation`].
pub fn angles(rotation: &DMat3) -> Vec3 {
    let (z, y, x) = rotation.to_euler(EulerRot::ZYX);
    Vec3::new(x as f32, y as f32, z as f32)
}

#[cfg(test)]
mod tests {
    use core::f32::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn angles_give_their_rotation_back() {
        for turn in [
            Vec3::new(0.3, -0.8, 2.9),
            Vec3::new(-2.0, 1.5, -0.1),
            Vec3::new(0.7, FRAC_PI_2, 0.2),
            Vec3::new(0.7, -FRAC_PI_2, 0.2),
            Vec3::ZERO,
        ] {
            let (matrix, again) = (rotation(turn), rotation(angles(&rotation(turn))));
            assert!(matrix.abs_diff_eq(again, 1e-3), "{turn:?}: {again} is not {matrix}");
        }
    }

    /// About x, then y, then z, counterclockwise.
    #[test]
    fn rotations_turn_counterclockwise() {
        for (turn, expected) in [
            (Vec3::new(FRAC_PI_2, 0.0, 0.0), DVec3::Z),
            (Vec3::new(FRAC_PI_2, FRAC_PI_2, 0.0), DVec3::X),
            (Vec3::new(0.0, 0.0, FRAC_PI_2), -DVec3::X),
        ] {
            let up = rotation(turn) * DVec3::Y;
            assert!(up.abs_diff_eq(expected, 2e-5), "{turn:?}: {up} is not {expected}");
        }
    }
}
