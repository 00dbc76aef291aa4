//! The projection of points onto a plane along the rays of a light: where their shadows fall.

use crate::light::Source;
use crate::math::{Real, Vec3};

/// The projection by a light onto a plane on which shadows fall.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadowProjection<N> {
    /// The place of the light, or the direction toward it.
    light: Vec3<N>,
    /// How much of a point is subtracted from `light` for the direction from the point to the light: 1 or 0.
    share: N,
    /// The plane: its unit normal, and its distance from the origin along the normal.
    normal: Vec3<N>,
    distance: N,
}

impl<N: Real<Setup = N>> ShadowProjection<N> {
    /// `None` for a light of which the place is not known in scene units.
    pub(super) fn new<R: Real<Setup = N>>(
        light: &Source<R>,
        (normal, distance): (Vec3<N>, N),
    ) -> Option<Self> {
        let (light, share) = match light {
            Source::At(position) => (position.to_setup(), N::ONE),
            Source::Toward(direction) => (direction.to_setup(), N::ZERO),
            Source::Far(..) => return None,
        };
        Some(Self { light, share, normal, distance })
    }

    /// The place where the shadow of a point falls; `None` if the light does not shine past the point toward
    /// the plane, or nearly along the plane.
    pub(super) fn shadow_of(&self, point: Vec3<N>) -> Option<Vec3<N>> {
        let toward = self.light - point * self.share;
        let (height, rise) = (self.normal.dot(point) - self.distance, self.normal.dot(toward));
        // On the side of the plane to which the light is above the point.
        let (height, rise) = if rise < N::ZERO { (-height, -rise) } else { (height, rise) };
        let flattest = height.larger(toward.magnitude() * N::from_f32(1e-2));
        (height > N::ZERO && rise * N::from_u16(100) > flattest).then(|| point - toward * (height / rise))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shadows_fall_behind_the_point_that_casts_them() {
        let floor = (Vec3::new(0.0, 1.0, 0.0), -1.0);
        let sun = ShadowProjection::new(&Source::Toward(Vec3::new(0.6f32, 0.8, 0.0)), floor).unwrap();
        let shadow = sun.shadow_of(Vec3::new(0.0, 3.0, 2.0)).unwrap();
        assert!((shadow - Vec3::new(-3.0, -1.0, 2.0)).length() < 1e-5, "{shadow:?}");
        assert_eq!(sun.shadow_of(Vec3::new(0.0, -3.0, 2.0)), None);
        let lamp = ShadowProjection::new(&Source::At(Vec3::new(0.0f32, 3.0, 0.0)), floor).unwrap();
        let shadow = lamp.shadow_of(Vec3::new(1.0, 1.0, 0.0)).unwrap();
        assert!((shadow - Vec3::new(2.0, -1.0, 0.0)).length() < 1e-5, "{shadow:?}");
        // Above the lamp, and beside it.
        assert_eq!(lamp.shadow_of(Vec3::new(1.0, 3.5, 0.0)), None);
        assert_eq!(lamp.shadow_of(Vec3::new(1.0, 3.0, 0.0)), None);
    }
}
