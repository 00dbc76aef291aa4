//! Constructive solid geometry: one solid out of several, by the parts of a ray that lie in each (Roth, "Ray Casting for
//! Modeling Solids", Computer Graphics and Image Processing 18, 1982).
//!
//! Roth puts lists of parts together, one for each node of the tree. Here all boundaries of all solids stand in one list, in the
//! order of the ray. Crossing one changes a bit: whether that solid is around. The tree is evaluated on the bits, and where
//! its value changes there is a surface. That takes one array and a word, however the tree is nested, and no recursion.
//!
//! # Coinciding faces
//! Two solids that share a face, such as a block and the hole that goes through it, have boundaries there that differ by
//! rounding: thin dust would be left between them. Therefore boundaries that lie nearer to each other than the distance by
//! which rays in `f32` leave a surface ([`Real::offset`]), measured across both, are one: what matters is what is around before and after
//! all of them. So a shared face is one surface or none, and walls that are thinner than that are not there. For rays that graze
//! a face at less than 1 : 1000 it is not made sure.

mod boundaries;
mod program;
#[cfg(test)]
mod tests;

use boundaries::{Boundaries, Surfaces, with_room};
use program::{Program, fold};

use super::{Geometry, Hull, Intersect, Solid, Tip};
use crate::arena::Arena;
use crate::fault::{Fault, Inner};
use crate::limits::MAX_CSG_SOLIDS;
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// A solid that is made of others. It is no part of another solid itself: nest its steps in the other's.
///
/// The steps are in the order in which one would build it: a solid is laid down, and an operator takes the last two that
/// lie there and leaves one.
///
/// ```
/// use rayline::Vec3;
/// use rayline::shape::{Csg, CsgStep, Cylinder, Solid, Sphere};
///
/// // A bead: a ball with a hole from top to bottom.
/// static BEAD: Csg = Csg::new(&[
///     CsgStep::Solid(Solid::Sphere(Sphere::new(Vec3::new(0.0, 0.0, 0.0), 1.0))),
///     CsgStep::Solid(Solid::Cylinder(Cylinder {
///         base: Vec3::new(0.0, -2.0, 0.0),
///         top: Vec3::new(0.0, 2.0, 0.0),
///         radius: 0.4,
///         capped: true,
///     })),
///     CsgStep::Difference,
/// ]);
/// # let _ = BEAD;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Csg<'a, S = Solid<'a>> {
    /// The steps, of which one solid is left in the end: at most [`MAX_CSG_SOLIDS`] solids.
    pub steps: &'a [CsgStep<S>],
}

/// A step on the way to a [`Csg`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum CsgStep<S = Solid<'static>> {
    /// Lays down a solid: a shape that [is one](Geometry::is_solid).
    Solid(S),
    /// What is in one of the last two, or in both.
    Union,
    /// What is in both of the last two.
    Intersection,
    /// What is in the last but one, but not in the last.
    Difference,
}

