//! Where an object can be seen, or the shadow of one: an ellipse or a rectangle around it, found once for a picture.
//!
//! A ball is seen from one point within a cone, and the directions d(u, v) = middle + u · right + v · down through the
//! places of a picture are linear, so the places from which (c · d)² ≥ k d² form a conic in u and v. A shadow is the same
//! conic, seen from the light: for the places p of a plane n · p = h that are seen from the eye e,
//!
//! p − light ∝ (e − light) (n · d) + (h − n · e) d
//!
//! is linear in u and v as well. Under a light far away, a ball shades what is nearer to the line through its center than its
//! radius, and that is a conic too.
//!
//! All this is done in floating point, once, and what depends on the eye or on a light alone once for all balls; then a line asks each
//! outline for its pixels in integers, for about 40 instructions. Outlines are wider than what they hold by a hundredth and by a pixel: by more than all rounding.

use super::line_candidates::Span;
use crate::camera::{Affine, Rect, Viewport};
use crate::light::Source;
use crate::math::{Aabb, Real, Vec3};

/// The pixels that something can be seen in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outline {
    Nowhere,
    Everywhere,
    /// The same pixels on all lines from `top` up to, but without, `bottom`.
    Rectangle {
        across: Span,
        top: u16,
        bottom: u16,
    },
    /// Its middle in 256ths of a pixel, how far the middle of a line moves from each to the next in 65536ths, half the
    /// width in pixels, and 2³¹ over half the height.
    Ellipse {
        x: i32,
        y: i32,
        slope: i32,
        half_width: u16,
        inverse_half_height: u32,
    },
}

impl Outline {
    /// The outline of a box.
    pub(super) fn of_box<R: Real>(bounds: Aabb<R::Setup>, viewport: &Viewport<R>) -> Self {
        let Some(Rect { left, right, top, bottom }) = viewport.frame(bounds) else { return Self::Everywhere };
        let across = Span { start: pixel(left, -1), end: pixel(right, 2) };
        let (top, bottom) = (pixel(top, -1), pixel(bottom, 2));
        Self::Rectangle { across, top, bottom }
    }

    /// How much it holds, in pixels, roughly.
    pub(super) fn area(&self) -> u32 {
        match *self {
            Self::Nowhere => 0,
            Self::Everywhere => u32::MAX,
            Self::Rectangle { across, top, bottom } => {
                u32::from(across.end.saturating_sub(across.start)) * u32::from(bottom.saturating_sub(top))
            }
            // Nothing flat has one.
            Self::Ellipse { half_width, .. } => u32::from(half_width),
        }
    }

    /// Whether it is less than so many lines high. Only of ellipses that is known.
    pub(super) fn is_lower_than(&self, lines: u32) -> bool {
        matches!(*self, Self::Ellipse { inverse_half_height, .. }
            if u64::from(inverse_half_height) * u64::from(lines) > 1 << 32)
    }

    /// Its pixels on the lines from `top` to `bottom`, both included.
    pub(super) fn lines(&self, top: u16, bottom: u16) -> Span {
        if let Self::Ellipse { y, .. } = *self {
            // The line that is nearest to the middle is the longest.
            let middle = (y >> 8).max(i32::from(top)).min(i32::from(bottom));
            if self.span(middle as u16) == Span::NOWHERE {
                return Span::NOWHERE;
            }
        }
        (top..=bottom).map(|y| self.span(y)).fold(Span::NOWHERE, Span::hull)
    }

    /// Its pixels on line `y`.
    pub(super) fn span(&self, y: u16) -> Span {
        match *self {
            Self::Nowhere => Span::NOWHERE,
            Self::Everywhere => Span::EVERYWHERE,
            Self::Rectangle { across, top, bottom } => {
                if y >= top && y < bottom {
                    across
                } else {
                    Span::NOWHERE
                }
            }
            Self::Ellipse { x, y: middle, slope, half_width, inverse_half_height } => {
                let down = (i32::from(y) << 8 | 0x80).wrapping_sub(middle);
                // How far from the middle, as a share of half the height, in 65536ths.
                let share = (u64::from(down.unsigned_abs()) * u64::from(inverse_half_height)) >> 23;
                if share >= 1 << 16 {
                    return Span::NOWHERE;
                }
                let share = share as u32;
                let root = u32::MAX.wrapping_sub(share.wrapping_mul(share)).isqrt();
                let half = ((u32::from(half_width) * root) >> 16) as i32;
                let x = x.saturating_add(((i64::from(down) * i64::from(slope)) >> 16) as i32) >> 8;
                let place = |x: i32| u16::try_from(x.max(0)).unwrap_or(u16::MAX);
                Span {
                    start: place(x.saturating_sub(half).saturating_sub(1)),
                    end: place(x.saturating_add(half).saturating_add(2)),
                }
            }
        }
    }
}

