//! Do mirrors that are marked as dark reflect nothing but the background?

use catoptra_core::geometry::Sphere;
use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Ray, Shape, Span};

use super::super::{Beam, Candidates, Frustum, Planner, PointBounds, TilePlan};
use super::beams::{beams_of, mirrored};
use super::parts::{farthest, hair, moved, one_in, one_of, some_shape};
use super::stage::{Stage, snapshot_of};
use super::{narrow_box, seen_in};
use crate::film::NOTHING;
use crate::random::Random;
use crate::{Frame, Hit, Region, Skip, Snapshot, SurfaceId};

/// Counts of what was tested, so that rare cases are known to occur.
#[derive(Debug, Default)]
struct Tally {
    /// Rays that are sent on by mirrors that are dark.
    into_darkness: u32,
    /// The same after another reflection.
    later: u32,
    /// Mirrors that are not dark, whose rays all but one meet nothing.
    nearly_dark: u32,
}

/// A ray that a surface sends on.
type Sent = (Ray, Option<SurfaceId>);

/// Rays sent on by what is met are checked against a plan; returns them.
fn send_on(snapshot: &Snapshot, plan: &TilePlan, rays: &[Sent]) -> Vec<Sent> {
    let meet = |(ray, leaving): &Sent| -> Option<(Ray, Hit)> {
        let hit = snapshot.nearest_in_frame(ray, Span::AHEAD, *leaving)?;
        Some((mirrored(ray, hit.crossing.t, hit.crossing.normal), hit))
    };
    let sent: Vec<(Ray, Hit)> = rays.iter().filter_map(meet).collect();
    for (ray, hit) in &sent {
        if plan.dark.contains(&hit.surface.prim) {
            let next = snapshot.nearest_in_frame(ray, Span::AHEAD, Some(hit.surface));
            let prims = snapshot.prims();
            assert!(
                next.is_none(),
                "{next:?} after {:?} on {ray:?}: {:?} {prims:#?}",
                hit.surface,
                plan.dark
            );
        }
    }
    sent.into_iter().map(|(ray, hit)| (ray, Some(hit.surface))).collect()
}

/// How many rays leave dark mirrors.
fn dark_ones(plan: &TilePlan, sent: &[Sent]) -> u32 {
    sent.iter()
        .filter(|(_, surface)| surface.is_some_and(|surface| plan.dark.contains(&surface.prim)))
        .count() as u32
}

/// Mirrors of which only one of the rays tried meets anything.
fn nearly_dark(snapshot: &Snapshot, sent: &[Sent]) -> u32 {
    let prims = 0..snapshot.prims().len() as u32;
    let meets = |(ray, surface): &&Sent| snapshot.nearest_in_frame(ray, Span::AHEAD, *surface).is_some();
    let own = |prim: u32| {
        sent.iter().filter(move |(_, surface)| surface.is_some_and(|surface| surface.prim == prim))
    };
    prims.filter(|&prim| own(prim).count() > 4 && own(prim).filter(meets).count() == 1).count() as u32
}

/// Camera rays of a region.
fn camera_rays(stage: &mut Stage<'_>, frame: &Frame<'_>, region: &Region) -> Vec<Sent> {
    stage.rays(frame, region).into_iter().map(|ray| (ray, None)).collect()
}

/// Puts a shape where it just meets a mirrored ray, and others do not, or do.
fn block(stage: &mut Stage<'_>, region: &Region) {
    let snapshot = stage.snapshot(&[], true);
    let view = stage.stand.view.clone();
    let frame = Frame::new(&snapshot, &view);
    let rays = camera_rays(stage, &frame, region);
    let sent = send_on(&snapshot, &TilePlan::default(), &rays);
    if sent.is_empty() {
        return;
    }
    let (ray, _) = *one_of(stage.random, &sent);
    let middle = sent.iter().map(|(ray, _)| ray.direction).sum::<DVec3>();
    let aside =
        (ray.direction - middle.normalize_or_zero()).reject_from(ray.direction).normalize_or(DVec3::X);
    let unit = stage.stand.unit;
    let radius = unit * stage.random.power(-8, 4);
    let at = ray.at(unit * stage.random.power(-3, 8)) + snapshot.frame();
    let off = radius * (1.0 - hair(stage.random));
    let shape = if one_in(stage.random, 2) {
        let shape = some_shape(stage.random, radius);
        moved(&shape, at + aside * (off - radius) - farthest(&shape, -aside))
    } else {
        Shape::from(Sphere::new(at + aside * off, radius).unwrap())
    };
    stage.add(shape);
}

