//! Where along a ray does a solid begin and end, given where all its members do?

use smallvec::SmallVec;

use super::{End, Passage, Rule};
use crate::exact::{Number, Verdict};

/// A walk along a ray, from place to place where it crosses surfaces.
pub(super) struct Sweep<N> {
    passages: SmallVec<[Passage<N>; 4]>,
    /// How many places of each passage have been passed.
    passed: SmallVec<[usize; 4]>,
    inside: SmallVec<[bool; 4]>,
}

/// A place that was passed.
pub(super) struct Step<N> {
    /// The member whose surface is the solid's there, and where it is met; `None` where the solid does not change.
    pub(super) surface: Option<(u32, End<N>)>,
    /// Whether the ray comes into the solid.
    pub(super) enters: bool,
}

impl<N: Number> Sweep<N> {
    pub(super) fn new(passages: SmallVec<[Passage<N>; 4]>) -> Self {
        let inside = passages.iter().map(|passage| passage.inside).collect();
        Self { passed: SmallVec::from_elem(0, passages.len()), inside, passages }
    }

    fn head(&self, shape: usize) -> Option<&End<N>> {
        self.passages[shape].ends.get(self.passed[shape])
    }

    /// Passes the next place, with all that lie in the same one.
    pub(super) fn next_step(&mut self, rule: &Rule) -> Verdict<Option<Step<N>>> {
        let Some(first) = self.first_head()? else { return Ok(None) };
        let place = self.passages[first].ends[self.passed[first]].root.clone();
        let before = self.inside.clone();
        let mut crossed: SmallVec<[(u32, End<N>); 4]> = SmallVec::new();
        for shape in 0..self.passages.len() {
            let mut met = None;
            // Twice where the line touches the shape.
            while let Some(end) = self.head(shape).cloned() {
                // Numbers with errors cannot tell that a root is the same as itself.
                let is_first = shape == first && met.is_none();
                if !is_first && end.root.compare(&place)?.is_ne() {
                    break;
                }
                self.passed[shape] += 1;
                self.inside[shape] = !self.inside[shape];
                met = Some((shape as u32, end));
            }
            crossed.extend(met.filter(|_| self.inside[shape] != before[shape]));
        }
        let enters = rule.holds(&self.inside);
        let changes = enters != rule.holds(&before);
        let surface = if changes { surface(rule, &before, enters, &crossed) } else { None };
        Ok(Some(Step { surface, enters }))
    }

    /// The shape whose surface is crossed next.
    fn first_head(&self) -> Verdict<Option<usize>> {
        let mut first: Option<usize> = None;
        for shape in 0..self.passages.len() {
            let Some(head) = self.head(shape) else { continue };
            let sooner = match first.and_then(|first| self.head(first)) {
                None => true,
                Some(best) => head.root.compare(&best.root)?.is_lt(),
            };
            if sooner {
                first = Some(shape);
            }
        }
        Ok(first)
    }
}

/// Which of the members that are crossed in one place shows its surface there: the first that alone would change the solid as all
/// of them do, else the first that helps to.
fn surface<N: Number>(
    rule: &Rule,
    before: &[bool],
    enters: bool,
    crossed: &[(u32, End<N>)],
) -> Option<(u32, End<N>)> {
    let alone = |shape: u32| {
        let mut only: SmallVec<[bool; 4]> = SmallVec::from_slice(before);
        only[shape as usize] = !only[shape as usize];
        rule.holds(&only) == enters
    };
    let helps = |shape: u32| (rule.is_negative(shape) == before[shape as usize]) == enters;
    let first = |fits: &dyn Fn(u32) -> bool| crossed.iter().find(|(shape, _)| fits(*shape)).cloned();
    first(&alone).or_else(|| first(&helps))
}
