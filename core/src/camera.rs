//! The camera of a scene, and the mapping between pixels and rays.

use crate::fault::{Fault, check_direction, check_finite, check_point, unit};
use crate::lens::{Lens, PreparedLens};
use crate::math::{Aabb, Kernel, Ray, Real, Scale, Vec3};
#[cfg(feature = "distributed")]
use crate::sampling::Dimension;
use crate::sampling::RayNumbers;

/// A camera: a pinhole, or a thin lens.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Camera {
    /// The position of the camera. It may be inside of an object, but not on a curved surface such as a
    /// sphere: there rounding decides for each ray whether it begins inside.
    pub eye: Vec3,
    /// The point in the center of the picture.
    pub target: Vec3,
    /// The direction that points up in the picture; any length but 0, not along the line of sight.
    pub up: Vec3,
    /// The full vertical angle of view in radians, between 0 and π. Pixels are square: the horizontal angle
    /// follows from the width and height of the picture.
    pub vertical_fov: f32,
    /// The lens; `None`: a pinhole, through which everything is sharp.
    #[cfg_attr(feature = "serde", serde(default))]
    pub lens: Option<Lens>,
}

#[cfg(feature = "serde")]
crate::read::plain!(Camera);

/// A camera's orthonormal frame, checked and converted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedCamera<R: Real> {
    eye: Vec3<R>,
    forward: Vec3<R::Setup>,
    right: Vec3<R::Setup>,
    up: Vec3<R::Setup>,
    /// Half the height of the picture at distance 1.
    half_height: R::Setup,
    /// The lens, if there is room for one.
    lens: [Option<PreparedLens<R>>; LENSES],
}

/// The lenses of a camera. Without the feature there is no room for one.
const LENSES: usize = if cfg!(feature = "distributed") { 1 } else { 0 };

impl Camera {
    /// Checks the camera and builds its frame.
    pub(crate) fn prepare<R: Real>(&self, scale: Scale) -> Result<PreparedCamera<R>, Fault> {
        check_point(self.eye)?;
        check_point(self.target)?;
        check_finite(self.vertical_fov)?;
        if !(self.vertical_fov > 0.0 && self.vertical_fov < core::f32::consts::PI) {
            return Err(Fault::FieldOfView);
        }
        let half_height = (R::Setup::from_f32(self.vertical_fov) * R::Setup::from_f32(0.5)).tan();
        // Close to 180° the tangent is too large to compute with.
        if half_height > R::Setup::from_f32(1e4) || half_height < R::Setup::from_f32(1e-6) {
            return Err(Fault::FieldOfView);
        }
        let forward: Vec3<R::Setup> = unit(self.target - self.eye).map_err(|_| Fault::EyeAtTarget)?;
        let right = forward.cross(check_direction(self.up)?);
        if right.length() < R::Setup::from_f32(1e-4) {
            return Err(Fault::UpAlongView);
        }
        let right = right.normalized().ok_or(Fault::UpAlongView)?;
        if !scale.is_near::<R>(self.eye) {
            return Err(Fault::BeyondReach);
        }
        let eye = scale.point(self.eye.to());
        let lens = [self.prepare_lens(scale)?; LENSES];
        Ok(PreparedCamera { eye, forward, right, up: right.cross(forward), half_height, lens })
    }

    /// Checks the lens and converts it.
    fn prepare_lens<R: Real>(&self, scale: Scale) -> Result<Option<PreparedLens<R>>, Fault> {
        let Some(lens) = self.lens else { return Ok(None) };
        let prepared = lens.prepare(scale)?;
        // Rays begin anywhere on the lens.
        let edge = Vec3::new(lens.radius, lens.radius, lens.radius);
        if !(scale.is_near::<R>(self.eye + edge) && scale.is_near::<R>(self.eye - edge)) {
            return Err(Fault::BeyondReach);
        }
        Ok(Some(prepared))
    }
}

impl<R: Real> PreparedCamera<R> {
    /// The eye, where all camera rays begin.
    pub(crate) fn eye(&self) -> Vec3<R> {
        self.eye
    }

    /// Unit vectors to the right and up in the picture.
    fn right_and_up(&self) -> [Vec3<R>; 2] {
        [self.right, self.up].map(Vec3::from_setup)
    }
}

