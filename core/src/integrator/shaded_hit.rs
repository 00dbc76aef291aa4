//! A hit, ready to be shaded: the light that leaves it toward the eye, and the rays that go on from it.

use super::Trace;
use super::pending_ray::PendingRay;
use crate::color::LinearRgb;
use crate::light::PreparedLight;
use crate::material::{PreparedMaterial, PreparedOptics, Shares};
use crate::math::{Ray, Real, Vec3};
use crate::prepared::{Departure, Hit, PreparedScene, Through};
use crate::probe::{Cut, Event, Probe, RayKind};
use crate::sampling::{Dimension, RayNumbers, lobe};
use crate::shape::Geometry;
use crate::surface::Surface;
use crate::throughput::Throughput;

/// A hit with the values for shading, as seen from the ray that met it.
pub(super) struct ShadedHit<'s, R: Real> {
    pub(super) hit: &'s Hit<R>,
    pub(super) material: &'s PreparedMaterial<'s, R>,
    /// The color of the texture.
    pub(super) color: LinearRgb<R>,
    /// Direction of the ray that met the hit.
    pub(super) incoming: Vec3<R>,
    /// The shading normal, on the side that the ray came from.
    pub(super) normal: Vec3<R>,
    /// Cosine of the angle between `normal` and the way back: 0 or more.
    cosine: R,
    /// Direction of the reflected ray; for a matte material without a probe, any direction.
    pub(super) mirrored: Vec3<R>,
    /// Whether the ray came from the side of the geometric normal, where that is known without a product: in
    /// fixed point, where products are slow, and if the normal to shade with is the geometric one.
    is_outside: Option<bool>,
}

/// A light in front of a surface, before its shadow ray.
pub(super) struct FacingLight<R> {
    /// Unit vector toward the light.
    pub(super) toward: Vec3<R>,
    pub(super) distance: R,
    /// Cosine of the angle between `toward` and the normal.
    pub(super) cosine: R,
    /// The cosine whose power is the highlight, if the highlight can be visible.
    pub(super) highlight_cosine: Option<R>,
    /// The share of its light that a lamp with falloff or a cone sends here.
    pub(super) share: Option<R>,
}

/// The light of all lamps at a surface.
pub(super) struct LampLight<R> {
    pub(super) diffuse: LinearRgb<R>,
    pub(super) specular: LinearRgb<R>,
    is_lit: bool,
    has_highlight: bool,
}

/// Sends shadow rays from hits to lights. Implementations differ in how they find the objects that can be in
/// the way.
pub(super) trait ShadowRays<R: Real> {
    /// The next hit lies on this object.
    // Forced, as in the rest of this file: without it, `classic` takes an M3 1.09 times the instructions, and
    // an M0 1.07 times.
    #[inline(always)]
    fn begin_at(&mut self, _object: usize) {}

    /// How much light gets through to a hit from the light at this position in the scene. The light is at
    /// `distance` in the unit direction `toward`.
    fn through<S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        hit: &ShadedHit<'_, R>,
        light: usize,
        toward: Vec3<R>,
        distance: R,
    ) -> Through<Throughput<R>>;
}

