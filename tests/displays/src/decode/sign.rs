//! Flip-dot signs: pixels arrive in messages of 16 bytes, and are shown when a message says so.

use embedded_graphics::geometry::{Point, Size};
use flipdot::core::{Frame, Message, Offset, Operation};

use crate::bus::Transfer;
use crate::panel::Panel;

/// Bytes of a page before its first column.
const HEADER: usize = 4;

/// The dots of a sign of this size: 1 for one that is turned over.
pub fn decode(size: Size, sent: &[Transfer]) -> Panel {
    let mut panel = Panel::blank(size);
    let column_bytes = size.height.div_ceil(8) as usize;
    let mut page = vec![0; (HEADER + size.width as usize * column_bytes).next_multiple_of(16)];
    let mut is_receiving = false;
    for Transfer { bytes, .. } in sent {
        // A message that was cut off is lost.
        let Ok(frame) = Frame::from_bytes(bytes) else { continue };
        match Message::from(frame) {
            Message::RequestOperation(_, Operation::ShowLoadedPage) => show(&page, column_bytes, &mut panel),
            Message::RequestOperation(_, operation) => is_receiving = operation == Operation::ReceivePixels,
            Message::SendData(Offset(offset), data) if is_receiving => {
                panel.windows += 1;
                let first = usize::from(offset);
                page[first..first + data.get().len()].copy_from_slice(data.get());
            }
            _ => {}
        }
    }
    panel
}

/// Turns the dots. A byte has eight dots of a column, the upper one in the lowest bit.
fn show(page: &[u8], column_bytes: usize, panel: &mut Panel) {
    let Size { width, height } = panel.size;
    for (x, column) in (0..width as i32).zip(page[HEADER..].chunks(column_bytes)) {
        for y in 0..height as i32 {
            panel.write(Point::new(x, y), u32::from(column[y as usize / 8] >> (y % 8) & 1));
        }
    }
}
