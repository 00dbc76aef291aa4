//! Reading of scenes in Neutral File Format (NFF), the output of Eric Haines' Standard Procedural Databases
//! ("A Proposal for Standard Graphics Environments", IEEE Computer Graphics & Applications, 1987).
//!
//! ```text
//! v from X Y Z at X Y Z up X Y Z angle DEG hither H resolution W H
//! b R G B                              background; without it, black
//! l X Y Z [R G B]                      a light
//! f R G B Kd Ks shine T ior            material of everything that follows
//! s X Y Z radius                       a sphere
//! c X Y Z radius X Y Z radius          a cone or cylinder, without caps
//! p  n (X Y Z)*n                       a planar polygon
//! pp n (X Y Z NX NY NZ)*n              a patch with vertex normals
//! # a comment, to the end of the line
//! ```
//!
//! Words are separated by white space, and line breaks only end comments. The words mean:
//!
//! - `angle` is the full vertical angle of view in degrees, and pixels are square.
//! - `hither` is the distance of a clipping plane. It must be a number, but is ignored: rays begin at the
//!   eye.
//! - A light without a color has intensity 1/√(number of lights) in each channel. Light does not fall off
//!   with distance.
//! - `f` becomes a material with diffuse Kd, specular and reflectance Ks, exponent `shine` and transmittance
//!   T; there is no ambient light. Opaque materials often have an `ior` of 0, which has no effect: it is read
//!   as 1.
//! - A polygon of three vertices becomes a triangle. A patch becomes a fan of triangles around its first
//!   vertex, with interpolated normals. Triangles without area (with repeated vertices, or vertices on one
//!   line) are left out: tessellated surfaces have them at their poles and seams.

mod error;
#[cfg(test)]
mod tests;
mod tokens;

use bumpalo::Bump;
use rayline::limits::{MAX_COUNT, MAX_SIDE};
use rayline::shape::{Cone, Cylinder, Polygon, Shape, Sphere, Triangle};
use rayline::{Background, Camera, Light, LinearRgb, Material, Object, Part, Scene, Texture, Vec3};

use crate::text;

pub(crate) use error::Excerpt;
pub use error::{NffError, NffFault};
use tokens::Tokens;

/// A scene that was read from a file.
#[derive(Clone, Debug)]
pub struct Import<'a> {
    /// The scene; it is checked when it is prepared.
    pub scene: Scene<'a>,
    /// The width and height of the picture by the file, in pixels: 1 to 65535.
    pub resolution: (u32, u32),
    lines: Lines,
}

/// The line of the file in which each part of the scene begins.
#[derive(Clone, Debug, Default)]
struct Lines {
    camera: usize,
    background: Option<usize>,
    objects: Vec<usize>,
    materials: Vec<usize>,
    lights: Vec<usize>,
}

impl Import<'_> {
    /// The line in which the file describes this part of the scene, counted from 1, for errors of the scene.
    /// `None` for a part that is not in the file.
    pub fn line_of(&self, part: Part) -> Option<usize> {
        match part {
            Part::Camera => Some(self.lines.camera),
            Part::Background => self.lines.background,
            Part::Object(index) => self.lines.objects.get(index).copied(),
            Part::Material(index) => self.lines.materials.get(index).copied(),
            Part::Light(index) => self.lines.lights.get(index).copied(),
            _ => None,
        }
    }
}

/// Reads a scene from the bytes of an NFF file.
///
/// # Errors
/// The errors of [`parse`], or the line that is not UTF-8.
pub fn parse_bytes<'a>(arena: &'a Bump, bytes: &[u8]) -> Result<Import<'a>, NffError> {
    let text = text::of_bytes(bytes).map_err(|line| NffError { line, fault: NffFault::NotUtf8 })?;
    parse(arena, text)
}

/// Reads a scene from the text of an NFF file. Its lists are kept in `arena`.
///
/// # Errors
/// The first line that breaks the grammar, and what was expected there. Numbers that are refused for their
/// value, such as a negative radius, are found by [`PreparedScene::new`](rayline::PreparedScene::new);
/// [`Import::line_of`] gives the line of such an error.
pub fn parse<'a>(arena: &'a Bump, text: &str) -> Result<Import<'a>, NffError> {
    let mut tokens = Tokens::new(text);
    let mut reader = Reader::new(arena);
    while let Some(keyword) = tokens.next() {
        reader.statement(keyword, &mut tokens)?;
    }
    reader.finish(tokens.last_line())
}

