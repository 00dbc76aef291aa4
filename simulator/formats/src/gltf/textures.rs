//! Textures and their images (glTF 2.0 Specification, section 3.8).

use std::collections::HashMap;

use bumpalo::Bump;
use rayline::{Encoding, Ends, Figure, Filter, Image, Pixels, Placed, Placement, Vec3};

use super::accessor::Lists;
use super::error::{At, GltfFault, Wrong, find, name};
use super::json::{Root, Sampler, TextureInfo};
use crate::files::MAX_PIXELS;
use crate::model::FARTHEST_UV;
use crate::notes::Notes;
use crate::palette::{Colors, Compact};
use crate::srgb::{Codes, byte, light};

/// Numbers of OpenGL.
const NEAREST: u32 = 9728;
const CLAMP_TO_EDGE: u32 = 33071;
const MIRRORED_REPEAT: u32 = 33648;

/// The most pixels of all images together. An image counts once, and once more for each color by which it is
/// multiplied.
const MOST: usize = MAX_PIXELS;

/// The most times that texture coordinates are halved: a pattern is at least a millionth of a unit large.
pub(super) const MOST_HALVINGS: u8 = 19;

/// The set of texture coordinates that a texture uses, their transform (`KHR_texture_transform`), and the
/// lengths after which the texture repeats.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Coordinates {
    pub(super) set: u32,
    offset: [f32; 2],
    /// The sine and cosine of the rotation.
    turn: (f32, f32),
    scale: [f32; 2],
    /// `None` if there is no texture; the length is `None` along an axis without an end.
    periods: Option<[Option<f64>; 2]>,
}

impl Coordinates {
    /// The coordinates of a texture; set 0 without a transform for `None`.
    pub(super) fn of(root: &Root, info: Option<&TextureInfo>) -> Self {
        let set = info.map_or(0, |info| info.tex_coord);
        let texture = info.and_then(|info| root.textures.get(info.index));
        let sampler = texture.and_then(|texture| root.samplers.get(texture.sampler?));
        let periods = info.map(|_| {
            ends(sampler).axes().map(|ends| match ends {
                Ends::Extend => None,
                Ends::Mirror => Some(2.0),
                _ => Some(1.0),
            })
        });
        let as_is = Self { set, offset: [0.0; 2], turn: (0.0, 1.0), scale: [1.0; 2], periods };
        match info.and_then(|info| info.extensions.transform.as_ref()) {
            None => as_is,
            Some(transform) => Self {
                set: transform.tex_coord.unwrap_or(set),
                offset: transform.offset,
                turn: transform.rotation.sin_cos(),
                scale: transform.scale,
                periods,
            },
        }
    }

    /// Whether other coordinates are the same for each vertex.
    pub(super) fn are_those_of(&self, other: &Self) -> bool {
        Self { periods: None, ..*self } == Self { periods: None, ..*other }
    }

    /// Transforms the coordinates of a vertex to those of the core, where v grows upward; in glTF it grows
    /// downward.
    pub(super) fn upward(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let ([left, down], (sine, cosine)) = (self.offset, self.turn);
        let [u, v] = [u * self.scale[0], v * self.scale[1]];
        [u * cosine + v * sine + left, 1.0 - (v * cosine - u * sine + down)]
    }

