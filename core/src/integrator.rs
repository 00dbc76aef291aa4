//! How much light comes along a ray: Whitted's recursion, without recursion.
//!
//! A hit may ask for two more rays, a mirrored and a refracted one. The mirrored ray is traced next and the
//! refracted one waits on a stack. A waiting ray is always followed by rays of one bounce more, so at most one
//! ray waits per bounce and [`MAX_BOUNCES`] places are enough. The order of rays, and so of additions, is fixed.

use heapless::Vec;

use crate::color::LinearRgb;
use crate::limits::MAX_BOUNCES;
use crate::material::{PreparedMaterial, Shares};
use crate::math::{Ray, Real, Vec3};
use crate::prepared::candidates::{Departure, ObjectSet};
use crate::prepared::{Hit, PreparedScene, Through};
use crate::probe::{Cut, Event, Probe, RayKind};
use crate::shape::Geometry;
use crate::share::Share;
use crate::surface::Surface;

/// When rays are no longer followed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds<R> {
    /// Rays of more bounces than this are left out.
    pub(crate) bounces: u8,
    /// Rays that bring a smaller share of their light than this are left out.
    pub(crate) cutoff: R,
}

/// What is known of a camera ray before it is traced.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight<'k> {
    /// The objects that it can meet; `None`: any.
    pub(crate) among: Option<ObjectSet>,
    /// What can shade what it meets.
    pub(crate) shades: Option<&'k Shades>,
}

/// What can stand between a place of one object and the first lights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shades {
    /// Position of the object.
    pub(crate) receiver: usize,
    pub(crate) among: [ObjectSet; LIGHTS],
}

/// How many lights [`Shades`] are known of.
pub(crate) const LIGHTS: usize = 4;

/// The rays that one pixel may still spend.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayBudget(pub(crate) u32);

impl RayBudget {
    /// Takes one ray, if there is one.
    fn spend(&mut self) -> bool {
        match self.0.checked_sub(1) {
            Some(left) => {
                self.0 = left;
                true
            }
            None => false,
        }
    }
}

/// A ray that is still to be traced.
#[derive(Clone, Copy, Debug)]
struct PendingRay<R> {
    ray: Ray<R>,
    /// Share of its light that reaches the pixel, in each channel.
    throughput: Share<R>,
    bounces: u8,
    kind: RayKind,
    /// The surface that it leaves; of a camera ray, none.
    from: Departure,
}

