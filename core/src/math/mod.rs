//! Numbers, vectors and rays.

mod aabb;
pub(crate) mod float;
mod interval;
mod ray;
mod real;
mod vec3;

pub use aabb::Aabb;
pub use interval::Interval;
pub use ray::Ray;
pub use real::Real;
pub use vec3::Vec3;
