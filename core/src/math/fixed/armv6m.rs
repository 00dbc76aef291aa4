//! Scalar products for ARMv6-M, which multiplies 32 by 32 bits for the lower half of the result alone.
//!
//! A number is split into halves, a = a₁ 2¹⁶ + a₀, so that a · b = a₁ b₁ 2³² + (a₁ b₀ + a₀ b₁) 2¹⁶ + a₀ b₀. The six products
//! in the middle are added up before they are shifted; where that sum leaves 32 bits, which it does for coordinates far from the
//! origin, the lost 2³² is made up for in the upper word. So a scalar product takes 65 cycles of a Cortex-M0+, calling included, and a
//! register file of eight is not spilled by the code around it. What the compiler makes of the same took 110.
//!
//! All six coordinates go in registers, two of which the procedure call standard would have saved: through the stack, as it wants
//! them, a product takes 10 cycles more.

use core::arch::{asm, naked_asm};

/// Adds `$term` to the sum of the middle products in `r6`. The term's register is free afterwards.
macro_rules! add_middle {
    ($term:literal, $overflow:literal) => {
        concat!("adds r6, r6, ", $term, "\n bvs ", $overflow, "f\n", $overflow, "5:\n")
    };
}

/// Makes up for an overflow of the sum: it looks negative where it is positive.
macro_rules! mend_middle {
    ($free:literal, $overflow:literal) => {
        concat!(
            $overflow,
            ":\n bmi ",
            $overflow,
            "6f\n movs ",
            $free,
            ", #1\n lsls ",
            $free,
            ", ",
            $free,
            ", #16\n subs r3, r3, ",
            $free,
            "\n b ",
            $overflow,
            "5b\n",
            $overflow,
            "6:\n movs ",
            $free,
            ", #1\n lsls ",
            $free,
            ", ",
            $free,
            ", #16\n adds r3, r3, ",
            $free,
            "\n b ",
            $overflow,
            "5b\n"
        )
    };
}

/// A function of six coordinates in `r0` to `r5`, those of a first, whose scalar product is in `r3:r4` before `$end`. What it leaves
/// in `r0` to `r5`, `r12` and `lr` is not saved.
macro_rules! scalar_product {
    ($(#[$doc:meta])* $name:ident $(, $end:literal)*) => {
        $(#[$doc])*
        #[allow(unsafe_code)]
        #[unsafe(naked)]
        extern "C" fn $name() {
            naked_asm!(
                "push {{r6, r7, lr}}",
                "uxth r6, r0",
                "asrs r0, r0, #16",
                "uxth r7, r3",
                "asrs r3, r3, #16",
                "mov r12, r4",
                "movs r4, r6",
                "muls r4, r7, r4",
                "muls r6, r3, r6",
                "muls r7, r0, r7",
                "muls r3, r0, r3",
                add_middle!("r7", "20"),

                "mov r0, r12",
                "mov r12, r2",
                "mov lr, r5",
                "uxth r7, r1",
                "asrs r1, r1, #16",
                "uxth r2, r0",
                "asrs r0, r0, #16",
                "movs r5, r7",
                "muls r5, r2, r5",
                "muls r7, r0, r7",
                "muls r2, r1, r2",
                "muls r0, r1, r0",
                "adds r4, r4, r5",
                "adcs r3, r0",
                add_middle!("r7", "21"),
                add_middle!("r2", "22"),

                "mov r0, lr",
                "mov r1, r12",
                "uxth r2, r1",
                "asrs r1, r1, #16",
                "uxth r7, r0",
                "asrs r0, r0, #16",
                "movs r5, r2",
                "muls r5, r7, r5",
                "muls r2, r0, r2",
                "muls r7, r1, r7",
                "muls r0, r1, r0",
                "adds r4, r4, r5",
                "adcs r3, r0",
                add_middle!("r2", "23"),
                add_middle!("r7", "24"),

                "asrs r5, r6, #16",
                "lsls r6, r6, #16",
                "adds r4, r4, r6",
                "adcs r3, r5",
                $($end,)*
                "pop {{r6, r7, pc}}",

                mend_middle!("r7", "20"),
                mend_middle!("r7", "21"),
                mend_middle!("r2", "22"),
                mend_middle!("r2", "23"),
                mend_middle!("r7", "24"),
            )
        }
    };
}

scalar_product! {
    /// The sum of three products.
    sum
}

scalar_product! {
    /// The sum of three products in units of 2²⁴, downward, in `r3`.
    sum_downward, "lsls r3, r3, #8", "lsrs r4, r4, #24", "orrs r3, r3, r4"
}

/// Calls one of them.
macro_rules! call {
    ($function:ident, $a:ident, $b:ident) => {{
        let ([ax, ay, az], [bx, by, bz]): ([i32; 3], [i32; 3]) = ($a, $b);
        let (high, low): (i32, u32);
        // SAFETY: the function takes the six registers, and leaves nothing changed but what is named here.
        #[allow(unsafe_code)]
        unsafe {
            asm!(
                "bl {function}",
                function = sym $function,
                inlateout("r0") ax => _,
                inlateout("r1") ay => _,
                inlateout("r2") az => _,
                inlateout("r3") bx => high,
                inlateout("r4") by => low,
                inlateout("r5") bz => _,
                out("r12") _,
                out("lr") _,
                options(pure, nomem),
            );
        }
        (high, low)
    }};
}

/// The sum of three products.
#[inline(always)]
pub(super) fn dot3_wide(a: [i32; 3], b: [i32; 3]) -> i64 {
    let (high, low) = call!(sum, a, b);
    i64::from(high) << 32 | i64::from(low)
}

/// The sum of three products in units of 2²⁴, downward.
#[inline(always)]
pub(super) fn dot3(a: [i32; 3], b: [i32; 3]) -> i32 {
    call!(sum_downward, a, b).0
}