/// A camera and the size of a picture in pixels. It maps positions in the picture to rays, and points of the
/// scene to positions in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Viewport<R: Real> {
    camera: PreparedCamera<R>,
    /// The vector from the eye to the upper left corner of the picture.
    corner: Vec3<R>,
    /// The vector of `2^shift` pixels to the right.
    right: Vec3<R>,
    /// The vector of `2^shift` pixels down.
    down: Vec3<R>,
    /// See [`Real::from_pixel`]; 0 for floating point.
    shift: u32,
    /// Half the width and half the height in pixels.
    middle: (R::Setup, R::Setup),
    /// The lens, if there is room for one.
    lens: [Option<LensView<R>>; LENSES],
}

/// A lens, as the rays of a picture need it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LensView<R: Real> {
    lens: PreparedLens<R>,
    /// Unit vectors to the right and up in the picture.
    axes: [Vec3<R>; 2],
    /// The change of a ray's direction from the center of the lens to its edge.
    turn: R,
}

/// A row of camera rays: the part of their directions that their height in the picture adds. It is the same
/// for all pixels of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RayRow<R>(Vec3<R>);

impl<R: Real> RayRow<R> {
    /// The row along the picture's upper side.
    pub(crate) const TOP: Self = Self(Vec3::ZERO);
}

/// An affine function over the picture: `middle + u · right + v · down`, where u runs from -1 at the left to
/// 1 at the right, and v from -1 at the top to 1 at the bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine<T> {
    pub(crate) middle: T,
    pub(crate) right: T,
    pub(crate) down: T,
}

impl<T> Affine<T> {
    /// The function whose values are `linear` of the values of this function.
    pub(crate) fn map<U>(self, mut linear: impl FnMut(T) -> U) -> Affine<U> {
        Affine { middle: linear(self.middle), right: linear(self.right), down: linear(self.down) }
    }
}

/// A rectangle of the picture, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rect<N> {
    pub(crate) left: N,
    pub(crate) right: N,
    pub(crate) top: N,
    pub(crate) bottom: N,
}

impl<R: Real> LensView<R> {
    /// For a picture whose directions have a part along the line of sight that is as long as that of this
    /// `corner`.
    fn new(lens: PreparedLens<R>, camera: &PreparedCamera<R>, corner: Vec3<R>) -> Self {
        let forward = corner.to_setup().dot(camera.forward);
        let turn = R::from_setup(lens.radius_over_focus * forward);
        Self { lens, axes: camera.right_and_up(), turn }
    }
}

impl<R: Real> Viewport<R> {
    pub(crate) fn new(camera: &PreparedCamera<R>, width: u16, height: u16) -> Self {
        let number = R::Setup::from_u16;
        let pixel = if height == 0 {
            R::Setup::ZERO
        } else {
            camera.half_height * R::Setup::from_f32(2.0) * number(height).recip()
        };
        let half = pixel * R::Setup::from_f32(0.5);
        let corner =
            camera.forward - camera.right * (half * number(width)) + camera.up * (half * number(height));
        let (right, down) = (camera.right * pixel, -(camera.up * pixel));
        // The length of these vectors does not matter. In fixed point they are scaled up, so that as many
        // digits as possible are used.
        let (shift, unit) = if R::IS_FIXED_POINT {
            let shift = u16::BITS - width.max(height).leading_zeros();
            (shift, Self::unit(R::Setup::ONE + half * (number(width) + number(height)), shift))
        } else {
            (0, (R::Setup::ONE, R::Setup::ONE))
        };
        let (unit, step) = unit;
        let corner = Vec3::from_setup(corner * unit);
        let lens = camera.lens.map(|lens| Some(LensView::new(lens?, camera, corner)));
        Self {
            camera: *camera,
            corner,
            right: Vec3::from_setup(right * step),
            down: Vec3::from_setup(down * step),
            shift,
            middle: (number(width) * R::Setup::from_f32(0.5), number(height) * R::Setup::from_f32(0.5)),
            lens,
        }
    }

