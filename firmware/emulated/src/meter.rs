//! Counts the instructions of rendering alone, without those of the display that the pixels go to.

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Dimensions;
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::primitives::Rectangle;
use rayline::Digest;

use crate::Counter;

/// A display that counts the instructions between its calls, and keeps a digest of its pixels.
#[derive(Debug)]
pub(crate) struct Meter<'a, D> {
    counter: Counter,
    display: &'a mut D,
    digest: Digest,
    /// Instructions that were counted up to the last pause.
    instructions: u64,
    /// The counter's value at the last call of `resume`.
    resumed: u64,
}

impl<'a, D: DrawTarget> Meter<'a, D> {
    /// A meter that is paused: call [`resume`](Self::resume) to count.
    pub(crate) fn new(counter: Counter, display: &'a mut D) -> Self {
        Self { counter, display, digest: Digest::new(), instructions: 0, resumed: 0 }
    }

    /// Counts from here on.
    // Not inlined: `cargo boards --profile` finds this function by its name, and profiles from there on.
    #[inline(never)]
    pub(crate) fn resume(&mut self) {
        self.resumed = self.counter.now();
    }

    /// Stops counting.
    // Not inlined: `cargo boards --profile` finds this function by its name, and profiles up to there.
    #[inline(never)]
    pub(crate) fn pause(&mut self) {
        self.instructions += self.counter.now() - self.resumed;
    }

    /// The instructions that were counted.
    pub(crate) fn instructions(&self) -> u64 {
        self.instructions
    }

    /// The digest of all pixels that were drawn.
    pub(crate) fn digest(&self) -> u64 {
        self.digest.value()
    }
}

impl<D: DrawTarget> Dimensions for Meter<'_, D> {
    fn bounding_box(&self) -> Rectangle {
        self.display.bounding_box()
    }
}

impl<D> DrawTarget for Meter<'_, D>
where
    D: DrawTarget<Color: ToBytes<Bytes: AsRef<[u8]>>>,
{
    type Color = D::Color;
    type Error = D::Error;

    fn draw_iter<P>(&mut self, pixels: P) -> Result<(), D::Error>
    where
        P: IntoIterator<Item = Pixel<D::Color>>,
    {
        self.pause();
        let digest = &mut self.digest;
        let pixels =
            pixels.into_iter().inspect(|Pixel(_, color)| digest.update(color.to_le_bytes().as_ref()));
        self.display.draw_iter(pixels)?;
        self.resume();
        Ok(())
    }

    fn fill_contiguous<C>(&mut self, area: &Rectangle, colors: C) -> Result<(), D::Error>
    where
        C: IntoIterator<Item = D::Color>,
    {
        self.pause();
        let digest = &mut self.digest;
        let colors = colors.into_iter().inspect(|color| digest.update(color.to_le_bytes().as_ref()));
        self.display.fill_contiguous(area, colors)?;
        self.resume();
        Ok(())
    }
}
