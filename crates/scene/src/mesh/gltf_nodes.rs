//! The nodes of a glTF scene: meshes and their transforms.

use crate::mesh::error::{LocatedFault, MeshFault, MeshPlace};
use bodies::names_a_wheel;
use glam::{DMat4, DQuat, DVec3, DVec4};
use gltf::json::scene::Node;
use gltf::json::{Mesh, Root};

/// A mesh with its transform.
pub(crate) struct Instance {
    /// Index of an existing mesh.
    pub mesh: usize,
    /// Transform from the mesh's own axes to the scene's.
    pub scene_from_mesh: DMat4,
    /// Whether its name, that of its node, or that of an ancestor other than a root of the scene, is that of
    /// a road wheel. The name of a single root with children is that of the whole body, and so is the same
    /// name of the root's own mesh.
    pub is_of_wheel: bool,
}

/// A node waiting to be visited.
struct PendingNode {
    index: usize,
    scene_from_parent: DMat4,
    /// Whether an ancestor other than a root has the name of a wheel.
    is_of_wheel: bool,
    is_root: bool,
}

/// Every mesh of the scene that the file shows (else its first; without scenes, all nodes; without nodes,
/// each mesh untransformed), parents before children, in the order of the file.
pub(crate) fn instances(root: &Root) -> Result<Vec<Instance>, LocatedFault> {
    if root.nodes.is_empty() {
        let untransformed = |(index, mesh): (usize, &Mesh)| Instance {
            mesh: index,
            scene_from_mesh: DMat4::IDENTITY,
            is_of_wheel: mesh.name.as_deref().is_some_and(names_a_wheel),
        };
        return Ok(root.meshes.iter().enumerate().map(untransformed).collect());
    }
    let mut found = vec![];
    let mut reached = vec![false; root.nodes.len()];
    // An explicit stack: a chain of 10⁶ nodes must not overflow ours. Reversed, so that the first is popped
    // first.
    let of_root = |index: usize| PendingNode {
        index,
        scene_from_parent: DMat4::IDENTITY,
        is_of_wheel: false,
        is_root: true,
    };
    let roots = roots(root)?;
    let whole_body = name_of_whole_body(root, &roots);
    let mut pending: Vec<PendingNode> = roots.into_iter().rev().map(of_root).collect();
    while let Some(PendingNode { index, scene_from_parent, is_of_wheel, is_root }) = pending.pop() {
        let place = MeshPlace::Node(index);
        let count = root.nodes.len();
        let no_such = || MeshPlace::File.fault(MeshFault::NoSuch { what: "node", index, count });
        let node = root.nodes.get(index).ok_or_else(no_such)?;
        if std::mem::replace(&mut reached[index], true) {
            return Err(place.fault(MeshFault::NodeTwice));
        }
        let parent_from_node = transform(node).ok_or_else(|| place.fault(MeshFault::Transform))?;
        let scene_from_node = scene_from_parent * parent_from_node;
        let names_wheel = node.name.as_deref().is_some_and(names_a_wheel);
        let own = instance(root, place, node, scene_from_node)?;
        let of_whole = whole_body.filter(|_| is_root);
        let names_own = |mesh: usize| {
            let names = [node.name.as_deref(), root.meshes[mesh].name.as_deref()];
            names.into_iter().filter(|name| *name != of_whole).flatten().any(names_a_wheel)
        };
        found.extend(own.map(|own| Instance { is_of_wheel: is_of_wheel || names_own(own.mesh), ..own }));
        pending.extend(node.children.iter().flatten().rev().map(|child| PendingNode {
            index: child.value(),
            scene_from_parent: scene_from_node,
            is_of_wheel: is_of_wheel || (names_wheel && !is_root),
            is_root: false,
        }));
    }
    Ok(found)
}

fn roots(root: &Root) -> Result<Vec<usize>, LocatedFault> {
    let shown = root.scene.map_or(0, |scene| scene.value());
    if root.scenes.is_empty() && root.scene.is_none() {
        let mut is_child = vec![false; root.nodes.len()];
        let children = root.nodes.iter().flat_map(|node| node.children.iter().flatten());
        children.filter_map(|child| is_child.get_mut(child.value()).map(|flag| *flag = true)).for_each(drop);
        return Ok((0..root.nodes.len()).filter(|&i| !is_child[i]).collect());
    }
    let count = root.scenes.len();
    let no_such = || MeshPlace::File.fault(MeshFault::NoSuch { what: "scene", index: shown, count });
    let scene = root.scenes.get(shown).ok_or_else(no_such)?;
    Ok(scene.nodes.iter().map(|node| node.value()).collect())
}

/// Name of the only root if it has children: that of the whole body, which says nothing about its parts.
fn name_of_whole_body<'d>(root: &'d Root, roots: &[usize]) -> Option<&'d str> {
    let [only] = roots else { return None };
    let node = root.nodes.get(*only).filter(|node| node.children.iter().flatten().next().is_some())?;
    node.name.as_deref()
}

fn instance(
    root: &Root,
    place: MeshPlace,
    node: &Node,
    scene_from_mesh: DMat4,
) -> Result<Option<Instance>, LocatedFault> {
    let Some(mesh) = node.mesh.map(|mesh| mesh.value()) else { return Ok(None) };
    let count = root.meshes.len();
    if mesh >= count {
        return Err(place.fault(MeshFault::NoSuch { what: "mesh", index: mesh, count }));
    }
    // A skinned mesh ignores its node and follows joints: without them its place is arbitrary.
    if node.skin.is_some() {
        return Err(place.fault(MeshFault::Deformed("a skin")));
    }
    if node.weights.iter().flatten().any(|weight| *weight != 0.0) {
        return Err(place.fault(MeshFault::Deformed("morph weights")));
    }
    Ok(Some(Instance { mesh, scene_from_mesh, is_of_wheel: false }))
}

/// Transform of a node; `None` if it is not finite and affine.
fn transform(node: &Node) -> Option<DMat4> {
    let matrix = match node.matrix {
        Some(columns) => DMat4::from_cols_array(&columns.map(f64::from)),
        None => {
            let vector =
                |v: Option<[f32; 3]>, default: DVec3| v.map_or(default, |v| DVec3::from(v.map(f64::from)));
            let rotation = node.rotation.unwrap_or_default().0.map(f64::from);
            let rotation = DVec4::from(rotation).try_normalize().map(DQuat::from_vec4)?;
            let (scale, offset) = (vector(node.scale, DVec3::ONE), vector(node.translation, DVec3::ZERO));
            DMat4::from_scale_rotation_translation(scale, rotation, offset)
        }
    };
    (matrix.is_finite() && matrix.row(3) == DVec4::W).then_some(matrix)
}