    /// The directions of the camera's rays over the picture; not unit vectors.
    #[inline(never)]
    pub(crate) fn directions(&self) -> Affine<Vec3<R::Setup>> {
        let camera = &self.camera;
        let (half_width, half_height) = self.middle;
        Affine {
            middle: camera.forward,
            right: camera.right * (camera.half_height * half_width / half_height),
            down: -(camera.up * camera.half_height),
        }
    }

    /// Half the width and half the height, in pixels.
    pub(crate) fn half_size(&self) -> (R::Setup, R::Setup) {
        self.middle
    }

    /// The eye, where all camera rays begin.
    pub(crate) fn eye(&self) -> Vec3<R> {
        self.camera.eye
    }

    /// Unit vectors to the right and up in the picture.
    pub(crate) fn right_and_up(&self) -> [Vec3<R>; 2] {
        self.camera.right_and_up()
    }

    /// Unit vectors to the right and up in the picture, and along the line of sight.
    pub(crate) fn axes(&self) -> [Vec3<R>; 3] {
        let [right, up] = self.right_and_up();
        [right, up, Vec3::from_setup(self.camera.forward)]
    }

    /// Half the width and height of the picture at depth 1.
    pub(crate) fn half_at_one(&self) -> [R; 2] {
        let (half_width, half_height) = self.middle;
        let half = self.camera.half_height;
        [half * half_width / half_height, half].map(R::from_setup)
    }

    /// The point at a place in the picture that lies at a depth along this line of sight.
    pub(crate) fn at_depth(&self, across: R, row: RayRow<R>, forward: Vec3<R>, depth: R) -> Vec3<R> {
        let direction = self.corner + self.right * across + row.0;
        self.camera.eye + direction * (depth / direction.dot(forward))
    }

    /// The largest power of two, at most 16, that scales a direction of this length to at most 16; and that
    /// power times `2^shift`.
    fn unit(length: R::Setup, shift: u32) -> (R::Setup, R::Setup) {
        let (half, mut unit) = (R::Setup::from_f32(0.5), R::Setup::from_f32(16.0));
        while length * unit > R::Setup::from_f32(16.0) && unit > R::Setup::ZERO {
            unit = unit * half;
        }
        (unit, unit * R::Setup::from_f32((1u32 << (shift & 31)) as f32))
    }

    /// The row of rays at a height in the picture.
    #[inline]
    pub(crate) fn row(&self, height: (u16, i32)) -> RayRow<R> {
        RayRow(self.down * self.across(height))
    }

    /// A distance from the left or upper side of the picture, given in pixels and 65536ths of a pixel: pixel
    /// 0 has its center at (0, 32768). The place may lie a few pixels outside of the picture.
    #[inline]
    pub(crate) fn across(&self, (pixel, within): (u16, i32)) -> R {
        // Only filters reach beyond the pixel.
        if cfg!(feature = "distributed") && u16::try_from(within).is_err() {
            return self.beside((pixel, within));
        }
        R::from_pixel(pixel, within as u16, self.shift)
    }

    /// [`across`](Self::across) beside the pixel.
    #[inline(never)]
    fn beside(&self, (pixel, within): (u16, i32)) -> R {
        let place = (i64::from(pixel) << 16) + i64::from(within);
        // The last pixel of the widest picture has none to its right.
        let distance = u32::try_from(place.unsigned_abs()).unwrap_or(u32::MAX);
        let distance = R::from_pixel((distance >> 16) as u16, distance as u16, self.shift);
        if place < 0 { -distance } else { distance }
    }

    /// The ray of a row at a distance from the left, see [`across`](Self::across). It begins in the eye, or
    /// at a place on the lens that the numbers draw: all rays through one place in the picture meet in the
    /// plane in focus.
    #[inline]
    pub(crate) fn ray(&self, across: R, row: RayRow<R>, numbers: &RayNumbers) -> Ray<R> {
        let (origin, direction) = (self.camera.eye, self.corner + self.right * across + row.0);
        // By `cfg!`, an M0 would take 1.02 times the instructions for `classic`.
        #[cfg(feature = "distributed")]
        let (origin, direction) = self.through_lens(origin, direction, numbers);
        #[cfg(not(feature = "distributed"))]
        let _ = numbers;
        // The length is at least 1, the distance of the picture from the eye.
        Ray { origin, direction: direction.unit() }
    }

