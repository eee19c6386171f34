//! Where is the surface of a member the surface of its solid?
//!
//! Every shape stands once in the tree of a solid's rule. Whether a point is inside the shape matters to the solid just where,
//! on the way from the shape to the root, each operation depends on it: the other members of a union do not hold the point,
//! those of an intersection do, and what is taken from the first member of a difference does not.

use catoptra_core::solid::{Operation, Rule};

use super::stretch::Sides;

/// What other members must be like where the surface of one is the solid's.
#[derive(Debug, Clone, Default)]
pub(super) struct Conditions {
    /// Rules, each with whether points must be inside.
    all: Vec<(Rule, bool)>,
}

impl Conditions {
    /// Of one shape of a rule. `None` where it is not in it.
    pub(super) fn of(rule: &Rule, shape: u32) -> Option<Self> {
        match rule {
            Rule::Shape(number) => (*number == shape).then(Self::default),
            Rule::Combined(operation, members) => {
                let found = members.iter().enumerate().find_map(|(i, m)| Some((i, Self::of(m, shape)?)));
                let (place, mut conditions) = found?;
                let others = members.iter().enumerate().filter(|(i, _)| *i != place);
                conditions.all.extend(others.map(|(i, other)| {
                    let first = *operation == Operation::Difference && i == 0;
                    (other.clone(), first || *operation == Operation::Intersection)
                }));
                Some(conditions)
            }
        }
    }

    /// The shapes that they speak of.
    pub(super) fn shapes(&self) -> Vec<u32> {
        let mut shapes = Vec::new();
        self.all.iter().for_each(|(rule, _)| list_shapes(rule, &mut shapes));
        shapes
    }

    /// Where they hold, given on which sides of shapes rays are, by the shapes' numbers: `inside` for certain, or `outside`
    /// for certain where they do not.
    pub(super) fn hold(&self, sides: &impl Fn(u32) -> Sides) -> Sides {
        self.all.iter().fold(Sides::ALL, |so_far, (rule, wanted)| {
            let place = sides_of(rule, sides);
            so_far.and(if *wanted { place } else { place.not() })
        })
    }
}

fn list_shapes(rule: &Rule, shapes: &mut Vec<u32>) {
    match rule {
        Rule::Shape(number) => shapes.push(*number),
        Rule::Combined(_, members) => members.iter().for_each(|member| list_shapes(member, shapes)),
    }
}

/// On which side of what a rule makes rays are.
fn sides_of(rule: &Rule, sides: &impl Fn(u32) -> Sides) -> Sides {
    match rule {
        Rule::Shape(number) => sides(*number),
        Rule::Combined(operation, members) => {
            let mut places = members.iter().map(|member| sides_of(member, sides));
            let Some(first) = places.next() else { return Sides::ALL.not() };
            match operation {
                Operation::Union => places.fold(first.not(), |out, place| out.and(place.not())).not(),
                Operation::Intersection => places.fold(first, Sides::and),
                Operation::Difference => places.fold(first, |remaining, taken| remaining.and(taken.not())),
            }
        }
    }
}
