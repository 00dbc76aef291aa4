//! A box: the space between three pairs of planes (Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH
//! 1986).

use super::chord::Chord;
use super::tessellate::face;
use super::{Facet, Geometry, Hull, Intersect, Silhouette, Spans, Tessellation, uv};
use crate::arena::Arena;
use crate::fault::{Fault, check_coordinate, check_point, check_size, unit};
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// A box, in any position. Its faces are the [parts](Surface::part) 0 to 5: first the face on the negative
/// side of the first axis, then the face on its positive side, and so on. A box along the coordinate axes
/// saves each ray six scalar products.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Cuboid {
    /// The middle.
    pub center: Vec3,
    /// From the center to the middles of three faces, at right angles to each other.
    pub axes: [Vec3; 3],
}

impl Cuboid {
    /// The box along the coordinate axes between two opposite corners.
    pub const fn aligned(min: Vec3, max: Vec3) -> Self {
        let half = Vec3::new((max.x - min.x) * 0.5, (max.y - min.y) * 0.5, (max.z - min.z) * 0.5);
        Self {
            center: Vec3::new(min.x + half.x, min.y + half.y, min.z + half.z),
            axes: [Vec3::new(half.x, 0.0, 0.0), Vec3::new(0.0, half.y, 0.0), Vec3::new(0.0, 0.0, half.z)],
        }
    }

    /// The box around `center` with these `axes`: from the center to the middles of three faces.
    pub const fn oriented(center: Vec3, axes: [Vec3; 3]) -> Self {
        Self { center, axes }
    }

    /// Whether the first axis is along x, the second along y and the third along z.
    const fn is_aligned(&self) -> bool {
        let [a, b, c] = self.axes;
        a.y == 0.0 && a.z == 0.0 && b.z == 0.0 && b.x == 0.0 && c.x == 0.0 && c.y == 0.0
    }

    /// [`Geometry::bytes`], usable in constants.
    pub const fn const_bytes<R: Real>(&self) -> usize {
        if self.is_aligned() { 0 } else { Arena::bytes::<[Vec3<R>; 3]>(1) }
    }

    /// The largest absolute coordinate.
    fn reach(&self) -> f32 {
        let reach = |center: f32, a: f32, b: f32, c: f32| center.abs() + a.abs() + b.abs() + c.abs();
        let (center, [a, b, c]) = (self.center, self.axes);
        Vec3::new(
            reach(center.x, a.x, b.x, c.x),
            reach(center.y, a.y, b.y, c.y),
            reach(center.z, a.z, b.z, c.z),
        )
        .magnitude()
    }
}

/// The largest cosine of an angle that counts as a right one.
const RIGHT: f32 = 1e-3;

impl Geometry for Cuboid {
    type Prepared<'m, R: Real> = PreparedCuboid<'m, R>;

    fn bytes<R: Real>(&self) -> usize {
        self.const_bytes::<R>()
    }

    fn is_solid(&self) -> bool {
        true
    }

    fn extent(&self) -> Extent {
        Extent::flat(self.reach())
    }

    fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<PreparedCuboid<'m, R>, Fault>
    where
        Self: 'm,
    {
        check_point(self.center)?;
        self.axes.into_iter().try_for_each(check_point)?;
        check_coordinate(self.reach())?;
        let [a, b, c] = self.axes;
        let (first, second, third): (Vec3<R::Setup>, _, _) = (unit(a)?, unit(b)?, unit(c)?);
        let right = R::Setup::from_f32(RIGHT);
        let off = [first.dot(second), second.dot(third), third.dot(first)];
        if off.into_iter().any(|cosine| cosine.abs() > right) {
            return Err(Fault::NotAtRightAngles);
        }
        let half = [a, b, c].map(|axis| scale.length::<R>(axis.to::<R::Setup>().length()));
        half.into_iter().try_for_each(check_size)?;
        let axes = if self.is_aligned() {
            None
        } else {
            // Make the angles exact (Gram and Schmidt). The third axis keeps its side.
            let second = (second - first * first.dot(second)).normalized().ok_or(Fault::NotAtRightAngles)?;
            let across = first.cross(second);
            let third = if across.dot(third) < R::Setup::ZERO { -across } else { across };
            Some(memory.store([first, second, third].map(Vec3::from_setup))?)
        };
        let [x, y, z] = half;
        Ok(PreparedCuboid {
            center: scale.point(self.center.to()),
            half: Vec3::new(x, y, z),
            axes,
            magnitude: scale.length(R::Setup::from_f32(self.reach())),
        })
    }
}

/// A [`Cuboid`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedCuboid<'m, R> {
    center: Vec3<R>,
    /// The distances from the center to the faces.
    half: Vec3<R>,
    /// Unit vectors at right angles; `None` for the coordinate axes.
    axes: Option<&'m [Vec3<R>; 3]>,
    magnitude: R,
}

