//! A place that a ray met: what light leaves it along the ray, and which rays are to be followed from there.

use super::{PendingRay, RayBudget, Shades};
use crate::color::LinearRgb;
use crate::fresh::afresh;
use crate::material::{PreparedMaterial, Shares};
use crate::math::{Ray, Real, Vec3};
use crate::prepared::candidates::Departure;
use crate::prepared::{Hit, PreparedScene, Through};
use crate::probe::{Cut, Event, Probe, RayKind};
use crate::shape::Geometry;
use crate::share::Share;
use crate::surface::Surface;

/// A hit, seen from the ray that met it.
pub(super) struct Vertex<'s, R: Real> {
    pub(super) hit: &'s Hit<R>,
    material: &'s PreparedMaterial<'s, R>,
    /// The color of the texture.
    color: LinearRgb<R>,
    /// Direction of the ray that came.
    incoming: Vec3<R>,
    /// The shading normal on the side that the ray came from.
    normal: Vec3<R>,
    /// Whether that is the side that the geometric normal is on, where both are known to be the same but for that, and to compute it
    /// takes longer than to remember it: in floating point to remember it takes an M4F 1.03 times the instructions.
    is_outside: Option<bool>,
    /// Cosine of the angle between that normal and the way back: 0 or more.
    cosine: R,
    /// Direction of the mirrored ray.
    pub(super) mirrored: Vec3<R>,
}

impl<'s, R: Real> Vertex<'s, R> {
    /// With a unit normal to shade with, which a map may have turned, where such a ray ends and this share of light reaches the pixel.
    #[inline(always)]
    pub(super) fn new<S: Geometry>(
        scene: &PreparedScene<'_, R, S>,
        ray: &Ray<R>,
        hit: &'s Hit<R>,
        shading_normal: Vec3<R>,
        material: &'s PreparedMaterial<'s, R>,
        (kind, throughput): (RayKind, Share<R>),
        probe: &mut impl Probe<R>,
    ) -> Self {
        let incoming = ray.direction;
        let (normal, cosine, is_turned) = shading_normal.facing(incoming);
        let is_geometric = R::IS_FIXED_POINT && shading_normal == hit.surface.normal;
        let is_outside = is_geometric.then_some(!is_turned);
        let color = material.color.color(&hit.surface, || scene.uv(hit.object, &hit.surface));
        let shown = Hit { surface: Surface { shading_normal, ..hit.surface }, ..*hit };
        // Nobody asks what is neither shiny nor mirrors where that way goes, unless it is beside a place that does; to tell takes time as well.
        let is_asked = !R::IS_FIXED_POINT
            || probe.asks_mirrored()
            || material.specular > R::ZERO
            || material.sends_rays()
            || probe.is_watching() && !material.maps.is_empty();
        let mirrored = if is_asked { incoming + normal * (cosine + cosine) } else { incoming };
        let throughput = throughput.color();
        probe.record(Event::Hit { kind, ray: *ray, hit: shown, color, mirrored, throughput });
        Self { hit, material, color, incoming, normal, is_outside, cosine, mirrored }
    }

    /// A ray that is to be followed from here, after so many bounces.
    pub(super) fn leave<S: Geometry>(
        &self,
        scene: &PreparedScene<'_, R, S>,
        direction: Vec3<R>,
        throughput: Share<R>,
        bounces: u8,
        kind: RayKind,
    ) -> PendingRay<R> {
        let from = self.departure(direction, kind == RayKind::Refracted);
        let ray = self.spawn(direction, from);
        PendingRay {
            ray,
            throughput,
            bounces: bounces.wrapping_add(1),
            kind,
            from,
            among: scene.leaving(from),
        }
    }

    /// A ray that leaves the surface, to the side that [`departure`](Self::departure) tells.
    pub(super) fn spawn(&self, direction: Vec3<R>, from: Departure) -> Ray<R> {
        let Surface { point, normal, magnitude, .. } = self.hit.surface;
        Ray::spawn_to(from.outward, point, normal, direction, magnitude)
    }

