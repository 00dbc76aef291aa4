//! The most rays that a pixel can take, from the scene's description alone.

use rayline::limits::{AREA_RAYS, MAX_AREA_RAYS};
use rayline::{AreaLights, Background, Fresnel, Integrator, Light, Material, Scene, Settings};

/// The most rays that a pixel can take with these settings: samples · hits · (1 + shadow rays of a hit). It
/// holds wherever the camera goes.
pub fn most_rays(scene: &Scene<'_>, settings: Settings) -> u64 {
    let samples = u64::from(settings.sampling.samples);
    let shadow_rays: u64 = scene.lights.iter().map(|light| rays_toward(light, scene, settings)).sum();
    let hits = match settings.integrator {
        Integrator::PathTracing => u64::from(settings.bounces) + 1,
        _ => most_hits(scene.materials, settings.bounces),
    };
    let rays = samples.saturating_mul(hits).saturating_mul(1 + shadow_rays);
    rays.min(u64::from(settings.rays_per_pixel))
}

/// The most shadow rays toward a light from one hit.
fn rays_toward(light: &Light, scene: &Scene<'_>, settings: Settings) -> u64 {
    if settings.integrator == Integrator::PathTracing {
        return u64::from(!matches!(light, Light::Ambient { .. } | Light::Sky));
    }
    let is_closed = settings.area_lights == AreaLights::ClosedForm;
    let several = if settings.sampling.samples > 1 { AREA_RAYS } else { MAX_AREA_RAYS };
    match light {
        Light::Ambient { .. } => 0,
        Light::Object(_) if is_closed => 1,
        Light::Sky if is_closed && !matches!(scene.background, Background::Image(_)) => 0,
        Light::Object(_) | Light::Sky => u64::from(several),
        _ => 1,
    }
}

/// The most hits of a sample: each ray is followed by a mirrored ray, a refracted ray, or both.
fn most_hits(materials: &[Material<'_>], bounces: u8) -> u64 {
    let most = materials.iter().map(|material| {
        let Material { reflectance, transmittance, optics, .. } = *material;
        let refracts = transmittance > 0.0;
        let mirrors_at_angles = match optics.map_or(Fresnel::Constant, |optics| optics.fresnel) {
            Fresnel::Constant => false,
            Fresnel::Schlick => true,
            Fresnel::Exact => refracts,
        };
        u32::from(reflectance > 0.0 || mirrors_at_angles) + u32::from(refracts)
    });
    let following = u64::from(most.max().unwrap_or(0));
    (0..=u32::from(bounces)).map(|bounce| following.pow(bounce)).sum()
}
