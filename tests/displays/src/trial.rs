//! The test body that all drivers share.

use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::{PointsIter, Rectangle};
use rayline::DisplayColor;

use crate::bus::{Bus, Transfer};
use crate::panel::{Panel, Turn};
use crate::picture::Picture;

/// Draws some lines of a picture and sends them: the code that a user of a driver writes.
pub type Draw = Box<dyn FnMut(&Picture, Range<u32>) -> Result<(), Fault>>;

type Connect = dyn Fn(&Bus) -> Draw;
type Decode = dyn Fn(&[Transfer]) -> Panel;
type Codes = dyn Fn(&Picture) -> Vec<u32>;

/// The work that is left when the bus failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// All lines before this one are on the panel: draw from there.
    Line(u32),
    /// All lines are in the driver's buffer: flush it again.
    Flush,
    /// The driver has forgotten what it did not send: draw the whole picture again.
    Redraw,
}

impl From<u32> for Fault {
    fn from(line: u32) -> Self {
        Self::Line(line)
    }
}

/// The reaction of a driver when the bus fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnFault {
    /// The driver returns an error.
    Returns,
    /// The driver panics.
    Panics,
}

/// A driver with one panel, in one orientation.
pub struct Trial {
    /// The panel, such as `ST7789 135x240 at (52, 40)`.
    pub panel: String,
    glass: Size,
    turn: Turn,
    on_fault: OnFault,
    connect: Box<Connect>,
    decode: Box<Decode>,
    codes: Box<Codes>,
}

/// A picture, and what the panel is to hold for its pixels.
struct Expected {
    picture: Picture,
    codes: Vec<u32>,
}

/// A driver that is connected to a bus.
struct Session {
    bus: Bus,
    draw: Draw,
    /// The panel before the first picture.
    before: Panel,
}

impl Trial {
    /// A panel with glass of this size. `decode` returns what the glass shows; `code` is the code that the
    /// panel holds for a color.
    pub fn new<C: DisplayColor>(
        panel: impl Into<String>,
        glass: Size,
        connect: impl Fn(&Bus) -> Draw + 'static,
        decode: impl Fn(&[Transfer]) -> Panel + 'static,
        code: impl Fn(C) -> u32 + 'static,
    ) -> Self {
        Self {
            panel: panel.into(),
            glass,
            turn: Turn::NONE,
            on_fault: OnFault::Returns,
            connect: Box::new(connect),
            decode: Box::new(decode),
            codes: Box::new(move |picture| picture.codes(&code)),
        }
    }

    /// This panel, turned by the driver.
    pub fn turned(self, turn: Turn) -> Self {
        Self { turn, ..self }
    }

    /// This panel, by a driver that panics when the bus fails.
    pub fn panics_on_fault(self) -> Self {
        Self { on_fault: OnFault::Panics, ..self }
    }

    /// Width and height of the display, after the turn.
    pub fn size(&self) -> Size {
        self.turn.size(self.glass)
    }

    /// The number of windows in which a picture of the display's size arrives.
    pub fn windows(&self) -> usize {
        let (picture, mut session) = (Picture::new(self.size()), self.connect());
        assert_eq!((session.draw)(&picture, picture.lines()), Ok(()), "{self}");
        self.shown(&session).windows - session.before.windows
    }

    /// Draws pictures that fit, are smaller and are larger; pictures with a wrong pixel; and pictures during
    /// which the bus fails.
    pub fn check(&self) {
        let Size { width, height } = self.size();
        // Odd sides are no multiple of a byte.
        self.check_picture(&self.expected(Size::new((width * 2 / 3) | 1, (height * 2 / 3) | 1)));
        self.check_picture(&self.expected(Size::new(width + 13, height + 9)));
        let fitting = self.expected(self.size());
        self.check_picture(&fitting);
        let (right, bottom) = (width as i32 - 1, height as i32 - 1);
        for wrong in [(0, 0), (right, 0), (right / 3, bottom / 2), (right, bottom)] {
            self.check_wrong_pixel(&fitting, Point::new(wrong.0, wrong.1));
        }
        self.check_faults(&fitting);
    }

    fn expected(&self, size: Size) -> Expected {
        let picture = Picture::new(size);
        Expected { codes: (self.codes)(&picture), picture }
    }

