//! Which objects can matter where: sets that are worked out once, so that rays test only what they can meet.
//!
//! The idea is that of the light buffer (Haines and Greenberg, "The Light Buffer: A Shadow-Testing Accelerator",
//! IEEE CG&A 1986), with the receiving object in place of the direction: for each object and each light, the
//! objects that reach into the hull of both, since nothing else can stand between. And for each convex object,
//! the objects that reach into it: what a ray inside can meet before it comes out. Sets are words of 32 bits, so
//! scenes of up to 32 objects have them; they cost 4 bytes for each object and light.
//!
//! All tests are on bounding balls, with room for rounding, so that a set holds too much rather than too little
//! and a picture has the same bytes with and without.

use super::PreparedObject;
use crate::arena::Arena;
use crate::fault::Fault;
use crate::light::{PreparedLight, Source};
use crate::math::{Real, Vec3};
use crate::shape::{Form, Intersect};

/// A set of up to [`ObjectSet::CAPACITY`] objects, by position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ObjectSet(u32);

impl ObjectSet {
    /// How many objects a scene may have for its sets to be worked out.
    pub(crate) const CAPACITY: usize = 32;
    pub(crate) const NONE: Self = Self(0);

    /// The first `count` objects.
    pub(crate) const fn first(count: usize) -> Self {
        if count >= Self::CAPACITY { Self(u32::MAX) } else { Self((1 << count) - 1) }
    }

    pub(crate) const fn contains(self, object: usize) -> bool {
        self.0 >> (object & 31) & 1 == 1
    }

    pub(crate) const fn is_empty(self) -> bool {
        self.0 == 0
    }

    pub(crate) const fn with(self, object: usize) -> Self {
        Self(self.0 | 1 << (object & 31))
    }

    pub(crate) const fn without(self, object: usize) -> Self {
        Self(self.0 & !(1 << (object & 31)))
    }
}

/// The objects, from the lowest position up.
impl Iterator for ObjectSet {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        if self.0 == 0 {
            return None;
        }
        let lowest = self.0.trailing_zeros();
        self.0 &= self.0.wrapping_sub(1);
        Some(lowest as usize)
    }
}

/// The surface that a ray leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Departure {
    /// Position of the object.
    pub(crate) object: usize,
    /// Whether the ray goes to the side that the geometric normal points to.
    pub(crate) outward: bool,
}

/// The sets of a scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidates<'m> {
    all: ObjectSet,
    /// The objects that are balls.
    balls: ObjectSet,
    /// The objects that never meet a ray again that left them outward.
    never_again: ObjectSet,
    /// Per object: what reaches into it, itself included.
    inside: &'m [ObjectSet],
    /// Per object and light: what can stand between them, the object included.
    shadows: &'m [ObjectSet],
    lights: usize,
}

impl<'m> Candidates<'m> {
    /// How many sets are stored for a scene: none where it has too many objects.
    pub(super) const fn count(objects: usize, lights: usize) -> usize {
        // 32 objects and 65535 lights are far from overflowing.
        if objects > ObjectSet::CAPACITY { 0 } else { objects * lights.saturating_add(1) }
    }

    /// Works out the sets, unless the scene has too many objects.
    pub(super) fn new<R: Real, P: Intersect<R>>(
        objects: &[PreparedObject<P>],
        lights: &[PreparedLight<R>],
        arena: &mut Arena<'m>,
    ) -> Result<Option<Self>, Fault> {
        if objects.len() > ObjectSet::CAPACITY {
            return Ok(None);
        }
        let inside = arena.store_with(objects.len(), |receiver| {
            among(objects, receiver, |around, other| around.reaches(other))
        })?;
        let shadows = arena.store_with(objects.len() * lights.len(), |index| {
            let receiver = index.checked_div(lights.len()).unwrap_or(0);
            let light = index.checked_rem(lights.len()).and_then(|light| lights.get(light));
            among(objects, receiver, |around, other| {
                light.is_none_or(|light| around.is_shaded_by(other, &light.source))
            })
        })?;
        let (mut balls, mut never_again) = (ObjectSet::NONE, ObjectSet::NONE);
        for (index, object) in objects.iter().enumerate() {
            match object.shape.form() {
                Form::Any => {}
                Form::Ball { .. } => {
                    balls = balls.with(index);
                    never_again = never_again.with(index);
                }
                Form::Flat { .. } => never_again = never_again.with(index),
            }
        }
        let all = ObjectSet::first(objects.len());
        Ok(Some(Self { all, balls, never_again, inside, shadows, lights: lights.len() }))
    }

    /// What a ray can meet that comes from far away.
    pub(crate) fn all(&self) -> ObjectSet {
        self.all
    }

    /// What a ray can meet that leaves a surface; for one that goes into a ball, before it comes out again.
    pub(crate) fn leaving(&self, from: Departure) -> ObjectSet {
        if !from.outward && self.balls.contains(from.object) {
            self.inside.get(from.object).copied().unwrap_or(self.all)
        } else {
            self.without_own(self.all, from)
        }
    }

