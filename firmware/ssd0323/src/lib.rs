//! Driver for OLED panels of 128×64 pixels in 16 grays with the controller SSD0323 (Solomon Systech,
//! "SSD0323: 128 x 80, 16 Gray Scale Dot Matrix OLED/PLED Segment/Common Driver with Controller", 2005), over
//! SPI.
//!
//! There is no frame buffer. An area is drawn through one window of the panel, and each of its lines is one
//! burst on the bus.
//!
//! Two neighbors share a byte of the panel's memory, which cannot be read over SPI: a pixel can only be drawn
//! together with its partner. Pixels 0 and 1 are partners, 2 and 3, and so on. Drawing a pixel without its
//! partner is the error [`Error::Unpaired`], so that no neighbor is overwritten.

#![cfg_attr(not(test), no_std)]

mod error;
mod panel;

#[cfg(test)]
mod tests;

pub use error::Error;
pub use panel::{HEIGHT, Ssd0323, WIDTH};