#[cfg(feature = "serde")]
crate::read::read_struct!([S: crate::read::Read<'m> + Copy] Csg as Csg<'m, S> { steps });

#[cfg(feature = "serde")]
crate::read::read_enum! {
    [S: crate::read::Read<'m>] CsgStep as CsgStep<S> { Solid(S), Union, Intersection, Difference }
}

impl<'a, S> Csg<'a, S> {
    /// The solid that these steps make.
    pub const fn new(steps: &'a [CsgStep<S>]) -> Self {
        Self { steps }
    }

    fn solids(&self) -> impl Iterator<Item = &'a S> + use<'a, S> {
        self.steps.iter().filter_map(|step| match step {
            CsgStep::Solid(solid) => Some(solid),
            _ => None,
        })
    }

    /// What lists of so many steps and solids take, where each of these takes `solid` bytes when it is prepared.
    const fn list_bytes<R: Real, P>(steps: usize, solids: usize) -> usize {
        Arena::bytes::<P>(solids)
            .saturating_add(Arena::bytes::<CsgStep<()>>(steps))
            .saturating_add(Arena::bytes::<Body<R>>(1))
    }
}

impl Csg<'_> {
    /// [`Geometry::bytes`], usable in constants.
    pub(super) const fn const_bytes<R: Real>(&self) -> usize {
        let (mut solids, mut bytes, mut i) = (0, 0usize, 0);
        while i < self.steps.len() {
            #[allow(clippy::indexing_slicing)]
            if let CsgStep::Solid(solid) = &self.steps[i] {
                solids += 1;
                bytes = bytes.saturating_add(solid.const_bytes::<R>());
            }
            i += 1;
        }
        bytes.saturating_add(Self::list_bytes::<R, <Solid<'_> as Geometry>::Prepared<'_, R>>(
            self.steps.len(),
            solids,
        ))
    }
}

impl<'a, S: Geometry + 'a> Geometry for Csg<'a, S> {
    type Prepared<'m, R: Real>
        = PreparedCsg<'m, R, S::Prepared<'m, R>>
    where
        Self: 'm;

    fn bytes<R: Real>(&self) -> usize {
        let lists = Self::list_bytes::<R, S::Prepared<'a, R>>(self.steps.len(), self.solids().count());
        self.solids().fold(lists, |sum, solid| sum.saturating_add(solid.bytes::<R>()))
    }

    fn extent(&self) -> Extent {
        self.solids().map(Geometry::extent).fold(Extent::default(), Extent::union)
    }

    fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<Self::Prepared<'m, R>, Fault>
    where
        Self: 'm,
    {
        let given = self.solids().count();
        if given > MAX_CSG_SOLIDS {
            return Err(Fault::TooManySolids { given });
        }
        if let Some(solid) = self.solids().position(|solid| !solid.is_solid()) {
            return Err(Fault::NotSolid { solid });
        }
        let program = Program::new(self.steps, memory)?;
        let mut unprepared = self.solids();
        let solids = &*memory.try_store_with(given, |index, memory| {
            // There is one for each.
            let solid = unprepared.next().ok_or(Fault::NotOneSolid)?;
            solid.prepare(scale, memory).inspect_err(|_| memory.blame(Inner::Solid(index)))
        })?;
        // Of all solids, since what is left of them is rounded as they are; in `f64` too, since descriptions are rounded to `f32`.
        let Extent { solid, flat, plane } = self.extent();
        let magnitude = solid.larger(flat).larger(plane.unwrap_or(0.0));
        let rounding: R = scale.length(R::Setup::from_f32(f32::offset(magnitude)));
        let tolerance = rounding.larger(R::offset(scale.length(R::Setup::from_f32(magnitude))));
        // Rays begin at the middle of the whole, so a small solid is met with the rounding of all; and of
        // boundaries that are one place, the surface may be either.
        let bounds = bounds(self.steps, solids)?.map(|bounds| bounds.padded(tolerance + tolerance));
        let ball = bounds.map(|bounds| {
            let center = bounds.center();
            let radius = (bounds.max - center).length();
            (center, radius + R::offset(bounds.magnitude()))
        });
        let body = memory.store(Body { program, bounds, ball, tolerance })?;
        Ok(PreparedCsg { solids, body })
    }
}

/// A box around the whole; `None` where it has no end.
fn bounds<R: Real, S, P: Intersect<R>>(steps: &[CsgStep<S>], solids: &[P]) -> Result<Option<Aabb<R>>, Fault> {
    let mut boxes = solids.iter().map(Intersect::bounds);
    let join = |step: &CsgStep<()>, left: Option<Aabb<R>>, right: Option<Aabb<R>>| match step {
        CsgStep::Intersection => match (left, right) {
            (Some(left), Some(right)) => Some(common(left, right)),
            (left, right) => left.or(right),
        },
        CsgStep::Difference => left,
        _ => left.zip(right).map(|(left, right)| left.union(right)),
    };
    fold(steps, None, |_| boxes.next().flatten(), join)
}

/// What two boxes have in common; a box without room where that is nothing.
fn common<R: Real>(a: Aabb<R>, b: Aabb<R>) -> Aabb<R> {
    let min = Vec3::new(a.min.x.larger(b.min.x), a.min.y.larger(b.min.y), a.min.z.larger(b.min.z));
    let max = Vec3::new(b.max.x.smaller(a.max.x), b.max.y.smaller(a.max.y), b.max.z.smaller(a.max.z));
    Aabb { min, max: Vec3::new(max.x.larger(min.x), max.y.larger(min.y), max.z.larger(min.z)) }
}

/// Of the number of a part of the surface, the lower bits are that of the solid's, the upper ones number the solids.
const PART_BITS: u32 = 8;
/// What is above is not told apart.
const MOST_PARTS: u32 = (1 << PART_BITS) - 1;

/// A [`Csg`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedCsg<'m, R, P> {
    solids: &'m [P],
    body: &'m Body<'m, R>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Body<'m, R> {
    program: Program<'m>,
    bounds: Option<Aabb<R>>,
    /// Around the bounds.
    ball: Option<(Vec3<R>, R)>,
    /// Nearer to each other than this, boundaries are one.
    tolerance: R,
}

/// A ray that begins where it is nearest to the middle, and the distance from there to its own origin.
struct Moved<R> {
    ray: Ray<R>,
    advance: R,
}

