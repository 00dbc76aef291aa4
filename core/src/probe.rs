//! Events of the renderer: for counters, and for a report of everything that happens to one pixel.

use crate::color::LinearRgb;
use crate::math::{Ray, Real, Vec3};
use crate::prepared::Hit;

/// Why a ray was traced. Shadow rays are not among these: see [`Event::Light`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum RayKind {
    /// From the eye through a pixel.
    Camera,
    /// Mirrored by a surface.
    Reflected,
    /// Through a transparent surface.
    Refracted,
    /// Scattered by a surface, where light is found by [path tracing](crate::Integrator).
    #[cfg(feature = "path-tracing")]
    Scattered,
}

/// Why light was left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Cut {
    /// A ray would have exceeded [`Settings::bounces`](crate::Settings).
    Bounces,
    /// A ray would have brought less than [`Settings::cutoff`](crate::Settings) of its light to the pixel.
    Throughput,
    /// The pixel had spent its [`Settings::rays_per_pixel`](crate::Settings).
    Rays,
    /// A shadow ray met more than [`MAX_SHADOW_LAYERS`](crate::limits::MAX_SHADOW_LAYERS) transparent
    /// surfaces.
    ShadowLayers,
}

/// Something that happened while a pixel was traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event<R> {
    /// A ray is traced; shadow rays come as [`Event::Light`].
    Ray {
        /// Why the ray is traced.
        kind: RayKind,
        /// The ray.
        ray: Ray<R>,
        /// Bounces since the camera.
        bounces: u8,
        /// Share of the light at its origin that reaches the pixel: the largest of the three channels.
        /// Absorption along the ray itself is not in it.
        throughput: R,
    },
    /// The ray met an object.
    Hit {
        /// Why the ray was traced.
        kind: RayKind,
        /// The ray.
        ray: Ray<R>,
        /// The hit.
        hit: Hit<R>,
        /// The color of its texture there.
        color: LinearRgb<R>,
        /// The direction of the mirrored ray, followed or not.
        mirrored: Vec3<R>,
        /// Share of the light that leaves here along the ray and reaches the pixel, in each channel.
        throughput: LinearRgb<R>,
    },
    /// The ray met nothing: it sees the background.
    Miss {
        /// The ray.
        ray: Ray<R>,
        /// The color of the background in the ray's direction.
        color: LinearRgb<R>,
        /// Share of that light that reaches the pixel, in each channel.
        throughput: LinearRgb<R>,
    },
    /// Light that leaves the hit along the ray without any lamp: once for each hit, before its lamps, and
    /// once more for the light of the sky in closed form.
    Surface {
        /// Ambient light that the surface reflects, plus light that it emits; or light of the sky.
        shown: LinearRgb<R>,
    },
    /// A light in front of the surface, which the surface shows if it is not blocked: one shadow ray of the
    /// budget. The event also comes if that ray was not traced, because no object can be in the way.
    Light {
        /// Position of the light in [`Scene::lights`](crate::Scene::lights).
        light: usize,
        /// Unit vector toward it.
        toward: Vec3<R>,
        /// Share of its light that comes through.
        through: R,
        /// The light that it adds to what leaves the hit along the ray.
        shown: LinearRgb<R>,
    },
    /// Light was left out.
    Cut(Cut),
}

/// Receives the events of the renderer. Parts of an event that a probe does not use cost nothing.
pub trait Probe<R> {
    /// Receives one event.
    fn record(&mut self, event: Event<R>);

    /// Whether the probe uses events. If not, pixels that show nothing but the background may be skipped
    /// without one.
    fn is_enabled(&self) -> bool {
        true
    }

    /// Whether events must come pixel after pixel. If not, neighboring pixels may be traced at once: the
    /// events of each pixel come in order, but mixed with those of others.
    fn needs_order(&self) -> bool {
        true
    }
}

/// A probe that is lent. The renderer is compiled once for each type of probe: as `&mut dyn Probe<R>`, all
/// probes share one copy of it, but all parts of events are computed.
impl<R, P: Probe<R> + ?Sized> Probe<R> for &mut P {
    #[inline]
    fn record(&mut self, event: Event<R>) {
        (**self).record(event);
    }

