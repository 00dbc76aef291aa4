//! Models that lie or reach farther than a scene may.

use glam::{DAffine3, DVec3};
use rayline::Vec3;
use rayline::limits::MAX_COORDINATE;

/// The distance of the default camera from the center of a model is less than this multiple of half the
/// diagonal of its bounds.
const CAMERA: f64 = 5.0;

/// A translation and a scale that bring a model into the limits of a scene, computed in `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Moved {
    center: DVec3,
    /// A power of ten.
    scale: f64,
}

impl Moved {
    /// No change.
    pub(crate) const NOT: Self = Self { center: DVec3::ZERO, scale: 1.0 };

    /// The change for a model with these vertices: none if it is within the limits of a scene, and so is the
    /// default camera, unless the model has one. Otherwise its center becomes the origin, and it becomes
    /// smaller if it is still too large.
    pub(crate) fn of(vertices: impl Iterator<Item = DVec3>, has_camera: bool) -> Self {
        let bounds = vertices.fold(None, |bounds, vertex| match bounds {
            None => Some((vertex, vertex)),
            Some((min, max)) => Some((vertex.min(min), vertex.max(max))),
        });
        let Some((min, max)) = bounds else { return Self::NOT };
        let (center, half) = (min * 0.5 + max * 0.5, max * 0.5 - min * 0.5);
        let half = if has_camera { half } else { DVec3::splat(half.length() * CAMERA) };
        let (reach, most) = (half.max_element(), f64::from(MAX_COORDINATE));
        if (center.abs() + half).max_element() <= most {
            return Self::NOT;
        }
        // Round the center to whole numbers: the note is then short, and a coordinate of few digits still has
        // few digits when it is moved.
        let center = DVec3::from_array(center.to_array().map(f64::round));
        let scale = if reach <= most { 1.0 } else { 10f64.powf((most / reach).log10().floor()) };
        Self { center, scale }
    }

    /// The new place of a vertex.
    pub(crate) fn vertex(&self, vertex: DVec3) -> DVec3 {
        (vertex - self.center) * self.scale
    }

    /// The new place of a vertex, rounded.
    pub(crate) fn rounded(&self, vertex: DVec3) -> Vec3 {
        let [x, y, z] = self.vertex(vertex).as_vec3().to_array();
        Vec3::new(x, y, z)
    }

    /// The change as a transform.
    pub(crate) fn transform(&self) -> DAffine3 {
        DAffine3::from_scale(DVec3::splat(self.scale)) * DAffine3::from_translation(-self.center)
    }

    /// The new length of a unit.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// The note about the change, if there is one.
    pub(crate) fn note(&self) -> Option<String> {
        if *self == Self::NOT {
            return None;
        }
        // Not `-center`: zero has no sign.
        let [x, y, z] = (DVec3::ZERO - self.center).to_array();
        let scaled =
            if self.scale == 1.0 { String::new() } else { format!(", and scaled by {}", self.scale) };
        Some(format!("moved by {x}, {y}, {z}{scaled}, as a scene reaches from -1e6 to 1e6"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(corners: [[f64; 3]; 2]) -> Moved {
        Moved::of(corners.into_iter().map(DVec3::from_array), false)
    }

    #[test]
    fn models_with_cameras_may_reach_farther() {
        let moved = |most: f64| Moved::of([-most, most].into_iter().map(DVec3::splat), true);
        assert_eq!(moved(1e6), Moved::NOT);
        let place = moved(2e6).transform().transform_point3(DVec3::new(2e6, 0.0, -1.0));
        assert!((place - DVec3::new(2e5, 0.0, -0.1)).length() < 1e-9, "{place}");
    }

    #[test]
    fn models_within_the_limits_stay() {
        assert_eq!(moved([[456_789.0, 912_345.0, 210.0], [456_799.0, 912_355.0, 215.0]]), Moved::NOT);
        assert_eq!(Moved::of(core::iter::empty(), false).note(), None);
    }

    #[test]
    fn far_models_come_to_the_origin() {
        let far = moved([[456_789.1, 5_412_345.0, 210.0], [456_799.1, 5_412_355.0, 212.0]]);
        assert_eq!(far.rounded(DVec3::new(456_789.1, 5_412_345.0, 210.0)), Vec3::new(-4.9, -5.0, -1.0));
        assert_eq!(
            far.note().as_deref(),
            Some("moved by -456794, -5412350, -211, as a scene reaches from -1e6 to 1e6")
        );
    }

    #[test]
    fn huge_models_become_smaller() {
        let huge = moved([[-3e9, 0.0, 0.0], [1e9, 0.0, 0.0]]);
        assert_eq!(huge.scale, 1e-4);
        assert_eq!(huge.rounded(DVec3::new(1e9, 0.0, 0.0)), Vec3::new(2e5, 0.0, 0.0));
        // Its corners are within the limits, but the default camera would not be.
        assert_eq!(moved([[-9e5, 0.0, 0.0], [9e5, 0.0, 0.0]]).scale, 0.1);
    }
}
