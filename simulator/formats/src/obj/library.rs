//! The statements of MTL files.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use super::lines;
use super::statements::{FOREIGN, number};
use crate::files::Files;
use crate::model::{Beside, beside};
use crate::nff::Excerpt;
use crate::notes::Notes;

/// All materials of the MTL files of an OBJ file.
#[derive(Debug, Default)]
pub(super) struct Library {
    pub(super) materials: Vec<Described>,
    /// The positions of materials by their names; of two with one name, the last.
    named: HashMap<String, usize>,
    /// The positions of materials by their names before a `#`; `None` if several materials have one.
    shortened: HashMap<String, Option<usize>>,
}

/// A material as described in a file.
#[derive(Clone, Debug, Default)]
pub(super) struct Described {
    /// The file and the line of its `newmtl`, for notes.
    pub(super) place: String,
    /// The folder of the file, where its pictures are.
    pub(super) folder: PathBuf,
    /// `Kd`, `Ks`, `Ke`.
    pub(super) diffuse: Option<[f32; 3]>,
    pub(super) specular: Option<[f32; 3]>,
    pub(super) emission: Option<[f32; 3]>,
    /// `Ns`, `Ni`, `d`, `Tr`.
    pub(super) exponent: Option<f32>,
    pub(super) ior: Option<f32>,
    pub(super) opacity: Option<f32>,
    pub(super) transparency: Option<f32>,
    /// `illum`.
    pub(super) model: Option<u8>,
    /// The maps of color, highlight, opacity, bumps and normals, with the numbers of their lines.
    pub(super) map_color: Option<(String, Map)>,
    pub(super) map_specular: Option<(String, Map)>,
    pub(super) map_opacity: Option<(String, Map)>,
    pub(super) map_bump: Option<(String, Map)>,
    pub(super) map_normal: Option<(String, Map)>,
}

/// A picture on a surface, and its options.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Map {
    /// The name of the file.
    pub(super) name: String,
    /// `-s`: the factor of texture coordinates, and `-o`: the number added to them.
    pub(super) scale: [f32; 2],
    pub(super) offset: [f32; 2],
    /// `-clamp on`: the picture does not repeat.
    pub(super) clamps: bool,
    /// `-bm`: the factor of a bump map.
    pub(super) bump: f32,
}

/// The note about files elsewhere.
pub(super) const OUTSIDE: &str = "not in the folder of the scene or below it";

impl Library {
    /// Reads the MTL files of these names, which are in a folder or below.
    pub(super) fn read(
        files: &Files,
        folder: &Path,
        names: &[(usize, String)],
        path: &str,
        notes: &mut Notes,
    ) -> Self {
        let (mut library, mut known) = (Self::default(), HashSet::new());
        for (line, names) in names {
            for (name, found) in named_files(files, folder, names) {
                let at = format!("{path}:{line}: `{}`", Excerpt(&name));
                let file = match found {
                    Beside::Found(file) => file,
                    Beside::Instead(file) => {
                        notes.add(&*at, format!("{OUTSIDE}: the file of that name here is used"));
                        file
                    }
                    Beside::Missing => {
                        notes.add(at, "there is no such file; its materials are left out");
                        continue;
                    }
                    Beside::Outside => {
                        notes.add(at, format!("{OUTSIDE}; its materials are left out, so move it there"));
                        continue;
                    }
                };
                // Some programs name the file again for each object.
                if known.insert(file.clone()) {
                    library.add_file(files, &file, &at, notes);
                }
            }
        }
        library
    }

    fn add_file(&mut self, files: &Files, file: &Path, at: &str, notes: &mut Notes) {
        match files.read(file) {
            Ok(bytes) => self.add(&bytes, file, notes),
            Err(reason) => notes.add(at, format!("its materials are left out: {reason}")),
        }
    }

