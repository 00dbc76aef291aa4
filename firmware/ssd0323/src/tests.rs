//! Tests with a mock panel, which interprets the bytes on the bus.

use core::cell::RefCell;
use core::convert::Infallible;

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::mono_font::{MonoTextStyleBuilder, ascii::FONT_6X10};
use embedded_graphics::pixelcolor::{Gray4, GrayColor};
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::Text;
use embedded_graphics::{Drawable, Pixel};
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::spi::{self, SpiBus};

use crate::{Error, Setup, Ssd0323};

/// The wires between processor and panel, and the panel's memory.
struct Panel {
    is_data: bool,
    /// Bytes of commands since the last data.
    commands: Vec<u8>,
    /// Each window that data was written to: first and last column byte, first and last row, and the bursts.
    windows: Vec<([u8; 4], Vec<Vec<u8>>)>,
    memory: [[u8; 64]; 64],
    /// Number of writes before the bus fails.
    writes_left: usize,
}

impl Panel {
    /// A panel whose pixels all have gray 5.
    fn new() -> Self {
        Self {
            is_data: true,
            commands: vec![],
            windows: vec![],
            memory: [[0x55; 64]; 64],
            writes_left: usize::MAX,
        }
    }

    fn receive(&mut self, bytes: &[u8]) {
        if !self.is_data {
            self.commands.extend(bytes);
            return;
        }
        if let [.., 0x15, c0, c1, 0x75, r0, r1] = self.commands[..] {
            self.windows.push(([c0, c1, r0, r1], vec![]));
        }
        self.commands.clear();
        let ([c0, c1, r0, r1], bursts) = self.windows.last_mut().expect("data outside of any window");
        let columns = usize::from(*c1 - *c0) + 1;
        let written: usize = bursts.iter().map(Vec::len).sum();
        for (index, byte) in bytes.iter().enumerate() {
            let at = written + index;
            let row = usize::from(*r0) + at / columns;
            assert!(row <= usize::from(*r1), "more data than the window holds");
            self.memory[row][usize::from(*c0) + at % columns] = *byte;
        }
        bursts.push(bytes.to_vec());
    }

    fn pixel(&self, x: usize, y: usize) -> u8 {
        let byte = self.memory[y][x / 2];
        if x & 1 == 0 { byte >> 4 } else { byte & 0xF }
    }
}

struct Bus<'p>(&'p RefCell<Panel>);
struct Pin<'p>(&'p RefCell<Panel>);

#[derive(Debug, PartialEq)]
struct Broken;

impl spi::Error for Broken {
    fn kind(&self) -> spi::ErrorKind {
        spi::ErrorKind::Other
    }
}

impl spi::ErrorType for Bus<'_> {
    type Error = Broken;
}

impl SpiBus for Bus<'_> {
    fn read(&mut self, _: &mut [u8]) -> Result<(), Broken> {
        panic!("the panel cannot be read")
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), Broken> {
        let mut panel = self.0.borrow_mut();
        panel.writes_left = panel.writes_left.checked_sub(1).ok_or(Broken)?;
        panel.receive(bytes);
        Ok(())
    }

    fn transfer(&mut self, _: &mut [u8], _: &[u8]) -> Result<(), Broken> {
        panic!("the panel cannot be read")
    }

    fn transfer_in_place(&mut self, _: &mut [u8]) -> Result<(), Broken> {
        panic!("the panel cannot be read")
    }

    fn flush(&mut self) -> Result<(), Broken> {
        Ok(())
    }
}

impl digital::ErrorType for Pin<'_> {
    type Error = Infallible;
}

impl OutputPin for Pin<'_> {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.borrow_mut().is_data = false;
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.borrow_mut().is_data = true;
        Ok(())
    }
}

type TestPanel<'p> = Ssd0323<Bus<'p>, Pin<'p>>;
type TestResult = Result<(), Error<Broken, Infallible>>;

/// Draws on a new panel.
fn draw(draw: impl FnOnce(&mut TestPanel) -> TestResult) -> (TestResult, Panel) {
    let panel = RefCell::new(Panel::new());
    let mut driver = Ssd0323::new(Bus(&panel), Pin(&panel)).unwrap();
    let result = draw(&mut driver);
    (result, panel.into_inner())
}

fn area(x: i32, y: i32, width: u32, height: u32) -> Rectangle {
    Rectangle::new(Point::new(x, y), Size::new(width, height))
}

/// Grays 0, 1, 2, … 15, 0, …
fn counting() -> impl Iterator<Item = Gray4> {
    (0..).map(|i: u32| Gray4::new(i as u8 & 0xF))
}

