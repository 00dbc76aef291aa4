//! hub75-framebuffer: the words that DMA sends to an LED panel, over and over.

use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_hal::spi::SpiDevice;
use hub75_framebuffer::plain::DmaFrameBuffer;
use hub75_framebuffer::{FrameBuffer, compute_frame_count, compute_rows};

use crate::bus::Bus;
use crate::decode::scan::Scan;
use crate::entry::Entry;
use crate::trial::{Draw, Fault, Trial};

const ROWS: usize = 32;
const COLUMNS: usize = 64;
const BITS: u8 = 3;

type Buffer = DmaFrameBuffer<ROWS, COLUMNS, { compute_rows(ROWS) }, BITS, { compute_frame_count(BITS) }>;

pub(super) fn entry() -> Entry {
    let connect = |bus: &Bus| -> Draw {
        let mut buffer = Box::new(Buffer::new());
        let mut spi = bus.clone();
        Box::new(move |picture, lines| {
            picture.draw(&mut *buffer, lines)?;
            spi.write(words(&buffer)).map_err(|_| Fault::Flush)
        })
    };
    let scan = Scan { size: Size::new(COLUMNS as u32, ROWS as u32) };
    let decode = move |sent: &[_]| scan.decode(sent);
    let code = |color: Rgb888| {
        let level = |code: u8| code >> (8 - BITS);
        u32::from_be_bytes([0, level(color.r()), level(color.g()), level(color.b())])
    };
    Entry {
        name: "hub75-framebuffer",
        glue: 1,
        note: "`Transfer::Linear`, as above; each channel is cut to its upper `BITS`",
        trials: vec![Trial::new("HUB75 64x32 in 9 bits", scan.size, connect, decode, code)],
    }
}

/// The bytes that DMA sends for a refresh.
fn words(buffer: &Buffer) -> &[u8] {
    assert_eq!(Buffer::BCM_SEGMENT_COUNT, 1);
    let segment = buffer.bcm_segment(0);
    // SAFETY: the segment is as many bytes of the buffer, which is borrowed as long as the slice.
    unsafe { std::slice::from_raw_parts(segment.ptr, segment.len) }
}