    /// Brings coordinates into the range of fixed point: moves them by whole periods, and halves them until
    /// all are in it. The result is how many times they were halved; `None` if they are too far out, or not
    /// used.
    pub(super) fn reduce(&self, uvs: &mut [[f32; 2]]) -> Option<u8> {
        let farthest =
            |uvs: &[[f32; 2]]| uvs.as_flattened().iter().fold(0.0f32, |most, at| most.max(at.abs()));
        if !uvs.as_flattened().iter().all(|at| at.is_finite()) {
            return None;
        }
        if farthest(uvs) <= FARTHEST_UV {
            return Some(0);
        }
        for (axis, period) in self.periods?.into_iter().enumerate() {
            let Some(period) = period else { continue };
            let along = |uv: &[f32; 2]| uv.get(axis).copied().map(f64::from).unwrap_or_default();
            let least = uvs.iter().map(along).fold(f64::INFINITY, f64::min);
            let most = uvs.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
            let moved = ((least + most) * 0.5 / period).round() * period;
            for at in uvs.iter_mut().filter_map(|uv| uv.get_mut(axis)) {
                *at = (f64::from(*at) - moved) as f32;
            }
        }
        let needed = (farthest(uvs) / FARTHEST_UV).log2().ceil().max(0.0);
        let halvings = (needed <= f32::from(MOST_HALVINGS)).then_some(needed as u8)?;
        let share = 0.5f32.powi(halvings.into());
        uvs.as_flattened_mut().iter_mut().for_each(|at| *at *= share);
        Some(halvings)
    }

    /// Whether a texture uses the coordinates.
    pub(super) fn are_used(&self) -> bool {
        self.periods.is_some()
    }
}

/// An image of the file with its filter and wrapping.
#[derive(Clone, Copy, Debug)]
pub(super) struct Picture<'a> {
    /// The number of the image in the file.
    source: usize,
    image: Compact<'a>,
    filter: Filter,
    ends: Ends,
}

/// All that a colored picture depends on: the image, the factors, the filter and the wrapping, and how often
/// texture coordinates are halved.
type Tint = (usize, [u32; 3], bool, u8, u8);

/// The images of a file, read when a material needs them.
#[derive(Debug)]
pub(super) struct Textures<'a, 'f> {
    arena: &'a Bump,
    lists: Lists<'f>,
    read: HashMap<usize, Option<Compact<'a>>>,
    /// The colored pictures: materials share them.
    colored: HashMap<Tint, &'a Placed<'a>>,
    /// The number of pixels that may still be read.
    room: usize,
}

impl<'a, 'f> Textures<'a, 'f> {
    pub(super) fn new(arena: &'a Bump, lists: Lists<'f>) -> Self {
        Self { arena, lists, read: HashMap::new(), colored: HashMap::new(), room: MOST }
    }

