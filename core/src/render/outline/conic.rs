//! Conics in the picture: the curves in which cones of light or sight meet it.

use super::Outline;
use crate::camera::Affine;
use crate::math::{Real, Vec3};
use crate::render::span::pixel;

/// An ellipse of more than this half width or half height counts as everywhere: its conic may be open, or lie
/// around the eye. In units of half the picture, like the limits below.
const OPEN: f32 = 16.0;

/// A limit for the middle and the slope of an ellipse, so that they can be counted in fractions of a pixel.
const FAR: f32 = 100.0;

/// The largest half width of an ellipse, in pixels.
const WIDEST: f32 = 60_000.0;

/// All places (u, v) of a picture with `uu·u² + 2uv·uv + vv·v² + 2u·u + 2v·v + one ≥ 0`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Conic<N> {
    uu: N,
    uv: N,
    vv: N,
    u: N,
    v: N,
    one: N,
}

impl<N: Real> Conic<N> {
    /// The square of a linear function of u and v.
    pub(super) fn of_square(function: Affine<N>) -> Self {
        Self::of_products(function, |a, b| a * b)
    }

    /// The squared length of a vector that is linear in u and v.
    pub(super) fn of_lengths(vector: Affine<Vec3<N>>) -> Self {
        Self::of_products(vector, Vec3::dot)
    }

    fn of_products<T: Copy>(Affine { middle, right, down }: Affine<T>, product: impl Fn(T, T) -> N) -> Self {
        Self {
            uu: product(right, right),
            uv: product(right, down),
            vv: product(down, down),
            u: product(right, middle),
            v: product(down, middle),
            one: product(middle, middle),
        }
    }

    pub(super) fn times(self, factor: N) -> Self {
        let Self { uu, uv, vv, u, v, one } = self;
        let [uu, uv, vv, u, v, one] = [uu, uv, vv, u, v, one].map(|coefficient| coefficient * factor);
        Self { uu, uv, vv, u, v, one }
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            uu: self.uu + other.uu,
            uv: self.uv + other.uv,
            vv: self.vv + other.vv,
            u: self.u + other.u,
            v: self.v + other.v,
            one: self.one + other.one,
        }
    }

    /// The outline in a picture with this half width and half height in pixels. Nowhere, if `front` is not
    /// positive in the middle: then the conic is the other half of the cone, behind the eye.
    pub(super) fn outline(&self, (width, height): (N, N), front: Option<Affine<N>>) -> Outline {
        let Self { uu, uv, vv, u, v, one } = *self;
        // On the line v the conic ends at u = (uv·v + u ± √(−p2 v² + 2 p1 v + p0)) / a.
        let a = -uu;
        let (p2, p1, p0) = (-(uv * uv + a * vv), uv * u + a * v, u * u + a * one);
        if !(a > N::ZERO && p2 > N::ZERO) {
            return Outline::Everywhere;
        }
        let middle_v = p1 / p2;
        let half_height = p0 / p2 + middle_v * middle_v;
        if half_height < N::ZERO {
            return Outline::Nowhere;
        }
        let half_height = half_height.sqrt();
        let slope = uv / a;
        let (middle_u, half_width) = (slope * middle_v + u / a, p2.sqrt() * half_height / a);
        let open = N::from_f32(OPEN);
        let is_closed = half_width < open && half_height < open && slope.abs() * half_height < open;
        let far = N::from_f32(FAR);
        let is_near = middle_u.abs() < far && middle_v.abs() < far;
        let slope = slope * width / height;
        let is_near = is_near && slope.abs() < far;
        let (half_width, half_height) = (half_width * width, half_height * height);
        if !(is_closed && is_near && half_width < N::from_f32(WIDEST)) {
            return Outline::Everywhere;
        }
        let is_in_front =
            |front: Affine<N>| front.middle + front.right * middle_u + front.down * middle_v > N::ZERO;
        if !front.is_none_or(is_in_front) {
            return Outline::Nowhere;
        }
        // Half the height is taken to be a little more, for rounding.
        let inverse_half_height = N::from_f32(2_147_483_648.0) / (half_height + N::from_f32(0.125));
        let place = |middle: N, half: N| ((half + middle * half) * N::from_f32(256.0)).floor_to_i32();
        Outline::Ellipse {
            x: place(middle_u, width),
            y: place(middle_v, height),
            slope: (slope * N::from_f32(65536.0)).floor_to_i32(),
            half_width: pixel(half_width, 1),
            inverse_half_height: inverse_half_height.floor_to_i32() as u32,
        }
    }
}
