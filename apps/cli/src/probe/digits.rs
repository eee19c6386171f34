//! What do the digits on a picture look like? Five by seven dots each.

/// Columns and rows of a digit; one more column and row lie between.
const SIZE: [usize; 2] = [5, 7];

/// Pixels of a dot.
const DOT: usize = 2;

/// Pixels from one digit to the next.
const STEP: usize = (SIZE[0] + 1) * DOT;

/// Pixels of a line of text.
pub(super) const HEIGHT: usize = SIZE[1] * DOT;

/// The rows of dots of a sign, from the top; the highest of five bits is the left dot.
fn dots(sign: char) -> [u8; 7] {
    match sign {
        '0' => [0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e],
        '1' => [0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e],
        '2' => [0x0e, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1f],
        '3' => [0x1f, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0e],
        '4' => [0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02],
        '5' => [0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e],
        '6' => [0x06, 0x08, 0x10, 0x1e, 0x11, 0x11, 0x0e],
        '7' => [0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08],
        '8' => [0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e],
        '9' => [0x0e, 0x11, 0x11, 0x0f, 0x01, 0x02, 0x0c],
        '.' => [0, 0, 0, 0, 0, 0x0c, 0x0c],
        '-' => [0, 0, 0, 0x1f, 0, 0, 0],
        'e' => [0, 0, 0x0e, 0x11, 0x1f, 0x10, 0x0e],
        'l' => [0x0c, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0e],
        'x' => [0, 0, 0x11, 0x0a, 0x04, 0x0a, 0x11],
        _ => [0; 7],
    }
}

/// How wide a text is, pixels.
pub(super) fn width(text: &str) -> usize {
    text.chars().count() * STEP
}

/// Calls `paint` with the pixels of a text whose upper left corner is given. Signs that numbers do not have are blank.
pub(super) fn write(text: &str, [x, y]: [usize; 2], mut paint: impl FnMut(usize, usize)) {
    for (place, sign) in text.chars().enumerate() {
        for (row, bits) in dots(sign).iter().enumerate() {
            for column in (0..SIZE[0]).filter(|column| bits >> (SIZE[0] - 1 - column) & 1 == 1) {
                let [left, top] = [x + place * STEP + column * DOT, y + row * DOT];
                (0..DOT * DOT).for_each(|i| paint(left + i % DOT, top + i / DOT));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn signs_differ_and_fit_their_size() {
        let signs = "0123456789.-elx";
        let all: HashSet<_> = signs.chars().map(dots).collect();
        assert_eq!(all.len(), signs.len());
        assert!(all.iter().flatten().all(|row| *row < 32));
        write("48", [3, 5], |x, y| {
            assert!((3..3 + width("48")).contains(&x) && (5..5 + HEIGHT).contains(&y));
        });
    }
}
