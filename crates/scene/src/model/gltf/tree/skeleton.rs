//! Who is whose parent, and do the nodes of a file form trees?

use catoptra_core::glam::DAffine3;

use super::frame::Local;
use crate::model::gltf::json::{Document, Node, Whole, entry};
use crate::model::gltf::limits::MOST_DEPTH;
use crate::model::gltf::refusal::{Refusal, Within};

/// The trees that nodes form.
#[derive(Debug)]
pub(crate) struct Skeleton {
    /// Nodes without a parent.
    pub(crate) roots: Vec<usize>,
    parents: Vec<Option<usize>>,
    /// Every node after its parent.
    order: Vec<usize>,
}

impl Skeleton {
    /// # Errors
    /// A child that is not there, a node with two parents, nodes that hold each other, or one that lies too deep.
    pub(crate) fn of(nodes: &[Node]) -> Result<Self, Refusal> {
        let mut parents: Vec<Option<usize>> = vec![None; nodes.len()];
        for (i, node) in nodes.iter().enumerate() {
            for &child in &node.children {
                let mut adopt = || {
                    entry(nodes, child, "nodes")?;
                    match parents[child.index()].replace(i) {
                        None => Ok(()),
                        Some(other) => Err(Refusal::new(format!(
                            "nodes[{child}] is a child of nodes[{other}] already: a node has one parent at most"
                        ))),
                    }
                };
                adopt().within(|| format!("nodes[{i}].children"))?;
            }
        }
        let roots: Vec<usize> = (0..nodes.len()).filter(|&i| parents[i].is_none()).collect();
        let mut order = roots.clone();
        let mut depths = vec![0; nodes.len()];
        let mut next = 0;
        while let Some(&i) = order.get(next) {
            next += 1;
            for child in nodes[i].children.iter().map(|child| child.index()) {
                depths[child] = depths[i] + 1;
                if depths[child] > MOST_DEPTH {
                    let message = format!("lies more than {MOST_DEPTH} nodes deep");
                    return Err(Refusal::new(message)).within(|| format!("nodes[{child}]"));
                }
                order.push(child);
            }
        }
        if order.len() < nodes.len() {
            let reached: std::collections::HashSet<usize> = order.into_iter().collect();
            let stray = (0..nodes.len()).find(|i| !reached.contains(i)).unwrap_or_default();
            return Err(Refusal::new("is its own ancestor")).within(|| format!("nodes[{stray}]"));
        }
        Ok(Self { roots, parents, order })
    }

    /// The nodes that are shown: those of the default scene or, without one, of the first; all where there are no scenes.
    pub(crate) fn shown(&self, document: &Document) -> Result<Vec<usize>, Refusal> {
        let first = (!document.scenes.is_empty()).then_some(Whole(0));
        let Some(index) = document.scene.or(first) else { return Ok(self.roots.clone()) };
        let scene = entry(&document.scenes, index, "scenes").within(|| "scene".to_owned())?;
        let mut shown = Vec::with_capacity(scene.nodes.len());
        let mut known = vec![false; document.nodes.len()];
        for &node in &scene.nodes {
            let mut check = || {
                entry(&document.nodes, node, "nodes")?;
                if let Some(parent) = self.parents[node.index()] {
                    return Err(Refusal::new(format!("nodes[{node}] is a child of nodes[{parent}] already")));
                }
                if std::mem::replace(&mut known[node.index()], true) {
                    return Err(Refusal::new(format!("names nodes[{node}] twice")));
                }
                Ok(node.index())
            };
            shown.push(check().within(|| format!("scenes[{index}].nodes"))?);
        }
        Ok(shown)
    }

    /// Where each node carries things, from its own space to the world.
    pub(crate) fn globals(&self, nodes: &[Node]) -> Result<Vec<DAffine3>, Refusal> {
        let mut globals = vec![DAffine3::IDENTITY; nodes.len()];
        for &i in &self.order {
            let local = Local::of(&nodes[i]).within(|| format!("nodes[{i}]"))?;
            let local = DAffine3 { matrix3: local.linear.matrix(), translation: local.translation };
            globals[i] = self.parents[i].map_or(local, |parent| globals[parent] * local);
        }
        Ok(globals)
    }
}
