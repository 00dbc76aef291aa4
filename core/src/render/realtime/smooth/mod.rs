//! Smooth edges: the color of a pixel from what the rays through its four corners saw.
//!
//! A pixel whose corners saw the same things has the mean of their tones. If they saw two different things, a
//! straight edge parts the pixel, as in marching squares (Lorensen and Cline, "Marching Cubes", SIGGRAPH
//! 1987). The share of the pixel on each side of the edge is its *coverage* (Carpenter, "The A-buffer, an
//! Antialiased Hidden Surface Method", SIGGRAPH 1984), and the pixel shows that mixture of the two sides'
//! light. If they saw more, as where squares of a checkered floor meet, each corner has a rectangle of the
//! pixel.
//!
//! An edge crosses a side of a pixel at f / (f - g), where f and g are the distances at which the rays
//! through both ends of the side pass the outline ([`crossing`]): this is f / |∇f| along the side. The
//! edges of textures are found on the surface. Where nothing is known of an edge, it crosses in the middle.

mod crossing;

use crossing::ShadowsNear;

use super::cell::Cell;
use super::grid::beyond;
use super::pixel_source::PixelSource;
use super::sample::Sample;
use super::tracer::{CellView, Tracer};
use crate::camera::RayRow;
use crate::integrator::Sight;
use crate::math::{Ray, Real};
use crate::prepared::ObjectSet;
use crate::probe::Probe;
use crate::render::pixel::Aim;
use crate::render::{Light16, Tone};
use crate::sampling::RayNumbers;
use crate::shape::Geometry;

/// The outlines that may cross a cell, found when the first edge of the cell needs them.
#[derive(Clone, Copy, Debug)]
pub(super) struct OutlinesNear<R> {
    /// The size of the cell in pixels.
    size: usize,
    objects: Option<ObjectSet>,
    shadows: Option<Option<ShadowsNear<R>>>,
}

impl<R> OutlinesNear<R> {
    /// No outlines and shadows yet, in a cell of this size in pixels.
    pub(super) const fn in_cell(size: usize) -> Self {
        Self { size, objects: None, shadows: None }
    }
}

/// Edges between tones that differ by less in all channels, in 65536ths of what a display can show, are not
/// visible.
const VISIBLE: u16 = 512;

/// The length of a side of a pixel.
const WHOLE: u32 = 256;
/// The place where an edge crosses a side if no outline is known.
const MIDDLE: u32 = WHOLE / 2;

/// A corner of a pixel: its place in the cell, and its sample.
type Corner = ((usize, usize), Sample);

/// The corners of a pixel.
#[derive(Clone, Copy, Debug)]
struct Corners {
    top_left: Corner,
    top_right: Corner,
    bottom_left: Corner,
    bottom_right: Corner,
}

/// The edges in a pixel, as far as its corners show them.
#[derive(Clone, Copy, Debug)]
enum EdgesInside {
    /// All corners saw the same things.
    None,
    One(Parted),
    Several,
}

/// A straight edge that parts a pixel.
#[derive(Clone, Copy, Debug)]
struct Parted {
    /// The two sides that it crosses, each from this side of the edge to the other one.
    sides: [[Corner; 2]; 2],
    shape: PartShape,
}

/// The part of a pixel on this side of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PartShape {
    /// One corner.
    Triangle,
    /// Two corners.
    Trapezoid,
}

impl Corners {
    fn of(cell: &Cell, (x, y): (usize, usize)) -> Self {
        let corner = |x: usize, y: usize| ((x, y), cell.get(x, y));
        Self {
            top_left: corner(x, y),
            top_right: corner(x + 1, y),
            bottom_left: corner(x, y + 1),
            bottom_right: corner(x + 1, y + 1),
        }
    }

