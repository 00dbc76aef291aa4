//! Backgrounds.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DQuat, DVec3};
use rayline::{Background, Encoding, Filter, Image, Panorama, Pixels, Sky};

use super::{color, vector};

/// The light of the background in a direction.
pub(super) fn background(background: &Background<'_>, direction: DVec3) -> DVec3 {
    match *background {
        Background::Solid(solid) => color(solid),
        Background::Gradient(&Sky { up, zenith, horizon, nadir }) => {
            let height = vector(up).normalize().dot(direction);
            let end = if height < 0.0 { nadir } else { zenith };
            color(horizon).lerp(color(end), height.abs())
        }
        Background::Image(&Panorama { ref image, rotation }) => {
            let turned = DQuat::from_rotation_z(f64::from(rotation.z))
                * DQuat::from_rotation_y(f64::from(rotation.y))
                * DQuat::from_rotation_x(f64::from(rotation.x));
            let at = turned.inverse() * direction;
            // The angle to the right of -z, and the angle above the horizon.
            let (right, above) = (at.x.atan2(-at.z), at.y.clamp(-1.0, 1.0).asin());
            look_up(image, right / TAU + 0.5, (FRAC_PI_2 - above) / PI)
        }
        _ => panic!("the textbook renderer does not support this background"),
    }
}

/// The light of an image at a position from 0 to 1, to the right and down.
fn look_up(image: &Image<'_>, right: f64, down: f64) -> DVec3 {
    let (columns, lines) = (f64::from(image.width), f64::from(image.height));
    let (x, y) = (right * columns, down * lines);
    match image.filter {
        Filter::Nearest => pixel(image, x.floor(), y.floor()),
        Filter::Bilinear => {
            let (x, y) = (x - 0.5, y - 0.5);
            let (column, line) = (x.floor(), y.floor());
            let row = |line| pixel(image, column, line).lerp(pixel(image, column + 1.0, line), x - column);
            row(line).lerp(row(line + 1.0), y - line)
        }
    }
}

/// A pixel of an image that repeats horizontally and is clamped vertically.
fn pixel(image: &Image<'_>, column: f64, line: f64) -> DVec3 {
    let Pixels::Rgb888(bytes) = image.pixels else {
        panic!("the textbook renderer does not support these pixels")
    };
    let column = column.rem_euclid(f64::from(image.width)) as usize;
    let line = line.clamp(0.0, f64::from(image.height) - 1.0) as usize;
    let place = (line * usize::from(image.width) + column) * 3;
    let light = |code: u8| {
        let code = f64::from(code) / 255.0;
        match image.encoding {
            Encoding::Linear => code,
            Encoding::Srgb if code <= 0.04045 => code / 12.92,
            Encoding::Srgb => ((code + 0.055) / 1.055).powf(2.4),
        }
    };
    DVec3::new(light(bytes[place]), light(bytes[place + 1]), light(bytes[place + 2]))
}
