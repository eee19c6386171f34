//! Where a line meets what is round about an axis: by the parts of its points that lie across the axis.

use std::cmp::Ordering;

use catoptra_core::Ray;
use catoptra_core::glam::DVec3;
use num_bigint::{BigInt, Sign};

use super::Place;
use super::integer::{Vector, dot, doublings, integer, minus, vector};
use super::isolated::{Isolated, product};
use super::shape::{Line, of_sphere};

/// A line and the side of a cone with a radius at each end, of a cylinder if they are the same. Heights run from 0 to a², the
/// square of the axis.
pub(super) struct Side {
    line: Line,
    axis: Vector,
    axis2: BigInt,
    radii: [BigInt; 2],
    /// The ray's origin as seen from the lower end.
    from: Vector,
    /// The height of the origin, and how much the direction adds.
    heights: [BigInt; 2],
}

impl Side {
    pub(super) fn new([lower, upper]: [DVec3; 2], radii: [f64; 2], ray: &Ray) -> Self {
        let line = Line::new(ray, lower.to_array().into_iter().chain(upper.to_array()).chain(radii));
        let [lower, upper] = [lower, upper].map(|p| vector(p, line.scale));
        let (axis, from) = (minus(&upper, &lower), minus(&line.origin, &lower));
        let heights = [dot(&from, &axis), dot(&line.direction, &axis)];
        let radii = radii.map(|radius| integer(radius, line.scale));
        Self { axis2: dot(&axis, &axis), line, axis, radii, from, heights }
    }

    /// a² times the part of a vector of that height that lies across the axis.
    fn across(&self, v: &Vector, height: &BigInt) -> Vector {
        std::array::from_fn(|i| &v[i] * &self.axis2 - &self.axis[i] * height)
    }

    /// Where the side without an end is met: where what lies across is as long as a² times the radius at that height.
    fn all(&self) -> Vec<Place> {
        let [height, climb] = &self.heights;
        let (o, d) = (self.across(&self.from, height), self.across(&self.line.direction, climb));
        let growth = &self.radii[1] - &self.radii[0];
        let reach = &self.radii[0] * &self.axis2 + &growth * height;
        let widens = growth * climb;
        let a = dot(&d, &d) - &widens * &widens;
        let b = dot(&o, &d) - &reach * &widens;
        let c = dot(&o, &o) - &reach * &reach;
        if a.sign() == Sign::NoSign {
            let once = b.sign() != Sign::NoSign;
            return once.then(|| self.line.ratio(-c, b * 2)).into_iter().collect();
        }
        let discriminant = &b * &b - &a * c;
        if discriminant.sign() == Sign::Minus {
            return Vec::new();
        }
        let place =
            |minus| Place::new([-b.clone(), discriminant.clone(), a.clone()], minus, self.line.doubled);
        vec![place(true), place(false)]
    }

    /// Where the plane at the height of an end is met: below, at or above a place as the line runs; by height alone where it
    /// never is.
    fn height_at(&self, place: &Place, upper: bool) -> Ordering {
        let [height, climb] = &self.heights;
        let end = if upper { self.axis2.clone() } else { BigInt::ZERO };
        match climb.sign() {
            Sign::NoSign => height.cmp(&end),
            Sign::Plus => place.compare(&self.line.ratio(end - height, climb.clone())),
            Sign::Minus => self.line.ratio(end - height, climb.clone()).compare(place),
        }
    }

    /// Where the side is met between its ends.
    pub(super) fn places(&self) -> Vec<(Place, u32)> {
        let between =
            |place: &Place| self.height_at(place, false).is_ge() && self.height_at(place, true).is_le();
        self.all().into_iter().filter(between).map(|place| (place, 0)).collect()
    }

    /// Where the disks at the ends are met.
    pub(super) fn caps(&self) -> Vec<(Place, u32)> {
        let [height, climb] = &self.heights;
        let cap = |upper: bool| {
            let radius = &self.radii[usize::from(upper)];
            if climb.sign() == Sign::NoSign || radius.sign() == Sign::NoSign {
                return None;
            }
            let away = if upper { &self.axis2 - height } else { -height };
            let middle: Vector = std::array::from_fn(|i| {
                let end = if upper { self.axis[i].clone() } else { BigInt::ZERO };
                (&self.from[i] - end) * climb + &self.line.direction[i] * &away
            });
            let reach = radius * climb;
            let within = dot(&middle, &middle) <= &reach * &reach;
            within.then(|| (self.line.ratio(away, climb.clone()), 1 + u32::from(upper)))
        };
        [false, true].into_iter().filter_map(cap).collect()
    }
}

/// The torus' equation as it stands: (x² + R² − r²)² = 4 R² (x² − h²), where h is how high x lies along the unit axis, times a².
pub(super) fn of_torus(center: DVec3, axis: DVec3, radii: [f64; 2], ray: &Ray) -> Vec<(Place, u32)> {
    let line = Line::new(ray, center.to_array().into_iter().chain(radii));
    let fine = axis.to_array().into_iter().map(doublings).max().unwrap_or(0);
    let (o, d) = (minus(&line.origin, &vector(center, line.scale)), &line.direction);
    let axis = vector(axis, fine);
    let [major, minor] = radii.map(|radius| integer(radius, line.scale));
    let (axis2, ring) = (dot(&axis, &axis), BigInt::from(4) * &major * &major);
    let square = [dot(&o, &o), dot(&o, d) * 2, dot(d, d)];
    let height = [dot(&o, &axis), dot(d, &axis)];
    let mut sum = square.clone();
    sum[0] += &major * &major - &minor * &minor;
    let (sum2, height2) = (product(&sum, &sum), product(&height, &height));
    let equation = (0..5_usize).map(|i| {
        let flat = square.get(i).map_or(BigInt::ZERO, |s| s * &axis2 - &height2[i]);
        &sum2[i] * &axis2 - &ring * flat
    });
    // In the given ray's parameter, which is 2^doubled times the scaled one's.
    let unscaled = equation.zip(0..).map(|(c, i)| {
        if line.doubled >= 0 { c << (line.doubled * (4 - i)) } else { c << (-line.doubled * i) }
    });
    Isolated::all_of(unscaled.collect()).into_iter().map(|root| (root.into(), 0)).collect()
}

/// A side, and of the balls at its ends what lies beyond it.
pub(super) fn of_capsule(ends: [DVec3; 2], radius: f64, ray: &Ray) -> Vec<(Place, u32)> {
    let side = Side::new(ends, [radius; 2], ray);
    let mut places = side.places();
    for (end, upper) in ends.into_iter().zip([false, true]) {
        let beyond = |place: &Place| {
            let height = side.height_at(place, upper);
            if upper { height.is_ge() } else { height.is_le() }
        };
        let ball = of_sphere(end, radius, ray).into_iter().map(|(place, _)| place).filter(beyond);
        places.extend(ball.map(|place| (place, 1 + u32::from(upper))));
    }
    places
}
