//! Error bounds of fixed-point arithmetic against `f64`.

use super::*;
use crate::math::real::Product;

pub(super) const UNIT: f64 = 1.0 / (1u32 << FRACTION) as f64;

/// Numbers that look random (Knuth, "The Art of Computer Programming" vol. 2; MMIX's constants), the same on
/// every run.
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0
    }

    pub(super) fn bits(&mut self) -> i32 {
        (self.next() >> 32) as i32
    }

    /// Of any magnitude and both signs.
    fn number(&mut self) -> Fixed {
        let down = self.bits() & 31;
        Fixed(self.bits() >> down)
    }

    /// From -1 to 1.
    pub(super) fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Three of those.
    pub(super) fn place(&mut self) -> [f64; 3] {
        [self.share(), self.share(), self.share()]
    }

    /// A unit vector.
    pub(super) fn unit(&mut self) -> [f64; 3] {
        let place = self.place();
        place.map(|number| number / length(place))
    }
}

pub(super) fn dot([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> f64 {
    ax * bx + ay * by + az * bz
}

pub(super) fn length(vector: [f64; 3]) -> f64 {
    dot(vector, vector).sqrt()
}

fn double(number: Fixed) -> f64 {
    f64::from(number.0) * UNIT
}

#[test]
fn quotients_keep_their_bound() {
    let mut random = Random(1);
    for _ in 0..1_000_000 {
        let (a, b) = (random.number(), random.number());
        if b.0 == 0 {
            continue;
        }
        let exact = (double(a) / double(b)).clamp(-128.0, 128.0 - UNIT);
        let error = (double(a / b) - exact).abs();
        assert!(error <= exact.abs() * 2f64.powi(-25) + 1.01 * UNIT, "{a:?} / {b:?} is off by {error:e}");
    }
    assert_eq!((Fixed(5) / Fixed(0), Fixed(-5) / Fixed(0)), (Fixed(i32::MAX), Fixed(i32::MIN)));
}

#[test]
fn products_round_down() {
    let mut random = Random(2);
    for _ in 0..1_000_000 {
        let (a, b) = (random.number(), random.number());
        let exact = double(a) * double(b);
        if exact.abs() < 127.0 {
            assert_eq!(double(a * b), (exact / UNIT).floor() * UNIT);
        }
    }
}

#[test]
fn light_is_attenuated_downward() {
    let mut random = Random(4);
    for _ in 0..1_000_000 {
        let (light, share) =
            (Fixed(random.number().0 & i32::MAX), Fixed(random.bits() & ((1 << FRACTION) - 1)));
        let (exact, left) = (double(light) * double(share), double(light.attenuated(share)));
        assert!(left <= exact, "{light:?} times {share:?}");
        assert!(exact - left < double(light) * 2f64.powi(-15) + UNIT, "{light:?} times {share:?}");
        assert_eq!(light.attenuated(Fixed::ONE), light);
        assert_eq!(light.attenuated(Fixed(0)), Fixed(0));
    }
}

#[test]
fn square_roots_keep_their_bound() {
    let mut random = Random(3);
    for _ in 0..1_000_000 {
        let a = random.number();
        let exact = double(a).max(0.0).sqrt();
        let error = (double(a.sqrt()) - exact).abs();
        assert!(error <= exact * 2f64.powi(-24) + UNIT, "√{a:?} is off by {error:e}");
        let b = random.number();
        let length = (double(a).powi(2) + double(b).powi(2)).sqrt();
        if length < 127.0 {
            let error = (double((a.times(a) + b.times(b)).sqrt()) - length).abs();
            assert!(error <= length * 2f64.powi(-24) + UNIT, "|({a:?}, {b:?})| is off by {error:e}");
        }
    }
}

#[test]
fn unit_vectors_keep_their_bound() {
    let mut random = Random(4);
    for _ in 0..1_000_000 {
        let down = random.bits() & 15;
        let vector = [(); 3].map(|()| Fixed(random.bits() >> 1 >> down));
        let length = vector.map(|x| double(x).powi(2)).iter().sum::<f64>().sqrt();
        if length == 0.0 {
            continue;
        }
        let (unit, got) = Fixed::unit_and_length(vector);
        assert!((double(got) - length).abs() <= length * 2f64.powi(-24) + UNIT, "{vector:?}: {got:?}");
        for (unit, x) in unit.iter().zip(vector) {
            let error = (double(*unit) - double(x) / length).abs();
            assert!(error <= 2.0 * UNIT, "{vector:?}: {unit:?} is off by {}", error / UNIT);
        }
    }
    assert_eq!(Fixed::unit_and_length([Fixed(0); 3]).1, Fixed(0));
}

#[test]
fn wide_products_and_quotients_keep_their_bounds() {
    let mut random = Random(5);
    for _ in 0..1_000_000 {
        let (a, b, c) = (random.number(), random.number(), random.number());
        let exact = double(a) * double(b);
        let scaled = Product::times(a.times(b), c);
        if (exact * double(c)).abs() < 8000.0 {
            let error = (scaled.bits() as f64 * UNIT * UNIT - exact * double(c)).abs();
            // Rounded below 2⁻⁴⁸, and f64 itself has 53 digits.
            assert!(error <= 2.0 * UNIT * UNIT + exact.abs() * double(c).abs() * 1e-15, "off by {error:e}");
        }
        if c.0 != 0 {
            let exact = (exact / double(c)).clamp(-128.0, 128.0 - UNIT);
            let error = (double(a.times(b).over(c)) - exact).abs();
            assert!(error <= exact.abs() * 2f64.powi(-25) + 1.01 * UNIT, "{a:?} {b:?} / {c:?}: {error:e}");
        }
    }
}

#[test]
fn conversions_round_to_nearest_and_saturate() {
    for (value, bits) in
        [(1.0f32, 1 << 24), (-0.5, -(1 << 23)), (1e9, i32::MAX), (-1e9, i32::MIN), (f32::NAN, 0)]
    {
        assert_eq!(Fixed::from_f32(value), Fixed(bits));
    }
    for (value, floor) in [(1.5f32, 1), (-1.5, -2), (-2.0, -2), (0.0, 0)] {
        assert_eq!(Fixed::from_f32(value).floor_to_i32(), floor);
    }
    for (value, q16) in [(0.0f32, 0), (-1.0, 0), (0.5, 32768), (1.0, 65536), (7.0, 65536)] {
        assert_eq!(Fixed::from_f32(value).to_q16(), q16);
    }
    assert_eq!(Fixed::from_fraction(0x8000), Fixed(1 << 23));
}

#[test]
fn pixels_are_placed_to_the_last_digit() {
    for shift in 0..=16 {
        let pixel = ((1u32 << shift) - 1) as u16;
        let exact = (f64::from(pixel) + 0.25) / f64::from(1u32 << shift);
        assert!((double(Fixed::from_pixel(pixel, 0x4000, shift)) - exact).abs() < UNIT, "{shift}");
    }
}

#[test]
fn cells_are_counted_for_every_density() {
    let mut random = Random(6);
    for per_unit in [0.0f32, 0.001, 0.5, 1.0, -3.0, 32.0, 1e4, 1e6] {
        for _ in 0..10_000 {
            let at = Fixed(random.bits() >> 2);
            let exact = double(at) * f64::from(per_unit);
            let cell = f64::from(at.cell(Fixed::factor(per_unit)));
            // Where rounding may move the border, either side will do.
            assert!(cell == exact.floor() || (exact - exact.round()).abs() <= exact.abs() * 1e-9, "{at:?}");
        }
    }
}

#[test]
fn powers_of_factors() {
    for (base, exponent) in
        [(0.5f32, 3.0f32), (0.9, 50.0), (0.999, 1425.0), (0.25, 0.5), (1.0, 7.0), (0.3, 0.0)]
    {
        let exact = f64::from(base).powf(f64::from(exponent));
        let power = double(Fixed::from_f32(base).powf(Fixed::factor(exponent)));
        assert!((power - exact).abs() < 3e-5, "{base}^{exponent} is {power}");
    }
    assert_eq!(Fixed(0).powf(Fixed::factor(0.0)), Fixed::ONE);
    assert_eq!(Fixed(-5).powf(Fixed::factor(2.0)), Fixed(0));
}
