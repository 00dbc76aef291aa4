//! PSNR and rays of a picture, computed on this computer, whose pixels are those of the board.

use anyhow::Result;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::RgbColor;
use rayline::math::Fixed;

use crate::host::{Canvas, render_frame};
use crate::picture::{Mode, Number, Picture};

/// PSNR and rays of a picture; of several frames, those of the first one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Quality {
    /// Number of rays that were traced.
    pub(crate) rays: u64,
    /// Peak signal-to-noise ratio in 8-bit sRGB: of a realtime picture against the exact one in the same
    /// number system, of an exact picture in fixed point against the exact one in `f64`. `None` for an exact
    /// picture in `f32`.
    pub(crate) psnr_db: Option<f64>,
}

impl Quality {
    /// Renders a picture and its reference.
    pub(crate) fn of(picture: &Picture) -> Result<Self> {
        let exact = Picture { mode: Mode::Exact, ..*picture };
        let shown = in_number(picture)?;
        let reference = match (picture.mode, picture.number) {
            (Mode::Exact, Number::F32) => None,
            (Mode::Exact, Number::Fixed) => Some(render_frame::<f64, _>(&exact, 0, Rgb888::BLACK)?),
            (Mode::Realtime | Mode::Smooth | Mode::Preview, _) => Some(in_number(&exact)?),
        };
        let psnr_db = reference.map(|reference| psnr_db(&shown.colors, &reference.colors));
        Ok(Self { rays: shown.rays, psnr_db })
    }
}

fn in_number(picture: &Picture) -> Result<Canvas<Rgb888>> {
    match picture.number {
        Number::F32 => render_frame::<f32, _>(picture, 0, Rgb888::BLACK),
        Number::Fixed => render_frame::<Fixed, _>(picture, 0, Rgb888::BLACK),
    }
}

/// Peak signal-to-noise ratio of two pictures, in dB. Equal pictures have 99 dB, the maximum.
fn psnr_db(a: &[Rgb888], b: &[Rgb888]) -> f64 {
    let channels = |color: &Rgb888| [color.r(), color.g(), color.b()].map(f64::from);
    let pairs = a.iter().flat_map(channels).zip(b.iter().flat_map(channels));
    let sum: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
    let mean = sum / (3 * a.len()) as f64;
    (10.0 * (255.0 * 255.0 / mean).log10()).min(99.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::BOARDS;
    use crate::request::Request;

    fn quality(number: Number, mode: Mode) -> Quality {
        let size = Some("32x24".parse().unwrap());
        let request = Request { size, number, mode, ..Request::new("classic").unwrap() };
        Quality::of(&request.on(&BOARDS[1])).unwrap()
    }

    #[test]
    fn pictures_are_compared_channel_by_channel() {
        assert_eq!(psnr_db(&[Rgb888::BLACK; 4], &[Rgb888::WHITE; 4]), 0.0);
        assert_eq!(psnr_db(&[Rgb888::RED; 4], &[Rgb888::RED; 4]), 99.0);
        // One of twelve channels is off by one: a mean square of 1/12.
        let mut other = [Rgb888::BLACK; 4];
        other[2] = Rgb888::new(0, 1, 0);
        assert!((psnr_db(&[Rgb888::BLACK; 4], &other) - 10.0 * (12.0f64 * 65025.0).log10()).abs() < 1e-9);
    }

    #[test]
    fn each_mode_has_its_reference() {
        let exact = quality(Number::F32, Mode::Exact);
        assert_eq!(exact.psnr_db, None);
        assert!(exact.rays >= 32 * 24);
        let fixed = quality(Number::Fixed, Mode::Exact).psnr_db.unwrap();
        assert!((35.0..99.0).contains(&fixed), "{fixed}");
        let realtime = quality(Number::F32, Mode::Realtime);
        assert!(realtime.rays < exact.rays);
        assert!((30.0..99.0).contains(&realtime.psnr_db.unwrap()), "{realtime:?}");
    }
}
