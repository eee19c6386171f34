//! Cylinders, cones and capsules: rays at rims, seams and tips, along and beside their sides, from inside and from the surface.

use catoptra_core::geometry::{Capsule, Cone, Cylinder, Disk, Plane, Sphere};
use catoptra_core::glam::DVec3;
use catoptra_core::{InvalidPart, Ray, Shape};

use super::flat::made;
use super::random::rounded;
use super::{Group, Random, Trial};

pub(super) const CYLINDERS: Group = Group {
    name: "cylinder",
    doc: "rays at rims, along the side and tangent to it, exactly or to a few steps; open ones too",
    make: |random| {
        let round = Round::new(random, |_, lower| lower);
        let [from, to] = round.ends;
        let shape = Cylinder::new(from, to, round.radii[0]);
        let open = random.below(3) == 0;
        round.trial(random, shape.map(|shape| if open { shape.opened() } else { shape }))
    },
};

pub(super) const CONES: Group = Group {
    name: "cone",
    doc: "rays at tip and rims, along the side, parallel to it and tangent; cut off and open ones too",
    make: |random| {
        let round = Round::new(random, |random, lower| match random.below(3) {
            0 => lower * random.power(-3, 2),
            _ => 0.0,
        });
        let [from, to] = round.ends;
        let shape = Cone::new(from, to, round.radii[0], round.radii[1]);
        let open = random.below(3) == 0;
        round.trial(random, shape.map(|shape| if open { shape.opened() } else { shape }))
    },
};

pub(super) const CAPSULES: Group = Group {
    name: "capsule",
    doc: "rays at the seams between side and ends, along the side and tangent to it",
    make: |random| {
        let round = Round::new(random, |_, lower| lower);
        let [from, to] = round.ends;
        round.trial(random, Capsule::new(from, to, round.radii[0]))
    },
};

pub(super) const TOUCHING: Group = Group {
    name: "round, coincident",
    doc: "cylinder, cone, capsule, ball, disk and plane that share rims, sides and ends",
    make: |random| {
        let round = Round::new(random, |_, lower| lower);
        let ([from, to], radius) = (round.ends, round.radii[0]);
        let mut shapes: Vec<Shape> = Vec::new();
        for _ in 0..3 {
            shapes.extend(match random.below(7) {
                0 => made(Cylinder::new(from, to, radius)),
                1 => made(Cylinder::new(to, from, radius)),
                2 => made(Capsule::new(from, to, radius)),
                3 => made(Cone::new(from, to, radius, [0.0, radius][random.below(2)])),
                4 => made(Sphere::new(to, radius)),
                5 => made(Disk::new(to, to - from, radius)),
                _ => made(Plane::new(to, to - from)),
            });
        }
        let rays = (0..24).map(|_| round.ray(random)).collect();
        Trial { shapes, rays }
    },
};

/// What is round about an axis, and two vectors across it as long as the axis' unit: often whole numbers, so that points of
/// rims and sides are exact.
struct Round {
    ends: [DVec3; 2],
    radii: [f64; 2],
    /// Perpendicular, of unit length but for rounding, or of a common whole length.
    across: [DVec3; 2],
    unit: f64,
}

impl Round {
    fn new(random: &mut Random, upper: impl Fn(&mut Random, f64) -> f64) -> Self {
        let (axis, across, unit, from) = if random.below(2) == 0 {
            // A Pythagorean frame: three vectors of length 7.
            let (a, u, v) =
                (DVec3::new(2.0, 3.0, 6.0), DVec3::new(3.0, -6.0, 2.0), DVec3::new(6.0, 2.0, -3.0));
            (a, [u, v], 7.0, random.whole_point(50.0))
        } else {
            let a = random.direction();
            let u = a.any_orthogonal_vector().normalize();
            (a, [u, a.cross(u).normalize()], 1.0, random.point(10.0))
        };
        let lower = unit * random.power(-3, 3);
        let to = rounded(from + axis * random.power(-3, 4));
        let radii = [lower, upper(random, lower)];
        Self { ends: [from, to], radii, across, unit }
    }

    /// A ray that is hard to tell from its neighbours.
    fn ray(&self, random: &mut Random) -> Ray {
        let ([from, to], axis) = (self.ends, self.ends[1] - self.ends[0]);
        let out = random.on_circle(self.across);
        let rims = [0, 1].map(|i| self.ends[i] + out * (self.radii[i] / self.unit));
        let share = [0.0, 1.0, 0.5, random.between(-0.2, 1.2)][random.below(4)];
        let on_side = rims[0].lerp(rims[1], share);
        let (along, around) = (rims[1] - rims[0], axis.cross(out) / axis.length());
        let size = axis.length() + self.radii[0] + self.radii[1];
        match random.below(7) {
            // Along the side, or parallel to it.
            0 => {
                let steps = random.below(3);
                let start = on_side - along * random.power(-2, 6);
                let aside = around * [0.0, 0.0, random.power(-30, 0)][random.below(3)];
                Ray::new(random.beside(start + aside, steps), rounded(along * random.power(-3, 3)))
            }
            // Tangent.
            1 | 2 => {
                let way = along * random.between(-1.0, 1.0).round() + around * random.power(-2, 2);
                let (back, steps) = (random.power(-2, 8), [0, 0, 1, 3][random.below(4)]);
                let start = random.beside(on_side - way * back, steps);
                Ray::new(start, rounded(way * random.power(-3, 3)))
            }
            // From the axis, inside or beyond its ends.
            3 => {
                let start = from.lerp(to, random.between(-0.5, 1.5));
                random.aimed(start, on_side)
            }
            // From the surface.
            4 => {
                let start = random.beside(on_side, 1);
                Ray::new(start, random.direction())
            }
            // At ends of the axis, beyond which tips and poles lie.
            5 => {
                let end = self.ends[random.below(2)];
                let target = end + axis * [0.0, self.radii[0] / axis.length()][random.below(2)];
                let start = target + random.point(1.0) * size * random.power(-2, 8);
                random.aimed(start, target)
            }
            _ => {
                let start = on_side + random.point(1.0) * size * random.power(-4, 10);
                random.aimed(start, on_side)
            }
        }
    }

    fn trial(&self, random: &mut Random, shape: Result<impl Into<Shape>, InvalidPart>) -> Trial {
        let rays = (0..24).map(|_| self.ray(random)).collect();
        Trial { shapes: made(shape), rays }
    }
}
