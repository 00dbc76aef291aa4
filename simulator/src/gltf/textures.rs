//! Pictures on surfaces (glTF 2.0 Specification, section 3.8).

use std::collections::HashMap;
use std::io::Cursor;
use std::rc::Rc;

use bumpalo::Bump;
use gltf_json::Index;
use gltf_json::texture::{Info, MagFilter, Sampler, Texture, WrappingMode};
use gltf_json::validation::Checked;
use image::{ImageReader, Limits, RgbaImage};
use rayline::{Encoding, Ends, Figure, Filter, Image, Pixels, Placed, Placement};

use super::accessor::Lists;
use super::error::{At, GltfFault, Wrong, find, name};
use super::notes::Notes;

/// The most pixels of all pictures together.
const MOST: usize = 1 << 26;

/// Which coordinates of vertices a texture lies by, and how it is moved, turned and stretched over these (`KHR_texture_transform`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Coordinates {
    pub(super) set: u32,
    offset: [f32; 2],
    /// Sine and cosine of the angle.
    turn: (f32, f32),
    scale: [f32; 2],
}

impl Coordinates {
    /// Those of a texture; where there is none, as they are.
    pub(super) fn of(info: Option<&Info>) -> Self {
        let set = info.map_or(0, |info| info.tex_coord);
        let as_is = Self { set, offset: [0.0; 2], turn: (0.0, 1.0), scale: [1.0; 2] };
        match info.and_then(|info| info.extensions.as_ref()?.texture_transform.as_ref()) {
            None => as_is,
            Some(transform) => Self {
                set: transform.tex_coord.unwrap_or(set),
                offset: transform.offset.0,
                turn: transform.rotation.0.sin_cos(),
                scale: transform.scale.0,
            },
        }
    }

    /// The place on the picture that coordinates of the file stand for, v upward as in the core: there it is downward.
    pub(super) fn upward(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let ([left, down], (sine, cosine)) = (self.offset, self.turn);
        let [u, v] = [u * self.scale[0], v * self.scale[1]];
        [u * cosine + v * sine + left, 1.0 - (v * cosine - u * sine + down)]
    }
}

/// A picture of the file, and what is seen beyond its edges and between its pixels.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    image: Rc<RgbaImage>,
    filter: Filter,
    ends: Ends,
}

/// The pictures of a file, read as they are asked for.
#[derive(Debug)]
pub(super) struct Textures<'a, 'f> {
    arena: &'a Bump,
    lists: Lists<'f>,
    read: HashMap<usize, Option<Rc<RgbaImage>>>,
    /// How many pixels may still come.
    room: usize,
}

impl<'a, 'f> Textures<'a, 'f> {
    pub(super) fn new(arena: &'a Bump, lists: Lists<'f>) -> Self {
        Self { arena, lists, read: HashMap::new(), room: MOST }
    }

    /// The picture of a texture; `None` where it cannot be read, which is noted.
    pub(super) fn picture(
        &mut self,
        texture: Index<Texture>,
        notes: &mut Notes,
    ) -> Result<Option<Picture>, Wrong> {
        let root = self.lists.root;
        let index = texture.value();
        let texture = find(&root.textures, "texture", index)?;
        let at = || name("texture", index, texture.name.as_ref());
        // Another format, by an extension, has no source of the plain kind.
        if texture.source.value() == u32::MAX as usize {
            notes.add(at(), "left out: it is of another format than PNG and JPEG");
            return Ok(None);
        }
        let image = match self.read.get(&texture.source.value()) {
            Some(image) => image.clone(),
            None => {
                let image = self.image(texture.source.value(), notes).at(at)?.map(Rc::new);
                self.read.insert(texture.source.value(), image.clone());
                image
            }
        };
        let sampler = match texture.sampler {
            Some(sampler) => Some(find(&root.samplers, "sampler", sampler.value()).at(at)?),
            None => None,
        };
        let ends = ends(sampler);
        if ends[0] != ends[1] {
            notes.add(at(), "beyond its upper and lower edge it goes on as beyond the others");
        }
        let filter = match sampler.and_then(|sampler| sampler.mag_filter) {
            Some(Checked::Valid(MagFilter::Nearest)) => Filter::Nearest,
            _ => Filter::Bilinear,
        };
        Ok(image.map(|image| Picture { image, filter, ends: ends[0] }))
    }

