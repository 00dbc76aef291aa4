//! POV-Ray 3.7, a renderer that others wrote: scenes in its language, and pictures by it where it is installed.

mod error;
mod light;
mod material;
mod pattern;
mod run;
mod scene;
mod shape;
mod surface;
mod words;

pub use error::{Lack, PovrayError};
pub use run::{PovrayPicture, RunError, render};
pub use scene::to_povray;
