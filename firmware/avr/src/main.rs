//! A picture on an ATmega2560, with 8 KB of RAM. There, the program draws and sends it ([`board`]); here, it
//! runs the board in QEMU and compares what arrives with its own picture ([`desktop`]).

#![cfg_attr(target_arch = "avr", no_std, no_main)]

#[cfg(target_arch = "avr")]
mod board;
#[cfg(not(target_arch = "avr"))]
mod desktop;
mod picture;

#[cfg(not(target_arch = "avr"))]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    desktop::main()
}
