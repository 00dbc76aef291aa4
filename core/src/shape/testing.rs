//! Helpers for the closed-form tests of all shapes.

use super::{Geometry, Intersect};
use crate::arena::{Arena, Workspace};
use crate::fault::Fault;
use crate::math::{Fixed, FourRays, Interval, Ray, Real, Scale, Vec3, choose};
use crate::surface::Surface;

/// A hit of a shape, in `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TestHit {
    pub(super) t: f64,
    pub(super) point: [f64; 3],
    pub(super) normal: [f64; 3],
    pub(super) shading_normal: [f64; 3],
}

fn doubles<R: Real>(v: Vec3<R>) -> [f64; 3] {
    [v.x, v.y, v.z].map(|x| f64::from(x.to_f32()))
}

/// Memory for any shape of the tests.
pub(super) type Memory = Workspace<4096>;

/// The shape, prepared in the number system `R`.
pub(super) fn prepared<'m, G: Geometry + 'm, R: Real>(
    shape: G,
    memory: &'m mut Memory,
) -> Result<G::Prepared<'m, R>, Fault> {
    prepared_for(shape, Vec3::ZERO, memory).map(|(_, prepared)| prepared)
}

/// The shape, prepared for a scene that contains nothing else and is seen from `eye`, and the scale of that
/// scene.
fn prepared_for<'m, G: Geometry + 'm, R: Real>(
    shape: G,
    eye: Vec3,
    memory: &'m mut Memory,
) -> Result<(Scale, G::Prepared<'m, R>), Fault> {
    let scale = Scale::new::<R>(shape.extent(), eye);
    shape.prepare(scale, &mut Arena::new(memory.lend())).map(|prepared| (scale, prepared))
}

/// The fault that a shape is refused with.
pub(super) fn refusal<G: Geometry>(shape: G) -> Fault {
    prepared::<G, f32>(shape, &mut Memory::new()).expect_err("the shape was accepted")
}

/// The hit of a ray in the number system `R`.
fn meet_in<R: Real, G: Geometry>(shape: G, origin: Vec3, toward: Vec3) -> Option<TestHit> {
    let direction = Vec3::from_setup(toward.to::<R::Setup>().normalized().expect("a direction"));
    let mut memory = Memory::new();
    let (scale, prepared) = prepared_for::<G, R>(shape, origin, &mut memory).expect("a legal shape");
    let ray = Ray { origin: scale.point(origin.to()), direction };
    let t = prepared.intersect(&ray, Interval::AHEAD)?;
    let Surface { point, normal, shading_normal, .. } = prepared.surface(&ray, t);
    Some(TestHit {
        t: f64::from(t.to_f32() / scale.to_f32()),
        point: doubles(point).map(|x| x / f64::from(scale.to_f32())),
        normal: doubles(normal),
        shading_normal: doubles(shading_normal),
    })
}

fn near(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 2e-5)
}

/// Asserts that a ray from `origin` along `toward` meets the shape at distance `t`, with this outward normal.
pub(super) fn assert_meets<G: Geometry>(shape: G, origin: Vec3, toward: Vec3, t: f64, normal: [f64; 3]) {
    let length = f64::from(toward.length());
    let at: Vec<f64> = doubles(origin).iter().zip(doubles(toward)).map(|(o, d)| o + d / length * t).collect();
    for meeting in [
        meet_in::<f32, G>(shape, origin, toward),
        meet_in::<f64, G>(shape, origin, toward),
        meet_in::<Fixed, G>(shape, origin, toward),
    ] {
        let meeting = meeting.unwrap_or_else(|| panic!("{shape:?} is missed from {origin:?} to {toward:?}"));
        assert!((meeting.t - t).abs() < 2e-5 * t.max(1.0), "{meeting:?}, not at {t}");
        assert!(near(meeting.normal, normal), "{meeting:?}, not {normal:?}");
        assert!(near(meeting.point, [at[0], at[1], at[2]]), "{meeting:?}, not at {at:?}");
    }
}

/// The point of the surface that a ray toward `toward` meets.
pub(super) fn surface_point<G: Geometry>(shape: G, origin: Vec3, toward: Vec3) -> [f64; 3] {
    meet_in::<f64, G>(shape, origin, toward).expect("a hit").point
}

/// The shading normal at the hit of a ray.
pub(super) fn shading_normal<G: Geometry>(shape: G, origin: Vec3, toward: Vec3) -> [f64; 3] {
    meet_in::<f64, G>(shape, origin, toward).expect("a hit").shading_normal
}