    #[inline]
    fn is_enabled(&self) -> bool {
        (**self).is_enabled()
    }

    #[inline]
    fn needs_order(&self) -> bool {
        (**self).needs_order()
    }
}

/// Ignores all events.
impl<R> Probe<R> for () {
    #[inline(always)]
    fn record(&mut self, _: Event<R>) {}

    fn is_enabled(&self) -> bool {
        false
    }

    fn needs_order(&self) -> bool {
        false
    }
}

/// Counts rays by kind, and what was cut short.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RayCounts {
    /// Rays from the eye.
    pub camera: u64,
    /// Rays toward lights, with those that were not traced because no object can be in the way.
    pub shadow: u64,
    /// Mirrored rays.
    pub reflected: u64,
    /// Rays through transparent surfaces.
    pub refracted: u64,
    /// Scattered rays.
    #[cfg(feature = "path-tracing")]
    pub scattered: u64,
    /// Rays from the eye that met an object.
    pub camera_hits: u64,
    /// How often [`Cut::Bounces`] happened.
    pub cut_bounces: u64,
    /// How often [`Cut::Throughput`] happened.
    pub cut_throughput: u64,
    /// How often [`Cut::Rays`] happened.
    pub cut_rays: u64,
    /// How often [`Cut::ShadowLayers`] happened.
    pub cut_shadow_layers: u64,
}

impl RayCounts {
    /// The rays of all kinds.
    pub fn total(&self) -> u64 {
        let beside_camera = self.shadow.saturating_add(self.reflected).saturating_add(self.refracted);
        #[cfg(feature = "path-tracing")]
        let beside_camera = beside_camera.saturating_add(self.scattered);
        self.camera.saturating_add(beside_camera)
    }
}

impl<R: Real> Probe<R> for RayCounts {
    fn record(&mut self, event: Event<R>) {
        let count = match event {
            Event::Ray { kind: RayKind::Camera, .. } => &mut self.camera,
            Event::Ray { kind: RayKind::Reflected, .. } => &mut self.reflected,
            Event::Ray { kind: RayKind::Refracted, .. } => &mut self.refracted,
            #[cfg(feature = "path-tracing")]
            Event::Ray { kind: RayKind::Scattered, .. } => &mut self.scattered,
            Event::Light { .. } => &mut self.shadow,
            Event::Hit { kind: RayKind::Camera, .. } => &mut self.camera_hits,
            Event::Cut(Cut::Bounces) => &mut self.cut_bounces,
            Event::Cut(Cut::Throughput) => &mut self.cut_throughput,
            Event::Cut(Cut::Rays) => &mut self.cut_rays,
            Event::Cut(Cut::ShadowLayers) => &mut self.cut_shadow_layers,
            Event::Hit { .. } | Event::Surface { .. } | Event::Miss { .. } => return,
        };
        *count = count.saturating_add(1);
    }

    fn needs_order(&self) -> bool {
        false
    }
}

impl core::ops::AddAssign for RayCounts {
    fn add_assign(&mut self, other: Self) {
        self.camera = self.camera.saturating_add(other.camera);
        self.shadow = self.shadow.saturating_add(other.shadow);
        self.reflected = self.reflected.saturating_add(other.reflected);
        self.refracted = self.refracted.saturating_add(other.refracted);
        #[cfg(feature = "path-tracing")]
        {
            self.scattered = self.scattered.saturating_add(other.scattered);
        }
        self.camera_hits = self.camera_hits.saturating_add(other.camera_hits);
        self.cut_bounces = self.cut_bounces.saturating_add(other.cut_bounces);
        self.cut_throughput = self.cut_throughput.saturating_add(other.cut_throughput);
        self.cut_rays = self.cut_rays.saturating_add(other.cut_rays);
        self.cut_shadow_layers = self.cut_shadow_layers.saturating_add(other.cut_shadow_layers);
    }
}
