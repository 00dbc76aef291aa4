//! The floating-point backends: the crate that computes each function, and its error bound.
//!
//! | function | backend, the first that applies | error bound |
//! |---|---|---|
//! | `sqrt` | feature `micromath`: its estimate and three of Heron's steps | 2 units in the last place |
//! | | `vsqrt.f32` on Arm with a hardware float ABI | correctly rounded |
//! | | feature `std`: the standard library | correctly rounded |
//! | | libm | correctly rounded |
//! | `turn` | libm | 2⁻²³ of a turn, 2⁻⁵¹ in `f64` |
//!
//! Nothing else comes from the standard library: its other functions differ between platforms. Powers in
//! `f32` are in this crate, see [`power`](super::power). Tangents, needed once per picture, always come from
//! libm.

/// The square root.
#[allow(unreachable_code)]
pub(crate) fn sqrt(value: f32) -> f32 {
    #[cfg(feature = "micromath")]
    return micro::sqrt(value);
    #[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
    return vsqrt(value);
    #[cfg(feature = "std")]
    return std::primitive::f32::sqrt(value);
    libm::sqrtf(value)
}

/// The angle of the vector (x, y) as a share of a turn, see [`Real::turn`](super::Real::turn): never the
/// platform's arc tangent.
pub(crate) fn turn(y: f32, x: f32) -> f32 {
    let turn = libm::atan2f(y, x) * (0.5 * core::f32::consts::FRAC_1_PI);
    let turn = if turn < 0.0 { turn + 1.0 } else { turn };
    // A number a little less than 0 was rounded to 1. The comparison also makes 0 of NaN.
    if turn < 1.0 { turn } else { 0.0 }
}

/// [`turn`] in `f64`.
pub(crate) fn turn_f64(y: f64, x: f64) -> f64 {
    let turn = libm::atan2(y, x) * (0.5 * core::f64::consts::FRAC_1_PI);
    let turn = if turn < 0.0 { turn + 1.0 } else { turn };
    if turn < 1.0 { turn } else { 0.0 }
}

/// 2 to the power `-times`, in `f64`.
pub(crate) fn halved_f64(times: f64) -> f64 {
    libm::exp2(-times)
}

/// The cosine of an angle in radians, while a scene is prepared: always libm's.
pub(crate) fn set_up_cos(angle: f32) -> f32 {
    libm::cosf(angle)
}

/// Sine and cosine of an angle in radians, for rotations while a scene is prepared: always libm's.
pub(crate) fn set_up_sin_cos(angle: f32) -> (f32, f32) {
    libm::sincosf(angle)
}

/// The square root in `f64`.
#[allow(unreachable_code)]
pub(crate) fn sqrt_f64(value: f64) -> f64 {
    #[cfg(feature = "std")]
    return std::primitive::f64::sqrt(value);
    libm::sqrt(value)
}

/// Two functions that compare up to 32 numbers with as many others and give a bit for each pair. The second
/// is for `f32`: some processors have an instruction that compares four numbers with four others and gives
/// four bits, which the compiler does not find by itself.
macro_rules! compare {
    ($what:literal, $compare:ident, $compare_f32:ident, $operator:tt, $instruction:ident) => {
        #[doc = $what]
        #[inline(always)]
        pub(crate) fn $compare<T: PartialOrd>(numbers: &[T], others: &[T]) -> u32 {
            let pairs = numbers.iter().zip(others).enumerate();
            pairs.fold(0, |bits, (place, (number, other))| bits | u32::from(number $operator other) << place)
        }

        #[doc = $what]
        #[allow(unsafe_code)]
        #[inline(always)]
        pub(crate) fn $compare_f32(numbers: &[f32], others: &[f32]) -> u32 {
            #[cfg(all(target_arch = "x86_64", target_feature = "sse"))]
            {
                use core::arch::x86_64::{$instruction, _mm_movemask_ps, _mm_setr_ps};
                let ((fours, rest), (other_fours, other_rest)) = (numbers.as_chunks(), others.as_chunks());
                let pairs = fours.iter().zip(other_fours).rev();
                pairs.fold($compare(rest, other_rest), |bits, ([a, b, c, d], [e, f, g, h])| {
                    // SAFETY: the target has these instructions; they touch no memory.
                    let four = unsafe {
                        let (numbers, others) = (_mm_setr_ps(*a, *b, *c, *d), _mm_setr_ps(*e, *f, *g, *h));
                        _mm_movemask_ps($instruction(numbers, others))
                    };
                    bits << 4 | four as u32
                })
            }
            #[cfg(not(all(target_arch = "x86_64", target_feature = "sse")))]
            $compare(numbers, others)
        }
    };
}

