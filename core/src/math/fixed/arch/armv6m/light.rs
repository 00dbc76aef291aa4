//! The direction to a light. The steps are those of [`portable`](crate::math::fixed::arch::portable).

use core::arch::naked_asm;

use crate::math::fixed::newton::RECIPROCAL_ROOTS;

/// `$number`, of 16 bits, times a number in units of 2⁻²¹ whose halves are in `r5` and `r6`; the product is
/// in `$result`. `$shift` is `asrs` if `$number` has a sign, else `lsrs`. Overwrites `$number` and `r4`.
macro_rules! scale {
    ($number:literal, $shift:literal, $result:literal) => {
        concat!(
            concat!("movs r4, ", $number, "\n muls r4, r5, r4\n ", $shift, " r4, r4, #16\n"),
            concat!("muls ", $number, ", r6, ", $number, "\n adds r4, r4, ", $number, "\n"),
            concat!($shift, " ", $result, ", r4, #5\n"),
        )
    };
}

/// The height of the light above the surface in `r7`, from the way in `r0` to `r2` and 15 digits of the
/// normal in `r3` to `r5`. Overwrites `r3` to `r6`.
macro_rules! height_above {
    () => {
        concat!(
            "asrs r3, r3, #10\n",
            "uxth r6, r0\n",
            "asrs r7, r0, #16\n",
            "muls r6, r3, r6\n",
            "muls r7, r3, r7\n",
            "asrs r4, r4, #10\n",
            "uxth r3, r1\n",
            "muls r3, r4, r3\n",
            "adds r6, r6, r3\n",
            "asrs r3, r1, #16\n",
            "muls r3, r4, r3\n",
            "adds r7, r7, r3\n",
            "asrs r5, r5, #10\n",
            "uxth r3, r2\n",
            "muls r3, r5, r3\n",
            "adds r6, r6, r3\n",
            "asrs r3, r2, #16\n",
            "muls r3, r5, r3\n",
            "adds r7, r7, r3\n",
            "asrs r6, r6, #14\n",
            "lsls r7, r7, #2\n",
            "adds r7, r7, r6\n",
        )
    };
}

/// The number of digits in `r4` by which the way in `r0` to `r2` can be shifted up. Overwrites `r3` and `r5`.
macro_rules! digits_up {
    () => {
        concat!(
            "asrs r3, r0, #31\n",
            "eors r3, r0\n",
            "asrs r4, r1, #31\n",
            "eors r4, r1\n",
            "orrs r3, r4\n",
            "asrs r4, r2, #31\n",
            "eors r4, r2\n",
            "orrs r3, r4\n",
            "movs r4, #0\n",
            // Most are at least 1/2 away.
            "lsrs r5, r3, #23\n",
            "bne 22f\n",
            search!("r3", "r5", "r4", "16", "15", "21"),
            search!("r3", "r5", "r4", "8", "23", "22"),
            search!("r3", "r5", "r4", "4", "27", "23"),
            search!("r3", "r5", "r4", "2", "29", "24"),
            search!("r3", "r5", "r4", "1", "30", "25"),
        )
    };
}

/// Cuts the way in `r0` to `r2` to 15 digits of each coordinate, and the height in `r7` to as many; the sum
/// of the squares of the coordinates is in `r3`. Overwrites `r5`.
macro_rules! cut_and_square {
    () => {
        concat!(
            "lsls r0, r4\n",
            "asrs r0, r0, #16\n",
            "lsls r1, r4\n",
            "asrs r1, r1, #16\n",
            "lsls r2, r4\n",
            "asrs r2, r2, #16\n",
            "movs r3, r0\n",
            "muls r3, r0, r3\n",
            "movs r5, r1\n",
            "muls r5, r1, r5\n",
            "adds r3, r3, r5\n",
            "movs r5, r2\n",
            "muls r5, r2, r5\n",
            "adds r3, r3, r5\n",
            "lsls r7, r4\n",
            "lsrs r7, r7, #16\n",
        )
    };
}

/// From the way in `r0` to `r2` and the unit normal in `r3` to `r5`: the unit vector along the way in `r0` to
/// `r2`, the length in `r3`, and the cosine in `r4`. Where the light is not above the surface, `r4` is -1 and
/// the other registers mean nothing. Overwrites `r5` and `r12`.
#[allow(unsafe_code)]
#[unsafe(naked)]
pub(super) extern "C" fn toward_light() {
    naked_asm!(
        "push {{r6, r7, lr}}",
        height_above!(),
        "cmp r7, #0",
        "bgt 20f",
        "movs r4, #0",
        "mvns r4, r4",
        "pop {{r6, r7, pc}}",
        "20:",
        digits_up!(),
        cut_and_square!(),
        "push {{r0, r1, r2, r3, r4, r7}}",
        // 2⁴⁵ over their length.
        "movs r0, r3",
        "movs r2, #1",
        "lsrs r1, r0, #30",
        "bne 26f",
        "lsls r0, r0, #2",
        "movs r2, #0",
        "26:",
        line_of_root!("27f"),
        end_reciprocal_root!(),
        "lsrs r1, r2",
        "movs r6, r1",
        "pop {{r0, r1, r2, r3, r4, r7}}",
        // The reciprocal times the squares, and by halves times the other numbers.
        "lsrs r3, r3, #15",
        "lsrs r5, r6, #15",
        "muls r3, r5, r3",
        "lsrs r3, r4",
        "lsls r3, r3, #1",
        "uxth r5, r6",
        "lsrs r6, r6, #16",
        scale!("r0", "asrs", "r0"),
        scale!("r1", "asrs", "r1"),
        scale!("r2", "asrs", "r2"),
        scale!("r7", "lsrs", "r4"),
        "pop {{r6, r7, pc}}",
        ".p2align 2",
        "27:",
        ".word {table}",
        table = sym RECIPROCAL_ROOTS,
    )
}
