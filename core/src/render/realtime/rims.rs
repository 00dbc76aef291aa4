//! Where meshes may be thin in parts, as a teapot at its handle.
//!
//! Whether a mesh is thin somewhere is not known, but it ends at its rims: where normals turn away from the eye, or along the edges of
//! triangles that are flat and narrower than a cell. They are found once for a frame. A cell that has one, or its shadow on the largest flat
//! object, is [verified](super::cell::Cell::verify) when it is done. Of 24 frames around the teapot of the gallery, on a grid of eight, at
//! 160×120, 231 pixels are off by 48 of 255 or more, and 20 at most in one frame, in place of 424 and 64, with its handle broken and its spout
//! cut off; for 1.20 times the rays. At 320×240 it is 480 and 40 in place of 1047 and 94, for 1.22 times the rays. The gallery's own view takes
//! an M4F 2,443 instructions a pixel at 160×120, for 43.9 dB, in place of 1,990 for 38.1; exactly it takes 5,775. To find the rims is next to
//! nothing of that.
//!
//! Rejected: every second pixel of every second row (101 pixels and 9, for 1.51 times the rays), or half of those (176 and 12, for 1.28 times,
//! but lines of a pixel between them are lost); to trace such cells in full (14 and 2, for 2.3 times); rims that are bent more closely than a
//! cell alone, of which there are fewer (135 and 23, for 1.36 times, with every second pixel): a handle may be flat above and below.

use super::super::Renderer;
use super::Grid;
use super::stadium::place_of;
use super::taper::Shade;
use crate::light::Source;
use crate::math::{Real, Vec3};
use crate::shape::{Bend, Geometry, Rim, Silhouette};

/// Squares of the picture in which rims are seen, as a set.
#[derive(Clone, Copy, Debug)]
pub(super) struct RimPlaces {
    /// A bit for each, row after row.
    bits: [u32; WORDS],
    columns: usize,
    /// Its side is a power of two, and that of a cell or more.
    shift: u32,
}

/// Enough for a picture of 320×240 with a bit for a cell of eight pixels.
const WORDS: usize = 40;

/// The most places that one rim is asked for: most of a longer one is outside of the picture.
const MOST_PLACES: i32 = 128;

impl RimPlaces {
    /// None, in a picture of this width and height.
    fn none(width: u16, height: u16, grid: Grid) -> Self {
        let squares = |side: u16, shift: u32| (usize::from(side.saturating_sub(1)) >> shift) + 1;
        let mut shift = grid.pixels().trailing_zeros();
        while squares(width, shift).saturating_mul(squares(height, shift)) > WORDS * 32 {
            shift += 1;
        }
        Self { bits: [0; WORDS], columns: squares(width, shift), shift }
    }

    /// Those of a scene, if it has some.
    #[inline(never)]
    pub(super) fn new<R: Real, S: Geometry>(renderer: &Renderer<'_, '_, R, S>, grid: Grid) -> Option<Self> {
        if !S::Prepared::<'_, R>::HAS_RIMS {
            return None;
        }
        let Renderer { scene, viewport, outlines, .. } = renderer;
        let plane = scene.plane_of(outlines.receiver());
        let mut places = Self::none(renderer.width, renderer.height, grid);
        scene.each_rim(|rim| {
            let [from, _] = rim.ends;
            if rim.is_seen_from(viewport.eye() - from) {
                places.add_rim(renderer, grid, &rim, None);
            }
            let Some(plane) = plane else { return };
            for light in scene.lights {
                let toward = match light.source {
                    Source::At(position) => position - from,
                    Source::Toward(direction) => direction,
                    Source::Far(..) => continue,
                };
                if rim.is_seen_from(toward) {
                    places.add_rim(renderer, grid, &rim, Shade::new(&light.source, plane).as_ref());
                }
            }
        });
        places.bits.iter().any(|word| *word != 0).then_some(places)
    }

    /// Adds the squares that a rim, or its shadow, is seen in, unless what it bounds is flat and wider than a cell.
    #[inline(never)]
    fn add_rim<R: Real, S: Geometry>(
        &mut self,
        renderer: &Renderer<'_, '_, R, S>,
        grid: Grid,
        rim: &Rim<R>,
        shade: Option<&Shade<R::Setup>>,
    ) {
        let viewport = &renderer.viewport;
        let number = R::Setup::from_u16;
        let shown = |point| shade.map_or(Some(point), |shade| shade.shadow(point));
        let [from, to] = rim.ends.map(Vec3::to_setup);
        let half = R::Setup::from_f32(0.5);
        let Some(middle) = shown((from + to) * half) else { return };
        // How long a cell's side is there, along the picture.
        let side = viewport.depth(middle).0 * viewport.pixel() * number(grid.pixels() as u16);
        if let Bend::Sharp(width) = rim.bend
            && !(width.to_setup() < side)
        {
            return;
        }
        // Twice for each side.
        let sides = (to - from).length() / side;
        let count = (sides + sides).floor_to_i32().clamp(0, MOST_PLACES) as u16 + 1;
        let step = (to - from) * number(count).recip();
        for i in 0..count {
            let place = shown(from + step * (number(i) + half)).and_then(|point| place_of(viewport, point));
            if let Some((x, y)) = place {
                self.add(x.floor_to_i32(), y.floor_to_i32(), (renderer.width, renderer.height));
            }
        }
    }

    /// Adds the square around a pixel of a picture of this width and height.
    fn add(&mut self, x: i32, y: i32, (width, height): (u16, u16)) {
        if (0..i32::from(width)).contains(&x) && (0..i32::from(height)).contains(&y) {
            let (word, bit) = self.place(x as u32, y as u32);
            if let Some(word) = self.bits.get_mut(word) {
                *word |= bit;
            }
        }
    }

    /// The word and the bit of a pixel's square.
    fn place(&self, x: u32, y: u32) -> (usize, u32) {
        let place = (y >> self.shift) as usize * self.columns + (x >> self.shift) as usize;
        (place >> 5, 1 << (place & 31))
    }

    /// Whether a rim may be seen in the cell that begins at this pixel.
    pub(super) fn hold(&self, left: u32, top: u32) -> bool {
        let (word, bit) = self.place(left, top);
        self.bits.get(word).is_some_and(|word| word & bit != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_hold_the_pixels_in_them() {
        let mut places = RimPlaces::none(320, 240, Grid::Eight);
        for (x, y) in [(0, 0), (47, 8), (319, 239), (320, 5), (-1, 5), (5, 240)] {
            places.add(x, y, (320, 240));
        }
        let cells = (0..240).step_by(8).flat_map(|top| (0..320).step_by(8).map(move |left| (left, top)));
        let held: Vec<(u32, u32)> = cells.filter(|(left, top)| places.hold(*left, *top)).collect();
        assert_eq!(held, [(0, 0), (40, 8), (312, 232)]);
    }

    #[test]
    fn large_pictures_have_larger_squares() {
        let mut places = RimPlaces::none(u16::MAX, u16::MAX, Grid::Four);
        assert!(!places.hold(65_532, 65_532));
        places.add(65_534, 65_534, (u16::MAX, u16::MAX));
        assert!(places.hold(65_532, 65_532) && !places.hold(0, 65_532) && !places.hold(65_532, 0));
    }
}
