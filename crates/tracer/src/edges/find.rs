//! Which pixels of a tile do outlines cross, and into which pieces do they part them?
//!
//! A tile is quartered down to pixels, each quarter with the outlines that may cross it: what is left out is certain not to.
//! A pixel that straight cuts part into convex pieces is shown by a ray through the centroid of each. One whose outlines are
//! too many or bend too much is quartered further; what is too small for that is sampled in its middle.

use super::checker::Lines;
use super::cut::Cuts;
use super::form::Square;
use super::sight::Outline;
use super::split::{MOST_CUTS, Piece, Pieces, halves};
use super::{EdgeList, PixelPieces};
use crate::Region;
use crate::numeric::{FINEST_SQUARE, MOST_PIXEL_PIECES};

/// Room for what a tile needs.
#[derive(Debug, Default)]
pub(super) struct SearchRoom {
    /// The outlines that may cross the tile.
    outlines: Vec<Outline>,
    /// Lines between checkered squares in mirrors; they are numbered on from the outlines.
    lines: Vec<Lines>,
    /// Those that part a pixel only where outlines do.
    others: Vec<Lines>,
    /// Numbers of those that may cross the squares on the way down, square after square.
    stack: Vec<u32>,
    pieces: Pieces,
}

/// Looking through a tile.
pub(super) struct Search<'a> {
    region: Region,
    room: &'a mut SearchRoom,
    /// Whether a round surface with a pattern may be seen.
    patterned: bool,
    seed: u32,
    /// How many pieces there may be up to those of the pixel under way.
    limit: usize,
    found: &'a mut PixelPieces,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        edges: &EdgeList,
        region: Region,
        room: &'a mut SearchRoom,
        found: &'a mut PixelPieces,
    ) -> Self {
        let SearchRoom { outlines, lines, others, stack, .. } = room;
        outlines.clear();
        for (bounds, outline) in edges.bounds.iter().zip(&edges.outlines) {
            if near(bounds, region) {
                outlines.push(*outline);
            }
        }
        let seen = |alone: bool| {
            edges.lines.iter().filter(move |lines| lines.alone == alone && near(&lines.bounds, region))
        };
        lines.clear();
        lines.extend(seen(true));
        others.clear();
        others.extend(seen(false));
        stack.clear();
        let patterned = edges.patterned.iter().any(|part| near(part, region));
        Self { region, room, patterned, seed: edges.seed, limit: 0, found }
    }

    /// Finds the pieces of all pixels.
    pub(super) fn run(&mut self) {
        self.room.stack.extend(0..(self.room.outlines.len() + self.room.lines.len()) as u32);
        if self.room.stack.is_empty() {
            return;
        }
        let size = self.region.size;
        let edge = size.width.max(size.height).next_power_of_two();
        self.look(self.region.x, self.region.y, edge, 0);
    }

    /// Looks through a square of pixels; its outlines are those of the stack from `first` on.
    fn look(&mut self, x: u32, y: u32, edge: u32, first: usize) {
        let half = f64::from(edge) / 2.0;
        let square = Square { x: f64::from(x) + half, y: f64::from(y) + half, half };
        let last = self.room.stack.len();
        self.keep_crossing(square, first..last);
        if self.room.stack.len() > last {
            if edge == 1 {
                self.part_pixel([x, y], square, last);
            } else {
                let half = edge / 2;
                let (right, bottom) =
                    (self.region.x + self.region.size.width, self.region.y + self.region.size.height);
                for (x, y) in [(x, y), (x + half, y), (x, y + half), (x + half, y + half)] {
                    if x < right && y < bottom {
                        self.look(x, y, half, last);
                    }
                }
            }
        }
        self.room.stack.truncate(last);
    }

    /// Adds those of some outlines that may cross a square to the stack.
    fn keep_crossing(&mut self, square: Square, among: std::ops::Range<usize>) {
        let Square { x, y, half } = square;
        for at in among {
            let number = self.room.stack[at] as usize;
            let outline = self.room.outlines.get(number);
            let bounds = outline
                .map_or_else(|| &self.room.lines[number - self.room.outlines.len()].bounds, |o| &o.bounds);
            let [left, top, right, bottom] = *bounds;
            if left <= x + half
                && right >= x - half
                && top <= y + half
                && bottom >= y - half
                && match outline {
                    Some(outline) => outline.form.may_cross(square),
                    None => self.room.lines[number - self.room.outlines.len()].may_cross(square),
                }
            {
                self.room.stack.push(number as u32);
            }
        }
    }

    /// Parts a pixel that outlines may cross.
    fn part_pixel(&mut self, [x, y]: [u32; 2], square: Square, first: usize) {
        let before = self.found.len();
        let counts = self.found.counts;
        self.limit = before + MOST_PIXEL_PIECES;
        let cuts = self.part(square, first);
        let pieces = self.found.len() - before;
        if cuts == 0 || pieces < 2 {
            self.found.truncate(before);
            self.found.counts = counts;
            return;
        }
        if self.found.len() > self.limit {
            self.found.truncate(before);
            self.found.add_samples([x - self.region.x, y - self.region.y], self.region, self.seed);
            return;
        }
        let total: f64 = self.found.share[before..].iter().sum();
        self.found.share[before..].iter_mut().for_each(|share| *share /= total);
        self.found.pixels.push(([x - self.region.x, y - self.region.y], before as u32));
        let kinds = &mut self.found.counts;
        *if self.found.quartered { &mut kinds.quartered } else { &mut kinds.parted } += 1;
        self.found.quartered = false;
    }

    /// Adds the pieces of a square, whose outlines are those of the stack from `first` on. Returns how many cuts there are.
    fn part(&mut self, square: Square, first: usize) -> u32 {
        let last = self.room.stack.len();
        if last - first == 1
            && self.room.others.is_empty()
            && let Some(outline) = self.room.outlines.get(self.room.stack[first] as usize)
            && let Cuts::Straight(cut) = Cuts::of(&outline.form.within(square))
        {
            let Some(parts) = halves(cut) else {
                self.found.add(Piece::SQUARE, square, self.patterned);
                return 0;
            };
            parts.into_iter().for_each(|piece| self.found.add(piece, square, self.patterned));
            return 1;
        }
        self.room.pieces.reset();
        let told = self.cut(square, first..last);
        if told {
            let mixed = self.patterned || self.room.others.iter().any(|lines| lines.are_many(square));
            let Self { room, found, .. } = self;
            room.pieces.iter().for_each(|piece| found.add(*piece, square, mixed));
            return self.room.pieces.len() as u32 - 1;
        }
        self.found.quartered = true;
        if square.half <= FINEST_SQUARE {
            self.found.add(Piece::SQUARE, square, true);
            return 1;
        }
        let mut cuts = 0;
        for quarter in square.quarters() {
            if self.found.len() > self.limit {
                return 1;
            }
            self.keep_crossing(quarter, first..last);
            cuts += self.part(quarter, last);
            self.room.stack.truncate(last);
        }
        cuts
    }

    /// Cuts the square of the pieces by some outlines, and by the lines between what squares there are; false where they are
    /// too many or bend too much.
    fn cut(&mut self, square: Square, among: std::ops::Range<usize>) -> bool {
        if among.len() > MOST_CUTS {
            return false;
        }
        let mut left = MOST_CUTS as u32;
        for at in among {
            let number = self.room.stack[at] as usize;
            let told = match self.room.outlines.get(number) {
                Some(outline) => match Cuts::of(&outline.form.within(square)) {
                    Cuts::Not => true,
                    Cuts::Straight(cut) => self.room.pieces.cut(cut, &mut left),
                    Cuts::Bent => false,
                },
                None => cut_by_lines(
                    &mut self.room.pieces,
                    &self.room.lines[number - self.room.outlines.len()],
                    square,
                    &mut left,
                ),
            };
            if !told {
                return false;
            }
        }
        self.room.others.iter().all(|lines| cut_by_lines(&mut self.room.pieces, lines, square, &mut left))
    }
}

/// Whether a part of the picture reaches into a rectangle of pixels.
pub(super) fn near(bounds: &[f64; 4], region: Region) -> bool {
    let [left, top] = [region.x, region.y].map(f64::from);
    let [right, bottom] = [left + f64::from(region.size.width), top + f64::from(region.size.height)];
    bounds[0] <= right && bounds[2] >= left && bounds[1] <= bottom && bounds[3] >= top
}

/// Cuts pieces by the lines of a family; false where no more of the cuts that are allowed is left.
fn cut_by_lines(pieces: &mut Pieces, lines: &Lines, square: Square, left: &mut u32) -> bool {
    let [left_edge, top, right, bottom] = lines.bounds;
    let Square { x, y, half } = square;
    if left_edge > x + half || right < x - half || top > y + half || bottom < y - half {
        return true;
    }
    let Some([first, last]) = lines.numbers(square) else { return true };
    (0..(last - first) as u32).all(|i| pieces.cut(lines.cut(first + f64::from(i), square), left))
}
