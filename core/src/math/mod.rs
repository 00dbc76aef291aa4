//! Numbers, vectors and rays.

mod aabb;
mod fixed;
pub(crate) mod float;
mod float_real;
mod four;
mod interval;
mod lattice;
pub(crate) mod power;
mod ray;
mod real;
mod roots;
mod rotation;
mod scale;
#[cfg(feature = "serde")]
mod triple;
mod vec3;

pub use aabb::Aabb;
pub use fixed::{Factor, Fixed, FixedLinear, FixedProduct};
pub use float_real::FloatLinear;
pub use four::FourRays;
pub(crate) use four::{FOUR_AT_ONCE, choose, each};
pub use interval::Interval;
pub use lattice::LatticeCoordinate;
pub use ray::Ray;
#[doc(hidden)]
pub use real::Kernel;
pub use real::{Linear, Product, Real};
pub(crate) use roots::{cubic_roots, root_between};
pub(crate) use rotation::{Rotation, turned};
pub use scale::{Extent, Scale};
#[cfg(feature = "serde")]
pub(crate) use triple::triple;
pub use vec3::Vec3;
