//! Numbers, vectors and rays.

pub(crate) mod float;
mod interval;
mod ray;
mod real;
mod vec3;

pub use interval::Interval;
pub use ray::Ray;
pub use real::Real;
pub use vec3::Vec3;