/// The bytes of the commands that set a panel up.
fn commands(setup: Setup) -> Vec<u8> {
    let panel = RefCell::new(Panel::new());
    Ssd0323::with_setup(Bus(&panel), Pin(&panel), setup).unwrap();
    let panel = panel.into_inner();
    assert!(panel.windows.is_empty());
    panel.commands
}

#[test]
fn a_panel_is_set_up_by_commands_alone() {
    let (result, panel) = draw(|_| Ok(()));
    assert_eq!(result, Ok(()));
    let plain = [0xAE, 0xA0, 0x00, 0xA1, 0x00, 0xA2, 0x00, 0xA4, 0xA8, 0x3F, 0x81, 0x40, 0x86, 0xAF];
    assert_eq!(panel.commands, plain);
    assert_eq!(commands(Setup::default()), plain);
}

#[test]
fn the_setup_says_how_the_panel_is_connected() {
    let setup = Setup {
        mirrors_rows: true,
        swaps_pairs: true,
        splits_rows: true,
        first_row: 8,
        offset: 0x4C,
        contrast: 200,
        ..Setup::PLAIN
    };
    let other = [0xAE, 0xA0, 0x52, 0xA1, 0x08, 0xA2, 0x4C, 0xA4, 0xA8, 0x3F, 0x81, 0x7F, 0x86, 0xAF];
    assert_eq!(commands(setup), other);
    // Turned, columns, pairs and rows are the other way round.
    assert_eq!(commands(setup.turned())[2], 0x41);
    assert_eq!(setup.turned().turned(), setup);
}

#[test]
fn brightness_and_light_change_at_any_time() {
    let (result, panel) = draw(|display| {
        display.fill_solid(&area(0, 0, 2, 1), Gray4::WHITE)?;
        display.set_contrast(0x20)?;
        display.set_contrast(0xFF)?;
        display.set_on(false)?;
        display.set_on(true)
    });
    assert_eq!(result, Ok(()));
    assert_eq!(panel.commands, [0x81, 0x20, 0x81, 0x7F, 0xAE, 0xAF]);
}

#[test]
fn letters_of_even_width_with_a_background_are_areas() {
    let style = MonoTextStyleBuilder::new().font(&FONT_6X10).text_color(Gray4::WHITE);
    let text = |x, style| Text::new("Il", Point::new(x, 10), style);
    let filled = style.background_color(Gray4::BLACK).build();
    let (result, panel) = draw(|display| text(2, filled).draw(display).map(|_| ()));
    assert_eq!(result, Ok(()));
    let row = |y| (0..16).map(|x| panel.pixel(x, y)).collect::<Vec<_>>();
    // The upper ends of both letters, between what the panel showed before.
    assert_eq!(row(4), [5, 5, 0, 15, 15, 15, 0, 0, 0, 15, 15, 0, 0, 0, 5, 5]);
    let (result, _) = draw(|display| text(3, filled).draw(display).map(|_| ()));
    assert!(matches!(result, Err(Error::Unpaired { .. })));
    let (result, _) = draw(|display| text(2, style.build()).draw(display).map(|_| ()));
    assert!(matches!(result, Err(Error::Unpaired { .. })));
}

#[test]
fn a_line_is_one_window_and_one_burst() {
    let (result, panel) = draw(|display| display.fill_contiguous(&area(0, 7, 128, 1), counting()));
    assert_eq!(result, Ok(()));
    let line: Vec<u8> = [0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF].repeat(8);
    assert_eq!(panel.windows, [([0, 63, 7, 7], vec![line])]);
}

#[test]
fn an_area_is_one_window_and_a_burst_per_line() {
    let (result, panel) = draw(|display| display.fill_contiguous(&area(4, 60, 6, 2), counting()));
    assert_eq!(result, Ok(()));
    assert_eq!(panel.windows, [([2, 4, 60, 61], vec![vec![0x01, 0x23, 0x45], vec![0x67, 0x89, 0xAB]])]);
    assert_eq!(panel.pixel(3, 60), 5);
    assert_eq!(panel.pixel(10, 61), 5);
}

#[test]
fn areas_are_clipped_to_the_panel() {
    for area in [
        area(-3, 10, 9, 8),
        area(124, 10, 9, 8),
        area(10, -3, 8, 8),
        area(10, 59, 8, 8),
        area(-3, -3, 9, 8),
        area(-3, -3, 200, 100),
    ] {
        let (result, panel) = draw(|display| display.fill_contiguous(&area, counting()));
        assert_eq!(result, Ok(()), "{area:?}");
        for (y, x) in (0..64).flat_map(|y| (0..128).map(move |x| (y, x))) {
            let inside = area.contains(Point::new(x, y));
            let index = (y - area.top_left.y) * area.size.width as i32 + x - area.top_left.x;
            let expected = if inside { (index & 0xF) as u8 } else { 5 };
            assert_eq!(panel.pixel(x as usize, y as usize), expected, "({x}, {y}) of {area:?}");
        }
    }
}

