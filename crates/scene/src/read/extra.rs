//! What some nodes are told beside the fields that the core lists: the file of a model, whether a part of it is left out, how
//! often a repeat repeats and in which steps, and whether something is hidden or locked.

use catoptra_core::Placement;
use kdl::{KdlEntry, KdlNode, KdlValue};

use super::placement::STEPS;
use super::value::value_span;
use super::{Reader, span_of};
use crate::flags::{self, FLAGS, Flag};
use crate::outline::{FlagText, Item, Sort, Span};

/// The most copies that one repeat makes. What all repeats of a text make together is bounded beside that.
pub(crate) const MOST_COPIES: u32 = 100_000;

/// The word for the path of a model.
pub(crate) const FILE: &str = "file";

/// The word that leaves a part of a model out.
pub(crate) const REMOVE: &str = "remove";

/// Something that nodes of one sort are told.
#[derive(Debug, Clone, Copy)]
pub(super) enum Extra {
    File,
    Remove,
    Count,
    Step,
    Flag(Flag),
}

/// Which nodes are told what, by which word.
pub(super) const EXTRAS: [(Sort, &str, Extra); 4] = [
    (Sort::Model, FILE, Extra::File),
    (Sort::Part, REMOVE, Extra::Remove),
    (Sort::Repeat, "count", Extra::Count),
    (Sort::Repeat, "step", Extra::Step),
];

/// What a word tells a node of that sort.
pub(super) fn extra(sort: Sort, word: &str) -> Option<Extra> {
    let same = |of: Sort| of.word() == sort.word();
    let own = EXTRAS.iter().find(|(of, known, _)| same(*of) && *known == word).map(|(.., extra)| *extra);
    own.or_else(|| flags::named(word).filter(|_| sort.is_entity()).map(Extra::Flag))
}

/// The words for what a node of that sort is told.
pub(super) fn words_for(sort: Sort) -> impl Iterator<Item = &'static str> {
    let own = EXTRAS.iter().filter(move |(of, ..)| of.word() == sort.word()).map(|(_, word, _)| *word);
    own.chain(FLAGS.iter().filter(move |_| sort.is_entity()).map(|flag| flag.word))
}

