//! Which number did somebody mean who wrote what scene text takes for none?

use crate::write::number;

/// A number as it should have been written, and what is wrong with the way it was.
#[derive(Debug, PartialEq)]
pub(super) struct Meant {
    pub(super) number: String,
    pub(super) fault: String,
}

/// Units that people write behind numbers: what scene text would have there, and by how much to multiply.
const UNITS: &[(&str, &str, f64)] = &[
    ("%", "", 0.01),
    ("°", "degrees", 1.0),
    ("degrees", "degrees", 1.0),
    ("deg", "degrees", 1.0),
    ("rad", "degrees", 180.0 / std::f64::consts::PI),
    ("km", "metres", 1000.0),
    ("cm", "metres", 0.01),
    ("mm", "metres", 0.001),
    ("m", "metres", 1.0),
];

/// Whether KDL reads the word as a number: its grammar, and no more digits in a row than 38.
pub(super) fn is_number(word: &str) -> bool {
    let unsigned = word.strip_prefix(['+', '-']).unwrap_or(word);
    let of_radix = |digits: &str, radix: u32| {
        digits.starts_with(|c: char| c.is_digit(radix))
            && digits.chars().all(|c| c == '_' || c.is_digit(radix))
            && i128::from_str_radix(&digits.replace('_', ""), radix).is_ok()
    };
    for (prefix, radix) in [("0x", 16), ("0X", 16), ("0o", 8), ("0O", 8), ("0b", 2), ("0B", 2)] {
        if let Some(digits) = unsigned.strip_prefix(prefix) {
            return of_radix(digits, radix);
        }
    }
    let (mantissa, exponent) = match unsigned.find(['e', 'E']) {
        Some(at) => (&unsigned[..at], Some(&unsigned[at + 1..])),
        None => (unsigned, None),
    };
    let (whole, decimals) = match mantissa.split_once('.') {
        Some((whole, decimals)) => (whole, Some(decimals)),
        None => (mantissa, None),
    };
    of_radix(whole, 10)
        && decimals.is_none_or(|digits| of_radix(digits, 10))
        && exponent.is_none_or(|digits| of_radix(digits.strip_prefix(['+', '-']).unwrap_or(digits), 10))
}

/// The number that a word which is none was meant to be.
pub(super) fn meant(word: &str) -> Option<Meant> {
    let plain = word.replace(['−', '–', '—'], "-");
    let found = |number: String, fault: String| is_number(&number).then_some(Meant { number, fault });
    if plain != word {
        let number = pointed(&plain).unwrap_or(plain);
        return found(number, format!("{word} begins with a dash that is no minus sign"));
    }
    if let Some(number) = pointed(word) {
        return found(number, format!("{word} needs a digit on both sides of its point"));
    }
    if let Some(number) = word.strip_suffix(['f', 'F', 'd', 'D', 'h', 'H', 'l', 'L', 'u', 'U']) {
        let number = pointed(number).unwrap_or_else(|| number.to_owned());
        if let Some(meant) = found(number, format!("{word} has a letter behind its number")) {
            return Some(meant);
        }
    }
    if let Some(meant) = with_unit(word).or_else(|| reckoned(word)).or_else(|| too_long(word)) {
        return Some(meant);
    }
    let fortran = word.replace(['d', 'D'], "e");
    let grouped = word.replace(['\'', '’'], "");
    if fortran != word {
        return found(fortran, format!("the exponent of {word} begins with e"));
    }
    if grouped != word {
        return found(grouped, format!("{word} has marks between its digits"));
    }
    let signed =
        word.strip_prefix("--").or_else(|| word.strip_prefix("+-")).map(|rest| format!("-{rest}"))?;
    found(signed, format!("{word} has two signs"))
}

/// `.5`, `-.5e3`, `5.` and `5.e3` with their missing digit.
fn pointed(word: &str) -> Option<String> {
    let at = word.find('.')?;
    let (before, after) = (&word[..at], &word[at + 1..]);
    let whole = if matches!(before, "" | "+" | "-") { format!("{before}0") } else { before.to_owned() };
    let decimals =
        if after.starts_with(|c: char| c.is_ascii_digit()) { after.to_owned() } else { format!("0{after}") };
    let bare = !word.contains(|c: char| c.is_ascii_digit());
    let number = format!("{whole}.{decimals}");
    (!bare && number != word && is_number(&number)).then_some(number)
}

fn value(word: &str) -> Option<f64> {
    let word = pointed(word).unwrap_or_else(|| word.to_owned());
    if is_number(&word) { word.replace('_', "").parse().ok() } else { None }
}

fn with_unit(word: &str) -> Option<Meant> {
    let (unit, means, factor) = UNITS.iter().find(|(unit, ..)| word.ends_with(unit))?;
    let value = value(word.strip_suffix(unit)?)?;
    let fault = if means.is_empty() {
        format!("{word} is written as a share of 1")
    } else {
        format!("{word} stands without its unit, in {means}")
    };
    Some(Meant { number: rounded(value * factor), fault })
}

/// A quotient or product of two numbers.
fn reckoned(word: &str) -> Option<Meant> {
    let (a, b) = word.split_once(['/', '*'])?;
    let (a, b) = (value(a)?, value(b)?);
    let result = if word.contains('/') { a / b } else { a * b };
    let fault = format!("{word} is not reckoned out");
    result.is_finite().then(|| Meant { number: rounded(result), fault })
}

/// A number of more digits than the reader of KDL holds.
fn too_long(word: &str) -> Option<Meant> {
    let digits = word.chars().all(|c| c.is_ascii_digit() || "+-.eE".contains(c));
    let value: f64 = word.parse().ok().filter(|_| digits && word.len() > 38)?;
    let fault = "this number has more digits in a row than 38".to_owned();
    value.is_finite().then(|| Meant { number: number(value), fault })
}

/// Six digits are enough to be told.
fn rounded(value: f64) -> String {
    let text = format!("{value:.5e}");
    number(text.parse().unwrap_or(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_kdl_are_numbers() {
        for word in ["1", "-0.5", "+2e-3", "1E5", "0x20", "0b1_0", "1_000.5", "0"] {
            assert!(is_number(word), "{word}");
            assert_eq!(meant(word).filter(|_| !is_number(word)), None);
        }
        for word in [".5", "5.", "1..5", "1e", "0x", "1e5f", "-", "x", "", "1.2.3", &"9".repeat(60)] {
            assert!(!is_number(word), "{word}");
        }
    }

    #[test]
    fn habits_of_other_programs_have_their_number() {
        for (word, number) in [
            (".5", "0.5"),
            ("+.5", "+0.5"),
            ("-.5", "-0.5"),
            ("5.", "5.0"),
            ("1e5f", "1e5"),
            (".5f", "0.5"),
            ("1.f", "1.0"),
            ("5.e3", "5.0e3"),
            ("−1", "-1"),
            ("50%", "0.5"),
            ("45°", "45"),
            ("45deg", "45"),
            ("0.5rad", "28.6479"),
            ("30cm", "0.3"),
            ("2m", "2"),
            ("1/3", "0.333333"),
            ("1d-3", "1e-3"),
            ("1'000", "1000"),
            ("--1", "-1"),
        ] {
            assert_eq!(meant(word).map(|meant| meant.number).as_deref(), Some(number), "{word}");
        }
        assert_eq!(meant(&format!("1{}", "0".repeat(50))).unwrap().number, "1e50");
        for word in [".", "-", "x", "1..5", "1/0", "m", "%", "1.2.3", "f"] {
            assert_eq!(meant(word), None, "{word}");
        }
    }
}
