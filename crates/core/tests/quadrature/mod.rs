//! Projected solid angles by adaptive quadrature over the lamp, visibility by rays: slow, and independent of contours.
//!
//! A lamp is swept by lines. On each line every plane and quadric of a blocker gives the places where visibility may change;
//! between two of them one exact ray tells. Across the lines the rule halves its steps until it is as exact as asked.

use catoptra_core::geometry::{
    Capsule, Cone, Cuboid, Cylinder, Disk, Platonic, Polyhedron, Rectangle, Sphere, Tetrahedron, Triangle,
};
use catoptra_core::glam::DVec3;
use catoptra_core::{Geometry, Ray, Shape, Span};

/// Nodes in 0..=1 and weights of the Gauss–Legendre rule with 12 points.
fn gauss() -> ([f64; 12], [f64; 12]) {
    let x = [
        0.125233408511469,
        0.367831498998180,
        0.587317954286617,
        0.769902674194305,
        0.904117256370475,
        0.981560634246719,
    ];
    let (mut nodes, mut weights) = ([0.0; 12], [0.0; 12]);
    for i in 0..6 {
        let mut at: f64 = x[i];
        let mut slope = 0.0;
        for _ in 0..4 {
            let (mut before, mut value) = (1.0, at);
            for k in 2..=12 {
                let k = f64::from(k);
                (before, value) = (value, ((2.0 * k - 1.0) * at * value - (k - 1.0) * before) / k);
            }
            slope = 12.0 * (at * value - before) / (at * at - 1.0);
            at -= value / slope;
        }
        let weight = 1.0 / ((1.0 - at * at) * slope * slope);
        (nodes[i], nodes[11 - i]) = ((1.0 - at) / 2.0, (1.0 + at) / 2.0);
        (weights[i], weights[11 - i]) = (weight, weight);
    }
    (nodes, weights)
}

/// A lamp that is swept: its place at (s, t) in 0..=1, and how the area grows.
pub(crate) enum Swept {
    /// a + s u + t (v + s w): a rectangle, or a triangle with w = −v.
    Flat {
        corner: DVec3,
        edges: [DVec3; 3],
        two_sided: bool,
    },
    Disk {
        center: DVec3,
        axes: [DVec3; 2],
        two_sided: bool,
    },
    Sphere {
        center: DVec3,
        radius: f64,
    },
}

impl Swept {
    pub(crate) fn of(shape: &Shape, two_sided: bool) -> Self {
        match shape {
            Shape::Rectangle(r) => {
                Self::Flat { corner: r.corner(), edges: [r.edges()[0], r.edges()[1], DVec3::ZERO], two_sided }
            }
            Shape::Triangle(t) => {
                let [a, b, c] = t.corners();
                Self::Flat { corner: a, edges: [b - a, c - a, a - c], two_sided }
            }
            Shape::Disk(d) => {
                let u = d.normal().any_orthonormal_vector() * d.radius();
                Self::Disk { center: d.center(), axes: [u, d.normal().cross(u)], two_sided }
            }
            Shape::Sphere(s) => Self::Sphere { center: s.center(), radius: s.radius() },
            _ => panic!("not a lamp of this test"),
        }
    }
}

pub(crate) struct Rule<'a> {
    pub(crate) point: DVec3,
    pub(crate) normal: DVec3,
    pub(crate) lamp: &'a Swept,
    pub(crate) shapes: &'a [Shape],
    gauss: ([f64; 12], [f64; 12]),
}

/// A line over the lamp, t in 0..=1, with the share of the area that a step of t and of s stands for.
struct Line {
    start: DVec3,
    along: DVec3,
    area: f64,
}

impl<'a> Rule<'a> {
    pub(crate) fn new(point: DVec3, normal: DVec3, lamp: &'a Swept, shapes: &'a [Shape]) -> Self {
        Self { point, normal, lamp, shapes, gauss: gauss() }
    }

    /// The projected solid angle, to about `off`, from so many stripes on: what is thinner may be missed.
    pub(crate) fn value(&self, off: f64, stripes: u32) -> f64 {
        let at = |k: u32| f64::from(k) / f64::from(stripes);
        let stripe = |k: u32| self.between(at(k), at(k + 1), self.rule(at(k), at(k + 1)), off / 8.0, 48);
        (0..stripes).map(stripe).sum()
    }

