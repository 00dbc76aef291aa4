//! Frame after frame, from a camera that goes around the scene.

use rayline::Renderer;
use rayline_show::{Number, Orbit};

use crate::fault::Fault;
use crate::picture::{Prepared, SCENE, SETTINGS};

/// The frames of the show. Each core has its own, and they are the same.
#[derive(Debug)]
pub(crate) struct Frames {
    scene: Prepared,
    orbit: Orbit,
    next: u32,
}

impl Frames {
    pub(crate) fn new(scene: Prepared) -> Self {
        Self { scene, orbit: Orbit::around(SCENE), next: 0 }
    }

    /// The next frame.
    pub(crate) fn next(&mut self) -> Result<Renderer<'_, 'static, Number>, Fault> {
        self.scene.set_camera(&self.orbit.camera(self.next))?;
        self.next = (self.next + 1) % Orbit::FRAMES;
        Ok(Renderer::new(&self.scene, SETTINGS)?)
    }
}
