//! Scalar products and square roots for ARMv6-M, which multiplies 32 by 32 bits for the lower half of the result alone.
//!
//! A number is split into halves, a = a₁ 2¹⁶ + a₀, so that a · b = a₁ b₁ 2³² + (a₁ b₀ + a₀ b₁) 2¹⁶ + a₀ b₀. The six products
//! in the middle are added up before they are shifted; where that sum leaves 32 bits, which it does for coordinates far from the
//! origin, the lost 2³² is made up for in the upper word. So a scalar product takes 65 cycles of a Cortex-M0+, calling included, and a
//! register file of eight is not spilled by the code around it. What the compiler makes of the same took 110.
//!
//! All six coordinates go in registers, two of which the procedure call standard would have saved: through the stack, as it wants
//! them, a product takes 10 cycles more.
//!
//! Squares have their middle product twice: three of them take 33 instructions in place of 62 with the moves that a scalar product
//! of a vector with itself needs. A root and its reciprocal take 82, in place of 117, because the compiler spills what a search for
//! leading zeros has in eight registers; a unit vector takes 160 in place of 205, a square root alone 48, a reciprocal 52 in place of 70, a
//! direction to a light 145 in place of 270. Rejected: three products with the same factor, in which the compiler does as well (1.01).

use core::arch::{asm, naked_asm};

use super::newton::{RECIP, RSQRT, Root};

/// Adds `$term` to the sum of the middle products in `$sum`. The term's register is free afterwards.
macro_rules! add_middle {
    ($sum:literal, $term:literal, $overflow:literal) => {
        concat!("adds ", $sum, ", ", $sum, ", ", $term, "\n bvs ", $overflow, "f\n", $overflow, "5:\n")
    };
}

/// Makes up for an overflow of the sum: it looks negative where it is positive. It is worth 2 to the power of `$bit` in `$high`.
macro_rules! mend_middle {
    ($high:literal, $bit:literal, $free:literal, $overflow:literal) => {
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
            ", #",
            $bit,
            "\n subs ",
            $high,
            ", ",
            $high,
            ", ",
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
            ", #",
            $bit,
            "\n adds ",
            $high,
            ", ",
            $high,
            ", ",
            $free,
            "\n b ",
            $overflow,
            "5b\n"
        )
    };
}

/// Adds the product of `r0` and `r1` to the sum in `r3:r4`, and its middle products to the sum in `r6`. What it leaves in `r0` to `r2`,
/// `r5` and `r7` is not saved.
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
    /// The sum of three products.
    sum
}

scalar_product! {
    /// The sum of three products in units of 2²⁴, downward, in `r3`.
    sum_downward, "lsls r3, r3, #8", "lsrs r4, r4, #24", "orrs r3, r3, r4"
}

/// The sum of the squares of `r0` to `r2`, in `r0:r3`. What it leaves in `r1` to `r5` and `r12` is not saved. To be followed by
/// [`mend_squares`], after what goes elsewhere.
macro_rules! add_squares {
    () => {
        concat!(
            // A square has its middle product twice.
            "uxth r3, r0\n asrs r0, r0, #16\n movs r4, r3\n muls r4, r0, r4\n muls r3, r3, r3\n muls r0, r0, r0\n",
            "uxth r5, r1\n asrs r1, r1, #16\n mov r12, r5\n muls r5, r5, r5\n adds r3, r3, r5\n mov r5, r12\n",
            "muls r5, r1, r5\n muls r1, r1, r1\n adcs r0, r1\n",
            add_middle!("r4", "r5", "40"),
            "uxth r5, r2\n asrs r2, r2, #16\n movs r1, r5\n muls r5, r5, r5\n adds r3, r3, r5\n muls r1, r2, r1\n",
            "muls r2, r2, r2\n adcs r0, r2\n",
            add_middle!("r4", "r1", "41"),
            "lsls r1, r4, #17\n asrs r4, r4, #15\n adds r3, r3, r1\n adcs r0, r4\n"
        )
    };
}

