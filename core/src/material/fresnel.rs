//! The Fresnel terms: the shares of mirrored and refracted light by angle.

use crate::math::Real;

/// The model by which the shares of mirrored and refracted light depend on the angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Fresnel {
    /// The shares are constant.
    #[default]
    Constant,
    /// A flatter ray is mirrored more, by the approximation of Schlick, "An Inexpensive BRDF Model for
    /// Physically-based Rendering", Eurographics 1994, eq. 15. For a transparent material, the index of
    /// refraction divides the sum of reflectance and transmittance into the two shares. An opaque material
    /// has its own reflectance at normal incidence, and 1 at grazing incidence.
    Schlick,
    /// The equations of Fresnel for unpolarized light and the index of refraction (Born and Wolf, "Principles
    /// of Optics", §1.5.2). A transparent material divides the sum of reflectance and transmittance by them.
    /// An opaque material, such as lacquer, has this share of its reflectance.
    Exact,
}

/// Schlick's approximation: `share` at cosine 1, and 1 at cosine 0, by the fifth power of 1 - cosine.
pub(super) fn schlick<R: Real>(share: R, cosine: R) -> R {
    let flat = (R::ONE - cosine).larger(R::ZERO);
    let squared = flat * flat;
    share + (R::ONE - share) * (squared * squared * flat)
}

/// The mirrored share of unpolarized light. `cosine` is that of the angle between the ray and the normal,
/// `refracted` that of the refracted ray, and `eta` the index of refraction on the side of the ray over that
/// on the other side.
pub(super) fn exact<R: Real>(eta: R, cosine: R, refracted: R) -> R {
    let ratio = |near: R, far: R| {
        let sum = near + far;
        // Both are 0 at grazing incidence, where all light is mirrored.
        if sum > R::ZERO { (near - far) / sum } else { R::ONE }
    };
    let across = ratio(eta * cosine, refracted);
    let along = ratio(cosine, eta * refracted);
    (across * across + along * along) * R::from_f32(0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    fn mirrored<R: Real>(eta: f32, degrees: f32) -> f32 {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let refracted = (1.0 - (eta * sine) * (eta * sine)).sqrt();
        exact(R::from_f32(eta), R::from_f32(cosine), R::from_f32(refracted)).to_f32()
    }

    #[test]
    fn glass_mirrors_as_the_books_say() {
        for mirrored in [mirrored::<f32>, mirrored::<f64>, mirrored::<Fixed>] {
            // ((1.5 - 1) / (1.5 + 1))² at normal incidence, from either side.
            assert!((mirrored(1.0 / 1.5, 0.0) - 0.04).abs() < 1e-6);
            assert!((mirrored(1.5, 0.0) - 0.04).abs() < 1e-6);
            // At Brewster's angle, 56.31°, one polarization is not mirrored, and (5/13)² of the other is.
            let half = 0.5 * (5.0f32 / 13.0) * (5.0 / 13.0);
            assert!((mirrored(1.0 / 1.5, 56.309_93) - half).abs() < 1e-5);
            assert!((mirrored(1.0 / 1.5, 90.0) - 1.0).abs() < 1e-4);
            // From inside, all light is mirrored at the critical angle, 41.81°.
            assert!((mirrored(1.5, 41.8103) - 1.0).abs() < 0.02);
        }
    }

    #[test]
    fn schlick_is_near_it() {
        for step in 0..90u16 {
            let angle = f32::from(step);
            let near = schlick(0.04f32, angle.to_radians().cos());
            let apart = (near - mirrored::<f32>(1.0 / 1.5, angle)).abs();
            assert!(apart < 0.07, "{angle}: {near} is {apart} off");
        }
        assert_eq!((schlick(0.25f32, 1.0), schlick(0.25f32, 0.0)), (0.25, 1.0));
    }
}
