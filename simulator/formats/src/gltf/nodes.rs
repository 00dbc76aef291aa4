//! Nodes and their transforms (glTF 2.0 Specification, section 3.5).

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use rayline::Vec3;
use rayline::limits::MAX_COORDINATE;
use rayline::shape::Pose;

use super::error::{At, GltfFault, Wrong, find, name};
use super::json::{Node, Root};
use crate::model::Moved;
use crate::notes::Notes;
use crate::space::angles;

/// A node of the scene with its transform.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<'f> {
    pub(super) index: usize,
    pub(super) node: &'f Node,
    pub(super) place: Place,
    /// Whether it or a node that contains it is invisible (`KHR_node_visibility`).
    pub(super) is_hidden: bool,
}

impl Placed<'_> {
    /// The name of the node in messages.
    pub(super) fn name(&self) -> String {
        name("node", self.index, self.node.name.as_ref())
    }

    /// The mesh, the skin, the weights of morph targets and the place: all that its picture depends on.
    pub(super) fn look(&self) -> Look {
        let weights = self.node.weights.as_ref();
        let weights = weights.map(|weights| weights.iter().map(|weight| weight.to_bits()).collect());
        (self.node.mesh, self.node.skin, weights, self.place.0.to_cols_array().map(f64::to_bits))
    }
}

/// See [`Placed::look`].
pub(super) type Look = (Option<usize>, Option<usize>, Option<Vec<u32>>, [u64; 12]);

/// The transform from the coordinates of a node to those of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place(DAffine3);

impl Place {
    /// The transform of the scene itself: identity.
    const ROOT: Self = Self(DAffine3::IDENTITY);

    /// The change of a scene that lies or reaches too far.
    pub(super) fn of_scene(moved: &Moved) -> Self {
        Self(moved.transform())
    }

    /// The transform by a matrix, column after column, whose last row is not read.
    pub(super) fn of_matrix(matrix: [f32; 16]) -> Self {
        Self(DAffine3::from_mat4(DMat4::from_cols_array(&matrix.map(f64::from))))
    }

    /// The transform that applies another one first, and then this one.
    pub(super) fn after(&self, first: &Self) -> Self {
        Self(self.0 * first.0)
    }

    /// The sum of transforms, each multiplied by its weight; `None` if the weights have no sum.
    pub(super) fn blended(parts: impl Iterator<Item = (f32, Self)>) -> Option<Self> {
        let (mut sum, mut weights) = (Self(DAffine3::from_mat3(DMat3::ZERO)), 0.0);
        for (weight, Self(part)) in parts {
            let weight = f64::from(weight);
            sum.0.matrix3 += part.matrix3 * weight;
            sum.0.translation += part.translation * weight;
            weights += weight;
        }
        let share = 1.0 / weights;
        let all = DAffine3 { matrix3: sum.0.matrix3 * share, translation: sum.0.translation * share };
        (weights > 0.0 && all.is_finite()).then_some(Self(all))
    }

    fn of(node: &Node) -> Result<DAffine3, GltfFault> {
        let place = match node.matrix {
            Some(matrix) => {
                let matrix = DMat4::from_cols_array(&matrix.map(f64::from));
                let last = matrix.row(3) - glam::DVec4::W;
                if last.abs().max_element() > 1e-6 {
                    return Err(GltfFault::Kind {
                        expected: "0, 0, 0 and 1 as the last row of its matrix",
                        found: format!("{}", matrix.row(3)),
                    });
                }
                DAffine3::from_mat4(matrix)
            }
            None => {
                let vector = |given: Option<[f32; 3]>, default| {
                    given.map_or(default, |vector| DVec3::from_array(vector.map(f64::from)))
                };
                let rotation =
                    DQuat::from_array(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]).map(f64::from));
                if rotation.length_squared() <= 0.0 {
                    return Err(GltfFault::Number { meaning: "the length of its rotation", found: 0.0 });
                }
                DAffine3::from_scale_rotation_translation(
                    vector(node.scale, DVec3::ONE),
                    rotation.normalize(),
                    vector(node.translation, DVec3::ZERO),
                )
            }
        };
        Self::checked(place)
    }

    fn checked(place: DAffine3) -> Result<DAffine3, GltfFault> {
        match place.to_cols_array().into_iter().find(|number| !number.is_finite()) {
            Some(found) => Err(GltfFault::Number { meaning: "a number of its place", found }),
            None => Ok(place),
        }
    }

    /// The uniform scale of this size.
    pub(super) fn scale(size: f64) -> Self {
        Self(DAffine3::from_scale(DVec3::splat(size)))
    }

    /// The size and the pose of a transform that scales evenly, turns and moves; `None` for others.
    pub(super) fn rigid(&self) -> Option<(f64, Pose)> {
        let DMat3 { x_axis: x, y_axis: y, z_axis: z } = self.0.matrix3;
        let size = self.0.matrix3.determinant().cbrt();
        let near = |number: f64, expected: f64| (number - expected).abs() <= 1e-6 * size * size;
        let is_even = [x, y, z].into_iter().all(|axis| near(axis.length_squared(), size * size));
        let is_square = [x.dot(y), y.dot(z), z.dot(x)].into_iter().all(|cosine| near(cosine, 0.0));
        let origin = rounded(self.0.translation);
        let is_held = [origin.x, origin.y, origin.z].into_iter().all(|at| at.abs() <= MAX_COORDINATE);
        let pose = || Pose { rotation: angles(&(self.0.matrix3 * (1.0 / size))), origin };
        (size > 0.0 && is_even && is_square && is_held).then(|| (size, pose()))
    }

    /// Whether the transform mirrors, and so exchanges the fronts and backs of triangles.
    pub(super) fn mirrors(&self) -> bool {
        self.0.matrix3.determinant() < 0.0
    }

    /// Transforms a point, computed in `f64` and rounded once.
    pub(super) fn point(&self, point: [f32; 3]) -> Vec3 {
        rounded(self.exact(point))
    }

    /// Transforms a point, not rounded.
    pub(super) fn exact(&self, point: [f32; 3]) -> DVec3 {
        self.0.transform_point3(DVec3::from_array(point.map(f64::from)))
    }

    /// Transforms a direction to a unit vector; `None` if its length becomes 0.
    pub(super) fn direction(&self, direction: [f32; 3]) -> Option<Vec3> {
        let direction = self.0.transform_vector3(DVec3::from_array(direction.map(f64::from)));
        direction.try_normalize().map(rounded)
    }

    /// The transform of normals: the transposed inverse, scaled.
    pub(super) fn of_normals(&self) -> impl Fn([f32; 3]) -> Vec3 {
        // Use cofactors, because a node that flattens its meshes has no inverse.
        let DMat3 { x_axis: x, y_axis: y, z_axis: z } = self.0.matrix3;
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let sign = if self.mirrors() { -1.0 } else { 1.0 };
        move |normal| {
            let normal = cofactors * DVec3::from_array(normal.map(f64::from)) * sign;
            rounded(normal.try_normalize().unwrap_or(DVec3::ZERO))
        }
    }
}

