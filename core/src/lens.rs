//! Lenses: a camera that is in focus at one distance.

use crate::fault::{Fault, check_finite};
use crate::math::{Real, Scale, float};
#[cfg(feature = "distributed")]
use crate::sampling::disc;

/// A thin lens: what lies at the distance of focus is sharp, what lies nearer or farther is blurred (Potmesil
/// and Chakravarty, "A Lens and Aperture Camera Model for Synthetic Image Generation", SIGGRAPH 1981). It
/// needs the feature `distributed`, and several samples for each pixel.
///
/// The light of a point at the distance d covers a circle with a diameter of `2 · radius · |d - focus| / d`
/// at the distance of focus. If the circles of all that the eye may see directly are smaller than half a
/// pixel, the lens is drawn as a pinhole: with one sample, and in realtime quality.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Lens {
    /// The radius of the aperture, in the scene's unit: more than 0, at most `focus`.
    pub radius: f32,
    /// The distance of the plane in focus from the eye, along the line of sight: more than 0.
    pub focus: f32,
    /// The number of blades, which give the aperture so many corners: 3 to 16; 0: it is round.
    #[cfg_attr(feature = "serde", serde(default))]
    pub blades: u8,
}

/// The most blades of an aperture.
const MOST_BLADES: u8 = 16;

/// A lens that was checked and converted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedLens<R: Real> {
    /// The radius of the aperture, in the scaled unit.
    pub(crate) radius: R,
    /// The radius over the distance of focus.
    pub(crate) radius_over_focus: R::Setup,
    blades: u8,
    /// Cosine and sine of the angle from one corner to the next.
    step: [R; 2],
}

impl Lens {
    /// A lens with a round aperture.
    pub const fn round(radius: f32, focus: f32) -> Self {
        Self { radius, focus, blades: 0 }
    }

    /// Checks the lens and converts it.
    pub(crate) fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedLens<R>, Fault> {
        if !cfg!(feature = "distributed") {
            return Err(Fault::WithoutFeature { feature: "distributed" });
        }
        let Self { radius, focus, blades } = *self;
        check_finite(radius)?;
        check_finite(focus)?;
        if !(radius > 0.0 && radius <= focus) || !(blades == 0 || (3..=MOST_BLADES).contains(&blades)) {
            return Err(Fault::Lens);
        }
        let (sine, cosine) = float::set_up_sin_cos(core::f32::consts::TAU / f32::from(blades.max(1)));
        Ok(PreparedLens {
            radius: R::from_f32(radius * scale.to_f32()),
            radius_over_focus: R::Setup::from_f32(radius) / R::Setup::from_f32(focus),
            blades,
            step: [cosine, sine].map(R::from_f32),
        })
    }
}

#[cfg(feature = "distributed")]
impl<R: Real> PreparedLens<R> {
    /// A place on the aperture, right and up from its center, in units of the radius.
    pub(crate) fn place(&self, pair: [u16; 2]) -> [R; 2] {
        if self.blades == 0 {
            return disc(pair);
        }
        // The triangle between the center and two neighboring corners, and the place in the triangle.
        let [along, across] = pair;
        let along = u32::from(along) * u32::from(self.blades);
        let ([cosine, sine], [mut x, mut y]) = (self.step, [R::ZERO, R::ONE]);
        for _ in 0..along >> 16 {
            [x, y] = [x * cosine - y * sine, x * sine + y * cosine];
        }
        let next = [x * cosine - y * sine, x * sine + y * cosine];
        let outward = R::from_fraction(along as u16).sqrt();
        let share = R::from_fraction(across);
        let mix = |corner: R, next: R| outward * (corner + (next - corner) * share);
        let [next_x, next_y] = next;
        [mix(x, next_x), mix(y, next_y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(feature = "distributed")]
    use crate::math::Fixed;

    /// The share of the round aperture that one with corners leaves open is its area over that of the circle.
    #[cfg(feature = "distributed")]
    fn assert_blades_cut_the_circle<R: Real>() {
        for blades in [3u8, 5, 6, 16] {
            let lens = Lens { blades, ..Lens::round(0.5, 4.0) }.prepare::<R>(Scale::ONE).unwrap();
            let (mut least, mut most, mut squares, mut count) = (1.0f64, 0.0f64, 0.0, 0.0);
            for pair in (0..128).flat_map(|a| (0..128).map(move |b| [a * 512 + 256, b * 512 + 256])) {
                let [x, y] = lens.place(pair).map(|number| f64::from(number.to_f32()));
                let distance = x.hypot(y);
                // In the direction of a corner or of the middle of a side.
                (least, most) = (least.min(1.0 - distance), most.max(distance));
                squares += distance * distance;
                count += 1.0;
            }
            assert!((-1e-4..0.05).contains(&least) && most > 0.95, "{blades}: {least} {most}");
            // The mean square distance of a regular polygon: (2 + cos 2π/n) / 6 of the radius.
            let expected = (2.0 + (core::f64::consts::TAU / f64::from(blades)).cos()) / 6.0;
            assert!((squares / count - expected).abs() < 0.01, "{blades}");
        }
    }

    #[test]
    fn lenses_need_their_feature() {
        let error = Lens::round(0.1, 3.0).prepare::<f32>(Scale::ONE).err();
        let refused = Some(Fault::WithoutFeature { feature: "distributed" });
        assert_eq!(error, if cfg!(feature = "distributed") { None } else { refused });
    }

    #[test]
    #[cfg(feature = "distributed")]
    fn apertures_have_corners() {
        assert_blades_cut_the_circle::<f32>();
        assert_blades_cut_the_circle::<Fixed>();
    }

    #[test]
    #[cfg(feature = "distributed")]
    fn bad_lenses_are_refused() {
        let refused = |lens: Lens| lens.prepare::<f32>(Scale::ONE).err();
        assert_eq!(refused(Lens::round(0.1, 3.0)), None);
        for (radius, focus, blades) in
            [(0.0, 1.0, 0), (-1.0, 1.0, 0), (2.0, 1.0, 0), (0.1, 0.0, 0), (0.1, 1.0, 2), (0.1, 1.0, 17)]
        {
            assert_eq!(refused(Lens { radius, focus, blades }), Some(Fault::Lens));
        }
        assert_eq!(refused(Lens::round(f32::NAN, 1.0)), Some(Fault::NotFinite));
        assert_eq!(refused(Lens::round(1.0, f32::INFINITY)), Some(Fault::NotFinite));
    }
}
