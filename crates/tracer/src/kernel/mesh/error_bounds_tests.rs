//! Do the bounds of the mesh kernels hold, and do they have to be as large as they are? Rays aimed at edges and corners,
//! grazing planes, near ties, at all scales: what `f32` is certain of must be what exact arithmetic says, and depths must
//! lie within their bounds. The tests fail when a bundle's bounds of edges are cut to an eighth, those of its
//! depths to a tenth, and a single ray's bounds to an eighth.
//!
//! The resolver of these tests gives out rays of NaN, which `f64` cannot decide about: all that `f32` does not decide
//! comes to the resolver, which records it and decides nothing.

use std::sync::Arc;

use catoptra_core::geometry::Triangle;
use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Shape, Span, TriangleMesh};
use fearless_simd::{Level, Simd, dispatch};

use super::{
    BundledRays, ClosestHit, CommonOrigin, ExactResolver, LeafBlock, Lines, RayBundle, RaySetup, Reach,
    Visits,
};
use crate::accel::{MeshTree, Preset};
use crate::lanes::{D, D3, F, M, U, splat_wide};
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
    /// Compares what `f32` is certain of, depth and bound of its crossing, with the exact answer.
    fn note(&mut self, target: &Target, ray: &Ray, found: Option<(u32, [f64; 2])>, depth_per_t: f64) {
        let right = target.first(ray);
        assert_eq!(found.map(|found| found.0), right.map(|right| right.0), "{ray:?} {:?}", target.corners);
        match (found, right) {
            (Some((_, [depth, error])), Some((_, t))) => {
                self.note_depth(target, ray, [depth, error], t * depth_per_t);
            }
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

#[test]
fn single_rays_are_certain_only_of_what_is_so() {
    let mut record = Record::default();
    attack_single(&mut Random(11), &mut record, |_, ray, _| (*ray, 0.0));
    record.assert_attacked(0.02);
}

#[test]
fn single_rays_whose_origins_are_off_are_certain_only_of_what_is_so() {
    let mut record = Record::default();
    attack_single(&mut Random(17), &mut record, |random, ray, reach| {
        let off = (ray.origin.length() + f64::from(reach)) * random.power(-34, -16);
        (Ray::new(ray.origin + random.point() * off, ray.direction), (off as f32).next_up())
    });
    record.assert_attacked(0.02);
}

/// Aims rays at rims. Each is traced as the nearby ray that `known` returns for it, with how far that is off; `known`
/// gets the reach of the mesh.
fn attack_single(
    random: &mut Random,
    record: &mut Record,
    known: impl Fn(&mut Random, &Ray, f32) -> (Ray, f32),
) {
    for _ in 0..300_000 {
        let Some(target) = Target::any(random) else { continue };
        let (from, to) = (target.eye(random), target.rim(random));
        let mut ray = Ray::new(from, (to - from) * random.power(-6, 6));
        // Some run along a plane of two axes, or nearly so.
        if random.bits().is_multiple_of(8) {
            ray.direction[random.bits() as usize % 3] *=
                [0.0, random.power(-60, -20)][random.bits() as usize % 2];
        }
        let (beside, off) = known(random, &ray, target.tree.reach);
        let (best, asked) = dispatch!(Level::new(), s => follow(s, beside, off, &target.tree));
        if asked != 0 {
            record.undecided += 1;
            continue;
        }
        let depth = [f64::from(best.t), f64::from(best.error)];
        let found = best.slot.map(|slot| (target.tree.tree.facet(slot), depth));
        record.note(&target, &ray, found, 1.0);
    }
}

/// Follows a ray alone whose origin may be off by so much; what it meets, and whether that is undecided.
fn follow<S: Simd>(s: S, ray: Ray, off: f32, tree: &MeshTree) -> (ClosestHit, u64) {
    let lines = Lines {
        origin: splat_wide(s, ray.origin),
        direction: splat_wide(s, ray.direction),
        live: M::splat(s, true),
    };
    let rays = RaySetup::of(s, &lines, F::splat(s, off), tree.reach);
    let (mut witness, mut visits) = (Witness::default(), Visits::default());
    let mut best = ClosestHit::nothing_on(Span::AHEAD);
    rays.lane(0, u32::MAX).search(s, &tree.tree, &mut visits, &mut best, &mut witness);
    (best, witness.asked)
}

#[test]
fn slow_rays_meet_what_is_far() {
    let (far, slow) = (2.0_f64.powi(58), 2.0_f64.powi(-60));
    let corners = [[1.0, -1.0, -1.0], [1.0, 1.0, -1.0], [1.0, 0.0, 1.0]].map(|p| p.map(|v| v * far as f32));
    let mesh = Arc::new(TriangleMesh::new(corners.to_vec(), vec![[0, 1, 2]], None, None).unwrap());
    let tree = MeshTree::build(&mesh, Preset::Fast, crate::pool::one_thread());
    for direction in [DVec3::X, DVec3::new(1.0, 1e-3, -1e-3)] {
        let ray = Ray::new(DVec3::new(-far, far / 64.0, far / 64.0), direction * slow);
        let (best, asked) = dispatch!(Level::new(), s => follow(s, ray, 0.0, &tree));
        assert_eq!((best.slot, asked), (Some(0), 0), "{direction}");
    }
}

#[test]
fn rays_through_one_point_are_certain_only_of_what_is_so() {
    let (mut random, mut record) = (Random(13), Record::default());
    for _ in 0..120_000 {
        let Some(target) = Target::any(&mut random) else { continue };
        dispatch!(Level::new(), s => attack_bundle(s, &mut random, &target, &mut record));
    }
    record.assert_attacked(0.02);
}

#[test]
fn depths_on_planes_hold_their_bounds() {
    let (mut random, mut records) = (Random(19), [Record::default(), Record::default()]);
    for _ in 0..60_000 {
        let Some(target) = Target::any(&mut random) else { continue };
        dispatch!(Level::new(), s => attack_planes(s, &mut random, &target, &mut records));
    }
    println!("{records:?}");
    for (record, least) in records.iter().zip([0.08, 0.3]) {
        assert!(record.hits > 100_000 && record.worst > least, "{records:?}");
    }
}

/// Holds the depths of all crossings against exact ones: those from planes in `f32`, then those in `f64`.
fn attack_planes<S: Simd>(s: S, random: &mut Random, target: &Target, records: &mut [Record; 2]) {
    let Some((rays, bundle, [bundled])) = aimed(s, random, target) else { return };
    let (common_origin, tree) = (&bundle.common_origin, &target.tree.tree);
    let Some((prepared, _)) =
        common_origin.prepare(s, &LeafBlock { tree, block: 0, own: u64::MAX }, &common_origin.ray_bounds())
    else {
        return;
    };
    for slot in 0..target.shapes.len() as u32 {
        let shape = &target.shapes[tree.facet(slot) as usize];
        let precise = common_origin.precise_plane(&tree.triangle(slot));
        let planes = [prepared.plane(slot as usize), common_origin.plane_of(&precise)];
        for (record, plane) in records.iter_mut().zip(planes) {
            let crossing = bundled.cross(s, &plane);
            let nearer = crossing.nearer.bits();
            for (lane, ray) in rays.iter().enumerate().filter(|(lane, _)| nearer >> lane & 1 == 1) {
                let Some(hit) = shape.cross(ray, Span::AHEAD, None) else { continue };
                let depth = between(crossing.depth, lane);
                record.note_depth(target, ray, depth, hit.t * depth_per_t(common_origin, ray));
            }
        }
    }
}

/// Rays at a rim from one point, which they pass by some roundings in half of all cases.
fn aimed<S: Simd>(
    s: S,
    random: &mut Random,
    target: &Target,
) -> Option<(Vec<Ray>, RayBundle, [BundledRays<S>; 1])> {
    let eye = target.eye(random);
    let off = [0.0, eye.distance(target.corners[0]) * random.power(-30, -20)][random.bits() as usize % 2];
    let rays: Vec<Ray> = (0..F::<S>::LANES)
        .map(|_| {
            let (from, to) = (eye + random.point() * off, target.rim(random));
            Ray::new(from, to - from)
        })
        .collect();
    let column = |of: &dyn Fn(&Ray) -> f64| D::load(s, &rays.iter().map(of).collect::<Vec<_>>());
    let triple = |of: &dyn Fn(&Ray) -> DVec3| {
        D3::new(column(&|ray| of(ray).x), column(&|ray| of(ray).y), column(&|ray| of(ray).z))
    };
    let (origin, direction) = (triple(&|ray| ray.origin), triple(&|ray| ray.direction));
    let lines = Lines { origin, direction, live: M::splat(s, true) };
    let mut bundled = [BundledRays::nothing(s)];
    let bundle = RayBundle::of(s, &mut bundled, |_| lines, Reach { off: 0.0, mesh: target.tree.reach })?;
    let (zero, most) = (F::splat(s, 0.0), F::splat(s, f32::MAX));
    bundled[0].start(s, [zero, zero], [most, zero], U::splat(s, u32::MAX));
    Some((rays, bundle, bundled))
}

/// Middle of what lies between two depths of a lane, and how far that is from them.
fn between<S: Simd>(depths: [F<S>; 2], lane: usize) -> [f64; 2] {
    let [low, high] = depths.map(|depth| f64::from(depth.lane(lane)));
    [(low + high) / 2.0, (high - low) / 2.0]
}

/// Depth per `t` of a ray.
fn depth_per_t(common_origin: &CommonOrigin, ray: &Ray) -> f64 {
    ray.direction[common_origin.axes[2]] * f64::from(common_origin.sign)
}

/// Looks at a rim from one point.
fn attack_bundle<S: Simd>(s: S, random: &mut Random, target: &Target, record: &mut Record) {
    let Some((rays, bundle, mut bundled)) = aimed(s, random, target) else { return };
    let (mut witness, mut visits) = (Witness::default(), Visits::default());
    bundle.common_origin.search(s, &target.tree.tree, &mut visits, &mut bundled, &mut witness);
    let [found] = bundled;
    for (lane, ray) in rays.iter().enumerate() {
        if witness.asked >> lane & 1 == 1 {
            record.undecided += 1;
            continue;
        }
        let slot = Some(found.slot.lane(lane)).filter(|&slot| slot != u32::MAX);
        let depth = between(found.end, lane);
        let found = slot.map(|slot| (target.tree.tree.facet(slot), depth));
        record.note(target, ray, found, depth_per_t(&bundle.common_origin, ray));
    }
}
