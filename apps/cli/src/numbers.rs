//! How are measured numbers written?

/// All digits that tell the number from its neighbours; with an exponent where it is far from 1.
pub(crate) fn in_full(number: f64) -> String {
    match number.abs() {
        0.0 => "0".to_owned(),
        1e-4..1e15 => format!("{number}"),
        _ => format!("{number:e}"),
    }
}

/// So many digits, without zeros at the end; with an exponent where the number is far from 1.
pub(crate) fn rounded(number: f64, digits: usize) -> String {
    let rounded = format!("{number:.*e}", digits.max(1) - 1).parse().unwrap_or(number);
    in_full(rounded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_as_they_were() {
        for number in [0.0, 0.1 + 0.2, 1e-7 / 3.0, 2e300 / 3.0, 123_456.789, 5e-324] {
            assert_eq!(in_full(number).parse(), Ok(number));
        }
        assert_eq!(in_full(-0.0), "0");
    }

    #[test]
    fn rounded_numbers_are_short() {
        assert_eq!(
            [0.0, 2.0 / 3.0, 1234.567, 1e-9 / 3.0].map(|n| rounded(n, 3)),
            ["0", "0.667", "1230", "3.33e-10"]
        );
    }
}
