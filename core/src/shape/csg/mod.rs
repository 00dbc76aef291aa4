//! Constructive solid geometry: one solid, combined from several, by the parts of a ray that lie in each
//! (Roth, "Ray Casting for Modeling Solids", Computer Graphics and Image Processing 18, 1982).
//!
//! Roth combines lists of parts, one list for each node of the tree. Here the boundaries of all solids stand
//! in one list, in the order along the ray. Each boundary flips the bit of its solid, which is 1 while the
//! ray is inside that solid. The tree is evaluated on the bits, and where its value changes there is a
//! surface. This method takes one array and one word, however the tree is nested, and no recursion.
//!
//! # Coinciding faces
//! Two solids that share a face, such as a block and the hole that goes through it, have boundaries there
//! that differ by rounding: thin dust would be left between them. Therefore boundaries count as one place if
//! they are nearer to each other, measured at a right angle to both faces, than the distance by which rays in
//! `f32` leave a surface ([`Real::offset`]). Only the insides before and after the whole place matter. So a
//! shared face is one surface or none, and walls that are thinner than this distance vanish. For rays that
//! graze a face at less than 1 : 1000, dust is not ruled out.

mod boundaries;
mod program;
#[cfg(test)]
mod tests;

use boundaries::{Boundaries, Boundary, Surfaces, with_room};
use program::{Bits, Program, fold};

use super::marching::{Lattice, Row};
use super::{Facet, Form, Geometry, Hull, Intersect, Silhouette, Solid, Tessellation, Tip};
use crate::arena::Arena;
use crate::fault::{Fault, Inner};
use crate::limits::MAX_CSG_SOLIDS;
use crate::math::{Aabb, Extent, Interval, Ray, Real, Scale, Vec3};
use crate::surface::Surface;

/// A solid that is combined from other solids. It cannot be a part of another [`Csg`]: nest its steps in the
/// other's.
///
/// The steps work on a stack. A solid is put on the stack; an operator takes the last two solids from the
/// stack, combines them, and puts the result on the stack.
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
    /// The steps, with at most [`MAX_CSG_SOLIDS`] solids. In the end, one solid must be on the stack.
    pub steps: &'a [CsgStep<S>],
}

/// A step of a [`Csg`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum CsgStep<S = Solid<'static>> {
    /// Puts a [solid](Geometry::is_solid) shape on the stack.
    Solid(S),
    /// All points in one of the last two solids, or in both.
    Union,
    /// All points in both of the last two solids.
    Intersection,
    /// All points in the last but one solid that are not in the last.
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

    /// The bytes of the lists of steps and solids, where `P` is a prepared solid.
    const fn list_bytes<R: Real, P>(steps: usize, solids: usize) -> usize {
        Arena::bytes::<P>(solids)
            .saturating_add(Arena::bytes::<CsgStep<()>>(steps))
            .saturating_add(Arena::bytes::<Tree<R>>(1))
    }
}

impl Csg<'_> {
    /// [`Geometry::bytes`], usable in constants.
    pub const fn const_bytes<R: Real>(&self) -> usize {
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
            // The iterator has `given` solids.
            let solid = unprepared.next().ok_or(Fault::NotOneSolid)?;
            solid.prepare(scale, memory).inspect_err(|_| memory.blame(Inner::Solid(index)))
        })?;
        // The largest coordinate of all solids, whose rounding is that of the result. At least that of `f32`,
        // since descriptions are rounded to `f32`.
        let Extent { solid, flat, plane } = self.extent();
        let magnitude = solid.larger(flat).larger(plane.unwrap_or(0.0));
        let rounding: R = scale.length(R::Setup::from_f32(f32::offset(magnitude)));
        let tolerance = rounding.larger(R::offset(scale.length(R::Setup::from_f32(magnitude))));
        // Pad the bounds: rays begin at the middle of the combined solid, so that a small solid is met with
        // the rounding of all; and the surface may be at any of the boundaries that count as one place.
        let bounds = bounds(self.steps, solids)?.map(|bounds| bounds.padded(tolerance + tolerance));
        let ball = bounds.map(|bounds| {
            let center = bounds.center();
            let radius = (bounds.max - center).length();
            (center, radius + R::offset(bounds.magnitude()))
        });
        let tree = memory.store(Tree { program, bounds, ball, tolerance })?;
        Ok(PreparedCsg { solids, tree })
    }
}

