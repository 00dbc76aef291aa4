//! Form factors: the share of the light from all around a place that one patch sends there.

use super::Vector;

/// The form factor of a small patch for a place on a surface: `cos cos' area / (π distance²)`, 0 where one is
/// behind the other.
pub(super) fn of_point(
    (place, normal): (Vector, Vector),
    (patch, patch_normal, area): (Vector, Vector, f64),
) -> f64 {
    let toward = patch - place;
    let squared = toward.length_squared();
    let (cosine, behind) = (normal.dot(toward), -patch_normal.dot(toward));
    if cosine <= 0.0 || behind <= 0.0 || squared <= 0.0 {
        return 0.0;
    }
    cosine * behind * area / (core::f64::consts::PI * squared * squared)
}

/// The form factor of a polygon for a place on a surface, without the part behind the surface: Lambert's
/// formula of 1760 (Baum, Rushmeier and Winget, "Improving Radiosity Solutions through the Use of
/// Analytically Determined Form-Factors", SIGGRAPH 1989). It does not matter from which side the polygon is
/// seen.
pub(super) fn of_polygon((place, normal): (Vector, Vector), corners: &[Vector]) -> f64 {
    let corners = above(corners.iter().map(|corner| *corner - place), normal);
    let units: Vec<_> = corners.iter().filter_map(|corner| corner.normalized()).collect();
    let edges = units.iter().zip(units.iter().cycle().skip(1));
    let sum: f64 = edges
        .map(|(a, b)| {
            let (across, sine) = a.cross(*b).unit_and_length();
            if sine > 0.0 { sine.atan2(a.dot(*b)) * across.dot(normal) } else { 0.0 }
        })
        .sum();
    sum.abs() / core::f64::consts::TAU
}

/// The part of a polygon on the side of a plane through the origin to which its normal points (Sutherland and
/// Hodgman, "Reentrant Polygon Clipping", 1974).
fn above(corners: impl Iterator<Item = Vector>, normal: Vector) -> Vec<Vector> {
    let corners: Vec<_> = corners.collect();
    let mut left = Vec::with_capacity(corners.len() + 1);
    for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let (low, high) = (normal.dot(*from), normal.dot(*to));
        if low >= 0.0 {
            left.push(*from);
        }
        if (low >= 0.0) != (high >= 0.0) {
            left.push(*from + (*to - *from) * (low / (low - high)));
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The form factor between two unit squares: the mean over the first of that of the second.
    fn between(place: impl Fn(f64, f64) -> Vector, normal: Vector, square: [Vector; 4]) -> f64 {
        const PLACES: usize = 64;
        let at = |index: usize| (index as f64 + 0.5) / PLACES as f64;
        let places = (0..PLACES * PLACES).map(|index| place(at(index % PLACES), at(index / PLACES)));
        places.map(|place| of_polygon((place, normal), &square)).sum::<f64>() / (PLACES * PLACES) as f64
    }

    /// Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", C-11 and C-14.
    #[test]
    fn unit_squares_have_the_form_factors_of_the_textbooks() {
        let v = Vector::new;
        let floor = |x, z| v(x, 0.0, z);
        let up = v(0.0, 1.0, 0.0);
        let opposite = [v(0.0, 1.0, 0.0), v(1.0, 1.0, 0.0), v(1.0, 1.0, 1.0), v(0.0, 1.0, 1.0)];
        let got = between(floor, up, opposite);
        assert!((got - 0.199_825).abs() < 2e-5, "opposite: {got}");
        let beside = [v(0.0, 0.0, 0.0), v(0.0, 0.0, 1.0), v(0.0, 1.0, 1.0), v(0.0, 1.0, 0.0)];
        let got = between(floor, up, beside);
        assert!((got - 0.200_044).abs() < 2e-5, "at a right angle: {got}");
        // Half of this square is below the floor.
        let through = beside.map(|corner| v(0.0, corner.y * 2.0 - 1.0, corner.z));
        assert!((between(floor, up, through) - got).abs() < 1e-12);
    }

    #[test]
    fn far_patches_are_points() {
        let v = Vector::new;
        let place = (v(0.0, 0.0, 0.0), v(0.0, 1.0, 0.0));
        let square = [v(3.0, 4.0, -0.1), v(3.2, 4.0, -0.1), v(3.2, 4.0, 0.1), v(3.0, 4.0, 0.1)];
        let point = of_point(place, (v(3.1, 4.0, 0.0), v(0.0, -1.0, 0.0), 0.04));
        assert!((of_polygon(place, &square) / point - 1.0).abs() < 1e-3);
        assert_eq!(of_point(place, (v(3.1, 4.0, 0.0), v(0.0, 1.0, 0.0), 0.04)), 0.0);
        assert_eq!(of_point(place, (v(3.1, -4.0, 0.0), v(0.0, 1.0, 0.0), 0.04)), 0.0);
    }
}