/// The light that comes to the origin of a camera ray from where it points.
pub(crate) fn radiance<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    ray: Ray<R>,
    sight: Sight<'_>,
    bounds: &Bounds<R>,
    rays: &mut RayBudget,
    probe: &mut impl Probe<R>,
) -> LinearRgb<R> {
    // Counted here, and told at the end.
    let budget = rays;
    let rays = &mut RayBudget(budget.0);
    let mut light = LinearRgb::BLACK;
    let mut waiting: Vec<PendingRay<R>, { MAX_BOUNCES as usize }> = Vec::new();
    let mut next = PendingRay {
        ray,
        throughput: Share::even(R::ONE),
        bounces: 0,
        kind: RayKind::Camera,
        from: Departure::NONE,
    };
    loop {
        let PendingRay { ray, throughput, bounces, kind, from } = next;
        if !rays.spend() {
            probe.record(Event::Cut(Cut::Rays));
            break;
        }
        probe.record(Event::Ray { kind, ray, bounces, throughput: throughput.largest() });
        let from = if kind == RayKind::Camera { None } else { Some(from) };
        let Some((mut hit, mut material)) = scene.closest_hit_from(&ray, from, sight.among) else {
            let color = scene.background.color(ray.direction);
            probe.record(Event::Miss { color });
            let throughput = scene.dimmed(throughput, from, kind == RayKind::Reflected, None);
            light = light + throughput.of(color);
            if !take(&mut waiting, &mut next) {
                break;
            }
            continue;
        };
        let throughput = scene.dimmed(throughput, from, kind == RayKind::Reflected, Some(hit.t));
        let mapped;
        if !material.maps.is_empty() {
            let uv = |surface: &Surface<R>| scene.uv(hit.object, surface);
            mapped = material.mapped(&hit.surface, uv);
            let normal = material.maps.bumped(&hit.surface, ray.direction, uv);
            (hit.surface.shading_normal, material) = (normal, &mapped);
        }
        let vertex = Vertex::new(scene, &ray, hit, material, kind, probe);
        let shades =
            sight.shades.filter(|shades| kind == RayKind::Camera && shades.receiver == vertex.hit.object);
        light = light + throughput.of(vertex.local_light(scene, shades, rays, probe));

        // What is left of the throughput for a ray with this share of it; 0 where it is not to be followed.
        let mut followed = |share: Share<R>| {
            let throughput = throughput * share;
            let largest = throughput.largest();
            if !(largest > R::ZERO) {
                return None;
            }
            if bounces >= bounds.bounces {
                probe.record(Event::Cut(Cut::Bounces));
                return None;
            }
            if largest < bounds.cutoff {
                probe.record(Event::Cut(Cut::Throughput));
                return None;
            }
            Some(throughput)
        };
        let (Shares { mirrored, refracted }, direction) = vertex.shares();
        let mirrors = followed(mirrored);
        if let Some(direction) = direction
            && let Some(throughput) = followed(refracted)
            // There is always room, as shown above.
            && waiting.push(vertex.leave(direction, throughput, bounces, RayKind::Refracted)).is_err()
        {
            probe.record(Event::Cut(Cut::Bounces));
        }
        if let Some(mirrors) = mirrors {
            next = vertex.leave(vertex.mirrored, mirrors, bounces, RayKind::Reflected);
        } else if !take(&mut waiting, &mut next) {
            break;
        }
    }
    budget.0 = rays.0;
    light
}

/// Takes the last ray that waits, if there is one. Without an `Option` of it, which would be copied byte by byte.
#[inline(always)]
fn take<R: Real, const N: usize>(waiting: &mut Vec<PendingRay<R>, N>, next: &mut PendingRay<R>) -> bool {
    let Some(last) = waiting.last() else { return false };
    *next = *last;
    waiting.truncate(waiting.len().saturating_sub(1));
    true
}

/// A hit, seen from the ray that met it.
struct Vertex<'s, R: Real> {
    hit: Hit<R>,
    material: &'s PreparedMaterial<'s, R>,
    /// The color of the texture.
    color: LinearRgb<R>,
    /// Direction of the ray that came.
    incoming: Vec3<R>,
    /// The shading normal on the side that the ray came from.
    normal: Vec3<R>,
    /// Cosine of the angle between that normal and the way back: 0 or more.
    cosine: R,
    /// Direction of the mirrored ray.
    mirrored: Vec3<R>,
}

impl<'s, R: Real> Vertex<'s, R> {
    fn new<S: Geometry>(
        scene: &PreparedScene<'_, R, S>,
        ray: &Ray<R>,
        hit: Hit<R>,
        material: &'s PreparedMaterial<'s, R>,
        kind: RayKind,
        probe: &mut impl Probe<R>,
    ) -> Self {
        let incoming = ray.direction;
        let (normal, cosine) = hit.surface.shading_normal.facing(incoming);
        let color = material.color.color(&hit.surface, || scene.uv(hit.object, &hit.surface));
        probe.record(Event::Hit { kind, hit, color });
        let mirrored = incoming + normal * (cosine + cosine);
        Self { hit, material, color, incoming, normal, cosine, mirrored }
    }

    /// A ray that is to be followed from here, after so many bounces.
    fn leave(&self, direction: Vec3<R>, throughput: Share<R>, bounces: u8, kind: RayKind) -> PendingRay<R> {
        let (ray, from) = (self.spawn(direction), self.departure(direction));
        PendingRay { ray, throughput, bounces: bounces.wrapping_add(1), kind, from }
    }

    /// A ray that leaves the surface.
    fn spawn(&self, direction: Vec3<R>) -> Ray<R> {
        let surface = &self.hit.surface;
        Ray::spawn(surface.point, surface.normal, direction, surface.magnitude)
    }

