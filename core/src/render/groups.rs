//! Lines in groups: squares of neighboring pixels that are traced side by side, or rows if one line is lent.
//!
//! The rays of a square lie closer together than the rays of a row, so several lines at once take less time
//! than the same lines one by one.

#[cfg(feature = "looks")]
use super::contours::Ink;
use super::pixel::Aim;
use super::region::Region;
use super::{DisplayColor, Light16, Quantizer, Renderer};
use crate::integrator::{Lane, Lanes, PixelGroup, RayBudget, WIDTH};
use crate::limits::LINES_AT_ONCE;
use crate::math::Real;
use crate::probe::Probe;
use crate::sampling::{CENTER, RayNumbers};
use crate::shape::Geometry;

/// Renders lines in groups of pixels.
pub(super) struct Groups<'r, 'p, 'm, R: Real, S: Geometry + 'm> {
    renderer: &'r Renderer<'p, 'm, R, S>,
    group: PixelGroup<'p, 'm, R, S>,
}

impl<'r, 'p, 'm, R: Real, S: Geometry + 'm> Groups<'r, 'p, 'm, R, S> {
    /// `None` if groups would not be faster, or if the probe needs the events of one pixel after the other.
    #[inline(always)]
    pub(super) fn new(renderer: &'r Renderer<'p, 'm, R, S>, probe: &impl Probe<R>) -> Option<Self> {
        if probe.needs_order() || renderer.settings.sampling.samples > 1 || renderer.is_distributed {
            return None;
        }
        Some(Self { renderer, group: PixelGroup::new(renderer.scene)? })
    }

    /// Renders whole lines of a region of the picture, until all are done or `budget_rays` are spent; at
    /// least one group. `traced` is the number of pixels that are done. Returns the rays that it spent.
    pub(super) fn trace<C: DisplayColor>(
        &mut self,
        region: &Region,
        lines: &mut [C],
        traced: &mut usize,
        budget_rays: u32,
        probe: &mut impl Probe<R>,
    ) -> u32 {
        // Filled once, not for each group: lanes are large.
        let mut lanes = Lanes::new();
        while lanes.push(Lane::new()).is_ok() {}
        let mut spent: u32 = 0;
        while *traced < lines.len() {
            let group = Group::after(*traced, lines.len(), region.width() as usize);
            spent = spent.saturating_add(self.trace_group(&group, &mut lanes, region, lines, probe));
            *traced = traced.saturating_add(group.width * group.height);
            if spent >= budget_rays {
                break;
            }
        }
        spent
    }

    /// Renders one group. Returns the rays that it spent.
    #[inline(always)]
    fn trace_group<C: DisplayColor>(
        &mut self,
        group: &Group,
        lanes: &mut Lanes<'m, R>,
        region: &Region,
        lines: &mut [C],
        probe: &mut impl Probe<R>,
    ) -> u32 {
        let Renderer { settings, viewport, limits, .. } = self.renderer;
        let rays_per_pixel = settings.rays_per_pixel;
        let lanes = lanes.get_mut(..group.width * group.height).unwrap_or_default();
        for (lane, (x, down)) in lanes.iter_mut().zip(group.pixels()) {
            let (x, y) = region.pixel(x, down);
            let ray = viewport.ray(
                viewport.across((x, CENTER)),
                self.renderer.row(y, Aim::Area),
                &RayNumbers::NONE,
            );
            lane.begin(ray, RayBudget(rays_per_pixel));
        }
        self.group.trace(lanes, limits, probe);
        let mut spent: u32 = 0;
        #[cfg(feature = "looks")]
        let mut inks = [Ink::NONE; WIDTH];
        #[cfg(feature = "looks")]
        {
            let corner = region.pixel(group.left, group.top);
            let rays = self.renderer.ink_of_group(corner, (group.width, group.height), &mut inks);
            spent = spent.saturating_add(rays);
        }
        for (lane, (column, down)) in lanes.iter().zip(group.pixels()) {
            spent = spent.saturating_add(rays_per_pixel.saturating_sub(lane.rays_left().0));
            if let Some(pixel) = lines.get_mut(down * region.width() as usize + column) {
                let (x, y) = region.pixel(column, down);
                let quantizer = Quantizer::new(settings, x, y);
                let light = Light16::new(self.renderer.toned(lane.light()));
                #[cfg(feature = "looks")]
                let light = {
                    let place = (down - group.top) * group.width + column - group.left;
                    self.renderer.inked(light, inks.get(place).copied().unwrap_or(Ink::NONE))
                };
                *pixel = C::from_light(light, &quantizer);
            }
        }
        spent
    }
}

/// A rectangle of pixels in a few lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Group {
    left: usize,
    top: usize,
    width: usize,
    height: usize,
}

impl Group {
    /// The group that begins after `traced` of the `pixels` of a few lines of this `width`. Groups follow
    /// from left to right, then from top to bottom.
    fn after(traced: usize, pixels: usize, width: usize) -> Self {
        let lines_of = |pixels: usize| pixels.checked_div(width).unwrap_or(0);
        let top = lines_of(traced) / LINES_AT_ONCE * LINES_AT_ONCE;
        let height = lines_of(pixels).saturating_sub(top).clamp(1, LINES_AT_ONCE);
        let left = traced.saturating_sub(top * width).checked_div(height).unwrap_or(0);
        let most = WIDTH.checked_div(height).unwrap_or(1);
        Self { left, top, width: width.saturating_sub(left).clamp(1, most), height }
    }

    /// Column and line of each pixel. Each pixel lies beside the one before it.
    fn pixels(self) -> impl Iterator<Item = (usize, usize)> {
        let Self { left, top, width, height } = self;
        (0..height).flat_map(move |down| {
            (0..width).map(move |i| {
                let right = if down % 2 == 0 { i } else { width - 1 - i };
                (left + right, top + down)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_cover_each_pixel_once() {
        for (width, height) in [(1, 1), (3, 9), (16, 4), (17, 1), (37, 2), (5, 7), (64, 64)] {
            let pixels = width * height;
            let (mut traced, mut times) = (0, vec![0; pixels]);
            while traced < pixels {
                let group = Group::after(traced, pixels, width);
                let places: Vec<_> = group.pixels().collect();
                assert!(!places.is_empty() && places.len() <= WIDTH, "{group:?}");
                for pair in places.windows(2) {
                    assert_eq!(pair[0].0.abs_diff(pair[1].0) + pair[0].1.abs_diff(pair[1].1), 1, "{pair:?}");
                }
                places.iter().for_each(|(x, y)| times[y * width + x] += 1);
                traced += places.len();
            }
            assert!(times.iter().all(|times| *times == 1), "{width}x{height}: {times:?}");
        }
    }
}
