//! One file for each driver crate: how it is set up, and the code that its user writes.

mod embedded_graphics;
mod embedded_graphics_framebuf;
mod embedded_graphics_simulator;
mod epd_waveshare;
mod flipdot_graphics;
mod gc9a01_rs;
mod hub75_framebuffer;
mod ili9341;
mod kolibri_embedded_gui;
mod lcd_async;
mod max7219;
mod mipidsi;
mod oled_async;
mod sh1106;
mod smart_leds_matrix;
mod ssd1306;
mod ssd1351;
mod st7735_lcd;
mod st7920;
mod uc8151;
mod weact_studio_epd;

use ::embedded_graphics::pixelcolor::PixelColor;
use ::embedded_graphics::pixelcolor::raw::RawData;

use crate::entry::Entry;

/// The entries of these modules, and a test for each.
macro_rules! entries {
    ($($driver:ident)+) => {
        /// All entries, in the order of the table.
        pub fn all() -> Vec<Entry> {
            vec![$($driver::entry()),+]
        }

        #[cfg(test)]
        mod tests {
            $(#[test]
            fn $driver() {
                super::$driver::entry().check();
            })+
        }
    };
}

entries! {
    mipidsi
    st7735_lcd
    ili9341
    gc9a01_rs
    ssd1351
    lcd_async
    ssd1306
    sh1106
    oled_async
    uc8151
    weact_studio_epd
    epd_waveshare
    st7920
    smart_leds_matrix
    hub75_framebuffer
    max7219
    flipdot_graphics
    embedded_graphics
    embedded_graphics_framebuf
    embedded_graphics_simulator
    kolibri_embedded_gui
}

/// The bits of a color, as embedded-graphics numbers them.
fn raw<C: PixelColor<Raw: From<C>>>(color: C) -> u32
where
    <C::Raw as RawData>::Storage: Into<u32>,
{
    C::Raw::from(color).into_inner().into()
}