/// The parts of the scene that were read so far.
struct Reader<'a> {
    arena: &'a Bump,
    view: Option<(Camera, (u32, u32))>,
    background: LinearRgb,
    objects: Vec<Object<Shape<'a>>>,
    materials: Vec<Material<'static>>,
    /// Positions and colors; `None` where the file gives no color.
    lights: Vec<(Vec3, Option<LinearRgb>)>,
    lines: Lines,
}

impl<'a> Reader<'a> {
    fn new(arena: &'a Bump) -> Self {
        Self {
            arena,
            view: None,
            background: LinearRgb::BLACK,
            objects: Vec::new(),
            materials: Vec::new(),
            lights: Vec::new(),
            lines: Lines::default(),
        }
    }

    fn statement(&mut self, keyword: &str, tokens: &mut Tokens<'_>) -> Result<(), NffError> {
        let line = tokens.line();
        match keyword {
            "v" if self.view.is_some() => Err(tokens.error(NffFault::Repeated { keyword: "v" })),
            "v" => {
                self.lines.camera = line;
                self.view = Some(view(tokens)?);
                Ok(())
            }
            "b" if self.lines.background.is_some() => Err(tokens.error(NffFault::Repeated { keyword: "b" })),
            "b" => {
                self.lines.background = Some(line);
                self.background = tokens.color("the background's color")?;
                Ok(())
            }
            "l" => {
                self.lines.lights.push(line);
                let position = tokens.vector("the position of the light")?;
                let color = if tokens.number_follows() {
                    Some(tokens.color("the color of the light")?)
                } else {
                    None
                };
                self.lights.push((position, color));
                Ok(())
            }
            "f" if self.materials.len() >= MAX_COUNT => {
                Err(tokens.error(NffFault::TooManyMaterials { most: MAX_COUNT }))
            }
            "f" => {
                self.lines.materials.push(line);
                self.materials.push(material(tokens)?);
                Ok(())
            }
            "s" | "c" | "p" | "pp" => self.object(keyword, tokens),
            _ => Err(tokens.error(NffFault::UnknownKeyword { found: keyword.to_owned() })),
        }
    }

    fn object(&mut self, keyword: &str, tokens: &mut Tokens<'_>) -> Result<(), NffError> {
        let line = tokens.line();
        let material = self.materials.len().checked_sub(1).and_then(|last| u16::try_from(last).ok());
        let material = material.ok_or_else(|| tokens.error(NffFault::NoMaterial))?;
        let mut push = |shape| {
            self.objects.push(Object::new(shape, material));
            self.lines.objects.push(line);
        };
        match keyword {
            "s" => {
                let center = tokens.vector("the center of the sphere")?;
                push(Shape::Sphere(Sphere::new(center, tokens.number("the radius of the sphere")?)));
            }
            "c" => push(cone(tokens)?),
            "p" => push(polygon(self.arena, tokens)?),
            _ => patch(tokens)?.for_each(|triangle| push(Shape::Triangle(triangle))),
        }
        Ok(())
    }

    fn finish(self, last_line: usize) -> Result<Import<'a>, NffError> {
        let (camera, resolution) = self.view.ok_or(NffError { line: last_line, fault: NffFault::NoView })?;
        let uncolored = LinearRgb::gray(1.0 / (self.lights.len() as f32).sqrt());
        let light = |(position, color): (Vec3, Option<_>)| Light::Point {
            position,
            color: color.unwrap_or(uncolored),
        };
        let scene = Scene {
            camera,
            background: Background::Solid(self.background),
            objects: self.arena.alloc_slice_copy(&self.objects),
            materials: self.arena.alloc_slice_copy(&self.materials),
            lights: self.arena.alloc_slice_fill_iter(self.lights.into_iter().map(light)),
            motions: &[],
        };
        Ok(Import { scene, resolution, lines: self.lines })
    }
}

