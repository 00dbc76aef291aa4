//! The colors of a line, by the facets that are seen there.

use super::facet::{PreviewFacet, PreviewPixel, unpacked};
use super::{DisplayColor, Preview, Renderer};
use crate::camera::RayRow;
use crate::color::LinearRgb;
use crate::math::{Real, Vec3};
use crate::probe::Probe;
use crate::render::painter::{Painter, Traced};
use crate::render::pixel::Aim;
use crate::render::quality::Sealed;
use crate::render::region::Region;
use crate::render::{Light16, LineError, Quality, Quantizer};
use crate::shape::{Geometry, project_onto_plane};
use crate::surface::Surface;

/// A preview with memory for a line, see [`Preview::lend`]: a [`Quality`].
#[derive(Debug)]
pub struct PreviewBuffer<'b, C> {
    pub(super) preview: Preview<'b>,
    pub(super) line: &'b mut [C],
    pub(super) pixels: &'b mut [PreviewPixel],
}

impl<C: DisplayColor> Sealed for PreviewBuffer<'_, C> {}

impl<'b, C: DisplayColor, R: Real> Quality<R> for PreviewBuffer<'b, C> {
    type Color = C;
    type Painter<'m, S: Geometry + 'm> = PreviewPainter<'b, C>;

    fn check<S: Geometry>(&self, renderer: &Renderer<'_, '_, R, S>) -> Result<(), LineError> {
        if self.preview.size != (renderer.width, renderer.height) {
            return Err(LineError::OtherPicture);
        }
        renderer.check_line(self.line.len().min(self.pixels.len()))
    }

    fn painter<'m, S: Geometry + 'm>(self, _: &Renderer<'_, 'm, R, S>) -> PreviewPainter<'b, C> {
        PreviewPainter(self)
    }
}

/// Draws one line after the other. It spends no rays, and counts one for each pixel.
#[derive(Debug)]
pub struct PreviewPainter<'b, C>(PreviewBuffer<'b, C>);

impl<'m, R: Real, S: Geometry + 'm, C: DisplayColor> Painter<'m, R, S> for PreviewPainter<'_, C> {
    type Color = C;

    fn restart(&mut self, _lines_total: u32) {}

    fn trace(
        &mut self,
        renderer: &Renderer<'_, 'm, R, S>,
        region: &Region,
        _budget_rays: u32,
        _probe: &mut impl Probe<R>,
    ) -> Traced {
        let PreviewBuffer { preview, line, pixels } = &mut self.0;
        let (left, y) = region.pixel(0, 0);
        let pixels = pixels.get_mut(..region.width() as usize).unwrap_or_default();
        preview.scan.line(preview.facets, y, left, pixels);
        let mut palette = LinePalette::new(renderer, preview, y);
        for (x, (color, pixel)) in (left..).zip(line.iter_mut().zip(pixels)) {
            *color = C::from_light(palette.light(x, *pixel), &Quantizer::new(&renderer.settings, x, y));
        }
        Traced { rays: region.width(), is_complete: true }
    }

    fn band(&self, region: &Region) -> (u32, &[C]) {
        let pixels = self.0.line.get(..region.width() as usize).unwrap_or_default();
        (region.top.saturating_add(1), pixels)
    }

    fn sent_until(&mut self, _line: u32) {}
}

/// The light of a line's pixels.
struct LinePalette<'p, 'm, R: Real, S: Geometry + 'm> {
    renderer: &'p Renderer<'p, 'm, R, S>,
    preview: &'p Preview<'p>,
    y: u16,
    row: RayRow<R>,
    forward: Vec3<R>,
    /// The facet of the last pixel, and its light at the next one.
    run: Option<(u16, Shade)>,
}

/// Light that is linear along a line, in units of 2⁻²⁸: at the next pixel, and how it changes.
#[derive(Clone, Copy)]
struct Shade {
    light: [i32; 4],
    step: [i32; 4],
}

