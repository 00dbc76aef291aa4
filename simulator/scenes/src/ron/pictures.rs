//! Names of picture files in place of pixels, in the text of a scene.
//!
//! The scene is written with short marks in place of its pixels, and these are then replaced by names.

use std::io;

use bumpalo::Bump;
use rayline::{
    Background, Encoding, Ends, Figure, Filter, Image, Map, Material, Panorama, Pixels, Placed, Scene,
    Texture,
};
use rayline_formats::Pictures;

/// The images of a scene that are replaced by marks.
pub(super) struct Marked<'p, 'a> {
    arena: &'a Bump,
    pictures: &'p mut Pictures<'a>,
    /// The names of the files, and whether no other field than the name is needed.
    names: Vec<(String, bool)>,
}

/// The mark of an image, as it stands in the text.
fn mark(number: usize) -> String {
    format!("picture {number}")
}

impl<'p, 'a> Marked<'p, 'a> {
    pub(super) fn new(arena: &'a Bump, pictures: &'p mut Pictures<'a>) -> Self {
        Self { arena, pictures, names: Vec::new() }
    }

    /// The scene with marks in place of the pixels of its images.
    pub(super) fn scene(&mut self, scene: &Scene<'a>) -> io::Result<Scene<'a>> {
        let background = match scene.background {
            Background::Image(panorama) => {
                let image = self.image(&panorama.image)?;
                Background::Image(self.arena.alloc(Panorama { image, ..*panorama }))
            }
            other => other,
        };
        let materials = scene.materials.iter().map(|material| self.material(material));
        let materials = materials.collect::<io::Result<Vec<_>>>()?;
        Ok(Scene { background, materials: self.arena.alloc_slice_copy(&materials), ..*scene })
    }

    fn material(&mut self, material: &Material<'a>) -> io::Result<Material<'a>> {
        let color = self.texture(material.color)?;
        let map = |map: &Map<'a>| Ok(Map { texture: self.texture(map.texture)?, ..*map });
        let maps = material.maps.iter().map(map).collect::<io::Result<Vec<_>>>()?;
        Ok(Material { color, maps: self.arena.alloc_slice_copy(&maps), ..*material })
    }

    fn texture(&mut self, texture: Texture<'a>) -> io::Result<Texture<'a>> {
        Ok(match texture {
            Texture::Placed(&Placed { figure: Figure::Image(image), placement }) => {
                let figure = Figure::Image(self.image(&image)?);
                Texture::Placed(self.arena.alloc(Placed::new(figure, placement)))
            }
            Texture::Placed(&Placed { figure: Figure::Parts(images), placement }) => {
                let images = images.iter().map(|image| self.image(image)).collect::<io::Result<Vec<_>>>()?;
                let figure = Figure::Parts(self.arena.alloc_slice_copy(&images));
                Texture::Placed(self.arena.alloc(Placed::new(figure, placement)))
            }
            other => other,
        })
    }

    fn image(&mut self, image: &Image<'a>) -> io::Result<Image<'a>> {
        let name = self.pictures.name_of(image)?;
        let is_usual = matches!(
            image,
            Image { encoding: Encoding::Srgb, filter: Filter::Bilinear, ends: Ends::Repeat, .. }
        );
        let mark = self.arena.alloc_str(&mark(self.names.len())).as_bytes();
        self.names.push((name, is_usual));
        Ok(Image { pixels: Pixels::Rgb888(mark), ..*image })
    }

    /// The text of the scene with names in place of the marks.
    pub(super) fn name(self, text: &str) -> String {
        let mut named = String::new();
        let mut rest = text;
        // The marks stand in the text in another order than the images were found.
        while let Some((before, number, after)) = split_at_mark(rest) {
            let Some((name, is_usual)) = self.names.get(number) else { break };
            // The image begins with its width and height.
            let (start, _) = before.rsplit_once("width:").unwrap_or((before, ""));
            if *is_usual {
                let end = after.find(')').unwrap_or(0);
                let start = start.trim_end();
                // The parentheses of an enum's variant stay, those of a struct do not.
                let outside = start.strip_suffix('(').unwrap_or(start);
                let is_variant = outside.ends_with(|letter: char| letter.is_alphanumeric());
                named += if is_variant { start } else { outside };
                named += &format!("\"{name}\"");
                rest = after.get(if is_variant { end } else { end.saturating_add(1) }..).unwrap_or("");
            } else {
                named += &format!("{start}file: \"{name}\"");
                rest = after;
            }
        }
        named + rest
    }
}

/// The text before the first mark's pixels, the number of the mark, and the text behind the pixels.
fn split_at_mark(text: &str) -> Option<(&str, usize, &str)> {
    let (before, rest) = text.split_once(&format!("pixels: Rgb888(b\"{}", mark(0).trim_end_matches('0')))?;
    let (number, after) = rest.split_once("\")")?;
    Some((before, number.parse().ok()?, after))
}
