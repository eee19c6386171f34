//! How is the outline of a polygon cut into triangles that lie within it? By ears: corners whose triangle holds no other
//! corner are cut off, one after another (G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82, 1975).
//!
//! Outlines may touch themselves, as where a hole is joined by a bridge. All questions are answered exactly, so that an
//! outline which does not cross itself is never cut wrongly; one that does is cut somehow.

use std::cmp::Ordering;
use std::collections::VecDeque;

use catoptra_core::glam::DVec2;

use super::corners::Corners;
use super::turn::turn;

/// An outline that becomes smaller; kept to use its memory again.
#[derive(Debug, Default)]
pub(super) struct Ears {
    points: Vec<DVec2>,
    before: Vec<u32>,
    after: Vec<u32>,
    /// Whether it is gone through against the order of its corners.
    is_reversed: bool,
    left: usize,
    /// One of the corners that are left.
    some: u32,
    corners: Corners,
    /// Corners to be looked at, each with the number of its entry; only the latest entry of a corner counts.
    queue: VecDeque<(u32, u32)>,
    entries: Vec<u32>,
}

/// What may lie in a triangle that is cut off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Rule {
    /// Nothing, not even on its new side.
    Nothing,
    /// What touches its new side from beyond.
    Touching,
    /// Anything.
    Anything,
}

/// How often all corners are looked at by the rules; once is enough where the outline does not touch itself.
const ROUNDS: u32 = 16;

impl Ears {
    /// Cuts an outline that runs anticlockwise and adds the triangles, by numbers of its corners in their order. Answers
    /// whether it could do so by the rules: else the outline crosses itself.
    pub(super) fn cut(&mut self, outline: &[DVec2], out: &mut Vec<[u32; 3]>) -> bool {
        self.begin(outline);
        let mut is_clean = true;
        for round in 0..2 * ROUNDS {
            let rules: &[Rule] =
                if round < ROUNDS { &[Rule::Nothing, Rule::Touching] } else { &[Rule::Anything] };
            let mut found = self.look_by(rules, out);
            if self.left < 3 {
                break;
            }
            if !found {
                is_clean = false;
                // What is left of an eight is a loop that runs the other way round.
                if self.area() < 0.0 {
                    self.reverse();
                    found = self.look_by(rules, out);
                }
                if !found && !self.look_by(&[Rule::Anything], out) {
                    break;
                }
            }
        }
        is_clean
    }

    fn begin(&mut self, outline: &[DVec2]) {
        let count = outline.len() as u32;
        self.points.clear();
        self.points.extend_from_slice(outline);
        self.before.clear();
        self.before.extend((0..count).map(|i| if i == 0 { count - 1 } else { i - 1 }));
        self.after.clear();
        self.after.extend((0..count).map(|i| if i == count - 1 { 0 } else { i + 1 }));
        self.entries.clear();
        self.entries.resize(outline.len(), 0);
        self.corners.fill(outline);
        (self.left, self.some, self.is_reversed) = (outline.len(), 0, false);
    }

    fn reverse(&mut self) {
        std::mem::swap(&mut self.before, &mut self.after);
        self.is_reversed = !self.is_reversed;
    }

    /// Twice the area of what is left.
    fn area(&self) -> f64 {
        let from = self.points[self.some as usize];
        let (mut corner, mut sum) = (self.some, 0.0);
        for _ in 0..self.left {
            let next = self.after[corner as usize];
            let [a, b] = [corner, next].map(|corner| self.points[corner as usize] - from);
            sum += a.perp_dot(b);
            corner = next;
        }
        sum
    }

    /// Looks at all corners by one rule, then by the next where that has found nothing. Whether any was found.
    fn look_by(&mut self, rules: &[Rule], out: &mut Vec<[u32; 3]>) -> bool {
        rules.iter().any(|&rule| {
            let before = self.left;
            let mut corner = self.some;
            for _ in 0..self.left {
                self.enqueue(corner);
                corner = self.after[corner as usize];
            }
            while let Some((corner, entry)) = self.queue.pop_front() {
                if self.entries[corner as usize] == entry {
                    self.look_at(corner, rule, out);
                }
            }
            self.left < before
        })
    }

    fn enqueue(&mut self, corner: u32) {
        let entry = &mut self.entries[corner as usize];
        *entry += 1;
        self.queue.push_back((corner, *entry));
    }

    /// Cuts a corner off if it is an ear; takes it out if there is nothing at it.
    fn look_at(&mut self, corner: u32, rule: Rule, out: &mut Vec<[u32; 3]>) {
        let numbers @ [before, _, after] =
            [self.before[corner as usize], corner, self.after[corner as usize]];
        let triangle @ [a, b, c] = numbers.map(|corner| self.points[corner as usize]);
        match turn(a, b, c) {
            // Doubled, or the tip of a spike.
            Ordering::Equal if a == b || b == c || (a - b).dot(c - b) > 0.0 => {}
            Ordering::Greater if rule == Rule::Anything || !self.is_blocked(numbers, triangle, rule) => {
                out.push(if self.is_reversed { [after, corner, before] } else { numbers });
            }
            _ => return,
        }
        self.take(corner, [before, after]);
    }

    fn take(&mut self, corner: u32, [before, after]: [u32; 2]) {
        self.after[before as usize] = after;
        self.before[after as usize] = before;
        self.corners.take(corner);
        self.entries[corner as usize] += 1;
        self.left -= 1;
        self.some = before;
        if self.left < 3 {
            self.queue.clear();
            return;
        }
        // Those beside it come last, so that triangles do not become slivers round one corner.
        self.enqueue(before);
        self.enqueue(after);
    }

    fn is_blocked(&self, numbers: [u32; 3], triangle: [DVec2; 3], rule: Rule) -> bool {
        self.corners
            .any_near(triangle, |other| !numbers.contains(&other) && self.blocks(other, triangle, rule))
    }

    /// Whether a corner must not lie where it does if this triangle is to be cut off at its second corner.
    fn blocks(&self, corner: u32, [a, b, c]: [DVec2; 3], rule: Rule) -> bool {
        let sides = [(a, b), (b, c), (c, a)];
        let point = self.points[corner as usize];
        let turns = sides.map(|(from, to)| turn(from, to, point));
        if turns.contains(&Ordering::Less) {
            return false;
        }
        // From the sides on which the corner lies, the outline goes inwards.
        let goes_inwards = |next: u32| {
            let next = self.points[next as usize];
            let on = sides.iter().zip(turns).filter(|(_, turned)| *turned == Ordering::Equal);
            on.map(|((from, to), _)| turn(*from, *to, next)).all(Ordering::is_gt)
        };
        let on_new_side = turns == [Ordering::Greater, Ordering::Greater, Ordering::Equal];
        on_new_side && rule == Rule::Nothing
            || goes_inwards(self.before[corner as usize])
            || goes_inwards(self.after[corner as usize])
    }
}