impl Reader<'_> {
    /// Reads a child of a node.
    pub(super) fn read_extra(&mut self, extra: Extra, node: &KdlNode, item: &mut Item) {
        let span = span_of(node.span());
        let span = span.start..span.start + self.text[span].trim_end().len();
        if matches!(extra, Extra::Step) {
            return self.read_step_of_repeat(node, item);
        }
        let entries = self.arguments(node);
        self.refuse_block(node);
        let at = span_of(node.name().span());
        match extra {
            Extra::File => self.read_model(&entries, at, item),
            Extra::Remove => {
                item.remove = Some((span, false));
                self.read_remove(&entries, at, item);
            }
            Extra::Count | Extra::Step => self.read_count(&entries, at, item),
            Extra::Flag(flag) => self.read_set_flag(flag, &entries, (span, false), item),
        }
    }

    /// Reads a property of a node.
    pub(super) fn read_property_extra(&mut self, extra: Extra, entry: &KdlEntry, item: &mut Item) {
        let span = span_of(entry.span());
        match extra {
            Extra::File => self.read_model(&[entry], span, item),
            Extra::Remove => {
                item.remove = Some((span.clone(), true));
                self.read_remove(&[entry], span, item);
            }
            Extra::Count => self.read_count(&[entry], span, item),
            Extra::Step => {
                self.complaints.add_with(span, "the step of a repeat stands in its block", STEP_FORM);
            }
            Extra::Flag(flag) => self.read_set_flag(flag, &[entry], (span, true), item),
        }
    }

    /// Complains about what such a node must be told and is not.
    pub(super) fn check_extras(&mut self, item: &Item) {
        let (message, help) = match item.sort {
            Sort::Model if item.model.is_none() => {
                ("this model needs a file", "write model \"some name\" { file \"path of a model file\" }")
            }
            Sort::Repeat if item.count.is_none() => {
                ("this repeat needs a count", "write repeat \"some name\" count=5 { step { move 1 0 0 }; … }")
            }
            Sort::Repeat if item.step.is_none() => ("this repeat needs a step", STEP_FORM),
            _ => return,
        };
        self.complaints.add_with(item.word.clone(), message, help);
    }

    /// Reads the path of a model, and the model.
    fn read_model(&mut self, entries: &[&KdlEntry], span: Span, item: &mut Item) {
        let &[entry] = entries else {
            return self.complaints.add(span, "file takes one path in quotes");
        };
        if item.model.is_some() {
            return self.complaints.add(span, "file is given twice");
        }
        self.refuse_odd_quotes(entry);
        let Some(path) = entry.value().as_string() else {
            return self.complaints.add(value_span(entry), "file needs the path of a model in quotes");
        };
        match self.files.model(path) {
            Ok(model) => (item.model, item.model_path) = (Some(model), Some(value_span(entry))),
            Err(message) => {
                let help = "the path of a model is relative to the folder of the scene file";
                self.complaints.add_with(value_span(entry), message, help);
            }
        }
    }

    /// Reads whether a part is left out.
    fn read_remove(&mut self, entries: &[&KdlEntry], span: Span, item: &mut Item) {
        match entries.first().and_then(|entry| entry.value().as_bool()) {
            Some(removed) if entries.len() == 1 => item.removed = removed,
            _ => self.complaints.add(span, "remove takes #true or #false"),
        }
    }

    /// Reads whether something is hidden, or locked.
    fn read_set_flag(
        &mut self,
        flag: Flag,
        entries: &[&KdlEntry],
        (span, property): (Span, bool),
        item: &mut Item,
    ) {
        let word = flag.word;
        if let Some(before) = item.flag_texts.iter().find(|text| text.word == word) {
            let first = before.span.start;
            return self.complaints.add_again(span, format!("{word} is given twice"), first);
        }
        match entries.first().and_then(|entry| entry.value().as_bool()) {
            Some(on) if entries.len() == 1 => {
                (flag.set)(&mut item.flags, on);
                item.flag_texts.push(FlagText { word, span, property });
            }
            _ => self.complaints.add(span, format!("{word} takes #true or #false")),
        }
    }

    /// Reads how often a repeat repeats.
    fn read_count(&mut self, entries: &[&KdlEntry], span: Span, item: &mut Item) {
        let &[entry] = entries else {
            return self.complaints.add(span, "count takes one whole number");
        };
        if item.count.is_some() {
            return self.complaints.add(span, "count is given twice");
        }
        let number = match entry.value() {
            KdlValue::Integer(number) => Some(*number),
            KdlValue::Float(number) if number.fract() == 0.0 => Some(*number as i128),
            _ => None,
        };
        match number {
            Some(number) if (1..=i128::from(MOST_COPIES)).contains(&number) => {
                item.count = Some(number as u32);
            }
            Some(_) => {
                let written = &self.text[value_span(entry)];
                let message = format!("count must be 1 to {MOST_COPIES}, not {written}");
                self.complaints.add_with(
                    value_span(entry),
                    message,
                    "repeats may stand in repeats: rows of rows",
                );
            }
            None => self.complaints.add(value_span(entry), "count takes one whole number"),
        }
    }

    /// Reads the step from one copy to the next.
    fn read_step_of_repeat(&mut self, node: &KdlNode, item: &mut Item) {
        let at = span_of(node.name().span());
        if let Some(entry) = self.arguments(node).first() {
            return self.complaints.add_with(
                value_span(entry),
                "a step has a block, and no values",
                STEP_FORM,
            );
        }
        if item.step.is_some() {
            return self.complaints.add(at, "step is given twice");
        }
        let mut step = self.new_item(node, Sort::Group, None);
        let complaints = self.complaints.count();
        for child in node.children().map(kdl::KdlDocument::nodes).unwrap_or_default() {
            if STEPS.iter().any(|(known, ..)| *known == child.name().value()) {
                self.read_step(child, &mut step);
            } else {
                let message = format!("a step has no \"{}\"", child.name().value());
                self.complaints.add_with(span_of(child.name().span()), message, STEP_FORM);
            }
        }
        if step.steps.is_empty() && self.complaints.count() == complaints {
            self.complaints.add_with(at, "this step leads nowhere", STEP_FORM);
        }
        item.step = Some(step.placement);
    }
}

/// How a step is written.
const STEP_FORM: &str = "write step { move 1 0 0 }, with any of move, turn, seed-turn and scale";

/// Where the copy after one stands; `None` where numbers end before.
pub(crate) fn next(copy: &Placement, step: &Placement) -> Option<Placement> {
    let next = copy.then(step);
    Placement::new(next.rotation(), next.translation(), next.scale()).ok()
}
