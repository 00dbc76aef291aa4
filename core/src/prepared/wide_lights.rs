//! Obstacles to the light of lamps with a size and of the sky, in closed form: opaque balls, and opaque
//! planes without end.

use super::objects::PreparedObject;
use super::{Among, ObjectSet, PreparedScene, Through};
use crate::background::share_above;
use crate::light::{Cap, light_of_ball};
use crate::limits::FEW_OBJECTS;
use crate::material::PreparedMaterial;
use crate::math::{Ray, Real, Vec3};
use crate::shape::{Form, Geometry, Intersect};
use crate::throughput::Throughput;

impl<'m, R: Real, S: Geometry + 'm> PreparedScene<'m, R, S> {
    /// The share of a lamp's cap that the opaque balls leave uncovered, as seen from a point. The object that
    /// the point lies on and the lamp itself are no obstacles.
    pub(crate) fn left_by_balls(&self, cap: &Cap<R>, point: Vec3<R>, [own, lamp]: [usize; 2]) -> R {
        let mut left = R::ONE;
        for index in self.distributed.balls.without(own).without(lamp) {
            let Some(Form::Ball { center, radius }) = self.form(index) else { continue };
            if let Some(ball) = Cap::of_ball(center - point, radius)
                && ball.distance < cap.distance
            {
                left = left * (R::ONE - cap.covered_by(&ball));
            }
        }
        left
    }

    /// The ground below a point: the normal of the first opaque plane without end, on the point's side.
    pub(crate) fn ground(&self, point: Vec3<R>, own: usize) -> Option<Vec3<R>> {
        self.planes_around(point, own).next()
    }

    /// The normals of the opaque planes without end, on a point's side.
    fn planes_around(&self, point: Vec3<R>, own: usize) -> impl Iterator<Item = Vec3<R>> {
        self.distributed.planes.without(own).filter_map(move |index| match self.form(index)? {
            Form::Flat { normal, distance } if normal.dot(point) > distance => Some(normal),
            Form::Flat { normal, .. } => Some(-normal),
            _ => None,
        })
    }

    /// The share of an even sky that the opaque balls leave, and all opaque planes but the first, on a
    /// surface with this normal. Each ball hides sin² of its angular radius times the cosine of its middle
    /// (Quílez, "Sphere ambient occlusion"); a plane leaves (1 + cos γ) / 2, where γ is the angle between the
    /// normals.
    pub(crate) fn sky_left(&self, point: Vec3<R>, normal: Vec3<R>, own: usize) -> R {
        let mut left = R::ONE;
        for plane in self.planes_around(point, own).skip(1) {
            left = left * share_above(plane, normal);
        }
        for index in self.distributed.balls.without(own) {
            let Some(Form::Ball { center, radius }) = self.form(index) else { continue };
            left = left * (R::ONE - light_of_ball(center - point, radius, normal));
        }
        left
    }

    /// The light that gets through from a lamp in the direction of a ray, if balls that
    /// [`left_by_balls`](Self::left_by_balls) counts are not in the way.
    pub(crate) fn through_but_balls(&self, ray: &Ray<R>, distance: R, lamp: usize) -> Through<Throughput<R>> {
        let count = self.objects.len();
        let among = if count > FEW_OBJECTS {
            Among::All
        } else {
            Among::Few(ObjectSet::first(count).but(self.distributed.balls).without(lamp))
        };
        self.light_through_among(ray, distance, among)
    }
}

/// The balls and the planes without end that let no light through, in a scene of few objects; none in others.
pub(super) fn balls_and_planes<R: Real, P: Intersect<R>>(
    objects: &[PreparedObject<'_, R, P>],
) -> [ObjectSet; 2] {
    let mut sets = [ObjectSet::NONE; 2];
    let [balls, planes] = &mut sets;
    for (index, object) in objects.iter().enumerate().take_while(|_| objects.len() <= FEW_OBJECTS) {
        let PreparedMaterial { transmittance, maps, .. } = object.material;
        if *transmittance > R::ZERO || !maps.is_empty() {
            continue;
        }
        match object.form() {
            Form::Ball { .. } => *balls = balls.with(index),
            Form::Flat { .. } if object.shape.bounds().is_none() => *planes = planes.with(index),
            _ => {}
        }
    }
    sets
}