    /// A driver on a new bus, which has sent what it sends without a picture.
    fn connect(&self) -> Session {
        let bus = Bus::default();
        let mut draw = (self.connect)(&bus);
        assert_eq!(draw(&Picture::new(self.size()), 0..0), Ok(()), "{self}");
        let before = (self.decode)(&bus.sent());
        assert_eq!(before.size, self.glass, "{self}");
        Session { bus, draw, before }
    }

    fn shown(&self, session: &Session) -> Panel {
        (self.decode)(&session.bus.sent())
    }

    /// The panel shows the picture, and beside it what it showed before.
    fn check_picture(&self, expected: &Expected) {
        let mut session = self.connect();
        let picture = &expected.picture;
        assert_eq!((session.draw)(picture, picture.lines()), Ok(()), "{self}");
        self.assert_shown(expected, &session);
    }

    fn assert_shown(&self, expected: &Expected, session: &Session) {
        let picture = &expected.picture;
        let wrong = self.wrong_pixels(expected, session, picture.lines());
        let count = wrong.len();
        assert!(wrong.is_empty(), "{self}, {}: {count} pixels are wrong, from {}", picture.size(), wrong[0]);
    }

    /// The pixels of the display that do not show some lines of the picture, or beside it what was shown
    /// before.
    fn wrong_pixels(&self, expected: &Expected, session: &Session, lines: Range<u32>) -> Vec<Point> {
        let Expected { picture, codes } = expected;
        let shown = self.shown(session);
        let inside = Rectangle::new(Point::zero(), picture.size());
        let pixels = Rectangle::new(Point::zero(), self.size()).points();
        let asked = pixels.filter(|at| !inside.contains(*at) || lines.contains(&(at.y as u32)));
        let wrong = asked.filter(|at| {
            let place = self.turn.place(*at, self.glass);
            let code = if inside.contains(*at) {
                Some(codes[at.y as usize * picture.size().width as usize + at.x as usize])
            } else {
                session.before.code(place)
            };
            shown.code(place) != code
        });
        wrong.collect()
    }

    /// A pixel that is drawn with a wrong color is found, and no other.
    fn check_wrong_pixel(&self, expected: &Expected, at: Point) {
        let mut session = self.connect();
        let spoiled = expected.picture.with_wrong_pixel(at);
        assert_eq!((session.draw)(&spoiled, spoiled.lines()), Ok(()), "{self}");
        assert_eq!(self.wrong_pixels(expected, &session, spoiled.lines()), [at], "{self}");
    }

    /// The bus fails at each tenth of a frame. What is left is then drawn, and the panel shows the picture.
    fn check_faults(&self, expected: &Expected) {
        let picture = &expected.picture;
        let mut whole = self.connect();
        let bytes = whole.bus.bytes();
        assert_eq!((whole.draw)(picture, picture.lines()), Ok(()), "{self}");
        let bytes = whole.bus.bytes() - bytes;
        assert!(bytes >= 10, "{self}: a frame of {bytes} bytes");
        for tenth in 0..10 {
            let mut session = self.connect();
            session.bus.fail_after(bytes * tenth / 10);
            let drawn = catch_unwind(AssertUnwindSafe(|| (session.draw)(picture, picture.lines())));
            assert!(!session.bus.is_failing(), "{self}: the bus has not failed");
            let Ok(result) = drawn else {
                assert_eq!(self.on_fault, OnFault::Panics, "{self}");
                continue;
            };
            assert_eq!(self.on_fault, OnFault::Returns, "{self}");
            let fault = result.expect_err("the error of the bus is returned");
            let left = match fault {
                Fault::Line(line) => {
                    assert_eq!(self.wrong_pixels(expected, &session, 0..line), [], "{self}, before {line}");
                    line..picture.lines().end
                }
                Fault::Flush => 0..0,
                Fault::Redraw => picture.lines(),
            };
            assert_eq!((session.draw)(picture, left), Ok(()), "{self}");
            self.assert_shown(expected, &session);
        }
    }
}

impl std::fmt::Display for Trial {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Turn { quarters, is_mirrored } = self.turn;
        let mirrored = if is_mirrored { ", mirrored" } else { "" };
        write!(f, "{}, turned by {}°{mirrored}", self.panel, u32::from(quarters) * 90)
    }
}