impl<R: Real> PreparedCuboid<'_, R> {
    /// The coordinates of a vector along the box's axes.
    #[inline]
    fn turned(&self, vector: Vec3<R>) -> Vec3<R> {
        match self.axes {
            None => vector,
            Some([a, b, c]) => Vec3::new(a.dot(vector), b.dot(vector), c.dot(vector)),
        }
    }

    /// Unit vectors along the edges.
    #[inline]
    fn unit_axes(&self) -> [Vec3<R>; 3] {
        let (one, none) = (R::ONE, R::ZERO);
        let units = [Vec3::new(one, none, none), Vec3::new(none, one, none), Vec3::new(none, none, one)];
        self.axes.copied().unwrap_or(units)
    }

    /// The part of a ray's line inside the box.
    #[inline]
    fn chord(&self, ray: &Ray<R>) -> Chord<R> {
        let (o, d) = (self.turned(ray.origin - self.center), self.turned(ray.direction));
        let mut chord = Chord::whole();
        for (o, d, half) in [(o.x, d.x, self.half.x), (o.y, d.y, self.half.y), (o.z, d.z, self.half.z)] {
            chord.between(-half - o, half - o, d);
        }
        chord
    }
}

impl<R: Real> Intersect<R> for PreparedCuboid<'_, R> {
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        self.chord(ray).first(range)
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        let reach = match self.axes {
            None => self.half,
            Some([a, b, c]) => {
                let positive = |v: &Vec3<R>| Vec3::new(v.x.abs(), v.y.abs(), v.z.abs());
                positive(a) * self.half.x + positive(b) * self.half.y + positive(c) * self.half.z
            }
        };
        Some(Aabb::around(self.center, reach).padded(R::offset(self.magnitude)))
    }

    fn spans(&self, ray: &Ray<R>) -> Spans<R> {
        self.chord(ray).spans()
    }

    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        let point = ray.at(t);
        let [a, b, c] = self.unit_axes();
        let place = self.turned(point - self.center);
        // The hit belongs to the nearest face.
        let behind = |half: R, place: R| (half - place.abs()).abs();
        let (x, y, z) =
            (behind(self.half.x, place.x), behind(self.half.y, place.y), behind(self.half.z, place.z));
        let (axis, place, half, part) = if x <= y && x <= z {
            (a, place.x, self.half.x, 0)
        } else if y <= z {
            (b, place.y, self.half.y, 2)
        } else {
            (c, place.z, self.half.z, 4)
        };
        let (normal, height, part) =
            if place < R::ZERO { (-axis, -place, part) } else { (axis, place, part + 1) };
        let point = point + normal * (half - height);
        Surface { point, normal, shading_normal: normal, magnitude: self.magnitude, part }
    }

    fn uv(&self, surface: &Surface<R>, _: Scale) -> [R; 2] {
        let Vec3 { x, y, z } = self.turned(surface.point - self.center);
        let (x, y, z) = (uv::share(x, self.half.x), uv::share(y, self.half.y), uv::share(z, self.half.z));
        // Upright on the sides: v is the second axis. On top and bottom, v runs along the third axis.
        match surface.part {
            0 => [z, y],
            1 => [R::ONE - z, y],
            2 => [x, z],
            3 => [x, R::ONE - z],
            4 => [R::ONE - x, y],
            _ => [x, y],
        }
    }
}

