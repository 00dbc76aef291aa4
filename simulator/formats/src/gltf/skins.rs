//! Skins and morph targets: the shape of a mesh at rest (glTF 2.0 Specification, sections 3.7.2.2 and 3.7.3).

use super::accessor::Lists;
use super::error::{At, GltfFault, Wrong, find};
use super::json::{Mesh, Node, Primitive, Root};
use super::nodes::{Place, everywhere};

/// The transforms of the joints of all skins, computed when the first mesh has a skin.
#[derive(Debug, Default)]
pub(super) struct Skins {
    /// The change of a scene that lies or reaches too far; `None`: none.
    pub(super) moved: Option<Place>,
    /// The places of all nodes.
    places: Option<Vec<Option<Place>>>,
}

impl Skins {
    /// The transforms of a skin's joints: from the coordinates of the mesh to those of the scene.
    pub(super) fn joints(&mut self, lists: Lists<'_>, index: usize) -> Result<Vec<Place>, Wrong> {
        let root: &Root = lists.root;
        let skin = find(&root.skins, "skin", index)?;
        let places = self.places.get_or_insert_with(|| everywhere(root));
        let inverse = match skin.inverse_bind_matrices {
            Some(matrices) => Some(lists.vectors::<16>(matrices)?),
            None => None,
        };
        let place = |(number, joint): (usize, &usize)| {
            let place = *find(places, "node", *joint)?;
            let place = place.ok_or(GltfFault::Repeated)?;
            let place = self.moved.map_or(place, |moved| moved.after(&place));
            Ok(match &inverse {
                Some(matrices) => {
                    place.after(&Place::of_matrix(*find(matrices, "inverse bind matrix", number)?))
                }
                None => place,
            })
        };
        skin.joints.iter().enumerate().map(place).collect()
    }
}

/// The transforms of the vertices of a primitive, from its own coordinates to those of the scene.
#[derive(Debug)]
pub(super) enum Places {
    /// One transform for all vertices.
    One(Place),
    /// A transform for each vertex, and one for vertices that no joint moves.
    Each(Vec<Place>, Place),
}

impl Places {
    /// The transform of a vertex.
    pub(super) fn of(&self, vertex: usize) -> &Place {
        match self {
            Self::One(place) => place,
            Self::Each(places, other) => places.get(vertex).unwrap_or(other),
        }
    }

    /// Whether the transforms mirror, and so exchange the fronts and backs of triangles.
    pub(super) fn mirror(&self) -> bool {
        match self {
            Self::One(place) => place.mirrors(),
            Self::Each(places, _) => 2 * places.iter().filter(|place| place.mirrors()).count() > places.len(),
        }
    }

    /// The transforms by the joints and weights of a primitive.
    pub(super) fn skinned(
        lists: Lists<'_>,
        primitive: &Primitive,
        joints: &[Place],
        other: Place,
    ) -> Result<Self, Wrong> {
        let mut sets = Vec::new();
        // A mesh has as many sets as its vertices have joints, in fours.
        for set in 0.. {
            let attribute = |meaning: &str| primitive.attributes.get(&format!("{meaning}_{set}")).copied();
            let (Some(named), Some(weights)) = (attribute("JOINTS"), attribute("WEIGHTS")) else { break };
            let named = lists.joints(named).at(|| format!("JOINTS_{set}"))?;
            let weights = lists.vectors::<4>(weights).at(|| format!("WEIGHTS_{set}"))?;
            sets.push((named, weights));
        }
        let Some((first, _)) = sets.first() else {
            let found = "none".to_owned();
            return Err(GltfFault::Kind { expected: "joints and weights of vertices", found }.into());
        };
        let place = |vertex: usize| {
            let parts = sets.iter().filter_map(|(named, weights)| {
                Some(named.get(vertex)?.iter().copied().zip(weights.get(vertex)?.iter().copied()))
            });
            let mut moved = Vec::new();
            for (joint, weight) in parts.flatten().filter(|(_, weight)| *weight > 0.0) {
                moved.push((weight, *find(joints, "joint", joint as usize)?));
            }
            Ok(Place::blended(moved.into_iter()).unwrap_or(other))
        };
        Ok(Self::Each((0..first.len()).map(place).collect::<Result<_, GltfFault>>()?, other))
    }
}

/// The weights of the morph targets of a mesh at a node.
pub(super) fn weights<'f>(node: &'f Node, mesh: &'f Mesh) -> &'f [f32] {
    node.weights.as_deref().unwrap_or(&mesh.weights)
}

/// The positions of a primitive's vertices; `None` if they cannot be read.
pub(super) fn positions(lists: Lists<'_>, primitive: &Primitive) -> Option<Vec<[f32; 3]>> {
    lists.vectors::<3>(*primitive.attributes.get("POSITION")?).ok()
}

/// Adds the morph targets of a primitive to its positions or normals. A target with another number of
/// vertices is left out; the result is whether there was none.
pub(super) fn morph(
    lists: Lists<'_>,
    (primitive, weights): (&Primitive, &[f32]),
    meaning: &str,
    vectors: &mut [[f32; 3]],
) -> Result<bool, Wrong> {
    let mut is_whole = true;
    for (target, weight) in primitive.targets.iter().zip(weights) {
        let Some(accessor) = target.get(meaning).filter(|_| *weight != 0.0 && weight.is_finite()) else {
            continue;
        };
        let moves = lists.vectors::<3>(*accessor).at(|| format!("a morph target's {meaning}"))?;
        if moves.len() != vectors.len() {
            is_whole = false;
            continue;
        }
        for (number, by) in vectors.as_flattened_mut().iter_mut().zip(moves.as_flattened()) {
            *number += by * weight;
        }
    }
    Ok(is_whole)
}
