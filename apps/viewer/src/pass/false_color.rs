//! How do numbers become colours, with a line wherever a round number is passed?

use catoptra_scene::image::false_color::{Scale, color};
use catoptra_tracer::Size;

use super::{NOTHING, Numbers, Painted};

/// The share of pixels that may lie past the end of the scale: the few next to a lamp would leave no colours for the rest.
const PAST: f64 = 0.01;

/// The colour of lines.
const LINE: u32 = 0;

/// Shows numbers of a film's size, row by row, with lines; NaN stands for nothing.
pub(super) fn with_lines(values: Vec<f32>, size: Size, unit: &'static str) -> Painted {
    let mut painted = plain(values, unit);
    if let Some(numbers) = &painted.numbers {
        draw_lines(&mut painted.colors, numbers, size.width as usize);
    }
    painted
}

/// The same without lines.
pub(super) fn plain(values: Vec<f32>, unit: &'static str) -> Painted {
    let scale = Scale::of(range(&values));
    let colored = |value: &f32| {
        if value.is_nan() {
            return NOTHING;
        }
        let [r, g, b] = color(scale.share(f64::from(*value))).map(u32::from);
        r << 16 | g << 8 | b
    };
    let colors = values.iter().map(colored).collect();
    Painted { colors, numbers: Some(Numbers { values, scale, unit, shares: Vec::new() }) }
}

fn draw_lines(colors: &mut [u32], Numbers { values, scale, .. }: &Numbers, width: usize) {
    let bands: Vec<Option<i64>> = values
        .iter()
        .map(|value| (!value.is_nan()).then(|| scale.band(f64::from(*value).min(scale.ends()[1]))))
        .collect();
    // Lines lie between pixels that both show something: outlines are no lines.
    let differs = |band: Option<i64>, other: Option<&Option<i64>>| match (band, other) {
        (Some(band), Some(Some(other))) => band != *other,
        _ => false,
    };
    for (at, color) in colors.iter_mut().enumerate() {
        let above = at.checked_sub(width).and_then(|above| bands.get(above));
        let before = if at % width.max(1) > 0 { bands.get(at - 1) } else { None };
        if differs(bands[at], above) || differs(bands[at], before) {
            *color = LINE;
        }
    }
}

/// From the least to the most, but for a few; 0 to 0 where there is nothing.
fn range(values: &[f32]) -> [f64; 2] {
    let mut there: Vec<f32> = values.iter().copied().filter(|value| value.is_finite()).collect();
    there.sort_unstable_by(f32::total_cmp);
    let at = |share: f64| there.get((there.len() as f64 * share) as usize).copied().unwrap_or(0.0);
    [at(0.0), at(1.0 - PAST)].map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_lie_where_round_numbers_are_passed_and_not_at_outlines() {
        // A ramp, with nothing in its middle.
        let mut values: Vec<f32> = (0..200_u16).map(|x| f32::from(x) / 10.0).collect();
        values[100..120].fill(f32::NAN);
        let painted = with_lines(values, Size::new(200, 1), "m");
        let lines: Vec<usize> = (0..200).filter(|x| painted.colors[*x] == LINE).collect();
        assert_eq!(lines, [20, 40, 60, 80, 140, 160, 180]);
        assert_eq!(painted.colors[110], NOTHING);
        assert_eq!(painted.numbers.unwrap().scale.step(), 2.0);
    }

    #[test]
    fn nothing_at_all_is_shown_as_nothing() {
        let painted = with_lines(vec![f32::NAN; 6], Size::new(3, 2), "m");
        assert_eq!(painted.colors, [NOTHING; 6]);
        assert!(with_lines(Vec::new(), Size::new(0, 0), "m").colors.is_empty());
    }
}