    fn add(&mut self, bytes: &[u8], file: &Path, notes: &mut Notes) {
        let path = file.display().to_string();
        let mut foreign = Notes::default();
        let mut ignores = false;
        let start = self.materials.len();
        for (line, statement) in
            lines::statements(bytes, |line| foreign.add(format!("{path}:{line}"), FOREIGN))
        {
            let statement = statement.trim();
            let keyword = statement.split_whitespace().next().unwrap_or_default();
            let rest = statement.get(keyword.len()..).unwrap_or_default().trim();
            let at = format!("{path}:{line}");
            if keyword == "newmtl" {
                if rest.is_empty() {
                    notes.add(&*at, "`newmtl` without a name");
                }
                let folder = file.parent().unwrap_or_else(|| Path::new("")).to_owned();
                self.name(rest);
                self.materials.push(Described { place: at, folder, ..Described::default() });
                ignores = false;
                continue;
            }
            let Some(material) = self.materials.get_mut(start..).and_then(<[_]>::last_mut) else {
                if !keyword.is_empty() && !ignores {
                    ignores = true;
                    notes.add(at, "left out: there is no `newmtl` before this line");
                }
                continue;
            };
            if let Some(what) = material.read(keyword, rest, &at) {
                notes.add(at, what);
            }
        }
        notes.append(foreign);
    }

    /// Gives a name to the next material.
    fn name(&mut self, name: &str) {
        let position = self.materials.len();
        self.named.insert(name.to_owned(), position);
        if let Some((short, _)) = shortened(name) {
            let known = self.shortened.entry(short.to_owned()).or_insert(Some(position));
            *known = known.filter(|known| *known == position);
        }
    }

    /// The position of the material of a name. `#` may begin a comment, or be a part of the name.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        if let Some(position) = self.named.get(name) {
            return Some(*position);
        }
        match shortened(name) {
            None => self.shortened.get(name).copied().flatten(),
            // `Material #2` is a name of its own.
            Some((_, behind)) if behind.starts_with(|character: char| character.is_ascii_digit()) => None,
            Some((short, _)) => {
                self.named.get(short).copied().or_else(|| self.shortened.get(short).copied().flatten())
            }
        }
    }
}

/// The parts of a name before and after a `#` that follows a space.
fn shortened(name: &str) -> Option<(&str, &str)> {
    let places = name.match_indices('#').map(|(place, _)| place);
    let mut cuts = places.filter_map(|place| Some((name.get(..place)?, name.get(place..)?.get(1..)?)));
    let (before, behind) = cuts.find(|(before, _)| before.ends_with(char::is_whitespace))?;
    Some((before.trim_end(), behind))
}

/// The files that `mtllib` names: one name with blanks, or several names between blanks. A blank may follow a
/// backslash.
fn named_files(files: &Files, folder: &Path, names: &str) -> Vec<(String, Beside)> {
    const BLANK: char = '\u{1f}';
    let found = |name: &str| (name.to_owned(), beside(folder, name, files));
    let is_found = |found: &(String, Beside)| matches!(found.1, Beside::Found(_));
    let unquoted = names.trim_matches('"');
    for whole in [names, unquoted, &unquoted.replace("\\ ", " ")] {
        let found = found(whole);
        if is_found(&found) {
            return vec![found];
        }
    }
    let words = names.replace("\\ ", &BLANK.to_string());
    let words = words.split_whitespace().map(|word| word.replace(BLANK, " "));
    let words: Vec<_> = words.map(|word| found(word.trim_matches('"'))).collect();
    if words.iter().any(is_found) { words } else { vec![found(unquoted)] }
}

impl Described {
    /// Reads a statement; a note about what is left out.
    fn read(&mut self, keyword: &str, rest: &str, at: &str) -> Option<String> {
        let mut words = rest.split_whitespace();
        match keyword {
            "Kd" | "Ks" | "Ke" => {
                if matches!(rest.split_whitespace().next(), Some("spectral" | "xyz")) {
                    return Some("colors by wavelength or in XYZ are left out".to_owned());
                }
                let Some(color) = color(rest) else { return Some(no_number(keyword)) };
                *match keyword {
                    "Kd" => &mut self.diffuse,
                    "Ks" => &mut self.specular,
                    _ => &mut self.emission,
                } = Some(color);
            }
            "Ns" | "Ni" | "d" | "Tr" | "illum" => {
                // With `-halo`, the number follows that word.
                let number = words.find(|word| *word != "-halo").and_then(number);
                let number = number.filter(|number| number.is_finite()).map(|number| number as f32);
                let Some(number) = number else { return Some(no_number(keyword)) };
                match keyword {
                    "Ns" => self.exponent = Some(number),
                    "Ni" => self.ior = Some(number),
                    "d" => self.opacity = Some(number),
                    "Tr" => self.transparency = Some(number),
                    _ => self.model = Some(number as u8),
                }
            }
            "map_Kd" | "map_kd" => self.map_color = Some((at.to_owned(), Map::of(rest)?)),
            "map_Ks" | "map_ks" => self.map_specular = Some((at.to_owned(), Map::of(rest)?)),
            "map_d" | "map_D" => self.map_opacity = Some((at.to_owned(), Map::of(rest)?)),
            "map_Bump" | "map_bump" | "bump" | "map_bm" => {
                self.map_bump = Some((at.to_owned(), Map::of(rest)?))
            }
            "norm" => self.map_normal = Some((at.to_owned(), Map::of(rest)?)),
            "disp" | "decal" | "refl" => return Some(format!("`{keyword}` is left out")),
            // Ambient light comes from the default surroundings, as with `Ka`.
            "map_Ka" | "map_ka" | "map_aat" => {}
            other if other.starts_with("map_") => return Some(format!("`{}` is left out", Excerpt(other))),
            _ => {}
        }
        None
    }
}

