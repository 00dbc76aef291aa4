//! How much light comes along a ray: Whitted's ray tracing, with a stack in place of recursion.
//!
//! The way of one camera ray ([`radiance`]):
//!
//! 1. [`Path`] holds the ray at hand and the light that was found so far. Rays that wait are on a stack
//!    beside it.
//! 2. [`PreparedScene::closest_from`] finds what the ray meets: a hit, or nothing, so that the background is
//!    seen.
//! 3. [`ShadedHit`] is that hit with the color and the normal to shade with. It adds up ambient light and the
//!    light of each lamp that a shadow ray reaches ([`shadow_rays`]).
//! 4. A mirror or glass sends on a reflected and a refracted ray. The reflected ray is next, the refracted
//!    ray waits. A waiting ray is only ever followed by rays of one bounce more, so at most one ray waits for
//!    each bounce, and [`MAX_BOUNCES`](crate::limits::MAX_BOUNCES) places are enough. The order of rays, and
//!    so of sums, is fixed.
//!
//! [`group`] traces several neighboring pixels through the same steps at once. [`unshadowed`](mod@unshadowed)
//! is the light of step 3 without rays, for scan conversion.

#[cfg(feature = "distributed")]
mod area_light;
#[cfg(feature = "looks")]
mod gooch;
mod group;
mod path;
#[cfg(feature = "path-tracing")]
mod path_tracing;
mod pending_ray;
mod seen;
mod shaded_hit;
mod shadow_rays;
#[cfg(feature = "distributed")]
mod sky_light;
mod unshadowed;

#[cfg(feature = "looks")]
pub use gooch::Gooch;
pub(crate) use group::{Lane, Lanes, PixelGroup, WIDTH};
pub(crate) use seen::{Seen, fold};
pub(crate) use shadow_rays::{Blockers, OUTLINED_LIGHTS};
pub(crate) use unshadowed::{UnshadowedLight, unshadowed};

use path::{Path, Waiting};

use crate::color::LinearRgb;
use crate::math::{Ray, Real};
use crate::prepared::{ObjectSet, PreparedScene, Through};
use crate::probe::{Cut, Event, Probe};
use crate::sampling::RayNumbers;
use crate::shape::Geometry;
use crate::throughput::Throughput;

/// When rays are no longer followed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayLimits<R> {
    /// The most bounces of a ray.
    pub(crate) bounces: u8,
    /// The least throughput of a ray.
    pub(crate) cutoff: R,
    #[cfg(feature = "distributed")]
    pub(crate) area_lights: AreaLights,
    #[cfg(feature = "path-tracing")]
    pub(crate) integrator: Integrator,
    /// The tones of surfaces in place of their light.
    #[cfg(feature = "looks")]
    pub(crate) gooch: Option<Gooch>,
}

/// The rays by which light finds its way to the eye.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Integrator {
    /// Mirrored and refracted rays (Whitted, "An Improved Illumination Model for Shaded Display", CACM 1980).
    /// Light that comes from other surfaces is the ambient light.
    #[default]
    Whitted,
    /// One path for each sample, whose rays may also be scattered (Kajiya, "The Rendering Equation", SIGGRAPH
    /// 1986): surfaces light and color each other, and glass throws caustics of lamps with a size.
    ///
    /// All that a path meets shines: backgrounds, and surfaces that emit light even if they are not lights of
    /// the scene. Ambient light, [`Light::Sky`](crate::Light::Sky) and
    /// [`Settings::area_lights`](crate::Settings::area_lights) are of no use and left out, and so is
    /// [`Settings::cutoff`](crate::Settings::cutoff): paths that bring little light end by chance. Noise
    /// falls with the number of samples; 64 to 1024 are usual. In fixed point, a path brings at most 1.99
    /// times the light that it finds, which is less than it should be only where a surface scatters one color
    /// and mirrors another.
    #[cfg(feature = "path-tracing")]
    PathTracing,
}

