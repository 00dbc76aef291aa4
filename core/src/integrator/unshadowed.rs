//! The light of a place without any ray, for scan conversion.

use super::shaded_hit::{LampLight, ShadedHit};
use crate::color::LinearRgb;
use crate::material::PreparedMaterial;
use crate::math::{Ray, Real};
use crate::prepared::{Hit, PreparedScene};
use crate::shape::Geometry;
use crate::throughput::Throughput;

/// The light of a place, as if nothing stood before the lamps.
pub(crate) struct UnshadowedLight<R> {
    /// Ambient and diffuse light.
    pub(crate) scattered: LinearRgb<R>,
    /// Highlights, and the background where it is mirrored and seen through glass, half as bright at the rim.
    pub(crate) mirrored: LinearRgb<R>,
}

/// The light that leaves a hit of this color along the ray that met it.
pub(crate) fn unshadowed<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    ray: &Ray<R>,
    (hit, color): (&Hit<R>, LinearRgb<R>),
    material: &PreparedMaterial<'_, R>,
) -> UnshadowedLight<R> {
    let shaded = ShadedHit::new(ray, (hit, color), hit.surface.shading_normal, material, true);
    let (diffuses, shines) = (material.diffuse > R::ZERO, material.specular > R::ZERO);
    let mut sum = LampLight::NONE;
    for light in scene.lights {
        if let Some(facing) = shaded.facing(light, diffuses, shines) {
            let color = facing.share.map_or(light.color, |share| light.color * share);
            sum.add(&facing, material, color, Throughput::even(R::ONE));
        }
    }
    #[cfg(feature = "distributed")]
    let sky = {
        for area in scene.areas().iter().filter(|area| area.object != hit.object) {
            if let Some(seen) = area.seen_from(hit.surface.point, shaded.normal)
                && let Some(facing) = shaded.facing_from(seen.toward, seen.distance, seen.cosine)
            {
                sum.add(&facing, material, area.radiance.scaled(seen.weight), Throughput::even(R::ONE));
            }
        }
        // Of a sky without a closed form, the light from straight above the surface.
        let all = || scene.background.light_on(shaded.normal, None);
        let light = scene.sky().map(|_| all().unwrap_or_else(|| scene.background.color(shaded.normal)));
        light.map_or(LinearRgb::BLACK, |light| shaded.scattered(light))
    };
    #[cfg(not(feature = "distributed"))]
    let sky = LinearRgb::BLACK;
    let scattered = shaded.ambient_light(scene) + sky + sum.diffuse * color * material.diffuse;
    let mut mirrored = sum.specular * material.specular;
    if let Some(optics) = material.optics() {
        mirrored = mirrored * optics.reflection_color;
    }
    if material.sends_rays() {
        let (shares, refracted) = shaded.shares();
        let mut behind = shares.mirrored.of(scene.background.color(shaded.mirrored));
        if let Some(direction) = refracted {
            behind = behind + shares.refracted.of(scene.background.color(direction));
        }
        // Darker toward the rim: else nothing could be seen before a background of one color.
        let half = R::from_fraction(1 << 15);
        let cosine = -shaded.normal.dot(shaded.incoming);
        mirrored = mirrored + behind.scaled((half + half * cosine).larger(half).smaller(R::ONE));
    }
    UnshadowedLight { scattered, mirrored }
}
