//! Numbers, vectors and colors as POV-Ray reads them.

use core::fmt;

use rayline::{LinearRgb, Vec3};

pub(super) fn points(vertices: &[Vec3]) -> String {
    vertices.iter().copied().map(point).collect::<Vec<_>>().join(", ")
}

pub(super) fn point(point: Vec3) -> String {
    list(&[point.x, point.y, point.z])
}

pub(super) fn xyz(vector: Vec3<f64>) -> String {
    // Adding 0 turns -0 into 0, which reads better.
    list(&[vector.x, vector.y, vector.z].map(|number| number + 0.0))
}

pub(super) fn rgb(color: LinearRgb) -> String {
    list(&color.channels())
}

pub(super) fn list<T: fmt::Display>(numbers: &[T]) -> String {
    format!("<{}>", numbers.iter().map(T::to_string).collect::<Vec<_>>().join(", "))
}

pub(super) fn unit(vector: Vec3<f64>) -> Vec3<f64> {
    vector * vector.length().recip()
}

/// The matrix that maps the three axes and the origin to these images.
pub(super) fn matrix(images: [Vec3<f64>; 4]) -> String {
    let rows =
        images.map(|image| [image.x, image.y, image.z].map(|number| (number + 0.0).to_string()).join(", "));
    format!("matrix <{}>", rows.join(", "))
}

/// The angles of `rotate`, in degrees.
pub(super) fn degrees(rotation: Vec3) -> String {
    xyz(rotation.to::<f64>() * (180.0 / core::f64::consts::PI))
}
