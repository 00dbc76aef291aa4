//! Scalar products and squared lengths.
//!
//! The six products in the middle of a scalar product are added up before they are shifted. Where that sum
//! leaves 32 bits, as it does for coordinates far from the origin, the lost 2³² is added to the upper word.
//! All six coordinates come in registers: through the stack, as the procedure call standard has it, a product
//! takes 10 cycles more. A square has its middle product twice.

use core::arch::naked_asm;

/// Adds the product of `r0` and `r1` to the sum in `r3:r4`, and its middle products to the sum in `r6`.
/// Overwrites `r0` to `r2`, `r5`, `r7`.
macro_rules! add_product {
    ($overflow:literal, $other:literal) => {
        concat!(
            "uxth r7, r1\n",
            "asrs r1, r1, #16\n",
            "uxth r2, r0\n",
            "asrs r0, r0, #16\n",
            "movs r5, r7\n",
            "muls r5, r2, r5\n",
            "muls r7, r0, r7\n",
            "muls r2, r1, r2\n",
            "muls r0, r1, r0\n",
            "adds r4, r4, r5\n",
            "adcs r3, r0\n",
            add_middle!("r6", "r7", $overflow),
            add_middle!("r6", "r2", $other),
        )
    };
}

/// A function of two vectors, in `r0` to `r2` and `r3` to `r5`, whose scalar product is in `r3:r4` before
/// `$end`. Overwrites `r0` to `r5`, `r12` and `lr`.
macro_rules! scalar_product {
    ($(#[$doc:meta])* $name:ident $(, $end:literal)*) => {
        $(#[$doc])*
        #[allow(unsafe_code)]
        #[unsafe(naked)]
        pub(super) extern "C" fn $name() {
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
                add_middle!("r6", "r7", "20"),
                "mov r0, r12",
                "mov r12, r2",
                "mov lr, r5",
                add_product!("21", "22"),
                "mov r0, lr",
                "mov r1, r12",
                add_product!("23", "24"),

                "asrs r5, r6, #16",
                "lsls r6, r6, #16",
                "adds r4, r4, r6",
                "adcs r3, r5",
                $($end,)*
                "pop {{r6, r7, pc}}",

                mend_middle!("r3", "16", "r7", "20"),
                mend_middle!("r3", "16", "r7", "21"),
                mend_middle!("r3", "16", "r2", "22"),
                mend_middle!("r3", "16", "r7", "23"),
                mend_middle!("r3", "16", "r2", "24"),
            )
        }
    };
}

scalar_product! {
    /// The scalar product in `r3:r4`.
    scalar_product
}

scalar_product! {
    /// The scalar product in units of 2²⁴, rounded down, in `r3`.
    scaled_scalar_product, "lsls r3, r3, #8", "lsrs r4, r4, #24", "orrs r3, r3, r4"
}

/// The sum of the squares of `r0` to `r2`, in `r0:r3`. Overwrites `r1`, `r2`, `r4`, `r5` and `r12`.
#[allow(unsafe_code)]
#[unsafe(naked)]
pub(super) extern "C" fn squares() {
    naked_asm!(add_squares!(), "bx lr", mend_squares!())
}
