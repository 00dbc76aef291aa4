//! A report of the rays, hits and lights of one pixel, for people to read.

use core::fmt::{self, Write};

use rayline::math::{Fixed, Ray};
use rayline::shape::Shape;
use rayline::{Cut, Event, Hit, LinearRgb, PreparedScene, Probe, RayKind, Real, Renderer, Vec3};

use crate::picture::memory_for;
use crate::{LoadedScene, Number, RenderError, RenderOptions, render};

/// The reason why there is no report.
#[derive(Debug)]
#[non_exhaustive]
pub enum ReportError {
    /// The pixel is outside the picture. Choose one inside.
    Outside {
        /// Its column and line.
        pixel: (i64, i64),
        /// The width and height of the picture, in pixels.
        size: (u32, u32),
    },
    /// The scene cannot be rendered.
    Render(RenderError),
}

/// Describes how the color of a pixel, given by its column and line, comes about: each ray, its hit, the
/// lights at the hit, and the final color. The rays that start at a hit are indented below it. The amounts
/// "to the pixel" add up to the light of the pixel, in each channel.
///
/// # Errors
/// The pixel is outside the picture, or the scene cannot be rendered.
pub fn report_pixel(
    scene: &LoadedScene<'_>,
    options: &RenderOptions,
    pixel: (i64, i64),
) -> Result<String, ReportError> {
    match options.number {
        Number::F32 => report_in::<f32>(scene, options, pixel),
        Number::Fixed => report_in::<Fixed>(scene, options, pixel),
        Number::F64 => report_in::<f64>(scene, options, pixel),
    }
}

fn report_in<R: Real>(
    loaded: &LoadedScene<'_>,
    options: &RenderOptions,
    pixel: (i64, i64),
) -> Result<String, ReportError> {
    let mut memory = memory_for::<R>(&loaded.scene);
    let prepared = PreparedScene::<R, _>::new(&loaded.scene, &mut memory).map_err(RenderError::Scene)?;
    let renderer = Renderer::new(&prepared, options.settings).map_err(RenderError::Settings)?;
    let size = (renderer.width(), renderer.height());
    let outside = ReportError::Outside { pixel, size };
    let (Ok(x), Ok(y)) = (u16::try_from(pixel.0), u16::try_from(pixel.1)) else { return Err(outside) };
    if u32::from(x) >= size.0 || u32::from(y) >= size.1 {
        return Err(outside);
    }

    let heading =
        format!("pixel ({x}, {y}) of {}x{}, scene {}, in {}\n", size.0, size.1, loaded.name, options.number);
    let mut tree = Tree {
        loaded,
        text: heading,
        depth: 0,
        samples: 0,
        direction: None,
        share: LinearRgb::BLACK,
        sample_share: 1.0 / f32::from(options.settings.sampling.samples),
        unit: 1.0 / prepared.scale(),
    };
    let (light, rays) = renderer.pixel(x, y, &mut (&mut tree as &mut dyn Probe<R>));
    let mut text = tree.text;

    // Compute the displayed color by the same code as for a picture.
    let line = Some(u32::from(y)..u32::from(y) + 1);
    let line = render(&loaded.scene, &RenderOptions { lines: line, ..options.clone() })?;
    let shown: String =
        line.rgb.iter().skip(usize::from(x) * 3).take(3).map(|level| format!("{level:02x}")).collect();
    let plural = if rays == 1 { "" } else { "s" };
    // Writing into a string cannot fail.
    let _ = writeln!(
        text,
        "light {} after {rays} ray{plural}, shown as #{shown} in {}",
        color(light.to_f32()),
        options.display
    );
    Ok(text)
}

/// The probe that writes the report, each ray indented by its number of bounces.
struct Tree<'s> {
    loaded: &'s LoadedScene<'s>,
    text: String,
    depth: usize,
    samples: u32,
    /// The direction of the last ray.
    direction: Option<Vec3>,
    /// The share of the light along the last ray that reaches the pixel.
    share: LinearRgb,
    /// The share of one sample in the pixel.
    sample_share: f32,
    /// The kernel's unit of length, in units of the scene.
    unit: f32,
}