fn rounded(vector: DVec3) -> Vec3 {
    let [x, y, z] = vector.as_vec3().to_array();
    Vec3::new(x, y, z)
}

/// All nodes of the scene that is shown, parents before their children.
pub(super) fn placed<'f>(root: &'f Root, notes: &mut Notes) -> Result<Vec<Placed<'f>>, Wrong> {
    let (mut open, mut is_there) = (Vec::new(), vec![false; root.nodes.len()]);
    let mut placed = Vec::new();
    for top in tops(root, notes)?.into_iter().rev() {
        open.push((top, Place::ROOT, false));
    }
    while let Some((index, Place(outer), is_hidden)) = open.pop() {
        let node = find(&root.nodes, "node", index)?;
        let at = || name("node", index, node.name.as_ref());
        if let Some(is_there) = is_there.get_mut(index)
            && core::mem::replace(is_there, true)
        {
            return Err(GltfFault::Repeated).at(at);
        }
        let own = Place::of(node).at(at)?;
        let place = Place(Place::checked(outer * own).at(at)?);
        let is_hidden = is_hidden || !node.extensions.visibility.visible;
        for child in node.children.iter().rev() {
            find(&root.nodes, "node", *child).at(at)?;
            open.push((*child, place, is_hidden));
        }
        placed.push(Placed { index, node, place, is_hidden });
    }
    Ok(placed)
}

/// The root nodes of the scene that the file selects, else of its first scene, else of all nodes.
fn tops(root: &Root, notes: &mut Notes) -> Result<Vec<usize>, Wrong> {
    let named = root.scene.unwrap_or(0);
    if root.scenes.is_empty() && root.scene.is_none() {
        return Ok(without_parents(root));
    }
    let scene = find(&root.scenes, "scene", named)?;
    if scene.nodes.is_empty() {
        notes.add(name("scene", named, scene.name.as_ref()), "it has no nodes, so all of the file are shown");
        return Ok(without_parents(root));
    }
    for (index, other) in root.scenes.iter().enumerate().filter(|(index, _)| *index != named) {
        notes.add(name("scene", index, other.name.as_ref()), "left out, as only one scene is shown");
    }
    Ok(scene.nodes.clone())
}

/// All nodes that are no children.
fn without_parents(root: &Root) -> Vec<usize> {
    let mut is_child = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| &node.children) {
        if let Some(is_child) = is_child.get_mut(*child) {
            *is_child = true;
        }
    }
    (0..root.nodes.len()).filter(|index| is_child.get(*index) == Some(&false)).collect()
}

/// The places of all nodes of the file, those outside of the scene included. A node that contains itself has
/// none.
pub(super) fn everywhere(root: &Root) -> Vec<Option<Place>> {
    let mut places: Vec<Option<Place>> = vec![None; root.nodes.len()];
    let mut open: Vec<_> = without_parents(root).into_iter().map(|top| (top, Place::ROOT)).collect();
    while let Some((index, outer)) = open.pop() {
        let (Some(node), Some(place @ None)) = (root.nodes.get(index), places.get_mut(index)) else {
            continue;
        };
        let Ok(own) = Place::of(node) else { continue };
        let own = Place(outer.0 * own);
        *place = Some(own);
        open.extend(node.children.iter().map(|child| (*child, own)));
    }
    places
}
