//! The statements of a file.

use bumpalo::Bump;
use rayline::limits::{MAX_COUNT, MAX_SIDE};
use rayline::shape::Shape;
use rayline::{Background, Camera, Light, LinearRgb, Material, Object, Scene, Texture, Vec3};

use super::objects::{self, Made};
use super::tokens::Tokens;
use super::{Import, Lines, NffError, NffFault};
use crate::model::{ModelView, view};
use crate::notes::Notes;

/// The note about the default view.
const SEEN: &str = "the whole model is seen from the front, slightly from the right and above (y is up)";

/// The parts of the scene that were read so far.
pub(super) struct Reader<'a> {
    arena: &'a Bump,
    view: Option<(Camera, (u32, u32))>,
    background: LinearRgb,
    objects: Vec<Object<Shape<'a>>>,
    materials: Vec<Material<'static>>,
    /// Positions and colors; `None` where the file gives no color.
    lights: Vec<(Vec3, Option<LinearRgb>)>,
    lines: Lines,
    notes: Notes,
}

impl<'a> Reader<'a> {
    pub(super) fn new(arena: &'a Bump) -> Self {
        Self {
            arena,
            view: None,
            background: LinearRgb::BLACK,
            objects: Vec::new(),
            materials: Vec::new(),
            lights: Vec::new(),
            lines: Lines::default(),
            notes: Notes::default(),
        }
    }

    pub(super) fn statement(&mut self, keyword: &str, tokens: &mut Tokens<'_>) -> Result<(), NffError> {
        let line = tokens.line();
        match keyword {
            "v" if self.view.is_some() => Err(tokens.error(NffFault::Repeated { keyword: "v" })),
            "v" => {
                self.lines.camera = Some(line);
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
                self.lights.push(light(tokens)?);
                Ok(())
            }
            "f" => {
                let (material, note) = material(tokens)?;
                self.note(line, note);
                self.add_material(material, line, tokens)
            }
            "s" | "c" | "p" | "pp" => self.object(keyword, tokens),
            _ => Err(tokens.error(NffFault::UnknownKeyword { found: keyword.to_owned() })),
        }
    }

    fn note(&mut self, line: usize, what: Option<&'static str>) {
        if let Some(what) = what {
            self.notes.add(format!("line {line}"), what);
        }
    }

    fn add_material(
        &mut self,
        material: Material<'static>,
        line: usize,
        tokens: &Tokens<'_>,
    ) -> Result<(), NffError> {
        if self.materials.len() >= MAX_COUNT {
            return Err(tokens.error(NffFault::TooManyMaterials { most: MAX_COUNT }));
        }
        self.lines.materials.push(line);
        self.materials.push(material);
        Ok(())
    }

    fn object(&mut self, keyword: &str, tokens: &mut Tokens<'_>) -> Result<(), NffError> {
        let line = tokens.line();
        if self.materials.is_empty() {
            self.note(line, Some("there is no material (`f`) before it; it is white and matte"));
            self.add_material(Material::matte(LinearRgb::WHITE), line, tokens)?;
        }
        // There is a material, and `MAX_COUNT` fits in 16 bits.
        let material = self.materials.len().saturating_sub(1) as u16;
        let Made { shapes, note } = match keyword {
            "s" => objects::sphere(tokens)?,
            "c" => objects::cone(tokens)?,
            "p" => objects::polygon(self.arena, tokens)?,
            _ => objects::patch(tokens)?,
        };
        self.note(line, note);
        for shape in shapes {
            // Stop here: the rest of the file may be huge.
            if self.objects.len() >= MAX_COUNT {
                return Err(NffError { line, fault: NffFault::TooManyObjects { most: MAX_COUNT } });
            }
            self.objects.push(Object::new(shape, material));
            self.lines.objects.push(line);
        }
        Ok(())
    }

    pub(super) fn finish(mut self, last_line: usize) -> Result<Import<'a>, NffError> {
        let mut added = |what: String| self.notes.add("the file", what);
        let (camera, resolution) = match self.view {
            Some(view) => view,
            None => {
                let bounds = objects::bounds(&self.objects);
                let bounds = bounds.ok_or(NffError { line: last_line, fault: NffFault::NoView })?;
                added(format!("it has no view (`v`); {SEEN}"));
                (ModelView::default().camera(bounds), view::SIZE)
            }
        };
        let uncolored = LinearRgb::gray(1.0 / (self.lights.len() as f32).sqrt());
        let mut lights: Vec<Light> = { self.lights }
            .into_iter()
            .map(|(position, color)| Light::Point { position, color: color.unwrap_or(uncolored) })
            .collect();
        if lights.is_empty() && !self.objects.is_empty() {
            added(format!("it has no light (`l`); {}", view::LIT));
            // Materials of NFF have no ambient light.
            let [key, _] = view::lights(&camera);
            lights.push(key);
        }
        let scene = Scene {
            camera,
            background: Background::Solid(self.background),
            objects: self.arena.alloc_slice_copy(&self.objects),
            materials: self.arena.alloc_slice_copy(&self.materials),
            lights: self.arena.alloc_slice_copy(&lights),
            motions: &[],
        };
        Ok(Import { scene, resolution, notes: self.notes.lines(), lines: self.lines })
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

fn light(tokens: &mut Tokens<'_>) -> Result<(Vec3, Option<LinearRgb>), NffError> {
    let position = tokens.vector("the position of the light")?;
    let color = if tokens.number_follows() { Some(tokens.color("the color of the light")?) } else { None };
    Ok((position, color))
}

/// A material, and a note if it was changed.
fn material(tokens: &mut Tokens<'_>) -> Result<(Material<'static>, Option<&'static str>), NffError> {
    let color = tokens.color("the color of the material")?;
    let diffuse = tokens.number("the diffuse share Kd")?;
    let specular = tokens.number("the specular share Ks")?;
    let shininess = tokens.number("the exponent of the highlight")?;
    let transmittance = tokens.number("the transmittance T")?;
    let ior = tokens.number("the index of refraction")?;
    // The core refuses negative shares.
    let (sum, least) = (specular + transmittance, specular.min(transmittance));
    let is_scaled = sum > 1.0 && least >= 0.0;
    let scale = if is_scaled { 1.0 / sum } else { 1.0 };
    let material = Material {
        color: Texture::Solid(color * diffuse.max(1.0)),
        diffuse: diffuse.min(1.0),
        specular: specular.min(1.0),
        shininess,
        reflectance: specular * scale,
        transmittance: transmittance * scale,
        ior: if transmittance == 0.0 && ior == 0.0 { 1.0 } else { ior },
        ..Material::matte(LinearRgb::WHITE)
    };
    Ok((material, is_scaled.then_some("Ks + T is above 1; both are scaled to a sum of 1")))
}
