//! Instances: one model in many places (Rubin and Whitted, "A 3-dimensional representation for fast rendering of complex scenes",
//! SIGGRAPH 1980). A ray is brought to where the model is, and its hit back.
//!
//! # Memory
//! The model is prepared once, and a place takes 50 bytes in `f32` and fixed point; up to 100 where there are more than
//! [`FEW_POSES`], for the boxes around them. Sixteen smooth pawns of 500 triangles take 26 KB, and 387 KB as
//! sixteen meshes.
//!
//! # One size
//! All instances of a shape have one size, and the model is prepared in that. So distances along a ray are the same in both
//! places: nothing is multiplied, no digit is lost, and a mesh finds its triangle again by the very distance at which it was met.
//! In another size, or of another material, the model is prepared once more.
//!
//! Rejected: a size for each place, which in fixed point needs as many more digits as the sizes differ. Rejected as well: an object
//! for each place that finds out which others are like it. How much memory that takes could not be told in a constant, as
//! addresses are not known before the program is linked.
//!
//! # No recursion
//! Instances hold no instances: [`Model`] has none, and a set of one's own whose instances are of that set does not compile, because
//! the prepared model is a part of the prepared instances.
//!
//! ```compile_fail
//! rayline::shape_set! {
//!     /// Trees of trees.
//!     pub enum Trees<'a>;
//!     /// `Trees`, prepared.
//!     pub enum PreparedTrees {
//!         /// A tree.
//!         Trees(rayline::shape::Instances<'a, Trees<'a>>),
//!     }
//! }
//! ```

mod model;
mod pose;
mod prepared;
#[cfg(test)]
mod tests;

pub use model::{Model, PreparedModel};
pub use pose::Pose;
pub use prepared::PreparedInstances;

use super::{Geometry, Intersect};
use crate::arena::Arena;
use crate::fault::{Fault, Inner, check_coordinate, check_number};
use crate::hierarchy::Hierarchy;
use crate::limits::{MAX_COUNT, MIN_SIZE};
use crate::math::{Aabb, Extent, Real, Scale};
use pose::PreparedPose;
use prepared::Group;

/// One shape in one size, in as many places as there are.
///
/// ```
/// use rayline::Vec3;
/// use rayline::shape::{Instances, Mesh, Model, Pose, Shape};
///
/// static TETRAHEDRON: Model = Model::Mesh(Mesh {
///     vertices: &[
///         Vec3::new(1.0, 1.0, 1.0),
///         Vec3::new(1.0, -1.0, -1.0),
///         Vec3::new(-1.0, 1.0, -1.0),
///         Vec3::new(-1.0, -1.0, 1.0),
///     ],
///     triangles: &[[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]],
///     normals: None,
///     uvs: None,
/// });
/// static PLACES: [Pose; 2] = [
///     Pose::at(Vec3::new(-2.0, 0.0, 0.0)),
///     Pose::at(Vec3::new(2.0, 0.0, 0.0)).turned(Vec3::new(0.0, 0.8, 0.0)),
/// ];
/// static TWINS: Shape = Shape::Instances(Instances::new(&TETRAHEDRON, &PLACES).sized(0.5));
/// ```
///
/// The coordinates u and v are those of the model, as if it were by itself. Where instances overlap, each is there: together they
/// are no [solid](Geometry::is_solid). One alone is, if its model is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Instances<'a, S = Model<'a>> {
    /// What stands there: best around its own origin. It holds no instances.
    pub model: &'a S,
    /// How many units of the scene one of the model is: 1e-6 or more.
    pub size: f32,
    /// Where: one place or more.
    pub poses: &'a [Pose],
}

