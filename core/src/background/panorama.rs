//! An image all around the scene, longitude across and latitude up (Blinn and Newell, "Texture and Reflection
//! in Computer Generated Images", CACM 1976).

use core::ptr;

use crate::color::LinearRgb;
use crate::fault::{Fault, check_numbers};
use crate::math::{Real, Vec3};
use crate::shape::globe;
use crate::texture::{Image, PreparedImage};

/// An equirectangular image all around the scene: its width is a full turn about the y axis, its height half
/// a turn, from straight below to straight above. The middle of the image lies toward -z, and its right half
/// lies toward +x.
///
/// The image repeats horizontally and is clamped vertically; its field [`ends`](Image::ends) is ignored.
///
/// ```
/// use rayline::{Background, Encoding, Ends, Filter, Image, Panorama, Pixels, Vec3};
/// /// Four pixels wide, two high: blue above, green below, and one white pixel ahead on the right.
/// const MEADOW: Image = Image {
///     width: 4,
///     height: 2,
///     pixels: Pixels::Rgb565(&[0x001F, 0x001F, 0xFFFF, 0x001F, 0x07E0, 0x07E0, 0x07E0, 0x07E0]),
///     encoding: Encoding::Srgb,
///     filter: Filter::Bilinear,
///     ends: Ends::Repeat,
/// };
/// // Turned by a quarter of a turn to the left, as seen from inside.
/// static TURNED: Panorama = Panorama { rotation: Vec3::new(0.0, 1.5708, 0.0), ..Panorama::new(MEADOW) };
/// let _background = Background::Image(&TURNED);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Panorama<'a> {
    /// The image.
    pub image: Image<'a>,
    /// The rotation about the x axis, then about y, then about z: angles in radians, counterclockwise as seen
    /// from the end of the axis.
    pub rotation: Vec3,
}

