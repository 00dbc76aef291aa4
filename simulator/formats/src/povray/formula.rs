//! Formulas in POV-Ray's language: functions of x, y and z.

use glam::DVec3;

/// The variables of POV-Ray's functions.
pub(super) const XYZ: [&str; 3] = ["x", "y", "z"];

/// The formula of a linear function of `place`, plus a constant.
pub(super) fn linear(factors: DVec3, constant: f64, place: &[&str]) -> String {
    let terms = place.iter().zip(factors.to_array()).filter(|(_, factor)| *factor != 0.0);
    let mut sum: Vec<String> = terms.map(|(at, factor)| multiple(at, factor)).collect();
    if constant != 0.0 || sum.is_empty() {
        // Adding 0 turns -0 into 0, which reads better.
        sum.push(number(constant + 0.0));
    }
    if let [only] = sum.as_slice() { only.clone() } else { format!("({})", sum.join(" + ")) }
}

fn multiple(at: &str, factor: f64) -> String {
    if factor == 1.0 { at.to_owned() } else { format!("{at}*{}", number(factor)) }
}

fn number(number: f64) -> String {
    if number < 0.0 { format!("({number})") } else { number.to_string() }
}

/// The formula of the fractional part.
pub(super) fn fraction(at: &str) -> String {
    format!("({at} - floor({at}))")
}

/// The formula of the parity of an integer: 0 if it is even, 1 if it is odd.
pub(super) fn parity(whole: &str) -> String {
    format!("mod(abs({whole}), 2)")
}

/// The formula of the angle of (x, y), as a share of a turn from 0 to 1.
pub(super) fn turn(y: &str, x: &str) -> String {
    format!("mod(atan2({y}, {x})/(2*pi) + 1, 1)")
}

/// The formulas of the longitude about the y axis, from x toward -z, and of the latitude.
pub(super) fn globe([x, y, z]: [String; 3]) -> [String; 2] {
    [turn(&format!("(-{z})"), &x), format!("(atan2(sqrt({x}*{x} + {z}*{z}), -{y})/pi)")]
}
