//! From the bytes on a bus to what the panel shows, one family of controllers a file.

pub mod pages;
pub mod planes;
pub mod windows;