    fn edges(&self) -> EdgesInside {
        let Self { top_left: a, top_right: b, bottom_left: c, bottom_right: d } = *self;
        let parted = |first, second, shape| EdgesInside::One(Parted { sides: [first, second], shape });
        match (differ(a, b), differ(c, d), differ(a, c), differ(b, d)) {
            (false, false, false, false) => EdgesInside::None,
            (true, false, true, false) => parted([a, b], [a, c], PartShape::Triangle),
            (true, false, false, true) => parted([b, a], [b, d], PartShape::Triangle),
            (false, true, true, false) => parted([c, d], [c, a], PartShape::Triangle),
            (false, true, false, true) => parted([d, c], [d, b], PartShape::Triangle),
            (true, true, false, false) => parted([a, b], [c, d], PartShape::Trapezoid),
            (false, false, true, true) => parted([a, c], [b, d], PartShape::Trapezoid),
            _ => EdgesInside::Several,
        }
    }

    fn mean(&self) -> Tone {
        let Self { top_left: a, top_right: b, bottom_left: c, bottom_right: d } = *self;
        middle(a, b).middle(middle(c, d))
    }
}

/// Whether two corners saw different things.
fn differ((_, a): Corner, (_, b): Corner) -> bool {
    a.marks_differ(b, Sample::DIGESTS)
}

fn middle(a: Corner, b: Corner) -> Tone {
    a.1.tone().middle(b.1.tone())
}

impl Parted {
    /// The tones on this side of the edge and on the other one: of the corners next to the edge.
    fn tones(&self) -> [Tone; 2] {
        let [[here, there], [also_here, also_there]] = self.sides;
        [middle(here, also_here), middle(there, also_there)]
    }

    /// The share of the pixel on this side, in 32768ths, from the places where the edge crosses the sides.
    fn coverage(&self, [first, second]: [u32; 2]) -> u32 {
        match self.shape {
            PartShape::Triangle => (first * second) >> 2,
            PartShape::Trapezoid => (first + second) << 6,
        }
    }
}

