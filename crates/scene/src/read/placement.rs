//! How the steps of a placement are read: `move`, `turn`, `seed-turn` and `scale`, applied in the order written.

use catoptra_core::glam::DVec3;
use catoptra_core::{InvalidPart, Placement};
use kdl::{KdlEntry, KdlNode};

use super::value::{plural, value_span};
use super::{Reader, span_of};
use crate::outline::{Item, StepText};

/// The words for the steps, and what each takes.
pub(crate) const STEPS: [(&str, usize, &str); 4] = [
    ("move", 3, "three numbers: x y z"),
    ("turn", 4, "four numbers: degrees and the axis x y z"),
    ("seed-turn", 2, "two numbers: degrees about y, then about x"),
    ("scale", 1, "one number"),
];

/// The word for the centre of a turn.
pub(crate) const ABOUT: &str = "about";

impl Reader<'_> {
    /// Reads a child that is a step, and applies it to the item's placement.
    pub(super) fn read_step(&mut self, node: &KdlNode, item: &mut Item) {
        let word = node.name().value();
        let span = span_of(node.span());
        let span = span.start..span.start + self.text[span].trim_end().len();
        let Some((name, count, takes)) = STEPS.into_iter().find(|(name, ..)| *name == word) else {
            return;
        };
        let entries = self.arguments(node);
        if entries.len() != count {
            let found = entries.len();
            let message = format!("{name} takes {takes}, not {found} value{}", plural(found));
            self.complaints.add(span_of(node.name().span()), message);
            return;
        }
        let numbers: Vec<Option<f64>> = entries.iter().map(|e| self.read_number(name, e)).collect();
        let about = self.read_about(node);
        let Some(numbers) = numbers.into_iter().collect::<Option<Vec<f64>>>() else {
            return;
        };
        let before = item.placement;
        match apply(before, name, &numbers, about) {
            Ok(placement) => {
                item.placement = placement;
                let numbers = entries.iter().map(|e| value_span(e)).collect();
                item.steps.push(StepText { span, numbers, is_move: name == "move", before });
            }
            Err(invalid) => self.complaints.add(span, invalid.to_string()),
        }
    }

    /// The centre of a turn: its child `about`, else the origin.
    fn read_about(&mut self, node: &KdlNode) -> DVec3 {
        let mut about = DVec3::ZERO;
        for child in node.children().map(kdl::KdlDocument::nodes).unwrap_or_default() {
            let span = span_of(child.name().span());
            let entries = self.arguments(child);
            if node.name().value() != "turn" || child.name().value() != ABOUT {
                let message = format!("{} has no {}", node.name().value(), child.name().value());
                self.complaints.add_with(
                    span,
                    message,
                    "a turn may have a centre: turn 30 0 1 0 { about x y z }",
                );
            } else if entries.len() != 3 {
                self.complaints.add(span, "about takes three numbers: x y z");
            } else if let Some(point) = self.read_three(ABOUT, &entries) {
                about = DVec3::from_array(point);
            }
        }
        about
    }

    /// The arguments of a node that takes no properties.
    pub(super) fn arguments<'n>(&mut self, node: &'n KdlNode) -> Vec<&'n KdlEntry> {
        self.refuse_annotations(node);
        for entry in node.entries() {
            if let Some(name) = entry.name() {
                let message = format!("{} has no property {}", node.name().value(), name.value());
                self.complaints.add(span_of(name.span()), message);
            }
        }
        node.entries().iter().filter(|e| e.name().is_none()).collect()
    }
}

fn apply(to: Placement, name: &str, numbers: &[f64], about: DVec3) -> Result<Placement, InvalidPart> {
    match *numbers {
        [x, y, z] => to.moved(DVec3::new(x, y, z)),
        [angle, x, y, z] => to.turned(about, DVec3::new(x, y, z), angle.to_radians()),
        [y, x] => to.seed_turned(y.to_radians(), x.to_radians()),
        [factor] => to.scaled(factor),
        _ => Err(InvalidPart::new("placement", "must be a step", name)),
    }
}
