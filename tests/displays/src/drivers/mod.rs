//! One file for each driver crate: how it is set up, and the code that its user writes.

mod epd_waveshare;
mod gc9a01_rs;
mod ili9341;
mod mipidsi;
mod oled_async;
mod sh1106;
mod ssd1306;
mod ssd1351;
mod st7735_lcd;
mod uc8151;
mod weact_studio_epd;

use embedded_graphics::pixelcolor::PixelColor;
use embedded_graphics::pixelcolor::raw::RawData;

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
    ssd1306
    sh1106
    oled_async
    uc8151
    weact_studio_epd
    epd_waveshare
}

/// The bits of a color, as embedded-graphics numbers them.
fn raw<C: PixelColor<Raw: From<C>>>(color: C) -> u32
where
    <C::Raw as RawData>::Storage: Into<u32>,
{
    C::Raw::from(color).into_inner().into()
}