    fn rule(&self, a: f64, b: f64) -> f64 {
        let (x, w) = &self.gauss;
        (0..12).map(|i| w[i] * self.line(a + (b - a) * x[i])).sum::<f64>() * (b - a)
    }

    fn between(&self, a: f64, b: f64, whole: f64, off: f64, depth: u32) -> f64 {
        let middle = (a + b) / 2.0;
        let (left, right) = (self.rule(a, middle), self.rule(middle, b));
        if depth == 0 || (left + right - whole).abs() <= off.max(1e-16) {
            return left + right;
        }
        let off = off * 0.7;
        self.between(a, middle, left, off, depth - 1) + self.between(middle, b, right, off, depth - 1)
    }

    /// The lamp's plane normal times area, and the line at s.
    fn line_at(&self, s: f64) -> (Line, DVec3) {
        use std::f64::consts::PI;
        match self.lamp {
            Swept::Flat { corner, edges: [u, v, w], .. } => {
                let along = *v + *w * s;
                let normal = u.cross(*v);
                (Line { start: *corner + *u * s, along, area: u.cross(along).length() }, normal.normalize())
            }
            Swept::Disk { center, axes: [u, v], .. } => {
                let (sin, cos) = (PI * (s - 0.5)).sin_cos();
                let line = Line { start: *center + *u * sin - *v * cos, along: *v * (2.0 * cos), area: 0.0 };
                let area = PI * u.length() * cos * line.along.length();
                (Line { area, ..line }, u.cross(*v).normalize())
            }
            Swept::Sphere { center, radius } => {
                // The circle where lines of sight touch it.
                let away = *center - self.point;
                let ratio2 = radius * radius / away.length_squared();
                let middle = self.point + away * (1.0 - ratio2);
                let u = away.normalize().any_orthonormal_vector() * (radius * (1.0 - ratio2).sqrt());
                let v = away.normalize().cross(u);
                let (sin, cos) = (PI * (s - 0.5)).sin_cos();
                let line = Line { start: middle + u * sin - v * cos, along: v * (2.0 * cos), area: 0.0 };
                let area = PI * u.length() * cos * line.along.length();
                (Line { area, ..line }, -away.normalize())
            }
        }
    }

    fn line(&self, s: f64) -> f64 {
        let (Line { start, along, area }, lit) = self.line_at(s);
        let mut stops = vec![0.0, 1.0];
        let from = start - self.point;
        // A plane through the eye with normal g changes sign where g·(from + t along) does.
        let plane = |g: DVec3, stops: &mut Vec<f64>| stops.push(-g.dot(from) / g.dot(along));
        plane(self.normal, &mut stops);
        for shape in self.shapes {
            self.stops(shape, from, along, &mut stops);
        }
        stops.retain(|t| (0.0..=1.0).contains(t));
        stops.sort_by(f64::total_cmp);
        let mut sum = 0.0;
        for pair in stops.windows(2) {
            if pair[1] > pair[0] && self.is_seen(start + along * ((pair[0] + pair[1]) / 2.0), lit) {
                for k in 0..4 {
                    let step = (pair[1] - pair[0]) / 4.0;
                    let a = pair[0] + step * f64::from(k);
                    for (x, w) in self.gauss.0.iter().zip(&self.gauss.1) {
                        let d = from + along * (a + step * x);
                        let d2 = d.length_squared();
                        sum += w * step * self.normal.dot(d).max(0.0) * lit.dot(d).abs() / (d2 * d2);
                    }
                }
            }
        }
        sum * area
    }

    /// Whether the way to a place of the lamp is free, and its lit side seen.
    fn is_seen(&self, place: DVec3, lit: DVec3) -> bool {
        let direction = place - self.point;
        let ray = Ray::new(self.point, direction);
        let (one_sided, span) = match self.lamp {
            Swept::Sphere { center, radius } => {
                let ball = Sphere::new(*center, *radius).unwrap();
                // Rounding may miss it at its outline.
                let end = ball.cross(&ray, Span::AHEAD, None).map_or(1.0, |hit| hit.t);
                (false, Span::until(end))
            }
            Swept::Flat { two_sided, .. } | Swept::Disk { two_sided, .. } => (!two_sided, Span::TO_LIGHT),
        };
        !(one_sided && lit.dot(direction) >= 0.0)
            && self.shapes.iter().all(|shape| shape.cross(&ray, span, None).is_none())
    }