/// What [`add_squares`] goes to where a sum overflows.
macro_rules! mend_squares {
    () => {
        concat!(mend_middle!("r0", "17", "r5", "40"), mend_middle!("r0", "17", "r5", "41"))
    };
}

/// The sum of the squares of `r0` to `r2`, in `r0:r3`. What it leaves in `r1` to `r5` and `r12` is not saved.
#[allow(unsafe_code)]
#[unsafe(naked)]
extern "C" fn squares() {
    naked_asm!(add_squares!(), "bx lr", mend_squares!())
}

/// Shifts digits up by `$step`, and counts that, if so many are 0.
macro_rules! search {
    ($digits:literal, $free:literal, $count:literal, $step:literal, $rest:literal, $found:literal) => {
        concat!(
            "lsrs ",
            $free,
            ", ",
            $digits,
            ", #",
            $rest,
            "\n bne ",
            $found,
            "f\n lsls ",
            $digits,
            ", ",
            $digits,
            ", #",
            $step,
            "\n adds ",
            $count,
            ", #",
            $step,
            "\n",
            $found,
            ":\n"
        )
    };
}

/// Shifts the digits in `r0` up by as many pairs of zeros as they begin with, and adds that to `r2`. What it leaves in `r1` is not saved.
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

/// The value of a curve's piece, in `r1`, at the digits in `r0`, as [`newton`](super::newton) has it. What it leaves in `r3` and `r4` is not
/// saved.
macro_rules! at {
    () => {
        "lsrs r3, r0, #9\n uxth r3, r3\n uxth r4, r1\n muls r3, r4, r3\n subs r1, r1, r3\n lsrs r1, r1, #16\n"
    };
}

/// A number of 16 bits times one in units of 2⁻²¹, of which the halves are in `r5` and `r6`; `$shift` tells whether it has a sign. The
/// product is in `$result`; what else it leaves in `$number` and `r4` is not saved.
macro_rules! scale {
    ($number:literal, $shift:literal, $result:literal) => {
        concat!(
            "movs r4, ",
            $number,
            "\n muls r4, r5, r4\n ",
            $shift,
            " r4, r4, #16\n muls ",
            $number,
            ", r6, ",
            $number,
            "\n adds r4, r4, ",
            $number,
            "\n ",
            $shift,
            " ",
            $result,
            ", r4, #5\n"
        )
    };
}

/// The upper half of `$number` times `r0`, in `r3`; `r6` is `r0`'s own upper half. What it leaves in `r4`, `r5` and `r7` is not saved.
macro_rules! upper {
    ($number:literal) => {
        concat!(
            "uxth r4, ",
            $number,
            "\n lsrs r3, ",
            $number,
            ", #16\n",
            "uxth r5, r0\n",
            "movs r7, r5\n",
            "muls r7, r4, r7\n",
            "lsrs r7, r7, #16\n",
            "muls r4, r6, r4\n",
            "adds r4, r4, r7\n",
            "uxth r7, r4\n",
            "lsrs r4, r4, #16\n",
            "muls r5, r3, r5\n",
            "adds r5, r5, r7\n",
            "lsrs r5, r5, #16\n",
            "muls r3, r6, r3\n",
            "adds r3, r3, r4\n",
            "adds r3, r3, r5\n",
        )
    };
}

/// Of the number in `r0:r3` the leading zeros in `r2`, as far as they are even, and the digits after them in `r0`; of these 1/√x in `r1`, as
/// [`line_of_root`]. What it leaves in `r3` and `r4` is not saved.
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

/// 1/√x of the digits in `r0` in `r1`, by the line of [`rsqrt`](super::newton::rsqrt), of which `$table` has the address. What it leaves in
/// `r3` and `r4` is not saved.
macro_rules! line_of_root {
    ($table:literal) => {
        concat!("ldr r1, ", $table, "\n lsrs r3, r0, #25\n lsls r3, r3, #2\n ldr r1, [r1, r3]\n", at!())
    };
}

