//! Real display drivers over recording buses: what their panels show is decoded and compared with the
//! renderer's picture. The table in `docs/displays.md` is written from the same trials.

pub mod bus;
mod decode;
pub mod drivers;
pub mod entry;
mod ink;
pub mod panel;
pub mod picture;
pub mod table;
pub mod trial;
