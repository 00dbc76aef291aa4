//! A facet in the picture, and the record of one pixel: its depth and its facet.

use crate::math::{Real, Vec3};

/// A triangle in the picture: memory for [`Preview`](super::Preview).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreviewFacet {
    /// The corners, from top to bottom and else from left to right: x and y in 16ths of a pixel.
    pub(super) corners: [[u16; 2]; 3],
    /// The inverse depth at the first corner, see [the module](super), and its changes from one pixel to the
    /// next, to the right and down, in units of 2^-`shift`.
    pub(super) inverse_depth: i32,
    pub(super) right: i32,
    pub(super) down: i32,
    pub(super) shift: u8,
    /// Whether the color comes from a texture, pixel by pixel.
    pub(super) is_textured: bool,
    /// The object's position in the scene.
    pub(super) object: u16,
    /// See [`Surface::part`](crate::Surface::part).
    pub(super) part: u32,
    /// The unit normal, in units of 2⁻¹⁴.
    pub(super) normal: [i16; 3],
    /// The distance of the facet's plane from the origin, along the normal.
    pub(super) distance: f32,
    /// The facet after this one in the list of those that reach the current line.
    pub(super) next: u16,
    /// At each corner red, green and blue light, which a texture's color is multiplied by, and gray light,
    /// which is added.
    pub(super) lights: [[u16; 4]; 3],
}

/// A pixel with the facet that it shows: memory for [`Preview`](super::Preview).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PreviewPixel {
    /// The inverse depth; 0 if nothing is seen.
    pub(super) inverse_depth: u32,
    /// The position of the facet in the list.
    pub(super) facet: u16,
}

impl PreviewFacet {
    /// Memory: all bits are 0, so that it takes no room in flash.
    pub const BLANK: Self = Self {
        corners: [[0; 2]; 3],
        inverse_depth: 0,
        right: 0,
        down: 0,
        shift: 0,
        is_textured: false,
        object: 0,
        part: 0,
        normal: [0; 3],
        distance: 0.0,
        next: 0,
        lights: [[0; 4]; 3],
    };

    /// The first line whose middle the facet covers, and the one after the last.
    pub(super) fn lines(&self) -> (u16, u16) {
        let [[_, top], _, [_, bottom]] = self.corners;
        (first_from(top), first_from(bottom))
    }
}

impl PreviewPixel {
    /// Memory: all bits are 0, so that it takes no room in flash.
    pub const BLANK: Self = Self { inverse_depth: 0, facet: 0 };
}

/// A unit vector in units of 2⁻¹⁴: vectors along the axes are exact.
pub(super) fn packed<R: Real>(Vec3 { x, y, z }: Vec3<R>) -> [i16; 3] {
    [x, y, z].map(|coordinate| {
        let size = (coordinate.abs().to_q16() >> 2) as i16;
        if coordinate < R::ZERO { -size } else { size }
    })
}

/// A unit vector from units of 2⁻¹⁴.
pub(super) fn unpacked<R: Real>(units: [i16; 3]) -> Vec3<R> {
    let [x, y, z] = units.map(|units| {
        let half = R::from_fraction(units.unsigned_abs() << 1);
        let size = half + half;
        if units < 0 { -size } else { size }
    });
    Vec3::new(x, y, z)
}

// The documentation of `Preview` states these sizes.
const _: () = assert!(size_of::<PreviewFacet>() <= 68 && size_of::<PreviewPixel>() <= 8);

/// No facet.
pub(super) const NONE: u16 = u16::MAX;

/// The first pixel whose middle lies at this place or beyond, given in 16ths of a pixel.
pub(super) fn first_from(place: u16) -> u16 {
    place.saturating_add(7) >> 4
}
