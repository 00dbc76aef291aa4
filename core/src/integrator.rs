//! How much light comes along a ray: Whitted's recursion, without recursion.
//!
//! A hit may ask for two more rays, a mirrored and a refracted one. The mirrored ray is traced next and the
//! refracted one waits on a stack. A waiting ray is always followed by rays of one bounce more, so at most one
//! ray waits per bounce and [`MAX_BOUNCES`] places are enough. The order of rays, and so of additions, is fixed.

use heapless::Vec;

use crate::color::LinearRgb;
use crate::limits::MAX_BOUNCES;
use crate::material::PreparedMaterial;
use crate::math::{Ray, Real, Vec3};
use crate::prepared::candidates::{Departure, ObjectSet};
use crate::prepared::{Hit, PreparedScene};
use crate::probe::{Cut, Event, Probe, RayKind};
use crate::shape::Geometry;

/// When rays are no longer followed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds<R> {
    /// Rays of more bounces than this are left out.
    pub(crate) bounces: u8,
    /// Rays that bring a smaller share of their light than this are left out.
    pub(crate) cutoff: R,
}

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
    /// Share of its light that reaches the pixel.
    throughput: R,
    bounces: u8,
    kind: RayKind,
    /// The surface that it leaves.
    from: Option<Departure>,
}

/// The light that comes to the origin of `ray` from where it points, if it can meet none but the objects
/// `among`.
pub(crate) fn radiance<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    ray: Ray<R>,
    among: Option<ObjectSet>,
    bounds: &Bounds<R>,
    rays: &mut RayBudget,
    probe: &mut impl Probe<R>,
) -> LinearRgb<R> {
    let mut light = LinearRgb::BLACK;
    let mut waiting: Vec<PendingRay<R>, { MAX_BOUNCES as usize }> = Vec::new();
    let mut next =
        Some(PendingRay { ray, throughput: R::ONE, bounces: 0, kind: RayKind::Camera, from: None });
    while let Some(PendingRay { ray, throughput, bounces, kind, from }) =
        next.take().or_else(|| waiting.pop())
    {
        if !rays.spend() {
            probe.record(Event::Cut(Cut::Rays));
            break;
        }
        probe.record(Event::Ray { kind, ray, bounces, throughput });
        let hit = match from {
            Some(from) => scene.closest_hit_leaving(&ray, from),
            None => scene.closest_hit_among(&ray, among),
        };
        let Some(hit) = hit else {
            probe.record(Event::Miss);
            light = light + scene.background * throughput;
            continue;
        };
        // Every object has a material: that was checked when the scene was prepared.
        let Some(material) = scene.material(hit.object) else { continue };
        let vertex = Vertex::new(&ray, &hit, material, kind, probe);
        light = light + vertex.local_light(scene, rays, probe) * throughput;

        let mut follow = |share: R, direction: Vec3<R>, kind| {
            let throughput = throughput * share;
            if !(throughput > R::ZERO) {
                return None;
            }
            if bounces >= bounds.bounces {
                probe.record(Event::Cut(Cut::Bounces));
                return None;
            }
            if throughput < bounds.cutoff {
                probe.record(Event::Cut(Cut::Throughput));
                return None;
            }
            let (ray, from) = vertex.spawn(direction);
            Some(PendingRay { ray, throughput, bounces: bounces + 1, kind, from: Some(from) })
        };
        let (mut reflectance, mut refracted) = (material.reflectance, None);
        if material.transmittance > R::ZERO {
            refracted = vertex.refracted();
            if refracted.is_none() {
                // Total internal reflection: what cannot leave is mirrored.
                reflectance = reflectance + material.transmittance;
            }
        }
        next = follow(reflectance, vertex.mirrored, RayKind::Reflected);
        let refracted =
            refracted.and_then(|direction| follow(material.transmittance, direction, RayKind::Refracted));
        if let Some(refracted) = refracted {
            // There is always room, as shown above.
            if waiting.push(refracted).is_err() {
                probe.record(Event::Cut(Cut::Bounces));
            }
        }
    }
    light
}

/// A hit, seen from the ray that met it.
struct Vertex<'s, R: Real> {
    hit: &'s Hit<R>,
    material: &'s PreparedMaterial<R>,
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
    fn new(
        ray: &Ray<R>,
        hit: &'s Hit<R>,
        material: &'s PreparedMaterial<R>,
        kind: RayKind,
        probe: &mut impl Probe<R>,
    ) -> Self {
        let incoming = ray.direction;
        let normal = hit.surface.shading_normal.facing(incoming);
        let cosine = -normal.dot(incoming);
        let color = material.color.color(&hit.surface);
        probe.record(Event::Hit { kind, hit: *hit, color });
        let mirrored = incoming + normal * (cosine + cosine);
        Self { hit, material, color, incoming, normal, cosine, mirrored }
    }

    /// A ray that leaves the surface, and to which side of it.
    fn spawn(&self, direction: Vec3<R>) -> (Ray<R>, Departure) {
        let surface = &self.hit.surface;
        let outward = !(surface.normal.dot(direction) < R::ZERO);
        let ray = Ray::spawn(surface.point, surface.normal, direction, surface.magnitude);
        (ray, Departure { object: self.hit.object, outward })
    }

    /// Ambient, diffuse and specular light that leaves along the incoming ray.
    fn local_light<S: Geometry>(
        &self,
        scene: &PreparedScene<'_, R, S>,
        rays: &mut RayBudget,
        probe: &mut impl Probe<R>,
    ) -> LinearRgb<R> {
        let material = self.material;
        let mut light = self.color * material.ambient;
        if !(material.diffuse > R::ZERO || material.specular > R::ZERO) {
            return light;
        }
        for (index, source) in scene.lights.iter().enumerate() {
            let seen = source.seen_from(self.hit.surface.point, self.normal);
            let Some((toward, distance, cosine)) = seen else { continue };
            let highlight = material.specular * material.shininess.power_of(self.mirrored.dot(toward));
            let diffuse = material.diffuse * cosine;
            if !(diffuse > R::ZERO || highlight > R::ZERO) {
                continue;
            }
            if !rays.spend() {
                probe.record(Event::Cut(Cut::Rays));
                break;
            }
            let (ray, from) = self.spawn(toward);
            let (through, cut) =
                scene.light_through_leaving(&ray, distance, from, self.hit.surface.magnitude, index);
            if cut {
                probe.record(Event::Cut(Cut::ShadowLayers));
            }
            let mut shown = LinearRgb::BLACK;
            if through > R::ZERO {
                let diffuse = self.color * diffuse;
                let share =
                    LinearRgb::new(diffuse.r + highlight, diffuse.g + highlight, diffuse.b + highlight);
                shown = source.color * share * through;
            }
            probe.record(Event::Light { light: index, toward, through, shown });
            light = light + shown;
        }
        light
    }

    /// The direction of the refracted ray by Snell's law (Glassner (ed.), "An Introduction to Ray Tracing",
    /// 1989, p. 289); `None` under total internal reflection.
    ///
    /// Which side is inside is told by the geometric normal alone: in front of a surface the index is 1, behind
    /// it the material's. Nested and overlapping glass follows the same rule, surface by surface.
    fn refracted(&self) -> Option<Vec3<R>> {
        let entering = self.hit.surface.normal.dot(self.incoming) < R::ZERO;
        let eta = if entering { self.material.eta_entering } else { self.material.eta_leaving };
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
