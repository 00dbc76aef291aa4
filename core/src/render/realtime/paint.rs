//! Colors of a cell, from its samples.

use super::Sample;
use super::cell::{Cell, Corners};
use crate::render::{DisplayColor, Dither, Quantizer, Settings, Tone};

/// Writes the colors of a cell into a band of lines.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paint<'s> {
    pub(super) settings: &'s Settings,
    /// Pixels of a line of the band.
    pub(super) width: usize,
    /// Pixels of a line of the band that lie to the left of the cell.
    pub(super) drawn: usize,
    /// The cell's upper left pixel in the picture, and its size in pixels.
    pub(super) left: u32,
    pub(super) top: u32,
    pub(super) size: usize,
    /// Whether samples belong to the corners of pixels, not to their centers.
    pub(super) is_smooth: bool,
}

impl Paint<'_> {
    /// A cell of one color.
    pub(super) fn blank<C: DisplayColor>(&self, colors: &mut [C], sample: Sample) {
        let corners = Corners::all(sample);
        if self.settings.dither != Dither::None {
            return self.smooth(colors, &corners);
        }
        let color = C::from_tone(sample.tone(), &self.quantizer());
        self.rows(colors, |_, row| row.fill(color));
    }

    /// A cell whose pixels are interpolated between its corners.
    pub(super) fn smooth<C: DisplayColor>(&self, colors: &mut [C], corners: &Corners) {
        let shift = self.size.trailing_zeros();
        let (mut left, mut right) = (corners.top_left.tone(), corners.top_right.tone());
        let down_left = left.step_toward(corners.bottom_left.tone(), shift);
        let down_right = right.step_toward(corners.bottom_right.tone(), shift);
        if self.is_smooth {
            left = left.middle(left.after(down_left));
            right = right.middle(right.after(down_right));
        }
        self.rows(colors, |y, row| {
            let (mut tone, step) = (left, left.step_toward(right, shift));
            if self.is_smooth {
                tone = tone.middle(tone.after(step));
            }
            let tones = core::iter::repeat_with(|| {
                let next = tone.after(step);
                core::mem::replace(&mut tone, next)
            });
            self.paint(row, y, tones);
            (left, right) = (left.after(down_left), right.after(down_right));
        });
    }

    /// A cell whose samples are all known.
    pub(super) fn refined<C: DisplayColor>(&self, colors: &mut [C], cell: &Cell) {
        self.rows(colors, |y, row| self.paint(row, y, cell.row(y).iter().map(|sample| sample.tone())));
    }

    /// A cell whose pixels have these tones.
    #[cfg(any(feature = "distributed", feature = "looks"))]
    pub(super) fn tones<C: DisplayColor>(
        &self,
        colors: &mut [C],
        mut tone: impl FnMut(usize, usize) -> Tone,
    ) {
        self.rows(colors, |y, row| self.paint(row, y, (0..self.size).map(|x| tone(x, y))));
    }

    /// A row of pixels.
    #[inline]
    fn paint<C: DisplayColor>(&self, row: &mut [C], y: usize, tones: impl Iterator<Item = Tone>) {
        if self.settings.dither == Dither::None {
            let quantizer = self.quantizer();
            for (pixel, tone) in row.iter_mut().zip(tones) {
                *pixel = C::from_tone(tone, &quantizer);
            }
        } else {
            for (x, (pixel, tone)) in row.iter_mut().zip(tones).enumerate() {
                *pixel = self.dithered(x, y, tone);
            }
        }
    }

    // Called from `smooth` and `refined`: one copy is enough.
    fn dithered<C: DisplayColor>(&self, x: usize, y: usize, tone: Tone) -> C {
        let quantizer =
            Quantizer::new(self.settings, (self.left + x as u32) as u16, (self.top + y as u32) as u16);
        C::from_tone(tone, &quantizer)
    }

    /// For colors that are not dithered.
    #[inline]
    fn quantizer(&self) -> Quantizer {
        Quantizer::nearest(self.settings.transfer)
    }

    /// Calls `paint` with each line of the cell and the pixels that it has in the band.
    #[inline]
    fn rows<C>(&self, colors: &mut [C], mut paint: impl FnMut(usize, &mut [C])) {
        let mut rest = colors;
        for y in 0..self.size {
            let Some((line, more)) = rest.split_at_mut_checked(self.width) else { return };
            rest = more;
            let end = (self.drawn + self.size).min(self.width);
            if let Some(row) = line.get_mut(self.drawn..end) {
                paint(y, row);
            }
        }
    }
}
