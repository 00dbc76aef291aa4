//! Textures and their images (glTF 2.0 Specification, section 3.8).

use std::collections::HashMap;
use std::rc::Rc;

use bumpalo::Bump;
use rayline::{Encoding, Ends, Figure, Filter, Image, Pixels, Placed, Placement};

use super::accessor::Lists;
use super::error::{At, GltfFault, Wrong, find, name};
use super::json::{Sampler, TextureInfo};
use crate::notes::Notes;
use crate::raster::Raster;

/// Numbers of OpenGL.
const NEAREST: u32 = 9728;
const CLAMP_TO_EDGE: u32 = 33071;
const MIRRORED_REPEAT: u32 = 33648;

/// The most pixels of all images together.
const MOST: usize = 1 << 26;

/// The set of texture coordinates that a texture uses, and their transform (`KHR_texture_transform`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Coordinates {
    pub(super) set: u32,
    offset: [f32; 2],
    /// The sine and cosine of the rotation.
    turn: (f32, f32),
    scale: [f32; 2],
}

impl Coordinates {
    /// The coordinates of a texture; set 0 without a transform for `None`.
    pub(super) fn of(info: Option<&TextureInfo>) -> Self {
        let set = info.map_or(0, |info| info.tex_coord);
        let as_is = Self { set, offset: [0.0; 2], turn: (0.0, 1.0), scale: [1.0; 2] };
        match info.and_then(|info| info.extensions.transform.as_ref()) {
            None => as_is,
            Some(transform) => Self {
                set: transform.tex_coord.unwrap_or(set),
                offset: transform.offset,
                turn: transform.rotation.sin_cos(),
                scale: transform.scale,
            },
        }
    }

    /// Transforms the coordinates of a vertex to those of the core, where v grows upward; in glTF it grows
    /// downward.
    pub(super) fn upward(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let ([left, down], (sine, cosine)) = (self.offset, self.turn);
        let [u, v] = [u * self.scale[0], v * self.scale[1]];
        [u * cosine + v * sine + left, 1.0 - (v * cosine - u * sine + down)]
    }
}

/// An image of the file with its filter and wrapping.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    image: Rc<Raster>,
    filter: Filter,
    ends: Ends,
}

/// The images of a file, read when a material needs them.
#[derive(Debug)]
pub(super) struct Textures<'a, 'f> {
    arena: &'a Bump,
    lists: Lists<'f>,
    read: HashMap<usize, Option<Rc<Raster>>>,
    /// The number of pixels that may still be read.
    room: usize,
}

impl<'a, 'f> Textures<'a, 'f> {
    pub(super) fn new(arena: &'a Bump, lists: Lists<'f>) -> Self {
        Self { arena, lists, read: HashMap::new(), room: MOST }
    }

    /// The image of a texture; `None` with a note if it cannot be read.
    pub(super) fn picture(&mut self, index: usize, notes: &mut Notes) -> Result<Option<Picture>, Wrong> {
        let root = self.lists.root;
        let texture = find(&root.textures, "texture", index)?;
        let at = || name("texture", index, texture.name.as_ref());
        // A texture in a format of an extension has no plain source.
        let Some(source) = texture.source else {
            notes.add(at(), "left out: its format is not PNG or JPEG");
            return Ok(None);
        };
        let image = match self.read.get(&source) {
            Some(image) => image.clone(),
            None => {
                let image = self.image(source, notes).at(at)?.map(Rc::new);
                self.read.insert(source, image.clone());
                image
            }
        };
        let sampler = match texture.sampler {
            Some(sampler) => Some(find(&root.samplers, "sampler", sampler).at(at)?),
            None => None,
        };
        let ends = ends(sampler);
        if ends[0] != ends[1] {
            notes.add(at(), "the wrapping of its left and right edges is used for all edges");
        }
        let filter = match sampler.and_then(|sampler| sampler.mag_filter) {
            Some(NEAREST) => Filter::Nearest,
            _ => Filter::Bilinear,
        };
        Ok(image.map(|image| Picture { image, filter, ends: ends[0] }))
    }