    /// Where a shape may begin or end to hide the line.
    fn stops(&self, shape: &Shape, from: DVec3, along: DVec3, stops: &mut Vec<f64>) {
        let p = self.point;
        let mut polygon = |corners: &[DVec3]| {
            for (i, a) in corners.iter().enumerate() {
                let g = (*a - p).cross(corners[(i + 1) % corners.len()] - p);
                stops.push(-g.dot(from) / g.dot(along));
            }
            let n = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            stops.push(n.dot(corners[0] - p - from) / n.dot(along));
        };
        match shape {
            Shape::Plane(plane) => {
                stops.push(plane.normal().dot(plane.point() - p - from) / plane.normal().dot(along));
            }
            Shape::Triangle(t) => polygon(&t.corners()),
            Shape::Rectangle(r) => polygon(&rectangle(r)),
            Shape::Cuboid(solid) => box_faces(solid).iter().for_each(|face| polygon(face)),
            Shape::Tetrahedron(solid) => (0..4).for_each(|i| polygon(&solid.face(i))),
            Shape::Sphere(ball) => {
                // |x × c|² = r² x².
                let c = ball.center() - p;
                let (a, b, r2) = (from.cross(c), along.cross(c), ball.radius() * ball.radius());
                quadratic(
                    b.length_squared() - r2 * along.length_squared(),
                    2.0 * (a.dot(b) - r2 * from.dot(along)),
                    a.length_squared() - r2 * from.length_squared(),
                    stops,
                );
            }
            Shape::Disk(disk) => {
                let c = disk.center() - p;
                let n = disk.normal();
                let flat = |x: DVec3| (x * n.dot(c) - c * n.dot(x), disk.radius() * n.dot(x));
                let ((a, k), (b, l)) = (flat(from), flat(along));
                quadratic(
                    b.length_squared() - l * l,
                    2.0 * (a.dot(b) - k * l),
                    a.length_squared() - k * k,
                    stops,
                );
                stops.push(n.dot(c - from) / n.dot(along));
            }
            Shape::Cylinder(_) | Shape::Cone(_) | Shape::Capsule(_) => {
                self.swept_stops(shape, from, along, stops);
            }
            solid => {
                let facets = solid.faceted().expect("a blocker of this test");
                for facet in 0..facets.count() {
                    let outline: Vec<DVec3> =
                        facets.outline(facet).iter().map(|&i| facets.corners()[i as usize]).collect();
                    polygon(&outline);
                }
            }
        }
    }
}

impl Rule<'_> {
    /// As [`stops`](Self::stops), for what is round about an axis.
    fn swept_stops(&self, shape: &Shape, from: DVec3, along: DVec3, stops: &mut Vec<f64>) {
        match shape {
            Shape::Cylinder(c) => {
                self.tangents(c.ends(), [c.radius(); 2], from, along, stops);
                for (end, normal) in c.ends().into_iter().zip([-c.axis(), c.axis()]) {
                    self.stops(&Disk::new(end, normal, c.radius()).unwrap().into(), from, along, stops);
                }
            }
            Shape::Cone(c) => {
                self.tangents(c.ends(), c.radii(), from, along, stops);
                for (end, radius) in c.ends().into_iter().zip(c.radii()).filter(|(_, radius)| *radius > 0.0) {
                    self.stops(&Disk::new(end, c.axis(), radius).unwrap().into(), from, along, stops);
                }
            }
            Shape::Capsule(c) => {
                self.tangents(c.ends(), [c.radius(); 2], from, along, stops);
                for end in c.ends() {
                    self.stops(&Sphere::new(end, c.radius()).unwrap().into(), from, along, stops);
                }
            }
            _ => {}
        }
    }

    /// Where lines of sight to a straight line touch the side of a cone, and where they pass the heights of its ends where they
    /// meet that: there its seams are.
    fn tangents(
        &self,
        [lower, upper]: [DVec3; 2],
        radii: [f64; 2],
        from: DVec3,
        along: DVec3,
        stops: &mut Vec<f64>,
    ) {
        // A line of sight touches where its own equation A t² + 2 B t + C has one root: B² = A C, which is of degree two in
        // the direction.
        let axis = (upper - lower).normalize();
        let slope = (radii[1] - radii[0]) / upper.distance(lower);
        let eye = self.point - lower;
        let (m, g) = (eye - axis * eye.dot(axis), radii[0] + slope * eye.dot(axis));
        let part = |d: DVec3| (d - axis * d.dot(axis), slope * d.dot(axis));
        let ((n, e), (k, f)) = (part(from), part(along));
        let c = m.length_squared() - g * g;
        let (b0, b1) = (m.dot(n) - g * e, m.dot(k) - g * f);
        let (a0, a1, a2) = (n.length_squared() - e * e, n.dot(k) - e * f, k.length_squared() - f * f);
        quadratic(b1 * b1 - a2 * c, 2.0 * (b0 * b1 - a1 * c), b0 * b0 - a0 * c, stops);
    }
}