    /// The image of a texture; `None` with a note if it cannot be read.
    pub(super) fn picture(&mut self, index: usize, notes: &mut Notes) -> Result<Option<Picture<'a>>, Wrong> {
        let root = self.lists.root;
        let texture = find(&root.textures, "texture", index)?;
        let at = || name("texture", index, texture.name.as_ref());
        // A texture in a format of an extension has no plain source.
        let Some(source) = texture.source else {
            notes.add(at(), "left out: its format is not PNG or JPEG");
            return Ok(None);
        };
        let image = match self.read.get(&source) {
            Some(image) => *image,
            None => {
                let image = self.image(source, notes).at(at)?;
                self.read.insert(source, image);
                image
            }
        };
        let sampler = match texture.sampler {
            Some(sampler) => Some(find(&root.samplers, "sampler", sampler).at(at)?),
            None => None,
        };
        let filter = match sampler.and_then(|sampler| sampler.mag_filter) {
            Some(NEAREST) => Filter::Nearest,
            _ => Filter::Bilinear,
        };
        Ok(image.map(|image| Picture { source, image, filter, ends: ends(sampler) }))
    }

    /// The picture of an image; `None` with a note if it cannot be read.
    fn image(&mut self, index: usize, notes: &mut Notes) -> Result<Option<Compact<'a>>, Wrong> {
        let image = find(&self.lists.root.images, "image", index)?;
        let at = || name("image", index, image.name.as_ref());
        let buffers = self.lists.buffers;
        let bytes = match (&image.uri, image.buffer_view) {
            (Some(uri), _) => buffers.resource(uri).map_err(Wrong::from),
            (None, Some(view)) => buffers.view(view).map(|(bytes, _)| bytes.into()),
            (None, None) => Err(GltfFault::NoBytes.into()),
        };
        let decoded = bytes.map_err(|Wrong { fault, .. }| fault.to_string()).and_then(|bytes| {
            let picture = Compact::decode(self.arena, &bytes);
            picture.map_err(|error| error.to_string())
        });
        match decoded {
            Ok(image) => {
                self.take(image.len()).at(at)?;
                Ok(Some(image))
            }
            Err(reason) => {
                notes.add(at(), format!("left out: {reason}"));
                Ok(None)
            }
        }
    }

    /// Counts pixels, and refuses too many.
    fn take(&mut self, pixels: usize) -> Result<(), GltfFault> {
        let too_many = GltfFault::TooMany { what: "pixels of textures", most: MOST };
        self.room = self.room.checked_sub(pixels).ok_or(too_many)?;
        Ok(())
    }

    /// The image for the core, with its linear light multiplied by `factor`.
    pub(super) fn colored(
        &mut self,
        picture: &Picture<'a>,
        factor: [f32; 3],
        halvings: u8,
    ) -> Result<&'a Placed<'a>, Wrong> {
        let Picture { source, filter, ends, .. } = *picture;
        let tint = (source, factor.map(f32::to_bits), filter == Filter::Nearest, ends as u8, halvings);
        if let Some(placed) = self.colored.get(&tint) {
            return Ok(placed);
        }
        let [red, green, blue] = factor.map(Codes::new);
        let multiplied = |r, g, b| [red.of(r), green.of(g), blue.of(b)];
        let pixels = match picture.image.colors {
            Colors::Few { indices, palette } => {
                let palette = palette.iter().map(|[r, g, b, _]| multiplied(*r, *g, *b));
                Pixels::Palette8 { indices, palette: self.arena.alloc_slice_fill_iter(palette) }
            }
            Colors::Many { rgb, .. } if factor.iter().all(|factor| *factor >= 1.0) => Pixels::Rgb888(rgb),
            Colors::Many { rgb, .. } => {
                self.take(picture.image.len())?;
                let copy = self.arena.alloc_slice_copy(rgb);
                for pixel in copy.as_chunks_mut::<3>().0 {
                    let [r, g, b] = *pixel;
                    *pixel = multiplied(r, g, b);
                }
                Pixels::Rgb888(copy)
            }
        };
        let placed = self.placed(picture, pixels, Encoding::Srgb, halvings);
        self.colored.insert(tint, placed);
        Ok(placed)
    }

    /// The image for the core as numbers that are no light.
    pub(super) fn numbers(&mut self, picture: &Picture<'a>, halvings: u8) -> Result<&'a Placed<'a>, Wrong> {
        let Placed { figure, placement } = *self.colored(picture, [1.0; 3], halvings)?;
        let figure = match figure {
            Figure::Image(image) => Figure::Image(Image { encoding: Encoding::Linear, ..image }),
            other => other,
        };
        Ok(self.arena.alloc(Placed::new(figure, placement)))
    }

    /// Images of gray levels for the core: `level` is the level of each color, and each palette has the grays
    /// of all levels.
    pub(super) fn grays<const N: usize>(
        &mut self,
        picture: &Picture<'a>,
        level: impl Fn([u8; 4]) -> u8,
        palettes: [[u8; 256]; N],
        halvings: u8,
    ) -> Result<[&'a Placed<'a>; N], Wrong> {
        let Compact { colors, .. } = picture.image;
        let (indices, names): (&'a [u8], Vec<u8>) = match colors {
            Colors::Few { indices, palette } => {
                (indices, palette.iter().map(|color| level(*color)).collect())
            }
            Colors::Many { .. } => {
                self.take(picture.image.len())?;
                let levels = self.arena.alloc_slice_fill_copy(picture.image.len(), 0);
                levels.iter_mut().zip(picture.image.pixels()).for_each(|(to, color)| *to = level(color));
                (levels, (0..=u8::MAX).collect())
            }
        };
        Ok(palettes.map(|grays| {
            let gray = |name: &u8| [grays.get(usize::from(*name)).copied().unwrap_or_default(); 3];
            let palette = self.arena.alloc_slice_fill_iter(names.iter().map(gray));
            self.placed(picture, Pixels::Palette8 { indices, palette }, Encoding::Linear, halvings)
        }))
    }

    /// Two images for the core: the opacity of each pixel and 1 minus that, where `opacity` maps alpha to an
    /// opacity. `None` if the image is fully opaque.
    pub(super) fn alpha(
        &mut self,
        picture: &Picture<'a>,
        opacity: impl Fn(f32) -> f32,
        halvings: u8,
    ) -> Result<Option<[&'a Placed<'a>; 2]>, Wrong> {
        let mut levels = [0u8; 256];
        for (level, alpha) in levels.iter_mut().zip(0..=u8::MAX) {
            *level = byte(opacity(f32::from(alpha) / 255.0));
        }
        let level = |[.., alpha]: [u8; 4]| levels.get(usize::from(alpha)).copied().unwrap_or(u8::MAX);
        let mut is_opaque = true;
        picture.image.each(|color, count| is_opaque &= count == 0 || level(color) == u8::MAX);
        if is_opaque {
            return Ok(None);
        }
        let mut grays = [[0u8; 256]; 2];
        for (index, shade) in (0..=u8::MAX).enumerate() {
            for (palette, gray) in grays.iter_mut().zip([shade, !shade]) {
                if let Some(place) = palette.get_mut(index) {
                    *place = gray;
                }
            }
        }
        self.grays(picture, level, grays, halvings).map(Some)
    }

    fn placed(
        &self,
        picture: &Picture<'a>,
        pixels: Pixels<'a>,
        encoding: Encoding,
        halvings: u8,
    ) -> &'a Placed<'a> {
        let Picture { image: Compact { width, height, .. }, filter, ends, .. } = *picture;
        let image = Image { width, height, pixels, encoding, filter, ends };
        let size = 0.5f32.powi(halvings.into());
        let placement = match halvings {
            0 => Placement::SURFACE,
            _ => Placement::SURFACE.stretched(Vec3::new(size, size, 1.0)),
        };
        self.arena.alloc(Placed::new(Figure::Image(image), placement))
    }
}

