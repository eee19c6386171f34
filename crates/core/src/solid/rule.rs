//! When does a point lie inside a solid that is made of others?

use crate::Aabb;

/// How members are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Operation {
    /// What lies in any of the members.
    Union,
    /// What lies in all members.
    Intersection,
    /// What lies in the first member and in no other.
    Difference,
}

impl Operation {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Union, Self::Intersection, Self::Difference];

    /// The word for it in scene text.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Union => "union",
            Self::Intersection => "intersection",
            Self::Difference => "difference",
        }
    }

    /// The operation of that word.
    #[must_use]
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|operation| operation.word() == word)
    }
}

/// A tree of operations over shapes, which are numbered in the order of the tree.
#[derive(Debug, Clone, PartialEq)]
pub enum Rule {
    /// A shape.
    Shape(u32),
    /// Members, and how they are combined. Nothing is inside of no members.
    Combined(Operation, Vec<Self>),
}

impl Rule {
    /// Whether a point is inside that is inside of those shapes that `inside` tells.
    pub(crate) fn holds(&self, inside: &[bool]) -> bool {
        match self {
            Self::Shape(number) => inside[*number as usize],
            Self::Combined(Operation::Union, members) => members.iter().any(|m| m.holds(inside)),
            Self::Combined(Operation::Intersection, members) => {
                !members.is_empty() && members.iter().all(|m| m.holds(inside))
            }
            Self::Combined(Operation::Difference, members) => {
                members.split_first().is_some_and(|(first, others)| {
                    first.holds(inside) && !others.iter().any(|other| other.holds(inside))
                })
            }
        }
    }

    /// Whether the solid loses what a shape of that number gains: whether it stands behind the first members of an odd number
    /// of differences. `false` where the rule does not name it.
    #[must_use]
    pub fn is_negative(&self, number: u32) -> bool {
        self.takes_away(number).unwrap_or(false)
    }

    /// As [`is_negative`](Self::is_negative); `None` where the rule does not name it.
    fn takes_away(&self, number: u32) -> Option<bool> {
        match self {
            Self::Shape(own) => (*own == number).then_some(false),
            Self::Combined(operation, members) => members.iter().enumerate().find_map(|(place, member)| {
                let is_other = *operation == Operation::Difference && place > 0;
                member.takes_away(number).map(|within| within != is_other)
            }),
        }
    }

    /// A box round all that is inside, given those of the shapes; `None` where that has no end.
    pub(crate) fn bounds(&self, shapes: &[Option<Aabb>]) -> Option<Aabb> {
        match self {
            Self::Shape(number) => shapes[*number as usize],
            Self::Combined(Operation::Union, members) => members
                .iter()
                .try_fold(Aabb::EMPTY, |all, member| member.bounds(shapes).map(|own| all.union(own))),
            Self::Combined(Operation::Intersection, members) => {
                members.iter().filter_map(|member| member.bounds(shapes)).reduce(Aabb::intersection)
            }
            Self::Combined(Operation::Difference, members) => members.first()?.bounds(shapes),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_difference_takes_away_is_negative_and_twice_is_positive() {
        let of = |operation, members| Rule::Combined(operation, members);
        // 0 − (1 ∪ (2 − 3)), and beside it 4 ∩ 5.
        let inner = of(Operation::Difference, vec![Rule::Shape(2), Rule::Shape(3)]);
        let taken = of(Operation::Union, vec![Rule::Shape(1), inner]);
        let left = of(Operation::Difference, vec![Rule::Shape(0), taken]);
        let beside = of(Operation::Intersection, vec![Rule::Shape(4), Rule::Shape(5)]);
        let rule = of(Operation::Union, vec![left, beside]);
        let negative: Vec<u32> = (0..7).filter(|&number| rule.is_negative(number)).collect();
        assert_eq!(negative, [1, 2]);
        // Whatever else is inside, a shape that is no more inside changes the solid to that side alone.
        for number in 0..6_u32 {
            for bits in 0..64_u32 {
                let inside: Vec<bool> = (0..6).map(|i| bits >> i & 1 == 1 && i != number).collect();
                let mut more = inside.clone();
                more[number as usize] = true;
                let [without, with] = [inside, more].map(|inside| rule.holds(&inside));
                assert!(without == with || with != rule.is_negative(number), "{number} {bits:b}");
            }
        }
    }
}