impl<'s, R: Real> ShadedHit<'s, R> {
    /// A hit on a surface of this color, with the unit `normal` to shade with, which a map may have turned.
    #[inline(always)]
    pub(super) fn new(
        ray: &Ray<R>,
        (hit, color): (&'s Hit<R>, LinearRgb<R>),
        normal: Vec3<R>,
        material: &'s PreparedMaterial<'s, R>,
        has_probe: bool,
    ) -> Self {
        let incoming = ray.direction;
        let is_geometric = R::IS_FIXED_POINT && normal == hit.surface.normal;
        let (normal, cosine, is_turned) = normal.facing(incoming);
        let is_outside = is_geometric.then_some(!is_turned);
        // Skip the mirrored direction of matte materials: only highlights, mirrors and probes use it.
        let is_used = !R::IS_FIXED_POINT || material.specular > R::ZERO || material.sends_rays() || has_probe;
        let mirrored = if is_used { incoming + normal * (cosine + cosine) } else { incoming };
        Self { hit, material, color, incoming, normal, cosine, mirrored, is_outside }
    }

    /// The side of the surface to which a ray of this direction leaves it: one that goes `through` the
    /// surface, or one that stays on the side of the incoming ray.
    #[inline(always)]
    pub(super) fn departure(&self, direction: Vec3<R>, through: bool) -> Departure {
        match self.is_outside {
            Some(is_outside) => Departure { object: self.hit.object, outward: is_outside != through },
            None => self.hit.departure(direction),
        }
    }

    /// The event that reports the hit, of a ray of this kind and throughput, with the normal to shade with.
    #[inline(always)]
    pub(super) fn event(
        &self,
        ray: &Ray<R>,
        (kind, throughput): (RayKind, Throughput<R>),
        shading_normal: Vec3<R>,
    ) -> Event<R> {
        let Self { color, mirrored, .. } = *self;
        let hit = Hit { surface: Surface { shading_normal, ..self.hit.surface }, ..*self.hit };
        Event::Hit { kind, ray: *ray, hit, color, mirrored, throughput: throughput.color() }
    }

    /// The ray that goes on from here into a direction, after so many bounces.
    pub(super) fn leave<S: Geometry>(
        &self,
        scene: &PreparedScene<'_, R, S>,
        direction: Vec3<R>,
        throughput: Throughput<R>,
        bounces: u8,
        kind: RayKind,
    ) -> PendingRay<R> {
        let from = self.departure(direction, kind == RayKind::Refracted);
        let (ray, bounces) = (self.hit.spawn(direction, from), bounces.wrapping_add(1));
        PendingRay { ray, throughput, bounces, kind, from, among: scene.leaving(from) }
    }

    /// Ambient, diffuse and specular light that leaves the hit along the incoming ray.
    pub(super) fn local_light<S: Geometry, P: Probe<R>>(
        &self,
        trace: &mut Trace<'_, '_, R, S, P>,
        shadow_rays: &mut impl ShadowRays<R>,
    ) -> LinearRgb<R> {
        let ambient = self.ambient_light(trace.scene);
        trace.probe.record(Event::Surface { shown: ambient });
        self.lamp_light(ambient, trace, shadow_rays)
    }

    /// Diffuse and specular light of all lamps without a size, beside `ambient` light.
    #[inline]
    pub(super) fn lamp_light<S: Geometry, P: Probe<R>>(
        &self,
        ambient: LinearRgb<R>,
        trace: &mut Trace<'_, '_, R, S, P>,
        shadow_rays: &mut impl ShadowRays<R>,
    ) -> LinearRgb<R> {
        let (diffuses, shines) = (self.material.diffuse > R::ZERO, self.material.specular > R::ZERO);
        if !(diffuses || shines) {
            return ambient;
        }
        let mut sum = LampLight::NONE;
        // Mirrors and glass show a light only as a highlight, in a small part of their surface. In floating
        // point the test takes as long as what it saves; an M0 takes 0.96 times the instructions.
        let is_mirror = R::IS_FIXED_POINT && !diffuses && self.material.optics().is_none();
        for (index, light) in trace.scene.lights.iter().enumerate() {
            if is_mirror && !trace.scene.may_have_highlight(self.hit.object, index, self.mirrored) {
                continue;
            }
            let Some(facing) = self.facing(light, diffuses, shines) else { continue };
            if !trace.rays.spend() {
                trace.probe.record(Event::Cut(Cut::Rays));
                break;
            }
            let through = shadow_rays.through(trace.scene, self, index, facing.toward, facing.distance);
            let color = facing.share.map_or(light.color, |share| light.color * share);
            self.receive(trace, &mut sum, (index, color), &facing, through);
        }
        self.reflected_light(ambient, sum)
    }

    /// Adds the light of one shadow ray toward the light at this position in the scene, which would bring
    /// this color. Returns the share of it that gets through.
    #[inline]
    pub(super) fn receive<S: Geometry, P: Probe<R>>(
        &self,
        trace: &mut Trace<'_, '_, R, S, P>,
        sum: &mut LampLight<R>,
        (light, color): (usize, LinearRgb<R>),
        facing: &FacingLight<R>,
        through: Through<Throughput<R>>,
    ) -> Throughput<R> {
        trace.count_layers(&through);
        if !matches!(through, Through::All) {
            trace.seen.shadow(light);
        }
        let throughput = through.throughput();
        let highlight = sum.add(facing, self.material, color, throughput);
        if trace.probe.is_enabled() {
            let shown = throughput.of(self.lit(color, facing.cosine, highlight));
            let (toward, through) = (facing.toward, throughput.largest());
            trace.probe.record(Event::Light { light, toward, through, shown });
        }
        throughput
    }

    /// Ambient light that the surface shows, and light of its own.
    #[inline(always)]
    pub(super) fn ambient_light<S: Geometry>(&self, scene: &PreparedScene<'_, R, S>) -> LinearRgb<R> {
        let mut ambient = LinearRgb::BLACK;
        // Products are slow in fixed point.
        if !R::IS_FIXED_POINT || self.material.ambient > R::ZERO {
            ambient = self.color * self.material.ambient;
            if let Some(light) = self.material.ambient_light().or(scene.ambient()) {
                ambient = light * ambient;
            }
        }
        match self.material.optics() {
            Some(optics) => ambient + optics.emission_toward(self.hit.surface.normal, self.incoming),
            None => ambient,
        }
    }

    /// The light that the surface emits along the incoming ray.
    #[cfg(any(feature = "looks", feature = "path-tracing"))]
    pub(super) fn emission(&self) -> LinearRgb<R> {
        let (optics, normal) = (self.material.optics(), self.hit.surface.normal);
        optics.map_or(LinearRgb::BLACK, |optics| optics.emission_toward(normal, self.incoming))
    }

    /// The share of light from all around that the surface scatters.
    #[cfg(feature = "path-tracing")]
    pub(super) fn scattering(&self) -> Throughput<R> {
        Throughput::colored(self.color) * self.material.diffuse
    }

    /// Whether a direction points to the other side of the surface than that of the incoming ray.
    #[cfg(feature = "path-tracing")]
    pub(super) fn is_behind(&self, direction: Vec3<R>) -> bool {
        let (geometric, _, _) = self.hit.surface.normal.facing(self.incoming);
        !(geometric.dot(direction) > R::ZERO)
    }

    /// π times the density with which a glossy surface mirrors the incoming ray into a direction; `None` for
    /// perfect mirrors, and in fixed point, where the density of narrow lobes is out of range.
    #[cfg(feature = "path-tracing")]
    pub(super) fn gloss_density<S: Geometry>(
        &self,
        scene: &PreparedScene<'_, R, S>,
        direction: Vec3<R>,
    ) -> Option<R> {
        let gloss = self.material.optics()?.gloss?;
        if R::IS_FIXED_POINT {
            return None;
        }
        if self.is_behind(direction) {
            return Some(R::ZERO);
        }
        // The part of the lobe that lies behind the surface is turned around to its front.
        let normal = self.hit.surface.normal;
        let height = normal.dot(direction);
        let turned = direction - normal * (height + height);
        let axis = self.mirrored_axis(scene);
        Some(gloss.density(axis.dot(direction)) + gloss.density(axis.dot(turned)))
    }

    /// A light that the surface faces and that it would show; `None` if no shadow ray is needed.
    #[inline(always)]
    pub(super) fn facing(
        &self,
        light: &PreparedLight<'_, R>,
        diffuses: bool,
        shines: bool,
    ) -> Option<FacingLight<R>> {
        let (toward, distance, cosine) = light.seen_from(self.hit.surface.point, self.normal)?;
        let highlight_cosine = if shines { self.highlight_cosine(toward) } else { None };
        if !diffuses && highlight_cosine.is_none() {
            return None;
        }
        let share = light.share(self.hit.surface.point, toward, distance);
        if share.is_some_and(|share| !(share > R::ZERO)) {
            return None;
        }
        Some(FacingLight { toward, distance, cosine, highlight_cosine, share })
    }

    /// The cosine whose power is the highlight of a light in this direction, if it can be visible.
    #[inline]
    pub(super) fn highlight_cosine(&self, toward: Vec3<R>) -> Option<R> {
        let shininess = &self.material.shininess;
        let cosine = match self.material.optics() {
            Some(optics) => optics.highlight_cosine(self.normal, self.incoming, self.mirrored, toward),
            // In floating point the bound is the product itself.
            None if R::IS_FIXED_POINT && !shininess.may_be_visible(self.mirrored, toward) => R::ZERO,
            None => self.mirrored.dot(toward),
        };
        shininess.is_visible(cosine).then_some(cosine)
    }

    /// The light of one lamp that leaves the hit if nothing is in the way: for events.
    pub(super) fn lit(&self, color: LinearRgb<R>, cosine: R, highlight: R) -> LinearRgb<R> {
        let shown = self.color * (self.material.diffuse * cosine);
        let highlight = LinearRgb::even(self.material.specular * highlight);
        let highlight =
            self.material.optics().map_or(highlight, |optics| optics.reflection_color * highlight);
        // The sum may be as large as 2: it is not a share, so it is multiplied with all digits.
        let LinearRgb { r, g, b } = shown + highlight;
        LinearRgb::new(color.r * r, color.g * g, color.b * b)
    }

    /// Light from all around that the surface scatters.
    #[cfg(feature = "distributed")]
    pub(super) fn scattered(&self, light: LinearRgb<R>) -> LinearRgb<R> {
        light * self.color * self.material.diffuse
    }

    /// Ambient light, and the light of lamps as the surface reflects it.
    #[inline(always)]
    pub(super) fn reflected_light(&self, ambient: LinearRgb<R>, lamps: LampLight<R>) -> LinearRgb<R> {
        let LampLight { diffuse, mut specular, is_lit, has_highlight } = lamps;
        // Most points have no highlight, and many no light: nothing is added there.
        if !is_lit {
            return ambient;
        }
        let scattered = ambient + diffuse * self.color * self.material.diffuse;
        if !has_highlight {
            return scattered;
        }
        if let Some(PreparedOptics { reflection_color, .. }) = self.material.optics() {
            specular = specular * *reflection_color;
        }
        scattered + specular * self.material.specular
    }

    /// The shares of light that are reflected and refracted, and the direction of the refracted ray, if there
    /// is one.
    #[inline(always)]
    pub(super) fn shares(&self) -> (Shares<R>, Option<Vec3<R>>) {
        let PreparedMaterial { reflectance, transmittance, .. } = *self.material;
        let is_transparent = transmittance > R::ZERO;
        let refraction = if is_transparent { self.refracted() } else { None };
        let Some(optics) = self.material.optics() else {
            let is_totally_reflected = is_transparent && refraction.is_none();
            let mirrored = if is_totally_reflected { reflectance + transmittance } else { reflectance };
            let (mirrored, refracted) = (Throughput::even(mirrored), Throughput::even(transmittance));
            return (Shares { mirrored, refracted }, refraction);
        };
        // Opaque lacquer reflects as much as if light went on behind its surface.
        let behind =
            if is_transparent || !optics.needs_angle_behind() { refraction } else { self.refracted() };
        let cosine = match behind {
            Some(direction) => Some(self.normal.dot(direction).abs()),
            None if is_transparent => None,
            None => Some(self.cosine),
        };
        let shares = optics.shares((reflectance, transmittance), self.cosine, self.eta(), cosine);
        (shares, if optics.thin { refraction.map(|_| self.incoming) } else { refraction })
    }

    /// The direction of a ray that the surface mirrors: in the lobe of a glossy material.
    #[inline]
    pub(super) fn spread_mirrored<S: Geometry>(
        &self,
        scene: &PreparedScene<'_, R, S>,
        numbers: &RayNumbers,
        bounces: u8,
    ) -> Vec3<R> {
        let mirrored = self.mirrored_axis(scene);
        match self.material.optics().and_then(|optics| optics.gloss) {
            Some(lobe) if cfg!(feature = "distributed") => {
                self.spread(mirrored, lobe.spread, numbers.pair(Dimension::mirrored(bounces)))
            }
            _ => mirrored,
        }
    }

    /// The mirrored direction of a mirror, or the axis of the lobe of a glossy material.
    #[inline]
    fn mirrored_axis<S: Geometry>(&self, scene: &PreparedScene<'_, R, S>) -> Vec3<R> {
        if scene.bends_normals() { self.mirrored_outside() } else { self.mirrored }
    }

    /// The mirrored direction. Where the normal to shade with is bent so far that it would lead into the
    /// body, whose inside is dark: the nearest direction along the surface, and 1/70 of a degree above it for
    /// rounding.
    fn mirrored_outside(&self) -> Vec3<R> {
        let (geometric, _, _) = self.hit.surface.normal.facing(self.incoming);
        let height = geometric.dot(self.mirrored);
        if !(height < R::ZERO) {
            return self.mirrored;
        }
        let bent = self.mirrored + geometric * (R::from_fraction(1 << 4) - height);
        bent.normalized().unwrap_or(geometric)
    }

    /// The direction of a ray that the surface refracts into a direction: in the lobe of a translucent
    /// material.
    #[inline]
    pub(super) fn spread_refracted(&self, direction: Vec3<R>, numbers: &RayNumbers, bounces: u8) -> Vec3<R> {
        match self.material.optics().and_then(|optics| optics.translucency) {
            Some(lobe) if cfg!(feature = "distributed") => {
                self.spread(direction, lobe.spread, numbers.pair(Dimension::refracted(bounces)))
            }
            _ => direction,
        }
    }

    /// A direction in the lobe around `axis`, on the axis's side of the surface. The part of the lobe that
    /// lies on the other side is turned around to this side, so that no light is lost.
    fn spread(&self, axis: Vec3<R>, exponent: R::Factor, pair: [u16; 2]) -> Vec3<R> {
        let direction = lobe(axis, exponent, pair);
        let normal = self.hit.surface.normal;
        let (height, of_axis) = (normal.dot(direction), normal.dot(axis));
        if (height > R::ZERO) == (of_axis > R::ZERO) {
            return direction;
        }
        let turned = direction - normal * (height + height);
        turned.normalized().unwrap_or(axis)
    }

    /// The ratio of the indices of refraction: on the side that the ray came from over the other side. Light
    /// that comes to the back of an opaque or thin surface enters it as well.
    fn eta(&self) -> R {
        let has_inside =
            self.material.optics().is_none_or(|optics| !optics.thin && self.material.transmittance > R::ZERO);
        let is_entering = !has_inside || self.hit.surface.normal.dot(self.incoming) < R::ZERO;
        if is_entering { self.material.eta_entering } else { self.material.eta_leaving }
    }

    /// The direction of the refracted ray by Snell's law (Glassner (ed.), "An Introduction to Ray Tracing",
    /// 1989, p. 289); `None` under total internal reflection.
    ///
    /// The geometric normal points away from the inside. A material states the indices of refraction on both
    /// sides of its surface, so that a ray need not store the media that it is in.
    fn refracted(&self) -> Option<Vec3<R>> {
        let eta = self.eta();
        if eta == R::ONE {
            // Straight on.
            return Some(self.incoming);
        }
        let cosine_squared = R::ONE - eta * eta * (R::ONE - self.cosine * self.cosine);
        if cosine_squared < R::ZERO {
            return None;
        }
        let refracted = self.incoming * eta + self.normal * (eta * self.cosine - cosine_squared.sqrt());
        // Keep directions unit vectors: in floating point `Path::keep_unit` does it. A ray that leaves the
        // denser side multiplies the error of the incoming length by the square of the ratio; a ray that
        // enters makes the error smaller.
        let is_unit =
            !R::IS_FIXED_POINT || eta < R::ONE || (refracted.length_squared() - R::ONE).abs() < R::RAY_OFFSET;
        if is_unit { Some(refracted) } else { refracted.normalized() }
    }
}

impl<R: Real> LampLight<R> {
    pub(super) const NONE: Self =
        Self { diffuse: LinearRgb::BLACK, specular: LinearRgb::BLACK, is_lit: false, has_highlight: false };

    /// Adds the share of a light that gets through; returns the strength of its highlight, 0 to 1.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        light: &FacingLight<R>,
        material: &PreparedMaterial<'_, R>,
        color: LinearRgb<R>,
        through: Throughput<R>,
    ) -> R {
        if !(through.largest() > R::ZERO) {
            return R::ZERO;
        }
        self.diffuse = self.diffuse + (through * light.cosine).of(color);
        self.is_lit = true;
        // A power takes long: compute it for light that gets through.
        let highlight = light.highlight_cosine.map_or(R::ZERO, |cosine| material.shininess.power_of(cosine));
        if highlight > R::ZERO {
            self.specular = self.specular + (through * highlight).of(color);
            self.has_highlight = true;
        }
        highlight
    }
}
