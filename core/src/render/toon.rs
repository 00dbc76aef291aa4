//! Toon tones: the brightness of light in steps.

use super::Light16;
use super::look::Tones;
use crate::color::LinearRgb;
use crate::math::Real;

/// The light of one sample in these tones. Gooch's are made where surfaces are shaded.
pub(super) fn toned<R: Real>(tones: Tones, light: LinearRgb<R>) -> LinearRgb<R> {
    let Tones::Toon { steps } = tones else { return light };
    let brightest = brightest(Light16::new(light));
    let last = u32::from(steps).saturating_sub(1).max(1);
    let step = nearest_step(brightest, last);
    if step == 0 {
        return LinearRgb::BLACK;
    }
    let level = (step * step * 65536).checked_div(last * last).unwrap_or(65536);
    // Both are at most 32768. Light of step 1 and more is far from 0, so the quotient is below 4.
    let [level, brightest] = [level, brightest].map(|light| R::from_fraction((light >> 1) as u16));
    let LinearRgb { r, g, b } = light;
    let [r, g, b] = [r, g, b].map(|channel| channel.smaller(R::ONE));
    LinearRgb::new(r, g, b).scaled(level / brightest)
}

/// The step of light in these tones, for comparisons; 0 if they have no steps.
pub(super) fn step_of(tones: Tones, light: Light16) -> u32 {
    match tones {
        Tones::Toon { steps } => nearest_step(brightest(light), u32::from(steps).saturating_sub(1).max(1)),
        Tones::Light | Tones::Gooch(_) => 0,
    }
}

/// The brightest channel. Unlike the luminance, it can have any step in any hue.
fn brightest(light: Light16) -> u32 {
    light.r.max(light.g).max(light.b)
}

/// The step k of 0 to `last` whose light (k / `last`)² is nearest in its root, for light from 0 to 65536.
fn nearest_step(light: u32, last: u32) -> u32 {
    // √light ≥ (k - 1/2) / last. At most 65536 · 900.
    let scaled = light.min(65536) * 4 * last * last;
    (1..=last).take_while(|step| (2 * step - 1) * (2 * step - 1) * 65536 <= scaled).last().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    fn toon(steps: u8, light: f32) -> f32 {
        toned(Tones::Toon { steps }, LinearRgb::gray(light)).r
    }

    #[test]
    fn steps_are_even_to_the_eye() {
        for steps in 2..=16u8 {
            let last = f32::from(steps - 1);
            for step in 0..steps {
                let root = f32::from(step) / last;
                let level = root * root;
                // Half a step less and more, and almost that much.
                for beside in [-0.49, 0.0, 0.49] {
                    let light = (root + beside / last).max(0.0).powi(2);
                    let found = toon(steps, light);
                    assert!((found - level).abs() < 1e-3, "{light} of {steps}: {found}, not {level}");
                }
            }
            assert_eq!((toon(steps, 0.0), toon(steps, 1.0), toon(steps, 50.0)), (0.0, 1.0, 1.0));
        }
    }

    #[test]
    fn hues_stay_in_all_number_systems() {
        fn check<R: Real>() {
            for light in [[0.9, 0.3, 0.1], [0.02, 0.01, 0.2], [0.0, 0.5, 0.25], [9.0, 0.5, 0.25]] {
                let [r, g, b] = light;
                let seen = toned(Tones::Toon { steps: 5 }, LinearRgb::new(r, g, b).to::<R>()).to_f32();
                let shown = light.map(|channel: f32| channel.min(1.0));
                let most = shown.into_iter().fold(0.0, f32::max);
                let level = ((most.sqrt() * 4.0).round() / 4.0).powi(2);
                for (channel, shown) in seen.channels().into_iter().zip(shown) {
                    assert!((channel - shown * level / most).abs() < 2e-4, "{seen:?} of {light:?}");
                }
            }
        }
        check::<f32>();
        check::<f64>();
        check::<Fixed>();
    }

    /// Realtime quality compares the steps of light that has its tone already.
    #[test]
    fn toned_light_keeps_its_step() {
        for steps in 2..=16 {
            let tones = Tones::Toon { steps };
            for light in (0..=1000).map(|light| LinearRgb::gray(light as f32 / 1000.0)) {
                let step = step_of(tones, Light16::new(light));
                assert_eq!(step_of(tones, Light16::new(toned(tones, light))), step, "{light:?}, {steps}");
            }
        }
        assert_eq!(step_of(Tones::Light, Light16::gray(40_000)), 0);
    }
}
