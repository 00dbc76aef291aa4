//! POV-Ray 3.7, an independent renderer: writing of scenes in its language, and rendering with it where it is
//! installed.

mod error;
mod formula;
mod images;
mod light;
mod literal;
mod material;
mod pattern;
mod run;
mod scene;
mod shape;
mod surface;

pub use error::{Lack, PovrayError};
pub use run::{PovrayPicture, RunError, render, render_source};
pub use scene::to_povray;