/// The pixel of a place, and some more.
pub(super) fn pixel<N: Real>(place: N, more: i32) -> u16 {
    let place = place.floor_to_i32().saturating_add(more).max(0);
    u16::try_from(place).unwrap_or(u16::MAX)
}

/// How much larger a ball is taken to be than it is.
const WIDER: f32 = 1.01;

/// A point that balls are seen from, with what all their outlines have in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vantage<N> {
    point: Vec3<N>,
    /// The directions to the places of the picture, in units of the longest, so that nothing is large.
    directions: Affine<Vec3<N>>,
    /// Their squared lengths.
    squares: Conic<N>,
    half_size: (N, N),
}

impl<N: Real> Vantage<N> {
    /// The eye.
    pub(super) fn eye<R: Real<Setup = N>>(viewport: &Viewport<R>) -> Self {
        Self::new(viewport.eye().to_setup(), viewport.directions(), viewport.half_size())
    }

    /// A point and directions to the places of the picture, that may be any that are linear, and of any length.
    fn new(point: Vec3<N>, directions: Affine<Vec3<N>>, half_size: (N, N)) -> Self {
        let Affine { middle, right, down } = directions.map(Vec3::magnitude);
        let unit = middle.larger(right).larger(down).recip();
        let directions = directions.map(|direction| direction * unit);
        Self { point, directions, squares: Conic::of_lengths(directions), half_size }
    }

