//! Writes the picture's scene, size and mode as Rust, and links the program for the Pico's memory.

use std::env;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    rayline_build_support::write_picture("160x120", rayline_build_support::Number::Fixed)?;
    rayline_build_support::write_mode()?;
    println!("cargo:rerun-if-changed=memory.x");
    println!("cargo:rustc-link-search={}", env::var("CARGO_MANIFEST_DIR")?);
    for argument in ["--nmagic", "-Tlink.x", "-Tlink-rp.x"] {
        println!("cargo:rustc-link-arg-bins={argument}");
    }
    Ok(())
}