/// A box around the combined solid; `None` if it has no end.
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

/// The intersection of two boxes; a box without volume if they do not overlap.
fn common<R: Real>(a: Aabb<R>, b: Aabb<R>) -> Aabb<R> {
    let min = Vec3::new(a.min.x.larger(b.min.x), a.min.y.larger(b.min.y), a.min.z.larger(b.min.z));
    let max = Vec3::new(b.max.x.smaller(a.max.x), b.max.y.smaller(a.max.y), b.max.z.smaller(a.max.z));
    Aabb { min, max: Vec3::new(max.x.larger(min.x), max.y.larger(min.y), max.z.larger(min.z)) }
}

/// A part of the surface is numbered by the solid's part, in so many lower bits, and by the index of the
/// solid, above them.
const PART_BITS: u32 = 8;
/// The largest number of a solid's part; larger ones are stored as this one.
const MOST_PARTS: u32 = (1 << PART_BITS) - 1;

/// A [`Csg`], prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreparedCsg<'m, R, P> {
    solids: &'m [P],
    tree: &'m Tree<'m, R>,
}

/// The data of a [`PreparedCsg`], except the solids.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Tree<'m, R> {
    program: Program<'m>,
    bounds: Option<Aabb<R>>,
    /// Center and radius of a ball around the bounds.
    ball: Option<(Vec3<R>, R)>,
    /// Boundaries that are nearer to each other than this count as one place.
    tolerance: R,
}

/// A ray whose origin was moved along its line to the point nearest to the middle of the bounds.
struct Moved<R> {
    ray: Ray<R>,
    /// The distance from the old origin to the new one.
    advance: R,
}

impl<R: Real, P: Intersect<R>> PreparedCsg<'_, R, P> {
    /// Moves the origin of a ray near to the solids. Their boundaries along it are compared, so all solids
    /// must see the same ray, with the same rounding. `None` if the ray misses the bounds, or meets them
    /// outside of `range`.
    fn moved(&self, ray: &Ray<R>, range: Interval<R>) -> Option<Moved<R>> {
        let Some((center, radius)) = self.tree.ball else {
            return Some(Moved { ray: *ray, advance: R::ZERO });
        };
        let advance = (center - ray.origin).dot(ray.direction);
        let origin = ray.at(advance);
        let from_center = origin - center;
        let is_near = from_center.length_squared_wide() <= radius.times(radius);
        let is_in_range = advance + radius > range.min && advance - radius < range.max;
        (is_near && is_in_range).then_some(Moved { ray: Ray { origin, direction: ray.direction }, advance })
    }

    /// The surface of one solid as a surface of the combined solid, or the other way around.
    fn turned(&self, solid: u8, surface: Surface<R>) -> Surface<R> {
        if self.tree.program.is_subtracted(solid) {
            // The solid is subtracted: its inside is outside.
            let (normal, shading_normal) = (-surface.normal, -surface.shading_normal);
            Surface { normal, shading_normal, ..surface }
        } else {
            surface
        }
    }

    /// The solid that a surface belongs to, and the surface as that of the solid.
    fn on_solid(&self, surface: &Surface<R>) -> (u8, Surface<R>) {
        let (solid, part) = ((surface.part >> PART_BITS) as u8, surface.part & MOST_PARTS);
        (solid, self.turned(solid, Surface { part, ..*surface }))
    }

    /// A bit for each place in a row that lies inside the combined solid.
    fn insides(&self, row: &Row<R>) -> u32 {
        with_room(self.solids.len(), |room| {
            let boundaries = Boundaries::new(room, self.solids, &row.ray());
            let (places, mut around) = boundaries.parts();
            let (mut bits, mut min) = (0, -R::FARTHEST);
            let mut part = |around: Bits, max: R| {
                bits |=
                    if self.tree.program.is_inside(around) { row.within(Interval { min, max }) } else { 0 };
                min = max;
            };
            for Boundary { t, solid } in places {
                part(around, *t);
                around ^= (1 as Bits).wrapping_shl(u32::from(*solid));
            }
            part(around, R::FARTHEST);
            bits
        })
    }

    /// The surfaces of the combined solid along a ray.
    fn surfaces<'b>(&'b self, boundaries: &'b Boundaries<'_, R>, ray: &'b Ray<R>) -> Surfaces<'b, R, P> {
        Surfaces::new(boundaries, self.tree.program, self.solids, ray, self.tree.tolerance)
    }
}

