//! How `part` nodes follow what has become of the parts of a model.

use std::collections::HashMap;

use catoptra_core::Placement;
use catoptra_core::scene::{MaterialId, Scene};

use super::edit::{new_block, put_at_end, put_at_start};
use super::layout::{self, INDENT};
use super::splice::{Splice, without_space};
use super::value::quoted;
use super::{flags, placement};
use crate::build::Id;
use crate::instance::{Instance, PartNow, Wish};
use crate::outline::{Item, Outline, PART, Sort};
use crate::read::{MATERIAL, REMOVE};

/// The line that leaves a part out.
const LEFT_OUT: &str = "#true";

/// The splices that make the nodes in a model's block say what has become of its parts. Names of parts that get a node go to
/// `written`.
pub(crate) fn edit_parts(
    text: &str,
    outline: &Outline,
    ids: &[Id],
    scene: &Scene,
    (place, model): (usize, &Instance),
    written: &mut Vec<String>,
) -> Vec<Splice> {
    let Some(parts) = model.now(scene) else { return Vec::new() };
    let nodes = nodes_of_parts(outline, place);
    let mut splices = Vec::new();
    let (mut lines, mut new) = (Vec::new(), Vec::new());
    for part in &parts {
        match nodes.get(part.name) {
            Some(&at) => edit_node(text, &outline.items[at], ids[at], part, scene, &mut splices),
            None => {
                if let Some(line) = new_node(part, scene) {
                    lines.push(line);
                    new.push(Id::Part(part.entity, worn(part)));
                    written.push(part.name.to_owned());
                }
            }
        }
    }
    if !lines.is_empty() {
        let (item, lines) = (&outline.items[place], lines.join("\n"));
        let last = nodes.values().max().map(|&at| layout::gap_after(text, &outline.items[at].span));
        let splice = match last.or_else(|| layout::gap_at_end(text, item)) {
            Some(gap) => Splice { ids: new, ..Splice::new(gap.at..gap.at, gap.fill(text, &lines)) },
            None => Splice { ids: new, ..new_block(text, item, &lines) },
        };
        splices.push(splice);
    }
    splices
}

/// The splices that take out nodes of parts which were written by [`edit_parts`] and have nothing to say any more.
pub(crate) fn remove_parts(
    text: &str,
    outline: &Outline,
    scene: &Scene,
    (place, model): (usize, &Instance),
) -> Vec<Splice> {
    let Some(parts) = model.now(scene) else { return Vec::new() };
    let nodes = nodes_of_parts(outline, place);
    let idle = |part: &&PartNow<'_>| part.is_as_in_file() && model.written.contains(part.name);
    let places = parts.iter().filter(idle).filter_map(|part| nodes.get(part.name).copied());
    let empty = |at: &usize| outline.inside(*at).is_empty();
    places
        .filter(empty)
        .map(|at| Splice::new(layout::whole_node(text, &outline.items[at].span), ""))
        .collect()
}

/// Where the nodes for parts of the model at `place` stand, by the names of the parts.
fn nodes_of_parts(outline: &Outline, place: usize) -> HashMap<&str, usize> {
    let nodes = outline.inside(place).filter_map(|at| {
        let item = &outline.items[at];
        let is_part = matches!(item.sort, Sort::Part) && item.parent == Some(place);
        Some((item.name.as_ref().filter(|_| is_part)?.value.as_str(), at))
    });
    nodes.collect()
}

/// The material that a node gives a part which is not by the file what it wears.
fn worn(part: &PartNow<'_>) -> Option<MaterialId> {
    match part.wish {
        Wish::There { material, .. } => material.filter(|_| material != part.material),
        _ => None,
    }
}

