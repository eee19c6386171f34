//! Into which convex pieces do straight cuts part a square?

use super::cut::Cut;
use crate::numeric::LEAST_PIECE;

/// Most cuts through one square.
pub(crate) const MOST_CUTS: usize = 8;

/// Corners of a square after that many cuts, with one to spare while it is cut.
const MOST_CORNERS: usize = 4 + MOST_CUTS + 1;

/// Pieces that so many lines part a square into: 1 + n + n (n − 1) / 2.
const MOST_PIECES: usize = 1 + MOST_CUTS + MOST_CUTS * (MOST_CUTS - 1) / 2;

/// A convex polygon.
#[derive(Debug, Clone, Copy)]
struct Polygon {
    count: usize,
    corners: [[f64; 2]; MOST_CORNERS],
}

/// A piece's area, and its centroid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Piece {
    pub(crate) area: f64,
    pub(crate) center: [f64; 2],
}

impl Piece {
    /// The whole square.
    pub(crate) const SQUARE: Self = Self { area: 4.0, center: [0.0; 2] };
}

/// The place between two others.
#[inline]
fn between([ax, ay]: [f64; 2], [bx, by]: [f64; 2], share: f64) -> [f64; 2] {
    [ax + share * (bx - ax), ay + share * (by - ay)]
}

/// What a single cut makes of the square; `None` where it leaves no more than a sliver on one side.
#[inline]
pub(crate) fn halves(cut: Cut) -> Option<[Piece; 2]> {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    // The border of what lies in front.
    let (mut border, mut count) = ([[0.0; 2]; 6], 0);
    let (mut from, mut here) = (corners[3], cut.height(corners[3]));
    for to in corners {
        let there = cut.height(to);
        if here * there < 0.0 {
            border[count] = between(from, to, here / (here - there));
            count += 1;
        }
        if there >= 0.0 {
            border[count] = to;
            count += 1;
        }
        (from, here) = (to, there);
    }
    let (mut twice, mut x, mut y) = (0.0, 0.0, 0.0);
    let mut last = border[if count > 0 { count - 1 } else { 0 }];
    for &to in &border[..count] {
        let area = last[0] * to[1] - last[1] * to[0];
        twice += area;
        x += area * (last[0] + to[0]);
        y += area * (last[1] + to[1]);
        last = to;
    }
    let area = twice / 2.0;
    let rest = 4.0 - area;
    if !(area > LEAST_PIECE && rest > LEAST_PIECE) {
        return None;
    }
    let center = [x / (3.0 * twice), y / (3.0 * twice)];
    let share = -area / rest;
    Some([Piece { area, center }, Piece { area: rest, center: center.map(|c| c * share) }])
}

/// The pieces of a square that reaches from −1 to 1.
#[derive(Debug)]
pub(crate) struct Pieces {
    count: usize,
    pieces: Box<[(Polygon, Piece)]>,
}

const SQUARE: Polygon = {
    let mut corners = [[0.0; 2]; MOST_CORNERS];
    corners[0] = [-1.0, -1.0];
    corners[1] = [1.0, -1.0];
    corners[2] = [1.0, 1.0];
    corners[3] = [-1.0, 1.0];
    Polygon { count: 4, corners }
};

impl Default for Pieces {
    fn default() -> Self {
        Self::whole()
    }
}

impl Pieces {
    /// The square as it is.
    pub(crate) fn whole() -> Self {
        Self { count: 1, pieces: vec![(SQUARE, Piece::SQUARE); MOST_PIECES].into() }
    }

    /// Puts the square together again.
    #[inline]
    pub(crate) fn reset(&mut self) {
        self.count = 1;
        self.pieces[0] = (SQUARE, Piece::SQUARE);
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// Areas and centroids.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Piece> {
        self.pieces[..self.count].iter().map(|(_, piece)| piece)
    }

    /// Parts the pieces by a cut, of which some are left; false where none is. Cuts that part nothing are free.
    #[inline]
    pub(crate) fn cut(&mut self, cut: Cut, left: &mut u32) -> bool {
        let before = self.count;
        if *left > 0 {
            self.split(cut);
            *left -= u32::from(self.count > before);
            return true;
        }
        !self.pieces[..before].iter().any(|(polygon, _)| polygon.is_crossed(cut))
    }

    /// Parts every piece that a cut goes through. Slivers stay with their larger part.
    #[inline]
    pub(crate) fn split(&mut self, cut: Cut) {
        for at in 0..self.count {
            let (known, [free, ..]) = self.pieces.split_at_mut(self.count) else { return };
            let mut rest = Polygon { count: 0, corners: SQUARE.corners };
            if !known[at].0.parted(cut, [&mut free.0, &mut rest]) {
                continue;
            }
            let parts = [free.0.piece(), rest.piece()];
            if parts.iter().any(|piece| !(piece.area > LEAST_PIECE)) {
                continue;
            }
            free.1 = parts[0];
            known[at] = (rest, parts[1]);
            self.count += 1;
        }
    }
}