impl<R: Real, P: Intersect<R>> Intersect<R> for PreparedCsg<'_, R, P> {
    // Not inlined: the boundaries may take a kilobyte of stack, which other shapes should not pay for.
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
        self.tree.bounds
    }

    // Not inlined: see `intersect`.
    #[inline(never)]
    fn surface(&self, ray: &Ray<R>, t: R) -> Surface<R> {
        // The same steps as in `intersect` lead to the same boundary.
        let everywhere = Interval { min: -R::FARTHEST, max: R::FARTHEST };
        let found = self.moved(ray, everywhere).and_then(|Moved { ray, advance }| {
            let off = |here: R| (advance + here - t).abs();
            let boundary = with_room(self.solids.len(), |room| {
                let boundaries = Boundaries::new(room, self.solids, &ray);
                self.surfaces(&boundaries, &ray).reduce(|a, b| if off(b.t) < off(a.t) { b } else { a })
            })?;
            let solid = self.solids.get(usize::from(boundary.solid))?;
            let mut surface = solid.surface(&ray, boundary.t);
            // Rays leave a ball by the offset of other shapes: boundaries within it count as one place.
            if let Form::Ball { center, radius } = solid.form() {
                surface.magnitude = center.magnitude() + radius;
            }
            Some((surface, boundary.solid))
        });
        let Some((surface, solid)) = found else {
            let normal = -ray.direction;
            let point = ray.at(t);
            return Surface { point, normal, shading_normal: normal, magnitude: point.magnitude(), part: 0 };
        };
        let part = u32::from(solid) << PART_BITS | surface.part.min(MOST_PARTS);
        self.turned(solid, Surface { part, ..surface })
    }

    fn uv(&self, surface: &Surface<R>, scale: Scale) -> [R; 2] {
        let (solid, surface) = self.on_solid(surface);
        self.solids.get(usize::from(solid)).map_or([R::ZERO; 2], |solid| solid.uv(&surface, scale))
    }
}

impl<R: Real, P: Silhouette<R>> Silhouette<R> for PreparedCsg<'_, R, P> {
    /// Part 0 is the box around the combined solid, which may be thin although its solids are thick. The
    /// further parts are the hulls of the solids, each of which may be thin.
    fn hull(&self, part: usize) -> Option<Hull<R>> {
        let Some(mut part) = part.checked_sub(1) else { return self.tree.bounds.map(Hull::aligned) };
        // Solids before that of the part are skipped by their number of hulls: listing all hulls would else
        // take a time that grows with the square of their number.
        for solid in self.solids {
            let hulls = solid.hulls();
            if part < hulls {
                return solid.hull(part);
            }
            part -= hulls;
        }
        None
    }

    fn hulls(&self) -> usize {
        let of_solids = self.solids.iter().map(Silhouette::hulls);
        // Without an end, the combined solid has no hull 0, and the others are not listed.
        if self.tree.bounds.is_some() { of_solids.fold(1, usize::saturating_add) } else { 0 }
    }

    /// The tips of all solids, which may also be tips of the combined solid.
    fn tip(&self, number: usize) -> Option<Tip<R>> {
        self.solids.iter().flat_map(|solid| (0..).map_while(|number| solid.tip(number))).nth(number)
    }

    fn each_facet(&self, tessellation: &Tessellation<R>, visit: &mut dyn FnMut(&Facet<R>)) {
        let insides = |row: &Row<R>| self.insides(row);
        if let Some(bounds) = self.tree.bounds {
            return Lattice::around(bounds, tessellation).each_facet(self, true, insides, visit);
        }
        // The solid has no end: show what is near the solids that have one.
        let bounds = self.solids.iter().filter_map(Intersect::bounds).reduce(Aabb::union);
        let Some(bounds) = bounds.map(|bounds| bounds.padded((bounds.max - bounds.min).magnitude())) else {
            return;
        };
        Lattice::within(bounds, tessellation).each_facet(self, false, insides, visit);
    }

    fn normal_beside(&self, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        let (number, on_solid) = self.on_solid(surface);
        let solid = self.solids.get(usize::from(number));
        let normal = solid.map_or(on_solid.shading_normal, |solid| solid.normal_beside(&on_solid, step));
        if self.tree.program.is_subtracted(number) { -normal } else { normal }
    }
}
