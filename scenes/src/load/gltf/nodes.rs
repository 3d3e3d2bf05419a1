//! The nodes of a scene: the meshes in it and their transforms.

use super::Oddities;
use super::container::File;
use crate::error::SceneError;
use glam::{DMat4, DQuat, DVec3};
use gltf_json::{Index, Mesh, Node};

/// A mesh at its place in the world.
pub(super) struct Placed {
    /// The mesh' and the node's indices.
    pub(super) mesh: usize,
    pub(super) node: usize,
    pub(super) to_world: DMat4,
}

/// The meshes of the scene that is drawn, each once for every node that has it, parents before their children.
pub(super) fn meshes(file: &File, oddities: &mut Oddities) -> Result<Vec<Placed>, SceneError> {
    let root = &file.root;
    if root.scenes.len() > 1 {
        let drawn = root.scene.map_or(0, |scene| scene.value());
        oddities.add(&format!("it holds {} scenes, of which scene {drawn} is drawn", root.scenes.len()));
    }
    let mut stack: Vec<(usize, DMat4)> = roots(file).into_iter().rev().map(|node| (node, DMat4::IDENTITY)).collect();
    let mut seen = vec![false; root.nodes.len()];
    let mut placed = Vec::new();
    while let Some((index, parent)) = stack.pop() {
        if std::mem::replace(&mut seen[index], true) {
            let problem = format!("nodes[{index}] has two parents, or is below itself");
            return Err(file.wrong(&problem, "give each node one parent"));
        }
        let node = &root.nodes[index];
        let to_world = parent * to_parent(node);
        if let Some(mesh) = node.mesh {
            note(node, &root.meshes[mesh.value()], oddities);
            placed.push(Placed { mesh: mesh.value(), node: index, to_world });
        }
        let children = node.children.iter().flatten().rev();
        stack.extend(children.map(|child: &Index<Node>| (child.value(), to_world)));
    }
    Ok(placed)
}

/// The root nodes: those of the scene, or, if the file has no scene, those that are below no other.
fn roots(file: &File) -> Vec<usize> {
    let root = &file.root;
    let scene = root.scene.map_or(0, |scene| scene.value());
    if let Some(scene) = root.scenes.get(scene) {
        return scene.nodes.iter().map(Index::value).collect();
    }
    let mut is_child = vec![false; root.nodes.len()];
    root.nodes.iter().flat_map(|node| node.children.iter().flatten()).for_each(|child| is_child[child.value()] = true);
    (0..root.nodes.len()).filter(|&node| !is_child[node]).collect()
}

fn to_parent(node: &Node) -> DMat4 {
    if let Some(matrix) = &node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector = |vector: Option<[f32; 3]>, default: DVec3| {
        vector.map_or(default, |vector| DVec3::from_array(vector.map(f64::from)))
    };
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |of| DQuat::from_array(of.0.map(f64::from)));
    // A rotation has length 1 up to rounding; any other quaternion is no rotation.
    let length = rotation.length();
    let rotation = if length > 0.0 { rotation / length } else { DQuat::IDENTITY };
    let (scale, translation) = (vector(node.scale, DVec3::ONE), vector(node.translation, DVec3::ZERO));
    DMat4::from_scale_rotation_translation(scale, rotation, translation)
}

/// Features of a node with a mesh that are drawn differently.
fn note(node: &Node, mesh: &Mesh, oddities: &mut Oddities) {
    if node.skin.is_some() {
        oddities.add("its skins are not bent: each mesh is drawn as its file has it, where its node is");
    }
    let weights = node.weights.as_ref().or(mesh.weights.as_ref());
    if weights.is_some_and(|weights| weights.iter().any(|&weight| weight != 0.0)) {
        oddities.add("its morph targets are not mixed in: each mesh is drawn without them");
    }
}
