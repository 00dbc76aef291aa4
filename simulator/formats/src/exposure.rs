//! Exposure: one factor for all light of a scene, in stops.

use core::fmt;
use core::str::FromStr;

use bumpalo::Bump;
use rayline::limits::MAX_COORDINATE;
use rayline::{Background, Image, Lamp, Light, LinearRgb, Material, Optics, Panorama, Pixels, Scene, Sky};
use serde::{Deserialize, Serialize};

use crate::notes::Notes;
use crate::pictures;
use crate::srgb::Codes;

/// An exposure in stops, -20 to 20: each stop doubles all light of a scene.
///
/// This is the light of lamps, of surfaces that emit it, of the background, and ambient light. A color of
/// light ends at [`MAX_COORDINATE`], and the image of a panorama at white.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "f32", into = "f32")]
pub struct Exposure(f32);

/// The reason why a number is no exposure. Use a number of stops from -20 to 20.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExposureError;

impl Exposure {
    /// The most stops.
    pub const MOST: f32 = 20.0;

    /// The exposure of this number of stops.
    ///
    /// # Errors
    /// It is not from -20 to 20.
    pub fn new(stops: f32) -> Result<Self, ExposureError> {
        if stops.abs() <= Self::MOST { Ok(Self(stops)) } else { Err(ExposureError) }
    }

    /// The number of stops.
    pub const fn stops(self) -> f32 {
        self.0
    }

    /// The factor of all light.
    fn factor(self) -> f32 {
        f64::from(self.0).exp2() as f32
    }

    /// A color of light with this exposure. A channel of at most [`MAX_COORDINATE`] stays within this limit.
    /// A larger channel is multiplied without the limit: the core refuses it if it is still too large.
    pub fn of_color(self, color: LinearRgb) -> LinearRgb {
        let [r, g, b] = color.channels().map(|channel| {
            let light = channel * self.factor();
            if light > MAX_COORDINATE && channel <= MAX_COORDINATE { MAX_COORDINATE } else { light }
        });
        LinearRgb::new(r, g, b)
    }

    /// The scene with this exposure. New parts of it are kept in `arena`.
    pub fn of<'a>(self, scene: &Scene<'a>, arena: &'a Bump, notes: &mut Notes) -> Scene<'a> {
        if self.0 == 0.0 {
            return *scene;
        }
        let mut exposed = Exposed { exposure: self, arena, notes };
        Scene {
            background: exposed.background(scene.background),
            materials: exposed.materials(scene.materials),
            lights: exposed.lights(scene),
            ..*scene
        }
    }
}

impl TryFrom<f32> for Exposure {
    type Error = ExposureError;

    fn try_from(stops: f32) -> Result<Self, ExposureError> {
        Self::new(stops)
    }
}

impl From<Exposure> for f32 {
    fn from(exposure: Exposure) -> Self {
        exposure.0
    }
}

impl FromStr for Exposure {
    type Err = ExposureError;

    fn from_str(text: &str) -> Result<Self, ExposureError> {
        Self::new(text.parse().map_err(|_| ExposureError)?)
    }
}

impl fmt::Display for ExposureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let most = Exposure::MOST;
        write!(f, "an exposure is a number of stops from -{most} to {most}, such as 1.5; correct it")
    }
}

impl core::error::Error for ExposureError {}

/// The state for exposing the parts of a scene.
struct Exposed<'s, 'a> {
    exposure: Exposure,
    arena: &'a Bump,
    notes: &'s mut Notes,
}

impl<'a> Exposed<'_, 'a> {
    fn color(&mut self, color: LinearRgb) -> LinearRgb {
        let exposed = self.exposure.of_color(color);
        let is_ended = |(channel, light): (f32, f32)| light == MAX_COORDINATE && channel < MAX_COORDINATE;
        if color.channels().into_iter().zip(exposed.channels()).any(is_ended) {
            self.notes
                .add("exposure", format!("a color of light ends at {MAX_COORDINATE}, which is the limit"));
        }
        exposed
    }

    fn background(&mut self, background: Background<'a>) -> Background<'a> {
        match background {
            Background::Solid(color) => Background::Solid(self.color(color)),
            Background::Gradient(sky) => Background::Gradient(self.arena.alloc(Sky {
                up: sky.up,
                zenith: self.color(sky.zenith),
                horizon: self.color(sky.horizon),
                nadir: self.color(sky.nadir),
            })),
            Background::Image(panorama) => {
                let image = self.image(&panorama.image);
                Background::Image(self.arena.alloc(Panorama { image, ..*panorama }))
            }
            // The backgrounds of a later version of the core.
            other => other,
        }
    }

    fn image(&mut self, image: &Image<'a>) -> Image<'a> {
        let (arena, codes) = (self.arena, Codes::encoded(image.encoding, self.exposure.factor()));
        if self.exposure.0 > 0.0 {
            self.notes.add("exposure", "the panorama has no light above white, and ends there");
        }
        let palette_of = |palette: &[[u8; 3]]| {
            &*arena.alloc_slice_fill_iter(palette.iter().map(|color| color.map(|code| codes.of(code))))
        };
        let pixels = match image.pixels {
            Pixels::Palette8 { indices, palette } => {
                Pixels::Palette8 { indices, palette: palette_of(palette) }
            }
            Pixels::Palette4 { indices, palette } => {
                Pixels::Palette4 { indices, palette: palette_of(palette) }
            }
            Pixels::Rgb888(bytes) => {
                Pixels::Rgb888(arena.alloc_slice_fill_iter(bytes.iter().map(|code| codes.of(*code))))
            }
            Pixels::Rgb565(pixels) => {
                let bytes = pixels.iter().flat_map(|pixel| pictures::codes(*pixel));
                Pixels::Rgb888(arena.alloc_slice_copy(&bytes.map(|code| codes.of(code)).collect::<Vec<_>>()))
            }
        };
        Image { pixels, ..*image }
    }

    fn materials(&mut self, materials: &'a [Material<'a>]) -> &'a [Material<'a>] {
        let is_dark = |optics: &Optics| optics.emission == LinearRgb::BLACK;
        let exposed = self.arena.alloc_slice_copy(materials);
        for material in &mut *exposed {
            if let Some(optics) = material.optics.filter(|optics| !is_dark(optics)) {
                let emission = self.color(optics.emission);
                material.optics = Some(self.arena.alloc(Optics { emission, ..*optics }));
            }
        }
        exposed
    }

    fn lights(&mut self, scene: &Scene<'a>) -> &'a [Light] {
        let mut lights = scene.lights.to_vec();
        for light in &mut lights {
            match light {
                Light::Point { color, .. }
                | Light::Directional { color, .. }
                | Light::Ambient { color }
                | Light::Lamp(Lamp { color, .. }) => *color = self.color(*color),
                // The light of the object's material, and of the background.
                _ => {}
            }
        }
        // Without an ambient light, it is white.
        let is_ambient = |light: &Light| matches!(light, Light::Ambient { .. });
        if !lights.iter().any(is_ambient) && scene.materials.iter().any(|material| material.ambient > 0.0) {
            lights.push(Light::Ambient { color: self.color(LinearRgb::WHITE) });
        }
        self.arena.alloc_slice_copy(&lights)
    }
}
