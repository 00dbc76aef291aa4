//! Driver for OLED panels of 128×64 pixels in 16 grays with the controller SSD0323 (Solomon Systech,
//! "SSD0323: 128 x 80, 16 Gray Scale Dot Matrix OLED/PLED Segment/Common Driver with Controller", 2005), over
//! SPI: a [`DrawTarget`](embedded_graphics::draw_target::DrawTarget) of embedded-graphics.
//!
//! There is no frame buffer. An area is drawn through one window of the panel, and each of its lines is one
//! burst on the bus.
//!
//! ```
//! use embedded_graphics::mono_font::{MonoTextStyleBuilder, ascii::FONT_6X10};
//! use embedded_graphics::{pixelcolor::Gray4, prelude::*, primitives::Rectangle, text::Text};
//! use embedded_hal::{digital::OutputPin, spi::SpiBus};
//! use rayline_ssd0323::{Error, Setup, Ssd0323};
//!
//! fn show<B: SpiBus, P: OutputPin>(bus: B, data_command: P) -> Result<(), Error<B::Error, P::Error>> {
//!     let mut panel = Ssd0323::with_setup(bus, data_command, Setup::PLAIN.turned())?;
//!     panel.clear(Gray4::BLACK)?;
//!     panel.fill_solid(&Rectangle::new(Point::new(0, 16), Size::new(64, 48)), Gray4::new(5))?;
//!     // With a background, a letter is one area; the letters of this font are six columns wide.
//!     let style = MonoTextStyleBuilder::new().font(&FONT_6X10);
//!     let style = style.text_color(Gray4::WHITE).background_color(Gray4::BLACK).build();
//!     Text::new("16 grays", Point::new(2, 10), style).draw(&mut panel)?;
//!     panel.set_contrast(0x20)
//! }
//! ```
//!
//! # Wiring
//!
//! | panel | processor |
//! |---|---|
//! | clock, data | clock and output of an `SpiBus`: mode 0 or 3, most significant bit first |
//! | D/C | the `OutputPin` that [`Ssd0323::new`] takes: low for commands, high for data |
//! | chip select | a pin of the program, low while it draws; or ground, if nothing else is on the bus |
//! | reset | a pin of the program, which resets the panel before [`Ssd0323::new`] |
//!
//! The driver needs a whole bus, not an `SpiDevice`: between bytes it changes the D/C pin, and waits with
//! `flush` before. On a shared bus, take the bus for as long as you draw.
//!
//! # Pairs of pixels
//!
//! Two neighbors share a byte of the panel's memory, which cannot be read over SPI: a pixel can only be drawn
//! together with its partner. Pixels 0 and 1 are partners, 2 and 3, and so on. Drawing a pixel without its
//! partner is the error [`Error::Unpaired`], so that no neighbor is overwritten.
//!
//! So an area must begin at an even column and be an even number of columns wide. Pictures, filled
//! rectangles, and text with a background and letters of even width can meet this rule. Lines, circles and
//! text without a background cannot: draw these into a
//! [`Framebuffer`](embedded_graphics::framebuffer::Framebuffer) of their size, and draw the framebuffer on
//! the panel.
//!
//! # Orientation, offset and brightness
//!
//! Makers of panels connect the controller's outputs in several ways. [`Setup`] says which, and turns the
//! picture by 180°. If the picture is mirrored, shifted, or has rows or columns in a wrong order, change one
//! field after the other. [`Ssd0323::set_contrast`] and [`Ssd0323::set_on`] work at any time.

#![cfg_attr(not(test), no_std)]

mod error;
mod panel;
mod setup;

#[cfg(test)]
mod tests;

pub use error::Error;
pub use panel::{HEIGHT, Ssd0323, WIDTH};
pub use setup::Setup;

/// The example of the crate's README compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
