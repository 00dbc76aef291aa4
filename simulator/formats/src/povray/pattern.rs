//! Textures as functions of a point, in POV-Ray's language.
//!
//! All figures are written as functions of x, y and z. The same code then serves patterns in space and on
//! surfaces, and edges lie where the core has them, at the floors of the same numbers. Images are functions
//! too, see `images`.

use glam::DVec3;
use rayline::{
    Brick, Checker, Ends, Figure, Gradient, LinearRgb, Panorama, Placed, Placement, Space, Squares, Stripes,
    Texture, Vec3,
};

use super::Lack;
use super::formula::{XYZ, fraction, globe, linear, parity};
use super::images::Images;
use crate::space::{self, vector};

/// A color that varies over a surface or in space.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Pattern {
    Color(LinearRgb),
    /// A function from 0 to 1, with patterns at some of its values; values between them blend two patterns.
    Along {
        function: String,
        stops: Vec<(f64, Pattern)>,
    },
    /// Functions from 0 to 1 for red, green and blue.
    Channels([String; 3]),
}

/// The coordinates that textures are functions of, as formulas.
#[derive(Clone, Debug)]
pub(super) struct Coordinates {
    /// The point in space; `None` for a mesh with UV mapping.
    pub(super) space: Option<[&'static str; 3]>,
    /// The texture coordinates u and v; `None` where they have no formula.
    pub(super) surface: Option<[String; 2]>,
}

impl Coordinates {
    /// The coordinates of a surface whose u and v have no formula.
    pub(super) const SPACE: Self = Self { space: Some(XYZ), surface: None };

    /// The coordinates of a mesh with UV mapping: POV-Ray passes u and v as x and y.
    pub(super) fn mapped() -> Self {
        Self { space: None, surface: Some(["x", "y"].map(str::to_owned)) }
    }

    pub(super) fn is_mapped(&self) -> bool {
        self.space.is_none()
    }
}

impl Pattern {
    /// The pattern of a texture.
    pub(super) fn of<'a>(
        texture: &Texture<'a>,
        coordinates: &Coordinates,
        images: &Images<'_, 'a>,
    ) -> Result<Self, Lack> {
        match *texture {
            Texture::Solid(color) => Ok(Self::Color(color)),
            Texture::Checker(Checker { even, odd, cells_per_unit }) => {
                let Vec3 { x, y, z } = cells_per_unit.to::<f64>();
                let point = coordinates.space.ok_or(Lack::Place)?;
                let axes = [(x, DVec3::X), (y, DVec3::Y), (z, DVec3::Z)];
                let axes = axes.iter().filter(|(cells, _)| *cells != 0.0);
                Ok(Self::squares(axes.map(|(cells, axis)| linear(axis * cells, 0.0, &point)), even, odd))
            }
            Texture::Placed(Placed { figure, placement }) => {
                Self::figure(figure, placed(placement, coordinates)?, images)
            }
            _ => Err(Lack::New),
        }
    }

    /// The pattern of a panorama, as a function of the direction.
    pub(super) fn panorama<'a>(
        Panorama { image, rotation }: &Panorama<'a>,
        images: &Images<'_, 'a>,
    ) -> Result<Self, Lack> {
        let turn = space::rotation(*rotation);
        let [x, y, z] = turn.to_cols_array_2d().map(|axis| linear(axis.into(), 0.0, &XYZ));
        let place = globe([z, y, x]);
        Ok(Self::Channels(images.channels(image, [Ends::Repeat, Ends::Extend], &place)?))
    }

    fn figure<'a>(
        figure: &Figure<'a>,
        [x, y, z]: [String; 3],
        images: &Images<'_, 'a>,
    ) -> Result<Self, Lack> {
        Ok(match *figure {
            Figure::Squares(Squares { even, odd }) => Self::squares([x, y, z], even, odd),
            Figure::Stripes(Stripes { first, second, width }) => {
                Self::either(format!("select({} - {width}, 0, 1)", fraction(&x)), first, second)
            }
            Figure::Gradient(Gradient { from, to, ends }) => {
                let stops = vec![(0.0, Self::Color(from)), (1.0, Self::Color(to))];
                Self::Along { function: folded(&x, ends.axes()[0]), stops }
            }
            Figure::Brick(Brick { brick, mortar, gap: [gap_x, gap_y] }) => {
                // Every second row is shifted by half a brick.
                let x = fraction(&format!("({x} + {}/2)", parity(&format!("floor({y})"))));
                let in_gap = |at: &str, gap: f32| format!("select({at} - {gap}, 0, 1)");
                let is_brick = format!("{} * {}", in_gap(&x, gap_x), in_gap(&fraction(&y), gap_y));
                Self::either(is_brick, mortar, brick)
            }
            Figure::Image(image) => Self::Channels(images.channels(&image, image.ends.axes(), &[x, y])?),
            Figure::Parts(_) | Figure::IrradianceVolume(_) => return Err(Lack::BakedLight),
            Figure::Noise(_) | Figure::Marble(_) | Figure::Wood(_) => return Err(Lack::Noise),
            _ => return Err(Lack::New),
        })
    }

    fn squares(cells: impl IntoIterator<Item = String>, even: LinearRgb, odd: LinearRgb) -> Self {
        // The offset keeps a surface along an edge, such as a floor at 0, on one side, however its points are
        // rounded.
        let floors: Vec<_> = cells.into_iter().map(|at| format!("floor({at} + 1e-6)")).collect();
        let sum = if floors.is_empty() { "0".to_owned() } else { floors.join(" + ") };
        Self::either(parity(&sum), even, odd)
    }

    /// The color `first` where a function is 0, and `second` where it is 1.
    fn either(function: String, first: LinearRgb, second: LinearRgb) -> Self {
        Self::Along { function, stops: vec![(0.0, Self::Color(first)), (1.0, Self::Color(second))] }
    }

    /// Writes the pattern with maps of this name; `body` writes a color.
    fn write(&self, map: &str, body: &dyn Fn(LinearRgb) -> Result<String, Lack>) -> Result<String, Lack> {
        match self {
            Self::Color(color) => body(*color),
            Self::Along { function, stops } => {
                let mut text = format!("function {{ {function} }} {map} {{");
                for (at, pattern) in stops {
                    text += &format!(" [{at} {}]", pattern.write(map, body)?);
                }
                Ok(text + " }")
            }
            // A blend by the share.
            Self::Channels([red, green, blue]) if map == TEXTURES => {
                let (none, full) = (body(LinearRgb::BLACK)?, body(LinearRgb::WHITE)?);
                let share = if red == green && green == blue {
                    red.clone()
                } else {
                    format!("0.25*{red} + 0.5*{green} + 0.25*{blue}")
                };
                Ok(format!("function {{ {share} }} {map} {{ [0 {none}] [1 {full}] }}"))
            }
            // The mean of three pigments, each with one channel.
            Self::Channels(functions) => {
                let channels = [(3.0, 0.0, 0.0), (0.0, 3.0, 0.0), (0.0, 0.0, 3.0)];
                let (none, mut text) = (body(LinearRgb::BLACK)?, format!("average {map} {{"));
                for (function, (r, g, b)) in functions.iter().zip(channels) {
                    let full = body(LinearRgb::new(r, g, b))?;
                    text += &format!(" [1 function {{ {function} }} {map} {{ [0 {none}] [1 {full}] }}]");
                }
                Ok(text + " }")
            }
        }
    }

    /// Writes the pattern as a pigment; `body` writes a color, and is linear in each channel.
    pub(super) fn pigment(&self, body: &dyn Fn(LinearRgb) -> Result<String, Lack>) -> Result<String, Lack> {
        self.write("pigment_map", body)
    }

    /// Writes textures that the pattern blends; `body` writes the texture for a share, and its light is
    /// linear in the share.
    pub(super) fn textures(&self, body: &dyn Fn(f32) -> Result<String, Lack>) -> Result<String, Lack> {
        self.write(TEXTURES, &|LinearRgb { r, g, b }| body(0.25 * r + 0.5 * g + 0.25 * b))
    }
}