    /// The ray from the eye through a place in the picture, moved to the place on the lens that the numbers
    /// draw. The direction is no unit vector.
    #[cfg(feature = "distributed")]
    fn through_lens(&self, eye: Vec3<R>, direction: Vec3<R>, numbers: &RayNumbers) -> (Vec3<R>, Vec3<R>) {
        let [Some(LensView { lens, axes, turn })] = &self.lens else { return (eye, direction) };
        let ([right, up], [unit_right, unit_up]) = (lens.place(numbers.pair(Dimension::LENS)), *axes);
        let beside = unit_right * right + unit_up * up;
        (eye + beside * lens.radius, direction - beside * *turn)
    }

    /// Whether rays begin all over a lens. Without the feature there is none, and the compiler drops the code
    /// that uses it.
    #[inline]
    pub(crate) fn has_lens(&self) -> bool {
        matches!(self.lens.first(), Some(Some(_)))
    }

    /// The viewport without its lens, if the lens is not seen: if whatever lies at the `nearest` depth or
    /// farther is blurred over less than half a pixel.
    #[cfg(feature = "distributed")]
    pub(crate) fn without_hidden_lens(self, nearest: impl FnOnce(&Self) -> Option<R::Setup>) -> Self {
        let [Some(view)] = self.lens else { return self };
        let Some(nearest) = nearest(&self) else { return self };
        // A point at the depth d covers a circle of the diameter 2 · |radius / focus - radius / d|, seen
        // from the eye. The largest circle is that of the nearest point, or of one infinitely far away.
        let far = view.lens.radius_over_focus;
        let near = view.lens.radius.to_setup() / nearest - far;
        let is_hidden = |half: R::Setup| half * R::Setup::from_f32(4.0) < self.pixel();
        if is_hidden(far) && is_hidden(near) { Self { lens: [None], ..self } } else { self }
    }

    /// The cosine of the angle between the line of sight and the ray to a corner of the picture.
    #[cfg(feature = "distributed")]
    pub(crate) fn least_cosine(&self) -> R::Setup {
        let Affine { middle, right, down } = self.directions();
        (middle + right + down).length().recip()
    }

    /// The depth of a point along the line of sight, and its distance from the eye.
    pub(crate) fn depth(&self, point: Vec3<R::Setup>) -> (R::Setup, R::Setup) {
        let toward = point - self.camera.eye.to_setup();
        (toward.dot(self.camera.forward), toward.length())
    }

    /// The width and height of a pixel at distance 1 in the middle of the picture. It is the largest angle
    /// that a pixel spans, in radians.
    pub(crate) fn pixel(&self) -> R::Setup {
        let (_, half_height) = self.middle;
        self.camera.half_height / half_height
    }

    /// The bounding rectangle, in pixels, of the projected corners of a box; `None` where a corner is not
    /// well in front of the camera.
    pub(crate) fn frame(&self, bounds: Aabb<R::Setup>) -> Option<Rect<R::Setup>> {
        let (far, near) = (R::Setup::FARTHEST, -R::Setup::FARTHEST);
        let mut frame = Rect { left: far, right: near, top: far, bottom: near };
        for corner in bounds.corners() {
            let (x, y) = self.project(corner)?;
            frame.left = if x < frame.left { x } else { frame.left };
            frame.right = frame.right.larger(x);
            frame.top = if y < frame.top { y } else { frame.top };
            frame.bottom = frame.bottom.larger(y);
        }
        Some(frame)
    }

    /// The unit normals of the two planes through the eye that bound the part of the scene seen between two
    /// heights of the picture, in pixels from the top. That part lies on the positive side of both.
    pub(crate) fn between(&self, top: R::Setup, bottom: R::Setup) -> [Vec3<R>; 2] {
        let camera = &self.camera;
        let (_, half_height) = self.middle;
        // The formula of `project`, multiplied by the depth.
        let below = |height: R::Setup| camera.forward * ((half_height - height) * self.pixel()) - camera.up;
        [below(top), -below(bottom)].map(|normal| Vec3::from_setup(normal.unit_and_length().0))
    }

