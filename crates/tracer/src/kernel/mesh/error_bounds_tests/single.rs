//! Single rays.

use std::sync::Arc;

use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Span, TriangleMesh};
use fearless_simd::{Level, Simd, dispatch};

use super::{Record, Target, Witness};
use crate::accel::{MeshTree, Preset};
use crate::kernel::mesh::{ClosestHit, Lines, RaySetup, Visits};
use crate::lanes::{F, M, splat_wide};
use crate::random::Random;

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
        record.note(&target, &ray, found, |t| t);
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