#[test]
fn areas_outside_the_panel_draw_nothing() {
    for outside in [area(128, 0, 4, 4), area(-4, 0, 4, 4), area(0, 64, 4, 4), area(0, 0, 0, 4)] {
        let (result, panel) = draw(|display| display.fill_contiguous(&outside, counting()));
        assert_eq!(result, Ok(()));
        assert!(panel.windows.is_empty());
    }
    let (result, panel) = draw(|display| display.draw_iter([Pixel(Point::new(-1, 0), Gray4::WHITE)]));
    assert_eq!(result, Ok(()));
    assert!(panel.windows.is_empty());
}

#[test]
fn an_area_that_splits_a_pair_is_an_error_and_draws_nothing() {
    for (split, pixel) in [
        (area(1, 2, 3, 1), Point::new(1, 2)),
        (area(2, 2, 3, 1), Point::new(4, 2)),
        (area(-2, 2, 3, 1), Point::new(0, 2)),
    ] {
        let (result, panel) = draw(|display| display.fill_contiguous(&split, counting()));
        assert_eq!(result, Err(Error::Unpaired { pixel }));
        assert!(panel.windows.is_empty());
    }
}

#[test]
fn colors_may_run_out_between_pairs_only() {
    let (result, panel) = draw(|display| display.fill_contiguous(&area(0, 0, 4, 2), counting().take(6)));
    assert_eq!(result, Ok(()));
    assert_eq!([0, 1, 2].map(|x| panel.pixel(x, 1)), [4, 5, 5]);
    let (result, _) = draw(|display| display.fill_contiguous(&area(0, 0, 4, 2), counting().take(7)));
    assert_eq!(result, Err(Error::Unpaired { pixel: Point::new(2, 1) }));
}

#[test]
fn single_pixels_are_drawn_in_pairs() {
    let pixel = |x, y, gray| Pixel(Point::new(x, y), Gray4::new(gray));
    let (result, panel) = draw(|display| {
        display.draw_iter([
            pixel(2, 3, 1),
            pixel(3, 3, 2),
            pixel(-1, 3, 9),
            pixel(4, 3, 3),
            pixel(5, 3, 4),
            pixel(126, 9, 6),
            pixel(127, 9, 7),
        ])
    });
    assert_eq!(result, Ok(()));
    assert_eq!([1, 2, 3, 4, 5, 6].map(|x| panel.pixel(x, 3)), [5, 1, 2, 3, 4, 5]);
    assert_eq!([125, 126, 127].map(|x| panel.pixel(x, 9)), [5, 6, 7]);
    // Neighbors share a window.
    assert_eq!(panel.windows.len(), 2);
}

#[test]
fn a_single_pixel_without_its_partner_is_an_error() {
    let pixel = |x, y| Pixel(Point::new(x, y), Gray4::WHITE);
    for (pixels, alone) in [
        (vec![pixel(3, 0)], Point::new(3, 0)),
        (vec![pixel(2, 0)], Point::new(2, 0)),
        (vec![pixel(2, 0), pixel(3, 1)], Point::new(2, 0)),
        (vec![pixel(2, 0), pixel(4, 0)], Point::new(2, 0)),
    ] {
        let (result, panel) = draw(|display| display.draw_iter(pixels));
        assert_eq!(result, Err(Error::Unpaired { pixel: alone }));
        assert!(panel.windows.is_empty());
    }
}

#[test]
fn solid_areas_of_any_size_are_clipped() {
    let (result, panel) =
        draw(|display| display.fill_solid(&area(-1000, -1000, u32::MAX, u32::MAX), Gray4::new(3)));
    assert_eq!(result, Ok(()));
    assert_eq!(panel.memory, [[0x33; 64]; 64]);
}

#[test]
fn an_error_of_the_bus_is_passed_on() {
    let panel = RefCell::new(Panel::new());
    let mut display = Ssd0323::new(Bus(&panel), Pin(&panel)).unwrap();
    // Clearing takes two commands for the window and one burst for each line.
    for writes in 0..66 {
        panel.borrow_mut().writes_left = writes;
        assert_eq!(display.clear(Gray4::BLACK), Err(Error::Bus(Broken)));
    }
    panel.borrow_mut().writes_left = 66;
    assert_eq!(display.clear(Gray4::BLACK), Ok(()));
    assert_eq!(panel.into_inner().memory, [[0; 64]; 64]);
}
