//! Files of all formats, changed at random and read by the importers of `rayline-simulator`.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use bumpalo::Bump;
use rayline::Scene;
use rayline_simulator::LoadedScene;
use tempfile::TempDir;

use crate::choices::Choices;
use crate::mutate;
use crate::scene_bytes::Corpus;

/// Formats of scenes, by the ends of their files' names.
const FORMATS: [&str; 5] = ["ron", "nff", "obj", "gltf", "rayline"];

/// Files that are longer would take too long.
const LONGEST: u64 = 20_000;

/// Seeds of every search, beside the files that it finds.
const OBJ: &str = include_str!("seeds/cube.obj");
const MTL: &str = include_str!("seeds/cube.mtl");
const GLTF: &str = include_str!("seeds/triangle.gltf");

/// Files that are changed, and a directory where the changed ones are read from.
pub(crate) struct Files {
    directory: TempDir,
    /// Texts of each format.
    texts: [Vec<Vec<u8>>; FORMATS.len()],
    materials: Vec<Vec<u8>>,
    /// The format and the text of this execution, and of the file of materials that it names.
    format: &'static str,
    text: Vec<u8>,
    material: Vec<u8>,
}

impl Files {
    /// The files of this repository.
    pub(crate) fn new() -> io::Result<Self> {
        let mut files = Self {
            directory: tempfile::Builder::new().prefix("rayline-fuzz-").tempdir()?,
            texts: Default::default(),
            materials: vec![MTL.into()],
            format: "",
            text: Vec::new(),
            material: Vec::new(),
        };
        let [_, _, obj, gltf, _] = &mut files.texts;
        obj.push(OBJ.into());
        gltf.push(GLTF.into());
        for directory in [gallery(), repository().join("tests/scenes")] {
            for path in sorted(&directory)? {
                files.add(&path)?;
            }
        }
        // Texts name these.
        for name in ["fish.png", "landscape.obj"] {
            fs::copy(gallery().join(name), files.directory.path().join(name))?;
        }
        Ok(files)
    }

    /// Adds a file, if it has a format of scenes or materials and is not long.
    pub(crate) fn add(&mut self, path: &Path) -> io::Result<()> {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let texts = match FORMATS.iter().zip(&mut self.texts).find(|(format, _)| **format == extension) {
            Some((_, texts)) => texts,
            None if extension == "mtl" => &mut self.materials,
            None => return Ok(()),
        };
        if path.metadata()?.len() <= LONGEST {
            texts.push(fs::read(path)?);
        }
        Ok(())
    }

    /// Adds the gallery's scenes to those whose bytes are changed, and those that once changed with
    /// acceleration.
    pub(crate) fn add_scenes_to(&self, corpus: &mut Corpus) -> io::Result<()> {
        let arena = Bump::new();
        for path in sorted(&repository().join("tests/scenes/acceleration"))? {
            if path.extension().is_some_and(|end| end == "rayline") {
                corpus.add_bytes(fs::read(path)?);
            }
        }
        for path in sorted(&gallery())?.iter().filter(|path| path.extension().is_some_and(|end| end == "ron"))
        {
            let loaded = LoadedScene::open(path, &arena).map_err(io::Error::other)?;
            corpus.add(&loaded.scene);
        }
        Ok(())
    }

    /// Chooses a file and changes it.
    pub(crate) fn change(&mut self, choices: &mut Choices<'_>) {
        // Bytes of scenes have a search of their own.
        let chosen = choices.one_of([0, 1, 2, 3, 2, 3, 0, 1]);
        let present = |texts: &Vec<_>| !texts.is_empty();
        let all = FORMATS.iter().zip(&self.texts).filter(|(_, texts)| present(texts));
        let Some((format, texts)) = all.clone().nth(chosen % all.count().max(1)) else { return };
        self.format = format;
        self.text.clear();
        self.text.extend_from_slice(texts.get(choices.below(texts.len())).map_or(&[][..], Vec::as_slice));
        self.material.clear();
        let material = self.materials.get(choices.below(self.materials.len()));
        self.material.extend_from_slice(material.map_or(&[][..], Vec::as_slice));
        if *format == "obj" && choices.chance(40) {
            mutate::text(choices, &mut self.material, &self.materials);
        } else if *format == "rayline" {
            mutate::bytes(choices, &mut self.text, texts);
        } else {
            mutate::text(choices, &mut self.text, texts);
        }
    }

    /// The files of this execution and their names; the scene is the first.
    pub(crate) fn files(&self) -> Vec<(String, Vec<u8>)> {
        vec![
            (format!("scene.{}", self.format), self.text.clone()),
            ("cube.mtl".to_owned(), self.material.clone()),
        ]
    }

    /// Reads what [`change`](Self::change) made; `None` where the importer refuses it, or the files cannot
    /// be written.
    pub(crate) fn read<'a>(&self, arena: &'a Bump) -> Option<Scene<'a>> {
        let path: PathBuf = self.directory.path().join("scene").with_extension(self.format);
        fs::write(&path, &self.text).ok()?;
        if self.format == "obj" {
            fs::write(self.directory.path().join("cube.mtl"), &self.material).ok()?;
        }
        match LoadedScene::open(&path, arena) {
            Ok(loaded) => Some(loaded.scene),
            // The text of an error must not panic either.
            Err(error) => {
                drop(error.to_string());
                None
            }
        }
    }
}

/// The root of the repository that this program was built in.
fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn gallery() -> PathBuf {
    repository().join("docs/gallery")
}

/// The files of a directory, in the order of their names: an execution must be the same on every machine.
fn sorted(directory: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths: Vec<_> = fs::read_dir(directory)?.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    Ok(paths)
}
