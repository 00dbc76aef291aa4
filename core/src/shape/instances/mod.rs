//! Instances: one model in many places (Rubin and Whitted, "A 3-dimensional representation for fast rendering
//! of complex scenes", SIGGRAPH 1980). A ray is transformed to the place where the model was described, and
//! its hit is transformed back.
//!
//! # Memory
//! The model is prepared once. Each place takes 50 bytes in `f32` and fixed point, and up to 100 bytes if
//! there are more than [`FEW_POSES`], as these have boxes around them.
//!
//! # One size
//! All instances of a shape have the same size, and the model is prepared in that size. So distances along
//! the transformed ray are those along the ray itself: nothing is multiplied, no digit is lost, and a mesh
//! finds its triangle again by the exact distance. For another size, or another material, the model is
//! prepared once more.
//!
//! # No recursion
//! Instances contain no instances. [`Model`] has none, and a set of your own whose instances are of that set
//! does not compile, because the prepared instances contain the prepared model itself, not a reference to it.
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

use super::{Geometry, Intersect, Mesh};
use crate::arena::Arena;
use crate::fault::{Fault, Inner, check_coordinate, check_number};
use crate::hierarchy::Hierarchy;
use crate::limits::{MAX_COUNT, MIN_SIZE};
use crate::math::{Aabb, Extent, Real, Scale};
use pose::PreparedPose;
use prepared::Places;

/// One shape of one size in several places.
///
/// ```
/// use rayline::Vec3;
/// use rayline::shape::{Instances, Mesh, Model, Pose, Shape};
///
/// static TETRAHEDRON: Model = Model::Mesh(Mesh::new(
///     &[
///         Vec3::new(1.0, 1.0, 1.0),
///         Vec3::new(1.0, -1.0, -1.0),
///         Vec3::new(-1.0, 1.0, -1.0),
///         Vec3::new(-1.0, -1.0, 1.0),
///     ],
///     &[[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]],
/// ));
/// static PLACES: [Pose; 2] = [
///     Pose::at(Vec3::new(-2.0, 0.0, 0.0)),
///     Pose::at(Vec3::new(2.0, 0.0, 0.0)).turned(Vec3::new(0.0, 0.8, 0.0)),
/// ];
/// static TWINS: Shape = Shape::Instances(Instances::new(&TETRAHEDRON, &PLACES).sized(0.5));
/// ```
///
/// The coordinates u and v are those of the model. Instances may overlap; several are no
/// [solid](Geometry::is_solid), but a single one is, if its model is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Instances<'a, S = Model<'a>> {
    /// The shape that stands in each place, best described around its own origin. It must not contain
    /// instances.
    pub model: &'a S,
    /// The length of one unit of the model, in units of the scene: 1e-6 or more.
    pub size: f32,
    /// The places: one or more.
    pub poses: &'a [Pose],
}

#[cfg(feature = "serde")]
crate::read::read_struct! {
    [S: crate::read::Read<'m> + Copy] Instances as Instances<'m, S> { model, size = 1.0, poses }
}

/// The most instances that are tested one by one, without a hierarchy.
const FEW_POSES: usize = 4;

/// The most instances in a leaf of the hierarchy.
const LEAF: usize = 2;

/// The number of instances that the hierarchy has, for so many places.
const fn in_boxes(poses: usize) -> usize {
    if cfg!(feature = "hierarchy") && poses > FEW_POSES { poses } else { 0 }
}

impl<'a, S> Instances<'a, S> {
    /// A model in these places, in its own size.
    pub const fn new(model: &'a S, poses: &'a [Pose]) -> Self {
        Self { model, size: 1.0, poses }
    }

    /// The same instances in another size.
    pub const fn sized(self, size: f32) -> Self {
        Self { size, ..self }
    }

    /// The bytes that so many places take.
    const fn pose_bytes<R: Real>(poses: usize) -> usize {
        Arena::bytes::<Places<'_, R>>(1)
            .saturating_add(Arena::bytes::<PreparedPose<R>>(poses))
            .saturating_add(Arena::bytes::<u16>(poses))
            .saturating_add(Hierarchy::<R>::bytes(in_boxes(poses), LEAF))
    }
}

/// A trait cannot have a `const fn`, so each type of model has its own. `Mesh` is for a set of shapes whose
/// models are meshes only.
macro_rules! const_bytes {
    ($($Model:ty),+) => {
        $(impl Instances<'_, $Model> {
            /// [`Geometry::bytes`], usable in constants.
            pub const fn const_bytes<R: Real>(&self) -> usize {
                Self::pose_bytes::<R>(self.poses.len()).saturating_add(self.model.const_bytes::<R>())
            }
        })+
    };
}

const_bytes!(Model<'_>, Mesh<'_>);

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
        // The model must also fit where it was described, since rays are transformed to that place.
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
        let places = memory.store(Places { poses, hierarchy, bounds: all, sized })?;
        Ok(PreparedInstances::new(model, places))
    }
}