/// Newton's step from there: 1/√x in `r1` in 31 digits. The upper half of `r0` is in `r6` from here on. What it leaves in `r3` to `r5` and
/// `r7` is not saved.
macro_rules! end_reciprocal_root {
    () => {
        concat!(
            "movs r3, r1\n muls r3, r1, r3\n lsrs r6, r0, #16\n",
            upper!("r3"),
            "movs r4, #1\n lsls r4, r4, #30\n subs r3, r4, r3\n asrs r3, r3, #3\n muls r3, r1, r3\n asrs r3, r3, #13\n",
            "lsls r1, r1, #15\n adds r1, r1, r3\n"
        )
    };
}

/// How far a root is shifted, in `r2`, from the leading zeros there.
macro_rules! halve_zeros {
    () => {
        "subs r2, r2, #1\n bcs 25f\n movs r2, #0\n 25:\n lsrs r2, r2, #1\n"
    };
}

/// Of the number in `r0:r3`, as [`root`](super::newton::root): the root in `r0`, its reciprocal in `r1`, and how far the root was shifted in
/// `r2`. What it leaves in `r3` to `r5` is not saved.
#[allow(unsafe_code)]
#[unsafe(naked)]
extern "C" fn roots() {
    naked_asm!(
        "push {{r6, r7, lr}}",
        begin_root!("29f"),
        end_reciprocal_root!(),
        // The upper half of the digits times the reciprocal root.
        upper!("r1"),
        "lsls r0, r3, #1",
        halve_zeros!(),
        "lsrs r0, r2",
        "pop {{r6, r7, pc}}",
        ".p2align 2",
        "29:",
        ".word {table}",
        table = sym RSQRT,
    )
}

/// Of the number in `r0:r3` the square root in `r0`, as [`square_root`](super::newton::square_root). What it leaves in `r1` to `r4` is not
/// saved.
#[allow(unsafe_code)]
#[unsafe(naked)]
extern "C" fn square_root_alone() {
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
        table = sym RSQRT,
    )
}

/// Of the number in `r0`, which is not 0, as [`inverse`](super::inverse): leading zeros in `r2`, and the reciprocal of what is after them in
/// `r0`. What it leaves in `r1` and `r3` to `r5` is not saved.
#[allow(unsafe_code)]
#[unsafe(naked)]
extern "C" fn reciprocal() {
    naked_asm!(
        "push {{r6, r7, lr}}",
        "asrs r1, r0, #31",
        "eors r0, r1",
        "subs r0, r0, r1",
        "movs r2, #0",
        search_pairs!(),
        search!("r0", "r1", "r2", "1", "31", "25"),
        // y, by the table.
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
        table = sym RECIP,
    )
}

/// Of the coordinate that the stack pointer is at by `$place`, shifted up by `r2`, and the reciprocal length of which the halves are in `r5`
/// and `r6`: that of the unit vector, in its place. What it leaves in `r0`, `r3`, `r4` and `r7` is not saved.
macro_rules! unit_coordinate {
    ($place:literal) => {
        concat!(
            "ldr r0, [sp, #",
            $place,
            "]\n lsls r0, r2\n uxth r3, r0\n asrs r0, r0, #16\n movs r4, r3\n muls r4, r5, r4\n lsrs r4, r4, #16\n",
            "movs r7, r0\n muls r7, r5, r7\n adds r4, r4, r7\n uxth r7, r4\n asrs r4, r4, #16\n muls r3, r6, r3\n",
            "adds r3, r3, r7\n lsrs r3, r3, #16\n muls r0, r6, r0\n adds r0, r0, r4\n adds r0, r0, r3\n",
            "adds r0, #16\n asrs r0, r0, #5\n str r0, [sp, #",
            $place,
            "]\n"
        )
    };
}

