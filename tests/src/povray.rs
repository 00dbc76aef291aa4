//! Pictures by POV-Ray, an independent renderer.

use std::path::Path;

use rayline::{Scene, Settings};
use rayline_simulator::povray;

use crate::Picture;

/// A picture by POV-Ray, with its report.
#[derive(Clone, Debug)]
pub struct PovrayPicture {
    /// The picture in 8-bit linear light.
    pub picture: Picture,
    report: povray::PovrayPicture,
}

impl PovrayPicture {
    /// Renders a scene with files in `directory`; `None` if `povray` is not installed.
    pub fn render(scene: &Scene<'_>, settings: Settings, directory: &Path, name: &str) -> Option<Self> {
        std::fs::create_dir_all(directory).unwrap();
        let Some(report) = povray::render(scene, &settings, directory, name).unwrap() else {
            println!("povray is not installed: nothing to compare {name} with");
            return None;
        };
        let pixels = report.rgb.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect();
        Some(Self { picture: Picture { width: settings.width, pixels }, report })
    }

    /// The first number in the line of POV-Ray's report that begins with `label`; 0 if there is none.
    pub fn reported(&self, label: &str) -> u64 {
        self.report.count(label).unwrap_or(0)
    }
}