impl Picture<'_> {
    /// The picture without interpolation.
    pub(super) fn sharp(&self) -> Self {
        Self { filter: Filter::Nearest, ..*self }
    }

    /// All colors, each with the number of pixels that have it.
    pub(super) fn each(&self, visit: impl FnMut([u8; 4], usize)) {
        self.image.each(visit);
    }

    /// The mean of the pixels' linear light, in each channel.
    pub(super) fn light(&self) -> [f32; 3] {
        let [r, g, b, _] = self.mean(|code| light(code).into());
        [r, g, b]
    }

    /// The mean of the pixels' numbers, in each channel.
    pub(super) fn numbers(&self) -> [f32; 4] {
        self.mean(|code| f64::from(code) / 255.0)
    }

    fn mean(&self, number: impl Fn(u8) -> f64) -> [f32; 4] {
        let numbers: Vec<f64> = (0..=u8::MAX).map(number).collect();
        let (mut sums, mut all) = ([0.0; 4], 0.0);
        self.each(|color, count| {
            let count = count as f64;
            all += count;
            for (sum, code) in sums.iter_mut().zip(color) {
                *sum += count * numbers.get(usize::from(code)).copied().unwrap_or_default();
            }
        });
        sums.map(|sum| if all > 0.0 { (sum / all) as f32 } else { 0.0 })
    }
}

fn ends(sampler: Option<&Sampler>) -> Ends {
    let Some(Sampler { wrap_s, wrap_t, .. }) = sampler else { return Ends::Repeat };
    Ends::of_axes([*wrap_s, *wrap_t].map(|wrap| match wrap {
        CLAMP_TO_EDGE => Ends::Extend,
        MIRRORED_REPEAT => Ends::Mirror,
        _ => Ends::Repeat,
    }))
}
