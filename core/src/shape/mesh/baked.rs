//! Meshes that were prepared when the program was built, so that a device needs neither memory nor time for it.

use core::any::Any;

use super::super::Geometry;
use super::{Parts, PreparedMesh, SmallNormal};
use crate::arena::Arena;
use crate::fault::Fault;
use crate::hierarchy::{Hierarchy, Node};
use crate::math::{Aabb, Extent, Real, Scale, Vec3};

/// A [`Mesh`](super::Mesh) as it is prepared for the number system `N`: a shape that lies in flash with its hierarchy, and takes no
/// RAM. The module `bake` writes it, for the scene that it is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BakedMesh<N: Real> {
    parts: Parts<'static, N>,
    scale: f32,
    extent: f32,
}

/// What a [`BakedMesh`] is made of.
#[derive(Clone, Copy, Debug)]
pub struct BakedParts<'m, N: Real> {
    /// As in the description.
    pub triangles: &'m [[u16; 3]],
    /// As in the description, or none.
    pub uvs: &'m [[f32; 2]],
    /// The corners, in the number system and at its scale.
    pub vertices: &'m [Vec3<N>],
    /// One for each vertex, or none.
    pub normals: &'m [SmallNormal],
    /// The triangles that have an area, leaf by leaf.
    pub order: &'m [u16],
    /// The boxes around them, or none.
    pub nodes: &'m [Node<N>],
    /// The smallest and the largest corner of the box around all.
    pub bounds: [Vec3<N>; 2],
    /// What [`Scale::to_f32`] was for the scene.
    pub scale: f32,
    /// The largest coordinate of the description.
    pub extent: f32,
}

impl<N: Real> BakedMesh<N> {
    /// Puts a mesh together when the program is compiled.
    ///
    /// # Panics
    /// A node leads back to one before it: rays would never come to an end. Or nodes lie in more than
    /// [`MAX_HIERARCHY_DEPTH`](crate::limits::MAX_HIERARCHY_DEPTH) others, or one in several: rays have no room to remember so many.
    pub const fn new(baked: BakedParts<'static, N>) -> Self {
        let BakedParts { triangles, uvs, vertices, normals, order, nodes, bounds: [min, max], scale, extent } =
            baked;
        assert!(Node::lead_on(nodes), "the nodes of a baked mesh are out of order");
        assert!(Node::are_shallow(nodes), "the nodes of a baked mesh lie in too many others");
        let hierarchy = Hierarchy::baked(nodes, order);
        let bounds = Aabb { min, max };
        Self { parts: Parts { triangles, vertices, normals, uvs, hierarchy, bounds }, scale, extent }
    }
}

impl<N: Real> Geometry for &'static BakedMesh<N> {
    type Prepared<'m, R: Real> = PreparedMesh<'m, R>;

    fn extent(&self) -> Extent {
        Extent::flat(self.extent)
    }

    /// # Errors
    /// [`Fault::BakedOtherwise`]
    fn prepare<'m, R: Real>(&self, scale: Scale, _: &mut Arena<'m>) -> Result<PreparedMesh<'m, R>, Fault>
    where
        Self: 'm,
    {
        let parts: &'static Parts<'static, N> = &self.parts;
        // What kind of number it is, is known when this is compiled: no call remains.
        let parts = (parts as &dyn Any).downcast_ref::<Parts<'static, R>>();
        let prepared = parts.filter(|_| self.scale == scale.to_f32()).ok_or(Fault::BakedOtherwise)?;
        Ok(PreparedMesh(prepared))
    }
}

#[cfg(feature = "bake")]
impl super::Mesh<'_> {
    /// Prepares the mesh and tells its parts, for as long as `told` takes.
    ///
    /// # Errors
    /// What is wrong with the mesh.
    pub(crate) fn bake<N: Real, T>(
        &self,
        scale: Scale,
        told: impl FnOnce(BakedParts<'_, N>) -> T,
    ) -> Result<T, Fault> {
        let mut memory = std::vec![core::mem::MaybeUninit::uninit(); self.const_bytes::<N>()];
        let mesh = self.prepare::<N>(scale, &mut Arena::new(&mut memory))?;
        let Parts { triangles, uvs, vertices, normals, hierarchy, bounds: Aabb { min, max } } = *mesh.0;
        let (nodes, order) = hierarchy.parts();
        let (bounds, scale, extent) = ([min, max], scale.to_f32(), self.extent().flat);
        Ok(told(BakedParts { triangles, uvs, vertices, normals, order, nodes, bounds, scale, extent }))
    }
}
