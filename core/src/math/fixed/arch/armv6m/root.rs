//! Square roots and reciprocals. The steps are those of [`portable`](crate::math::fixed::arch::portable).

use core::arch::naked_asm;

use crate::math::fixed::newton::{RECIPROCAL_ROOTS, RECIPROCALS};

/// From the number in `r0:r3`: the root in `r0`, its reciprocal in `r1`, and how far the root was shifted
/// down in `r2`. Overwrites `r3` to `r5`.
#[allow(unsafe_code)]
#[unsafe(naked)]
pub(super) extern "C" fn root() {
    naked_asm!(
        "push {{r6, r7, lr}}",
        begin_root!("29f"),
        end_reciprocal_root!(),
        // The digits times the reciprocal root.
        upper!("r1"),
        "lsls r0, r3, #1",
        halve_zeros!(),
        "lsrs r0, r2",
        "pop {{r6, r7, pc}}",
        ".p2align 2",
        "29:",
        ".word {table}",
        table = sym RECIPROCAL_ROOTS,
    )
}

/// From the number in `r0:r3`: the square root in `r0`. Overwrites `r1` to `r4`.
#[allow(unsafe_code)]
#[unsafe(naked)]
pub(super) extern "C" fn square_root() {
    naked_asm!(
        begin_root!("29f"),
        "lsrs r3, r0, #16",
        "muls r3, r1, r3",
        "lsrs r3, r3, #15",
        "movs r4, r3",
        "muls r4, r3, r4",
        "subs r0, r0, r4",
        "asrs r0, r0, #5",
        "muls r0, r1, r0",
        "asrs r0, r0, #12",
        "lsls r3, r3, #15",
        "adds r0, r0, r3",
        halve_zeros!(),
        "lsrs r0, r2",
        "bx lr",
        ".p2align 2",
        "29:",
        ".word {table}",
        table = sym RECIPROCAL_ROOTS,
    )
}

/// From the number in `r0`, which is not 0: the leading zeros of its absolute value in `r2`, and the
/// reciprocal of the digits after them in `r0`. Overwrites `r1` and `r3` to `r5`.
#[allow(unsafe_code)]
#[unsafe(naked)]
pub(super) extern "C" fn inverse() {
    naked_asm!(
        "push {{r6, r7, lr}}",
        "asrs r1, r0, #31",
        "eors r0, r1",
        "subs r0, r0, r1",
        "movs r2, #0",
        search_pairs!(),
        search!("r0", "r1", "r2", "1", "31", "25"),
        // y, by the line.
        "ldr r1, 29f",
        "lsls r3, r0, #1",
        "lsrs r3, r3, #26",
        "lsls r3, r3, #2",
        "ldr r1, [r1, r3]",
        at!(),
        // The upper half of y times the digits.
        "lsrs r6, r0, #16",
        "lsls r1, r1, #15",
        upper!("r1"),
        // Newton's step.
        "movs r4, #1",
        "lsls r4, r4, #30",
        "subs r3, r4, r3",
        "asrs r3, r3, #3",
        "lsrs r4, r1, #15",
        "muls r3, r4, r3",
        "asrs r3, r3, #12",
        "adds r0, r1, r3",
        "pop {{r6, r7, pc}}",
        ".p2align 2",
        "29:",
        ".word {table}",
        table = sym RECIPROCALS,
    )
}
