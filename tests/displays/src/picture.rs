//! The picture that all drivers draw.

use std::mem::MaybeUninit;
use std::ops::Range;
use std::sync::LazyLock;

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions, Point, Size};
use embedded_graphics::primitives::{PointsIter, Rectangle};
use rayline::builtin::CLASSIC;
use rayline::{DisplayColor, Dither, DrawError, Light16, PreparedScene, Quantizer, Renderer, Settings};

/// The scene: four spheres on a checkered floor.
static SCENE: LazyLock<PreparedScene<'static, f32>> = LazyLock::new(|| {
    let memory = vec![MaybeUninit::uninit(); CLASSIC.bytes::<f32>()].leak();
    PreparedScene::new(&CLASSIC, memory).expect("a legal scene")
});

/// A picture of this size, which a driver draws.
#[derive(Clone, Debug)]
pub struct Picture {
    renderer: Renderer<'static, 'static, f32>,
    settings: Settings,
    /// A pixel that is drawn with a wrong color, to see whether the trial notices.
    wrong: Option<Point>,
}

impl Picture {
    /// A picture of this size. It is dithered, so that colors of one bit show more than outlines.
    pub fn new(size: Size) -> Self {
        let settings =
            Settings { bounces: 0, dither: Dither::Ordered, ..Settings::new(size.width, size.height) };
        let renderer = Renderer::new(&SCENE, settings).expect("legal settings");
        Self { renderer, settings, wrong: None }
    }

    /// This picture with one wrong pixel.
    pub fn with_wrong_pixel(&self, at: Point) -> Self {
        Self { wrong: Some(at), ..self.clone() }
    }

    /// Width and height.
    pub fn size(&self) -> Size {
        Size::new(self.renderer.width(), self.renderer.height())
    }

    /// All lines.
    pub fn lines(&self) -> Range<u32> {
        0..self.renderer.height()
    }

    /// The colors of the picture's pixels by `Renderer::line`, each as the code that the panel is to hold.
    pub fn codes<C: DisplayColor>(&self, code: impl Fn(C) -> u32) -> Vec<u32> {
        let mut line = self.line();
        let lines = self.lines().flat_map(|y| {
            self.renderer.line(y, &mut line).expect("a line of the picture");
            line.iter().map(|color| code(*color)).collect::<Vec<_>>()
        });
        lines.collect()
    }

    /// Draws some lines on a display, as a program does.
    ///
    /// # Errors
    /// If the display failed: the line from which to draw again.
    pub fn draw<D>(&self, display: &mut D, lines: Range<u32>) -> Result<(), u32>
    where
        D: DrawTarget<Color: DisplayColor>,
    {
        let result = match self.wrong {
            Some(at) => self.draw_lines(&mut Wrong { display, at, picture: self }, lines),
            None => self.draw_lines(display, lines),
        };
        result.map_err(|error| match error {
            DrawError::Display { line, .. } => line,
            _ => panic!("the lines are those of the picture"),
        })
    }

    fn draw_lines<D>(&self, display: &mut D, lines: Range<u32>) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget<Color: DisplayColor>,
    {
        let mut line = self.line();
        if lines == self.lines() {
            return self.renderer.draw(display, &mut line[..]);
        }
        self.renderer.frame(lines, &mut line[..])?.draw(display)
    }

    /// Memory for one line.
    fn line<C: DisplayColor>(&self) -> Vec<C> {
        vec![self.shade(0); self.renderer.width() as usize]
    }

    /// Gray of this light, 0 to 65536.
    fn shade<C: DisplayColor>(&self, light: u32) -> C {
        let quantizer = Quantizer::new(&self.settings, 0, 0);
        C::from_light(Light16 { r: light, g: light, b: light }, &quantizer)
    }
}

/// A display on which one pixel gets a wrong color.
struct Wrong<'d, D> {
    display: &'d mut D,
    at: Point,
    picture: &'d Picture,
}

impl<D: DrawTarget> Dimensions for Wrong<'_, D> {
    fn bounding_box(&self) -> Rectangle {
        self.display.bounding_box()
    }
}

impl<D: DrawTarget<Color: DisplayColor>> DrawTarget for Wrong<'_, D> {
    type Color = D::Color;
    type Error = D::Error;

    fn draw_iter<I: IntoIterator<Item = Pixel<D::Color>>>(&mut self, pixels: I) -> Result<(), D::Error> {
        self.display.draw_iter(pixels)
    }

    fn fill_contiguous<I: IntoIterator<Item = D::Color>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), D::Error> {
        let (black, white) = (self.picture.shade(0), self.picture.shade(1 << 16));
        let colors =
            area.points().zip(colors).map(|(point, color)| match (point == self.at, color == black) {
                (false, _) => color,
                (true, true) => white,
                (true, false) => black,
            });
        self.display.fill_contiguous(area, colors)
    }
}
