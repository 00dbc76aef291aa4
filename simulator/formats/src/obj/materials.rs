//! Materials of MTL files. The table in [`obj`](super) describes how they are converted.

use std::path::Path;

use rayline::{LinearRgb, Material, Texture};

use super::error::{LineError, ObjError, ObjFault};
use super::statements::{lines, number};
use crate::files::Files;

/// The material of meshes without one.
pub(super) const GRAY: Material<'static> =
    Material { ambient: AMBIENT, ..Material::matte(LinearRgb::gray(0.7)) };

const AMBIENT: f32 = 0.1;

/// The contents of all MTL files of an OBJ file.
#[derive(Clone, Debug, Default)]
pub(super) struct Library {
    /// The checked statements, written for `tobj`.
    pub(super) text: String,
    /// The names of the materials.
    pub(super) names: Vec<String>,
    /// Notes about parts that were left out.
    pub(super) notes: Vec<String>,
}

/// Reads the MTL files of these names.
pub(super) fn read(folder: &Path, names: &[(usize, String)], files: &Files) -> Result<Library, ObjError> {
    let mut library = Library::default();
    for (_, name) in names {
        // A name may contain spaces, or a line may have several names.
        let is_one = files.reference(folder, name).is_ok_and(|path| path.is_file());
        let names = if is_one { vec![&**name] } else { name.split_whitespace().collect() };
        for name in names {
            let path = match files.reference(folder, name) {
                Ok(path) => path,
                Err(reason) => {
                    let name = name.escape_debug();
                    library.notes.push(format!("`{name}`: its materials are left out: {reason}"));
                    continue;
                }
            };
            match super::text_of(&path, files) {
                Ok(text) => library.add(&path, &text).map_err(|error| error.of(&path))?,
                Err(ObjError { fault: ObjFault::Unreadable(reason), .. }) => {
                    library.notes.push(format!("{}: its materials are left out: {reason}", path.display()));
                }
                Err(error) => return Err(error),
            }
        }
    }
    Ok(library)
}

impl Library {
    fn add(&mut self, path: &Path, text: &str) -> Result<(), LineError> {
        let (mut is_named, mut has_texture) = (false, false);
        for (line, statement) in lines(text) {
            let mut words = statement.split_whitespace();
            let keyword = words.next().unwrap_or_default();
            let written = match keyword {
                "newmtl" => {
                    let name = statement.trim().get(keyword.len()..).unwrap_or_default().trim().to_owned();
                    is_named = true;
                    if name.is_empty() {
                        Err(ObjFault::Expected { expected: "the name of a material", found: name })
                    } else {
                        self.names.push(name.clone());
                        Ok(Some(format!("newmtl {name}")))
                    }
                }
                "Kd" | "Ks" | "Ke" => color(words)
                    .map(|color| color.map(|[red, green, blue]| format!("{keyword} {red} {green} {blue}"))),
                "Ns" | "Ni" | "d" => {
                    // With `-halo`, the number follows that word.
                    let word = words.find(|word| *word != "-halo");
                    number(word, "a number").map(|number| Some(format!("{keyword} {number}")))
                }
                "Tr" => number(words.next(), "a number").map(|number| Some(format!("d {}", 1.0 - number))),
                "illum" => number(words.next(), "the number of an illumination model")
                    .map(|number| Some(format!("illum {}", number as u8))),
                _ => {
                    if keyword.starts_with("map_") && !has_texture {
                        has_texture = true;
                        self.notes.push(format!(
                            "{}:{line}: textures are left out, here and below",
                            path.display()
                        ));
                    }
                    Ok(None)
                }
            };
            let written = written.map_err(|fault| LineError { line, fault })?;
            if let Some(written) = written {
                if !is_named {
                    return Err(LineError { line, fault: ObjFault::NoMaterial });
                }
                self.text += &written;
                self.text.push('\n');
            }
        }
        Ok(())
    }
}

/// Reads a color of three numbers, or of one for all channels; `None` for a spectral or XYZ color.
fn color<'w>(mut words: impl Iterator<Item = &'w str>) -> Result<Option<[f32; 3]>, ObjFault> {
    let first = words.next();
    if matches!(first, Some("spectral" | "xyz")) {
        return Ok(None);
    }
    let red = number(first, "a color")?;
    let mut rest = [red; 2];
    for (place, word) in rest.iter_mut().zip(words) {
        *place = number(Some(word), "a color")?;
    }
    let [green, blue] = rest;
    Ok(Some([red, green, blue]))
}

/// Converts a material.
pub(super) fn material(described: &tobj::Material) -> Material<'static> {
    let share = |value: f32| value.clamp(0.0, 1.0);
    let color = |color: [f32; 3]| {
        let [red, green, blue] = color.map(share);
        LinearRgb::new(red, green, blue)
    };
    let opacity = share(described.dissolve.unwrap_or(1.0));
    let transmittance = 1.0 - opacity;
    let [red, green, blue] = described.specular.unwrap_or_default().map(share);
    let specular = (red + green + blue) / 3.0;
    let shininess = described.shininess.unwrap_or(0.0).max(0.0);
    let mirrors = matches!(described.illumination_model, Some(3..=7));
    let refracts = transmittance > 0.0;
    let material = Material {
        ambient: AMBIENT * opacity,
        diffuse: opacity,
        specular: if shininess > 0.0 { specular } else { 0.0 },
        shininess,
        reflectance: if mirrors { specular * opacity } else { 0.0 },
        transmittance,
        // The range of fixed point.
        ior: if refracts { described.optical_density.unwrap_or(1.0).clamp(0.14, 7.0) } else { 1.0 },
        ..Material::matte(described.diffuse.map_or(LinearRgb::gray(0.7), color))
    };
    match described.emissive {
        Some(emitted) if emitted.iter().any(|channel| *channel > 0.0) => {
            Material { color: Texture::Solid(color(emitted)), ambient: 1.0, diffuse: 0.0, ..material }
        }
        _ => material,
    }
}
