//! How much light does a flat lamp give past balls, disks and flat pieces? By quadrature over the lamp, line by line.
//!
//! On a line over the lamp each blocker and the horizon say where what is seen may change; between two of those places a look
//! at the middle tells, and a Gauss–Legendre rule adds up what is seen. Across the lines the rule halves its steps until both
//! halves say what the whole said. No contour is followed, and nothing is shared with the tracer's closed form.

use std::f64::consts::PI;

use catoptra_core::glam::DVec3;

/// A lamp of radiance 1.
#[derive(Debug, Clone, Copy)]
pub(super) enum Flat {
    /// A corner and two edges; lit along u × v.
    Parallelogram(DVec3, [DVec3; 2]),
    /// Middle, unit normal, radius; lit along the normal.
    Disk(DVec3, DVec3, f64),
}

/// What stands between, wholly in front of the lamp.
#[derive(Debug, Clone)]
pub(super) enum Between {
    Ball(DVec3, f64),
    Disk(DVec3, DVec3, f64),
    /// Convex.
    Polygon(Vec<DVec3>),
}

/// The lamp that looks like a sphere from a point: the disk within the circle where lines of sight touch it.
pub(super) fn as_disk(point: DVec3, center: DVec3, radius: f64) -> Flat {
    let (away, distance) = (center - point, center.distance(point));
    let sine = radius / distance;
    let cosine2 = (1.0 - sine) * (1.0 + sine);
    Flat::Disk(point + away * cosine2, -away / distance, radius * cosine2.sqrt())
}

/// The irradiance at a point with a unit normal.
pub(super) fn irradiance(point: DVec3, normal: DVec3, lamp: &Flat, between: &[Between]) -> f64 {
    let rule = Rule::new();
    let sweep = Sweep { point, normal, lamp, between, rule: &rule };
    let at = |k: u32| f64::from(k) / f64::from(STRIPES);
    (0..STRIPES).map(|k| rule.halved([at(k), at(k + 1)], 1e-13, &|s| sweep.of_line(&sweep.line(s)))).sum()
}

/// How many parts a lamp is swept in at least.
const STRIPES: u32 = 64;

/// How often a part is halved at most.
const DEEPEST: u32 = 40;

/// Nodes in 0..=1 and weights of the Gauss–Legendre rule with 16 points.
pub(super) struct Rule([(f64, f64); 16]);

impl Rule {
    /// Newton's steps from Tricomi's first guess (Abramowitz and Stegun 22.16.6).
    pub(super) fn new() -> Self {
        const N: usize = 16;
        let node = |i: usize| {
            let n = N as f64;
            let mut x = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..8 {
                let (mut before, mut value) = (1.0, x);
                for k in 2..=N {
                    let k = k as f64;
                    (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
                }
                slope = n * (x * value - before) / (x * x - 1.0);
                x -= value / slope;
            }
            ((1.0 - x) / 2.0, 1.0 / ((1.0 - x * x) * slope * slope))
        };
        Self(std::array::from_fn(node))
    }

    /// Calls `each` with every node and its weight.
    pub(super) fn for_each(&self, mut each: impl FnMut(f64, f64)) {
        self.0.iter().for_each(|(node, weight)| each(*node, *weight));
    }

    /// The integral of a function, by halves until both say together what the whole said, to about `off`.
    fn halved(&self, ends: [f64; 2], off: f64, f: &impl Fn(f64) -> f64) -> f64 {
        self.by_halves(ends, self.integral(ends, f), (off, DEEPEST), f)
    }

    fn by_halves(
        &self,
        [a, b]: [f64; 2],
        whole: f64,
        (off, depth): (f64, u32),
        f: &impl Fn(f64) -> f64,
    ) -> f64 {
        let middle = (a + b) / 2.0;
        let halves = [[a, middle], [middle, b]];
        let [left, right] = halves.map(|ends| self.integral(ends, f));
        if depth == 0 || (left + right - whole).abs() <= off {
            return left + right;
        }
        // Errors of the rule lie in few parts.
        let next = (off * std::f64::consts::FRAC_1_SQRT_2, depth - 1);
        self.by_halves(halves[0], left, next, f) + self.by_halves(halves[1], right, next, f)
    }

    fn integral(&self, [a, b]: [f64; 2], f: &impl Fn(f64) -> f64) -> f64 {
        self.0.iter().map(|(x, w)| w * f(a + (b - a) * x)).sum::<f64>() * (b - a)
    }
}

struct Sweep<'a> {
    point: DVec3,
    normal: DVec3,
    lamp: &'a Flat,
    between: &'a [Between],
    rule: &'a Rule,
}

/// A line over the lamp, from t = 0 to 1, as seen from the point; and the area that a step of t and of s stands for.
struct Line {
    from: DVec3,
    along: DVec3,
    area: f64,
}

impl Line {
    fn at(&self, t: f64) -> DVec3 {
        self.from + self.along * t
    }

    /// Where a quadratic form of the way to the line's points is zero, given by its values for two vectors.
    fn zeros(&self, form: impl Fn(DVec3, DVec3) -> f64) -> [Option<f64>; 2] {
        let (c, b, a) =
            (form(self.from, self.from), form(self.from, self.along), form(self.along, self.along));
        let root = (b * b - a * c).sqrt();
        let far = -b - root.copysign(b);
        [far / a, c / far].map(|t| Some(t).filter(|t| t.is_finite()))
    }
}

