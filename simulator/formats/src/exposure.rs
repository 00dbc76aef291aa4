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

    /// A color of light with this exposure. What the core refuses stays beyond its limits.
    pub(crate) fn of_color(self, color: LinearRgb) -> LinearRgb {
        let [r, g, b] = color.channels().map(|channel| {
            let light = channel * self.factor();
            if light > MAX_COORDINATE && channel <= MAX_COORDINATE { MAX_COORDINATE } else { light }
        });
        LinearRgb::new(r, g, b)
    }

    /// The scene with this exposure. New parts of it are kept in `arena`.
    pub(crate) fn of<'a>(self, scene: &Scene<'a>, arena: &'a Bump, notes: &mut Notes) -> Scene<'a> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LoadedScene;

    /// A scene with light of each kind, as RON.
    fn text(settings: &str, background: &str, lights: &str) -> String {
        format!(
            "Scene(
            camera: (eye: (0, 0, 6), target: (0, 0, 0), up: (0, 1, 0), vertical_fov: 0.7),
            background: {background},
            materials: [(optics: (emission: (0.5, 0, 3))), (ambient: 0.5), (color: Solid(0.5, 0.5, 0.5))],
            objects: [(shape: Sphere(center: (1, 0, 0), radius: 1), material: 0)],
            lights: [{lights}],
            settings: ({settings}),
            )"
        )
    }

    /// Opens a scene, and gives it and its notes to a function.
    fn opened<T>(text: &str, then: impl FnOnce(Result<LoadedScene<'_>, String>) -> T) -> T {
        let (folder, arena) = (tempfile::tempdir().unwrap(), Bump::new());
        let path = folder.path().join("scene.ron");
        std::fs::write(&path, text).unwrap();
        let name = path.display().to_string();
        let scene =
            LoadedScene::open(&path, &arena).map_err(|error| error.to_string().replace(&name, "scene"));
        then(scene.map(|mut scene| {
            scene.notes.iter_mut().for_each(|note| *note = note.replace(&name, "scene"));
            scene
        }))
    }

    const LIGHTS: &str = "Point(position: (0, 1, 0), color: (1, 2, 3)), Object(0),
        Directional(direction: (0, -1, 0), color: (0.25, 0.5, 1)),
        Lamp(position: (0, 3, 0), color: (8, 0, 4), falloff: (quadratic: 0.5))";

    #[test]
    fn each_light_is_multiplied() {
        let sky = "Gradient(zenith: (0.1, 0.2, 0.4), horizon: (1, 2, 3), nadir: (0, 0, 5))";
        opened(&text("exposure: 2", sky, LIGHTS), |scene| {
            let scene = scene.unwrap();
            assert!(scene.notes.is_empty(), "{:?}", scene.notes);
            let Background::Gradient(sky) = scene.scene.background else { panic!() };
            let colors = [sky.zenith, sky.horizon, sky.nadir].map(LinearRgb::channels);
            assert_eq!(colors, [[0.4, 0.8, 1.6], [4.0, 8.0, 12.0], [0.0, 0.0, 20.0]]);
            let colors = scene.scene.lights.iter().map(|light| match *light {
                Light::Point { color, .. } => color.channels(),
                Light::Directional { color, .. } => color.channels(),
                Light::Ambient { color } => color.channels(),
                Light::Lamp(Lamp { color, falloff, .. }) => {
                    assert_eq!(falloff.quadratic, 0.5);
                    color.channels()
                }
                _ => [0.0; 3],
            });
            // The white ambient light of the scene, which has none of its own, is the last.
            let expected = [[4.0, 8.0, 12.0], [0.0; 3], [1.0, 2.0, 4.0], [32.0, 0.0, 16.0], [4.0, 4.0, 4.0]];
            assert_eq!(colors.collect::<Vec<_>>(), expected);
            let [glowing, ambient, plain] = scene.scene.materials else { panic!() };
            assert_eq!(glowing.optics.unwrap().emission, LinearRgb::new(2.0, 0.0, 12.0));
            // Coefficients are no light.
            assert_eq!((ambient.ambient, plain.optics), (0.5, None));
        });
        opened(&text("exposure: -1", "Solid(1, 3, 0)", "Ambient(color: (1, 2, 0))"), |scene| {
            let scene = scene.unwrap().scene;
            assert_eq!(scene.background, Background::Solid(LinearRgb::new(0.5, 1.5, 0.0)));
            assert_eq!(scene.lights, [Light::Ambient { color: LinearRgb::new(0.5, 1.0, 0.0) }]);
        });
    }

    #[test]
    fn light_ends_at_the_limit_with_a_note() {
        opened(&text("exposure: 20", "Solid(0.5, 0, 2)", "Ambient(color: (0, 1, 0.25))"), |scene| {
            let scene = scene.unwrap();
            assert_eq!(scene.scene.background, Background::Solid(LinearRgb::new(524_288.0, 0.0, 1e6)));
            let ambient = Light::Ambient { color: LinearRgb::new(0.0, 1e6, 262_144.0) };
            assert_eq!(scene.scene.lights, [ambient]);
            let told = "scene: exposure: a color of light ends at 1000000, which is the limit";
            assert_eq!(scene.notes, [told]);
            assert!(crate::check(&scene.scene).is_ok());
        });
        // A scene that is refused without an exposure is refused with one.
        for color in ["-1", "2e6", "NaN"] {
            opened(&text("exposure: -9", &format!("Solid(0, {color}, 0)"), ""), |scene| {
                assert!(crate::check(&scene.unwrap().scene).is_err() == (color != "2e6"), "{color}");
            });
        }
    }

    /// Code 128 of sRGB is light of 0.2159; half of it is code 92.
    #[test]
    fn panoramas_are_multiplied_up_to_white() {
        let codes = |stops: i32, pixels: &str, encoding: &str| {
            let image = format!("(width: 2, height: 1, pixels: {pixels}, encoding: {encoding})");
            let scene = text(&format!("exposure: {stops}"), &format!("Image(image: {image})"), "");
            opened(&scene, |scene| {
                let scene = scene.unwrap();
                let Background::Image(panorama) = scene.scene.background else { panic!() };
                let codes = match panorama.image.pixels {
                    Pixels::Rgb888(bytes) => bytes.to_vec(),
                    Pixels::Palette8 { palette, .. } | Pixels::Palette4 { palette, .. } => palette.concat(),
                    Pixels::Rgb565(_) => panic!(),
                };
                (codes, scene.notes)
            })
        };
        let told = "scene: exposure: the panorama has no light above white, and ends there".to_owned();
        let rgb = "Rgb888([128, 0, 255, 10, 128, 1])";
        assert_eq!(codes(-1, rgb, "Srgb"), (vec![92, 0, 188, 5, 92, 1], vec![]));
        assert_eq!(codes(-1, rgb, "Linear"), (vec![64, 0, 128, 5, 64, 1], vec![]));
        assert_eq!(codes(1, rgb, "Linear"), (vec![255, 0, 255, 20, 255, 2], vec![told.clone()]));
        let palette = "Palette8(indices: [0, 1], palette: [(128, 0, 255), (10, 0, 0)])";
        assert_eq!(codes(-1, palette, "Srgb").0, [92, 0, 188, 5, 0, 0]);
        let small = "Palette4(indices: [1], palette: [(128, 0, 255), (10, 0, 0)])";
        assert_eq!(codes(-1, small, "Srgb").0, [92, 0, 188, 5, 0, 0]);
        // 31, 0, 0 and 0, 32, 16 of 31 and 63.
        assert_eq!(codes(-1, "Rgb565([63488, 1040])", "Linear").0, [128, 0, 0, 0, 65, 66]);
    }

    #[test]
    fn other_numbers_of_stops_are_refused() {
        for stops in ["20.1", "-21", "NaN", "inf"] {
            let said = opened(&text(&format!("exposure: {stops}"), "Solid(0, 0, 0)", ""), |scene| {
                scene.unwrap_err()
            });
            let limit = "an exposure is a number of stops from -20 to 20, such as 1.5; correct it";
            assert!(said.starts_with("scene:7:") && said.ends_with(limit), "{said}");
            assert_eq!(stops.parse::<Exposure>(), Err(ExposureError));
        }
        for stops in ["20", "-20", "0.5"] {
            assert_eq!(stops.parse::<Exposure>().map(Exposure::stops).ok(), stops.parse().ok());
        }
        assert_eq!("x".parse::<Exposure>(), Err(ExposureError));
    }
}
