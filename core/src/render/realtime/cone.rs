//! The rays around a traced one, as far as that stands for them: a cone (Amanatides, "Ray Tracing with Cones", SIGGRAPH 1984).
//!
//! What a traced ray passes by within its cone may be met by a ray beside it: something thin that is mirrored, or that is in the way to
//! a light. Where thin things are seen directly is known better ([`thin`](super::thin)).
//!
//! The cone holds every ray up to half the diagonal of a cell away. Mirrors open it where they are curved, as two places of them
//! have normals of other directions: balls by their radius, others by what mirrored directions [sweep](super::sweep) over. On a surface the
//! cone leaves an ellipse, longer the more the surface is slanted, and a shadow ray stands for those of the whole ellipse.

use core::f32::consts::FRAC_1_SQRT_2;

use super::Grid;
use crate::camera::Viewport;
use crate::math::{Ray, Real, Vec3};
use crate::shape::Hull;

/// The cone around a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone<R> {
    /// Its radius where the ray begins, and by how much it grows with each unit.
    radius: R,
    spread: R,
    /// What is looked for beside the ray is at least so many times as long as wide.
    slenderness: R,
}

impl<R: Real> Cone<R> {
    /// That of a ray from the eye, to look for what is at least so many times as long as wide.
    pub(super) fn new(viewport: &Viewport<R>, grid: Grid, slenderness: u16) -> Self {
        let half_diagonal = R::Setup::from_u16(grid.pixels() as u16) * R::Setup::from_f32(0.71);
        let spread = R::from_setup(half_diagonal * viewport.pixel()).smaller(R::ONE);
        Self { radius: R::ZERO, spread, slenderness: R::from_u16(slenderness) }
    }

    /// Half as wide.
    pub(super) fn halved(self) -> Self {
        let half = R::from_f32(0.5);
        Self { radius: self.radius * half, spread: self.spread * half, ..self }
    }

    /// After so many units.
    pub(super) fn after(self, distance: R) -> Self {
        Self { radius: self.radius_at(distance), ..self }
    }

    /// Mirrored or bent by a ball of this radius.
    pub(super) fn opened(self, ball_radius: R) -> Self {
        self.turned(turned_by_ball(self.radius, ball_radius))
    }

    /// Mirrored by a surface that turns rays so much that are as far from the middle as it reaches.
    pub(super) fn turned(self, turn: R) -> Self {
        Self { spread: (self.spread + turn).smaller(R::ONE), ..self }
    }

    /// Whether it is wider than a hull that is looked for, where that is narrowest.
    pub(super) fn is_wider(self, hull: &Hull<R>) -> bool {
        let stick = Stick::new(hull);
        stick.radius < self.radius && self.looks_for(&stick)
    }

    /// Its radius where the ray has gone so far.
    pub(super) fn radius_at(&self, distance: R) -> R {
        self.radius + self.spread * distance
    }

    fn looks_for(&self, stick: &Stick<R>) -> bool {
        stick.half_length >= stick.radius * self.slenderness
    }

    /// What it leaves where it begins, on a surface of this normal, if its ray came in this direction.
    pub(super) fn footprint(self, direction: Vec3<R>, normal: Vec3<R>) -> Footprint<R> {
        let cosine = direction.dot(normal);
        let slant = cosine.abs().larger(R::from_f32(MOST_SLANTED));
        Footprint { cone: self, direction, normal, slant: if cosine < R::ZERO { -slant } else { slant } }
    }

    /// Whether a ray beside this one can meet something thin before so many units, in a shape of these hulls: the first holds all others.
    pub(super) fn can_see(&self, ray: &Ray<R>, distance: R, hulls: impl Iterator<Item = Hull<R>>) -> bool {
        self.any_thin(hulls, |stick| stick.is_beside(ray, distance, |t, _| self.radius_at(t)))
    }

    /// Whether one of these hulls that are looked for is thin beside a ray, of which the first holds the others.
    #[inline(never)]
    fn any_thin(
        &self,
        mut hulls: impl Iterator<Item = Hull<R>>,
        is_beside: impl Fn(&Stick<R>) -> Option<Beside>,
    ) -> bool {
        let is_beside = |hull: Hull<R>| {
            let stick = Stick::new(&hull);
            let beside = is_beside(&stick)?;
            Some(if self.looks_for(&stick) { beside } else { Beside::Thick })
        };
        match hulls.next().and_then(is_beside) {
            None => false,
            Some(Beside::Thin) => true,
            Some(Beside::Thick) => hulls.any(|hull| is_beside(hull) == Some(Beside::Thin)),
        }
    }
}

/// By how much a ball turns rays at most that meet it so far aside of another: as an angle, up to 1.
fn turned_by_ball<R: Real>(aside: R, radius: R) -> R {
    (aside + aside).smaller(radius) / radius
}

