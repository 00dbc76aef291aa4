//! Scenes whose bytes were changed at random.

use core::mem::MaybeUninit;

use rayline::{Scene, builtin};

use crate::check::write_bytes;
use crate::choices::Choices;
use crate::mutate;

/// The bytes of the scenes that are changed.
#[derive(Debug, Default)]
pub(crate) struct Corpus {
    seeds: Vec<Vec<u8>>,
    /// The input of one execution.
    bytes: Vec<u8>,
    lists: Vec<MaybeUninit<u8>>,
}

/// Seeds that are longer would take too long.
const LONGEST: usize = 20_000;

impl Corpus {
    /// The built-in scenes.
    pub(crate) fn new() -> Self {
        let mut corpus = Self::default();
        for builtin in builtin::all() {
            corpus.add(builtin.scene);
        }
        corpus
    }

    /// Adds a scene, unless it is long.
    pub(crate) fn add(&mut self, scene: &Scene<'_>) {
        let mut bytes = Vec::new();
        if write_bytes(scene, &mut bytes).is_ok() {
            self.add_bytes(bytes);
        }
    }

    /// Adds the bytes of a scene, unless they are many.
    pub(crate) fn add_bytes(&mut self, bytes: Vec<u8>) {
        if bytes.len() <= LONGEST {
            self.seeds.push(bytes);
        }
    }

    /// Changes one of the seeds and reads it; `None` where it is no scene any more.
    pub(crate) fn scene(&mut self, choices: &mut Choices<'_>) -> Option<Scene<'_>> {
        let Self { seeds, bytes, lists } = self;
        bytes.clear();
        bytes.extend_from_slice(seeds.get(choices.below(seeds.len())).map_or(&[][..], Vec::as_slice));
        mutate::bytes(choices, bytes, seeds);
        read(bytes, lists)
    }
}

/// The scene that these bytes are, if they are one. It must have the same bytes again.
pub(crate) fn read<'a>(bytes: &'a [u8], lists: &'a mut Vec<MaybeUninit<u8>>) -> Option<Scene<'a>> {
    // A description is at most so many times as long as its bytes, or else it is refused.
    lists.resize(lists.len().max(bytes.len().saturating_mul(40).saturating_add(4096)), MaybeUninit::uninit());
    Scene::from_bytes(bytes, lists).ok()
}
