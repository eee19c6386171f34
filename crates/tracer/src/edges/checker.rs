//! Where do the squares of a checkered flat surface end in the picture?

use catoptra_core::glam::DVec3;
use catoptra_core::material::Checker;

use super::body::Level;
use super::cut::Cut;
use super::form::Square;
use super::sight::Sight;
use crate::numeric::MOST_LINES;

/// The lines between squares, in the snapshot's frame: x and z times the scale plus the shift are whole numbers there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grid {
    scale: f64,
    shift: [f64; 2],
}

impl Grid {
    /// That of a material for positions relative to an origin.
    pub(crate) fn of(checker: &Checker, origin: DVec3) -> Self {
        let (scale, [x, z]) = checker.grid();
        Self { scale, shift: [x - origin.x * scale, z - origin.z * scale] }
    }
}

/// One family of lines on a surface: number k is where cells = k. Both are linear in the place in the picture, as
/// numerator and denominator.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lines {
    above: [f64; 3],
    below: [f64; 3],
    /// Left, top, right, bottom of the part of the picture that the surface is seen in.
    pub(crate) bounds: [f64; 4],
    /// Whether pixels that nothing but these lines cross are parted too: those in mirrors. Of what is seen directly, the
    /// material is asked for its mean.
    pub(crate) alone: bool,
}

impl Lines {
    /// The two families on a surface.
    pub(crate) fn on(
        sight: &Sight,
        grid: &Grid,
        (level, bounds): (&Level, [f64; 4]),
        alone: bool,
    ) -> [Self; 2] {
        let depth = -level.height(sight.eye);
        [(DVec3::X, grid.shift[0]), (DVec3::Z, grid.shift[1])].map(|(axis, shift)| {
            let here = axis.dot(sight.eye) * grid.scale + shift;
            Self {
                above: sight.linear(level.normal * here + axis * (depth * grid.scale)),
                below: sight.linear(level.normal),
                bounds,
                alone,
            }
        })
    }

    /// The numbers of the lines that may cross a square: from the first up to before the second; `None` for too many, and
    /// where the surface has no end.
    pub(crate) fn numbers(&self, square: Square) -> Option<[f64; 2]> {
        let Square { x, y, half } = square;
        let [mut least, mut most] = [f64::INFINITY, f64::NEG_INFINITY];
        let mut side = 0.0;
        for (x, y) in [(x - half, y - half), (x + half, y - half), (x - half, y + half), (x + half, y + half)]
        {
            let at = |[a, b, c]: [f64; 3]| a * x + b * y + c;
            let below = at(self.below);
            if side * below < 0.0 {
                return None;
            }
            side = below;
            let cell = at(self.above) / below;
            least = least.min(cell);
            most = most.max(cell);
        }
        let (first, last) = (least.ceil(), most.ceil());
        (last - first <= MOST_LINES).then_some([first, last])
    }

    /// Whether any line may cross a square; of a pixel that has too many of them, none does.
    pub(crate) fn may_cross(&self, square: Square) -> bool {
        self.numbers(square).map_or(square.half > 0.5, |[first, last]| first < last)
    }

    /// Whether so many lines may cross a square that they are not told apart.
    pub(crate) fn are_many(&self, square: Square) -> bool {
        let Square { x, y, half } = square;
        let [left, top, right, bottom] = self.bounds;
        let seen = left <= x + half && right >= x - half && top <= y + half && bottom >= y - half;
        seen && self.numbers(square).is_none()
    }

    /// The cut along line number `k` through a square.
    pub(crate) fn cut(&self, k: f64, square: Square) -> Cut {
        let [x, y, one] = [0, 1, 2].map(|i| self.above[i] - k * self.below[i]);
        Cut { along: [x * square.half, y * square.half], off: x * square.x + y * square.y + one }
    }
}
