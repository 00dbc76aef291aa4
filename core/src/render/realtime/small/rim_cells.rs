//! The cells that may show the rim of a mesh. They are verified once they are drawn.
//!
//! A mesh may be thin somewhere, like a teapot at its handle, and stores no list of thin parts. But in the
//! picture, a mesh ends at its rims: where its normals turn away from the eye, or along the edges of flat
//! triangles. A part narrower than a cell has a rim in that cell. The cells with a rim, or with the shadow of
//! a rim on the largest flat object, are found once for a picture.

use super::super::grid::Grid;
use super::shadow_projection::ShadowProjection;
use super::stadium::place_of;
use crate::light::Source;
use crate::math::{Real, Vec3};
use crate::render::Renderer;
use crate::shape::{Bend, Geometry, Rim, Silhouette};

/// A set of squares of the picture, each of one cell or several.
#[derive(Clone, Copy, Debug)]
pub(super) struct RimCells {
    /// A bit for each square, row after row.
    bits: [u32; WORDS],
    /// The squares in a row.
    columns: usize,
    /// The side of a square is 2 to the power of `shift` pixels.
    shift: u32,
}

/// Enough words for a picture of 320×240 with a bit for each cell of eight pixels.
const WORDS: usize = 40;

/// The most points of one rim that are looked up: most of a longer rim is outside of the picture.
const MOST_POINTS: i32 = 128;

impl RimCells {
    /// The empty set, in a picture of this width and height.
    fn none(width: u16, height: u16, grid: Grid) -> Self {
        let squares = |pixels: u16, shift: u32| (usize::from(pixels.saturating_sub(1)) >> shift) + 1;
        let mut shift = grid.pixels().trailing_zeros();
        while squares(width, shift).saturating_mul(squares(height, shift)) > WORDS * 32 {
            shift += 1;
        }
        Self { bits: [0; WORDS], columns: squares(width, shift), shift }
    }

    /// The cells of a picture that may show a rim or its shadow, if there are any.
    pub(super) fn new<R: Real, S: Geometry>(renderer: &Renderer<'_, '_, R, S>, grid: Grid) -> Option<Self> {
        if !S::Prepared::<'_, R>::HAS_RIMS {
            return None;
        }
        let Renderer { scene, viewport, outlines, .. } = renderer;
        let plane = scene.plane_of(outlines.receiver());
        let mut cells = Self::none(renderer.width, renderer.height, grid);
        scene.each_rim(|rim| {
            let [from, _] = rim.ends;
            if rim.is_seen_from(viewport.eye() - from) {
                cells.add_rim(renderer, grid, &rim, None);
            }
            let Some(plane) = plane else { return };
            for light in scene.lights {
                let toward = match light.source {
                    Source::At(position) => position - from,
                    Source::Toward(direction) => direction,
                    Source::Far(..) => continue,
                };
                if rim.is_seen_from(toward) {
                    let projection = ShadowProjection::new(&light.source, plane);
                    cells.add_rim(renderer, grid, &rim, projection.as_ref());
                }
            }
        });
        cells.bits.iter().any(|word| *word != 0).then_some(cells)
    }

    /// Adds the squares in which a rim, or its shadow, is seen. The rim of a flat part wider than a cell is
    /// left out.
    fn add_rim<R: Real, S: Geometry>(
        &mut self,
        renderer: &Renderer<'_, '_, R, S>,
        grid: Grid,
        rim: &Rim<R>,
        projection: Option<&ShadowProjection<R::Setup>>,
    ) {
        let viewport = &renderer.viewport;
        let number = R::Setup::from_u16;
        let shown = |point| projection.map_or(Some(point), |projection| projection.shadow_of(point));
        let [from, to] = rim.ends.map(Vec3::to_setup);
        let half = R::Setup::from_f32(0.5);
        let Some(middle) = shown((from + to) * half) else { return };
        // The length of a cell's side in the scene, at the depth of the rim's middle.
        let size = viewport.depth(middle).0 * viewport.pixel() * number(grid.pixels() as u16);
        if let Bend::Sharp(width) = rim.bend
            && !(width.to_setup() < size)
        {
            return;
        }
        // Two points for each cell that the rim is long.
        let cells = (to - from).length() / size;
        let count = (cells + cells).floor_to_i32().clamp(0, MOST_POINTS) as u16 + 1;
        let step = (to - from) * number(count).recip();
        for i in 0..count {
            let point = shown(from + step * (number(i) + half));
            if let Some((x, y)) = point.and_then(|point| place_of(viewport, point)) {
                self.add(x.floor_to_i32(), y.floor_to_i32(), (renderer.width, renderer.height));
            }
        }
    }

    /// Adds the square around a pixel, if the pixel is within a picture of this width and height.
    fn add(&mut self, x: i32, y: i32, (width, height): (u16, u16)) {
        if (0..i32::from(width)).contains(&x) && (0..i32::from(height)).contains(&y) {
            let (word, bit) = self.place(x as u32, y as u32);
            if let Some(word) = self.bits.get_mut(word) {
                *word |= bit;
            }
        }
    }

    /// The word and the bit of the square around a pixel.
    fn place(&self, x: u32, y: u32) -> (usize, u32) {
        let place = (y >> self.shift) as usize * self.columns + (x >> self.shift) as usize;
        (place >> 5, 1 << (place & 31))
    }

    /// Whether the cell that begins at this pixel may show a rim.
    pub(super) fn hold(&self, left: u32, top: u32) -> bool {
        let (word, bit) = self.place(left, top);
        self.bits.get(word).is_some_and(|word| word & bit != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cells_around_added_pixels_are_held() {
        let mut cells = RimCells::none(320, 240, Grid::Eight);
        for (x, y) in [(0, 0), (47, 8), (319, 239), (320, 5), (-1, 5), (5, 240)] {
            cells.add(x, y, (320, 240));
        }
        let all = (0..240).step_by(8).flat_map(|top| (0..320).step_by(8).map(move |left| (left, top)));
        let held: Vec<(u32, u32)> = all.filter(|(left, top)| cells.hold(*left, *top)).collect();
        assert_eq!(held, [(0, 0), (40, 8), (312, 232)]);
    }

    #[test]
    fn large_pictures_have_larger_squares() {
        let mut cells = RimCells::none(u16::MAX, u16::MAX, Grid::Four);
        assert!(!cells.hold(65_532, 65_532));
        cells.add(65_534, 65_534, (u16::MAX, u16::MAX));
        assert!(cells.hold(65_532, 65_532) && !cells.hold(0, 65_532) && !cells.hold(65_532, 0));
    }
}