compare!("Which numbers are no larger than others.", no_larger, no_larger_f32, <=, _mm_cmple_ps);
compare!("Which numbers are less than others.", less, less_f32, <, _mm_cmplt_ps);

/// The FPU's own square root: 9 instructions where libm's takes 58, and the same bits.
///
/// The compiler uses the instruction only for `std`. It refuses a register operand of class `sreg` on these
/// targets, so the value goes through `s0`.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[allow(unsafe_code)]
#[inline(always)]
fn vsqrt(value: f32) -> f32 {
    let bits = value.to_bits();
    let root: u32;
    // SAFETY: the target has the FPU that its ABI passes floats in; only s0 is touched, and it is declared.
    unsafe {
        core::arch::asm!(
            "vmov s0, {value}",
            "vsqrt.f32 s0, s0",
            "vmov {root}, s0",
            value = in(reg) bits,
            root = lateout(reg) root,
            out("s0") _,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    f32::from_bits(root)
}

#[cfg(feature = "micromath")]
mod micro {
    //! micromath's estimate, refined here until the bound in the table above holds.

    use micromath::F32Ext;

    pub(super) fn sqrt(value: f32) -> f32 {
        if !(value > 0.0) {
            return 0.0;
        }
        // The estimate is off by up to 6 %; each of Heron's steps squares the error: 1.8e-3, then 1.7e-6,
        // then 1.4e-12.
        let mut root = F32Ext::sqrt(value);
        for _ in 0..3 {
            root = 0.5 * (root + value / root);
        }
        root
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Evenly spread over the bit patterns, so over all magnitudes.
    fn positive_floats() -> impl Iterator<Item = f32> {
        (1..200_000u32).map(|i| f32::from_bits(0x0080_0000 + i * 10_000)).filter(|x| x.is_finite())
    }

    #[test]
    fn sqrt_keeps_its_bound() {
        let bound = if cfg!(feature = "micromath") { 2 } else { 0 };
        for value in positive_floats() {
            let exact = f64::from(value).sqrt() as f32;
            assert!(sqrt(value).to_bits().abs_diff(exact.to_bits()) <= bound, "sqrt({value:e})");
        }
        assert_eq!(sqrt(0.0), 0.0);
    }

    #[test]
    fn bits_tell_which_are_less_and_no_larger() {
        bits_tell_which_of::<4>();
        bits_tell_which_of::<8>();
        // No whole fours.
        bits_tell_which_of::<7>();
    }

    fn bits_tell_which_of<const N: usize>() {
        let numbers = [-1.0, -0.0, 0.0, 1.0, f32::INFINITY, f32::NAN];
        for (i, a) in numbers.into_iter().enumerate() {
            for (j, b) in numbers.into_iter().enumerate() {
                let is_no_larger = i.max(j) < 5 && (i <= j || i.max(j) == 2 && i.min(j) == 1);
                for place in 0..N {
                    let (mut some, mut others) = ([1.0; N], [0.0; N]);
                    (some[place], others[place]) = (a, b);
                    let expected = u32::from(is_no_larger) << place;
                    assert_eq!(no_larger_f32(&some, &others), expected, "{a} and {b} at {place}");
                    assert_eq!(no_larger(&some, &others), expected, "{a} and {b} at {place}");
                    let expected = u32::from(a < b) << place;
                    assert_eq!(less_f32(&some, &others), expected, "{a} and {b} at {place}");
                    assert_eq!(less(&some, &others), expected, "{a} and {b} at {place}");
                }
            }
        }
    }

    #[test]
    fn sqrt_f64_is_correctly_rounded() {
        for value in positive_floats().map(f64::from) {
            assert_eq!(sqrt_f64(value), value.sqrt());
        }
    }
}
