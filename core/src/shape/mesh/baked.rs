//! Meshes that are prepared when the program is built, so that a device needs neither memory nor time to
//! prepare them.

use core::any::Any;

use super::super::Geometry;
use super::{MeshData, PreparedMesh, SmallNormal};
use crate::arena::Arena;
use crate::fault::Fault;
use crate::hierarchy::{Hierarchy, Node};
use crate::math::{Aabb, Extent, Real, Scale, Vec3};

/// A [`Mesh`](super::Mesh) that is already prepared for the number system `N`, with its hierarchy. It lies in
/// flash and takes no RAM. The module `bake` writes it as source code, for the scene that it is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BakedMesh<N: Real> {
    parts: MeshData<'static, N>,
    scale: f32,
    extent: f32,
}

/// The data of a [`BakedMesh`].
#[derive(Clone, Copy, Debug)]
pub struct BakedParts<'m, N: Real> {
    /// The triangles, as in the description.
    pub triangles: &'m [[u16; 3]],
    /// The coordinates u and v, as in the description, or none.
    pub uvs: &'m [[f32; 2]],
    /// The colors, as in the description, or none.
    pub colors: &'m [[u8; 3]],
    /// The vertices, in the number system and scaled.
    pub vertices: &'m [Vec3<N>],
    /// One for each vertex, or none.
    pub normals: &'m [SmallNormal],
    /// The indices of the triangles that have an area, leaf by leaf.
    pub order: &'m [u16],
    /// The nodes of the hierarchy, or none.
    pub nodes: &'m [Node<N>],
    /// The corners of the bounds with the smallest and with the largest coordinates.
    pub bounds: [Vec3<N>; 2],
    /// The longest way from a triangle to the smooth surface that rays leave; 0 if they leave the triangles.
    pub lift: N,
    /// The result of [`Scale::to_f32`] for the scene.
    pub scale: f32,
    /// The largest absolute coordinate of the description.
    pub extent: f32,
}

impl<N: Real> BakedMesh<N> {
    /// Makes a mesh of its data, when the program is compiled.
    ///
    /// # Panics
    /// If a node refers to one before it, as rays would visit them without end; if a node lies in more than
    /// one other node; or if nodes are nested deeper than
    /// [`MAX_HIERARCHY_DEPTH`](crate::limits::MAX_HIERARCHY_DEPTH), the room that rays have.
    pub const fn new(baked: BakedParts<'static, N>) -> Self {
        let BakedParts { triangles, uvs, colors, vertices, normals, bounds, lift, .. } = baked;
        let BakedParts { order, nodes, scale, extent, .. } = baked;
        let [min, max] = bounds;
        assert!(Node::lead_on(nodes), "the nodes of a baked mesh are out of order");
        assert!(Node::are_shallow(nodes), "the nodes of a baked mesh lie in too many others");
        let hierarchy = Hierarchy::baked(nodes, order);
        let bounds = Aabb { min, max };
        Self {
            parts: MeshData { triangles, vertices, normals, uvs, colors, hierarchy, bounds, lift },
            scale,
            extent,
        }
    }

    /// [`Geometry::bytes`], usable in constants.
    pub const fn const_bytes<R: Real>(&self) -> usize {
        0
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
        let parts: &'static MeshData<'static, N> = &self.parts;
        // Whether N is R is known when this is compiled, so that no call remains.
        let parts = (parts as &dyn Any).downcast_ref::<MeshData<'static, R>>();
        let prepared = parts.filter(|_| self.scale == scale.to_f32()).ok_or(Fault::BakedOtherwise)?;
        Ok(PreparedMesh(prepared))
    }
}

#[cfg(feature = "bake")]
impl super::Mesh<'_> {
    /// Prepares the mesh and calls `told` with its data.
    ///
    /// # Errors
    /// The fault of the mesh.
    pub(crate) fn bake<N: Real, T>(
        &self,
        scale: Scale,
        told: impl FnOnce(BakedParts<'_, N>) -> T,
    ) -> Result<T, Fault> {
        let mut memory = std::vec![core::mem::MaybeUninit::uninit(); self.const_bytes::<N>()];
        let mesh = self.prepare::<N>(scale, &mut Arena::new(&mut memory))?;
        let MeshData { triangles, uvs, colors, vertices, normals, hierarchy, bounds, lift } = *mesh.0;
        let (nodes, order) = hierarchy.parts();
        let (bounds, scale, extent) = ([bounds.min, bounds.max], scale.to_f32(), self.extent().flat);
        Ok(told(BakedParts {
            triangles,
            uvs,
            colors,
            vertices,
            normals,
            order,
            nodes,
            bounds,
            lift,
            scale,
            extent,
        }))
    }
}
