//! Images in POV-Ray's language: files, and functions of their light.
//!
//! Each image is declared once, as three functions of x and y for red, green and blue. They read single
//! pixels at their centers and blend them as the core does, so that POV-Ray's own rules for edges and
//! interpolation have no effect.

use std::cell::RefCell;

use rayline::{Encoding, Ends, Filter, Image, Pixels};

use super::Lack;
use super::pattern::folded;
use crate::Pictures;

/// The images that the scene has used so far.
#[derive(Debug)]
pub(super) struct Images<'p, 'a>(RefCell<Used<'p, 'a>>);

#[derive(Debug)]
struct Used<'p, 'a> {
    pictures: &'p mut Pictures<'a>,
    declared: Vec<Declared>,
}

/// An image as it is declared; its number is its position in the list.
#[derive(Debug, PartialEq)]
struct Declared {
    file: String,
    size: [u16; 2],
    encoding: Encoding,
    filter: Filter,
    /// The ends across and up.
    ends: [Ends; 2],
}

impl<'p, 'a> Images<'p, 'a> {
    pub(super) fn new(pictures: &'p mut Pictures<'a>) -> Self {
        Self(RefCell::new(Used { pictures, declared: Vec::new() }))
    }

    /// The formulas of red, green and blue of an image at a place; its width and height are 1. They are equal
    /// if it is known to be gray.
    pub(super) fn channels(
        &self,
        image: &Image<'a>,
        ends: [Ends; 2],
        [x, y]: &[String; 2],
    ) -> Result<[String; 3], Lack> {
        let mut used = self.0.borrow_mut();
        let file = used.pictures.name_of(image).map_err(|_| Lack::Pixels)?;
        let Image { width, height, encoding, filter, .. } = *image;
        let new = Declared { file, size: [width, height], encoding, filter, ends };
        let number = used.declared.iter().position(|known| *known == new).unwrap_or_else(|| {
            used.declared.push(new);
            used.declared.len() - 1
        });
        let is_gray = match image.pixels {
            Pixels::Palette8 { palette, .. } | Pixels::Palette4 { palette, .. } => {
                palette.iter().all(|[red, green, blue]| red == green && green == blue)
            }
            _ => false,
        };
        let channels = if is_gray { ["Red"; 3] } else { ["Red", "Green", "Blue"] };
        Ok(channels.map(|channel| format!("{channel}{number}({x}, {y})")))
    }

    /// The declarations of all images that were used.
    pub(super) fn declarations(self) -> String {
        self.0.into_inner().declared.iter().enumerate().map(|(number, image)| image.write(number)).collect()
    }
}

impl Declared {
    fn write(&self, number: usize) -> String {
        let Self { file, encoding, filter, .. } = self;
        let gamma = match encoding {
            Encoding::Srgb => "srgb",
            Encoding::Linear => "1",
        };
        let mut text = format!(
            "#declare Picture{number} = function {{ pigment {{ image_map {{ png \"{file}\" gamma \
             {gamma} }} }} }}\n"
        );
        for (name, channel) in [("Red", "red"), ("Green", "green"), ("Blue", "blue")] {
            let pixel = |right: u8, up: u8| {
                let [column, line] = [self.center(0, "Column", right), self.center(1, "Line", up)];
                format!("Picture{number}({column}, {line}, 0).{channel}")
            };
            let [x, y] = [self.place(0, "x"), self.place(1, "y")];
            text += &match filter {
                Filter::Nearest => {
                    let at = format!("{name}At{number}");
                    format!(
                        "#declare {at} = function(Column, Line) {{ {} }}\n\
                         #declare {name}{number} = function(x, y) {{ {at}(floor({x}), floor({y})) }}\n",
                        pixel(0, 0)
                    )
                }
                Filter::Bilinear => {
                    let at = format!("{name}At{number}");
                    format!(
                        "#declare {at} = function(Column, Line, Right, Up) {{ (1 - Up)*((1 - Right)*{} + \
                         Right*{}) + Up*((1 - Right)*{} + Right*{}) }}\n\
                         #declare {name}{number} = function(x, y) {{ {at}(floor({x}), floor({y}), {x} - \
                         floor({x}), {y} - floor({y})) }}\n",
                        pixel(0, 0),
                        pixel(1, 0),
                        pixel(0, 1),
                        pixel(1, 1)
                    )
                }
            };
        }
        text
    }

    /// The number of pixels along an axis, and its ends.
    fn axis(&self, axis: usize) -> (u16, Ends) {
        let ([width, height], [across, up]) = (self.size, self.ends);
        if axis == 0 { (width, across) } else { (height, up) }
    }

    /// The formula of a coordinate in pixels. Whole numbers are edges of pixels, or with a blend
    /// their centers.
    fn place(&self, axis: usize, at: &str) -> String {
        let (count, ends) = self.axis(axis);
        let half = if self.filter == Filter::Bilinear { 0.5 } else { 0.0 };
        format!("({}*{count} - {half})", folded(at, ends))
    }

    /// The formula of the center of a pixel, as a share of the image. The number may be one beyond an end;
    /// POV-Ray repeats images.
    fn center(&self, axis: usize, number: &str, more: u8) -> String {
        let (count, ends) = self.axis(axis);
        let last = count.saturating_sub(1);
        match (self.filter, ends) {
            // A position exactly on the far edge belongs to the last pixel.
            (Filter::Nearest, _) => format!("(min({number}, {last}) + 0.5)/{count}"),
            (Filter::Bilinear, Ends::Repeat) => format!("({number} + {more} + 0.5)/{count}"),
            (Filter::Bilinear, _) => format!("(min(max({number} + {more}, 0), {last}) + 0.5)/{count}"),
        }
    }
}
