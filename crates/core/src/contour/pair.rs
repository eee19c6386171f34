//! Where do the outlines of two round bodies cross, and which arcs of each lie within the other?
//!
//! Every answer is one for both: a crossing exists for both curves or for neither, and both share the place. So loops stay
//! closed however near the curves are to touching.

use glam::DVec3;

use super::conic::{Arc, Conic, Turn};
use super::roots::Wave;
use crate::numeric::CONIC_ROUNDING;

/// At most two arcs.
pub(super) type Arcs = [Option<Arc>; 2];

/// How two outlines lie to one another.
#[derive(Debug, Clone, Copy)]
pub(super) enum Pair {
    Apart,
    /// But for rounding.
    Same,
    FirstWithin,
    SecondWithin,
    /// The arcs of each within the other.
    Cross([Arcs; 2]),
}

impl Pair {
    fn swapped(self) -> Self {
        match self {
            Self::FirstWithin => Self::SecondWithin,
            Self::SecondWithin => Self::FirstWithin,
            Self::Cross([first, second]) => Self::Cross([second, first]),
            Self::Apart | Self::Same => self,
        }
    }

    /// How the outlines of two round bodies lie to one another.
    pub(super) fn of(first: &Conic, second: &Conic) -> Self {
        match (first.is_round, second.is_round) {
            (true, true) => of_spheres(first, second),
            (true, false) => of_rim(second, first).swapped(),
            (false, false) if second.sine() < first.sine() => of_rim(second, first).swapped(),
            (false, _) => of_rim(first, second),
        }
    }
}

/// The arcs between two, or what one leaves of the circle.
pub(super) fn rest_of(arcs: Arcs) -> Arcs {
    match arcs {
        [Some(a), Some(b)] => [Some(Arc { from: a.to, to: b.from }), Some(Arc { from: b.to, to: a.from })],
        [Some(a), None] | [None, Some(a)] => [Some(a.rest()), None],
        [None, None] => arcs,
    }
}

/// Two small circles a·x = c, b·x = e. Within the first, b is nearer than the plane d·x = e − c, d = b − a, through their
/// crossings; written with d² and 1 − c, which keep their digits for small circles side by side.
fn of_spheres(first: &Conic, second: &Conic) -> Pair {
    let between = second.axis - first.axis;
    let half = between.length_squared() / 2.0;
    let across2 = half * (2.0 - half);
    let [c1, c2] = [first, second].map(|conic| conic.axis.dot(conic.center));
    let height = |conic: &Conic, cos: f64| conic.radius * conic.radius / (1.0 + cos);
    let (h1, h2) = (height(first, c1), height(second, c2));
    let rise = h1 - h2;
    let (along1, along2) = (rise + c1 * half, c2 * half - rise);
    let root2 = first.radius * first.radius * across2 - along1 * along1;
    if root2 > 0.0 {
        let root = root2.sqrt();
        let arc = |conic: &Conic, towards: DVec3, along: f64| {
            let middle = Turn::of(conic.across[0].dot(towards), conic.across[1].dot(towards));
            let arc = middle.around(Turn::of(along, root));
            // Of a large circle a tiny one may cut no more than rounding holds.
            if arc.from != arc.to && (arc.from.cross(arc.to) > 0.0) == (along > 0.0) {
                Some(arc)
            } else {
                None
            }
        };
        if let (Some(a), Some(b)) = (arc(first, between, along1), arc(second, -between, along2)) {
            return Pair::Cross([[Some(a), None], [Some(b), None]]);
        }
    }
    if h1 + h2 - h1 * h2 - half <= 0.0 {
        Pair::Apart
    } else if rise > 0.0 {
        Pair::SecondWithin
    } else if rise < 0.0 {
        Pair::FirstWithin
    } else {
        Pair::Same
    }
}

