//! The candidates of rays: sets of the objects that a ray from a known place can meet, computed when the
//! scene is prepared.
//!
//! There are two kinds of sets:
//! - for each object and each light, the objects that can stand between them: those that reach into the space
//!   around both (Haines and Greenberg, "The Light Buffer: A Shadow-Testing Accelerator", IEEE CG&A 1986,
//!   with the receiving object in place of the direction);
//! - for each object and each of its two sides, the objects that a ray can meet which leaves the object to
//!   that side. A ray into a ball can meet only the objects that reach into the ball, before it comes out. A
//!   ray that leaves a ball outward, or a flat object, can meet all objects but that one. A ray that leaves
//!   another object can meet all objects.
//!
//! A set is a word of 32 bits, so only scenes of up to 32 objects have sets. All tests compare bounding
//! balls, with room for rounding and for the ray offset: a set may hold too many objects, but never too few,
//! and pictures have the same bytes with and without sets.

use super::{Departure, ObjectSet, PreparedObject};
use crate::arena::Arena;
use crate::fault::Fault;
use crate::light::{PreparedLight, Source};
use crate::material::Shininess;
use crate::math::{Real, Vec3};
use crate::shape::{Form, Intersect};

/// The sets of a scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidates<'m, R: Real> {
    all: ObjectSet,
    /// For each object, the candidates of rays that leave it inward and outward. Inward from a ball, they
    /// are valid up to the place where the ray comes out.
    leaving: &'m [[ObjectSet; 2]],
    /// One for each object and light.
    pairs: &'m [Pair<R>],
    lights: usize,
    /// Fifteen times the largest coordinate of an object with bounds. Pairs and the outlines of shadows are
    /// valid for hits of a [`Surface::magnitude`](crate::Surface::magnitude) up to it. Other hits lie far out
    /// on infinite planes, or on a small part that is cut out of something large.
    reach: R,
}

/// An object and a light.
#[derive(Clone, Copy, Debug)]
struct Pair<R: Real> {
    /// The objects that can stand between them.
    between: ObjectSet,
    /// The object as the light sees it, if it is a ball.
    ball: BallFromLight<R>,
}

/// A ball as a point light sees it: a circle of directions. A shadow ray toward the light can meet the ball
/// only if the opposite of its direction lies in the circle.
#[derive(Clone, Copy, Debug)]
struct BallFromLight<R: Real> {
    /// Unit vector from the light toward the center; 0 if the object is no ball or the light lies inside it.
    toward_center: Vec3<R>,
    /// Minus the cosine of the circle's radius, with room for rounding: a shadow ray whose direction has a
    /// larger product with `toward_center` misses the ball.
    least_opposite: R,
    /// As `least_opposite`, for the radius plus the angle at which a highlight fades out: a mirrored ray
    /// whose direction has a larger product with `toward_center` shows no highlight.
    least_glinting: R,
}

impl<R: Real> BallFromLight<R> {
    /// Rules nothing out: the product with the vector 0 is 0.
    const UNKNOWN: Self = Self { toward_center: Vec3::ZERO, least_opposite: R::ONE, least_glinting: R::ONE };

    fn new(form: Form<R>, shininess: &Shininess<R>, light: &Source<R>, reach: R) -> Self {
        let (Form::Ball { center, radius }, Source::At(position)) = (form, light) else {
            return Self::UNKNOWN;
        };
        let (position, radius) = (position.to_setup(), radius.to_setup());
        let toward_center = center.to_setup() - position;
        let radius = radius + radius * R::Setup::from_f32(1e-3) + shadow_ray_deviation((reach, reach), light);
        let distance_squared = toward_center.length_squared();
        let rounding = distance_squared * (R::Setup::RAY_OFFSET * R::Setup::from_f32(4.0));
        let tangent_squared = distance_squared - rounding - radius * radius;
        if !(tangent_squared > R::Setup::ZERO) {
            return Self::UNKNOWN;
        }
        let (toward_center, distance) = toward_center.unit_and_length();
        let (cosine, sine) = (tangent_squared.sqrt() / distance, radius / distance);
        // Only fixed point uses it, see `ShadedHit::local_light`.
        let mut least_glinting = R::Setup::ONE;
        if R::IS_FIXED_POINT {
            // The cosine of the sum of two angles: the ball's angular radius, and the one at which a
            // highlight fades out.
            let fading = shininess.least().to_setup();
            let sine_of_fading = (R::Setup::ONE - fading * fading).larger(R::Setup::ZERO).sqrt();
            least_glinting = sine_of_fading * sine - fading * cosine + R::Setup::from_f32(1e-5);
        }
        Self {
            toward_center: Vec3::from_setup(toward_center),
            least_opposite: R::from_setup(-cosine),
            least_glinting: R::from_setup(least_glinting),
        }
    }

