//! Models that lie or reach farther than a scene may.

use glam::DVec3;
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

    /// The change for a model with these vertices: none if it and the default camera are within the limits of
    /// a scene. Otherwise its center becomes the origin, and it becomes smaller if it is still too large.
    pub(crate) fn of(vertices: impl Iterator<Item = DVec3>) -> Self {
        let bounds = vertices.fold(None, |bounds, vertex| match bounds {
            None => Some((vertex, vertex)),
            Some((min, max)) => Some((vertex.min(min), vertex.max(max))),
        });
        let Some((min, max)) = bounds else { return Self::NOT };
        let (center, half) = (min * 0.5 + max * 0.5, max * 0.5 - min * 0.5);
        let (reach, most) = (half.length() * CAMERA, f64::from(MAX_COORDINATE));
        if center.abs().max_element() + reach <= most {
            return Self::NOT;
        }
        // Round the center: the note tells it, and coordinates with few digits keep them.
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

    /// The note about the change, if there is one.
    pub(crate) fn note(&self) -> Option<String> {
        if *self == Self::NOT {
            return None;
        }
        let [x, y, z] = self.center.to_array();
        let scaled =
            if self.scale == 1.0 { String::new() } else { format!(", and scaled by {}", self.scale) };
        Some(format!("moved by {}, {}, {}{scaled}, as a scene reaches from -1e6 to 1e6", -x, -y, -z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(corners: [[f64; 3]; 2]) -> Moved {
        Moved::of(corners.into_iter().map(DVec3::from_array))
    }

    #[test]
    fn models_within_the_limits_stay() {
        assert_eq!(moved([[456_789.0, 912_345.0, 210.0], [456_799.0, 912_355.0, 215.0]]), Moved::NOT);
        assert_eq!(Moved::of(core::iter::empty()).note(), None);
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
