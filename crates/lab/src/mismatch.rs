//! How often do two lists of answers (hit or miss, which surface) disagree?

/// The share of places, 0 to 1, at which two answers differ; 0 for two empty lists, `None` where the lengths differ.
///
/// For answers without a size to their error: which surface a pixel sees, whether a ray hits. Compared with `==`, so a NaN
/// agrees with nothing.
pub fn mismatch_rate<T: PartialEq>(reference: &[T], test: &[T]) -> Option<f64> {
    if reference.len() != test.len() {
        return None;
    }
    let differing = reference.iter().zip(test).filter(|(a, b)| a != b).count();
    Some(differing as f64 / reference.len().max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::mismatch_rate;

    #[test]
    fn one_in_four_is_a_quarter() {
        assert_eq!(mismatch_rate(&[1, 2, 3, 4], &[1, 2, 0, 4]), Some(0.25));
    }

    #[test]
    fn nothing_disagrees_with_nothing() {
        assert_eq!(mismatch_rate::<u8>(&[], &[]), Some(0.0));
    }

    #[test]
    fn lists_of_different_lengths_have_no_rate() {
        assert_eq!(mismatch_rate(&[1], &[1, 2]), None);
    }
}
