//! Spheres, and rays along their silhouettes.

use catoptra_core::Ray;
use catoptra_core::geometry::Sphere;
use catoptra_core::glam::DVec3;

use super::flat::made;
use super::random::rounded;
use super::{Group, Random, Trial};

pub(super) const FAR: Group = Group {
    name: "sphere, far away",
    doc: "radius 2^-20 to 1 of the distance",
    make: |random| {
        let (center, radius) = (random.point(100.0), random.power(-14, 6));
        let from = |random: &mut Random| center + random.point(64.0);
        trial(random, center, radius, from)
    },
};

pub(super) const HUGE: Group = Group {
    name: "sphere, huge",
    doc: "radius up to 2^26, origins near the surface",
    make: |random| {
        let (center, radius) = (random.point(1e4), random.power(10, 26));
        let from = |random: &mut Random| {
            center + random.point(1.0).normalize_or(DVec3::X) * radius + random.point(10.0)
        };
        trial(random, center, radius, from)
    },
};

pub(super) const TANGENT: Group = Group {
    name: "sphere, tangent",
    doc: "rays that touch it, to within a few steps",
    make: |random| {
        // A Pythagorean quadruple makes the tangent exact.
        let (n, u) = (DVec3::new(2.0, 3.0, 6.0), DVec3::new(3.0, -6.0, 2.0));
        let scale = random.power(-8, 8);
        let center = random.whole_point(100.0);
        let touch = center + n * scale;
        let rays = (0..24).map(|_| {
            let from = touch - u * random.power(-2, 12) * scale;
            let steps = [0, 0, 1, 4][random.below(4)];
            Ray::new(rounded(random.beside(from, steps)), u * random.power(-3, 3))
        });
        let rays = rays.collect();
        Trial { shapes: made(Sphere::new(center, 7.0 * scale)), rays }
    },
};

pub(super) const INSIDE: Group = Group {
    name: "sphere, inside",
    doc: "origins inside, some very close to the surface",
    make: |random| {
        let (center, radius) = (random.point(10.0), random.power(-3, 10));
        let from = |random: &mut Random| {
            let depth = 1.0 - random.power(-30, -1);
            center + random.point(1.0).normalize_or(DVec3::X) * (radius * depth)
        };
        trial(random, center, radius, from)
    },
};

pub(super) const ON_SURFACE: Group = Group {
    name: "sphere, on its surface",
    doc: "origins on the surface, exactly or to rounding",
    make: |random| {
        let (center, radius) = (random.whole_point(100.0), 7.0 * random.power(-4, 4));
        let from = |random: &mut Random| {
            let exact = DVec3::new(2.0, 3.0, 6.0) * (radius / 7.0);
            let about = random.point(1.0).normalize_or(DVec3::X) * radius;
            center + [exact, about][random.below(2)]
        };
        trial(random, center, radius, from)
    },
};

/// Rays at points of the silhouette as seen from the origin, at the middle, and anywhere.
fn trial(random: &mut Random, center: DVec3, radius: f64, from: impl Fn(&mut Random) -> DVec3) -> Trial {
    let aim = |_| {
        let from = rounded(from(random));
        let away = (from - center).normalize_or(DVec3::X);
        let side = away.cross(random.point(1.0)).normalize_or(DVec3::Y);
        let sine = radius / (from - center).length();
        let cosine = (1.0 - sine * sine).max(0.0).sqrt();
        let silhouette = center + (away * sine + side * cosine) * radius;
        let target = [silhouette, silhouette, center, center + random.point(radius)][random.below(4)];
        random.aimed(from, target)
    };
    let rays = (0..24).map(aim).collect();
    Trial { shapes: made(Sphere::new(center, radius)), rays }
}
