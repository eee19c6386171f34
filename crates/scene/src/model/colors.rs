//! Which light do the colours of a file's corners and faces stand for?

use catoptra_core::srgb_decoded;

/// Colours as files write them, sRGB in 0..=1 or, where any number is larger, in 0..=255, as linear Rec. 709. What is no
/// number counts as 0.
pub(super) fn linear(mut colors: Vec<[f32; 3]>) -> Vec<[f32; 3]> {
    let whole = colors.iter().flatten().any(|&v| v > 1.0 && v.is_finite());
    let steps: Vec<f32> = (0..=255).map(|step| srgb_decoded(f64::from(step) / 255.0) as f32).collect();
    for value in colors.iter_mut().flatten() {
        let given = f64::from(*value) * if whole { 1.0 } else { 255.0 };
        let step = if given.is_nan() { 0.0 } else { given.clamp(0.0, 255.0) };
        // Bytes over 255 are not whole again after rounding to single precision.
        let is_byte = (step - step.round()).abs() < 1e-4;
        *value = if is_byte { steps[step.round() as usize] } else { srgb_decoded(step / 255.0) as f32 };
    }
    colors
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_and_shares_are_decoded_alike() {
        let half = srgb_decoded(0.5) as f32;
        assert_eq!(linear(vec![[0.0, 0.5, 1.0]]), [[0.0, half, 1.0]]);
        assert_eq!(linear(vec![[0.0, 127.5, 255.0]]), [[0.0, half, 1.0]]);
        let byte = srgb_decoded(100.0 / 255.0) as f32;
        assert_eq!(linear(vec![[100.0 / 255.0, f32::NAN, -1.0]]), [[byte, 0.0, 0.0]]);
        assert_eq!(linear(vec![[100.0, f32::INFINITY, 300.0]]), [[byte, 1.0, 1.0]]);
    }
}