#[cfg(feature = "serde")]
crate::read::read_struct! {
    [S: crate::read::Read<'m> + Copy] Instances as Instances<'m, S> { model, size = 1.0, poses }
}

/// The most that are tested one by one.
const FEW_POSES: usize = 4;

/// The most in a leaf of the hierarchy.
const LEAF: usize = 2;

/// How many lie in boxes, of so many.
const fn in_boxes(poses: usize) -> usize {
    if cfg!(feature = "hierarchy") && poses > FEW_POSES { poses } else { 0 }
}

impl<'a, S> Instances<'a, S> {
    /// A model in these places, as large as it is.
    pub const fn new(model: &'a S, poses: &'a [Pose]) -> Self {
        Self { model, size: 1.0, poses }
    }

    /// The same in another size.
    pub const fn sized(self, size: f32) -> Self {
        Self { size, ..self }
    }

    /// What so many places take.
    const fn pose_bytes<R: Real>(poses: usize) -> usize {
        Arena::bytes::<Group<'_, R>>(1)
            .saturating_add(Arena::bytes::<PreparedPose<R>>(poses))
            .saturating_add(Arena::bytes::<u16>(poses))
            .saturating_add(Hierarchy::<R>::bytes(in_boxes(poses), LEAF))
    }
}

impl Instances<'_> {
    /// [`Geometry::bytes`], usable in constants.
    pub(super) const fn const_bytes<R: Real>(&self) -> usize {
        Self::pose_bytes::<R>(self.poses.len()).saturating_add(self.model.const_bytes::<R>())
    }
}

impl<'a, S: Geometry + 'a> Geometry for Instances<'a, S> {
    type Prepared<'m, R: Real>
        = PreparedInstances<'m, R, S::Prepared<'m, R>>
    where
        Self: 'm;

    fn bytes<R: Real>(&self) -> usize {
        Self::pose_bytes::<R>(self.poses.len()).saturating_add(self.model.bytes::<R>())
    }

    fn is_solid(&self) -> bool {
        self.poses.len() == 1 && self.model.is_solid()
    }

    fn extent(&self) -> Extent {
        let Extent { solid, flat, plane } = self.model.extent();
        // The model must be near where it was described, too: rays are brought there.
        let here = solid.larger(flat) * self.size;
        let there = self.poses.iter().map(|pose| pose.reach(here)).fold(here, Real::larger);
        let away = self.poses.iter().map(|pose| pose.origin.length()).fold(0.0, Real::larger);
        Extent { solid: there, flat: 0.0, plane: plane.map(|distance| distance * self.size + away) }
    }

    fn prepare<'m, R: Real>(
        &self,
        scale: Scale,
        memory: &mut Arena<'m>,
    ) -> Result<Self::Prepared<'m, R>, Fault>
    where
        Self: 'm,
    {
        let given = self.poses.len();
        if given == 0 {
            return Err(Fault::NoPoses);
        }
        if given > MAX_COUNT {
            return Err(Fault::TooMany { given });
        }
        check_number(self.size)?;
        if self.size < MIN_SIZE {
            return Err(Fault::InstanceSize);
        }
        self.poses.iter().try_for_each(Pose::check)?;
        check_coordinate(self.extent().solid)?;
        let sized = scale.enlarged(self.size);
        let model = self.model.prepare(sized, memory).inspect_err(|_| memory.blame(Inner::Model))?;
        let mut unprepared = self.poses.iter();
        let poses = &*memory.try_store_with(given, |_, _| {
            unprepared.next().map(|pose| pose.prepare(scale)).ok_or(Fault::NoPoses)
        })?;
        let order = memory.try_store_with(given, |index, _| Ok::<u16, Fault>(index as u16))?;
        let around = model.bounds();
        let bounds = |index: u16| poses.get(usize::from(index)).and_then(|pose| pose.bounds(around?));
        let all =
            around.and_then(|_| (0..given).filter_map(|index| bounds(index as u16)).reduce(Aabb::union));
        let hierarchy = if in_boxes(given) > 0 {
            Hierarchy::new(order, LEAF, bounds, memory)?
        } else {
            Hierarchy::list(order)
        };
        let group = memory.store(Group { poses, hierarchy, bounds: all, sized })?;
        Ok(PreparedInstances::new(model, group))
    }
}
