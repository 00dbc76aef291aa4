//! The desktop side of Rayline: scene files, pictures and measurements.

pub mod nff;