#[cfg(feature = "serde")]
crate::read::read_struct!([] Panorama as Panorama<'m> { image, rotation = Vec3::ZERO });

impl<'a> Panorama<'a> {
    /// The image without rotation.
    pub const fn new(image: Image<'a>) -> Self {
        Self { image, rotation: Vec3::ZERO }
    }

    pub(super) fn prepare<R: Real>(&'a self) -> Result<PreparedPanorama<'a, R>, Fault> {
        check_numbers(self.rotation)?;
        let (one, none) = (R::Setup::ONE, R::Setup::ZERO);
        let axis = |x, y, z| Vec3::from_setup(Vec3::<R::Setup>::new(x, y, z).rotated(self.rotation));
        Ok(PreparedPanorama {
            described: self,
            image: self.image.prepare_around()?,
            axes: [axis(one, none, none), axis(none, one, none), axis(none, none, one)],
        })
    }
}

/// A [`Panorama`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedPanorama<'m, R: Real> {
    described: &'m Panorama<'m>,
    image: PreparedImage<'m, R>,
    /// The axes of the image, as unit vectors in the scene.
    axes: [Vec3<R>; 3],
}

impl<R: Real> PreparedPanorama<'_, R> {
    pub(super) fn color(&self, direction: Vec3<R>) -> LinearRgb<R> {
        let [x, y, z] = self.axes.map(|axis| axis.dot(direction));
        // Longitude runs from +z toward -x, which is to the right as seen from inside. `globe` counts from x
        // toward -z.
        let [across, up] = globe(Vec3::new(z, y, x));
        self.image.at(across, up)
    }

    /// Whether both were prepared from the same description, compared by address.
    pub(super) fn is_same(&self, other: &PreparedPanorama<'_, R>) -> bool {
        ptr::addr_eq(self.described, other.described)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;
    use crate::texture::{Encoding, Ends, Filter, Pixels};

    /// Eight columns that become darker from left to right, in two lines; the upper one is pure red.
    const AROUND: Image = Image {
        width: 8,
        height: 2,
        pixels: Pixels::Rgb888(&[
            255, 0, 0, 223, 0, 0, 191, 0, 0, 159, 0, 0, 127, 0, 0, 95, 0, 0, 63, 0, 0, 31, 0, 0, //
            255, 9, 9, 223, 9, 9, 191, 9, 9, 159, 9, 9, 127, 9, 9, 95, 9, 9, 63, 9, 9, 31, 9, 9,
        ]),
        encoding: Encoding::Linear,
        filter: Filter::Nearest,
        ends: Ends::Extend,
    };

    fn seen<R: Real>(panorama: Panorama<'static>, direction: Vec3) -> [f32; 3] {
        let direction = direction.to::<R>().normalized().unwrap();
        let panorama: &Panorama = Box::leak(Box::new(panorama));
        let color = panorama.prepare::<R>().unwrap().color(direction).to_f32();
        [color.r, color.g, color.b].map(|channel| channel * 255.0)
    }

    fn assert_around<R: Real>() {
        let panorama = Panorama::new(AROUND);
        // In eighths of a turn from the left edge: behind, left, ahead, right, and behind again.
        for (x, z, red) in [
            (-0.1, 1.0, 255.0),
            (-1.0, 0.1, 223.0),
            (-1.0, -0.1, 191.0),
            (-0.1, -1.0, 159.0),
            (0.1, -1.0, 127.0),
            (1.0, -0.1, 95.0),
            (1.0, 0.1, 63.0),
            (0.1, 1.0, 31.0),
        ] {
            for (y, green) in [(0.1, 0.0), (-0.1, 9.0), (3.0, 0.0), (-3.0, 9.0)] {
                let got = seen::<R>(panorama, Vec3::new(x, y, z));
                let near = (got[0] - red).abs() < 0.01 && (got[1] - green).abs() < 0.01;
                assert!(near, "{got:?}, not {red}, {green} toward {x}, {y}, {z}");
            }
        }
    }

    #[test]
    fn the_right_half_of_the_image_is_on_the_right() {
        assert_around::<f32>();
        assert_around::<f64>();
        assert_around::<Fixed>();
    }

    fn assert_blended<R: Real>() {
        let smooth = Image { filter: Filter::Bilinear, ..AROUND };
        let panorama = Panorama::new(smooth);
        for (direction, red, green) in [
            // Straight ahead on the horizon: the middle of four pixels.
            (Vec3::new(0.0, 0.0, -1.0), 143.0, 4.5),
            // Behind, where the edges meet.
            (Vec3::new(0.0, 0.0, 1.0), 143.0, 4.5),
            (Vec3::new(1e-3, 0.0, 1.0), 143.0, 4.5),
            // An eighth of a turn above the horizon is the middle of the upper line; above it the line is
            // extended.
            (Vec3::new(0.0, 1.0, -1.0), 143.0, 0.0),
            (Vec3::new(0.0, 9.0, -1.0), 143.0, 0.0),
            (Vec3::new(0.0, -9.0, -1.0), 143.0, 9.0),
        ] {
            let got = seen::<R>(panorama, direction);
            let near = (got[0] - red).abs() < 0.4 && (got[1] - green).abs() < 0.02;
            assert!(near, "{got:?}, not {red}, {green} toward {direction:?}");
        }
    }

    #[test]
    fn pixels_are_blended_around_the_seam_but_not_across_the_poles() {
        assert_blended::<f32>();
        assert_blended::<f64>();
        assert_blended::<Fixed>();
    }

    #[test]
    fn panoramas_turn_like_textures() {
        let quarter = core::f32::consts::FRAC_PI_2;
        let turned = |rotation| Panorama { rotation, ..Panorama::new(AROUND) };
        for (rotation, direction) in [
            // A turn about y moves ahead to the left, one about x moves ahead up, one about z moves up to the
            // left.
            (Vec3::new(0.0, quarter, 0.0), [(0.1, 0.2, -1.0), (-1.0, 0.2, -0.1)]),
            (Vec3::new(quarter, 0.0, 0.0), [(0.1, 0.2, -1.0), (0.1, 1.0, 0.2)]),
            (Vec3::new(0.0, 0.0, quarter), [(0.1, 0.2, -1.0), (-0.2, 0.1, -1.0)]),
        ] {
            let [before, after] = direction.map(|(x, y, z)| Vec3::new(x, y, z));
            let expected = seen::<f64>(turned(Vec3::ZERO), before);
            assert_eq!(seen::<f64>(turned(rotation), after), expected, "{rotation:?}");
            assert_eq!(seen::<f32>(turned(rotation), after), seen::<f32>(turned(Vec3::ZERO), before));
            assert_eq!(seen::<Fixed>(turned(rotation), after), seen::<Fixed>(turned(Vec3::ZERO), before));
        }
    }

    #[test]
    fn the_poles_are_defined() {
        for y in [1.0, -1.0] {
            let green = if y > 0.0 { 0.0 } else { 9.0 };
            for got in [
                seen::<f32>(Panorama::new(AROUND), Vec3::new(0.0, y, 0.0)),
                seen::<f64>(Panorama::new(AROUND), Vec3::new(0.0, y, 0.0)),
                seen::<Fixed>(Panorama::new(AROUND), Vec3::new(0.0, y, 0.0)),
            ] {
                assert!((got[0] - 255.0).abs() < 0.01 && (got[1] - green).abs() < 0.01, "{got:?}");
            }
        }
    }
}