impl Polygon {
    fn is_crossed(&self, cut: Cut) -> bool {
        let mut heights = self.corners[..self.count].iter().map(|corner| cut.height(*corner));
        let first = heights.next().unwrap_or(0.0);
        heights.any(|height| height * first < 0.0)
    }

    /// Fills in what lies in front of a cut and behind it; false where all lies on one side.
    #[inline]
    fn parted(&self, cut: Cut, parts: [&mut Self; 2]) -> bool {
        let mut heights = [0.0; MOST_CORNERS];
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        for (height, corner) in heights.iter_mut().zip(&self.corners[..self.count]) {
            *height = cut.height(*corner);
            lowest = height.min(lowest);
            highest = height.max(highest);
        }
        if !(lowest < 0.0 && highest > 0.0) || self.count + 1 >= MOST_CORNERS {
            return false;
        }
        let [front, back] = parts;
        (front.count, back.count) = (0, 0);
        for i in 0..self.count {
            let next = if i + 1 == self.count { 0 } else { i + 1 };
            let (a, b, here, there) = (self.corners[i], self.corners[next], heights[i], heights[next]);
            if here >= 0.0 {
                front.push(a);
            }
            if here <= 0.0 {
                back.push(a);
            }
            if here * there < 0.0 {
                let on = between(a, b, here / (here - there));
                front.push(on);
                back.push(on);
            }
        }
        true
    }

    #[inline]
    fn push(&mut self, corner: [f64; 2]) {
        self.corners[self.count] = corner;
        self.count += 1;
    }

    /// Area and centroid, by triangles from the first corner.
    #[inline]
    fn piece(&self) -> Piece {
        let [ox, oy] = self.corners[0];
        let (mut twice, mut x, mut y) = (0.0, 0.0, 0.0);
        for pair in self.corners[1..self.count.max(1)].windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|[x, y]| [x - ox, y - oy]);
            let area = a[0] * b[1] - a[1] * b[0];
            twice += area;
            x += area * (a[0] + b[0]);
            y += area * (a[1] + b[1]);
        }
        Piece { area: twice / 2.0, center: [ox + x / (3.0 * twice), oy + y / (3.0 * twice)] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn pieces_add_up_to_the_square_and_to_its_centroid() {
        let mut random = Random(9);
        for _ in 0..2000 {
            let mut pieces = Pieces::whole();
            for _ in 0..MOST_CUTS {
                pieces.split(Cut { along: [random.number(), random.number()], off: random.number() });
            }
            let area: f64 = pieces.iter().map(|piece| piece.area).sum();
            let moment =
                |axis: usize| pieces.iter().map(|piece| piece.area * piece.center[axis]).sum::<f64>();
            assert!((area - 4.0).abs() < 1e-12 && moment(0).abs() < 1e-12 && moment(1).abs() < 1e-12);
            assert!(pieces.iter().all(|piece| piece.center.iter().all(|c| c.abs() < 1.0)));
        }
    }

    #[test]
    fn a_cut_along_the_diagonal_halves_the_square() {
        let mut pieces = Pieces::whole();
        pieces.split(Cut { along: [1.0, -1.0], off: 0.0 });
        let found: Vec<_> = pieces.iter().map(|piece| (piece.area, piece.center)).collect();
        assert_eq!(found.len(), 2);
        for ((area, [x, y]), side) in found.iter().zip([-1.0, 1.0]) {
            assert!(
                (area - 2.0).abs() + (x - side / 3.0).abs() + (y + side / 3.0).abs() < 1e-15,
                "{area} {x} {y}"
            );
        }
    }

    #[test]
    fn halves_are_those_of_any_other_polygon() {
        let mut random = Random(11);
        for _ in 0..2000 {
            let cut = Cut { along: [random.number(), random.number()], off: 1.5 * random.number() };
            let mut pieces = Pieces::whole();
            pieces.split(cut);
            let Some(parts) = halves(cut) else {
                assert_eq!(pieces.len(), 1);
                continue;
            };
            for part in parts {
                let near = |other: &Piece| {
                    let [dx, dy] = [0, 1].map(|axis| (other.center[axis] - part.center[axis]).abs());
                    (other.area - part.area).abs() + dx + dy
                };
                assert!(pieces.iter().map(near).fold(f64::INFINITY, f64::min) < 1e-6, "{cut:?}");
            }
        }
    }
}
