//! Which facet is seen at each pixel of a line.

use super::facet::{NONE, PreviewFacet, PreviewPixel, first_from};

/// How far the lines are, and the facets that reach the current one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scan {
    /// The line that comes next.
    line: u16,
    /// How many facets begin above it.
    begun: usize,
    /// The last one of them that has not ended, see [`PreviewFacet::next`].
    active: u16,
}

impl Scan {
    /// Before the first line.
    pub(super) const BEGIN: Self = Self { line: 0, begun: 0, active: NONE };

    /// Finds the facet and the depth at the pixels of a line, from column `left` on. The lines may come in
    /// any order; from top to bottom is the fastest.
    pub(super) fn line(
        &mut self,
        facets: &mut [PreviewFacet],
        y: u16,
        left: u16,
        pixels: &mut [PreviewPixel],
    ) {
        if y < self.line {
            *self = Self::BEGIN;
        }
        self.line = y;
        self.end(facets, y);
        self.begin(facets, y);
        pixels.fill(PreviewPixel::BLANK);
        let mut number = self.active;
        while let Some(facet) = facets.get(usize::from(number)) {
            cover(facet, number, (left, y), pixels);
            number = facet.next;
        }
    }

    /// Takes facets that end above this line out of the list.
    fn end(&mut self, facets: &mut [PreviewFacet], y: u16) {
        let (mut last, mut number) = (NONE, self.active);
        while let Some(facet) = facets.get(usize::from(number)) {
            let next = facet.next;
            let (_, end) = facet.lines();
            if end > y {
                last = number;
            } else {
                match facets.get_mut(usize::from(last)) {
                    Some(last) => last.next = next,
                    None => self.active = next,
                }
            }
            number = next;
        }
    }

    /// Adds those that begin no lower than this line to the list.
    fn begin(&mut self, facets: &mut [PreviewFacet], y: u16) {
        while let Some(facet) = facets.get_mut(self.begun) {
            let (first, end) = facet.lines();
            if first > y {
                break;
            }
            if end > y {
                facet.next = self.active;
                self.active = self.begun as u16;
            }
            self.begun = self.begun.saturating_add(1);
        }
    }
}

/// Enters a facet into the pixels of a line where it is nearer than what they show.
fn cover(facet: &PreviewFacet, number: u16, (left, y): (u16, u16), pixels: &mut [PreviewPixel]) {
    let middle = (u32::from(y) << 4) + 8;
    let [a, b, c] = facet.corners;
    let is_upper = middle < u32::from(b[1]);
    let one = crossing(a, c, middle);
    let other = if is_upper { crossing(a, b, middle) } else { crossing(b, c, middle) };
    let (first, end) = (first_from(one.min(other)).max(left), first_from(one.max(other)));
    // The inverse depth in units of 2⁻³², so that its whole part is the upper half.
    let [x, y] = a.map(i64::from);
    let (right, down) = (i64::from(facet.right), i64::from(facet.down));
    let from_corner = right * ((i64::from(first) << 4) + 8 - x) + down * (i64::from(middle) - y);
    let shift = 32u32.saturating_sub(facet.shift.into());
    let mut inverse_depth =
        (i64::from(facet.inverse_depth) << 32).wrapping_add((from_corner >> 4).wrapping_shl(shift));
    let step = right.wrapping_shl(shift);
    let (first, end) = (first.saturating_sub(left).into(), end.saturating_sub(left).into());
    let end = pixels.len().min(end);
    for pixel in pixels.get_mut(first..end).unwrap_or_default() {
        // Of a facet narrower than a pixel, rounding may bring it out of range.
        let whole = (inverse_depth >> 32).clamp(1, 1 << 30) as u32;
        if whole > pixel.inverse_depth {
            *pixel = PreviewPixel { inverse_depth: whole, facet: number };
        }
        inverse_depth = inverse_depth.wrapping_add(step);
    }
}

/// Where an edge crosses a height that lies between its ends, in 16ths of a pixel: the same for both facets
/// that share the edge.
fn crossing([upper_x, upper_y]: [u16; 2], [lower_x, lower_y]: [u16; 2], height: u32) -> u16 {
    let down = height.saturating_sub(upper_y.into());
    let whole = u32::from(lower_y.saturating_sub(upper_y));
    // At most 65520 · 65520, which fits.
    let across =
        u32::from(lower_x.abs_diff(upper_x)).wrapping_mul(down).checked_div(whole).unwrap_or(0) as u16;
    if lower_x < upper_x { upper_x.saturating_sub(across) } else { upper_x.saturating_add(across) }
}

/// Sorts facets by their first line: by a heap, which takes neither memory nor recursion (Williams,
/// "Algorithm 232: Heapsort", CACM 1964).
pub(super) fn sort(facets: &mut [PreviewFacet]) {
    for root in (0..facets.len() / 2).rev() {
        sift(facets, root);
    }
    for end in (1..facets.len()).rev() {
        if let Ok([first, last]) = facets.get_disjoint_mut([0, end]) {
            core::mem::swap(first, last);
        }
        sift(facets.get_mut(..end).unwrap_or_default(), 0);
    }
}

/// Moves a facet down until none below it comes later.
fn sift(heap: &mut [PreviewFacet], mut root: usize) {
    // Facets that begin on the same line keep the order of the scene.
    let key = |facet: &PreviewFacet| (facet.lines().0, facet.object, facet.part, facet.corners);
    loop {
        let child = root.saturating_mul(2).saturating_add(1);
        let Some(left) = heap.get(child) else { break };
        let right = heap.get(child.saturating_add(1));
        let later =
            if right.is_some_and(|right| key(right) > key(left)) { child.saturating_add(1) } else { child };
        let Ok([parent, later_one]) = heap.get_disjoint_mut([root, later]) else { break };
        if key(parent) >= key(later_one) {
            break;
        }
        core::mem::swap(parent, later_one);
        root = later;
    }
}
