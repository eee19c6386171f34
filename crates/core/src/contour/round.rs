//! What do round outlines leave of a convex piece of the lamp? By subtraction of intervals on edges and arcs.

use glam::DVec3;

use super::angle::angle;
use super::conic::{Arc, Conic, Cut, Turn};
use super::pair::{Arcs, Pair, rest_of};
use super::polygon::{Corner, contour, for_each_edge};

/// The round outlines of a view: first the lamp's own, if it is round, then those of blockers.
#[derive(Debug, Default)]
pub(super) struct Curves {
    list: Vec<Curve>,
    has_lamp: bool,
    /// What other outlines take of each curve.
    taken: Vec<(usize, Arc)>,
    work: Work,
}

#[derive(Debug)]
struct Curve {
    conic: Conic,
    matters: bool,
}

/// Lists for one piece.
#[derive(Debug, Default)]
struct Work {
    /// How curves that matter lie to each edge's plane, curve by curve.
    cuts: Vec<Cut>,
    /// The stretches of edges within curves.
    spans: Vec<Stretch>,
    /// Curves that meet the piece, each with the start of its cuts.
    met: Vec<(usize, usize)>,
    gaps: Vec<[f64; 2]>,
    arcs: Vec<(f64, f64, Arc)>,
}

/// A part of an edge, 0 at its first corner, 1 at the next, within a curve.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    edge: usize,
    is_lamp: bool,
    from: f64,
    to: f64,
}

/// How a curve lies to a piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Relation {
    Apart,
    /// The body holds all of the piece.
    Covers,
    Meets,
}

impl Curves {
    /// Forgets all but a lamp's own outline.
    pub(super) fn begin(&mut self, lamp: Option<&Conic>) {
        self.list.clear();
        self.taken.clear();
        self.has_lamp = lamp.is_some();
        if let Some(conic) = lamp {
            self.push(*conic);
        }
    }

    pub(super) fn push(&mut self, conic: Conic) {
        self.list.push(Curve { conic, matters: true });
    }

    /// Whether there is no blocker's outline.
    pub(super) fn are_plain(&self) -> bool {
        self.list.len() == usize::from(self.has_lamp)
    }

    /// Whether a piece of the lamp's polygon meets its outline, if it is round.
    pub(super) fn lamp_meets(&mut self, piece: &[Corner]) -> bool {
        if !self.has_lamp {
            return true;
        }
        self.work.cuts.clear();
        self.work.spans.clear();
        self.work.relation(&self.list[0].conic, piece, true) != Relation::Apart
    }

    /// Whether a body may hide a part of a lamp whose polygon is given.
    pub(super) fn meets_lamp(&mut self, outline: &[Corner], conic: &Conic) -> bool {
        self.work.cuts.clear();
        self.work.spans.clear();
        if self.work.relation(conic, outline, false) == Relation::Apart {
            return false;
        }
        !(self.has_lamp && matches!(Pair::of(&self.list[0].conic, conic), Pair::Apart))
    }

    /// Finds what curves take of one another; `false` where the lamp's outline is hidden wholly.
    pub(super) fn settle_pairs(&mut self) -> bool {
        for i in 0..self.list.len() {
            for j in i + 1..self.list.len() {
                if !(self.list[i].matters && self.list[j].matters) {
                    continue;
                }
                let is_lamp = self.has_lamp && i == 0;
                match Pair::of(&self.list[i].conic, &self.list[j].conic) {
                    Pair::Same | Pair::FirstWithin if is_lamp => return false,
                    Pair::FirstWithin => self.list[i].matters = false,
                    Pair::Apart if is_lamp => self.list[j].matters = false,
                    Pair::Same => self.list[j].matters = false,
                    Pair::SecondWithin if !is_lamp => self.list[j].matters = false,
                    Pair::Apart | Pair::SecondWithin => {}
                    Pair::Cross([first, second]) => {
                        self.take(i, first);
                        self.take(j, if is_lamp { rest_of(second) } else { second });
                    }
                }
            }
        }
        true
    }

    fn take(&mut self, curve: usize, arcs: Arcs) {
        self.taken.extend(arcs.into_iter().flatten().map(|arc| (curve, arc)));
    }

    /// Twice the share of a piece in the contour.
    pub(super) fn contour(&mut self, normal: DVec3, piece: &[Corner]) -> f64 {
        let work = &mut self.work;
        work.cuts.clear();
        work.spans.clear();
        work.met.clear();
        let mut in_lamp = false;
        for (i, curve) in self.list.iter().enumerate().filter(|(_, curve)| curve.matters) {
            let is_lamp = self.has_lamp && i == 0;
            let start = work.cuts.len();
            match work.relation(&curve.conic, piece, is_lamp) {
                Relation::Apart if is_lamp => return 0.0,
                Relation::Covers if !is_lamp => return 0.0,
                Relation::Apart | Relation::Covers => work.cuts.truncate(start),
                Relation::Meets => {
                    work.met.push((i, start));
                    in_lamp |= is_lamp;
                }
            }
        }
        if work.met.is_empty() {
            return contour(normal, piece);
        }
        let mut sum = work.edges(normal, piece, in_lamp);
        for k in 0..work.met.len() {
            let (i, start) = work.met[k];
            let sign = if self.has_lamp && i == 0 { 1.0 } else { -1.0 };
            let taken = self.taken.iter().filter(|(owner, _)| *owner == i).map(|(_, arc)| *arc);
            sum += sign * work.curve(&self.list[i].conic, start..start + piece.len(), taken);
        }
        sum
    }
}

