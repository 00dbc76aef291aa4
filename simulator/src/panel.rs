//! Pictures as they look on a panel: with large pixels, gaps between them, and the two colors of a theme.

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions, Size};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};

use crate::{Picture, RenderError};

/// The largest width and height of a picture of a panel, in pixels.
const MAX_SIDE: u64 = 1 << 15;

/// The picture as the panel shows it, by embedded-graphics' simulator. A theme other than the default one is
/// for pictures in black and white.
///
/// # Errors
/// The pixels are so large that the picture would have more than 32768 columns or lines.
pub fn on_panel(picture: &Picture, panel: &OutputSettings) -> Result<Picture, RenderError> {
    let side = |pixels: u32| u64::from(pixels) * (u64::from(panel.scale) + u64::from(panel.pixel_spacing));
    if side(picture.width.max(picture.height)) > MAX_SIDE {
        let needed = side(picture.width).saturating_mul(side(picture.height)).saturating_mul(3);
        return Err(RenderError::Memory { needed });
    }
    let mut display = SimulatorDisplay::<Rgb888>::new(Size::new(picture.width, picture.height));
    let colors = picture.rgb.as_chunks().0.iter().map(|&[r, g, b]| Rgb888::new(r, g, b));
    match display.fill_contiguous(&display.bounding_box(), colors) {
        Ok(()) => {}
        Err(error) => match error {},
    }
    let image = display.to_rgb_output_image(panel);
    let Size { width, height } = display.output_size(panel);
    Ok(Picture { width, height, rgb: image.as_image_buffer().into_raw().to_vec(), ..picture.clone() })
}

#[cfg(test)]
mod tests {
    use embedded_graphics_simulator::{BinaryColorTheme, OutputSettingsBuilder};
    use rayline::RayCounts;

    use super::*;

    #[test]
    fn pixels_are_enlarged_with_gaps_in_the_color_of_the_theme() {
        let rgb = vec![0, 0, 0, 255, 255, 255];
        let picture = Picture { width: 2, height: 1, rgb, rays: RayCounts::default(), prepared_bytes: 7 };
        let panel =
            OutputSettingsBuilder::new().theme(BinaryColorTheme::OledBlue).scale(2).pixel_spacing(1).build();
        let shown = on_panel(&picture, &panel).unwrap();
        assert_eq!((shown.width, shown.height, shown.prepared_bytes), (5, 2, 7));
        let (off, on) = ([0, 20, 40], [0, 210, 255]);
        let line = [off, off, off, on, on].concat();
        assert_eq!(shown.rgb, [line.clone(), line].concat());
        let plain = OutputSettingsBuilder::new().build();
        assert_eq!(on_panel(&picture, &plain).unwrap(), picture);
        let vast = OutputSettingsBuilder::new().scale(20_000).build();
        assert!(on_panel(&picture, &vast).is_err());
    }
}
