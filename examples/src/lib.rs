//! Files, and a panel that stands for a real one: the examples share them, and firmware has no use for them.

mod mock_panel;

pub use mock_panel::{MockBus, MockDelay, MockPanel, MockPin};

use std::error::Error;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use embedded_graphics::pixelcolor::{PixelColor, Rgb888};
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};

/// The file to write: the first argument of the program, or this name in `target/examples-pictures`, a folder
/// that is made if it is not there.
///
/// # Errors
/// The folder cannot be made.
pub fn file(name: &str) -> io::Result<PathBuf> {
    if let Some(file) = std::env::args_os().nth(1) {
        return Ok(file.into());
    }
    let folder = Path::new("target").join("examples-pictures");
    fs::create_dir_all(&folder)?;
    Ok(folder.join(name))
}

/// Writes what a display shows into the [`file()`] of this name, and says so.
///
/// # Errors
/// The file cannot be written.
pub fn save<C: PixelColor + Into<Rgb888>>(
    display: &SimulatorDisplay<C>,
    output: &OutputSettings,
    name: &str,
) -> Result<(), Box<dyn Error>> {
    let file = file(name)?;
    display.to_rgb_output_image(output).save_png(&file)?;
    let size = display.output_size(output);
    println!("{}: a picture of {}x{} pixels", file.display(), size.width, size.height);
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    /// The text from the scene on, without what the formatter changes.
    fn program(text: &str) -> String {
        let (_, program) = text.split_once("static SCENE").expect("a scene");
        program.split_whitespace().collect::<String>().replace(",}", "}")
    }

    #[test]
    fn hello_is_the_program_of_both_readmes() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let text = |file: &str| fs::read_to_string(folder.join(file)).expect(file);
        let hello = program(&text("hello.rs"));
        for file in ["../README.md", "../core/README.md"] {
            let readme = text(file);
            let (_, code) = readme.split_once("```rust\n").expect("a program");
            let (code, _) = code.split_once("\n```").expect("the end of the program");
            assert!(hello.starts_with(&program(code)), "make {file} and examples/hello.rs alike");
        }
    }
}