impl<R: Real, P: Intersect<R>> PreparedCsg<'_, R, P> {
    /// All solids are to see the same ray, with the same roundings, from nearby: their boundaries are compared. `None` where the
    /// ray passes by, or is elsewhere in `range`.
    fn moved(&self, ray: &Ray<R>, range: Interval<R>) -> Option<Moved<R>> {
        let Some((center, radius)) = self.body.ball else {
            return Some(Moved { ray: *ray, advance: R::ZERO });
        };
        let advance = (center - ray.origin).dot(ray.direction);
        let origin = ray.at(advance);
        let from_center = origin - center;
        let is_near = from_center.length_squared_wide() <= radius.times(radius);
        let is_in_range = advance + radius > range.min && advance - radius < range.max;
        (is_near && is_in_range).then_some(Moved { ray: Ray { origin, direction: ray.direction }, advance })
    }

    /// The surface of one of its solids as that of the whole, or the other way around.
    fn turned(&self, solid: u8, surface: Surface<R>) -> Surface<R> {
        if self.body.program.is_taken_away(solid) {
            // Its inside is outside.
            let (normal, shading_normal) = (-surface.normal, -surface.shading_normal);
            Surface { normal, shading_normal, ..surface }
        } else {
            surface
        }
    }

    /// A surface as the solid that it belongs to sees it, and which that is.
    fn on_solid(&self, surface: &Surface<R>) -> (u8, Surface<R>) {
        let (solid, part) = ((surface.part >> PART_BITS) as u8, surface.part & MOST_PARTS);
        (solid, self.turned(solid, Surface { part, ..*surface }))
    }

    fn surfaces<'b>(&'b self, boundaries: &'b Boundaries<'_, R>, ray: &'b Ray<R>) -> Surfaces<'b, R, P> {
        Surfaces::new(boundaries, self.body.program, self.solids, ray, self.body.tolerance)
    }
}

impl<R: Real, P: Intersect<R>> Intersect<R> for PreparedCsg<'_, R, P> {
    // Its boundaries may take a kilobyte: on no stack but its own.
    #[inline(never)]
    fn intersect(&self, ray: &Ray<R>, range: Interval<R>) -> Option<R> {
        let Moved { ray, advance } = self.moved(ray, range)?;
        with_room(self.solids.len(), |room| {
            let boundaries = Boundaries::new(room, self.solids, &ray);
            let surfaces = self.surfaces(&boundaries, &ray);
            surfaces.map(|boundary| advance + boundary.t).find(|t| range.contains(*t))
        })
    }

    fn bounds(&self) -> Option<Aabb<R>> {
        self.body.bounds
    }

    /// That of the whole, then those of its solids: of two that are thick, a thin part may be left, and of several that are far apart
    /// each may be thin.
    #[inline(never)]
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        let Some(part) = part.checked_sub(1) else { return self.body.bounds.map(Hull::aligned) };
        self.solids.iter().flat_map(|solid| (0..).map_while(|part| solid.hull(part))).nth(part)
    }

    /// Those of its solids: what is left of them may taper off there.
    fn tip(&self, number: usize) -> Option<Tip<R>> {
        self.solids.iter().flat_map(|solid| (0..).map_while(|number| solid.tip(number))).nth(number)
    }

    #[inline(never)]
    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        // The same steps as before lead to the same boundary.
        let everywhere = Interval { min: -R::FARTHEST, max: R::FARTHEST };
        let found = self.moved(ray, everywhere).and_then(|Moved { ray, advance }| {
            let off = |here: R| (advance + here - t).abs();
            let boundary = with_room(self.solids.len(), |room| {
                let boundaries = Boundaries::new(room, self.solids, &ray);
                self.surfaces(&boundaries, &ray).reduce(|a, b| if off(b.t) < off(a.t) { b } else { a })
            })?;
            let solid = self.solids.get(usize::from(boundary.solid))?;
            Some((solid.surface(&ray, boundary.t), boundary.solid))
        });
        let Some((surface, solid)) = found else {
            let normal = -ray.direction;
            let point = ray.at(t);
            return Surface { point, normal, shading_normal: normal, magnitude: point.magnitude(), part: 0 };
        };
        let part = u32::from(solid) << PART_BITS | surface.part.min(MOST_PARTS);
        self.turned(solid, Surface { part, ..surface })
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        let (number, on_solid) = self.on_solid(surface);
        let solid = self.solids.get(usize::from(number));
        let normal = solid.map_or(on_solid.shading_normal, |solid| solid.normal_beside(&on_solid, step));
        if self.body.program.is_taken_away(number) { -normal } else { normal }
    }

    fn uv(&self, surface: &Surface<R>, scale: Scale) -> [R; 2] {
        let (solid, surface) = self.on_solid(surface);
        self.solids.get(usize::from(solid)).map_or([R::ZERO; 2], |solid| solid.uv(&surface, scale))
    }
}
