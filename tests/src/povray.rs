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
        Some(Self::new(report, settings))
    }

    /// [`render`](Self::render) with another scene file than Rayline writes: `change` gets that one.
    pub fn render_changed(
        scene: &Scene<'_>,
        settings: Settings,
        (directory, name): (&Path, &str),
        change: impl Fn(String) -> String,
    ) -> Option<Self> {
        Self::render(scene, settings, directory, name)?;
        let written = std::fs::read_to_string(directory.join(format!("{name}.pov"))).unwrap();
        let report = povray::render_source(&change(written), &settings, directory, name).unwrap()?;
        Some(Self::new(report, settings))
    }

    fn new(report: povray::PovrayPicture, settings: Settings) -> Self {
        let pixels = report.rgb.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect();
        Self { picture: Picture { width: settings.width, pixels }, report }
    }

    /// The first number in the line of POV-Ray's report that begins with `label`; 0 if there is none.
    pub fn reported(&self, label: &str) -> u64 {
        self.report.count(label).unwrap_or(0)
    }
}
