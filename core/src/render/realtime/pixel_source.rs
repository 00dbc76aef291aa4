//! The source of the pixels for the drawing of a cell.

use super::sample::Sample;

/// Traces pixels of one cell, and compares them. Points are counted from the cell's upper left pixel.
pub(super) trait PixelSource {
    /// Traces the pixel at a point.
    fn trace(&mut self, x: usize, y: usize) -> Sample;

    /// Traces the pixel at a point for its tone alone: the digests of the sample are not used.
    fn trace_tone(&mut self, x: usize, y: usize) -> Sample;

    /// The pixel between `a` and `b`, which are `distance` pixels apart: traced, or a copy of the one of the
    /// two that has the same path digest, and so most likely meets the same objects.
    fn trace_between(&mut self, point: (usize, usize), a: Sample, b: Sample, distance: usize) -> Sample;

    /// Whether two pixels at this distance differ so much that something may lie between them.
    fn differ(&self, a: Sample, b: Sample, distance: usize) -> bool;

    /// Whether there are rays left for other pixels than the corners.
    fn may_trace(&self) -> bool;

    /// Whether points are the corners of pixels, so that those on the far sides of a cell belong to it too.
    fn are_corners(&self) -> bool;

    /// The distance from a straight edge up to which pixels are traced, in 1/16 of a pixel.
    fn traced_beside_edge(&self) -> u32;
}
