//! Detects ARMv6-M (Cortex-M0, M0+), for which fixed point has functions in assembly.
//!
//! Stable Rust has no `cfg` for it: all that it says of `thumbv6m-none-eabi` is true of `thumbv4t-none-eabi`
//! (Game Boy Advance) as well, whose assembler refuses half of the instructions. A target of another name
//! gets portable code, which gives the same bits.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(armv6m)");
    if std::env::var("TARGET").is_ok_and(|target| target.starts_with("thumbv6m-")) {
        println!("cargo::rustc-cfg=armv6m");
    }
}