    fn image(&mut self, index: usize, notes: &mut Notes) -> Result<Option<RgbaImage>, Wrong> {
        let image = find(&self.lists.root.images, "image", index)?;
        let at = || name("image", index, image.name.as_ref());
        let buffers = self.lists.buffers;
        let bytes = match (&image.uri, image.buffer_view) {
            (Some(uri), _) => match buffers.resource(uri) {
                Err(GltfFault::Unreadable(reason)) => {
                    notes.add(at(), format!("left out: {reason}"));
                    return Ok(None);
                }
                bytes => bytes.at(at)?,
            },
            (None, Some(view)) => buffers.view(view).at(at)?.0.into(),
            (None, None) => return Err(GltfFault::NoBytes).at(at),
        };
        let mut limits = Limits::default();
        (limits.max_image_width, limits.max_image_height) = (Some(u16::MAX.into()), Some(u16::MAX.into()));
        limits.max_alloc = Some(8 * MOST as u64);
        let decoded = ImageReader::new(Cursor::new(&bytes)).with_guessed_format().map_err(Into::into);
        let decoded = decoded.and_then(|mut reader| {
            reader.limits(limits);
            reader.decode()
        });
        match decoded {
            Ok(image) => {
                self.take(image.width() as usize * image.height() as usize).at(at)?;
                Ok(Some(image.into_rgba8()))
            }
            Err(error) => {
                notes.add(at(), format!("left out: {error}"));
                Ok(None)
            }
        }
    }

    /// Makes sure that there are not too many pixels.
    fn take(&mut self, pixels: usize) -> Result<(), GltfFault> {
        let too_many = GltfFault::TooMany { what: "pixels of textures", most: MOST };
        self.room = self.room.checked_sub(pixels).ok_or(too_many)?;
        Ok(())
    }

    /// The picture in these shares of its light, as the core has it.
    pub(super) fn colored(&mut self, picture: &Picture, factor: [f32; 3]) -> Result<&'a Placed<'a>, Wrong> {
        self.take(picture.image.len() / 4)?;
        let tables = factor.map(Codes::new);
        let pixels = self.arena.alloc_slice_fill_iter(
            picture
                .image
                .pixels()
                .flat_map(|pixel| {
                    let [r, g, b, _] = pixel.0;
                    let [red, green, blue] = &tables;
                    [red.of(r), green.of(g), blue.of(b)]
                })
                .collect::<Vec<_>>(),
        );
        Ok(self.placed(picture, Pixels::Rgb888(pixels), Encoding::Srgb))
    }

    /// How opaque the picture is, and how clear, where an alpha of the file stands for `opacity`; `None`: it is opaque all over.
    pub(super) fn alpha(
        &mut self,
        picture: &Picture,
        opacity: impl Fn(f32) -> f32,
    ) -> Result<Option<[&'a Placed<'a>; 2]>, Wrong> {
        let levels: Vec<u8> = (0..=u8::MAX).map(|alpha| byte(opacity(f32::from(alpha) / 255.0))).collect();
        let level = |alpha: u8| levels.get(usize::from(alpha)).copied().unwrap_or(u8::MAX);
        if picture.image.pixels().all(|pixel| level(pixel.0[3]) == u8::MAX) {
            return Ok(None);
        }
        self.take(picture.image.len() / 4)?;
        let indices = self
            .arena
            .alloc_slice_fill_iter(picture.image.pixels().map(|pixel| pixel.0[3]).collect::<Vec<_>>());
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
            // Decoders were told not to make larger ones.
            width: picture.image.width() as u16,
            height: picture.image.height() as u16,
            pixels,
            encoding,
            filter: picture.filter,
            ends: picture.ends,
        };
        self.arena.alloc(Placed::new(Figure::Image(image), Placement::SURFACE))
    }
}

impl Picture {
    /// The mean of its light.
    pub(super) fn light(&self) -> [f32; 3] {
        self.mean(|code| light(code).into())
    }

    /// The mean of its numbers.
    pub(super) fn numbers(&self) -> [f32; 3] {
        self.mean(|code| f64::from(code) / 255.0)
    }

    fn mean(&self, number: impl Fn(u8) -> f64) -> [f32; 3] {
        let numbers: Vec<f64> = (0..=u8::MAX).map(number).collect();
        let mut sums = [0.0; 3];
        for pixel in self.image.pixels() {
            for (sum, code) in sums.iter_mut().zip(pixel.0) {
                *sum += numbers.get(usize::from(code)).copied().unwrap_or_default();
            }
        }
        let count = (self.image.len() / 4).max(1);
        sums.map(|sum| (sum / count as f64) as f32)
    }
}

/// For each code of sRGB that of a share of its light.
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

/// The light of a code of sRGB (IEC 61966-2-1).
fn light(code: u8) -> f32 {
    let code = f32::from(code) / 255.0;
    if code <= 0.040_45 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
}

fn code(light: f32) -> u8 {
    byte(if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 })
}

fn byte(share: f32) -> u8 {
    // The cast brings what is outside to the nearest.
    (share * 255.0).round() as u8
}

fn ends(sampler: Option<&Sampler>) -> [Ends; 2] {
    let Some(Sampler { wrap_s, wrap_t, .. }) = sampler else { return [Ends::Repeat; 2] };
    [wrap_s, wrap_t].map(|wrap| match wrap {
        Checked::Valid(WrappingMode::ClampToEdge) => Ends::Extend,
        Checked::Valid(WrappingMode::MirroredRepeat) => Ends::Mirror,
        _ => Ends::Repeat,
    })
}