    /// To which side of the surface a ray of this direction leaves it, which goes `through` the surface or not.
    pub(super) fn departure(&self, direction: Vec3<R>, through: bool) -> Departure {
        let outward = match self.is_outside {
            Some(is_outside) => is_outside != through,
            None => Ray::is_outward(self.hit.surface.normal, direction),
        };
        Departure { object: self.hit.object, outward }
    }

    /// Ambient, diffuse and specular light that leaves along the incoming ray.
    pub(super) fn local_light<S: Geometry>(
        &self,
        scene: &PreparedScene<'_, R, S>,
        shading: &mut impl Shading<R>,
        rays: &mut RayBudget,
        probe: &mut impl Probe<R>,
    ) -> LinearRgb<R> {
        let (material, optics) = (self.material, self.material.optics());
        let mut ambient = LinearRgb::BLACK;
        if !R::IS_FIXED_POINT || material.ambient > R::ZERO {
            ambient = self.color * material.ambient;
            if let Some(light) = scene.ambient() {
                ambient = light * ambient;
            }
        }
        if let Some(optics) = optics {
            ambient = ambient + optics.emission;
        }
        probe.record(Event::Surface { shown: ambient });
        let (diffuses, shines) = (material.diffuse > R::ZERO, material.specular > R::ZERO);
        if !(diffuses || shines) {
            return ambient;
        }
        // What the lights bring by Lambert's law and by Phong's.
        let (mut diffuse, mut specular) = (LinearRgb::BLACK, LinearRgb::BLACK);
        let (mut is_lit, mut is_glinting) = (false, false);
        for (index, light) in scene.lights.iter().enumerate() {
            let scene = afresh(scene);
            // Where all that a light could bring is a highlight.
            if !diffuses && optics.is_none() && !scene.may_glint(self.hit.object, index, self.mirrored) {
                continue;
            }
            let seen = light.seen_from(self.hit.surface.point, self.normal);
            let Some((toward, distance, cosine)) = seen else { continue };
            let along = match optics {
                _ if !shines => R::ZERO,
                None if !material.shininess.may_be_visible(self.mirrored, toward) => R::ZERO,
                None => self.mirrored.dot(toward),
                Some(optics) => optics.highlight_cosine(self.normal, self.incoming, self.mirrored, toward),
            };
            let glints = shines && material.shininess.is_visible(along);
            if !(diffuses || glints) {
                continue;
            }
            let share = light.share(self.hit.surface.point, toward, distance);
            if share.is_some_and(|share| !(share > R::ZERO)) {
                continue;
            }
            if !rays.spend() {
                probe.record(Event::Cut(Cut::Rays));
                break;
            }
            let through = shading.through(scene, self, index, toward, distance);
            if let Through::TooManyLayers = through {
                probe.record(Event::Cut(Cut::ShadowLayers));
            }
            // Not before the way is known: it would have to be kept meanwhile.
            let color = share.map_or(light.color, |share| light.color * share);
            let mut highlight = R::ZERO;
            let way = through.times(R::ONE);
            if way.largest() > R::ZERO {
                diffuse = diffuse + (way * cosine).of_gray(color);
                is_lit = true;
                // The power takes long: it is for what is seen.
                highlight = if glints { material.shininess.power_of(along) } else { R::ZERO };
                if highlight > R::ZERO {
                    specular = specular + (way * highlight).of_gray(color);
                    is_glinting = true;
                }
            }
            if probe.is_watching() {
                let shown = self.color * (material.diffuse * cosine);
                let highlight = LinearRgb::even(material.specular * highlight);
                let highlight = optics.map_or(highlight, |optics| optics.reflection_color * highlight);
                // Both may add up to 2, of which there is no share.
                let LinearRgb { r, g, b } = shown + highlight;
                let through = through.times(R::ONE);
                let shown = through.of(LinearRgb::new(color.r * r, color.g * g, color.b * b));
                probe.record(Event::Light { light: index, toward, through: through.largest(), shown });
            }
        }
        // Nothing is added where there is nothing: most points have no highlight.
        if !is_lit {
            return ambient;
        }
        let scattered = ambient + diffuse * self.color * material.diffuse;
        if !is_glinting {
            return scattered;
        }
        if let Some(optics) = optics {
            specular = specular * optics.reflection_color;
        }
        scattered + specular * material.specular
    }