    /// The picture of an image; `None` with a note if it cannot be read.
    fn image(&mut self, index: usize, notes: &mut Notes) -> Result<Option<Raster>, Wrong> {
        let image = find(&self.lists.root.images, "image", index)?;
        let at = || name("image", index, image.name.as_ref());
        let buffers = self.lists.buffers;
        let bytes = match (&image.uri, image.buffer_view) {
            (Some(uri), _) => buffers.resource(uri).map_err(Wrong::from),
            (None, Some(view)) => buffers.view(view).map(|(bytes, _)| bytes.into()),
            (None, None) => Err(GltfFault::NoBytes.into()),
        };
        let decoded = bytes.map_err(|Wrong { fault, .. }| fault.to_string()).and_then(|bytes| {
            let picture = Raster::decode(&bytes);
            picture.map_err(|error| error.to_string())
        });
        match decoded {
            Ok(image) => {
                self.take(image.pixels.len()).at(at)?;
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
    pub(super) fn colored(&mut self, picture: &Picture, factor: [f32; 3]) -> Result<&'a Placed<'a>, Wrong> {
        self.take(picture.image.pixels.len())?;
        let tables = factor.map(Codes::new);
        let pixels = self.arena.alloc_slice_fill_iter(
            picture
                .image
                .pixels
                .iter()
                .flat_map(|[r, g, b, _]| {
                    let [red, green, blue] = &tables;
                    [red.of(*r), green.of(*g), blue.of(*b)]
                })
                .collect::<Vec<_>>(),
        );
        Ok(self.placed(picture, Pixels::Rgb888(pixels), Encoding::Srgb))
    }

    /// Two images for the core: the opacity of each pixel and 1 minus that, where `opacity` maps alpha to an
    /// opacity. `None` if the image is fully opaque.
    pub(super) fn alpha(
        &mut self,
        picture: &Picture,
        opacity: impl Fn(f32) -> f32,
    ) -> Result<Option<[&'a Placed<'a>; 2]>, Wrong> {
        let levels: Vec<u8> = (0..=u8::MAX).map(|alpha| byte(opacity(f32::from(alpha) / 255.0))).collect();
        let level = |alpha: u8| levels.get(usize::from(alpha)).copied().unwrap_or(u8::MAX);
        if picture.image.pixels.iter().all(|[.., alpha]| level(*alpha) == u8::MAX) {
            return Ok(None);
        }
        self.take(picture.image.pixels.len())?;
        let indices = self
            .arena
            .alloc_slice_fill_iter(picture.image.pixels.iter().map(|[.., alpha]| *alpha).collect::<Vec<_>>());
        let palettes = [
            self.arena.alloc_slice_fill_iter(levels.iter().map(|level| [*level; 3])),
            self.arena.alloc_slice_fill_iter(levels.iter().map(|level| [!*level; 3])),
        ];
        Ok(Some(
            palettes
                .map(|palette| self.placed(picture, Pixels::Palette8 { indices, palette }, Encoding::Linear)),
        ))
    }

    fn placed(&self, picture: &Picture, pixels: Pixels<'a>, encoding: Encoding) -> &'a Placed<'a> {
        let image = Image {
            // The limits of the decoder exclude larger images.
            width: picture.image.width as u16,
            height: picture.image.height as u16,
            pixels,
            encoding,
            filter: picture.filter,
            ends: picture.ends,
        };
        self.arena.alloc(Placed::new(Figure::Image(image), Placement::SURFACE))
    }
}

impl Picture {
    /// The mean of the pixels' linear light, in each channel.
    pub(super) fn light(&self) -> [f32; 3] {
        self.mean(|code| light(code).into())
    }

    /// The mean of the pixels' numbers, in each channel.
    pub(super) fn numbers(&self) -> [f32; 3] {
        self.mean(|code| f64::from(code) / 255.0)
    }

    fn mean(&self, number: impl Fn(u8) -> f64) -> [f32; 3] {
        let numbers: Vec<f64> = (0..=u8::MAX).map(number).collect();
        let mut sums = [0.0; 3];
        for pixel in &self.image.pixels {
            for (sum, code) in sums.iter_mut().zip(pixel) {
                *sum += numbers.get(usize::from(*code)).copied().unwrap_or_default();
            }
        }
        let count = (self.image.pixels.len()).max(1);
        sums.map(|sum| (sum / count as f64) as f32)
    }
}

/// A table from codes of sRGB to the codes of their light multiplied by a factor.
struct Codes(Vec<u8>);

impl Codes {
    fn new(factor: f32) -> Self {
        Self(
            (0..=u8::MAX)
                .map(|code| if factor < 1.0 { self::code(light(code) * factor) } else { code })
                .collect(),
        )
    }

    fn of(&self, code: u8) -> u8 {
        self.0.get(usize::from(code)).copied().unwrap_or(code)
    }
}

/// The linear light of a code of sRGB (IEC 61966-2-1).
fn light(code: u8) -> f32 {
    let code = f32::from(code) / 255.0;
    if code <= 0.040_45 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
}

fn code(light: f32) -> u8 {
    byte(if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 })
}

fn byte(share: f32) -> u8 {
    // The cast saturates.
    (share * 255.0).round() as u8
}

fn ends(sampler: Option<&Sampler>) -> [Ends; 2] {
    let Some(Sampler { wrap_s, wrap_t, .. }) = sampler else { return [Ends::Repeat; 2] };
    [*wrap_s, *wrap_t].map(|wrap| match wrap {
        CLAMP_TO_EDGE => Ends::Extend,
        MIRRORED_REPEAT => Ends::Mirror,
        _ => Ends::Repeat,
    })
}