/// The coordinates u and v at the hit of a ray in the number system `R`.
fn uv_in<R: Real, G: Geometry>(shape: G, origin: Vec3, toward: Vec3) -> [f64; 2] {
    let direction = Vec3::from_setup(toward.to::<R::Setup>().normalized().expect("a direction"));
    let mut memory = Memory::new();
    let (scale, prepared) = prepared_for::<G, R>(shape, origin, &mut memory).expect("a legal shape");
    let ray = Ray { origin: scale.point(origin.to()), direction };
    let t = prepared.intersect(&ray, Interval::AHEAD).expect("a hit");
    prepared.uv(&prepared.surface(&ray, t), scale).map(|coordinate| f64::from(coordinate.to_f32()))
}

/// Asserts that the hit of a ray has these coordinates u and v.
pub(super) fn assert_uv<G: Geometry>(shape: G, origin: Vec3, toward: Vec3, expected: [f64; 2]) {
    for uv in [
        uv_in::<f32, G>(shape, origin, toward),
        uv_in::<f64, G>(shape, origin, toward),
        uv_in::<Fixed, G>(shape, origin, toward),
    ] {
        let same = uv.iter().zip(expected).all(|(a, b)| (a - b).abs() < 2e-5 * b.abs().max(1.0));
        assert!(same, "{shape:?}: {uv:?}, not {expected:?}");
    }
}

/// Asserts that a ray from `origin` along `toward` misses the shape.
pub(super) fn assert_misses<G: Geometry>(shape: G, origin: Vec3, toward: Vec3) {
    assert_eq!(meet_in::<f32, G>(shape, origin, toward), None);
    assert_eq!(meet_in::<f64, G>(shape, origin, toward), None);
    assert_eq!(meet_in::<Fixed, G>(shape, origin, toward), None);
}

fn spans_in<R: Real, G: Geometry>(shape: G, origin: Vec3, toward: Vec3) -> Vec<(f64, f64)> {
    let direction = Vec3::from_setup(toward.to::<R::Setup>().normalized().expect("a direction"));
    let mut memory = Memory::new();
    let (scale, prepared) = prepared_for::<G, R>(shape, origin, &mut memory).expect("a legal shape");
    let spans = prepared.spans(&Ray { origin: scale.point(origin.to()), direction });
    let unscaled = |t: R| {
        let end = f64::from(t.to_f32() / scale.to_f32());
        if t.abs() < R::FARTHEST { end } else { end * f64::INFINITY }
    };
    spans.as_slice().iter().map(|part| (unscaled(part.min), unscaled(part.max))).collect()
}

/// Asserts that the line from `origin` along `toward` has these parts inside the shape; a part without end
/// ends at infinity.
pub(super) fn assert_spans<G: Geometry>(shape: G, origin: Vec3, toward: Vec3, expected: &[(f64, f64)]) {
    let near = |a: f64, b: f64| a == b || (a - b).abs() < 2e-5 * b.abs().max(1.0);
    for spans in [
        spans_in::<f32, G>(shape, origin, toward),
        spans_in::<f64, G>(shape, origin, toward),
        spans_in::<Fixed, G>(shape, origin, toward),
    ] {
        let same = spans.iter().zip(expected).all(|(a, b)| near(a.0, b.0) && near(a.1, b.1));
        assert!(same && spans.len() == expected.len(), "{shape:?}: {spans:?}, not {expected:?}");
    }
}

/// Fires rays at points around `middle`, four at once, also from inside and from far away. Their hits must be
/// those of single rays, to the bit, also if the rays end earlier.
pub(super) fn assert_four_are_met_as_one<G: Geometry>(shape: G, middle: Vec3, extent: f32) {
    assert_four_are_met_as_one_in::<f32, G>(shape, middle, extent);
    assert_four_are_met_as_one_in::<f64, G>(shape, middle, extent);
}