/// The node of a part that has none, if it needs one.
fn new_node(part: &PartNow<'_>, scene: &Scene) -> Option<String> {
    let name = quoted(part.name);
    match part.wish {
        Wish::Whatever => None,
        Wish::Removed => Some(format!("{PART} {name} {{ {REMOVE} {LEFT_OUT} }}")),
        Wish::There { .. } if part.is_as_in_file() => None,
        Wish::There { placement, flags, .. } => {
            let material = worn(part).map(|id| format!(" {MATERIAL}={}", quoted(scene.material_name(id))));
            let mut steps = if placement == part.placement { Vec::new() } else { steps(&placement) };
            steps.extend(crate::flags::lines(&flags));
            let block = match steps.as_slice() {
                [] => String::new(),
                [step] => format!(" {{ {step} }}"),
                steps => format!(" {{\n{INDENT}{}\n}}", steps.join(&format!("\n{INDENT}"))),
            };
            Some(format!("{PART} {name}{}{block}", material.unwrap_or_default()))
        }
    }
}

/// The steps of a placement, which takes the place of another: where nothing is to be done, that is said.
fn steps(placement: &Placement) -> Vec<String> {
    let steps = placement::steps(placement);
    if steps.is_empty() { vec!["move 0 0 0".to_owned()] } else { steps }
}

/// Changes a node so that it says what has become of its part.
fn edit_node(text: &str, item: &Item, id: Id, part: &PartNow<'_>, scene: &Scene, splices: &mut Vec<Splice>) {
    let take_out = |span: &std::ops::Range<usize>| Splice::new(layout::taken_out(text, span), "");
    match part.wish {
        Wish::Whatever => {}
        Wish::Removed if item.removed => {}
        Wish::Removed => {
            splices.extend(item.steps.iter().map(|step| take_out(&step.span)));
            splices.extend(item.worn.as_ref().map(|span| without_space(text, span)));
            match &item.remove {
                Some((span, false)) => {
                    splices.push(Splice::new(span.clone(), format!("{REMOVE} {LEFT_OUT}")));
                }
                Some((span, true)) => splices.push(Splice::new(span.clone(), format!("{REMOVE}={LEFT_OUT}"))),
                None => put_at_start(text, item, &[format!("{REMOVE} {LEFT_OUT}")], splices),
            }
        }
        Wish::There { placement, material, flags } => {
            match &item.remove {
                Some((span, false)) if item.removed => splices.push(take_out(span)),
                Some((span, true)) if item.removed => splices.push(without_space(text, span)),
                _ => {}
            }
            let said = id.named_material().or(part.material);
            if let Some(material) = material.filter(|_| said != material) {
                wear(text, item, material, part, scene, splices);
            }
            let flags = flags::edit(text, item, &flags, splices);
            place(text, item, (&placement, flags), part, splices);
        }
    }
}

/// Makes the node name a material, or none where it is that of the file.
fn wear(
    text: &str,
    item: &Item,
    material: MaterialId,
    part: &PartNow<'_>,
    scene: &Scene,
    splices: &mut Vec<Splice>,
) {
    let name = quoted(scene.material_name(material));
    match (&item.worn, &item.material) {
        (Some(span), _) if part.material == Some(material) => splices.push(without_space(text, span)),
        (_, Some(word)) => splices.push(Splice::new(word.span.clone(), name)),
        _ => {
            let at = item.name.as_ref().map_or(item.word.end, |name| name.span.end);
            splices.push(Splice::new(at..at, format!(" {MATERIAL}={name}")));
        }
    }
}

/// Makes the node place its part, or say nothing where it stands as in the file; `flags` are lines that come with that.
fn place(
    text: &str,
    item: &Item,
    (to, flags): (&Placement, Vec<String>),
    part: &PartNow<'_>,
    splices: &mut Vec<Splice>,
) {
    let said = if item.steps.is_empty() { part.placement } else { item.placement };
    if *to == said {
        return put_at_start(text, item, &flags, splices);
    }
    let as_in_file = *to == part.placement;
    if as_in_file || placement::steps(to).is_empty() || item.steps.is_empty() {
        splices.extend(item.steps.iter().map(|step| Splice::new(layout::taken_out(text, &step.span), "")));
        let steps = if as_in_file { Vec::new() } else { steps(to) };
        return put_at_start(text, item, &[steps, flags].concat(), splices);
    }
    let lines = placement::edit(text, item, to, splices);
    put_at_end(text, item, &[lines, flags].concat(), splices);
}