    /// What can stand between a surface and a light.
    pub(crate) fn between(&self, from: Departure, light: usize) -> ObjectSet {
        let index = from.object.wrapping_mul(self.lights).wrapping_add(light);
        self.without_own(self.shadows.get(index).copied().unwrap_or(self.all), from)
    }

    fn without_own(&self, set: ObjectSet, from: Departure) -> ObjectSet {
        let flat_or_outward = from.outward || !self.balls.contains(from.object);
        if flat_or_outward && self.never_again.contains(from.object) { set.without(from.object) } else { set }
    }
}

/// The receiver, the objects that pass the test with the ball around it, and all that have no ball.
fn among<R: Real, P: Intersect<R>>(
    objects: &[PreparedObject<P>],
    receiver: usize,
    can_matter: impl Fn(&Ball<R>, &Body<R>) -> bool,
) -> ObjectSet {
    let Some(around) = objects.get(receiver).and_then(Ball::around) else {
        return ObjectSet::first(objects.len());
    };
    let mut set = ObjectSet::NONE;
    for (index, object) in objects.iter().enumerate() {
        let body = Body { ball: Ball::around(object), form: object.shape.form() };
        if index == receiver || can_matter(&around, &body) {
            set = set.with(index);
        }
    }
    set
}

/// What is known of an object that might be in the way.
struct Body<R: Real> {
    ball: Option<Ball<R>>,
    form: Form<R>,
}

/// A ball around everything that a ray can meet of an object, with room for rounding.
#[derive(Clone, Copy)]
struct Ball<R: Real> {
    center: Vec3<R::Setup>,
    radius: R::Setup,
}

impl<R: Real> Ball<R> {
    /// Room for rounding, relative: well above the errors of the tests below.
    const SLACK: f32 = 1e-3;

    fn around<P: Intersect<R>>(object: &PreparedObject<P>) -> Option<Self> {
        let (center, radius) = match object.shape.form() {
            Form::Ball { center, radius } => (center.to_setup(), radius.to_setup()),
            _ => {
                let bounds = object.shape.bounds()?.to_setup();
                let center = bounds.center();
                (center, (bounds.max - center).length())
            }
        };
        let rounding =
            R::offset(R::from_setup(center.magnitude() + radius)).to_setup() * R::Setup::from_f32(8.0);
        Some(Self { center, radius: radius + radius * R::Setup::from_f32(Self::SLACK) + rounding })
    }

    /// Whether any of `other` may lie inside.
    fn reaches(&self, other: &Body<R>) -> bool {
        if let Form::Flat { normal, distance } = other.form
            && (normal.to_setup().dot(self.center) - distance.to_setup()).abs() > self.radius
        {
            return false;
        }
        other.ball.is_none_or(|ball| (ball.center - self.center).length() <= self.radius + ball.radius)
    }

    /// Whether any of `other` may stand between a point inside and the light.
    fn is_shaded_by(&self, other: &Body<R>, light: &Source<R>) -> bool {
        if let Form::Flat { normal, distance } = other.form {
            // What lies in a plane shades nothing if light and receiver are both on one side of it.
            let (normal, distance) = (normal.to_setup(), distance.to_setup());
            let height = normal.dot(self.center) - distance;
            let toward_light = match light {
                Source::At(position) => normal.dot(position.to_setup()) - distance,
                Source::Far(position, shrink) => {
                    normal.dot(position.to_setup()) - distance * shrink.to_setup()
                }
                Source::Toward(direction) => normal.dot(direction.to_setup()),
            };
            let above = height > self.radius && toward_light > R::Setup::ZERO;
            let below = height < -self.radius && toward_light < R::Setup::ZERO;
            if above || below {
                return false;
            }
        }
        let Some(ball) = other.ball else { return true };
        let reach = self.radius + ball.radius;
        match light {
            Source::At(position) => {
                let position = position.to_setup();
                let (receiver, blocker) = (self.center - position, ball.center - position);
                let (far, near) = (receiver.length(), blocker.length());
                if far <= self.radius || near <= ball.radius {
                    return true;
                }
                if near - ball.radius > far + self.radius {
                    return false;
                }
                // Seen from the light, the two balls overlap if the angle between them is at most the sum of
                // their angular radii.
                let sine_of = |radius: R::Setup, distance: R::Setup| radius / distance;
                let cosine_of = |sine: R::Setup| (R::Setup::ONE - sine * sine).larger(R::Setup::ZERO).sqrt();
                let (sine_a, sine_b) = (sine_of(self.radius, far), sine_of(ball.radius, near));
                let apart = receiver.dot(blocker) / far / near;
                let touching = cosine_of(sine_a) * cosine_of(sine_b) - sine_a * sine_b;
                apart >= touching - R::Setup::from_f32(1e-5)
            }
            Source::Far(..) => true,
            Source::Toward(direction) => {
                let direction = direction.to_setup();
                let toward = ball.center - self.center;
                let along = toward.dot(direction);
                let across = toward - direction * along;
                along >= -reach && across.length() <= reach
            }
        }
    }
}