impl Tree<'_> {
    fn line(&mut self, depth: usize, line: fmt::Arguments<'_>) {
        // Writing into a string cannot fail.
        let _ = writeln!(self.text, "{:1$}{line}", "", depth * 2);
    }

    /// Sets the share of the light along the last ray that reaches the pixel.
    fn end<R: Real>(&mut self, throughput: LinearRgb<R>) {
        self.share = throughput.to_f32() * self.sample_share;
    }

    /// The text for the contribution of light along the last ray to the pixel.
    fn part(&self, light: LinearRgb) -> String {
        format!("to the pixel {}", color(light * self.share))
    }

    fn ray<R: Real>(&mut self, kind: RayKind, ray: Ray<R>, bounces: u8, throughput: R) {
        let name = match kind {
            RayKind::Camera => "camera",
            RayKind::Reflected => "reflected",
            RayKind::Refracted => "refracted",
            RayKind::Scattered => "scattered",
        };
        if kind == RayKind::Camera {
            self.samples += 1;
            if self.samples > 1 {
                self.line(0, format_args!(""));
            }
        }
        self.depth = usize::from(bounces);
        let direction = ray.direction.to_f32();
        self.direction = Some(direction);
        let (origin, toward, share) =
            (vector(ray.origin.to_f32() * self.unit), vector(direction), number(throughput.to_f32()));
        self.line(self.depth, format_args!("{name} ray from {origin} toward {toward}, share {share}"));
    }

    fn hit<R: Real>(&mut self, hit: &Hit<R>, surface_color: LinearRgb<R>) {
        let (point, normal) = (hit.surface.point.to_f32() * self.unit, hit.surface.normal.to_f32());
        let behind = self.direction.is_some_and(|direction| direction.dot(normal) > 0.0);
        let side = if behind { "back" } else { "front" };
        let object = self.object(hit.object);
        let (distance, point, normal) = (number(hit.t.to_f32() * self.unit), vector(point), vector(normal));
        let surface_color = color(surface_color.to_f32());
        self.line(
            self.depth + 1,
            format_args!(
                "hits the {side} of {object} at {point}, distance {distance}, normal {normal}, color \
                 {surface_color}"
            ),
        );
    }

    fn object(&self, index: usize) -> String {
        let Some(object) = self.loaded.scene.objects.get(index) else { return format!("object {index}") };
        let kind = match object.shape {
            Shape::Sphere(_) => "sphere",
            Shape::Plane(_) => "plane",
            Shape::Disc(_) => "disc",
            Shape::Rectangle(_) => "rectangle",
            Shape::Triangle(_) => "triangle",
            Shape::Polygon(_) => "polygon",
            Shape::Cylinder(_) => "cylinder",
            Shape::Cone(_) => "cone",
            Shape::Ellipsoid(_) => "ellipsoid",
            Shape::Quadric(_) => "quadric",
            Shape::Torus(_) => "torus",
            Shape::Cuboid(_) => "box",
            Shape::ConvexPolyhedron(_) => "polyhedron",
            Shape::Mesh(_) => "mesh",
            Shape::Csg(_) => "solid",
            Shape::Metaballs(_) => "metaballs",
            Shape::Instances(_) => "instances",
        };
        let line = self.loaded.line_of_object(index).map(|line| format!(", line {line}")).unwrap_or_default();
        format!("object {index} ({kind}, material {}{line})", object.material.0)
    }

    fn cut(&mut self, cut: Cut) {
        let reason = match cut {
            Cut::Bounces => "a ray is left out: the limit of bounces is reached",
            Cut::Throughput => "a ray is left out: its share would be below the cut-off",
            Cut::Rays => "all further rays are left out: the limit of rays per pixel is reached",
            Cut::ShadowLayers => "a light is left out: too many transparent surfaces in front of it",
        };
        self.line(self.depth + 1, format_args!("{reason}"));
    }
}

impl<R: Real> Probe<R> for Tree<'_> {
    fn record(&mut self, event: Event<R>) {
        match event {
            Event::Ray { kind, ray, bounces, throughput } => self.ray(kind, ray, bounces, throughput),
            Event::Hit { hit, color, throughput, .. } => {
                self.end(throughput);
                self.hit(&hit, color);
            }
            Event::Miss { color: background, throughput, .. } => {
                self.end(throughput);
                let background = background.to_f32();
                let (background, part) = (color(background), self.part(background));
                self.line(
                    self.depth + 1,
                    format_args!("hits nothing; the background is {background}, {part}"),
                );
            }
            // Most surfaces have neither ambient light nor emission.
            Event::Surface { shown } if shown == LinearRgb::BLACK => {}
            Event::Surface { shown } => {
                let shown = shown.to_f32();
                let (shown, part) = (color(shown), self.part(shown));
                self.line(self.depth + 1, format_args!("ambient light and emission: adds {shown}, {part}"));
            }
            Event::Light { light, toward, through, shown } => {
                let (toward, through) = (vector(toward.to_f32()), number(through.to_f32() * 100.0));
                let shown = shown.to_f32();
                let (shown, part) = (color(shown), self.part(shown));
                self.line(
                    self.depth + 1,
                    format_args!(
                        "light {light} toward {toward}: {through} % gets through, adds {shown}, {part}"
                    ),
                );
            }
            Event::Cut(cut) => self.cut(cut),
        }
    }
}

fn vector(Vec3 { x, y, z }: Vec3) -> String {
    format!("({}, {}, {})", number(x), number(y), number(z))
}

fn color(LinearRgb { r, g, b }: LinearRgb) -> String {
    format!("({}, {}, {})", number(r), number(g), number(b))
}

/// A number with four significant digits, without trailing zeros.
fn number(value: f32) -> String {
    let magnitude = if value == 0.0 { 0.0 } else { value.abs().log10().floor() };
    let decimals = (3.0 - magnitude).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    if !text.contains('.') {
        return text;
    }
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

impl From<RenderError> for ReportError {
    fn from(error: RenderError) -> Self {
        Self::Render(error)
    }
}

impl fmt::Display for ReportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outside { pixel: (x, y), size: (width, height) } => {
                write!(f, "there is no pixel {x},{y}: the picture is {width}x{height}, counted from 0,0")
            }
            Self::Render(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for ReportError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Outside { .. } => None,
            Self::Render(error) => Some(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (-0.25, "-0.25"),
            (0.123456, "0.1235"),
            (0.000123456, "0.0001235"),
            (123.456, "123.5"),
            (123456.0, "123456"),
            (20.0, "20"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