/// The way to find the light of lamps with a size and of the sky, see [`Light::Object`](crate::Light::Object)
/// and [`Light::Sky`](crate::Light::Sky). Other scenes are the same in both ways.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum AreaLights {
    /// By rays to several points of each lamp and of the sky: right for all shapes, with noise where samples
    /// are few.
    #[default]
    Sampled,
    /// By formulas, with one ray for each lamp: without noise, for realtime quality and small processors.
    /// Opaque balls throw soft shadows. Opaque balls and planes hide the sky. All other objects throw shadows
    /// with sharp edges, and so do all objects of a scene of more than 32. Where two balls cover the same
    /// part of a lamp, the part counts twice. Highlights are those of a lamp without a size.
    ClosedForm,
}

/// What is known of a camera ray before it is traced.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight<'k> {
    /// The objects that the ray can meet, where the scene has sets of objects.
    pub(crate) among: ObjectSet,
    /// The objects that can shade the place where the ray ends.
    pub(crate) blockers: &'k Blockers,
}

impl Sight<'_> {
    /// The ray can meet these objects, and any object can shade the place where it ends.
    pub(crate) const fn among(among: ObjectSet) -> Self {
        Self { among, blockers: &Blockers::UNKNOWN }
    }
}

/// The rays that one pixel may still spend.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayBudget(pub(crate) u32);

impl RayBudget {
    /// Takes one ray, if there is one left.
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

/// All that the rays of one sample have in common.
struct Trace<'t, 'm, R: Real, S: Geometry + 'm, P> {
    scene: &'t PreparedScene<'m, R, S>,
    limits: RayLimits<R>,
    /// The rays that are left.
    rays: RayBudget,
    seen: Seen,
    /// The numbers that the rays draw.
    numbers: RayNumbers,
    /// π times the density with which the direction of the ray at hand was drawn, if shadow rays are sent to
    /// the same lamps.
    #[cfg(feature = "path-tracing")]
    drawn: Option<R>,
    probe: &'t mut P,
}

impl<'t, 'm, R: Real, S: Geometry + 'm, P> Trace<'t, 'm, R, S, P> {
    /// For the rays of a sample that may spend some rays and draws these numbers.
    #[inline]
    fn new(
        scene: &'t PreparedScene<'m, R, S>,
        limits: &RayLimits<R>,
        rays: RayBudget,
        numbers: RayNumbers,
        probe: &'t mut P,
    ) -> Self {
        Self {
            scene,
            limits: *limits,
            rays,
            seen: Seen::NOTHING,
            numbers,
            #[cfg(feature = "path-tracing")]
            drawn: None,
            probe,
        }
    }
}

impl<R: Real, S: Geometry, P: Probe<R>> Trace<'_, '_, R, S, P> {
    /// Records if a shadow ray met more layers than are followed.
    #[inline]
    fn count_layers(&mut self, through: &Through<Throughput<R>>) {
        if let Through::TooManyLayers = through {
            self.probe.record(Event::Cut(Cut::ShadowLayers));
        }
    }
}

/// The state of a pixel that its samples share.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SampleRays {
    /// The rays that are left.
    pub(crate) left: RayBudget,
    /// The digest of the last sample.
    pub(crate) seen: Seen,
}

/// The light that comes to the origin of a camera ray from where it points.
#[inline(always)]
pub(crate) fn radiance<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    (ray, numbers): (Ray<R>, RayNumbers),
    sight: Sight<'_>,
    limits: &RayLimits<R>,
    rays: &mut SampleRays,
    probe: &mut impl Probe<R>,
) -> LinearRgb<R> {
    let mut trace = Trace::new(scene, limits, rays.left, numbers, probe);
    let mut path = Path::new(ray, sight.among);
    path.finish(&mut trace, sight.blockers, &mut Waiting::new());
    (rays.left, rays.seen) = (trace.rays, trace.seen);
    path.light
}
