//! Bundles of rays, through one point or side by side.

use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Span};
use fearless_simd::{Level, Simd, dispatch};

use super::{Record, Target, Witness};
use crate::kernel::mesh::common::Common;
use crate::kernel::mesh::common_direction::CommonDirection;
use crate::kernel::mesh::common_origin::CommonOrigin;
use crate::kernel::mesh::{Bundle, BundledRays, LeafBlock, Lines, RayBundle, Reach, Starts, Visits};
use crate::lanes::{D, D3, F, M, U};
use crate::random::Random;

#[test]
fn rays_through_one_point_are_certain_only_of_what_is_so() {
    let (mut random, mut record) = (Random(13), Record::default());
    for _ in 0..120_000 {
        let Some(target) = Target::any(&mut random) else { continue };
        dispatch!(Level::new(), s => attack_bundle(s, &target, aimed_through(s, &mut random, &target), &mut record));
    }
    record.assert_attacked(0.02);
}

#[test]
fn rays_side_by_side_are_certain_only_of_what_is_so() {
    let (mut random, mut record) = (Random(23), Record::default());
    for _ in 0..120_000 {
        let Some(target) = Target::any(&mut random) else { continue };
        dispatch!(Level::new(), s => attack_bundle(s, &target, aimed_along(s, &mut random, &target), &mut record));
    }
    record.assert_attacked(0.02);
}

#[test]
fn depths_on_planes_hold_their_bounds() {
    let (mut random, mut records) = (Random(19), [Record::default(), Record::default()]);
    for _ in 0..60_000 {
        let Some(target) = Target::any(&mut random) else { continue };
        dispatch!(Level::new(), s => attack_planes(s, &target, aimed_through(s, &mut random, &target), &mut records));
    }
    assert_close(&records, [0.08, 0.3]);
}

#[test]
fn depths_on_planes_hold_their_bounds_side_by_side() {
    let (mut random, mut records) = (Random(29), [Record::default(), Record::default()]);
    for _ in 0..60_000 {
        let Some(target) = Target::any(&mut random) else { continue };
        dispatch!(Level::new(), s => attack_planes(s, &target, aimed_along(s, &mut random, &target), &mut records));
    }
    assert_close(&records, [0.05, 0.2]);
}

/// Asserts that depths were held against exact ones often, and came that close to their bounds.
fn assert_close(records: &[Record; 2], least: [f64; 2]) {
    println!("{records:?}");
    for (record, least) in records.iter().zip(least) {
        assert!(record.hits > 100_000 && record.worst > least, "{records:?}");
    }
}

/// A bundle of rays, and what they are exactly.
struct Aimed<S: Simd, C> {
    rays: Vec<Ray>,
    /// The depth at which each begins.
    begins: Vec<f64>,
    bundle: Bundle<C>,
    bundled: [BundledRays<S>; 1],
}

impl<S: Simd, C> Aimed<S, C> {
    /// The depth of a ray at `t`.
    fn depth(&self, lane: usize, t: f64) -> f64 {
        let Bundle { axes, sign, .. } = &self.bundle;
        self.begins[lane] + t * self.rays[lane].direction[axes[2]] * f64::from(*sign)
    }
}

/// Holds the depths of all crossings against exact ones: those from planes in `f32`, then those in `f64`.
fn attack_planes<S: Simd, C: Common>(
    s: S,
    target: &Target,
    aimed: Option<Aimed<S, C>>,
    records: &mut [Record; 2],
) {
    let Some(aimed) = aimed else { return };
    let (bundle, tree, [bundled]) = (&aimed.bundle, &target.tree.tree, &aimed.bundled);
    let (leaf, ray_bounds) = (LeafBlock { tree, block: 0, own: u64::MAX }, bundle.common.ray_bounds(bundle));
    let Some((prepared, _)) = bundle.common.prepare(s, bundle, &leaf, &ray_bounds) else { return };
    for slot in 0..target.shapes.len() as u32 {
        let shape = &target.shapes[tree.facet(slot) as usize];
        let precise = bundle.common.precise_plane(bundle, &tree.triangle(slot));
        let planes = [prepared.plane(slot as usize), bundle.common.plane_of(bundle, &precise)];
        for (record, plane) in records.iter_mut().zip(planes) {
            let crossing = bundled.cross(s, bundle, &plane);
            let nearer = crossing.nearer.bits();
            for (lane, ray) in aimed.rays.iter().enumerate().filter(|(lane, _)| nearer >> lane & 1 == 1) {
                let Some(hit) = shape.cross(ray, Span::AHEAD, None) else { continue };
                let depth = between(crossing.depth, lane);
                record.note_depth(target, ray, depth, aimed.depth(lane, hit.t));
            }
        }
    }
}

