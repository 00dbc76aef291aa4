//! The corner of a facet, seen from the camera.

use crate::color::LinearRgb;
use crate::math::{Real, Vec3};

/// The camera, as facets need it.
pub(super) struct View<R> {
    pub(super) eye: Vec3<R>,
    /// Unit vectors to the right, up, and along the line of sight.
    pub(super) axes: [Vec3<R>; 3],
    /// Half the width and height of the picture at depth 1.
    pub(super) half: [R; 2],
}

/// The corner of a facet, and its light. All numbers are linear in the point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner<R> {
    /// The point's distance to the right of the line of sight, and above it.
    pub(super) across: [R; 2],
    /// The distance of the picture's right and upper side at the same depth, on the same scale.
    pub(super) edge: [R; 2],
    /// The depth along the line of sight.
    pub(super) depth: R,
    pub(super) light: Light<R>,
}

/// Light that leaves the corner of a facet toward the eye.
#[derive(Clone, Copy, Debug)]
pub(super) struct Light<R> {
    /// Light that a texture's color is multiplied by.
    pub(super) scattered: LinearRgb<R>,
    /// Gray light that is added.
    pub(super) added: R,
}

impl<R: Real> View<R> {
    /// A corner at this point of the scene.
    pub(super) fn corner(&self, point: Vec3<R>, light: Light<R>) -> Corner<R> {
        let from_eye = point - self.eye;
        let [right, up, depth] = self.axes.map(|axis| axis.dot(from_eye));
        // The smaller of two numbers is scaled down: fixed point has little range.
        let scaled = |across: R, half: R| {
            if half > R::ONE { (across * half.recip(), depth) } else { (across, depth * half) }
        };
        let [half_width, half_height] = self.half;
        let ((x, right_edge), (y, upper_edge)) = (scaled(right, half_width), scaled(up, half_height));
        Corner { across: [x, y], edge: [right_edge, upper_edge], depth, light }
    }
}

impl<R: Real> Corner<R> {
    /// The point and the light on the way to another corner.
    pub(super) fn toward(&self, to: &Self, share: R) -> Self {
        let between = |from: R, to: R| from + (to - from) * share;
        let pair = |[a, b]: [R; 2], [c, d]: [R; 2]| [between(a, c), between(b, d)];
        let (from_light, to_light) = (self.light.scattered, to.light.scattered);
        Self {
            across: pair(self.across, to.across),
            edge: pair(self.edge, to.edge),
            depth: between(self.depth, to.depth),
            light: Light {
                scattered: from_light.scaled(R::ONE - share) + to_light.scaled(share),
                added: between(self.light.added, to.light.added),
            },
        }
    }

    /// The place in the picture from the left and from the top, as a share of its width and height in units
    /// of 1/65536, of a corner that is not clipped.
    pub(super) fn place(&self) -> [u32; 2] {
        let half = R::from_fraction(1 << 15);
        // From -1 to 1 across the picture, and from 0 to 1.
        let share = |across: R, edge: R, is_down: bool| {
            let share = across / edge * half;
            (if is_down { half - share } else { half + share }).to_q16()
        };
        let ([x, y], [right, upper]) = (self.across, self.edge);
        [share(x, right, false), share(y, upper, true)]
    }

    /// The light in units of 2⁻¹⁴, red, green and blue, and the gray one.
    pub(super) fn packed_light(&self) -> [u16; 4] {
        let LinearRgb { r, g, b } = self.light.scattered;
        let quarter = R::from_fraction(1 << 14);
        [r, g, b, self.light.added].map(|channel| (channel * quarter).to_q16().min(0xFFFF) as u16)
    }
}
