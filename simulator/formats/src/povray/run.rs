//! Rendering with POV-Ray, on one thread.

use core::fmt;
use std::io::{self, ErrorKind};
use std::path::Path;
use std::process::Command;

use rayline::{Scene, Settings};

use super::{PovrayError, to_povray};
use crate::Pictures;
use crate::raster::{Raster, RasterError};

/// A picture by POV-Ray, with its report.
#[derive(Clone, Debug)]
pub struct PovrayPicture {
    /// Red, green and blue of each pixel in 8-bit linear light, from the upper left, line by line.
    pub rgb: Vec<u8>,
    report: String,
}

/// The reason why POV-Ray rendered no picture.
#[derive(Debug)]
#[non_exhaustive]
pub enum RunError {
    /// The scene cannot be written for POV-Ray. Replace the part that the error names.
    Scene(PovrayError),
    /// The system refused to write the scene or to start the program. Its text says why.
    Io(io::Error),
    /// POV-Ray failed. Its report says why.
    Failed {
        /// The whole report.
        report: String,
    },
    /// POV-Ray's picture cannot be read, or has another size. Look at the file.
    Picture(RasterError),
}

/// Renders a scene with POV-Ray on one thread, without a display and anti-aliasing. Files are written to
/// `directory` under `name`. Returns `None` if `povray` is not installed.
///
/// # Errors
/// See [`RunError`].
pub fn render(
    scene: &Scene<'_>,
    settings: &Settings,
    directory: &Path,
    name: &str,
) -> Result<Option<PovrayPicture>, RunError> {
    let path = directory.join(format!("{name}.pov"));
    let mut pictures = Pictures::beside(&path);
    let text = to_povray(scene, settings, &mut pictures).map_err(RunError::Scene)?;
    pictures.files().try_for_each(|(path, bytes)| std::fs::write(path, bytes)).map_err(RunError::Io)?;
    render_source(&text, settings, directory, name)
}

/// [`render`] for a scene that is given in POV-Ray's language: for what Rayline's scenes do not say, such as
/// photons.
///
/// # Errors
/// See [`RunError`].
pub fn render_source(
    source: &str,
    settings: &Settings,
    directory: &Path,
    name: &str,
) -> Result<Option<PovrayPicture>, RunError> {
    std::fs::write(directory.join(format!("{name}.pov")), source).map_err(RunError::Io)?;
    let output = format!("{name}-povray.ppm");
    let mut command = Command::new("povray");
    command.current_dir(directory).args([
        format!("+I{name}.pov"),
        format!("+O{output}"),
        format!("+W{}", settings.width),
        format!("+H{}", settings.height),
    ]);
    // Eight bits of linear light, uncompressed; no display, no anti-aliasing, one thread; the report on the
    // console.
    command.args(["+FP8", "File_Gamma=1", "Dither=off", "-D", "-A", "+WT1", "+GA"]);
    let finished = match command.output() {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        finished => finished.map_err(RunError::Io)?,
    };
    let report = String::from_utf8_lossy(&finished.stderr).into_owned();
    if !finished.status.success() {
        return Err(RunError::Failed { report });
    }
    let picture = std::fs::read(directory.join(output)).map_err(RunError::Io)?;
    let rgb = Raster::decode(&picture).map_err(RunError::Picture)?.rgb();
    Ok(Some(PovrayPicture { rgb, report }))
}

impl PovrayPicture {
    /// The first number of the line of the report that begins with `label`, such as `Shadow Ray Tests`.
    pub fn count(&self, label: &str) -> Option<u64> {
        self.line(label)?.trim_start_matches([':', ' ']).split(' ').next()?.parse().ok()
    }

    /// The CPU time in seconds that the report has for a step: `Parse Time`, `Bounding Time` or `Trace Time`.
    pub fn cpu_seconds(&self, label: &str) -> Option<f64> {
        // It is on the next line: `using 1 thread(s) with 0.625 CPU-seconds total`.
        let mut lines = self.report.lines().skip_while(|line| !line.trim_start().starts_with(label));
        lines.nth(1)?.split(" with ").nth(1)?.split(' ').next()?.parse().ok()
    }

    fn line(&self, label: &str) -> Option<&str> {
        self.report.lines().find_map(|line| line.trim_start().strip_prefix(label))
    }
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Io(error) => write!(f, "cannot run POV-Ray: {error}"),
            Self::Failed { report } => {
                let last = report.lines().rfind(|line| !line.trim().is_empty()).unwrap_or_default();
                write!(f, "POV-Ray failed: {last}")
            }
            Self::Picture(error) => write!(f, "cannot read POV-Ray's picture: {error}"),
        }
    }
}

impl core::error::Error for RunError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Scene(error) => Some(error),
            Self::Io(error) => Some(error),
            Self::Failed { .. } => None,
            Self::Picture(error) => Some(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_the_report() {
        let report = "\
Rays:             416885   Saved:                 0   Max Level: 5/5
Shadow Ray Tests:  914576   Succeeded:            406003
Render Time:
  Trace Time:       0 hours  1 minutes  2 seconds (62.625 seconds)
              using 1 thread(s) with 62.500 CPU-seconds total";
        let picture = PovrayPicture { rgb: Vec::new(), report: report.to_owned() };
        assert_eq!(picture.count("Rays"), Some(416_885));
        assert_eq!(picture.count("Shadow Ray Tests"), Some(914_576));
        assert_eq!(picture.count("Photons"), None);
        assert_eq!(picture.cpu_seconds("Trace Time"), Some(62.5));
        assert_eq!(picture.cpu_seconds("Parse Time"), None);
    }
}
