//! Into which convex pieces do straight cuts part a square?

use super::cut::Cut;
use crate::numeric::LEAST_PIECE;

/// Most cuts through one square.
pub(crate) const MOST_CUTS: usize = 5;

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

/// The pieces of a square that reaches from −1 to 1.
pub(crate) struct Pieces {
    count: usize,
    pieces: [(Polygon, Piece); MOST_PIECES],
}

const SQUARE: Polygon = {
    let mut corners = [[0.0; 2]; MOST_CORNERS];
    corners[0] = [-1.0, -1.0];
    corners[1] = [1.0, -1.0];
    corners[2] = [1.0, 1.0];
    corners[3] = [-1.0, 1.0];
    Polygon { count: 4, corners }
};

impl Pieces {
    /// The square as it is.
    #[inline]
    pub(crate) fn whole() -> Self {
        Self { count: 1, pieces: [(SQUARE, Piece { area: 4.0, center: [0.0; 2] }); MOST_PIECES] }
    }

    /// Puts the square together again.
    #[inline]
    pub(crate) fn reset(&mut self) {
        self.count = 1;
        self.pieces[0] = (SQUARE, Piece { area: 4.0, center: [0.0; 2] });
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// Areas and centroids.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Piece> {
        self.pieces[..self.count].iter().map(|(_, piece)| piece)
    }

    /// Parts every piece that a cut goes through. Slivers stay with their larger part.
    #[inline]
    pub(crate) fn split(&mut self, cut: Cut) {
        for at in 0..self.count {
            if self.count == MOST_PIECES {
                return;
            }
            let Some([front, back]) = self.pieces[at].0.parted(cut) else { continue };
            let parts = [front, back].map(|polygon| (polygon, polygon.piece()));
            if parts.iter().any(|(_, piece)| !(piece.area > LEAST_PIECE)) {
                continue;
            }
            self.pieces[at] = parts[0];
            self.pieces[self.count] = parts[1];
            self.count += 1;
        }
    }
}

impl Polygon {
    /// What lies in front of a cut and behind it; `None` where all lies on one side.
    #[inline]
    fn parted(&self, cut: Cut) -> Option<[Self; 2]> {
        let mut heights = [0.0; MOST_CORNERS];
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        for (height, [x, y]) in heights.iter_mut().zip(&self.corners[..self.count]) {
            *height = cut.along[0].mul_add(*x, cut.along[1].mul_add(*y, cut.off));
            lowest = height.min(lowest);
            highest = height.max(highest);
        }
        if !(lowest < 0.0 && highest > 0.0) || self.count + 1 >= MOST_CORNERS {
            return None;
        }
        let mut parts = [Self { count: 0, corners: [[0.0; 2]; MOST_CORNERS] }; 2];
        for i in 0..self.count {
            let next = if i + 1 == self.count { 0 } else { i + 1 };
            let (a, b, here, there) = (self.corners[i], self.corners[next], heights[i], heights[next]);
            if here >= 0.0 {
                parts[0].push(a);
            }
            if here <= 0.0 {
                parts[1].push(a);
            }
            if here * there < 0.0 {
                let share = here / (here - there);
                let on = [share.mul_add(b[0] - a[0], a[0]), share.mul_add(b[1] - a[1], a[1])];
                parts[0].push(on);
                parts[1].push(on);
            }
        }
        Some(parts)
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
        let found: Vec<_> = pieces.iter().map(|piece| (piece.area, piece.center[0].abs())).collect();
        assert_eq!(found, [(2.0, 1.0 / 3.0); 2]);
    }
}
