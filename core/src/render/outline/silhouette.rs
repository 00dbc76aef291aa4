//! The outlines of balls as they are seen, and of their shadows on a plane.
//!
//! The directions d(u, v) = middle + u · right + v · down through the places (u, v) of a picture are linear
//! in u and v. From one point, a ball is seen within a cone: in the directions with (c · d)² ≥ k d². These
//! places form a conic.
//!
//! A shadow is the same conic, seen from the light. The place p on a plane n · p = h that is seen from the
//! eye e in direction d has
//!
//! p − light ∝ (e − light) (n · d) + (h − n · e) d
//!
//! which is linear in u and v as well. Under a light far away, a ball shades the points that are nearer than
//! its radius to the line through its center, and these form a conic too.
//!
//! Whatever depends only on the eye or on a light is worked out once for all balls.

use super::Outline;
use super::conic::Conic;
use crate::camera::{Affine, Viewport};
use crate::light::Source;
use crate::math::{Real, Vec3};

/// The factor by which balls are enlarged, to have room for rounding.
const WIDER: f32 = 1.01;

/// A point from which balls are seen, with what all of their outlines have in common.
#[derive(Clone, Copy, Debug)]
pub(in crate::render) struct Vantage<N> {
    point: Vec3<N>,
    /// The directions to the places of the picture, in units of the longest, so that no number is large.
    directions: Affine<Vec3<N>>,
    /// Their squared lengths.
    squares: Conic<N>,
    /// Half the width and half the height of the picture, in pixels.
    half_size: (N, N),
}

impl<N: Real> Vantage<N> {
    /// The eye of a camera.
    pub(in crate::render) fn eye<R: Real<Setup = N>>(viewport: &Viewport<R>) -> Self {
        Self::new(viewport.eye().to_setup(), viewport.directions(), viewport.half_size())
    }

    /// A point, and the directions to the places of the picture, which may have any length.
    fn new(point: Vec3<N>, directions: Affine<Vec3<N>>, half_size: (N, N)) -> Self {
        let Affine { middle, right, down } = directions.map(Vec3::magnitude);
        let unit = middle.larger(right).larger(down).recip();
        let directions = directions.map(|direction| direction * unit);
        Self { point, directions, squares: Conic::of_lengths(directions), half_size }
    }

    /// The outline of a ball.
    pub(in crate::render) fn outline(&self, center: Vec3<N>, radius: N) -> Outline {
        let c = center - self.point;
        let distance = c.length();
        // A ball that is seen smaller than a few degrees is enlarged: the difference of squares below would
        // be lost in rounding.
        let radius = radius.larger(distance * N::from_f32(0.02)) * N::from_f32(WIDER);
        if distance <= radius {
            return Outline::Everywhere;
        }
        let unit = distance.recip();
        let (c, relative) = (c * unit, radius * unit);
        let along = self.directions.map(|direction| c.dot(direction));
        let squares = self.squares.times(relative * relative - N::ONE);
        Conic::of_square(along).plus(squares).outline(self.half_size, Some(along))
    }
}

/// A light and a plane, for the outlines of the shadows of balls on the plane, as far as it is in front of
/// the eye.
#[derive(Clone, Copy, Debug)]
pub(in crate::render) enum Projector<N> {
    /// A light at a point, from which balls are seen.
    At(Vantage<N>),
    /// A light far away.
    Toward {
        /// Unit vector toward the light.
        toward: Vec3<N>,
        /// The dot products of the plane's normal and the directions to the places of the picture.
        slants: Affine<N>,
        eye: Vec3<N>,
        /// The vectors from the eye to the points of the plane, times `slants`.
        places: Affine<Vec3<N>>,
        half_size: (N, N),
    },
    /// A light whose place is beyond the number system's reach: all outlines are everywhere.
    Unknown,
}

impl<N: Real> Projector<N> {
    pub(in crate::render) fn new<R: Real<Setup = N>>(
        light: &Source<R>,
        (normal, distance): (Vec3<N>, N),
        viewport: &Viewport<R>,
    ) -> Self {
        let (eye, half_size) = (viewport.eye().to_setup(), viewport.half_size());
        let height = distance - normal.dot(eye);
        // With this sign, points in front of the eye have positive `slants`.
        let normal = if height < N::ZERO { -normal } else { normal };
        let directions = viewport.directions();
        let places = directions.map(|direction| direction * height.abs());
        let slants = directions.map(|direction| normal.dot(direction));
        match light {
            Source::At(light) => {
                let light = light.to_setup();
                let places = seen_from(light, eye, slants, places);
                Self::At(Vantage::new(light, places, half_size))
            }
            Source::Toward(toward) => {
                Self::Toward { toward: toward.to_setup(), slants, eye, places, half_size }
            }
            Source::Far(..) => Self::Unknown,
        }
    }

    /// The outline of the shadow of a ball.
    pub(in crate::render) fn outline(&self, center: Vec3<N>, radius: N) -> Outline {
        match *self {
            Self::At(ref vantage) => vantage.outline(center, radius),
            Self::Toward { toward, slants, eye, places, half_size } => {
                let radius = radius * N::from_f32(WIDER);
                let places = seen_from(center, eye, slants, places);
                // The points that are nearer than the radius to the line through the center toward the light.
                Conic::of_square(slants.map(|slant| radius * slant))
                    .plus(Conic::of_square(places.map(|place| place.dot(toward))))
                    .plus(Conic::of_lengths(places).times(-N::ONE))
                    .outline(half_size, None)
            }
            Self::Unknown => Outline::Everywhere,
        }
    }
}

/// The vectors from a point to the points of a plane, times `slants`. `places` are those from the eye.
fn seen_from<N: Real>(
    from: Vec3<N>,
    eye: Vec3<N>,
    slants: Affine<N>,
    places: Affine<Vec3<N>>,
) -> Affine<Vec3<N>> {
    let away = eye - from;
    Affine {
        middle: away * slants.middle + places.middle,
        right: away * slants.right + places.right,
        down: away * slants.down + places.down,
    }
}