    /// Whether a shadow ray of this direction surely misses the ball.
    fn is_passed_by(&self, toward_light: Vec3<R>) -> bool {
        self.toward_center.dot_bounds(toward_light).0 > self.least_opposite
    }

    /// Whether the ball may show a highlight at a place where rays are mirrored into this direction.
    fn may_have_highlight(&self, mirrored: Vec3<R>) -> bool {
        !(self.toward_center.dot_bounds(mirrored).0 > self.least_glinting)
    }
}

/// The largest distance between a shadow ray and the straight way from a hit within `reach` to a light: the
/// ray begins off the surface by the ray offset of its `magnitude`, and its direction is rounded.
// Not inlined: 144 bytes of flash in a program for an M4F.
#[inline(never)]
fn shadow_ray_deviation<R: Real>((reach, magnitude): (R, R), light: &Source<R>) -> R::Setup {
    let (largest, farthest) = match light {
        Source::At(position) => {
            let far = position.to_setup().magnitude();
            // The distance is at most √3 times the sum of the two largest coordinates.
            let farthest = (reach.to_setup() + far) * R::Setup::from_f32(1.74);
            (R::from_setup(magnitude.to_setup().larger(far)), farthest)
        }
        _ => (magnitude, R::Setup::ZERO),
    };
    R::offset(largest).to_setup() * R::Setup::from_f32(8.0) + R::toward_light_error(farthest)
}

impl<'m, R: Real> Candidates<'m, R> {
    /// The number of objects with sets: none in a scene of too many.
    const fn stored(objects: usize) -> usize {
        if objects > ObjectSet::CAPACITY { 0 } else { objects }
    }

    /// The bytes that the sets of a scene take.
    pub(super) const fn bytes(objects: usize, lights: usize) -> usize {
        let objects = Self::stored(objects);
        // 32 objects and 65535 lights are far from overflowing.
        let pairs = objects.saturating_mul(lights);
        Arena::bytes::<[ObjectSet; 2]>(objects).saturating_add(Arena::bytes::<Pair<R>>(pairs))
    }

