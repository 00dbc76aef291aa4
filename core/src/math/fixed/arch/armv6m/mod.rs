//! The functions of [`arch`](super) for ARMv6-M, which multiplies 32 by 32 bits for the lower half of the
//! result alone.
//!
//! A number is split into halves, a = a₁ 2¹⁶ + a₀, so that a · b = a₁ b₁ 2³² + (a₁ b₀ + a₀ b₁) 2¹⁶ + a₀ b₀.
//! Single products are in Rust, see [`halves`]. Scalar products, roots and unit vectors are in assembly: the
//! compiler has eight registers for them, and keeps half of the numbers on the stack.
//!
//! | function | instructions | of the compiler's code |
//! |---|---:|---:|
//! | scalar product | 65 | 110 |
//! | squared length | 33 | 62 |
//! | root and its reciprocal | 82 | 117 |
//! | square root alone | 48 | |
//! | reciprocal | 52 | 70 |
//! | unit vector | 160 | 205 |
//! | direction to a light | 145 | 270 |
//!
//! The functions do not follow the procedure call standard: they take and return up to six numbers in `r0` to
//! `r5`, which [`call!`] states.

#[macro_use]
mod steps;

mod dot;
mod light;
mod root;
mod unit;

use core::arch::asm;
use core::mem::MaybeUninit;

use super::{coarse, halves, share_digits};
use crate::math::fixed::newton::{self, Root};

pub(crate) use coarse::{dot3_bounds, misses_ball};
pub(crate) use halves::{leading_zeros, product, scaled_product, shifted};

/// Calls a function in assembly with the numbers in `r0` to `r5`, and gives what is in these registers
/// afterwards. `$memory` is `nomem`, or `readonly` for a function with a table.
macro_rules! call {
    ($function:path, $memory:ident, [$a:expr, $b:expr, $c:expr, $d:expr, $e:expr, $f:expr]) => {{
        let (a, b, c, d, e, f): (i32, i32, i32, i32, i32, i32);
        // SAFETY: the function changes `r0` to `r5`, `r12`, `lr` and the flags alone, and memory only below
        // the stack pointer.
        #[allow(unsafe_code)]
        unsafe {
            asm!(
                "bl {function}",
                function = sym $function,
                inlateout("r0") $a => a,
                inlateout("r1") $b => b,
                inlateout("r2") $c => c,
                inlateout("r3") $d => d,
                inlateout("r4") $e => e,
                inlateout("r5") $f => f,
                out("r12") _,
                out("lr") _,
                options(pure, $memory),
            );
        }
        [a, b, c, d, e, f]
    }};
}

/// A register that a function does not read.
const UNUSED: MaybeUninit<i32> = MaybeUninit::uninit();

// Forced, as in the rest of this file: without it, `classic` takes an M0 1.009 times the instructions.
#[inline(always)]
pub(crate) fn upper_product(a: u32, b: u32) -> u32 {
    halves::upper_product(a, b, opaque)
}

/// Returns the number unchanged, and hides its origin from the compiler.
#[inline(always)]
fn opaque(number: u32) -> u32 {
    let same;
    // SAFETY: the text is a comment, without an instruction.
    #[allow(unsafe_code)]
    unsafe {
        asm!("/* {} */", inlateout(reg) number => same, options(pure, nomem, nostack, preserves_flags));
    }
    same
}

#[inline(always)]
pub(crate) fn unsigned_product(a: u32, b: u32) -> u64 {
    u64::from(upper_product(a, b)) << 32 | u64::from(a.wrapping_mul(b))
}

#[inline(always)]
pub(crate) fn attenuated(light: i32, share: i32) -> i32 {
    halves::attenuated(light, share_digits(share))
}

#[inline(always)]
pub(crate) fn reciprocal(x: u32) -> u32 {
    newton::reciprocal(x, upper_product)
}

#[inline(always)]
pub(crate) fn dot3_wide([ax, ay, az]: [i32; 3], [bx, by, bz]: [i32; 3]) -> i64 {
    let [_, _, _, high, low, _] = call!(dot::scalar_product, nomem, [ax, ay, az, bx, by, bz]);
    i64::from(high) << 32 | i64::from(low as u32)
}

#[inline(always)]
pub(crate) fn dot3([ax, ay, az]: [i32; 3], [bx, by, bz]: [i32; 3]) -> i32 {
    let [_, _, _, scaled, ..] = call!(dot::scaled_scalar_product, nomem, [ax, ay, az, bx, by, bz]);
    scaled
}

#[inline(always)]
pub(crate) fn dot3_sparse(sparse: [i32; 3], other: [i32; 3]) -> i32 {
    halves::product_along_axis(sparse, other).unwrap_or_else(|| dot3(sparse, other))
}

#[inline]
pub(crate) fn dot3_wide_sparse(sparse: [i32; 3], other: [i32; 3]) -> i64 {
    halves::wide_product_along_axis(sparse, other).unwrap_or_else(|| dot3_wide(sparse, other))
}

#[inline(always)]
pub(crate) fn length_squared([x, y, z]: [i32; 3]) -> i64 {
    let [high, _, _, low, ..] = call!(dot::squares, nomem, [x, y, z, UNUSED, UNUSED, UNUSED]);
    i64::from(high) << 32 | i64::from(low as u32)
}

#[inline(always)]
pub(crate) fn root(squared: u64) -> Root {
    let (high, low) = ((squared >> 32) as u32, squared as u32);
    let [length, inverse, up, ..] = call!(root::root, readonly, [high, UNUSED, UNUSED, low, UNUSED, UNUSED]);
    Root { length: length as u32, inverse: inverse as u32, up: up as u32 }
}

#[inline(always)]
pub(crate) fn square_root(squared: u64) -> u32 {
    let (high, low) = ((squared >> 32) as u32, squared as u32);
    let [root, ..] = call!(root::square_root, readonly, [high, UNUSED, UNUSED, low, UNUSED, UNUSED]);
    root as u32
}

#[inline(always)]
pub(crate) fn inverse(number: i32) -> (u32, i32) {
    let [inverse, _, zeros, ..] =
        call!(root::inverse, readonly, [number, UNUSED, UNUSED, UNUSED, UNUSED, UNUSED]);
    (zeros as u32, inverse)
}

#[inline(always)]
pub(crate) fn unit([x, y, z]: [i32; 3]) -> [i32; 3] {
    let [x, y, z, ..] = call!(unit::unit, readonly, [x, y, z, UNUSED, UNUSED, UNUSED]);
    [x, y, z]
}

#[inline(always)]
pub(crate) fn toward_light([x, y, z]: [i32; 3], [nx, ny, nz]: [i32; 3]) -> Option<([i32; 3], i32, i32)> {
    let [x, y, z, length, cosine, _] = call!(light::toward_light, readonly, [x, y, z, nx, ny, nz]);
    if cosine >= 0 { Some(([x, y, z], length, cosine)) } else { None }
}
