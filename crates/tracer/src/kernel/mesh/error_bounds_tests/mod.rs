//! Do the bounds of the mesh kernels hold, and do they have to be as large as they are? Rays aimed at edges and corners,
//! grazing planes, near ties, at all scales: what `f32` is certain of must be what exact arithmetic says, and depths must
//! lie within their bounds. The tests fail when a bundle's bounds of edges are cut to an eighth (of rays side by side, whose roundings
//! add up less badly, to a sixty-fourth), those of its depths to a tenth, and a single ray's bounds to an eighth.
//!
//! The resolver of these tests gives out rays of NaN, which `f64` cannot decide about: all that `f32` does not decide
//! comes to the resolver, which records it and decides nothing.

mod bundles;
mod single;

use std::sync::Arc;

use catoptra_core::geometry::Triangle;
use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Shape, Span, TriangleMesh};

use super::ExactResolver;
use crate::accel::{MeshTree, Preset};
use crate::random::Random;

/// Records which lanes it had to decide.
#[derive(Default)]
struct Witness {
    asked: u64,
}

impl ExactResolver for Witness {
    fn ray(&mut self, _: usize) -> Option<(Ray, Span)> {
        Some((Ray::new(DVec3::NAN, DVec3::NAN), Span::AHEAD))
    }

    fn leaves(&self, _: u32, _: u32) -> bool {
        false
    }

    fn decide(&mut self, lane: usize, _: u32, _: Option<u32>) -> Option<f64> {
        self.asked |= 1 << lane;
        None
    }
}

/// How a kernel did.
#[derive(Debug, Default)]
struct Record {
    hits: u64,
    misses: u64,
    undecided: u64,
    /// Largest error of a depth in units of its bound.
    worst: f64,
}

/// Triangles with their tree, and exactly.
struct Target {
    tree: MeshTree,
    shapes: Vec<Shape>,
    corners: [DVec3; 3],
}

impl Target {
    /// A triangle and, in half of all cases, one that is the same but for some roundings.
    fn any(random: &mut Random) -> Option<Self> {
        let unit = random.unit();
        let (place, size) = (random.point() * unit * random.power(-8, 4), unit * random.power(-8, 4));
        let thin = random.power(-8, 0);
        let [a, b, c] = [(); 3].map(|()| place + random.point() * size);
        let c = a.lerp(c, thin);
        // Walls and floors: bounds count each axis by itself.
        let wall = DVec3::ONE - random.axis() * f64::from(u8::from(random.bits().is_multiple_of(4)));
        let mut positions = [a, b, c].map(|p: DVec3| (a + (p - a) * wall).as_vec3()).to_vec();
        if random.bits().is_multiple_of(2) {
            let off = (random.point() * size * random.power(-24, -8)).as_vec3();
            positions.extend([0, 1, 2].map(|corner: usize| positions[corner] + off));
        }
        let wide = |at: usize| positions[at].as_dvec3();
        let shape = |at: usize| Triangle::new(wide(at), wide(at + 1), wide(at + 2)).ok().map(Shape::from);
        let shapes = (0..positions.len()).step_by(3).map(shape).collect::<Option<Vec<_>>>()?;
        let triangles = (0..positions.len() as u32).step_by(3).map(|at| [at, at + 1, at + 2]).collect();
        let corners = [wide(0), wide(1), wide(2)];
        let positions = positions.into_iter().map(|p| p.to_array()).collect();
        let mesh = Arc::new(TriangleMesh::new(positions, triangles, None, None).ok()?);
        Some(Self { tree: MeshTree::build(&mesh, Preset::Fast, crate::pool::one_thread()), shapes, corners })
    }

    /// A point at an edge or a corner, or nearly so.
    fn rim(&self, random: &mut Random) -> DVec3 {
        let corner = random.bits() as usize % 3;
        let (a, b) = (self.corners[corner], self.corners[(corner + 1) % 3]);
        let share = [0.0, 0.5, random.number()][random.bits() as usize % 3];
        a.lerp(b, share) + random.point() * a.distance(b) * random.power(-26, -1)
    }

    /// A point to look from: anywhere, hardly out of the plane, or all but along an axis.
    fn eye(&self, random: &mut Random) -> DVec3 {
        let [a, b, c] = self.corners;
        let (along, mut away) = (b - a, random.point() * a.distance(b) * random.power(1, 6));
        if random.bits().is_multiple_of(4) {
            let axis = random.axis();
            away = away * axis + away * (1.0 - axis) * random.power(-12, 0);
        }
        if random.bits().is_multiple_of(2) {
            return a + away;
        }
        let normal = along.cross(c - a).normalize_or_zero();
        a + away - normal * away.dot(normal) * (1.0 - random.power(-20, 0))
    }

    /// Which triangle a ray meets first, and where; of two in one place the first.
    fn first(&self, ray: &Ray) -> Option<(u32, f64)> {
        let hits = self.shapes.iter().zip(0_u32..);
        let hits = hits.filter_map(|(shape, id)| Some((id, shape.cross(ray, Span::AHEAD, None)?.t)));
        hits.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Record {
    /// Compares what `f32` is certain of, depth and bound of its crossing, with the exact answer; `depth` is that of a `t`.
    fn note(
        &mut self,
        target: &Target,
        ray: &Ray,
        found: Option<(u32, [f64; 2])>,
        depth: impl Fn(f64) -> f64,
    ) {
        let right = target.first(ray);
        assert_eq!(found.map(|found| found.0), right.map(|right| right.0), "{ray:?} {:?}", target.corners);
        match (found, right) {
            (Some((_, found)), Some((_, t))) => self.note_depth(target, ray, found, depth(t)),
            _ => self.misses += 1,
        }
    }

    /// Compares a depth that is known within a bound with the exact one.
    fn note_depth(&mut self, target: &Target, ray: &Ray, [depth, error]: [f64; 2], right: f64) {
        self.hits += 1;
        let ratio = (depth - right).abs() / error;
        assert!(ratio <= 1.0, "{ratio} of the bound: {ray:?} {:?}", target.corners);
        self.worst = self.worst.max(ratio);
    }

    /// Asserts that all there is to attack was attacked.
    fn assert_attacked(&self, least: f64) {
        println!("{self:?}");
        assert!(self.hits.min(self.misses).min(self.undecided) > 300, "{self:?}");
        assert!(self.worst > least, "the worst error is but {} of its bound", self.worst);
    }
}
