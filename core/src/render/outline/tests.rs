//! Outlines against every pixel's ray.

use super::super::span::Span;
use super::{Outline, Projector, Vantage};
use crate::camera::{Camera, Viewport};
use crate::light::Source;
use crate::math::{Aabb, Scale, Vec3};
use crate::sampling::RayNumbers;

const SIZE: (u16, u16) = (90, 70);

fn viewport(camera: Camera) -> Viewport<f32> {
    Viewport::new(&camera.prepare(Scale::ONE).unwrap(), SIZE.0, SIZE.1)
}

const CAMERA: Camera = Camera {
    eye: Vec3::new(0.5, 2.0, 10.0),
    target: Vec3::new(0.0, 0.0, 0.0),
    up: Vec3::new(0.1, 1.0, 0.0),
    vertical_fov: 0.8,
    lens: None,
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

/// Asserts that the outline holds every pixel for whose ray `is_in` is true; returns the number of these
/// pixels, and of the other pixels that the outline holds in vain.
fn compare(outline: &Outline, viewport: &Viewport<f32>, is_in: impl Fn(Vec3, Vec3) -> bool) -> (u32, u32) {
    let (mut inside, mut vain) = (0, 0);
    for y in 0..SIZE.1 {
        let span = outline.span(y);
        for x in 0..SIZE.0 {
            let ray =
                viewport.ray(viewport.across((x, 0x8000)), viewport.row((y, 0x8000)), &RayNumbers::NONE);
            let is_held = x >= span.start && x < span.end;
            if is_in(ray.origin, ray.direction) {
                assert!(is_held, "{outline:?} lacks {x}, {y}");
                inside += 1;
            } else if is_held && *outline != Outline::Everywhere {
                vain += 1;
            }
        }
    }
    (inside, vain)
}

/// Whether a ray that ends at `distance` enters a ball.
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
        let (held, more) =
            compare(&outline, &viewport, |origin, direction| meets(origin, direction, 1e6, center, radius));
        closed += u32::from(outline != Outline::Everywhere);
        (inside, vain) = (inside + held, vain + more);
    }
    // Each outline is a few pixels wider than its ball, and few balls are seen from inside.
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
    // Some balls lie below the plane or above the light, and shade nothing.
    assert!(closed > 900 && inside > 20_000 && vain < 2 * inside, "{closed} {inside} {vain}");
}

#[test]
fn lines_of_an_ellipse_are_the_hull_of_each_and_its_height_is_known() {
    let viewport = viewport(CAMERA);
    let outline = Vantage::eye(&viewport).outline(Vec3::new(1.0, 0.5, 0.0), 1.0);
    let height = (0..SIZE.1).filter(|y| outline.span(*y) != Span::NOWHERE).count() as u32;
    // The outline is less than a line higher on either side.
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
    // The front of the box is 9 units away. One unit is 70 / 2 / tan(0.4) / 9 pixels high there.
    let half = 35.0 / 0.4f32.tan() / 9.0;
    let Span { start, end } = outline.span(35);
    assert!((f32::from(start) - (45.0 - half)).abs() < 2.5 && (f32::from(end) - (45.0 + half)).abs() < 2.5);
    assert_eq!(outline.span(5), Span::NOWHERE);
    assert_eq!(
        Outline::of_box(Aabb::around(Vec3::new(0.0, 0.0, 10.0), unit), &viewport),
        Outline::Everywhere
    );
}
