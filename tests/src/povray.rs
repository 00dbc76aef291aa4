//! Pictures by POV-Ray, a renderer that others wrote.

use std::io::ErrorKind;
use std::path::Path;
use std::process::Command;

use rayline::{Scene, Settings};
use rayline_simulator::povray::to_povray;

use crate::Picture;

/// A picture by POV-Ray, and what POV-Ray reports of its work.
#[derive(Clone, Debug)]
pub struct PovrayPicture {
    /// The picture in 8-bit linear light.
    pub picture: Picture,
    report: String,
}

impl PovrayPicture {
    /// Renders a scene in `directory`; `None` where `povray` is not installed.
    pub fn render(scene: &Scene<'_>, settings: Settings, directory: &Path, name: &str) -> Option<Self> {
        std::fs::create_dir_all(directory).unwrap();
        std::fs::write(directory.join(name).with_extension("pov"), to_povray(scene, &settings).unwrap())
            .unwrap();
        let mut command = Command::new("povray");
        command.current_dir(directory).args([
            format!("+I{name}.pov"),
            format!("+O{name}-povray.png"),
            format!("+W{}", settings.width),
            format!("+H{}", settings.height),
        ]);
        // Eight bits of linear light, no display, no anti-aliasing, one thread; the report on the console.
        command.args(["+FN8", "File_Gamma=1", "Dither=off", "-D", "-A", "+WT1", "+GA"]);
        let output = match command.output() {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                println!("povray is not installed: nothing to compare {name} with");
                return None;
            }
            output => output.unwrap(),
        };
        let report = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "POV-Ray refused {name}: {report}");
        Some(Self { picture: Picture::read(&directory.join(format!("{name}-povray.png"))), report })
    }

    /// The first number of the line of POV-Ray's report that begins with `label`; 0 where there is none.
    pub fn reported(&self, label: &str) -> u64 {
        let line = self.report.lines().find_map(|line| line.trim_start().strip_prefix(label));
        let number = line.and_then(|line| line.trim_start_matches([':', ' ']).split(' ').next());
        number.map_or(0, |number| number.parse().unwrap())
    }
}
