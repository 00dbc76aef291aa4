//! Driver for OLED panels of 128×64 pixels in 16 grays with the controller SSD0323 (Solomon Systech,
//! "SSD0323: 128 x 80, 16 Gray Scale Dot Matrix OLED/PLED Segment/Common Driver with Controller", 2005), over
//! SPI.
//!
//! There is no frame buffer. An area is one window of the panel, and each of its lines one burst on the bus.
//!
//! Two neighbors share a byte of the panel's memory, which cannot be read over SPI: a pixel can only be drawn
//! together with its partner. Pixel 0 is the partner of pixel 1, 2 of 3, and so on. What would draw one
//! without the other is [`Error::Unpaired`], so that no neighbor is ever overwritten.

#![cfg_attr(not(test), no_std)]

mod error;
mod panel;

#[cfg(test)]
mod tests;

pub use error::Error;
pub use panel::{HEIGHT, Ssd0323, WIDTH};