/// Vectors in every lane.
fn gathered<S: Simd>(s: S, vectors: &[DVec3]) -> D3<S> {
    let column = |of: &dyn Fn(&DVec3) -> f64| D::load(s, &vectors.iter().map(of).collect::<Vec<_>>());
    D3::new(column(&|v| v.x), column(&|v| v.y), column(&|v| v.z))
}

/// Rays at a rim from one point, which they pass by some roundings in half of all cases.
fn aimed_through<S: Simd>(s: S, random: &mut Random, target: &Target) -> Option<Aimed<S, CommonOrigin>> {
    let eye = target.eye(random);
    let off = [0.0, eye.distance(target.corners[0]) * random.power(-30, -20)][random.bits() as usize % 2];
    let rays: Vec<Ray> = (0..F::<S>::LANES)
        .map(|_| {
            let (from, to) = (eye + random.point() * off, target.rim(random));
            Ray::new(from, to - from)
        })
        .collect();
    let origin = gathered(s, &rays.iter().map(|ray| ray.origin).collect::<Vec<_>>());
    let direction = gathered(s, &rays.iter().map(|ray| ray.direction).collect::<Vec<_>>());
    let lines = Lines { origin, direction, live: M::splat(s, true) };
    let mut bundled = [BundledRays::nothing(s)];
    let bundle = RayBundle::of(s, &mut bundled, |_| lines, Reach { off: 0.0, mesh: target.tree.reach })?;
    let (zero, most) = (F::splat(s, 0.0), F::splat(s, f32::MAX));
    bundled[0].start(s, [zero, zero], [most, zero], U::splat(s, u32::MAX));
    Some(Aimed { begins: vec![0.0; rays.len()], rays, bundle: bundle.common_origin, bundled })
}

/// Rays at a rim in one direction, along an axis or all but so in some cases. Where they begin is known but for some roundings in
/// half of all cases.
fn aimed_along<S: Simd>(s: S, random: &mut Random, target: &Target) -> Option<Aimed<S, CommonDirection>> {
    let mut direction = target.rim(random) - target.eye(random);
    if random.bits().is_multiple_of(8) {
        direction[random.bits() as usize % 3] *= [0.0, random.power(-60, -20)][random.bits() as usize % 2];
    }
    let (far, off) = (random.power(-10, 1), random.power(-30, -16));
    let off = [0.0, direction.length() * off][random.bits() as usize % 2];
    let rays: Vec<Ray> = (0..F::<S>::LANES)
        .map(|_| Ray::new(target.rim(random) - direction * (far * random.number()), direction))
        .collect();
    let known: Vec<DVec3> = rays.iter().map(|ray| ray.origin + random.point() * off).collect();
    let starts = Starts {
        origin: gathered(s, &known),
        off: F::splat(s, (off as f32).next_up()),
        live: M::splat(s, true),
        leaving: U::splat(s, u32::MAX),
    };
    let mut bundled = [BundledRays::nothing(s)];
    let (zero, most) = (F::splat(s, 0.0), F::splat(s, f32::MAX));
    let spans = |_, _| [[zero; 2], [most, zero]];
    let bundle = Bundle::along(s, &mut bundled, &[starts], direction, target.tree.reach, spans)?;
    let Bundle { axes, sign, origin, .. } = &bundle;
    let begin = |ray: &Ray| ray.origin[axes[2]] * f64::from(*sign) - f64::from(origin[2]);
    Some(Aimed { begins: rays.iter().map(begin).collect(), rays, bundle, bundled })
}

/// Middle of what lies between two depths of a lane, and how far that is from them.
fn between<S: Simd>(depths: [F<S>; 2], lane: usize) -> [f64; 2] {
    let [low, high] = depths.map(|depth| f64::from(depth.lane(lane)));
    [(low + high) / 2.0, (high - low) / 2.0]
}

/// Looks at a rim.
fn attack_bundle<S: Simd, C: Common>(s: S, target: &Target, aimed: Option<Aimed<S, C>>, record: &mut Record) {
    let Some(mut aimed) = aimed else { return };
    let (mut witness, mut visits) = (Witness::default(), Visits::default());
    aimed.bundle.search(s, &target.tree.tree, &mut visits, &mut aimed.bundled, &mut witness);
    let [found] = aimed.bundled;
    for (lane, ray) in aimed.rays.iter().enumerate() {
        if witness.asked >> lane & 1 == 1 {
            record.undecided += 1;
            continue;
        }
        let slot = Some(found.slot.lane(lane)).filter(|&slot| slot != u32::MAX);
        let found = slot.map(|slot| (target.tree.tree.facet(slot), between(found.end, lane)));
        record.note(target, ray, found, |t| aimed.depth(lane, t));
    }
}