/// What a cone leaves on a surface: an ellipse.
#[derive(Clone, Copy, Debug)]
pub(super) struct Footprint<R> {
    cone: Cone<R>,
    direction: Vec3<R>,
    normal: Vec3<R>,
    /// The cosine between the two, or if that is too small to count, the least that does.
    slant: R,
}

impl<R: Real> Footprint<R> {
    /// How far to go on the surface from its middle to where a ray ends that is beside its own, into such a direction and as far as half a
    /// side of what the ray stands for; and how that ray differs in direction.
    pub(super) fn step(&self, toward: Vec3<R>) -> (Vec3<R>, Vec3<R>) {
        let Self { cone, direction, normal, slant } = *self;
        let least = R::from_f32(0.25);
        let slant = if slant < R::ZERO { slant.smaller(-least) } else { slant.larger(least) };
        let aside = toward * R::from_f32(FRAC_1_SQRT_2);
        let along = aside - direction * (normal.dot(aside) / slant);
        (along * cone.radius, aside * cone.spread)
    }

    /// How far it reaches.
    pub(super) fn reach(&self) -> R {
        self.cone.radius / self.slant.abs()
    }

    /// How far at most directions turn over it that a ball of this radius mirrors, as the sine of an angle.
    pub(super) fn most_turned(&self, radius: R) -> R {
        // To first order, by how much directions differ, and twice by how much normals do; the square is more than all that comes after.
        let first = self.cone.spread + turned_by_ball(self.reach(), radius);
        first + first * first
    }

    /// Whether something thin can be between a place of it and a light, in a shape of these hulls: that is so far away along `shadow`.
    pub(super) fn can_be_shaded(
        &self,
        shadow: &Ray<R>,
        distance: R,
        hulls: impl Iterator<Item = Hull<R>>,
    ) -> bool {
        // Of a step g across the ray, the surface makes g - direction (g · normal) / (direction · normal).
        let Self { cone, direction, normal, slant } = *self;
        let radius =
            |_, toward: Vec3<R>| cone.radius * (toward - normal * (direction.dot(toward) / slant)).length();
        cone.any_thin(hulls, |stick| stick.is_beside(shadow, distance, radius))
    }
}

/// What is in a cone, next to how wide the cone is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Beside {
    Thin,
    Thick,
}

/// The least cosine between a ray and the normal of a surface that counts.
const MOST_SLANTED: f32 = 1.0 / 16.0;

/// A hull that is taken for a line with something around it.
struct Stick<R> {
    center: Vec3<R>,
    /// Unit vector along the longest axis; none of what is around a point.
    along: Vec3<R>,
    half_length: R,
    radius: R,
}

impl<R: Real> Stick<R> {
    fn new(hull: &Hull<R>) -> Self {
        let (mut along, mut half_length, mut lengths) = (Vec3::ZERO, R::ZERO, R::ZERO);
        for axis in &hull.axes {
            // Most have one axis, and a root takes long.
            if *axis == Vec3::ZERO {
                continue;
            }
            let (unit, length) = axis.unit_and_length();
            lengths = lengths + length;
            if length > half_length {
                (along, half_length) = (unit, length);
            }
        }
        Self { center: hull.center, along, half_length, radius: hull.radius + (lengths - half_length) }
    }

    /// Where on a ray's line its own is the nearest, and the way from there to it.
    fn nearest(&self, ray: &Ray<R>) -> (R, Vec3<R>) {
        let mut toward = self.center - ray.origin;
        if self.half_length > R::ZERO {
            let cosine = self.along.dot(ray.direction);
            let sine_squared = R::ONE - cosine * cosine;
            // Of parallel lines, any two places are as near.
            let place = if sine_squared > R::from_f32(1e-3) {
                (cosine * toward.dot(ray.direction) - self.along.dot(toward)) / sine_squared
            } else {
                R::ZERO
            };
            toward = toward + self.along * place.larger(-self.half_length).smaller(self.half_length);
        }
        let t = toward.dot(ray.direction);
        (t, toward - ray.direction * t)
    }

    /// Whether it is in the cone around a ray of some length, which has a `radius` at a distance and into a unit direction.
    #[inline(never)]
    fn is_beside(&self, ray: &Ray<R>, distance: R, radius: impl Fn(R, Vec3<R>) -> R) -> Option<Beside> {
        let (t, across) = self.nearest(ray);
        // Nothing is seen of what lies behind, nor farther away.
        let end = t + self.radius;
        if !(end > R::ZERO && t - self.radius < distance) {
            return None;
        }
        let (toward, away) = across.unit_and_length();
        let radius = radius(end.smaller(distance), toward);
        if !(away < self.radius + radius) {
            return None;
        }
        // That at which a ray begins or ends is seen.
        let is_between = t > R::ZERO && t < distance;
        Some(if is_between && self.radius < radius { Beside::Thin } else { Beside::Thick })
    }
}
