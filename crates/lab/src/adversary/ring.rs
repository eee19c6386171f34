//! Tori: rays that touch them, at double and fourfold points, through the hole, along the tube and from the surface.

use catoptra_core::geometry::{Cylinder, Plane, Sphere, Torus};
use catoptra_core::glam::DVec3;
use catoptra_core::{InvalidPart, Ray, Shape};

use super::flat::made;
use super::random::rounded;
use super::{Group, Random, Trial};

pub(super) const TORI: Group = Group {
    name: "torus",
    doc: "rays tangent to it, inside and outside, along its highest circle, through the hole and from the surface",
    make: |random| {
        let ring = Ring::new(random);
        let rays = (0..24).map(|_| ring.ray(random)).collect();
        Trial { shapes: made(ring.torus()), rays }
    },
};

pub(super) const TOUCHING: Group = Group {
    name: "torus, coincident",
    doc: "tori that are the same or share circles, and planes, balls and cylinders that touch them",
    make: |random| {
        let ring = Ring::new(random);
        let Ring { center, axis, across: [u, _], radii: [major, minor] } = ring;
        let up = axis * (minor / axis.length());
        let mut shapes: Vec<Shape> = made(ring.torus());
        for _ in 0..2 {
            shapes.extend(match random.below(6) {
                0 => made(Plane::new(center + up, axis)),
                1 => made(Sphere::new(center, major + minor)),
                2 => made(Sphere::new(center + u * (major / u.length()), minor)),
                3 => made(Cylinder::new(center - up * 3.0, center + up * 3.0, major - minor)),
                4 => made(Torus::new(center, axis * 2.0, major, minor)),
                _ => made(Torus::new(center, -axis, major, minor / 2.0)),
            });
        }
        let first = random.below(shapes.len().max(1));
        shapes.rotate_left(first);
        let rays = (0..24).map(|_| ring.ray(random)).collect();
        Trial { shapes, rays }
    },
};

/// A torus and two vectors across its axis: often whole numbers, so that points of its circles are exact.
struct Ring {
    center: DVec3,
    axis: DVec3,
    across: [DVec3; 2],
    radii: [f64; 2],
}

impl Ring {
    fn new(random: &mut Random) -> Self {
        // A Pythagorean frame: three vectors of length 7.
        let frame = [DVec3::new(2.0, 3.0, 6.0), DVec3::new(3.0, -6.0, 2.0), DVec3::new(6.0, 2.0, -3.0)];
        let major = 7.0 * random.power(-3, 3);
        let minor = major * random.power(-4, -1) * [1.0, 1.0, 1.75][random.below(3)];
        let (center, axis, across) = if random.below(2) == 0 {
            (random.whole_point(50.0), frame[0], [frame[1], frame[2]])
        } else {
            let axis = random.direction();
            let u = axis.any_orthogonal_vector().normalize() * 7.0;
            (random.point(10.0), axis, [u, axis.cross(u).normalize() * 7.0])
        };
        Self { center, axis, across, radii: [major, minor] }
    }

    fn torus(&self) -> Result<Torus, InvalidPart> {
        Torus::new(self.center, self.axis, self.radii[0], self.radii[1])
    }

    fn ray(&self, random: &mut Random) -> Ray {
        let [major, minor] = self.radii;
        let out = random.on_circle(self.across);
        let (up, around) =
            (self.axis * (7.0 / self.axis.length()), self.axis.cross(out) / self.axis.length());
        // Where the tube's cross section is highest, lowest, innermost or outermost, or anywhere.
        let t = random.between(-3.0, 3.0);
        let leaning = (out * (1.0 - t * t) + up * (2.0 * t)) / (1.0 + t * t);
        let round = [up, -up, out, -out, leaning][random.below(5)];
        let on_surface = self.center + out * (major / 7.0) + round * (minor / 7.0);
        let across_round = round.cross(around) / 7.0;
        match random.below(6) {
            // Tangent: along the tube, across it, or between.
            0..3 => {
                let share = [0.0, 1.0, random.between(-1.0, 1.0)][random.below(3)];
                let way = around * (1.0 - share * share) + across_round * share;
                let (back, steps) = (random.power(-2, 6), [0, 0, 1, 3][random.below(4)]);
                let start = random.beside(on_surface - way * back, steps);
                Ray::new(start, rounded(way * random.power(-3, 3)))
            }
            // From the middle of the ring or of the tube.
            3 => {
                let start = [self.center, self.center + out * (major / 7.0)][random.below(2)];
                random.aimed(start, on_surface)
            }
            4 => {
                let start = random.beside(on_surface, 1);
                Ray::new(start, random.direction())
            }
            _ => {
                let start = on_surface + random.point(1.0) * major * random.power(-4, 10);
                random.aimed(start, on_surface)
            }
        }
    }
}