impl Work {
    /// How a curve lies to a piece; its cuts and stretches are added where they meet.
    fn relation(&mut self, conic: &Conic, piece: &[Corner], is_lamp: bool) -> Relation {
        let (cuts, spans) = (self.cuts.len(), self.spans.len());
        for corner in piece {
            let cut = conic.cut(corner.edge);
            if matches!(cut, Cut::Outside) {
                self.cuts.truncate(cuts);
                return Relation::Apart;
            }
            self.cuts.push(cut);
        }
        let (mut edge, mut covers) = (0, true);
        for_each_edge(piece, |corner, next| {
            let within = match self.cuts[cuts + edge] {
                Cut::Part(arc) => stretch(corner, next, conic, arc),
                Cut::Within | Cut::Outside => None,
            };
            if let Some([from, to]) = within {
                self.spans.push(Stretch { edge, is_lamp, from, to });
            }
            covers &= within == Some([0.0, 1.0]);
            edge += 1;
        });
        if covers {
            self.spans.truncate(spans);
            Relation::Covers
        } else if self.spans.len() > spans || piece.iter().all(|corner| corner.edge.dot(conic.center) >= 0.0)
        {
            Relation::Meets
        } else {
            self.cuts.truncate(cuts);
            Relation::Apart
        }
    }

    /// The edges' part: within the lamp's outline, if that meets the piece, and outside all others.
    fn edges(&mut self, normal: DVec3, piece: &[Corner], in_lamp: bool) -> f64 {
        let (mut edge, mut sum) = (0, 0.0);
        for_each_edge(piece, |corner, next| {
            self.gaps.clear();
            let (mut start, mut end) = if in_lamp { (1.0, 1.0) } else { (0.0, 1.0) };
            for span in self.spans.iter().filter(|span| span.edge == edge) {
                if span.is_lamp {
                    (start, end) = (span.from, span.to);
                } else {
                    self.gaps.push([span.from, span.to]);
                }
            }
            edge += 1;
            let along = next - corner.at;
            let sine = corner.edge.dot(corner.at.cross(along));
            let mut angles = 0.0;
            let mut add = |from: f64, to: f64| {
                if from < to {
                    let (a, b) =
                        (corner.at + along * from, if to == 1.0 { next } else { corner.at + along * to });
                    angles += angle((to - from) * sine, a.dot(b));
                }
            };
            self.gaps.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
            for [from, to] in &self.gaps {
                add(start, from.min(end));
                start = start.max(*to);
            }
            add(start, end);
            sum += normal.dot(corner.edge) * angles;
        });
        sum
    }

    /// A curve's part: within the piece, without what others take of it.
    fn curve(
        &mut self,
        conic: &Conic,
        cuts: std::ops::Range<usize>,
        taken: impl Iterator<Item = Arc>,
    ) -> f64 {
        self.arcs.clear();
        let outside = self.cuts[cuts].iter().filter_map(|cut| match cut {
            Cut::Part(arc) => Some(arc.rest()),
            Cut::Within | Cut::Outside => None,
        });
        for arc in outside.chain(taken) {
            let (from, to) = (arc.from.key(), arc.to.key());
            if from <= to {
                self.arcs.push((from, to, arc));
            } else {
                self.arcs.push((from, 4.0, Arc { to: Turn::START, ..arc }));
                self.arcs.push((0.0, to, Arc { from: Turn::START, ..arc }));
            }
        }
        if self.arcs.is_empty() {
            return conic.whole();
        }
        self.arcs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let (mut sum, mut start, mut place) = (0.0, 0.0, Turn::START);
        for (from, to, arc) in &self.arcs {
            if *from > start {
                sum += conic.arc(Arc { from: place, to: arc.from }, from - start);
            }
            if *to > start {
                (start, place) = (*to, arc.to);
            }
        }
        if start < 4.0 {
            sum += conic.arc(Arc { from: place, to: Turn::START }, 4.0 - start);
        }
        sum
    }
}

/// The stretch of an edge within a curve, given the arc of it on the inner side of the edge's plane. Along the edge one comes
/// in where that arc ends and goes out where it begins, or the other way where rounding has swapped the edge's ends.
#[inline]
fn stretch(corner: Corner, next: DVec3, conic: &Conic, arc: Arc) -> Option<[f64; 2]> {
    let (mut after, mut before) = (corner.edge.cross(corner.at), next.cross(corner.edge));
    let (mut enter, mut leave) = (conic.at(arc.to), conic.at(arc.from));
    if after.dot(next) < 0.0 {
        (after, before, enter, leave) = (-after, -before, leave, enter);
    }
    let (enter_after, enter_before) = (after.dot(enter), before.dot(enter));
    let (leave_after, leave_before) = (after.dot(leave), before.dot(leave));
    let from = if enter_after >= 0.0 && enter_before >= 0.0 {
        enter_after / (enter_after + enter_before)
    } else if enter_after <= 0.0 && leave_after >= 0.0 {
        0.0
    } else {
        return None;
    };
    let to = if leave_after >= 0.0 && leave_before >= 0.0 {
        leave_after / (leave_after + leave_before)
    } else if leave_before <= 0.0 && enter_before >= 0.0 {
        1.0
    } else {
        return None;
    };
    if from < to { Some([from, to]) } else { None }
}