/// The rim of a disk and any other outline, but none seen closer to edge-on: a place of that would hardly follow from the
/// direction in which it is seen.
fn of_rim(rim: &Conic, other: &Conic) -> Pair {
    let wave = other.wave(rim);
    let (places, count) = wave.sign_changes();
    if is_rounding(&wave, rim, other) {
        return Pair::Same;
    }
    let mut here = [Turn::START; 4];
    let mut there = [Turn::START; 4];
    let mut crossings = 0;
    for turn in &places[..count] {
        let x = rim.at(*turn);
        if other.axis.dot(x) > 0.0 {
            (here[crossings], there[crossings]) = (*turn, other.turn_of(x));
            crossings += 1;
        }
    }
    let crossings = crossings - crossings % 2;
    let (here, there) = (&mut here[..crossings], &mut there[..crossings]);
    for turns in [&mut *here, &mut *there] {
        turns.sort_unstable_by(|a, b| a.key().total_cmp(&b.key()));
    }
    let distinct = |turns: &[Turn]| turns.windows(2).all(|pair| pair[0].key() < pair[1].key());
    if crossings == 0 || !(distinct(here) && distinct(there)) {
        return if holds_most(other, rim) {
            Pair::FirstWithin
        } else if holds_most(rim, other) {
            Pair::SecondWithin
        } else {
            Pair::Apart
        };
    }
    Pair::Cross([arcs_within(here, rim, other), arcs_within(there, other, rim)])
}

/// Arcs of a curve within another body, given the crossings in order. The longest arc tells, and the others take turns.
fn arcs_within(turns: &[Turn], curve: &Conic, body: &Conic) -> Arcs {
    let count = turns.len();
    let arc = |i: usize| Arc { from: turns[i], to: turns[(i + 1) % count] };
    let keys = |i: usize| (arc(i).to.key() - arc(i).from.key()).rem_euclid(4.0);
    let longest = (0..count).max_by(|&i, &j| keys(i).total_cmp(&keys(j))).unwrap_or(0);
    let Arc { from, to } = arc(longest);
    let (cos, sin) = (from.cos + to.cos, from.sin + to.sin);
    let middle = if from.cross(to) < 0.0 { Turn::of(-cos, -sin) } else { Turn::of(cos, sin) };
    let first = if body.depth(curve.at(middle)) > 0.0 { longest % 2 } else { (longest + 1) % 2 };
    [Some(arc(first)), if count > 2 { Some(arc(first + 2)) } else { None }]
}

/// Whether a body holds a curve that does not cross its outline: the place of four that is farthest from it tells.
fn holds_most(body: &Conic, curve: &Conic) -> bool {
    let places = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
    let depths = places.map(|(cos, sin)| body.depth(curve.at(Turn { cos, sin })));
    depths.into_iter().fold(0.0, |most: f64, depth| if depth.abs() > most.abs() { depth } else { most }) > 0.0
}

/// Whether all that tells two outlines apart is rounding.
fn is_rounding(wave: &Wave, rim: &Conic, other: &Conic) -> bool {
    let reach = (rim.center.length() + rim.radius) * other.center.length();
    wave.size() <= CONIC_ROUNDING * other.radius * reach * reach && other.axis.dot(rim.center) > 0.0
}

impl Conic {
    /// Of the angle under which the plane of the circle is seen.
    fn sine(&self) -> f64 {
        self.axis.dot(self.center) / self.center.length()
    }

    /// Positive for directions within: r² (N·x)² − |N × (x × P)|², negative behind the eye.
    fn depth(&self, x: DVec3) -> f64 {
        let along = self.axis.dot(x);
        let across = self.axis.cross((x - self.center).cross(self.center)).length();
        if along > 0.0 {
            let reach = self.radius * along;
            (reach - across) * (reach + across)
        } else {
            f64::NEG_INFINITY
        }
    }

    /// That of the points of a curve, before and behind the eye alike.
    fn wave(&self, curve: &Self) -> Wave {
        let [q, r] = curve.across.map(|e| e * curve.radius);
        let mut wave = Wave::default();
        let along = [curve.center, q, r].map(|x| self.axis.dot(x) * self.radius);
        wave.add_square(1.0, along);
        let moment = |x: DVec3| self.axis.cross(x.cross(self.center));
        let [a, b, c] = [moment(curve.center - self.center), moment(q), moment(r)];
        for i in 0..3 {
            wave.add_square(-1.0, [a[i], b[i], c[i]]);
        }
        wave
    }
}
