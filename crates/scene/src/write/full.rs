//! How a model or a repeat is written whose node cannot say any more what the scene holds: as the group that it is.

use std::collections::HashSet;

use catoptra_core::scene::{EntityId, Scene};

use super::layout;
use super::node::Nodes;
use super::splice::Splice;
use crate::build::Id;
use crate::instance::Instance;
use crate::outline::{Outline, Span};
use crate::scan;

/// The splice that writes the group `root` in place of the item at `place`. Comments in the item's block go before it.
pub(crate) fn in_full(
    text: &str,
    outline: &Outline,
    ids: &[Id],
    (scene, models): (&Scene, &[Instance]),
    (place, root): (usize, EntityId),
) -> Splice {
    let span = &outline.items[place].span;
    let inside = outline.inside(place);
    let elsewhere: HashSet<EntityId> = ids
        .iter()
        .enumerate()
        .filter_map(|(i, id)| if let Id::Entity(id) = id { Some((i, *id)) } else { None })
        .filter(|(i, _)| *i != place && !inside.contains(i))
        .map(|(_, id)| id)
        .collect();
    let mut nodes = Nodes::new(models);
    nodes.add_entity(scene, root, &|member| !elsewhere.contains(&member));
    let comments = scan::comments(text, span.clone());
    let comments = comments.iter().flat_map(|comment: &Span| text[comment.clone()].trim_end().lines());
    let lines = comments.map(str::trim_start).chain(nodes.lines.lines());
    let separator = format!("{}{}", layout::newline(text), layout::indent_at(text, span.start));
    let text = lines.collect::<Vec<_>>().join(&separator);
    Splice { range: span.clone(), text, ids: nodes.ids }
}
