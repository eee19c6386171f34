//! How are numbers put into words that are easy to read?

/// Digits in groups of three: `1,234,567`.
pub(crate) fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut grouped = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

/// A number of things: `1 light`, `2 lights`, `3 boxes`.
pub(crate) fn counted(number: u64, what: &str) -> String {
    let ending = match number {
        1 => "",
        _ if what.ends_with(['x', 's']) || what.ends_with("sh") => "es",
        _ => "s",
    };
    format!("{} {what}{ending}", thousands(number))
}

/// A share of a whole: `12.5 %`; `0 %` of nothing.
pub(crate) fn percent(part: u64, whole: u64) -> String {
    match part {
        0 => "0 %".to_owned(),
        part => format!("{:.1} %", 100.0 * part as f64 / whole as f64),
    }
}

/// Kinds and their counts after a colon, `: 3 planes, 1 sphere`; nothing without kinds.
pub(crate) fn list(kinds: &[(&str, usize)]) -> String {
    let kinds: Vec<String> = kinds.iter().map(|(name, count)| counted(*count as u64, name)).collect();
    if kinds.is_empty() { String::new() } else { format!(": {}", kinds.join(", ")) }
}

/// An amount of memory in the unit that keeps it short.
pub(crate) fn bytes(count: u64) -> String {
    match count {
        0..1024 => format!("{count} bytes"),
        1024..1_048_576 => format!("{:.1} KiB", count as f64 / 1024.0),
        1_048_576..1_073_741_824 => format!("{:.1} MiB", count as f64 / 1_048_576.0),
        _ => format!("{:.1} GiB", count as f64 / 1_073_741_824.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_grouped_from_the_right() {
        assert_eq!([0, 999, 1000, 12_345_678].map(thousands), ["0", "999", "1,000", "12,345,678"]);
    }

    #[test]
    fn one_thing_is_singular() {
        assert_eq!(
            [counted(1, "box"), counted(0, "ray"), counted(2, "mesh")],
            ["1 box", "0 rays", "2 meshes"]
        );
    }

    #[test]
    fn a_share_of_nothing_is_nothing() {
        assert_eq!((percent(0, 0), percent(1, 8)), ("0 %".to_owned(), "12.5 %".to_owned()));
    }

    #[test]
    fn memory_is_short_to_read() {
        assert_eq!(
            [5, 2048, 3_145_728, 5_368_709_120].map(bytes),
            ["5 bytes", "2.0 KiB", "3.0 MiB", "5.0 GiB"]
        );
    }
}
