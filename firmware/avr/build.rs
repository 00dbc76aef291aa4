//! Links the program for the board's memory.

use std::env;

fn main() {
    println!("cargo:rerun-if-changed=memory.x");
    if env::var("CARGO_CFG_TARGET_ARCH").is_ok_and(|processor| processor == "avr") {
        let memory = concat!("-T", env!("CARGO_MANIFEST_DIR"), "/memory.x");
        // The compiler driver of GCC takes its start code and arithmetic for this chip.
        for argument in ["-mmcu=atmega2560", memory] {
            println!("cargo:rustc-link-arg-bins={argument}");
        }
    }
}
