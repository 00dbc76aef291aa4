//! Unit vectors. The steps are those of [`portable`](crate::math::fixed::arch::portable).

use core::arch::naked_asm;

use crate::math::fixed::newton::RECIPROCAL_ROOTS;

/// Turns the coordinate at the stack pointer + `$place` into that of the unit vector. The coordinate is
/// shifted up by `r2`; `r5` and `r6` are the halves of the reciprocal length. Overwrites `r0`, `r3`, `r4` and
/// `r7`.
macro_rules! unit_coordinate {
    ($place:literal) => {
        concat!(
            concat!("ldr r0, [sp, #", $place, "]\n lsls r0, r2\n uxth r3, r0\n asrs r0, r0, #16\n"),
            "movs r4, r3\n muls r4, r5, r4\n lsrs r4, r4, #16\n",
            "movs r7, r0\n muls r7, r5, r7\n adds r4, r4, r7\n",
            "uxth r7, r4\n asrs r4, r4, #16\n muls r3, r6, r3\n adds r3, r3, r7\n lsrs r3, r3, #16\n",
            "muls r0, r6, r0\n adds r0, r0, r4\n adds r0, r0, r3\n",
            concat!("adds r0, #16\n asrs r0, r0, #5\n str r0, [sp, #", $place, "]\n"),
        )
    };
}

/// The unit vector along the vector in `r0` to `r2`, in its place. Overwrites `r3` to `r5` and `r12`.
#[allow(unsafe_code)]
#[unsafe(naked)]
pub(super) extern "C" fn unit() {
    naked_asm!(
        "push {{r0, r1, r2, r6, r7, lr}}",
        add_squares!(),
        // The corrections must be near.
        "b 42f",
        mend_squares!(),
        "42:",
        begin_root!("29f"),
        end_reciprocal_root!(),
        halve_zeros!(),
        "uxth r5, r1",
        "lsrs r6, r1, #16",
        unit_coordinate!("0"),
        unit_coordinate!("4"),
        unit_coordinate!("8"),
        "pop {{r0, r1, r2, r6, r7, pc}}",
        ".p2align 2",
        "29:",
        ".word {table}",
        table = sym RECIPROCAL_ROOTS,
    )
}