/// Plans for the camera's rays, and for those that are sent on.
fn try_plan(stage: &mut Stage<'_>, region: &Region, tally: &mut Tally) {
    let snapshot = stage.snapshot(&[], true);
    let view = stage.stand.view.clone();
    let frame = Frame::new(&snapshot, &view);
    let (columns, outside) = (snapshot.columns(), frame.outside_solids);
    let (visible, mut reachable) = (seen_in(&frame, region), Candidates::default());
    let mut plan = TilePlan::default();
    let planner = Planner { snapshot: &snapshot, skip: Skip::ALL, outside };
    plan.plan_darkness(&planner, &[Frustum::new(&frame, region).beam()], &visible.points);
    let rays = camera_rays(stage, &frame, region);
    let sent = send_on(&snapshot, &plan, &rays);
    tally.into_darkness += dark_ones(&plan, &sent);
    tally.nearly_dark += nearly_dark(&snapshot, &sent);
    let beams = beams_of(&snapshot, &sent);
    reachable.reachable(columns, &beams, outside);
    if reachable.find_points_of(columns, &beams) {
        plan.plan_darkness(&planner, &beams, &reachable.points);
        let later = send_on(&snapshot, &plan, &sent);
        tally.later += dark_ones(&plan, &later);
        tally.nearly_dark += nearly_dark(&snapshot, &later);
    }
}

#[test]
fn dark_mirrors_show_nothing() {
    let mut tally = Tally::default();
    let mut random = Random(18);
    for _ in 0..7_000 {
        let mut stage = Stage::new(&mut random, 3);
        let region = *one_of(stage.random, &stage.stand.regions);
        if !one_in(stage.random, 4) {
            block(&mut stage, &region);
        }
        try_plan(&mut stage, &region, &mut tally);
    }
    assert!(tally.into_darkness > 4_000 && tally.later > 1_500 && tally.nearly_dark > 120, "{tally:?}");
}

#[test]
fn small_parts_of_spheres_are_dark_only_if_they_show_nothing() {
    let mut random = Random(19);
    let (mut dark, mut blocked) = (0, 0);
    for _ in 0..6_000 {
        let random = &mut random;
        let radius = random.power(-4, 4);
        let center = random.point() * random.power(-4, 4);
        let pole = random.axis() * random.number().signum();
        // Corners of a small square round the pole, and rays that come down on it, a little aslant.
        let (tilt, lean) = (random.power(-12, -4), random.power(-14, -4));
        let [a, b] = [pole.any_orthonormal_vector(), pole.cross(pole.any_orthonormal_vector())];
        let corners = [a + b, a - b, -a + b, -a - b];
        let starts = corners.map(|aside| center + (pole + aside * tilt).normalize() * radius);
        let units = corners.map(|aside| aside * lean - pole);
        let sent = |i: usize, j: usize| {
            let normal = (starts[i] - center).normalize();
            Ray::new(starts[i], units[j] - normal * (2.0 * units[j].dot(normal)))
        };
        let (i, ray) = (random.bits() as usize % 4, random.bits() as usize % 4);
        let ray = sent(i, if one_in(random, 2) { i } else { ray });
        let aside = corners[i].reject_from(ray.direction).normalize();
        let size = radius * random.power(-12, 2);
        let off = if one_in(random, 4) { size * random.power(0, 4) } else { size * (1.0 - hair(random)) };
        let at = ray.at(radius * random.power(-4, 6)) + aside * off;
        let shapes =
            [Sphere::new(center, radius), Sphere::new(at, size)].map(|sphere| Shape::from(sphere.unwrap()));
        let snapshot = snapshot_of(&shapes, &[], true, None);
        let own = |p: DVec3| p - snapshot.origin();
        let from = Aabb::of([own(center + pole * (radius * 8.0))]);
        // All in one box each, or one by one.
        let (beams, places): (Vec<Beam>, Vec<PointBounds>) = if one_in(random, 2) {
            let points = starts.into_iter().chain([center + pole * radius]).map(own);
            let bounds = PointBounds::new(0, narrow_box(points));
            (vec![Beam::new(NOTHING, from, narrow_box(units))], vec![bounds])
        } else {
            let bounds = |start: DVec3| PointBounds::new(0, narrow_box([own(start)]));
            (units.map(|unit| Beam::new(NOTHING, from, narrow_box([unit]))).into(), starts.map(bounds).into())
        };
        let mut plan = TilePlan::default();
        let planner = Planner { snapshot: &snapshot, skip: Skip::ALL, outside: true };
        plan.plan_darkness(&planner, &beams, &places);
        let rays = (0..16).map(|k| sent(k % 4, k / 4)).map(|ray| snapshot.own_ray(&ray));
        let meets = |ray: &Ray| snapshot.cross_part(1, None, ray, Span::AHEAD, None).is_some();
        let met = rays.filter(meets).count();
        assert!(plan.dark.is_empty() || met == 0, "{met} rays meet {shapes:#?}");
        dark += u32::from(!plan.dark.is_empty());
        blocked += u32::from(met > 0 && met < 3);
    }
    assert!(dark > 300 && blocked > 2_000, "{dark} were dark, {blocked} nearly so");
}
