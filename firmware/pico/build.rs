//! Chooses scene, size and mode of the picture, and gives the program its memory layout.

use std::env;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    rayline_choice::write("160x120", rayline_choice::Number::Fixed)?;
    rayline_choice::write_mode()?;
    println!("cargo:rerun-if-changed=memory.x");
    println!("cargo:rustc-link-search={}", env::var("CARGO_MANIFEST_DIR")?);
    for argument in ["--nmagic", "-Tlink.x", "-Tlink-rp.x"] {
        println!("cargo:rustc-link-arg-bins={argument}");
    }
    Ok(())
}
