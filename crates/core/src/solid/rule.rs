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