fn quadratic(a: f64, b: f64, c: f64, roots: &mut Vec<f64>) {
    let root2 = b * b - 4.0 * a * c;
    if root2 >= 0.0 {
        let q = -(b + root2.sqrt().copysign(b)) / 2.0;
        roots.extend([q / a, c / q]);
    }
}

pub(crate) fn rectangle(r: &Rectangle) -> [DVec3; 4] {
    let (c, [u, v]) = (r.corner(), r.edges());
    [c, c + u, c + u + v, c + v]
}

fn box_faces(solid: &Cuboid) -> Vec<[DVec3; 4]> {
    let bounds = solid.object_bounds();
    let at = |x: [bool; 3]| {
        let mut p = bounds.min;
        for k in 0..3 {
            if x[k] {
                p[k] = bounds.max[k];
            }
        }
        solid.placement().point(p)
    };
    let mut faces = Vec::new();
    for axis in 0..3 {
        for side in [false, true] {
            let corner = |a: bool, b: bool| {
                let mut x = [side; 3];
                x[(axis + 1) % 3] = a;
                x[(axis + 2) % 3] = b;
                at(x)
            };
            faces.push([corner(false, false), corner(true, false), corner(true, true), corner(false, true)]);
        }
    }
    faces
}

/// Random numbers of a fixed sequence.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// In 0..1.
    pub(crate) fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        (mixed >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }

    pub(crate) fn vector(&mut self) -> DVec3 {
        DVec3::new(self.within(-1.0, 1.0), self.within(-1.0, 1.0), self.within(-1.0, 1.0))
    }

    pub(crate) fn unit(&mut self) -> DVec3 {
        loop {
            let v = self.vector();
            if v.length() > 0.1 && v.length() < 1.0 {
                return v.normalize();
            }
        }
    }

    pub(crate) fn below(&mut self, count: u32) -> u32 {
        ((self.share() * f64::from(count)) as u32).min(count - 1)
    }

    fn right_angle(&mut self) -> [DVec3; 2] {
        let u = self.unit();
        let v = u.any_orthonormal_vector();
        let turned = v * self.within(-1.0, 1.0) + u.cross(v) * self.within(-1.0, 1.0);
        [u, turned.try_normalize().unwrap_or(v)]
    }

    /// A lamp over the origin.
    pub(crate) fn lamp(&mut self) -> Shape {
        let size = 10.0_f64.powf(self.within(-1.0, 0.6));
        let middle = DVec3::Y * self.within(2.0, 6.0) + self.vector();
        match self.below(4) {
            0 => {
                let [u, v] = self.right_angle();
                let (u, v) = (u * size, v * size * self.within(0.3, 2.0));
                Rectangle::new(middle - (u + v) / 2.0, u, v).unwrap().into()
            }
            1 => {
                let [a, b, c] = [self.vector(), self.vector(), self.vector()].map(|p| middle + p * size);
                Triangle::new(a, b, c).unwrap().into()
            }
            2 => Disk::new(middle, self.unit(), size * 0.6).unwrap().into(),
            _ => Sphere::new(middle, (size * 0.5).min(1.5)).unwrap().into(),
        }
    }

    /// A place of a lamp, a corner or at its outline half of the time.
    fn place(&mut self, lamp: &Shape) -> DVec3 {
        let edge = self.below(2) == 0;
        match lamp {
            Shape::Rectangle(r) => {
                let c = rectangle(r);
                let (s, t) = (self.share(), self.share());
                match (edge, self.below(2)) {
                    (true, 0) => c[self.below(4) as usize],
                    (true, _) => c[0].lerp(c[1], s),
                    _ => c[0] + r.edges()[0] * s + r.edges()[1] * t,
                }
            }
            Shape::Triangle(t) => {
                let c = t.corners();
                if edge { c[self.below(3) as usize] } else { (c[0] + c[1] + c[2]) / 3.0 }
            }
            Shape::Disk(d) => {
                let u = d.normal().any_orthonormal_vector();
                let angle = self.within(0.0, 7.0);
                let out = u * angle.cos() + d.normal().cross(u) * angle.sin();
                d.center() + out * d.radius() * if edge { 1.0 } else { self.share() }
            }
            Shape::Sphere(s) => s.center() + self.unit() * s.radius() * if edge { 1.0 } else { self.share() },
            _ => DVec3::ZERO,
        }
    }

    /// Something between a point and a lamp; half of the time its outline touches a line to the lamp's corners or outline.
    pub(crate) fn blocker(&mut self, eye: DVec3, lamp: &Shape) -> Shape {
        let at = eye.lerp(self.place(lamp), self.within(0.15, 0.8));
        let size = 10.0_f64.powf(self.within(-1.2, 0.2));
        let touches = self.below(2) == 0;
        match self.below(6) {
            0 | 1 => {
                let radius = size * 0.5;
                let aside = (at - eye).normalize().cross(self.unit()).normalize_or(DVec3::X) * radius;
                let center = if touches { at + aside } else { at + self.vector() * radius };
                Sphere::new(center, radius).unwrap().into()
            }
            2 => {
                let normal = self.unit();
                let aside = normal.any_orthonormal_vector() * size * 0.6;
                Disk::new(
                    if touches { at + aside } else { at + self.vector() * size * 0.3 },
                    normal,
                    size * 0.6,
                )
                .unwrap()
                .into()
            }
            3 => {
                let [u, v] = self.right_angle();
                let (u, v) = (u * size, v * size);
                let corner = match (touches, self.below(2)) {
                    (true, 0) => at,
                    (true, _) => at - u * self.share(),
                    _ => at - u * self.share() - v * self.share(),
                };
                Rectangle::new(corner, u, v).unwrap().into()
            }
            4 => {
                let [u, v] = self.right_angle();
                let [b, c] = [u * size, (v + u * self.within(-1.0, 1.0)) * size];
                let a = if touches { at } else { at - (b + c) / 3.0 };
                let fourth = self.unit() * size;
                if self.below(2) == 0 && b.cross(c).normalize().dot(fourth).abs() > 0.05 * size {
                    Tetrahedron::new(a, a + b, a + c, a + fourth).unwrap().into()
                } else {
                    Triangle::new(a, a + b, a + c).unwrap().into()
                }
            }
            _ => {
                let half = DVec3::new(self.within(0.1, 1.0), self.within(0.1, 1.0), self.within(0.1, 1.0))
                    * size
                    * 0.5;
                let solid: Shape = Cuboid::new(-half, half).unwrap().into();
                let turn = catoptra_core::Placement::IDENTITY
                    .turned(DVec3::ZERO, self.unit(), self.within(0.0, 3.0))
                    .unwrap();
                let to = if touches { at - turn.point(half) } else { at };
                solid.placed(&turn.moved(to).unwrap())
            }
        }
    }

    /// A convex solid, round about an axis or with many faces, between a point and a lamp.
    pub(crate) fn solid(&mut self, eye: DVec3, lamp: &Shape) -> Shape {
        let at = eye.lerp(self.place(lamp), self.within(0.2, 0.75));
        let size = 10.0_f64.powf(self.within(-1.2, -0.1));
        let center = at + self.vector() * size * 0.5;
        let along = self.unit() * size * self.within(0.2, 2.0);
        let [from, to] = [center - along, center + along];
        let radius = size * self.within(0.1, 1.0);
        match self.below(6) {
            0 => Cylinder::new(from, to, radius).unwrap().into(),
            1 => Capsule::new(from, to, radius).unwrap().into(),
            2 => Cone::new(from, to, radius, 0.0).unwrap().into(),
            3 => Cone::new(from, to, radius, radius * self.within(0.1, 2.0)).unwrap().into(),
            4 => {
                let points: Vec<DVec3> = (0..10).map(|_| center + self.vector() * size).collect();
                Polyhedron::hull_of(points).unwrap().into()
            }
            _ => {
                let solid = ["octahedron", "dodecahedron", "icosahedron"][self.below(3) as usize];
                Platonic::new(solid, center, size).unwrap().into()
            }
        }
    }
}