impl<R: Real, S: Geometry, P: Probe<R>> Tracer<'_, CellView<'_, '_, R, S>, P> {
    /// The tone of the pixel whose upper left corner is this point of a cell. If the cell is one whose points
    /// are all traced, for their tones alone, it is the mean light of the corners.
    pub(super) fn smooth_tone(
        &mut self,
        cell: &Cell,
        (x, y): (usize, usize),
        near: &mut OutlinesNear<R>,
        is_all_traced: bool,
    ) -> Tone {
        let corners = Corners::of(cell, (x, y));
        if is_all_traced {
            return self.mixed(corners);
        }
        let parted = match corners.edges() {
            EdgesInside::None => return corners.mean(),
            EdgesInside::One(parted) => parted,
            EdgesInside::Several => {
                return self.sampled_tone((x, y)).unwrap_or_else(|| self.shared(corners, near));
            }
        };
        let [here, there] = parted.tones();
        if !here.differs(there, VISIBLE) {
            return self.sampled_tone((x, y)).unwrap_or_else(|| corners.mean());
        }
        let crossings = parted.sides.map(|side| self.crossing(side, near));
        if crossings.contains(&None)
            && let Some(tone) = self.sampled_tone((x, y))
        {
            return tone;
        }
        let coverage = parted.coverage(crossings.map(|place| place.unwrap_or(MIDDLE)));
        self.mix([there, here], coverage)
    }

    /// The light of a pixel that several edges part: of four rectangles, one for each corner, that meet where
    /// the edges cross the sides on average.
    fn shared(&self, corners: Corners, near: &mut OutlinesNear<R>) -> Tone {
        let Corners { top_left, top_right, bottom_left, bottom_right } = corners;
        let mut middle = |sides: [[Corner; 2]; 2]| {
            let edges = sides.into_iter().filter(|[from, to]| differ(*from, *to));
            let add = |(sum, count), side| (sum + self.crossing(side, near).unwrap_or(MIDDLE), count + 1);
            let (sum, count) = edges.fold((0u32, 0u32), add);
            sum.checked_div(count).unwrap_or(MIDDLE)
        };
        let across = middle([[top_left, top_right], [bottom_left, bottom_right]]);
        let down = middle([[top_left, bottom_left], [top_right, bottom_right]]);
        self.halves(corners, [across, down].map(|first| (WHOLE - first) << 7))
    }

    /// The mean light of all corners.
    fn mixed(&self, corners: Corners) -> Tone {
        self.halves(corners, [1 << 14; 2])
    }

    /// The light of four rectangles: these shares of the right and of the lower half, in 32768ths.
    fn halves(&self, corners: Corners, [right, lower]: [u32; 2]) -> Tone {
        let Corners { top_left, top_right, bottom_left, bottom_right } = corners;
        let rows = [[top_left, top_right], [bottom_left, bottom_right]];
        self.mix(rows.map(|row| self.mix(row.map(|(_, sample)| sample.tone()), right)), lower)
    }

    /// The tone of a mixture of light: this share of the second tone, in 32768ths, and the rest of the first.
    fn mix(&self, [first, second]: [Tone; 2], share: u32) -> Tone {
        let curve = self.view.renderer.settings.transfer;
        self.tones.mixed(first, self.tones.light(second, curve), share, curve)
    }

    /// The place where an outline that is known crosses the way from one corner to the next, in 256ths of it.
    fn crossing(&self, [from, to]: [Corner; 2], near: &mut OutlinesNear<R>) -> Option<u32> {
        let view = &self.view;
        let scene = view.renderer.scene;
        if !view.renderer.has_sharp_outlines() {
            return None;
        }
        let among = view.among.common(scene.all());
        // The angle of a cell, which is more than that from the middle to a corner.
        let size = view.renderer.viewport.pixel() * R::Setup::from_u16(near.size as u16);
        let (angle, middle) = (R::from_setup(size), near.size / 2);
        let rays = || [from, to].map(|(place, _)| self.ray(place));
        let place = if from.1.path() == to.1.path() {
            let find = || crossing::shadows_near(scene, among, &self.ray((middle, middle)), angle);
            let near = near.shadows.get_or_insert_with(find).as_ref()?;
            crossing::of_shadow(scene, near, rays())
        } else {
            let find = || crossing::outlines_near(scene, among, &self.ray((middle, middle)), angle);
            let near = *near.objects.get_or_insert_with(find);
            if near.is_empty() {
                return None;
            }
            let rays = rays();
            crossing::of_outline(scene, near, rays).or_else(|| crossing::of_texture(scene, among, rays))
        };
        Some((place?.to_q16() >> 8).min(WHOLE))
    }

    /// The ray through a point of the cell.
    fn ray(&self, (x, y): (usize, usize)) -> Ray<R> {
        let (view, viewport) = (&self.view, &self.view.renderer.viewport);
        let row = view.rows.get(y).copied().unwrap_or(RayRow::TOP);
        let across = viewport.across((beyond(view.left, x), Aim::Corner.place()));
        viewport.ray(across, row, &RayNumbers::NONE)
    }

    /// The tone of all samples of a pixel; `None` if a pixel has one sample, if the points have taken all
    /// samples already, or if no rays are left.
    fn sampled_tone(&mut self, (x, y): (usize, usize)) -> Option<Tone> {
        let view = &self.view;
        let renderer = view.renderer;
        if renderer.settings.sampling.samples <= 1 || renderer.is_distributed || !self.may_trace() {
            return None;
        }
        let pixel = renderer.pixel_at(beyond(view.left, x), beyond(view.top, y));
        let sight = Sight::among(view.among);
        let (light, rays) = renderer.light_in(renderer.scene, view.limits, pixel, sight, self.probe);
        self.spend(rays);
        Some(self.tones.tone(Light16::new(light), renderer.settings.transfer))
    }
}
