//! A tree over many lamps: picks one with a chance that grows with its power and falls with the square of its distance.
//!
//! Conty Estevez and Kulla, "Importance sampling of many lights with adaptive tree splitting", HPG 2018, without splitting
//! and without orientation.

use catoptra_core::glam::DVec3;

use super::Ball;

/// A binary tree over lamps, by their balls and powers; positions are relative to the snapshot's origin.
#[derive(Debug, Default)]
pub(crate) struct LampTree {
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    ball: Ball,
    power: f64,
    /// A lamp, or the second child of an inner node, whose first child follows it.
    link: Link,
}

#[derive(Debug, Clone, Copy)]
enum Link {
    Lamp(u32),
    Second(u32),
}

impl LampTree {
    /// Over lamps with their powers.
    pub(super) fn new(lamps: &[(Ball, f64)]) -> Self {
        let mut tree = Self::default();
        let mut order: Vec<u32> = (0..lamps.len() as u32).collect();
        if !order.is_empty() {
            tree.add(lamps, &mut order);
        }
        tree
    }

    /// Adds the node over some lamps, and those below it: halves along the axis on which their middles lie farthest apart.
    fn add(&mut self, lamps: &[(Ball, f64)], order: &mut [u32]) {
        let of = |lamp: u32| &lamps[lamp as usize];
        let at = self.nodes.len();
        if let [lamp] = *order {
            let (ball, power) = *of(lamp);
            self.nodes.push(Node { ball, power, link: Link::Lamp(lamp) });
            return;
        }
        let middles = || order.iter().map(|&lamp| of(lamp).0.center);
        let (least, most) =
            middles().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(a, b), c| (a.min(c), b.max(c)));
        let size = most - least;
        let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0);
        let middle = (least + most) / 2.0;
        let radius = order.iter().map(|&lamp| of(lamp).0.center.distance(middle) + of(lamp).0.radius);
        let ball = Ball { center: middle, radius: radius.fold(0.0, f64::max) };
        let power = order.iter().map(|&lamp| of(lamp).1).sum();
        self.nodes.push(Node { ball, power, link: Link::Second(0) });
        let half = order.len() / 2;
        order.select_nth_unstable_by(half, |&a, &b| {
            of(a).0.center[axis].total_cmp(&of(b).0.center[axis]).then(a.cmp(&b))
        });
        let (first, second) = order.split_at_mut(half);
        self.add(lamps, first);
        self.nodes[at].link = Link::Second(self.nodes.len() as u32);
        self.add(lamps, second);
    }

    /// The lamp that a share in 0..1 picks for a point, with the chance that it is picked.
    pub(crate) fn pick(&self, point: DVec3, mut share: f64) -> Option<(u32, f64)> {
        let (mut at, mut chance) = (0, 1.0);
        loop {
            let second = match self.nodes.get(at)?.link {
                Link::Lamp(lamp) => return Some((lamp, chance)),
                Link::Second(second) => second as usize,
            };
            let [a, b] = [at + 1, second].map(|child| self.nodes[child].weight(point));
            let first = if a + b > 0.0 && (a + b).is_finite() { a / (a + b) } else { 0.5 };
            if share < first {
                (at, chance, share) = (at + 1, chance * first, share / first);
            } else {
                let rest = 1.0 - first;
                (at, chance, share) = (second, chance * rest, (share - first) / rest);
            }
            share = share.clamp(0.0, 1.0_f64.next_down());
        }
    }
}

impl Node {
    /// What is expected to arrive from it, but for a common factor.
    fn weight(&self, point: DVec3) -> f64 {
        let distance2 = self.ball.center.distance_squared(point);
        self.power / distance2.max(self.ball.radius * self.ball.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn lamps(count: usize) -> Vec<(Ball, f64)> {
        let mut random = Random(5);
        let ball = |random: &mut Random| Ball { center: random.point() * 9.0, radius: 0.1 };
        (0..count).map(|_| (ball(&mut random), 1.5 + random.number())).collect()
    }

    #[test]
    fn chances_add_up_to_one_and_every_lamp_has_one() {
        for count in [1, 2, 3, 100] {
            let tree = LampTree::new(&lamps(count));
            let point = DVec3::new(1.0, -2.0, 3.0);
            let steps = 200_000;
            let mut seen = vec![(0_u32, 0.0); count];
            for step in 0..steps {
                let (lamp, chance) = tree.pick(point, (f64::from(step) + 0.5) / f64::from(steps)).unwrap();
                seen[lamp as usize].0 += 1;
                seen[lamp as usize].1 = chance;
            }
            let sum: f64 = seen.iter().map(|(_, chance)| chance).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{count}: {sum}");
            for (picks, chance) in seen {
                assert!(
                    chance > 0.0
                        && (f64::from(picks) / f64::from(steps) - chance).abs() < 2.0 / f64::from(steps)
                );
            }
        }
    }

    #[test]
    fn near_and_strong_lamps_are_picked_more_often() {
        let ball = |x: f64| Ball { center: DVec3::X * x, radius: 0.1 };
        let tree = LampTree::new(&[(ball(1.0), 1.0), (ball(-12.0), 1.0), (ball(-10.0), 9.0)]);
        let chance = |lamp: u32| {
            let steps = (0..1000).map(|k| f64::from(k) / 1000.0);
            steps.filter_map(|share| tree.pick(DVec3::ZERO, share)).filter(|pick| pick.0 == lamp).count()
        };
        assert!(chance(0) > chance(2) && chance(2) > chance(1) && chance(1) > 0);
    }

    #[test]
    fn no_lamps_give_no_pick_and_lamps_in_one_place_are_no_trouble() {
        assert!(LampTree::new(&[]).pick(DVec3::ZERO, 0.5).is_none());
        let one_place = vec![(Ball { center: DVec3::ZERO, radius: 0.0 }, 1.0); 1000];
        let (_, chance) = LampTree::new(&one_place).pick(DVec3::ZERO, 0.3).unwrap();
        assert!(chance.is_finite() && chance > 0.0);
    }
}
