//! POV-Ray 3.7, a renderer that others wrote: scenes in its language, and pictures by it where it is installed.

mod export;
mod run;

pub use export::{PovrayError, to_povray};
pub use run::{PovrayPicture, RunError, render};
