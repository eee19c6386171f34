//! How values are spelled in scene text.

use catoptra_core::scene::Scene;
use catoptra_core::{FieldKind, TextureUse, Value};

use crate::read::{CHANNEL, TEXTURE};

/// The words that a field's value is written with, without those for a texture that multiplies it.
pub(crate) fn words(kind: FieldKind, value: &Value, scene: &Scene) -> Vec<String> {
    match value {
        Value::Number(v) if kind == FieldKind::Angle => vec![degrees(*v)],
        Value::Number(v) => vec![number(*v)],
        Value::Vector(v) => v.to_array().map(number).to_vec(),
        Value::Color(c) => c.to_array().map(number).to_vec(),
        Value::Flag(v) => vec![format!("#{v}")],
        Value::Word(word) => vec![quoted(word)],
        Value::Mesh(source) => vec![quoted(&source.path)],
        Value::Profile(source) => vec![quoted(&source.path)],
        Value::Pair(v) => v.to_array().map(number).to_vec(),
        Value::Image(source) => vec![quoted(&source.path)],
        Value::Texture(texture) => vec![quoted(scene.texture_name(*texture).unwrap_or_default())],
        Value::Textured(textured) => words(kind, &textured.base, scene),
        Value::Rows(rows) => rows.iter().flatten().copied().map(number).collect(),
    }
}

/// The properties for a texture that multiplies a value, with the space before each.
pub(crate) fn paint(by: TextureUse, scene: &Scene) -> String {
    let texture = format!(" {TEXTURE}={}", quoted(scene.texture_name(by.texture).unwrap_or_default()));
    match by.channel {
        Some(channel) => format!("{texture} {CHANNEL}={}", quoted(channel.word())),
        None => texture,
    }
}

/// The shortest spelling that reads back as the same number.
pub(crate) fn number(v: f64) -> String {
    let text = format!("{v:?}");
    match text.strip_suffix(".0") {
        Some("-0") => "0".to_owned(),
        Some(whole) => whole.to_owned(),
        None => text,
    }
}

/// An angle in degrees: the shortest spelling that reads back as the same radians. Where no degrees do (the two
/// grids of numbers do not meet everywhere), the nearest.
pub(crate) fn degrees(radians: f64) -> String {
    let exact = radians.to_degrees();
    let reads_back = |text: &str| text.parse::<f64>().is_ok_and(|v| v.to_radians() == radians);
    // 12 decimals are the most that a turn of 360 degrees can use.
    let short = (0..=12).map(|decimals| format!("{exact:.decimals$}")).find(|text| reads_back(text));
    let text = short
        .or_else(|| {
            [exact, exact.next_up(), exact.next_down()].map(number).into_iter().find(|t| reads_back(t))
        })
        .unwrap_or_else(|| number(exact));
    if text == "-0" { "0".to_owned() } else { text }
}

/// A text in quotes, with escapes where KDL needs them.
pub(crate) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            c if needs_escape(c) => out.push_str(&format!("\\u{{{:x}}}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// Control characters, line ends and direction marks, which KDL does not allow to stand as they are.
fn needs_escape(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}')
        || matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_read_back() {
        for (v, text) in [(10.0, "10"), (0.1, "0.1"), (-0.0, "0"), (1e300, "1e300"), (-2.5, "-2.5")] {
            assert_eq!(number(v), text);
        }
        assert_eq!(number(1.0 / 3.0).parse::<f64>().unwrap(), 1.0 / 3.0);
    }

    #[test]
    fn degrees_read_back_as_the_same_radians() {
        for tenth in 0..3600 {
            let text = format!("{}", f64::from(tenth) / 10.0);
            let radians = text.parse::<f64>().unwrap().to_radians();
            assert_eq!(degrees(radians), text);
        }
    }

    #[test]
    fn any_text_survives_quoting() {
        for text in [
            "",
            "a b",
            "\"\\\"",
            "line\nend\r\t\u{8}\u{c}",
            "\u{202e}x\u{feff}",
            "日本語 {}#\"#",
            "\0\u{7f}\u{85}",
        ] {
            let document: kdl::KdlDocument = format!("node {}", quoted(text)).parse().unwrap();
            assert_eq!(document.get_arg("node").and_then(|v| v.as_string()).unwrap_or("?"), text);
        }
    }
}