const TEXTURES: &str = "texture_map";

/// Whether a texture lies on surfaces, by u and v.
pub(super) fn is_on_surface(texture: &Texture<'_>) -> bool {
    matches!(texture, Texture::Placed(placed) if placed.placement.space == Space::Surface)
}

/// The formulas for the coordinates of a placed pattern.
fn placed(placement: &Placement, coordinates: &Coordinates) -> Result<[String; 3], Lack> {
    let Placement { space, size, rotation, origin } = *placement;
    let place: Vec<&str> = match (space, coordinates) {
        (Space::Scene, Coordinates { space: Some(point), .. }) => point.to_vec(),
        (Space::Surface, Coordinates { surface: Some([u, v]), .. }) => vec![u, v],
        _ => return Err(Lack::Place),
    };
    let (origin, size) = (vector(origin), vector(size));
    let [x, y, z] = space::rotation(rotation).to_cols_array_2d().map(DVec3::from);
    Ok([x / size.x, y / size.y, z / size.z].map(|axis| linear(axis, -axis.dot(origin), &place)))
}

/// The formula that maps a coordinate to 0 to 1, by these ends.
pub(super) fn folded(at: &str, ends: Ends) -> String {
    match ends {
        Ends::Mirror => format!("abs({at} - 2*floor(({at} + 1)/2))"),
        Ends::Extend => format!("min(max({at}, 0), 1)"),
        _ => fraction(at),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::Pictures;
    use rayline::Noise;

    const BLACK: LinearRgb = LinearRgb::gray(0.0);

    fn written(figure: Figure<'_>, placement: Placement) -> Result<String, Lack> {
        let placed = Placed::new(figure, placement);
        let mut pictures = Pictures::beside(Path::new("no folder/scene.pov"));
        let images = Images::new(&mut pictures);
        Pattern::of(&Texture::Placed(&placed), &Coordinates::SPACE, &images)?
            .pigment(&|color| Ok(format!("{}", color.r)))
    }

    #[test]
    fn figures_in_space_are_functions() {
        let gradient = Gradient { from: BLACK, to: LinearRgb::WHITE, ends: Ends::Mirror };
        let placement = Placement::in_scene(0.5).at(Vec3::new(3.0, 1.0, 0.0));
        assert_eq!(
            written(Figure::Gradient(gradient), placement).unwrap(),
            "function { abs((x*2 + (-6)) - 2*floor(((x*2 + (-6)) + 1)/2)) } pigment_map { [0 0] [1 1] }"
        );
        let upward = Placement::in_scene(1.0).turned(Vec3::new(0.0, 0.0, core::f32::consts::FRAC_PI_2));
        let ends = Gradient { ends: Ends::Extend, ..gradient };
        let text = written(Figure::Gradient(ends), upward).unwrap();
        assert!(text.starts_with("function { min(max((x*(-0.000000043711"), "{text}");
        assert!(text.contains(" + y*0.99999"), "{text}");
        assert_eq!(written(Figure::Gradient(gradient), Placement::SURFACE), Err(Lack::Place));
        let noise = Figure::Noise(Noise { low: BLACK, high: LinearRgb::WHITE, octaves: 1 });
        assert_eq!(written(noise, placement), Err(Lack::Noise));
    }
}
