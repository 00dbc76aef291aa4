//! Textures as functions of a point, in POV-Ray's language.
//!
//! All figures are written as functions of x, y and z. The same code then serves patterns in space and on
//! surfaces, and edges lie where the core has them, at the floors of the same numbers.

use glam::DVec3;
use rayline::{
    Brick, Checker, Ends, Figure, Filter, Gradient, Image, LinearRgb, Panorama, Placed, Placement, Space,
    Squares, Stripes, Texture, Vec3,
};

use super::Lack;
use super::formula::{XYZ, fraction, globe, linear, parity};
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

/// The most entries of a map; POV-Ray's limit is 256.
const MOST_STOPS: usize = 200;

impl Pattern {
    /// The pattern of a texture.
    pub(super) fn of(texture: &Texture<'_>, coordinates: &Coordinates) -> Result<Self, Lack> {
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
                Self::figure(figure, placed(placement, coordinates)?)
            }
            _ => Err(Lack::New),
        }
    }

    /// The pattern of a panorama, as a function of the direction.
    pub(super) fn panorama(Panorama { image, rotation }: &Panorama<'_>) -> Self {
        let turn = space::rotation(*rotation);
        let [x, y, z] = turn.to_cols_array_2d().map(|axis| linear(axis.into(), 0.0, &XYZ));
        let [across, up] = globe([z, y, x]);
        Self::image(image, [across, up], [Ends::Repeat, Ends::Extend])
    }

    fn figure(figure: &Figure<'_>, [x, y, z]: [String; 3]) -> Result<Self, Lack> {
        Ok(match *figure {
            Figure::Squares(Squares { even, odd }) => Self::squares([x, y, z], even, odd),
            Figure::Stripes(Stripes { first, second, width }) => {
                Self::either(format!("select({} - {width}, 0, 1)", fraction(&x)), first, second)
            }
            Figure::Gradient(Gradient { from, to, ends }) => {
                let stops = vec![(0.0, Self::Color(from)), (1.0, Self::Color(to))];
                Self::Along { function: folded(&x, ends), stops }
            }
            Figure::Brick(Brick { brick, mortar, gap: [gap_x, gap_y] }) => {
                // Every second row is shifted by half a brick.
                let x = fraction(&format!("({x} + {}/2)", parity(&format!("floor({y})"))));
                let in_gap = |at: &str, gap: f32| format!("select({at} - {gap}, 0, 1)");
                let is_brick = format!("{} * {}", in_gap(&x, gap_x), in_gap(&fraction(&y), gap_y));
                Self::either(is_brick, mortar, brick)
            }
            Figure::Image(image) => Self::image(&image, [x, y], [image.ends; 2]),
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

    /// The pattern of an image whose width and height are 1.
    fn image(image: &Image<'_>, [x, y]: [String; 2], [across, up]: [Ends; 2]) -> Self {
        let (x, y) =
            (pixel(&x, image.width, image.filter, across), pixel(&y, image.height, image.filter, up));
        let is_blended = |ends| image.filter == Filter::Bilinear && ends == Ends::Repeat;
        let line = |line: u16| {
            let color = |column: u16| {
                let from_above = image.height.saturating_sub(1).saturating_sub(line);
                Self::Color(image.light(column, from_above))
            };
            Self::along(&x, row(image.width, is_blended(across), color))
        };
        Self::along(&y, row(image.height, is_blended(up), line))
    }

    /// A pattern with any number of stops, written as a map of maps if there are more than `MOST_STOPS`.
    fn along(function: &str, stops: Vec<(f64, Self)>) -> Self {
        if stops.len() <= MOST_STOPS {
            return Self::Along { function: function.to_owned(), stops };
        }
        // Each part begins at the last stop of the part before it.
        let starts = (0..stops.len() - 1).step_by(MOST_STOPS - 1);
        let parts = starts.flat_map(|start| {
            let part: Vec<_> = stops.iter().skip(start).take(MOST_STOPS).cloned().collect();
            let ends = [part.first(), part.last()].map(|end| end.map_or(0.0, |(at, _)| *at));
            let pattern = Self::Along { function: function.to_owned(), stops: part };
            ends.map(|at| (at, pattern.clone()))
        });
        Self::along(function, parts.collect())
    }

    /// Writes the pattern with maps of this name; `body` writes a color.
    pub(super) fn write(
        &self,
        map: &str,
        body: &dyn Fn(LinearRgb) -> Result<String, Lack>,
    ) -> Result<String, Lack> {
        match self {
            Self::Color(color) => body(*color),
            Self::Along { function, stops } => {
                let mut text = format!("function {{ {function} }} {map} {{");
                for (at, pattern) in stops {
                    text += &format!(" [{at} {}]", pattern.write(map, body)?);
                }
                Ok(text + " }")
            }
        }
    }
}

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
fn folded(at: &str, ends: Ends) -> String {
    match ends {
        Ends::Repeat => fraction(at),
        Ends::Mirror => format!("abs({at} - 2*floor(({at} + 1)/2))"),
        Ends::Extend => format!("min(max({at}, 0), 1)"),
    }
}

/// The formula of a pixel's number, divided by the number of pixels.
fn pixel(at: &str, count: u16, filter: Filter, ends: Ends) -> String {
    let (at, count) = (folded(at, ends), f64::from(count));
    let last = (count - 1.0) / count;
    match (filter, ends) {
        (Filter::Nearest, _) => format!("min(floor({at}*{count})/{count}, {last})"),
        // From center to center.
        (Filter::Bilinear, Ends::Repeat) => fraction(&format!("({at} - {})", 0.5 / count)),
        (Filter::Bilinear, _) => format!("min(max({at} - {}, 0), {last})", 0.5 / count),
    }
}

/// The stops of a row of `count` pixels. If the ends are blended, the first pixel is repeated at the end.
fn row(count: u16, is_blended: bool, what: impl Fn(u16) -> Pattern) -> Vec<(f64, Pattern)> {
    let stops = (0..count).map(|index| (f64::from(index) / f64::from(count), what(index)));
    stops.chain(is_blended.then(|| (1.0, what(0)))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayline::{Encoding, Noise, Pixels};

    const BLACK: LinearRgb = LinearRgb::gray(0.0);

    fn written(figure: Figure<'_>, placement: Placement) -> Result<String, Lack> {
        let placed = Placed::new(figure, placement);
        Pattern::of(&Texture::Placed(&placed), &Coordinates::SPACE)?
            .write("pigment_map", &|color| Ok(format!("{}", color.r)))
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

    #[test]
    fn wide_pictures_are_maps_of_maps() {
        let pixels: Vec<u8> = (0..500u16).flat_map(|gray| [(gray % 251) as u8; 3]).collect();
        let (width, height) = (500, 1);
        let (encoding, filter, ends) = (Encoding::Linear, Filter::Nearest, Ends::Repeat);
        let image = Image { width, height, pixels: Pixels::Rgb888(&pixels), encoding, filter, ends };
        let Pattern::Along { stops: lines, .. } =
            Pattern::image(&image, ["x", "y"].map(str::to_owned), [Ends::Repeat; 2])
        else {
            panic!("no lines")
        };
        let [(_, Pattern::Along { stops: parts, .. })] = lines.as_slice() else { panic!("{lines:?}") };
        let places: Vec<f64> = parts.iter().map(|(at, _)| (at * 500.0).round()).collect();
        assert_eq!(places, [0.0, 199.0, 199.0, 398.0, 398.0, 499.0]);
        for (column, gray) in [(0u16, 0.0), (199, 199.0), (398, 147.0), (499, 248.0)] {
            let at = f64::from(column) / 500.0;
            let part = parts.iter().rev().find(|(start, _)| *start <= at);
            let Some((_, Pattern::Along { stops, .. })) = part else { panic!("no part for {column}") };
            let Some((_, Pattern::Color(color))) = stops.iter().find(|(place, _)| *place == at) else {
                panic!("no pixel {column}")
            };
            assert!((color.r * 255.0 - gray).abs() < 0.01, "{column}: {}", color.r * 255.0);
        }
    }
}