    /// The shares of light that is mirrored and refracted, and the direction of the refracted ray, if there is one.
    #[inline(always)]
    pub(super) fn shares(&self) -> (Shares<R>, Option<Vec3<R>>) {
        let PreparedMaterial { reflectance, transmittance, .. } = *self.material;
        let optics = self.material.optics();
        let is_glass = transmittance > R::ZERO;
        let refraction = if is_glass { self.refracted() } else { None };
        let Some(optics) = optics else {
            // Total internal reflection: what cannot leave is mirrored.
            let mirrored =
                if is_glass && refraction.is_none() { reflectance + transmittance } else { reflectance };
            let shares = Shares { mirrored: Share::even(mirrored), refracted: Share::even(transmittance) };
            return (shares, refraction);
        };
        // Opaque lacquer mirrors as if light went on behind it.
        let behind = if is_glass || !optics.needs_angle_behind() { refraction } else { self.refracted() };
        let cosine = match behind {
            Some(direction) => Some(self.normal.dot(direction).abs()),
            None if is_glass => None,
            None => Some(self.cosine),
        };
        (optics.shares((reflectance, transmittance), self.cosine, self.eta(), cosine), refraction)
    }

    /// The ratio of the indices of refraction for a ray that goes on: that of the side it came from over that of the other.
    fn eta(&self) -> R {
        let entering = self.hit.surface.normal.dot(self.incoming) < R::ZERO;
        if entering { self.material.eta_entering } else { self.material.eta_leaving }
    }

    /// The direction of the refracted ray by Snell's law (Glassner (ed.), "An Introduction to Ray Tracing",
    /// 1989, p. 289); `None` under total internal reflection.
    ///
    /// Which side is inside is told by the geometric normal alone: a material states the indices on both sides of a surface, so
    /// that no ray needs to remember what it is in. Rejected: a list of the media that a ray is in, which every pending ray would carry
    /// along, and from which a ray that grazes an edge drops out for ever.
    fn refracted(&self) -> Option<Vec3<R>> {
        let eta = self.eta();
        if eta == R::ONE {
            // Straight through, with the very same bits.
            return Some(self.incoming);
        }
        let cosine_squared = R::ONE - eta * eta * (R::ONE - self.cosine * self.cosine);
        if cosine_squared < R::ZERO {
            return None;
        }
        let refracted = self.incoming * eta + self.normal * (eta * self.cosine - cosine_squared.sqrt());
        // What leaves a high index, or one surface after the other, is off by what `incoming` was times the square of the ratio: in `f32` by
        // 3e-6 after glass, and by 6e-4 at 18. What makes rays faster takes directions for unit vectors. What enters is off by less.
        let is_unit = eta < R::ONE || (refracted.length_squared() - R::ONE).abs() < R::RAY_OFFSET;
        if is_unit { Some(refracted) } else { refracted.normalized() }
    }
}

/// What is known of the ways from hits to lights before they are looked along.
pub(super) trait Shading<R: Real> {
    /// The hit lies on this object.
    #[inline(always)]
    fn begin_at(&mut self, _object: usize) {}

    /// How much comes through to a hit from a light, which is at this distance in the unit direction `toward`.
    fn through<S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        vertex: &Vertex<'_, R>,
        light: usize,
        toward: Vec3<R>,
        distance: R,
    ) -> Through<Share<R>>;
}

impl<R: Real> Shading<R> for &Shades {
    #[inline(always)]
    fn begin_at(&mut self, object: usize) {
        if self.receiver != object {
            *self = &Shades::UNKNOWN;
        }
    }

    #[inline(always)]
    fn through<S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        vertex: &Vertex<'_, R>,
        light: usize,
        toward: Vec3<R>,
        distance: R,
    ) -> Through<Share<R>> {
        let from = vertex.departure(toward, false);
        let in_the_way =
            scene.in_the_way(from, vertex.hit.surface.magnitude, light, toward, self.before(light));
        if in_the_way.is_none_or(|objects| !objects.is_empty()) {
            scene.light_through_among(&vertex.spawn(toward, from), distance, in_the_way)
        } else {
            Through::All
        }
    }
}
