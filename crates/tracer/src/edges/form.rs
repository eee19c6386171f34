//! Where in a picture is an outline? A function of the place that is zero along it, of degree two at most.

use crate::numeric::OUTLINE_MARGIN;

/// A square of the picture: its centre and half its side, in pixels from the picture's corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Square {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) half: f64,
}

impl Square {
    /// Its four quarters.
    pub(crate) fn quarters(self) -> [Self; 4] {
        let half = self.half / 2.0;
        [(-half, -half), (half, -half), (-half, half), (half, half)].map(|(right, down)| Self {
            x: self.x + right,
            y: self.y + down,
            half,
        })
    }
}

/// f(x, y) = xx x² + xy x y + yy y² + x x + y y + one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Form {
    pub(crate) xx: f64,
    pub(crate) xy: f64,
    pub(crate) yy: f64,
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) one: f64,
}

impl Form {
    /// A straight line: x a + y b + c.
    pub(crate) fn line([x, y, one]: [f64; 3]) -> Self {
        Self { x, y, one, ..Self::default() }
    }

    /// The same in coordinates that a square reaches from −1 to 1 in.
    #[inline]
    pub(crate) fn within(&self, square: Square) -> Self {
        let Square { x, y, half } = square;
        let (value, across, down) = self.at(x, y);
        let square = half * half;
        Self {
            xx: self.xx * square,
            xy: self.xy * square,
            yy: self.yy * square,
            x: across * half,
            y: down * half,
            one: value,
        }
    }

    /// Its value at a place, and how much that changes with a pixel to the right and down.
    #[inline]
    fn at(&self, x: f64, y: f64) -> (f64, f64, f64) {
        let value = (self.xx * x + self.xy * y + self.x) * x + (self.yy * y + self.y) * y + self.one;
        (value, 2.0 * self.xx * x + self.xy * y + self.x, 2.0 * self.yy * y + self.xy * x + self.y)
    }

    /// Whether it may be zero anywhere in a square. Exact for straight lines, up to rounding.
    #[inline]
    pub(crate) fn may_cross(&self, square: Square) -> bool {
        let (value, across, down) = self.at(square.x, square.y);
        let bend = (self.xx.abs() + self.xy.abs() + self.yy.abs()) * square.half;
        let reach = (across.abs() + down.abs() + bend) * square.half;
        // NaN may be anything.
        !(value.abs() > reach * (1.0 + OUTLINE_MARGIN))
    }

    /// Whether it is a straight line.
    pub(crate) fn is_straight(&self) -> bool {
        self.xx == 0.0 && self.xy == 0.0 && self.yy == 0.0
    }

    /// The least and the largest x and y of an ellipse; `None` for what has no such bounds.
    pub(crate) fn ellipse_bounds(&self) -> Option<[f64; 4]> {
        let turned = Self { xx: self.yy, yy: self.xx, x: self.y, y: self.x, ..*self };
        let ([left, right], [top, bottom]) = (self.extent()?, turned.extent()?);
        Some([left, top, right, bottom])
    }

    /// Least and largest x of an ellipse: where the equation for y has one root.
    fn extent(&self) -> Option<[f64; 2]> {
        let square = self.xy * self.xy - 4.0 * self.yy * self.xx;
        let linear = 2.0 * self.xy * self.y - 4.0 * self.yy * self.x;
        let constant = self.y * self.y - 4.0 * self.yy * self.one;
        let under = linear * linear - 4.0 * square * constant;
        if !(square < 0.0 && under >= 0.0) {
            return None;
        }
        let sum = linear + under.sqrt().copysign(linear);
        let (one, other) = (-sum / (2.0 * square), -2.0 * constant / sum);
        Some([one.min(other), one.max(other)]).filter(|[a, b]| a.is_finite() && b.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn at(form: &Form, x: f64, y: f64) -> f64 {
        form.xx * x * x + form.xy * x * y + form.yy * y * y + form.x * x + form.y * y + form.one
    }

    #[test]
    fn a_form_has_the_same_values_in_a_squares_own_coordinates() {
        let mut random = Random(7);
        for _ in 0..1000 {
            let [xx, xy, yy, x, y, one] = [(); 6].map(|()| random.number());
            let form = Form { xx, xy, yy, x, y, one };
            let square = Square { x: random.number() * 9.0, y: random.number() * 9.0, half: 0.5 };
            let (u, v) = (random.number(), random.number());
            let [there, here] =
                [at(&form, square.x + u * 0.5, square.y + v * 0.5), at(&form.within(square), u, v)];
            assert!((there - here).abs() < 1e-11, "{there} {here}");
            if !form.may_cross(square) {
                assert!(there * at(&form, square.x, square.y) > 0.0);
            }
        }
    }

    #[test]
    fn bounds_of_an_ellipse_touch_it() {
        // A circle of radius 2 round (3, 4).
        let circle = Form { xx: -1.0, xy: 0.0, yy: -1.0, x: 6.0, y: 8.0, one: -21.0 };
        let bounds = circle.ellipse_bounds().unwrap();
        assert!(bounds.iter().zip([1.0, 2.0, 5.0, 6.0]).all(|(a, b)| (a - b).abs() < 1e-12), "{bounds:?}");
        assert!(Form { xx: 1.0, yy: -1.0, one: 1.0, ..Form::default() }.ellipse_bounds().is_none());
    }
}
