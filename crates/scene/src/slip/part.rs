//! Which number was meant by one piece between blanks, commas and brackets?

use super::Help;
use super::number::{is_number, meant};
use super::statement::Takes;
use super::value::Values;
use super::word::{KEYWORDS, color, is_identifier, shown};
use crate::outline::Span;

/// What makes a vector, a colour or a number of numbers elsewhere, as part of its name.
const MAKERS: &[&str] =
    &["vec", "rgb", "color", "colour", "array", "float", "double", "int", "tuple", "list", "point", "xyz"];

impl Values<'_> {
    /// The name before a bracket.
    pub(super) fn maker(&mut self, at: Span, call: &str) {
        let name = self.text[at.clone()].to_ascii_lowercase();
        if MAKERS.iter().any(|maker| name.contains(maker)) {
            let message = format!("{} is no number of scene text", shown(call));
            self.push(at, "", message, Help::Statement(""));
        } else {
            let message = format!("{} is not reckoned out", shown(call));
            self.unknown = Some((at, message, "write the number that it gives".to_owned()));
        }
    }

    /// One number, or what was meant to be one.
    pub(super) fn part(&mut self, at: Span) {
        let written = &self.text[at.clone()];
        let flag = matches!(self.takes, Takes::Flag);
        if is_number(written)
            || self.keyword(at.clone(), flag)
            || is_identifier(written) && meant(written).is_none()
        {
            return;
        }
        if let Some(meant) = meant(written) {
            let help = Help::Says(format!("write {}", meant.number));
            self.push(at, &meant.number, meant.fault, help);
        } else if let Some(color) = color(written) {
            let help = Help::Says(format!("write {color} for that sRGB colour"));
            self.push(
                at,
                &color,
                format!("{written} is no colour of scene text, which takes linear light"),
                help,
            );
        } else {
            let message = format!("{} is no number", shown(written));
            self.unknown = Some((at, message, "write a number such as 0.5".to_owned()));
        }
    }

    /// A word that needs a `#`, or has it and is spelled otherwise; true if it is one.
    fn keyword(&mut self, at: Span, flag: bool) -> bool {
        let written = &self.text[at.clone()];
        let name = written.trim_start_matches('#').to_ascii_lowercase();
        let right = match name.as_str() {
            "yes" | "on" if flag => "#true",
            "no" | "off" if flag => "#false",
            "true" | "yes" | "on" => "#true",
            "false" | "no" | "off" => "#false",
            "null" | "none" => "#null",
            "nan" => "#nan",
            "inf" => "#inf",
            "-inf" => "#-inf",
            _ => return false,
        };
        if written == right {
            return true;
        }
        if !written.starts_with('#') && !KEYWORDS.contains(&written) {
            return false;
        }
        if flag && matches!(right, "#true" | "#false") {
            self.push(
                at,
                right,
                format!("{written} needs to be written {right}"),
                Help::Says(format!("write {right}")),
            );
        } else {
            let message = format!("{written} stands where a number or a word is needed");
            self.push(
                at,
                right,
                message,
                Help::Unknown(format!("write a value for {}, or leave it away", self.word)),
            );
        }
        true
    }
}
