//! The objects of a scene, and where they are.

use crate::arena::Arena;
use crate::fault::Fault;
use crate::hierarchy::{Hierarchy, WIDE};
use crate::limits::FEW_OBJECTS;
use crate::material::PreparedMaterial;
use crate::math::{Aabb, FOUR_AT_ONCE, Real};
use crate::shape::Intersect;

/// An object that was checked and converted.
#[derive(Clone, Copy, Debug)]
pub(super) struct PreparedObject<'m, R: Real, P> {
    pub(super) shape: P,
    pub(super) material: &'m PreparedMaterial<'m, R>,
}

/// The most objects in a leaf of their hierarchy.
const LEAF: usize = if FOUR_AT_ONCE { 3 } else { 2 };

/// Of how many objects a hierarchy is stored: none where sets of candidates serve.
const fn stored(objects: usize) -> usize {
    if cfg!(feature = "hierarchy") && objects > FEW_OBJECTS { objects } else { 0 }
}

/// How many bytes the hierarchy of a scene takes.
pub(super) const fn hierarchy_bytes<R: Real>(objects: usize) -> usize {
    let objects = stored(objects);
    Arena::bytes::<u16>(objects).saturating_add(Hierarchy::<R, WIDE>::bytes(objects, LEAF))
}

/// Builds the hierarchy of a scene, unless that has few objects.
pub(super) fn hierarchy<'m, R: Real, P: Intersect<R>>(
    objects: &[PreparedObject<'_, R, P>],
    arena: &mut Arena<'m>,
) -> Result<Option<Hierarchy<'m, R, WIDE>>, Fault> {
    if stored(objects.len()) == 0 {
        return Ok(None);
    }
    let order = arena.try_store_with(objects.len(), |index, _| Ok::<u16, Fault>(index as u16))?;
    Hierarchy::new(order, LEAF, |object| bounds(objects, object), arena).map(Some)
}

/// In one place for all shapes: in preparation size counts more than time.
#[inline(never)]
fn bounds<R: Real, P: Intersect<R>>(objects: &[PreparedObject<R, P>], object: u16) -> Option<Aabb<R>> {
    objects.get(usize::from(object)).and_then(|object| object.shape.bounds())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    #[test]
    fn at_most_64_bytes_an_object() {
        assert_eq!(hierarchy_bytes::<f32>(32), 0);
        let most = if FOUR_AT_ONCE { 64 } else { 50 };
        for objects in [33, 820, 65_535] {
            assert!(hierarchy_bytes::<f32>(objects) <= most * objects);
            assert!(hierarchy_bytes::<Fixed>(objects) <= most * objects);
        }
    }
}
