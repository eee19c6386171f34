//! What number is typed? One that stands there, or that is to be worked out: `1/3`, `2*0.45`, `-(1 + 2)/4`, `2*pi`.

/// The number that a text stands for; `None` for what is no number, and for one that is not finite.
pub(crate) fn value(text: &str) -> Option<f64> {
    let tokens = text.chars().filter(|c| !c.is_whitespace());
    // Both are written for a minus, and a comma for a point.
    let text: String = tokens.map(|c| if c == '−' { '-' } else { c }).collect();
    let mut rest = Rest(&text);
    let value = rest.sum(0)?;
    (rest.0.is_empty() && value.is_finite()).then_some(value)
}

/// Brackets within brackets that are followed: no one types more.
const DEEPEST: u32 = 64;

/// What is still to be read.
struct Rest<'a>(&'a str);

impl Rest<'_> {
    /// Takes a character away, if that is the next one.
    fn takes(&mut self, wanted: char) -> bool {
        let rest = self.0.strip_prefix(wanted);
        self.0 = rest.unwrap_or(self.0);
        rest.is_some()
    }

    fn sum(&mut self, depth: u32) -> Option<f64> {
        let mut value = self.product(depth)?;
        loop {
            if self.takes('+') {
                value += self.product(depth)?;
            } else if self.takes('-') {
                value -= self.product(depth)?;
            } else {
                return Some(value);
            }
        }
    }

    fn product(&mut self, depth: u32) -> Option<f64> {
        let mut value = self.factor(depth)?;
        loop {
            if self.takes('*') || self.takes('×') {
                value *= self.factor(depth)?;
            } else if self.takes('/') {
                value /= self.factor(depth)?;
            } else {
                return Some(value);
            }
        }
    }

    fn factor(&mut self, depth: u32) -> Option<f64> {
        if depth > DEEPEST {
            return None;
        }
        if self.takes('-') {
            return self.factor(depth + 1).map(|value| -value);
        }
        if self.takes('+') {
            return self.factor(depth + 1);
        }
        if self.takes('(') {
            let value = self.sum(depth + 1)?;
            return self.takes(')').then_some(value);
        }
        if let Some(rest) = self.0.strip_prefix("pi") {
            self.0 = rest;
            return Some(std::f64::consts::PI);
        }
        self.number()
    }

    fn number(&mut self) -> Option<f64> {
        let length = number_length(self.0);
        let (number, rest) = self.0.split_at(length);
        self.0 = rest;
        number.parse().ok()
    }
}

/// Bytes of the number at the beginning of a text: digits, a point, a power of ten.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') {
        length += 1 + digits(length + 1);
    }
    let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
    if matches!(bytes.get(length), Some(b'e' | b'E')) && digits((length + 1 + sign).min(bytes.len())) > 0 {
        length += 1 + sign + digits(length + 1 + sign);
    }
    length
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_typed_is_worked_out() {
        for (text, wanted) in [
            ("1/3", 1.0 / 3.0),
            ("2*0.45", 0.9),
            (" -( 1 + 2 ) / 4 ", -0.75),
            ("1-2-3", -4.0),
            ("8/2/2", 2.0),
            ("1+2*3", 7.0),
            ("--2", 2.0),
            ("1e-3", 0.001),
            ("2e1*.5", 10.0),
            ("5.", 5.0),
            ("2*pi", std::f64::consts::TAU),
            ("−7", -7.0),
        ] {
            assert_eq!(value(text), Some(wanted), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_none() {
        let deep = "(".repeat(10_000);
        for text in ["", "x", "1/0", "1+", "(1", "1)", "1 2x", "e5", ".", "1..2", "1e999", "pie", &deep] {
            assert_eq!(value(text), None, "{text:.20}");
        }
    }
}
