//! How many answers are wrong, group by group?

use std::collections::{BTreeMap, HashMap};

use super::{Case, Duty, Expected, Reply};
use crate::oracle::is_same_parameter;

/// The score of a group.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Score {
    /// Cases that have an answer to be held against.
    pub cases: usize,
    /// Replies that are wrong, or missing.
    pub wrong: usize,
    /// The numbers of the first of them.
    pub examples: Vec<u64>,
    /// The largest error of a path, relative to what its conditioning makes of a relative error of 1.
    pub path_error: f64,
}

/// Paths must be right to so much of what their conditioning makes of a relative error of 1: 2⁻⁴⁰, where `f64` itself
/// has 2⁻⁵³ and a chain of mirrors makes some tens of operations at every one of up to some hundred bounces.
const PATH_ERROR: f64 = 1.0 / (1_u64 << 40) as f64;

/// How many wrong cases are told by number.
const TOLD: usize = 5;

/// Holds replies against the right answers; cases without one are left out.
#[must_use]
pub fn score(
    cases: &[Case],
    answers: &HashMap<u64, Expected>,
    replies: &HashMap<u64, Reply>,
) -> BTreeMap<String, Score> {
    let mut scores: BTreeMap<String, Score> = BTreeMap::new();
    for case in cases {
        let Some(expected) = answers.get(&case.id) else { continue };
        let score = scores.entry(case.group.clone()).or_default();
        score.cases += 1;
        let reply = replies.get(&case.id);
        if let (Some(Reply::Path(Some(path))), Expected::Path { .. }) = (reply, expected) {
            score.path_error = score.path_error.max(path_error(path, expected));
        }
        if !reply.is_some_and(|reply| is_right(reply, expected)) {
            score.wrong += 1;
            if score.examples.len() < TOLD {
                score.examples.push(case.id);
            }
        }
    }
    scores
}

fn is_right(reply: &Reply, expected: &Expected) -> bool {
    match (reply, expected) {
        (Reply::Nearest(None), Expected::Nearest(duty, _)) => *duty != Duty::Hit,
        (Reply::Nearest(Some(hit)), Expected::Nearest(duty, pairs)) => {
            let fits = |&(primitive, t): &(Option<u32>, Option<f64>)| {
                primitive.is_none_or(|p| p == hit.0) && t.is_none_or(|t| is_same_parameter(hit.1, t))
            };
            *duty != Duty::Miss && pairs.iter().any(fits)
        }
        (Reply::Occluded(hidden), Expected::Occluded(expected)) => hidden == expected,
        (Reply::Path(Some(path)), Expected::Path { primitive, .. }) => {
            path.2 == *primitive && path_error(path, expected) <= PATH_ERROR
        }
        _ => false,
    }
}

fn path_error(&(point, length, _): &([f64; 3], f64, u32), expected: &Expected) -> f64 {
    let Expected::Path { point: right, length: right_length, amplification, .. } = expected else {
        return 0.0;
    };
    let off = (0..3).map(|i| (point[i] - right[i]).abs()).fold((length - right_length).abs(), f64::max);
    off / amplification
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hit_counts_where_primitive_and_t_fit() {
        let expected =
            Expected::Nearest(Duty::Hit, vec![(Some(3), Some(1.0)), (None, Some(2.0)), (Some(7), None)]);
        let right = |hit| is_right(&Reply::Nearest(hit), &expected);
        assert!(right(Some((3, 1.0 + 1e-8))) && right(Some((9, 2.0))) && right(Some((7, -5.0))));
        assert!(!right(Some((3, 1.000_001))) && !right(Some((4, 1.0))) && !right(None));
    }

    #[test]
    fn either_still_wants_an_acceptable_hit() {
        let expected = Expected::Nearest(Duty::Either, vec![(Some(0), Some(1.0))]);
        assert!(is_right(&Reply::Nearest(None), &expected));
        assert!(!is_right(&Reply::Nearest(Some((0, 1.5))), &expected));
    }

    #[test]
    fn tiny_and_huge_parameters_are_compared_by_their_ratio() {
        assert!(is_same_parameter(1.000_000_05e-49, 1e-49) && !is_same_parameter(1.000_001e-49, 1e-49));
        assert!(is_same_parameter(1.000_000_05e49, 1e49) && !is_same_parameter(1.000_001e49, 1e49));
    }
}
