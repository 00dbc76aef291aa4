//! Counting the instructions of rendering alone, while what is rendered goes to a display.

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Dimensions;
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::primitives::Rectangle;
use rayline::Digest;

use crate::InstructionCounter;

/// A display that counts what is done between its calls, and keeps a digest of what it is given.
#[derive(Debug)]
pub(crate) struct Meter<'a, I, D> {
    counter: &'a I,
    display: &'a mut D,
    digest: Digest,
    instructions: u64,
    resumed: u64,
}

impl<'a, I: InstructionCounter, D: DrawTarget> Meter<'a, I, D> {
    /// Counts nothing until [`resume`](Self::resume).
    pub(crate) fn new(counter: &'a I, display: &'a mut D) -> Self {
        Self { counter, display, digest: Digest::new(), instructions: 0, resumed: 0 }
    }

    /// Goes on counting. A function of its own, because a profile finds by it where counting goes on.
    #[inline(never)]
    pub(crate) fn resume(&mut self) {
        self.resumed = self.counter.now();
    }

    /// Stops counting. A function of its own, because a profile finds by it where counting stops.
    #[inline(never)]
    pub(crate) fn pause(&mut self) {
        self.instructions += self.counter.now() - self.resumed;
    }

    /// The instructions that were counted.
    pub(crate) fn instructions(&self) -> u64 {
        self.instructions
    }

    /// The digest of all that was drawn.
    pub(crate) fn digest(&self) -> u64 {
        self.digest.value()
    }
}

impl<I, D: DrawTarget> Dimensions for Meter<'_, I, D> {
    fn bounding_box(&self) -> Rectangle {
        self.display.bounding_box()
    }
}

impl<I: InstructionCounter, D> DrawTarget for Meter<'_, I, D>
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