    /// The position in the picture, in pixels from the left and the top, where a point is seen; `None` where
    /// the point is not well in front of the camera.
    pub(crate) fn project(&self, point: Vec3<R::Setup>) -> Option<(R::Setup, R::Setup)> {
        let camera = &self.camera;
        let toward = point - camera.eye.to_setup();
        let depth = toward.dot(camera.forward);
        if !(depth > toward.magnitude() * R::Setup::from_f32(1e-2)) {
            return None;
        }
        let (half_width, half_height) = self.middle;
        let pixels = half_height / camera.half_height / depth;
        Some((half_width + toward.dot(camera.right) * pixels, half_height - toward.dot(camera.up) * pixels))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAMERA: Camera = Camera {
        eye: Vec3::new(1.0, 2.0, 3.0),
        target: Vec3::new(1.0, 2.0, -7.0),
        up: Vec3::new(0.0, 5.0, 0.0),
        vertical_fov: core::f32::consts::FRAC_PI_2,
        lens: None,
    };

    #[test]
    fn a_right_angle_sees_as_far_up_as_forward() {
        let viewport = Viewport::new(&CAMERA.prepare::<f64>(Scale::ONE).unwrap(), 200, 100);
        let top = viewport.ray(viewport.across((100, 0)), viewport.row((0, 0)), &RayNumbers::NONE);
        assert_eq!(top.origin, Vec3::new(1.0, 2.0, 3.0));
        let half = core::f64::consts::FRAC_1_SQRT_2;
        assert!((top.direction - Vec3::new(0.0, half, -half)).length() < 1e-7);
        // Twice as wide as high: 63.4° to the right.
        let right =
            viewport.ray(viewport.across((200, 0)), viewport.row((50, 0)), &RayNumbers::NONE).direction;
        assert!((right.x / -right.z - 2.0).abs() < 1e-6 && right.y.abs() < 1e-12);
    }

    #[test]
    fn points_are_seen_where_their_rays_go() {
        let viewport = Viewport::new(&CAMERA.prepare::<f64>(Scale::ONE).unwrap(), 200, 100);
        for (x, y) in [(0, 0), (31, 77), (100, 50), (199, 3)] {
            let ray =
                viewport.ray(viewport.across((x, 0x8000)), viewport.row((y, 0x8000)), &RayNumbers::NONE);
            let seen = viewport.project(ray.at(7.0)).unwrap();
            let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            assert!((seen.0 - x).abs() < 1e-4 && (seen.1 - y).abs() < 1e-4, "{seen:?}");
        }
        assert_eq!(viewport.project(viewport.eye()), None);
        let behind = viewport.ray(viewport.across((5, 0)), viewport.row((5, 0)), &RayNumbers::NONE).at(-7.0);
        assert_eq!(viewport.project(behind), None);
    }

    #[test]
    fn bad_cameras_are_refused() {
        let refused = |camera: Camera| camera.prepare::<f32>(Scale::ONE).unwrap_err();
        assert_eq!(refused(Camera { target: CAMERA.eye, ..CAMERA }), Fault::EyeAtTarget);
        assert_eq!(refused(Camera { up: Vec3::new(0.0, 0.0, 3.0), ..CAMERA }), Fault::UpAlongView);
        assert_eq!(refused(Camera { up: Vec3::ZERO, ..CAMERA }), Fault::ZeroLength);
        for fov in [0.0, -1.0, core::f32::consts::PI, 3.1415925, 7.0] {
            assert_eq!(refused(Camera { vertical_fov: fov, ..CAMERA }), Fault::FieldOfView);
        }
        assert_eq!(refused(Camera { vertical_fov: f32::NAN, ..CAMERA }), Fault::NotFinite);
        assert_eq!(refused(Camera { eye: Vec3::new(2e6, 0.0, 0.0), ..CAMERA }), Fault::TooFar);
    }

    #[test]
    fn pictures_without_pixels_are_defined() {
        Viewport::new(&CAMERA.prepare::<f32>(Scale::ONE).unwrap(), 7, 0);
        Viewport::new(&CAMERA.prepare::<f32>(Scale::ONE).unwrap(), 0, 7);
    }
}
