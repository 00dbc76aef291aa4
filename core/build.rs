//! Detects ARMv6-M (Cortex-M0, M0+), for which fixed point has functions in assembly.
//!
//! Stable Rust has no `cfg` for it: all that it says of `thumbv6m-none-eabi` is true of `thumbv4t-none-eabi`
//! (Game Boy Advance) as well, whose assembler refuses half of the instructions. A target of another name
//! gets portable code, which gives the same bits.

fn main() {
    // No file: a change of this one is seen anyway, and its path differs where other packages use it.
    println!("cargo::rerun-if-env-changed=TARGET");
    println!("cargo::rustc-check-cfg=cfg(armv6m)");
    if std::env::var("TARGET").is_ok_and(|target| target.starts_with("thumbv6m-")) {
        println!("cargo::rustc-cfg=armv6m");
    }
}