/// Of the vector in `r0` to `r2`, the unit vector, as [`polar`](crate::math::Real::polar). What it leaves in `r3` to `r5` and `r12` is not
/// saved.
#[allow(unsafe_code)]
#[unsafe(naked)]
extern "C" fn unit_vector() {
    naked_asm!(
        "push {{r0, r1, r2, r6, r7, lr}}",
        add_squares!(),
        // What an overflow goes to must be near.
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
        table = sym RSQRT,
    )
}

/// Of the vector in `r0` to `r2` and the unit normal in `r3` to `r5`, as [`toward_light`](super::coarse::toward_light): the unit vector in
/// `r0` to `r2`, the length in `r3`, the cosine in `r4`; where the light is not above the surface, -1 there and nothing else.
#[allow(unsafe_code)]
#[unsafe(naked)]
extern "C" fn direction_to_light() {
    naked_asm!(
        "push {{r6, r7, lr}}",
        // The height above the surface, from 15 digits of the normal.
        "asrs r3, r3, #10",
        "uxth r6, r0",
        "asrs r7, r0, #16",
        "muls r6, r3, r6",
        "muls r7, r3, r7",
        "asrs r4, r4, #10",
        "uxth r3, r1",
        "muls r3, r4, r3",
        "adds r6, r6, r3",
        "asrs r3, r1, #16",
        "muls r3, r4, r3",
        "adds r7, r7, r3",
        "asrs r5, r5, #10",
        "uxth r3, r2",
        "muls r3, r5, r3",
        "adds r6, r6, r3",
        "asrs r3, r2, #16",
        "muls r3, r5, r3",
        "adds r7, r7, r3",
        "asrs r6, r6, #14",
        "lsls r7, r7, #2",
        "adds r7, r7, r6",
        "cmp r7, #0",
        "bgt 20f",
        "movs r4, #0",
        "mvns r4, r4",
        "pop {{r6, r7, pc}}",
        "20:",
        // How far the digits can be shifted up.
        "asrs r3, r0, #31",
        "eors r3, r0",
        "asrs r4, r1, #31",
        "eors r4, r1",
        "orrs r3, r4",
        "asrs r4, r2, #31",
        "eors r4, r2",
        "orrs r3, r4",
        "movs r4, #0",
        // Most are at least 1/2 away.
        "lsrs r5, r3, #23",
        "bne 22f",
        search!("r3", "r5", "r4", "16", "15", "21"),
        search!("r3", "r5", "r4", "8", "23", "22"),
        search!("r3", "r5", "r4", "4", "27", "23"),
        search!("r3", "r5", "r4", "2", "29", "24"),
        search!("r3", "r5", "r4", "1", "30", "25"),
        // 15 digits of each coordinate, and the sum of their squares.
        "lsls r0, r4",
        "asrs r0, r0, #16",
        "lsls r1, r4",
        "asrs r1, r1, #16",
        "lsls r2, r4",
        "asrs r2, r2, #16",
        "movs r3, r0",
        "muls r3, r0, r3",
        "movs r5, r1",
        "muls r5, r1, r5",
        "adds r3, r3, r5",
        "movs r5, r2",
        "muls r5, r2, r5",
        "adds r3, r3, r5",
        "lsls r7, r4",
        "lsrs r7, r7, #16",
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
        // Times their squares, and by halves times all others.
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
        table = sym RSQRT,
    )
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

/// The sum of three squares.
#[inline(always)]
pub(super) fn length_squared([x, y, z]: [i32; 3]) -> u64 {
    let (high, low): (u32, u32);
    // SAFETY: the function takes three registers, and leaves nothing changed but what is named here.
    #[allow(unsafe_code)]
    unsafe {
        asm!(
            "bl {function}",
            function = sym squares,
            inlateout("r0") x => high,
            inlateout("r1") y => _,
            inlateout("r2") z => _,
            out("r3") low,
            out("r4") _,
            out("r5") _,
            out("r12") _,
            out("lr") _,
            options(pure, nomem),
        );
    }
    u64::from(high) << 32 | u64::from(low)
}

/// The square root of a number below 2⁶², and its reciprocal.
#[inline(always)]
pub(super) fn root(squared: u64) -> Root {
    let (length, inverse, up): (u32, u32, u32);
    // SAFETY: the function takes two registers, reads a table for every 7 bits, and leaves nothing changed but what is named here.
    #[allow(unsafe_code)]
    unsafe {
        asm!(
            "bl {function}",
            function = sym roots,
            inlateout("r0") (squared >> 32) as u32 => length,
            out("r1") inverse,
            out("r2") up,
            inlateout("r3") squared as u32 => _,
            out("r4") _,
            out("r5") _,
            out("lr") _,
            options(pure, readonly),
        );
    }
    Root { length, inverse, up }
}

/// The square root alone.
#[inline(always)]
pub(super) fn square_root(squared: u64) -> u32 {
    let root: u32;
    // SAFETY: the function takes two registers, reads a table for every 7 bits, and leaves nothing changed but what is named here.
    #[allow(unsafe_code)]
    unsafe {
        asm!(
            "bl {function}",
            function = sym square_root_alone,
            inlateout("r0") (squared >> 32) as u32 => root,
            out("r1") _,
            out("r2") _,
            inlateout("r3") squared as u32 => _,
            out("r4") _,
            out("lr") _,
            options(pure, readonly),
        );
    }
    root
}

/// Leading zeros of the absolute value of a number that is not 0, and the reciprocal of the digits after them.
#[inline(always)]
pub(super) fn inverse(number: i32) -> (u32, i32) {
    let (zeros, inverse): (u32, i32);
    // SAFETY: the function takes a register, reads a table for every 6 bits, and leaves nothing changed but what is named here.
    #[allow(unsafe_code)]
    unsafe {
        asm!(
            "bl {function}",
            function = sym reciprocal,
            inlateout("r0") number => inverse,
            out("r1") _,
            out("r2") zeros,
            out("r3") _,
            out("r4") _,
            out("r5") _,
            out("lr") _,
            options(pure, readonly),
        );
    }
    (zeros, inverse)
}

/// The unit vector along a vector.
#[inline(always)]
pub(super) fn unit([x, y, z]: [i32; 3]) -> [i32; 3] {
    let (ux, uy, uz): (i32, i32, i32);
    // SAFETY: the function takes three registers, reads a table for every 7 bits, and leaves nothing changed but what is named here.
    #[allow(unsafe_code)]
    unsafe {
        asm!(
            "bl {function}",
            function = sym unit_vector,
            inlateout("r0") x => ux,
            inlateout("r1") y => uy,
            inlateout("r2") z => uz,
            out("r3") _,
            out("r4") _,
            out("r5") _,
            out("r12") _,
            out("lr") _,
            options(pure, readonly),
        );
    }
    [ux, uy, uz]
}

/// As [`toward_light`](super::coarse::toward_light).
#[inline(always)]
pub(super) fn toward_light([x, y, z]: [i32; 3], [nx, ny, nz]: [i32; 3]) -> Option<([i32; 3], i32, i32)> {
    let (ux, uy, uz, length, cosine): (i32, i32, i32, i32, i32);
    // SAFETY: the function takes six registers, reads a table for every 7 bits, and leaves nothing changed but what is named here.
    #[allow(unsafe_code)]
    unsafe {
        asm!(
            "bl {function}",
            function = sym direction_to_light,
            inlateout("r0") x => ux,
            inlateout("r1") y => uy,
            inlateout("r2") z => uz,
            inlateout("r3") nx => length,
            inlateout("r4") ny => cosine,
            inlateout("r5") nz => _,
            out("r12") _,
            out("lr") _,
            options(pure, readonly),
        );
    }
    if cosine >= 0 { Some(([ux, uy, uz], length, cosine)) } else { None }
}
