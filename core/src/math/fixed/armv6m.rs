//! Scalar products for ARMv6-M, which multiplies 32 by 32 bits for the lower half of the result alone.
//!
//! A number is split into halves, a = a₁ 2¹⁶ + a₀, so that a · b = a₁ b₁ 2³² + (a₁ b₀ + a₀ b₁) 2¹⁶ + a₀ b₀. The six products
//! in the middle are added up before they are shifted; where that sum leaves 32 bits, which it does for coordinates far from the
//! origin, the lost 2³² is made up for in the upper word. So a scalar product takes 70 cycles of a Cortex-M0+, calling included, and a
//! register file of eight is not spilled by the code around it. What the compiler makes of the same took 110.

use core::arch::naked_asm;

/// Adds `$term` to the sum of the middle products in `r4`. The term's register is free afterwards.
macro_rules! add_middle {
    ($term:literal, $overflow:literal) => {
        concat!("adds r4, r4, ", $term, "\n bvs ", $overflow, "f\n", $overflow, "5:\n")
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

/// A function of six coordinates whose scalar product is in `r3:r6` before `$end`.
macro_rules! scalar_product {
    ($(#[$doc:meta])* $name:ident -> $result:ty, $($end:literal),+) => {
        $(#[$doc])*
        #[allow(unsafe_code)]
        #[unsafe(naked)]
        pub(super) extern "C" fn $name(ax: i32, ay: i32, az: i32, bx: i32, by: i32, bz: i32) -> $result {
            // By the procedure call standard ax, ay, az and bx are in r0 to r3, and the others on the stack.
            naked_asm!(
                "push {{r4, r5, r6, r7, lr}}",
                "uxth r4, r0",
                "asrs r0, r0, #16",
                "uxth r5, r3",
                "asrs r3, r3, #16",
                "movs r6, r4",
                "muls r6, r5, r6",
                "muls r4, r3, r4",
                "muls r5, r0, r5",
                "muls r3, r0, r3",
                add_middle!("r5", "20"),

                "ldr r0, [sp, #20]",
                "uxth r5, r1",
                "asrs r1, r1, #16",
                "uxth r7, r0",
                "asrs r0, r0, #16",
                "mov r12, r2",
                "movs r2, r5",
                "muls r2, r7, r2",
                "muls r5, r0, r5",
                "muls r7, r1, r7",
                "muls r0, r1, r0",
                "adds r6, r6, r2",
                "adcs r3, r0",
                add_middle!("r5", "21"),
                add_middle!("r7", "22"),
                "mov r2, r12",

                "ldr r0, [sp, #24]",
                "uxth r5, r2",
                "asrs r2, r2, #16",
                "uxth r7, r0",
                "asrs r0, r0, #16",
                "movs r1, r5",
                "muls r1, r7, r1",
                "muls r5, r0, r5",
                "muls r7, r2, r7",
                "muls r0, r2, r0",
                "adds r6, r6, r1",
                "adcs r3, r0",
                add_middle!("r5", "23"),
                add_middle!("r7", "24"),

                "asrs r5, r4, #16",
                "lsls r4, r4, #16",
                "adds r6, r6, r4",
                "adcs r3, r5",
                $($end,)+
                "pop {{r4, r5, r6, r7, pc}}",

                mend_middle!("r5", "20"),
                mend_middle!("r5", "21"),
                mend_middle!("r7", "22"),
                mend_middle!("r5", "23"),
                mend_middle!("r7", "24"),
            )
        }
    };
}

scalar_product! {
    /// The sum of three products.
    dot3_wide -> i64, "movs r0, r6", "movs r1, r3"
}

scalar_product! {
    /// The sum of three products in units of 2²⁴, downward.
    dot3 -> i32, "lsls r0, r3, #8", "lsrs r6, r6, #24", "orrs r0, r0, r6"
}
