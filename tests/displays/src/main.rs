//! Prints the table of `docs/displays.md`, or writes it to the page.

use std::io;

use rayline_displays::{drivers, table};

fn main() -> io::Result<()> {
    let entries = drivers::all();
    match std::env::args().nth(1).as_deref() {
        None => {
            print!("{}", table::table(&entries));
            Ok(())
        }
        Some("--write") => table::write(&entries),
        Some(other) => Err(io::Error::other(format!("`{other}`: the only option is --write"))),
    }
}