    /// The outline of a ball.
    #[inline(never)]
    pub(super) fn outline(&self, center: Vec3<N>, radius: N) -> Outline {
        let c = center - self.point;
        let distance = c.length();
        // Of a ball that is seen smaller than a few degrees, rounding would eat the difference of squares.
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

/// A light and a plane, for the outlines of shadows that balls throw there, as far as that is in front of the eye.
#[derive(Clone, Copy, Debug)]
pub(super) enum Projector<N> {
    At(Vantage<N>),
    Toward {
        toward: Vec3<N>,
        /// The plane's normal times the directions to the places of the picture.
        slants: Affine<N>,
        eye: Vec3<N>,
        /// The way from there to the places of the plane, times their depths.
        places: Affine<Vec3<N>>,
        half_size: (N, N),
    },
    /// Of these lights outlines are everywhere.
    Unknown,
}

impl<N: Real> Projector<N> {
    pub(super) fn new<R: Real<Setup = N>>(
        light: &Source<R>,
        (normal, distance): (Vec3<N>, N),
        viewport: &Viewport<R>,
    ) -> Self {
        let (eye, half_size) = (viewport.eye().to_setup(), viewport.half_size());
        let height = distance - normal.dot(eye);
        // So that what is in front of the eye is on the positive side.
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
    pub(super) fn outline(&self, center: Vec3<N>, radius: N) -> Outline {
        match *self {
            Self::At(ref vantage) => vantage.outline(center, radius),
            Self::Toward { toward, slants, eye, places, half_size } => {
                let radius = radius * N::from_f32(WIDER);
                let places = seen_from(center, eye, slants, places);
                // What is nearer to the line toward the light than the radius.
                Conic::of_square(slants.map(|slant| radius * slant))
                    .plus(Conic::of_square(places.map(|place| place.dot(toward))))
                    .plus(Conic::of_lengths(places).times(-N::ONE))
                    .outline(half_size, None)
            }
            Self::Unknown => Outline::Everywhere,
        }
    }
}

/// The way from a point to the places of a plane, times their depths, where the way from the eye is known.
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

/// Half the width or height beyond which an outline is everywhere, in half pictures: its conic may be open, and be seen
/// around the eye.
const OPEN: f32 = 16.0;

/// All (u, v) with `uu·u² + 2uv·uv + vv·v² + 2u·u + 2v·v + one ≥ 0`.
#[derive(Clone, Copy, Debug)]
struct Conic<N> {
    uu: N,
    uv: N,
    vv: N,
    u: N,
    v: N,
    one: N,
}

impl<N: Real> Conic<N> {
    /// The square of a function.
    fn of_square(function: Affine<N>) -> Self {
        Self::of_products(function, |a, b| a * b)
    }

    /// The squared length of a vector.
    fn of_lengths(vector: Affine<Vec3<N>>) -> Self {
        Self::of_products(vector, Vec3::dot)
    }

    #[inline(always)]
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

    fn times(self, factor: N) -> Self {
        let Self { uu, uv, vv, u, v, one } = self;
        let [uu, uv, vv, u, v, one] = [uu, uv, vv, u, v, one].map(|coefficient| coefficient * factor);
        Self { uu, uv, vv, u, v, one }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            uu: self.uu + other.uu,
            uv: self.uv + other.uv,
            vv: self.vv + other.vv,
            u: self.u + other.u,
            v: self.v + other.v,
            one: self.one + other.one,
        }
    }

    /// In pixels, where the picture has this half width and height; nowhere, if its middle is where `front` is not
    /// positive: behind, in the other half of a cone.
    #[inline(never)]
    fn outline(&self, (width, height): (N, N), front: Option<Affine<N>>) -> Outline {
        let Self { uu, uv, vv, u, v, one } = *self;
        // On the line v its ends are (uv·v + u ± √(−p2 v² + 2 p1 v + p0)) / a.
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
        // Beyond, pixels could no longer be counted in 256ths.
        let is_near = middle_u.abs() < N::from_f32(100.0) && middle_v.abs() < N::from_f32(100.0);
        let slope = slope * width / height;
        let is_near = is_near && slope.abs() < N::from_f32(100.0);
        let (half_width, half_height) = (half_width * width, half_height * height);
        if !(is_closed && is_near && half_width < N::from_f32(60_000.0)) {
            return Outline::Everywhere;
        }
        let is_in_front =
            |front: Affine<N>| front.middle + front.right * middle_u + front.down * middle_v > N::ZERO;
        if !front.is_none_or(is_in_front) {
            return Outline::Nowhere;
        }
        // A little more, for the roundings here.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::math::Scale;

    const SIZE: (u16, u16) = (90, 70);

    fn viewport(camera: Camera) -> Viewport<f32> {
        Viewport::new(&camera.prepare(Scale::ONE).unwrap(), SIZE.0, SIZE.1)
    }

    const CAMERA: Camera = Camera {
        eye: Vec3::new(0.5, 2.0, 10.0),
        target: Vec3::new(0.0, 0.0, 0.0),
        up: Vec3::new(0.1, 1.0, 0.0),
        vertical_fov: 0.8,
    };

    /// Numbers from 0 to 1, the same in every run.
    struct Numbers(u32);

    impl Numbers {
        fn next(&mut self) -> f32 {
            self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (self.0 >> 8) as f32 / (1 << 24) as f32
        }

        fn point(&mut self, size: f32) -> Vec3 {
            Vec3::new(self.next() - 0.5, self.next() - 0.5, self.next() - 0.5) * size
        }
    }

    /// Every pixel for which `is_in` must be in the outline; tells how many are, and how many are in the outline alone.
    fn compare(
        outline: &Outline,
        viewport: &Viewport<f32>,
        is_in: impl Fn(Vec3, Vec3) -> bool,
    ) -> (u32, u32) {
        let (mut inside, mut vain) = (0, 0);
        for y in 0..SIZE.1 {
            let span = outline.span(y);
            for x in 0..SIZE.0 {
                let ray = viewport.ray((x, 0x8000), (y, 0x8000));
                let is_held = x >= span.start && x < span.end;
                if is_in(ray.origin, ray.direction) {
                    assert!(is_held, "{outline:?} has not {x}, {y}");
                    inside += 1;
                } else if is_held && *outline != Outline::Everywhere {
                    vain += 1;
                }
            }
        }
        (inside, vain)
    }

    /// Whether the way from a point along a unit vector, at most so far, comes into a ball.
    fn meets(origin: Vec3, direction: Vec3, distance: f32, center: Vec3, radius: f32) -> bool {
        let toward = center - origin;
        let along = toward.dot(direction).clamp(0.0, distance);
        (toward - direction * along).length() < radius
    }

    #[test]
    fn balls_are_inside_of_their_outlines() {
        let mut numbers = Numbers(1);
        let (mut inside, mut vain, mut closed) = (0, 0, 0);
        for _ in 0..1000 {
            let viewport = viewport(Camera { vertical_fov: 0.2 + 2.0 * numbers.next(), ..CAMERA });
            let (center, radius) = (numbers.point(25.0), 0.02 + 3.0 * numbers.next() * numbers.next());
            let outline = Vantage::eye(&viewport).outline(center, radius);
            let (held, more) = compare(&outline, &viewport, |origin, direction| {
                meets(origin, direction, 1e6, center, radius)
            });
            closed += u32::from(outline != Outline::Everywhere);
            (inside, vain) = (inside + held, vain + more);
        }
        // They are wider by a few pixels each, and few balls have none.
        assert!(closed > 900 && inside > 30_000 && vain < inside, "{closed} {inside} {vain}");
    }

    #[test]
    fn shadows_are_inside_of_their_outlines() {
        let mut numbers = Numbers(2);
        let (mut inside, mut vain, mut closed) = (0, 0, 0);
        for index in 0..1000 {
            let viewport = viewport(Camera { vertical_fov: 0.3 + 1.5 * numbers.next(), ..CAMERA });
            let (center, radius) = (numbers.point(8.0), 0.05 + 2.0 * numbers.next() * numbers.next());
            let (normal, _) = (Vec3::new(0.0, 1.0, 0.0) + numbers.point(1.0)).unit_and_length();
            let distance = -3.0 + 2.0 * numbers.next();
            let light = numbers.point(30.0) + Vec3::new(0.0, 15.0, 0.0);
            let source =
                if index % 2 == 0 { Source::At(light) } else { Source::Toward(light.unit_and_length().0) };
            let outline = Projector::new(&source, (normal, distance), &viewport).outline(center, radius);
            let (held, more) = compare(&outline, &viewport, |origin, direction| {
                let depth = (distance - normal.dot(origin)) / normal.dot(direction);
                if !(depth > 0.0 && depth < 1e3) {
                    return false;
                }
                let point = origin + direction * depth;
                let (toward, far) = match source {
                    Source::At(light) => (light - point).unit_and_length(),
                    _ => (light.unit_and_length().0, 1e6),
                };
                meets(point, toward, far, center, radius)
            });
            closed += u32::from(outline != Outline::Everywhere);
            (inside, vain) = (inside + held, vain + more);
        }
        // Some lie below the plane or above the light, and shade nothing.
        assert!(closed > 900 && inside > 20_000 && vain < 2 * inside, "{closed} {inside} {vain}");
    }

    #[test]
    fn lines_of_an_ellipse_are_those_of_each_and_its_height_is_known() {
        let viewport = viewport(CAMERA);
        let outline = Vantage::eye(&viewport).outline(Vec3::new(1.0, 0.5, 0.0), 1.0);
        let height = (0..SIZE.1).filter(|y| outline.span(*y) != Span::NOWHERE).count() as u32;
        // Wider by less than a line on either side.
        assert!(outline.is_lower_than(height + 1) && !outline.is_lower_than(height - 2), "{height}");
        for top in 0..SIZE.1 {
            for bottom in top..SIZE.1 {
                let all = (top..=bottom).map(|y| outline.span(y)).fold(Span::NOWHERE, Span::hull);
                assert_eq!(outline.lines(top, bottom), all);
            }
        }
    }

    #[test]
    fn boxes_are_seen_between_their_corners() {
        let viewport =
            viewport(Camera { eye: Vec3::new(0.0, 0.0, 10.0), up: Vec3::new(0.0, 1.0, 0.0), ..CAMERA });
        let unit = Vec3::new(1.0, 1.0, 1.0);
        let outline = Outline::of_box(Aabb::around(Vec3::ZERO, unit), &viewport);
        // Half a unit is 70 / 2 / tan(0.4) / 9 pixels high at its front.
        let half = 35.0 / 0.4f32.tan() / 9.0;
        let Span { start, end } = outline.span(35);
        assert!(
            (f32::from(start) - (45.0 - half)).abs() < 2.5 && (f32::from(end) - (45.0 + half)).abs() < 2.5
        );
        assert_eq!(outline.span(5), Span::NOWHERE);
        assert_eq!(
            Outline::of_box(Aabb::around(Vec3::new(0.0, 0.0, 10.0), unit), &viewport),
            Outline::Everywhere
        );
    }
}