impl<R: Real> Silhouette<R> for PreparedCuboid<'_, R> {
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        let ([a, b, c], Vec3 { x, y, z }) = (self.unit_axes(), self.half);
        (part == 0).then_some(Hull { center: self.center, axes: [a * x, b * y, c * z], radius: R::ZERO })
    }

    fn each_facet(&self, _: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let [a, b, c] = self.unit_axes();
        let Vec3 { x, y, z } = self.half;
        let shift = |axis: Vec3<R>, is_upper: bool| if is_upper { axis } else { -axis };
        // The axes may be those of a mirror.
        let is_mirrored = a.cross(b).dot(c) < R::ZERO;
        for part in 0..6u8 {
            let (number, is_upper) = (part / 2, part % 2 != 0);
            let corners = [(false, false), (true, false), (true, true), (false, true)].map(|(next, last)| {
                // Exchange two corners to see the face from the other side.
                let (next, last) = if is_upper == is_mirrored { (last, next) } else { (next, last) };
                let (on_a, on_b, on_c) = match number {
                    0 => (is_upper, next, last),
                    1 => (last, is_upper, next),
                    _ => (next, last, is_upper),
                };
                self.center + shift(a * x, on_a) + shift(b * y, on_b) + shift(c * z, on_c)
            });
            let axis = match number {
                0 => a,
                1 => b,
                _ => c,
            };
            face(&corners, shift(axis, is_upper), part.into(), true, visit);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::*;
    use super::*;

    const BRICK: Cuboid = Cuboid::aligned(Vec3::new(-1.0, 0.0, 1.0), Vec3::new(3.0, 1.0, 3.0));
    const LEFT: Vec3 = Vec3::new(-1.0, 0.0, 0.0);
    const DOWN: Vec3 = Vec3::new(0.0, -1.0, 0.0);
    const HALF: f64 = core::f64::consts::FRAC_1_SQRT_2;

    /// A box that stands on an edge. Its square sides have a diagonal of 2.
    const ON_EDGE: Cuboid = Cuboid::oriented(
        Vec3::new(0.0, 1.0, 0.0),
        [Vec3::new(0.5, 0.5, 0.0), Vec3::new(-0.5, 0.5, 0.0), Vec3::new(0.0, 0.0, 0.75)],
    );

    /// The same box with its axes in another order, so that it is not prepared as an aligned one.
    fn renamed(cuboid: Cuboid) -> Cuboid {
        let [a, b, c] = cuboid.axes;
        Cuboid { axes: [b, -c, a], ..cuboid }
    }

    #[test]
    fn met_on_all_faces_from_outside_and_from_inside() {
        for cuboid in [BRICK, renamed(BRICK)] {
            assert_meets(cuboid, Vec3::new(5.0, 0.5, 2.0), LEFT, 2.0, [1.0, 0.0, 0.0]);
            assert_meets(cuboid, Vec3::new(-5.0, 0.5, 2.0), -LEFT, 4.0, [-1.0, 0.0, 0.0]);
            assert_meets(cuboid, Vec3::new(0.0, 3.0, 2.5), DOWN, 2.0, [0.0, 1.0, 0.0]);
            assert_meets(cuboid, Vec3::new(0.0, -3.0, 2.5), -DOWN, 3.0, [0.0, -1.0, 0.0]);
            assert_meets(cuboid, Vec3::new(2.0, 0.25, 9.0), Vec3::new(0.0, 0.0, -1.0), 6.0, [0.0, 0.0, 1.0]);
            assert_meets(
                cuboid,
                Vec3::new(2.0, 0.25, -9.0),
                Vec3::new(0.0, 0.0, 1.0),
                10.0,
                [0.0, 0.0, -1.0],
            );
            assert_meets(cuboid, Vec3::new(1.5, 0.5, 2.0), LEFT, 2.5, [-1.0, 0.0, 0.0]);
            let slant = Vec3::new(3.0, -4.0, 0.0);
            assert_meets(cuboid, Vec3::new(-3.0, 5.0, 2.0), slant, 5.0, [0.0, 1.0, 0.0]);
        }
    }

    #[test]
    fn missed_beside_and_behind() {
        for cuboid in [BRICK, renamed(BRICK)] {
            assert_misses(cuboid, Vec3::new(5.0, 1.1, 2.0), LEFT);
            assert_misses(cuboid, Vec3::new(5.0, 0.5, 3.1), LEFT);
            assert_misses(cuboid, Vec3::new(5.0, 0.5, 2.0), -LEFT);
            assert_misses(cuboid, Vec3::new(-1.1, 5.0, 2.0), DOWN);
            // Close to an edge.
            assert_misses(cuboid, Vec3::new(2.0, 2.1, 2.0), Vec3::new(1.0, -1.0, 0.0));
        }
    }

    #[test]
    fn met_on_its_edge() {
        assert_meets(ON_EDGE, Vec3::new(0.25, 5.0, 0.2), DOWN, 3.25, [HALF, HALF, 0.0]);
        assert_meets(ON_EDGE, Vec3::new(-0.25, 5.0, 0.2), DOWN, 3.25, [-HALF, HALF, 0.0]);
        assert_meets(ON_EDGE, Vec3::new(5.0, 0.5, 0.0), LEFT, 4.5, [HALF, -HALF, 0.0]);
        assert_misses(ON_EDGE, Vec3::new(0.25, 5.0, 0.8), DOWN);
        assert_misses(ON_EDGE, Vec3::new(1.1, 5.0, 0.0), DOWN);
    }

    #[test]
    fn faces_are_numbered_against_and_along_each_axis() {
        let mut memory = Memory::new();
        for cuboid in [BRICK, ON_EDGE] {
            let prepared = prepared::<_, f32>(cuboid, &mut memory).unwrap();
            let ways = cuboid.axes.into_iter().flat_map(|axis| [-axis, axis]);
            for (face, way) in (0..).zip(ways) {
                let outside =
                    Ray { origin: cuboid.center + way * 3.0, direction: -way.normalized().unwrap() };
                let t = prepared.intersect(&outside, Interval::AHEAD).unwrap();
                assert_eq!(prepared.surface(&outside, t).part, face);
            }
        }
    }

    #[test]
    fn its_inside_is_a_chord() {
        for cuboid in [BRICK, renamed(BRICK)] {
            for (x, near) in [(5.0, 2.0), (1.0, -2.0), (-5.0, -8.0)] {
                assert_spans(cuboid, Vec3::new(x, 0.5, 2.0), LEFT, &[(near, near + 4.0)]);
            }
            // From the top to a side, near an edge.
            let slant = Vec3::new(1.0, -1.0, 0.0);
            assert_spans(cuboid, Vec3::new(2.5, 1.25, 2.0), slant, &[(0.5 * HALF, HALF)]);
            assert_spans(cuboid, Vec3::new(5.0, 1.5, 2.0), LEFT, &[]);
        }
        assert_spans(ON_EDGE, Vec3::new(5.0, 0.5, 0.0), LEFT, &[(4.5, 5.5)]);
        for extent in EXTENTS {
            let middle = Vec3::new(0.3, -0.7, 0.2) * extent;
            assert_spans_are_met(leaning(middle, extent), middle, extent, 2_000);
            let reach = Vec3::new(0.9, 0.4, 0.6) * extent;
            assert_spans_are_met(Cuboid::aligned(middle - reach, middle + reach), middle, extent, 2_000);
        }
    }

    #[test]
    fn bounds_are_tight() {
        let mut memory = Memory::new();
        let bounds = prepared::<_, f32>(ON_EDGE, &mut memory).unwrap().bounds().unwrap();
        assert!((bounds.min - Vec3::new(-1.0, 0.0, -0.75)).magnitude() < 1e-4, "{bounds:?}");
        assert!((bounds.max - Vec3::new(1.0, 2.0, 0.75)).magnitude() < 1e-4, "{bounds:?}");
    }

    /// A box none of whose axes is along a coordinate axis.
    fn leaning(center: Vec3, extent: f32) -> Cuboid {
        let (a, b) = (Vec3::new(0.6, 0.3, -0.2) * extent, Vec3::new(-0.1, 0.6, 0.6) * extent);
        Cuboid::oriented(center, [a, b, a.cross(b) * (0.7 / extent)])
    }

    #[test]
    fn spawned_rays_do_not_meet_their_own_surface() {
        for extent in EXTENTS {
            let middle = Vec3::new(0.3, -0.7, 0.2) * extent;
            assert_no_self_hits(leaning(middle, extent), middle, extent, 20_000);
            let reach = Vec3::new(0.9, 0.4, 0.6) * extent;
            assert_no_self_hits(Cuboid::aligned(middle - reach, middle + reach), middle, extent, 20_000);
        }
    }

    #[test]
    fn bad_boxes_are_refused() {
        let [a, b, c] = BRICK.axes;
        let refused = |axes: [Vec3; 3]| refusal(Cuboid { axes, ..BRICK });
        assert_eq!(refused([a, b, Vec3::ZERO]), Fault::ZeroLength);
        assert_eq!(refused([a, b + a * 0.1, c]), Fault::NotAtRightAngles);
        assert_eq!(refused([a, b, a]), Fault::NotAtRightAngles);
        assert_eq!(refused([a, b * f32::NAN, c]), Fault::NotFinite);
        assert_eq!(refused([a, b * 4e6, c]), Fault::TooFar);
        assert_eq!(refusal(Cuboid { center: Vec3::new(999_999.0, 0.0, 0.0), ..BRICK }), Fault::TooFar);
    }

    #[test]
    fn coordinates_are_upright_on_each_face() {
        assert_uv(BRICK, Vec3::new(0.0, 0.25, 9.0), Vec3::new(0.0, 0.0, -1.0), [0.25, 0.25]);
        assert_uv(BRICK, Vec3::new(0.0, 0.25, -9.0), Vec3::new(0.0, 0.0, 1.0), [0.75, 0.25]);
        assert_uv(BRICK, Vec3::new(9.0, 0.25, 1.5), LEFT, [0.75, 0.25]);
        assert_uv(BRICK, Vec3::new(-9.0, 0.25, 1.5), -LEFT, [0.25, 0.25]);
        assert_uv(BRICK, Vec3::new(0.0, 9.0, 1.5), DOWN, [0.25, 0.75]);
        assert_uv(BRICK, Vec3::new(0.0, -9.0, 1.5), -DOWN, [0.25, 0.25]);
    }

    #[test]
    fn corners_may_be_named_in_any_order() {
        let (one, other) = (Vec3::new(3.0, 0.0, 3.0), Vec3::new(-1.0, 1.0, 1.0));
        assert_meets(Cuboid::aligned(one, other), Vec3::new(5.0, 0.5, 2.0), LEFT, 2.0, [1.0, 0.0, 0.0]);
    }
}