impl Sweep<'_> {
    fn line(&self, s: f64) -> Line {
        match *self.lamp {
            Flat::Parallelogram(corner, [u, v]) => {
                Line { from: corner + u * s - self.point, along: v, area: u.cross(v).length() }
            }
            Flat::Disk(center, normal, radius) => {
                // By the angle of its end, so that chords shrink smoothly.
                let (sine, cosine) = (PI * (s - 0.5)).sin_cos();
                let u = normal.any_orthonormal_vector() * radius;
                let v = normal.cross(u);
                let along = v * (2.0 * cosine);
                let area = PI * cosine * radius * along.length();
                Line { from: center + u * sine - v * cosine - self.point, along, area }
            }
        }
    }

    fn lamp_normal(&self) -> DVec3 {
        match *self.lamp {
            Flat::Parallelogram(_, [u, v]) => u.cross(v).normalize(),
            Flat::Disk(_, normal, _) => normal,
        }
    }

    fn of_line(&self, line: &Line) -> f64 {
        let facing = self.lamp_normal();
        if !(facing.dot(line.from) < 0.0) {
            return 0.0;
        }
        let mut places = vec![0.0, 1.0, -self.normal.dot(line.from) / self.normal.dot(line.along)];
        for blocker in self.between {
            self.push_changes(line, blocker, &mut places);
        }
        places.retain(|t| (0.0..=1.0).contains(t));
        places.sort_by(f64::total_cmp);
        let light = |way: DVec3| {
            let distance2 = way.length_squared();
            self.normal.dot(way) * -facing.dot(way) / (distance2 * distance2) * line.area
        };
        let pieces = places
            .windows(2)
            .filter(|ends| ends[0] < ends[1] && self.sees(line.at((ends[0] + ends[1]) / 2.0)));
        pieces.map(|ends| self.rule.halved([ends[0], ends[1]], 1e-14, &|t| light(line.at(t)))).sum()
    }

    /// Adds where a blocker may begin or end to hide the line.
    fn push_changes(&self, line: &Line, blocker: &Between, places: &mut Vec<f64>) {
        match blocker {
            Between::Ball(center, radius) => {
                let m = *center - self.point;
                let form = |a: DVec3, b: DVec3| radius * radius * a.dot(b) - m.cross(a).dot(m.cross(b));
                places.extend(line.zeros(form).into_iter().flatten());
            }
            Between::Disk(center, normal, radius) => {
                let m = *center - self.point;
                let flat = |w: DVec3| w * normal.dot(m) - m * normal.dot(w);
                let form = |a: DVec3, b: DVec3| {
                    radius * radius * normal.dot(a) * normal.dot(b) - flat(a).dot(flat(b))
                };
                places.extend(line.zeros(form).into_iter().flatten());
            }
            Between::Polygon(corners) => {
                let edges = self.edges(corners).map(|plane| -plane.dot(line.from) / plane.dot(line.along));
                places.extend(edges.filter(|t| t.is_finite()));
            }
        }
    }

    /// Normals of the planes through the point and the edges of a polygon.
    fn edges<'c>(&self, corners: &'c [DVec3]) -> impl Iterator<Item = DVec3> + use<'c> {
        let point = self.point;
        (0..corners.len()).map(move |i| (corners[i] - point).cross(corners[(i + 1) % corners.len()] - point))
    }

    /// Whether the way to a point of the lamp is above the horizon and free.
    fn sees(&self, way: DVec3) -> bool {
        self.normal.dot(way) > 0.0 && !self.between.iter().any(|blocker| self.is_behind(way, blocker))
    }

    fn is_behind(&self, way: DVec3, blocker: &Between) -> bool {
        match blocker {
            Between::Ball(center, radius) => {
                let m = *center - self.point;
                m.dot(way) > 0.0 && m.cross(way).length_squared() < radius * radius * way.length_squared()
            }
            Between::Disk(center, normal, radius) => {
                let m = *center - self.point;
                let share = normal.dot(m) / normal.dot(way);
                share > 0.0 && (way * share).distance(m) < *radius
            }
            Between::Polygon(corners) => {
                let middle = corners.iter().sum::<DVec3>() / corners.len() as f64 - self.point;
                self.edges(corners).all(|plane| plane.dot(way) * plane.dot(middle) > 0.0)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn disks_on_one_axis_are_their_formula() {
        let lamp = Flat::Disk(DVec3::Y * 3.0, DVec3::NEG_Y, 4.0);
        let open = irradiance(DVec3::ZERO, DVec3::Y, &lamp, &[]);
        assert!((open - PI * 16.0 / 25.0).abs() < 1e-12, "{open}");
        for blocker in [Between::Disk(DVec3::Y, DVec3::Y, 0.75), Between::Ball(DVec3::Y, 0.6)] {
            let seen = irradiance(DVec3::ZERO, DVec3::Y, &lamp, &[blocker]);
            assert!((seen - PI * (16.0 / 25.0 - 9.0 / 25.0)).abs() < 1e-11, "{seen}");
        }
    }

    #[test]
    fn a_sphere_gives_what_its_formula_says() {
        let point = DVec3::new(1.0, 0.0, 0.0);
        let found = irradiance(point, DVec3::Y, &as_disk(point, DVec3::Y * 2.0, 0.5), &[]);
        assert!((found - PI * 0.25 / 5.0 * 2.0 / 5.0_f64.sqrt()).abs() < 1e-13, "{found}");
    }
}
