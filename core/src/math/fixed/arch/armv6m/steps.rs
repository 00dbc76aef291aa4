//! Steps of the functions in assembly. Each macro gives the text of a few instructions; its comment names the
//! registers that it reads, those that hold the result, and those that it overwrites besides.
//!
//! Labels are numbers. An argument for a label is a number that the function has no other label for.

/// Adds `$term` to the sum of middle products in `$sum`. Goes to `$overflow` where the sum overflows, which
/// [`mend_middle!`] gives.
macro_rules! add_middle {
    ($sum:literal, $term:literal, $overflow:literal) => {
        concat!("adds ", $sum, ", ", $sum, ", ", $term, "\n bvs ", $overflow, "f\n", $overflow, "5:\n")
    };
}

/// Corrects `$high` after an overflow of the sum: the lost bit counts 2 to the power of `$bit` there. A
/// positive sum looks negative after an overflow, and the reverse. Overwrites `$free`.
macro_rules! mend_middle {
    ($high:literal, $bit:literal, $free:literal, $overflow:literal) => {
        concat!(
            concat!($overflow, ":\n bmi ", $overflow, "6f\n"),
            mend_middle!(@by "subs ", $high, $bit, $free, $overflow),
            concat!($overflow, "6:\n"),
            mend_middle!(@by "adds ", $high, $bit, $free, $overflow),
        )
    };
    (@by $change:literal, $high:literal, $bit:literal, $free:literal, $overflow:literal) => {
        concat!(
            concat!(" movs ", $free, ", #1\n lsls ", $free, ", ", $free, ", #", $bit, "\n "),
            concat!($change, $high, ", ", $high, ", ", $free, "\n b ", $overflow, "5b\n"),
        )
    };
}

/// The sum of the squares of `r0` to `r2`, in `r0:r3`. Overwrites `r1`, `r2`, `r4`, `r5` and `r12`.
/// [`mend_squares!`] must follow, beyond a branch.
macro_rules! add_squares {
    () => {
        concat!(
            "uxth r3, r0\n asrs r0, r0, #16\n movs r4, r3\n",
            "muls r4, r0, r4\n muls r3, r3, r3\n muls r0, r0, r0\n",
            "uxth r5, r1\n asrs r1, r1, #16\n mov r12, r5\n",
            "muls r5, r5, r5\n adds r3, r3, r5\n mov r5, r12\n",
            "muls r5, r1, r5\n muls r1, r1, r1\n adcs r0, r1\n",
            add_middle!("r4", "r5", "40"),
            "uxth r5, r2\n asrs r2, r2, #16\n movs r1, r5\n",
            "muls r5, r5, r5\n  adds r3, r3, r5\n muls r1, r2, r1\n",
            "muls r2, r2, r2\n adcs r0, r2\n",
            add_middle!("r4", "r1", "41"),
            "lsls r1, r4, #17\n asrs r4, r4, #15\n adds r3, r3, r1\n adcs r0, r4\n"
        )
    };
}

/// The corrections that [`add_squares!`] goes to where a sum overflows.
macro_rules! mend_squares {
    () => {
        concat!(mend_middle!("r0", "17", "r5", "40"), mend_middle!("r0", "17", "r5", "41"))
    };
}

/// Shifts `$digits` up by `$step`, and adds that to `$count`, if the digits above bit `$rest` are 0.
/// Overwrites `$free`.
macro_rules! search {
    ($digits:literal, $free:literal, $count:literal, $step:literal, $rest:literal, $found:literal) => {
        concat!(
            concat!("lsrs ", $free, ", ", $digits, ", #", $rest, "\n bne ", $found, "f\n"),
            concat!(" lsls ", $digits, ", ", $digits, ", #", $step, "\n adds ", $count, ", #", $step, "\n"),
            concat!($found, ":\n"),
        )
    };
}

/// Shifts the digits in `r0` up by their leading pairs of zeros, and adds the number of zeros to `r2`.
/// Overwrites `r1`.
macro_rules! search_pairs {
    () => {
        concat!(
            search!("r0", "r1", "r2", "16", "16", "21"),
            search!("r0", "r1", "r2", "8", "24", "22"),
            search!("r0", "r1", "r2", "4", "28", "23"),
            search!("r0", "r1", "r2", "2", "30", "24")
        )
    };
}

/// The value of the line in `r1` at the digits in `r0`, in `r1`: as
/// [`newton::at`](crate::math::fixed::newton::at). Overwrites `r3`, `r4`.
macro_rules! at {
    () => {
        "lsrs r3, r0, #9\n uxth r3, r3\n uxth r4, r1\n muls r3, r4, r3\n subs r1, r1, r3\n lsrs r1, r1, #16\n"
    };
}

/// The upper 32 bits of `$number` times `r0`, in `r3`. `r6` is the upper half of `r0`. Overwrites `r4`, `r5`
/// and `r7`.
macro_rules! upper {
    ($number:literal) => {
        concat!(
            concat!("uxth r4, ", $number, "\n lsrs r3, ", $number, ", #16\n"),
            "uxth r5, r0\n movs r7, r5\n muls r7, r4, r7\n lsrs r7, r7, #16\n",
            "muls r4, r6, r4\n adds r4, r4, r7\n",
            "uxth r7, r4\n lsrs r4, r4, #16\n muls r5, r3, r5\n adds r5, r5, r7\n lsrs r5, r5, #16\n",
            "muls r3, r6, r3\n adds r3, r3, r4\n adds r3, r3, r5\n",
        )
    };
}

/// From the number in `r0:r3`: its leading zeros, rounded down to an even number, in `r2`, the digits after
/// them in `r0`, and 1/√x of these in `r1`, as [`line_of_root!`]. Overwrites `r3` and `r4`.
macro_rules! begin_root {
    ($table:literal) => {
        concat!(
            "movs r2, #0\n cmp r0, #0\n bne 20f\n movs r0, r3\n movs r3, #0\n movs r2, #32\n 20:\n",
            search_pairs!(),
            // A shift by 32 or more leaves nothing.
            "movs r1, #32\n subs r1, r1, r2\n lsrs r3, r1\n orrs r0, r3\n",
            line_of_root!($table)
        )
    };
}

/// 1/√x of the digits in `r0` by the line alone, in `r1`. The address of the table is at the label `$table`.
/// Overwrites `r3` and `r4`.
macro_rules! line_of_root {
    ($table:literal) => {
        concat!("ldr r1, ", $table, "\n lsrs r3, r0, #25\n lsls r3, r3, #2\n ldr r1, [r1, r3]\n", at!())
    };
}

/// Newton's step for that: 1/√x in 31 digits, in `r1`. Leaves the upper half of `r0` in `r6`. Overwrites `r3`
/// to `r5` and `r7`.
macro_rules! end_reciprocal_root {
    () => {
        concat!(
            "movs r3, r1\n muls r3, r1, r3\n lsrs r6, r0, #16\n",
            upper!("r3"),
            "movs r4, #1\n lsls r4, r4, #30\n subs r3, r4, r3\n",
            "asrs r3, r3, #3\n muls r3, r1, r3\n asrs r3, r3, #13\n",
            "lsls r1, r1, #15\n adds r1, r1, r3\n"
        )
    };
}

/// How far a root is shifted down, from the leading zeros of the number: both in `r2`.
macro_rules! halve_zeros {
    () => {
        "subs r2, r2, #1\n bcs 25f\n movs r2, #0\n 25:\n lsrs r2, r2, #1\n"
    };
}