fn assert_four_are_met_as_one_in<R: Real, G: Geometry>(shape: G, middle: Vec3, extent: f32) {
    let mut random = Random(extent.to_bits().into());
    let mut memory = Memory::new();
    let prepared = prepared::<G, R>(shape, &mut memory).expect("a legal shape");
    let (mut some, mut all) = (0, 0);
    for round in 0..20_000 {
        let away = [0.3, 1.5, 4.0, 1000.0][round % 4] * extent;
        let mut ray = |_| {
            let origin = middle + random.direction() * away;
            let aim = middle + random.vector() * extent;
            let direction = (aim - origin).normalized().unwrap_or(Vec3::new(0.0, 1.0, 0.0));
            Ray { origin: origin.to::<R>(), direction: Vec3::from_setup(direction.to()) }
        };
        let rays: [Ray<R>; 4] = [ray(0), ray(1), ray(2), ray(3)];
        let max = [R::FARTHEST, R::from_f32(away), R::from_f32(away + extent * 0.5), R::FARTHEST];
        let four = FourRays::new(rays.each_ref());
        let (met, t) = prepared.intersect_four(&four, &max);
        let (met_by_one, t_by_one) = four.one_by_one(&max, |ray, range| prepared.intersect(ray, range));
        assert_eq!(met, met_by_one, "{shape:?}: {rays:?} up to {max:?}");
        let (t, expected) = (choose(met, t, max), choose(met, t_by_one, max));
        assert_eq!(t, expected, "{shape:?}: {rays:?} up to {max:?}");
        some += u32::from(met != 0);
        all += u32::from(met == 15);
    }
    assert!(
        some > 1000 && all > 20 && some - all > 1000,
        "{shape:?}: {some} times some were met, {all} times all"
    );
}

/// Fires rays at points around `middle`: each must meet the shape at the ends of its line's parts inside the
/// shape, and nowhere else.
pub(super) fn assert_spans_are_met<G: Geometry>(shape: G, middle: Vec3, extent: f32, rays: usize) {
    assert!(shape.is_solid());
    assert_spans_are_met_in::<f32, G>(shape, middle, extent, rays);
    assert_spans_are_met_in::<f64, G>(shape, middle, extent, rays);
    assert_spans_are_met_in::<Fixed, G>(shape, middle, extent, rays);
}

fn assert_spans_are_met_in<R: Real, G: Geometry>(shape: G, middle: Vec3, extent: f32, rays: usize) {
    let mut random = Random(extent.to_bits().into());
    let mut met = 0;
    let mut memory = Memory::new();
    let eye = Vec3::new(middle.magnitude() + 5.0 * extent, 0.0, 0.0);
    let (scale, prepared) = prepared_for::<G, R>(shape, eye, &mut memory).expect("a legal shape");
    let tolerance = f64::from(1e-3 * extent * scale.to_f32());
    let double = |t: R| f64::from(t.to_f32());
    for _ in 0..rays {
        // From outside and from inside: 0 to 4 extents away from the middle.
        let origin = middle + random.direction() * (extent * (2.0 + 2.0 * random.next()));
        let aim = middle + random.vector() * extent;
        let Some(direction) = (aim - origin).normalized() else { continue };
        let ray = Ray { origin: scale.point(origin.to()), direction: Vec3::from_setup(direction.to()) };
        let spans = prepared.spans(&ray);
        let parts = spans.as_slice();
        assert!(parts.iter().zip(parts.iter().skip(1)).all(|(a, b)| a.max <= b.min), "{spans:?}");
        // A part that is hardly longer than the tolerance may be missed.
        if parts.iter().any(|part| double(part.max) - double(part.min) < 10.0 * tolerance) {
            continue;
        }
        let ends: Vec<R> = parts.iter().flat_map(|part| [part.min, part.max]).collect();
        let mut range = Interval::AHEAD;
        while let Some(t) = prepared.intersect(&ray, range) {
            let found = ends.iter().any(|end| (double(*end) - double(t)).abs() < tolerance);
            assert!(found || double(t) < tolerance, "{shape:?}: {ray:?} meets it at {t:?}, inside {spans:?}");
            range.min = t + R::from_f32(tolerance as f32);
            met += 1;
        }
        let expected = ends.iter().filter(|end| double(**end) > tolerance && **end < R::FARTHEST);
        for end in expected {
            let before = Interval { min: *end - R::from_f32(tolerance as f32), max: R::FARTHEST };
            let t = prepared.intersect(&ray, before);
            let near = t.is_some_and(|t| (double(t) - double(*end)).abs() < tolerance);
            assert!(near, "{shape:?}: {ray:?} does not meet it at {end:?}, but at {t:?}");
        }
    }
    assert!(met > rays / 20, "only {met} of {rays} rays met {shape:?}");
}