impl<'p, 'm, R: Real, S: Geometry + 'm> LinePalette<'p, 'm, R, S> {
    fn new(renderer: &'p Renderer<'p, 'm, R, S>, preview: &'p Preview<'p>, y: u16) -> Self {
        let [_, _, forward] = renderer.viewport.axes();
        Self { renderer, preview, y, row: renderer.row(y, Aim::Area), forward, run: None }
    }

    /// The light of a pixel. The pixels are those of the line from left to right.
    fn light(&mut self, x: u16, pixel: PreviewPixel) -> Light16 {
        let Some(facet) = self.preview.seen(pixel) else {
            self.run = None;
            return self.background(x);
        };
        let mut shade = match self.run {
            Some((number, shade)) if number == pixel.facet => shade,
            _ => Shade::new(facet, (x, self.y)),
        };
        let [r, g, b, added] = shade.next();
        self.run = Some((pixel.facet, shade));
        if !facet.is_textured {
            return Light16 { r, g, b }.clamped();
        }
        let color = Light16::new(self.texture(x, pixel, facet));
        // At most 2¹⁸ · 2¹⁶, of light up to 4.
        let times = |light: u32, color: u32| ((u64::from(light) * u64::from(color)) >> 16) as u32;
        let sum = |light, color| times(light, color).saturating_add(added);
        Light16 { r: sum(r, color.r), g: sum(g, color.g), b: sum(b, color.b) }.clamped()
    }

    fn background(&self, x: u16) -> Light16 {
        let background = &self.renderer.scene.background;
        if let Some(color) = background.solid() {
            return Light16::new(color);
        }
        let viewport = &self.renderer.viewport;
        let across = viewport.across((x, Aim::Area.place()));
        let point = viewport.at_depth(across, self.row, self.forward, R::ONE);
        Light16::new(background.color((point - viewport.eye()).unit()))
    }

    /// The color of the texture where the facet is seen.
    fn texture(&self, x: u16, pixel: PreviewPixel, facet: &PreviewFacet) -> LinearRgb<R> {
        let Renderer { scene, viewport, .. } = self.renderer;
        let object = usize::from(facet.object);
        let Some(material) = scene.material(object) else { return LinearRgb::BLACK };
        let depth = self.preview.nearest * (1u32 << 30) as f32 / pixel.inverse_depth as f32;
        let across = viewport.across((x, Aim::Area.place()));
        let point = viewport.at_depth(across, self.row, self.forward, R::from_f32(depth));
        // A texture may change just where the facet lies, as a checker with a level between its cells does.
        let normal = unpacked(facet.normal);
        let point = project_onto_plane(point, normal, R::from_f32(facet.distance));
        let magnitude = point.magnitude();
        let surface = Surface { point, normal, shading_normal: normal, magnitude, part: facet.part };
        let color = material.color.color(&surface, || scene.uv(object, &surface));
        #[cfg(feature = "textures")]
        let color = if scene.is_tinted(object) { scene.tint(object, &surface) * color } else { color };
        color
    }
}

impl Shade {
    /// From pixel (x, y) of a facet on.
    fn new(facet: &PreviewFacet, (x, y): (u16, u16)) -> Self {
        let [a, b, c] = facet.corners.map(|at| at.map(i32::from));
        let from = |[x, y]: [i32; 2]| [x.wrapping_sub(a[0]), y.wrapping_sub(a[1])];
        let middle = |pixel: u16| (i32::from(pixel) << 4) + 8;
        let (b, c, at) = (from(b), from(c), from([middle(x), middle(y)]));
        let cross = |[ax, ay]: [i32; 2], [bx, by]: [i32; 2]| {
            i64::from(ax) * i64::from(by) - i64::from(ay) * i64::from(bx)
        };
        // Barycentric coordinates. The area is not 0.
        let share = 1.0 / cross(b, c) as f32;
        let (of_b, of_c) = (cross(at, c) as f32 * share, cross(b, at) as f32 * share);
        let (b_step, c_step) = (16.0 * c[1] as f32 * share, -16.0 * b[1] as f32 * share);
        let [at_a, at_b, at_c] = facet.lights;
        let (mut light, mut step) = ([0; 4], [0; 4]);
        for ((light, step), ((a, b), c)) in
            light.iter_mut().zip(&mut step).zip(at_a.into_iter().zip(at_b).zip(at_c))
        {
            let unit = |light: u16| f32::from(light) * (1u32 << 14) as f32;
            let (a, to_b, to_c) = (unit(a), unit(b) - unit(a), unit(c) - unit(a));
            *light = (a + to_b * of_b + to_c * of_c) as i32;
            *step = (to_b * b_step + to_c * c_step) as i32;
        }
        Self { light, step }
    }

    /// The light of the next pixel: 65536 is full light.
    fn next(&mut self) -> [u32; 4] {
        let now = self.light;
        for (light, step) in self.light.iter_mut().zip(self.step) {
            *light = light.wrapping_add(step);
        }
        // The packed light has units of 2⁻¹⁴.
        now.map(|light| (light.max(0) as u32) >> 12)
    }
}
