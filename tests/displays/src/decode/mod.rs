//! From the bytes on a bus to what the panel shows, one family of panels a file.

pub mod chain;
pub mod memory;
pub mod pages;
pub mod planes;
pub mod scan;
pub mod serial_lcd;
pub mod sign;
pub mod windows;
