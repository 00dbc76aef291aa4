//! Extensions of the models of Whitted and Phong: Fresnel's equations, Beer's law, lamps.

use glam::DVec3;
use rayline::{Falloff, Fresnel, Highlight, Lamp, Material, Optics};

use super::{color, vector};

/// The share of light that is left after a distance behind a surface, or in front of it (Beer's law).
pub(super) fn absorbed(optics: &Optics, is_behind: bool, length: f64) -> DVec3 {
    let coefficients = color(if is_behind { optics.absorption } else { optics.outside.absorption });
    // A coefficient of 0 absorbs nothing, even over an infinite distance.
    coefficients.map(|coefficient| if coefficient > 0.0 { (-coefficient * length).exp() } else { 1.0 })
}

/// The share of light that is left at a distance.
pub(super) fn faded(falloff: &Falloff, distance: f64) -> f64 {
    let [c, l, q] = [falloff.constant, falloff.linear, falloff.quadratic].map(f64::from);
    (1.0 / (c + l * distance + q * distance * distance)).min(1.0)
}

/// The light that a lamp sends to a point. `toward` is the direction from the point to the lamp.
pub(super) fn emitted(lamp: &Lamp, toward: DVec3, distance: f64) -> DVec3 {
    let mut light = color(lamp.color) * faded(&lamp.falloff, distance);
    if let Some(cone) = lamp.cone {
        let cosine = -vector(cone.direction).normalize().dot(toward);
        let (bright, dark) = (f64::from(cone.bright).cos(), f64::from(cone.dark).cos());
        let x = ((cosine - dark) / (bright - dark)).clamp(0.0, 1.0);
        light *= x * x * (3.0 - 2.0 * x);
    }
    light
}

/// The cosine whose power is the highlight.
pub(super) fn highlight(optics: &Optics, normal: DVec3, view: DVec3, toward: DVec3) -> f64 {
    match optics.highlight {
        // The mirrored view direction is 2 (N·V) N - V.
        Highlight::Phong => (2.0 * normal.dot(view) * normal - view).dot(toward),
        Highlight::BlinnPhong => (view + toward).normalize().dot(normal),
    }
}

/// The mirrored and the refracted share at an angle of incidence with this cosine. `refracted` is the cosine
/// of the refracted angle, if there is one.
pub(super) fn shares(
    material: &Material,
    optics: &Optics,
    (n1, n2): (f64, f64),
    cosine: f64,
    refracted: Option<f64>,
) -> (DVec3, DVec3) {
    let (mirror, glass) = (color(optics.reflection_color), color(optics.transmission_color));
    let (r, t) = (f64::from(material.reflectance), f64::from(material.transmittance));
    if t > 0.0 && refracted.is_none() {
        return (mirror * r + t, DVec3::ZERO);
    }
    let straight = ((n1 - n2) / (n1 + n2)).powi(2);
    let schlick = |share: DVec3, cosine: f64| share + (1.0 - share) * (1.0 - cosine).powi(5);
    let f = match optics.fresnel {
        Fresnel::Constant => return (mirror * r, glass * t),
        Fresnel::Schlick if t == 0.0 => return (schlick(mirror * r, cosine), DVec3::ZERO),
        Fresnel::Schlick => {
            let cosine = if n1 > n2 { refracted.unwrap() } else { cosine };
            schlick(DVec3::splat(straight), cosine).x
        }
        Fresnel::Exact => {
            // Fresnel's equations in terms of the angles: sin²(a - b) / sin²(a + b) and tan²(a - b) / tan²(a
            // + b).
            let (a, b) = (cosine.acos(), refracted.map_or(std::f64::consts::FRAC_PI_2, f64::acos));
            if a < 1e-6 {
                straight
            } else {
                let across = ((a - b).sin() / (a + b).sin()).powi(2);
                let along = ((a - b).tan() / (a + b).tan()).powi(2);
                (across + along) / 2.0
            }
        }
    };
    if t == 0.0 {
        (mirror * (r * f), DVec3::ZERO)
    } else {
        (mirror * ((r + t) * f), glass * ((r + t) * (1.0 - f)))
    }
}