fn view(tokens: &mut Tokens<'_>) -> Result<(Camera, (u32, u32)), NffError> {
    tokens.keyword("`from`")?;
    let eye = tokens.vector("the position of the eye")?;
    tokens.keyword("`at`")?;
    let target = tokens.vector("the point to look at")?;
    tokens.keyword("`up`")?;
    let up = tokens.vector("the direction up")?;
    tokens.keyword("`angle`")?;
    let vertical_fov = tokens.number("the angle of view")?.to_radians();
    tokens.keyword("`hither`")?;
    tokens.number("the distance of the hither plane")?;
    tokens.keyword("`resolution`")?;
    let width = tokens.count("the width in pixels, 1 to 65535", 1, MAX_SIDE)?;
    let height = tokens.count("the height in pixels, 1 to 65535", 1, MAX_SIDE)?;
    Ok((Camera { eye, target, up, vertical_fov, lens: None }, (width, height)))
}

fn material(tokens: &mut Tokens<'_>) -> Result<Material<'static>, NffError> {
    let color = tokens.color("the color of the material")?;
    let diffuse = tokens.number("the diffuse share Kd")?;
    let specular = tokens.number("the specular share Ks")?;
    let shininess = tokens.number("the exponent of the highlight")?;
    let transmittance = tokens.number("the transmittance T")?;
    let ior = tokens.number("the index of refraction")?;
    Ok(Material {
        color: Texture::Solid(color),
        ambient: 0.0,
        diffuse,
        specular,
        shininess,
        reflectance: specular,
        transmittance,
        ior: if transmittance == 0.0 && ior == 0.0 { 1.0 } else { ior },
        optics: None,
        maps: &[],
    })
}

fn cone<'a>(tokens: &mut Tokens<'_>) -> Result<Shape<'a>, NffError> {
    let base = tokens.vector("the middle of the base")?;
    let base_radius = tokens.number("the radius of the base")?;
    let top = tokens.vector("the middle of the apex")?;
    let top_radius = tokens.number("the radius of the apex")?;
    Ok(if base_radius == top_radius {
        Shape::Cylinder(Cylinder { base, top, radius: base_radius, capped: false })
    } else {
        Shape::Cone(Cone { base, base_radius, top, top_radius, capped: false })
    })
}

/// Reads a count, and then that number of items.
fn list<T>(
    tokens: &mut Tokens<'_>,
    item: impl Fn(&mut Tokens<'_>) -> Result<T, NffError>,
) -> Result<Vec<T>, NffError> {
    let count = tokens.count("the number of vertices, 3 or more", 3, u32::MAX)?;
    // The list grows with the contents of the file, not with the count, which may be wrong.
    let mut items = Vec::new();
    for _ in 0..count {
        items.push(item(tokens)?);
    }
    Ok(items)
}

fn polygon<'a>(arena: &'a Bump, tokens: &mut Tokens<'_>) -> Result<Shape<'a>, NffError> {
    let vertices = list(tokens, |tokens| tokens.vector("a vertex of the polygon"))?;
    Ok(match *vertices {
        [a, b, c] => Shape::Triangle(Triangle::flat(a, b, c)),
        _ => Shape::Polygon(Polygon::new(arena.alloc_slice_copy(&vertices))),
    })
}

/// The triangles of a patch that have an area.
fn patch(tokens: &mut Tokens<'_>) -> Result<impl Iterator<Item = Triangle>, NffError> {
    let corners = list(tokens, |tokens| {
        Ok((tokens.vector("a vertex of the patch")?, tokens.vector("the normal at a vertex of the patch")?))
    })?;
    let mut rest = corners.into_iter();
    let first = rest.next();
    let mut previous = rest.next();
    let fan = rest.filter_map(move |third| {
        let (a, b, c) = (first?, previous.replace(third)?, third);
        Some(Triangle { vertices: [a.0, b.0, c.0], normals: Some([a.1, b.1, c.1]) })
    });
    Ok(fan.filter(has_area))
}

/// Whether a triangle is thicker than two millionths of its sides. The core accepts triangles half as thick,
/// so it never refuses a triangle of a patch, which the file does not name.
fn has_area(triangle: &Triangle) -> bool {
    let [a, b, c] = triangle.vertices.map(Vec3::to::<f64>);
    let (ab, ac) = (b - a, c - a);
    ab.cross(ac).length() > 2e-6 * ab.length() * ac.length()
}