    /// Computes the sets, unless the scene has too many objects.
    pub(super) fn new<P: Intersect<R>>(
        objects: &[PreparedObject<'_, R, P>],
        lights: &[PreparedLight<R>],
        arena: &mut Arena<'m>,
    ) -> Result<Option<Self>, Fault> {
        if !cfg!(feature = "candidates") || objects.len() > ObjectSet::CAPACITY {
            return Ok(None);
        }
        let all = ObjectSet::first(objects.len());
        let meets_itself =
            |index: usize| objects.get(index).is_none_or(|object| object.form().is_met_again(true));
        let but_itself = |set: ObjectSet, index| if meets_itself(index) { set } else { set.without(index) };
        let leaving = arena.store_with(objects.len(), |index| {
            let outward = but_itself(all, index);
            let inward = match objects.get(index).map(PreparedObject::form) {
                // A ray that goes into a ball smaller than the ray offset begins outside of it.
                Some(Form::Ball { center, radius })
                    if !(radius > R::offset(center.magnitude() + radius) * R::from_u16(8)) =>
                {
                    all
                }
                Some(Form::Ball { .. }) => {
                    candidates_for(objects, index, |around, other| around.reaches(other))
                }
                _ => outward,
            };
            [inward, outward]
        })?;
        let bounds = objects.iter().filter_map(PreparedObject::bounds);
        let largest = bounds.fold(R::ZERO, |largest, bounds| largest.larger(bounds.magnitude()));
        // In fixed point objects lie within 8 units, so that 15 times as much is in range.
        let reach = largest * R::from_u16(15);
        let pairs = arena.store_with(objects.len() * lights.len(), |index| {
            let receiver = index.checked_div(lights.len()).unwrap_or(0);
            let light = index.checked_rem(lights.len()).and_then(|light| lights.get(light));
            let between = candidates_for(objects, receiver, |around, other| {
                light.is_none_or(|light| around.is_shaded_by(other, (&light.source, reach)))
            });
            let ball = match (objects.get(receiver), light) {
                (Some(object), Some(light)) => {
                    BallFromLight::new(object.form(), &object.material.shininess, &light.source, reach)
                }
                _ => BallFromLight::UNKNOWN,
            };
            Pair { between: but_itself(between, receiver), ball }
        })?;
        Ok(Some(Self { all, leaving, pairs, lights: lights.len(), reach }))
    }

    /// All objects: the candidates of a ray from far away.
    pub(crate) fn all(&self) -> ObjectSet {
        self.all
    }

    /// The candidates of a ray that leaves a surface; for a ray into a ball, up to the place where it comes
    /// out.
    pub(crate) fn leaving(&self, from: Departure) -> ObjectSet {
        match self.leaving.get(from.object) {
            Some([inward, outward]) => {
                if from.outward {
                    *outward
                } else {
                    *inward
                }
            }
            None => self.all,
        }
    }

    /// Whether a ray goes into a ball, so that [`leaving`](Self::leaving) is valid only inside it.
    pub(crate) fn comes_out_again(&self, from: Departure) -> bool {
        // Only balls have different sets on their two sides.
        !from.outward && self.leaving.get(from.object).is_some_and(|[inward, outward]| inward != outward)
    }

    /// The objects that can stand between a surface and a light, for hits that [are near](Self::are_near).
    pub(crate) fn between(&self, from: Departure, light: usize) -> ObjectSet {
        let set = self.pair(from.object, light).map_or(self.all, |pair| pair.between);
        if from.outward { set } else { set.with(from.object) }
    }

    /// The largest distance between a shadow ray and the straight way to the light, for hits that
    /// [are near](Self::are_near).
    pub(super) fn shadow_ray_deviation(&self, light: &Source<R>) -> R::Setup {
        shadow_ray_deviation((self.reach, self.reach), light)
    }

    /// Whether a hit of this [`Surface::magnitude`](crate::Surface::magnitude) is near enough for
    /// [`between`](Self::between), [`shadow_ray_deviation`](Self::shadow_ray_deviation) and
    /// [`not_passed_by`](Self::not_passed_by).
    pub(super) fn are_near(&self, magnitude: R) -> bool {
        magnitude <= self.reach
    }

    /// Whether an object may have a highlight of a light at a place where rays are mirrored into this
    /// direction.
    pub(super) fn may_have_highlight(&self, object: usize, light: usize, mirrored: Vec3<R>) -> bool {
        self.pair(object, light).is_none_or(|pair| pair.ball.may_have_highlight(mirrored))
    }

    fn pair(&self, object: usize, light: usize) -> Option<&Pair<R>> {
        self.pairs.get(object.wrapping_mul(self.lights).wrapping_add(light))
    }

    /// The set without balls that a shadow ray of this direction surely misses. In floating point only the
    /// balls before the first other object are left out: the test takes as long as an intersection there.
    pub(super) fn not_passed_by(&self, mut set: ObjectSet, light: usize, toward_light: Vec3<R>) -> ObjectSet {
        let is_passed =
            |object| self.pair(object, light).is_some_and(|pair| pair.ball.is_passed_by(toward_light));
        while let Some(object) = set.lowest()
            && is_passed(object)
        {
            set = set.without_lowest();
        }
        if R::IS_FIXED_POINT {
            for object in set.without_lowest() {
                if is_passed(object) {
                    set = set.without(object);
                }
            }
        }
        set
    }
}

/// The candidates of rays that leave a receiver: the receiver itself, and the objects for which `can_matter`
/// is true of the ball around the receiver; all objects, if the receiver has no such ball.
fn candidates_for<R: Real, P: Intersect<R>>(
    objects: &[PreparedObject<'_, R, P>],
    receiver: usize,
    can_matter: impl Fn(&BoundingBall<R>, &Blocker<R>) -> bool,
) -> ObjectSet {
    let Some(around) = objects.get(receiver).and_then(BoundingBall::around) else {
        return ObjectSet::first(objects.len());
    };
    let mut set = ObjectSet::NONE;
    for (index, object) in objects.iter().enumerate() {
        let blocker = Blocker { ball: BoundingBall::around(object), form: object.form() };
        if index == receiver || can_matter(&around, &blocker) {
            set = set.with(index);
        }
    }
    set
}

/// An object that may be in the way.
struct Blocker<R: Real> {
    ball: Option<BoundingBall<R>>,
    form: Form<R>,
}

/// A ball around an object: every hit lies inside, with room for rounding.
#[derive(Clone, Copy)]
pub(super) struct BoundingBall<R: Real> {
    pub(super) center: Vec3<R::Setup>,
    pub(super) radius: R::Setup,
}

impl<R: Real> BoundingBall<R> {
    /// Room for rounding, relative: well above the errors of the tests below.
    const SLACK: f32 = 1e-3;

    pub(super) fn around<P: Intersect<R>>(object: &PreparedObject<'_, R, P>) -> Option<Self> {
        let (center, radius) = match object.form() {
            Form::Ball { center, radius } => (center.to_setup(), radius.to_setup()),
            _ => {
                let bounds = object.bounds()?.to_setup();
                let center = bounds.center();
                (center, (bounds.max - center).length())
            }
        };
        let rounding =
            R::offset(R::from_setup(center.magnitude() + radius)).to_setup() * R::Setup::from_f32(8.0);
        Some(Self { center, radius: radius + radius * R::Setup::from_f32(Self::SLACK) + rounding })
    }

    /// Whether any of `other` may lie inside.
    fn reaches(&self, other: &Blocker<R>) -> bool {
        if let Form::Flat { normal, distance } = other.form
            && (normal.to_setup().dot(self.center) - distance.to_setup()).abs() > self.radius
        {
            return false;
        }
        other.ball.is_none_or(|ball| (ball.center - self.center).length() <= self.radius + ball.radius)
    }

    /// Whether any of `other` may stand between the light and a hit inside, of at most this magnitude.
    fn is_shaded_by(&self, other: &Blocker<R>, (light, magnitude): (&Source<R>, R)) -> bool {
        // How far beside its way a shadow ray may be: it begins off the receiver's surface by the ray offset,
        // which may be more than that of the ball: a part that is cut out of a long cone is hit with the
        // rounding of the whole cone.
        let largest = R::from_setup(self.center.magnitude() + self.radius);
        let astray = shadow_ray_deviation((largest, magnitude.larger(largest)), light);
        if let Form::Flat { normal, distance } = other.form {
            // An object in a plane shades nothing if light and receiver are both on one side of the plane.
            let (normal, distance) = (normal.to_setup(), distance.to_setup());
            let height = normal.dot(self.center) - distance;
            // The light's height above the plane, and by how much it must be beside the plane: heights in the
            // light's own scale; for a direction its sine, which two computations round to different numbers.
            let (toward_light, room) = match light {
                Source::At(position) => (normal.dot(position.to_setup()) - distance, astray),
                Source::Far(position, shrink) => {
                    let shrink = shrink.to_setup();
                    let rounding = R::offset(position.magnitude()).to_setup();
                    (normal.dot(position.to_setup()) - distance * shrink, astray * shrink + rounding)
                }
                Source::Toward(direction) => (normal.dot(direction.to_setup()), R::RAY_OFFSET.to_setup()),
            };
            let above = height > self.radius && toward_light > room;
            let below = height < -self.radius && toward_light < -room;
            if above || below {
                return false;
            }
        }
        let Some(mut ball) = other.ball else { return true };
        ball.radius = ball.radius + astray;
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