/// Random numbers in [-1, 1), the same on every run (Knuth's MMIX generator).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1u32 << 23) as f32 - 1.0
    }

    pub(crate) fn vector(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }

    pub(crate) fn direction(&mut self) -> Vec3 {
        loop {
            let vector = self.vector();
            if vector.length() > 0.1 && vector.length() < 1.0 {
                return vector.normalized().expect("a length");
            }
        }
    }
}

/// Fires rays from around the shape at points around `middle`. From each hit it spawns a ray in a random
/// direction, which must not meet the same place of the surface again.
pub(super) fn assert_no_self_hits<G: Geometry>(shape: G, middle: Vec3, extent: f32, rays: usize) {
    assert_no_self_hits_in::<f32, G>(shape, middle, extent, rays);
    assert_no_self_hits_in::<Fixed, G>(shape, middle, extent, rays);
}

fn assert_no_self_hits_in<R: Real, G: Geometry>(shape: G, middle: Vec3, extent: f32, rays: usize) {
    let mut random = Random(extent.to_bits().into());
    let mut hits = 0;
    let mut memory = Memory::new();
    // Seen from as far away as the rays begin.
    let eye = Vec3::new(middle.magnitude() + 5.0 * extent, 0.0, 0.0);
    let (scale, prepared) = prepared_for::<G, R>(shape, eye, &mut memory).expect("a legal shape");
    let kernel = |point: Vec3| -> Vec3<R> { scale.point(point.to()) };
    let length = |value: f32| value * scale.to_f32();
    for _ in 0..rays {
        let origin = middle + random.direction() * (extent * (3.0 + 2.0 * random.next()));
        let aim = middle + random.vector() * extent;
        let Some(direction) = (aim - origin).normalized() else { continue };
        let ray = Ray { origin: kernel(origin), direction: Vec3::from_setup(direction.to()) };
        let Some(t) = prepared.intersect(&ray, Interval::AHEAD) else { continue };
        hits += 1;
        let surface = prepared.surface(&ray, t);
        if let Some(bounds) = prepared.bounds() {
            assert!(
                bounds.contains(surface.point) && bounds.contains(ray.at(t)),
                "{surface:?} outside {bounds:?}"
            );
            let size = bounds.magnitude().to_f32();
            assert!(size < length(4.0 * extent + middle.magnitude()), "{bounds:?} is loose");
        }
        let away: Vec3<R> = Vec3::from_setup(random.direction().to());
        // A ray within half a degree of a curved surface may rightly meet it again nearby.
        if away.dot(surface.normal).abs() < R::from_f32(0.01) {
            continue;
        }
        let spawned = Ray::spawn(surface.point, surface.normal, away, surface.magnitude);
        for ray in [&ray, &spawned] {
            assert_parts_meet_no_more(
                &prepared,
                ray,
                R::from_f32(length(extent * (2.0 + 2.0 * random.next()))),
            );
        }
        if let Some(again) = prepared.intersect(&spawned, Interval::AHEAD) {
            // Close to an edge, the other face is close, too.
            let other_face = prepared.surface(&spawned, again).normal.dot(surface.normal) < R::from_f32(0.9);
            assert!(
                other_face || again.to_f32() > length(extent * 1e-3),
                "{shape:?}: {ray:?} meets itself after {again:?}"
            );
        }
    }
    assert!(hits > rays / 20, "only {hits} of {rays} rays met {shape:?}");
}

/// Asserts that a ray has no more hits up to `max` than the [form](super::Form) of a shape allows, and that
/// its parts meet nothing if the whole ray meets nothing.
fn assert_parts_meet_no_more<R: Real>(prepared: &impl Intersect<R>, ray: &Ray<R>, max: R) {
    let Some(most) = prepared.form().most_hits() else { return };
    let mut range = Interval { min: R::ZERO, max };
    let mut hits = 0;
    while let Some(t) = prepared.intersect(ray, range) {
        range.min = t;
        hits += 1;
        assert!(hits <= most, "{ray:?} meets it again at {t:?}");
    }
    for sixteenths in 0..16 {
        let part = Interval { min: max * R::from_f32(sixteenths as f32 / 16.0), max };
        let t = prepared.intersect(ray, part);
        assert!(hits > 0 || t.is_none(), "{ray:?} is met at {t:?} from {:?} on alone", part.min);
    }
}

/// Sizes over eight orders of magnitude.
pub(super) const EXTENTS: [f32; 5] = [1e-3, 0.1, 1.0, 300.0, 1e5];