    /// To which side of the surface a ray of this direction leaves it.
    fn departure(&self, direction: Vec3<R>) -> Departure {
        let outward = !(self.hit.surface.normal.dot(direction) < R::ZERO);
        Departure { object: self.hit.object, outward }
    }

    /// Ambient, diffuse and specular light that leaves along the incoming ray.
    fn local_light<S: Geometry>(
        &self,
        scene: &PreparedScene<'_, R, S>,
        shades: Option<&Shades>,
        rays: &mut RayBudget,
        probe: &mut impl Probe<R>,
    ) -> LinearRgb<R> {
        let (material, optics) = (self.material, self.material.optics());
        let mut ambient = self.color * material.ambient;
        if let Some(light) = scene.ambient() {
            ambient = ambient * light;
        }
        if let Some(optics) = optics {
            ambient = ambient + optics.emission;
        }
        let (diffuses, shines) = (material.diffuse > R::ZERO, material.specular > R::ZERO);
        if !(diffuses || shines) {
            return ambient;
        }
        // What the lights bring by Lambert's law and by Phong's.
        let (mut diffuse, mut specular) = (LinearRgb::BLACK, LinearRgb::BLACK);
        for (index, light) in scene.lights.iter().enumerate() {
            let seen = light.seen_from(self.hit.surface.point, self.normal);
            let Some((toward, distance, cosine)) = seen else { continue };
            let along = match optics {
                _ if !shines => R::ZERO,
                None => self.mirrored.dot(toward),
                Some(optics) => optics.highlight_cosine(self.normal, self.incoming, self.mirrored, toward),
            };
            let glints = shines && material.shininess.is_visible(along);
            if !(diffuses || glints) {
                continue;
            }
            let mut color = light.color;
            if let Some(lamp) = light.lamp() {
                let share = lamp.share(toward, distance);
                if !(share > R::ZERO) {
                    continue;
                }
                color = color * share;
            }
            if !rays.spend() {
                probe.record(Event::Cut(Cut::Rays));
                break;
            }
            let shades = shades.and_then(|shades| shades.among.get(index)).copied();
            let from = self.departure(toward);
            let in_the_way = scene.in_the_way(from, self.hit.surface.magnitude, index, toward, shades);
            let mut through = Through::All;
            if in_the_way.is_none_or(|objects| !objects.is_empty()) {
                through = scene.light_through_among(&self.spawn(toward), distance, in_the_way);
            }
            let mut highlight = R::ZERO;
            let through = match through {
                Through::All => Share::even(R::ONE),
                Through::Some(through) => through,
                Through::Nothing => Share::even(R::ZERO),
                Through::TooManyLayers => {
                    probe.record(Event::Cut(Cut::ShadowLayers));
                    Share::even(R::ZERO)
                }
            };
            if through.largest() > R::ZERO {
                diffuse = diffuse + (through * cosine).of(color);
                // The power takes long: it is for what is seen.
                highlight = if glints { material.shininess.power_of(along) } else { R::ZERO };
                if highlight > R::ZERO {
                    specular = specular + (through * highlight).of(color);
                }
            }
            if probe.is_watching() {
                let shown = self.color * (material.diffuse * cosine);
                let highlight = LinearRgb::even(material.specular * highlight);
                let highlight = optics.map_or(highlight, |optics| optics.reflection_color * highlight);
                let shown = through.of(color * (shown + highlight));
                probe.record(Event::Light { light: index, toward, through: through.largest(), shown });
            }
        }
        if let Some(optics) = optics {
            specular = specular * optics.reflection_color;
        }
        ambient + self.color * diffuse * material.diffuse + specular * material.specular
    }

    /// The shares of light that is mirrored and refracted, and the direction of the refracted ray, if there is one.
    #[inline(always)]
    fn shares(&self) -> (Shares<R>, Option<Vec3<R>>) {
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
        Some(self.incoming * eta + self.normal * (eta * self.cosine - cosine_squared.sqrt()))
    }
}
