//! Which share of a square lies on either side of an outline? A conic that bends little within a square is replaced there by
//! the straight line in its direction that cuts off the same area.

use super::form::Form;
use crate::numeric::{GAUSS_4, MOST_BEND};

/// A straight cut through a square that reaches from −1 to 1: along · p + off is zero on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cut {
    pub(crate) along: [f64; 2],
    pub(crate) off: f64,
}

impl Cut {
    /// Its function at a place; positive in front.
    #[inline]
    pub(crate) fn height(&self, [x, y]: [f64; 2]) -> f64 {
        self.along[0] * x + self.along[1] * y + self.off
    }
}

/// How an outline cuts a square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Cuts {
    /// It passes by.
    Not,
    Straight(Cut),
    /// It bends too much to be told.
    Bent,
}

impl Cuts {
    /// How a form in a square's own coordinates cuts it.
    #[inline]
    pub(crate) fn of(form: &Form) -> Self {
        if form.is_straight() {
            return Self::Straight(Cut { along: [form.x, form.y], off: form.one });
        }
        // Upright or not: along the axis on which the form rises faster it must have one zero.
        let steep = form.y.abs() - form.xy.abs() - 2.0 * form.yy.abs();
        let level = form.x.abs() - form.xy.abs() - 2.0 * form.xx.abs();
        if steep.max(level) > form.x.abs().max(form.y.abs()) * MOST_BEND {
            if steep >= level {
                return Self::flat(form);
            }
            let turned = Form { xx: form.yy, yy: form.xx, x: form.y, y: form.x, ..*form };
            return match Self::flat(&turned) {
                Self::Straight(Cut { along: [x, y], off }) => Self::Straight(Cut { along: [y, x], off }),
                other => other,
            };
        }
        Self::Bent
    }

    /// For a form that rises or falls all the way along y: its zero is a function y(x).
    fn flat(form: &Form) -> Self {
        let stops = crossings(form);
        let (mut below, mut middle, mut width) = (0.0, [0.0; 2], 0.0);
        for pair in stops.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            if !(to > from) {
                continue;
            }
            let half = (to - from) / 2.0;
            let mut inside = false;
            for (place, weight) in GAUSS_4 {
                let x = from + half * (1.0 + place);
                let y = height(form, x);
                below += half * weight * (y.clamp(-1.0, 1.0) + 1.0);
                inside |= y.abs() < 1.0;
            }
            if inside && to - from > width {
                width = to - from;
                let x = (from + to) / 2.0;
                middle = [x, height(form, x)];
            }
        }
        if width == 0.0 {
            return Self::Not;
        }
        let [x, y] = middle;
        let along = [form.x + 2.0 * form.xx * x + form.xy * y, form.y + 2.0 * form.yy * y + form.xy * x];
        // `below` is the area with smaller y; the positive side is there where the form falls.
        let positive = if along[1] < 0.0 { below } else { 4.0 - below };
        Self::Straight(Cut { along, off: offset_of(along, positive) })
    }
}

/// The zero of a form that rises or falls all the way along y.
fn height(form: &Form, x: f64) -> f64 {
    let linear = form.xy * x + form.y;
    let constant = (form.xx * x + form.x) * x + form.one;
    let under = linear * linear - 4.0 * form.yy * constant;
    // Beyond the last zero lies none: far away on the side that the form points to.
    if under < 0.0 {
        return -(constant * linear.signum()).signum() * f64::INFINITY;
    }
    -2.0 * constant / (linear + under.sqrt().copysign(linear))
}

/// Where y(x) passes through the upper or the lower side of the square, in order, with both ends.
fn crossings(form: &Form) -> [f64; 6] {
    let mut stops = [-1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
    let mut count = 1;
    for y in [-1.0, 1.0] {
        let linear = form.xy * y + form.x;
        let constant = (form.yy * y + form.y) * y + form.one;
        let under = linear * linear - 4.0 * form.xx * constant;
        if under >= 0.0 {
            let sum = linear + under.sqrt().copysign(linear);
            for x in [-2.0 * constant / sum, -sum / (2.0 * form.xx)] {
                if x > -1.0 && x < 1.0 {
                    stops[count] = x;
                    count += 1;
                }
            }
        }
    }
    stops[1..count].sort_unstable_by(f64::total_cmp);
    stops
}

/// How far off a line in a direction lies whose positive side has an area of the square.
pub(crate) fn offset_of(along: [f64; 2], area: f64) -> f64 {
    let [p, q] = along.map(f64::abs);
    let (p, q) = (p.min(q), p.max(q));
    // Of the corner that lies farthest on the positive side, the line cuts off s along the direction.
    let less = area.min(4.0 - area).max(0.0);
    // A triangle s²/2pq up to s = 2p, then a slanted strip.
    let triangle = 2.0 * p / q;
    let s = if less <= triangle { (2.0 * p * q * less).sqrt() } else { p + q * less / 2.0 };
    let off = s - (p + q);
    if area <= 2.0 { off } else { -off }
}

#[cfg(test)]
mod tests {
    use super::super::split::Pieces;
    use super::*;
    use crate::random::Random;

    /// The share of the square where a form is positive, by a fine grid.
    fn counted(form: &Form) -> f64 {
        let steps = 2000;
        let mut positive = 0;
        for i in 0..steps {
            for j in 0..steps {
                let [x, y] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(steps) * 2.0 - 1.0);
                let value =
                    form.xx * x * x + form.xy * x * y + form.yy * y * y + form.x * x + form.y * y + form.one;
                positive += u32::from(value > 0.0);
            }
        }
        4.0 * f64::from(positive) / f64::from(steps * steps)
    }

    fn positive_area(cut: Cut) -> f64 {
        let mut pieces = Pieces::whole();
        pieces.split(cut);
        pieces
            .iter()
            .filter(|piece| cut.along[0] * piece.center[0] + cut.along[1] * piece.center[1] + cut.off > 0.0)
            .map(|piece| piece.area)
            .sum()
    }

    #[test]
    fn a_line_of_a_given_area_cuts_off_that_area() {
        let mut random = Random(3);
        for _ in 0..1000 {
            let (along, area) = ([random.number(), random.number()], 2.0 + 2.0 * random.number());
            let cut = Cut { along, off: offset_of(along, area) };
            assert!((positive_area(cut) - area).abs() < 1e-12, "{cut:?} {area} {}", positive_area(cut));
        }
    }

    #[test]
    fn conics_are_replaced_by_lines_that_cut_off_as_much() {
        let mut random = Random(5);
        let mut bent = 0;
        for _ in 0..60 {
            let [xx, xy, yy, x, y, one] = [0.1, 0.1, 0.1, 1.0, 1.0, 1.0].map(|size| random.number() * size);
            let form = Form { xx, xy, yy, x, y, one };
            match Cuts::of(&form) {
                Cuts::Straight(cut) => {
                    assert!((positive_area(cut) - counted(&form)).abs() < 4e-3, "{form:?}");
                }
                Cuts::Not => assert!((counted(&form) - 2.0).abs() > 1.99, "{form:?}"),
                Cuts::Bent => bent += 1,
            }
        }
        assert!(bent < 20, "{bent}");
    }
}