fn no_number(keyword: &str) -> String {
    format!("left out: `{keyword}` without a number")
}

/// A color of three numbers, or of one for all channels.
fn color(text: &str) -> Option<[f32; 3]> {
    let mut words = text.split_whitespace().map(|word| {
        let number = number(word).filter(|number| number.is_finite());
        number.map(|number| number as f32)
    });
    let red = words.next()??;
    let [mut green, mut blue] = [red; 2];
    if let Some(given) = words.next() {
        green = given?;
        blue = words.next().map_or(Some(red), |given| given)?;
    }
    Some([red, green, blue])
}

impl Map {
    /// A map by its options and its name; `None` without a name.
    pub(super) fn of(text: &str) -> Option<Self> {
        let mut map =
            Self { name: String::new(), scale: [1.0; 2], offset: [0.0; 2], clamps: false, bump: 1.0 };
        let mut rest = map.options(text);
        // Some programs write options behind the name.
        if let Some((name, options)) = rest.split_once(" -")
            && OPTIONS.iter().any(|(option, _)| options.split_whitespace().next() == Some(option))
        {
            map.options(text.get(text.len() - options.len() - 1..).unwrap_or_default());
            rest = name;
        }
        rest.trim().trim_matches('"').clone_into(&mut map.name);
        (!map.name.is_empty()).then_some(map)
    }

    /// Reads the options at the beginning of a text, and returns the rest.
    fn options<'t>(&mut self, text: &'t str) -> &'t str {
        let mut rest = text.trim_start();
        while let Some((option, most)) = OPTIONS.into_iter().find(|(option, _)| {
            let behind = rest.strip_prefix('-').and_then(|behind| behind.strip_prefix(option));
            behind.is_some_and(|behind| behind.starts_with(char::is_whitespace))
        }) {
            rest = rest.get(option.len() + 1..).unwrap_or_default().trim_start();
            let mut numbers = Vec::new();
            for place in 0..most {
                let (word, behind) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
                let number = number(word).filter(|number| number.is_finite());
                // The first value of an option may be a word; further ones are numbers.
                if place > 0 && number.is_none() {
                    break;
                }
                if option == "clamp" {
                    self.clamps = word == "on";
                }
                numbers.extend(number.map(|number| number as f32));
                rest = behind.trim_start();
            }
            let pair = |given: [f32; 2]| match *numbers {
                [first, second, ..] => [first, second],
                [first] => [first, given[1]],
                [] => given,
            };
            match (option, numbers.first()) {
                ("s", _) => self.scale = pair(self.scale),
                ("o", _) => self.offset = pair(self.offset),
                ("bm", Some(factor)) => self.bump = *factor,
                _ => {}
            }
        }
        rest
    }
}

/// The options of maps, with the largest number of their values.
const OPTIONS: [(&str, usize); 13] = [
    ("s", 3),
    ("o", 3),
    ("t", 3),
    ("mm", 2),
    ("bm", 1),
    ("boost", 1),
    ("texres", 1),
    ("clamp", 1),
    ("blendu", 1),
    ("blendv", 1),
    ("cc", 1),
    ("imfchan", 1),
    ("type", 1),
];
