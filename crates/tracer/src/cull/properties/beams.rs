//! Does a beam keep all that its rays meet, and does a mirrored beam hold all its rays?

use catoptra_core::geometry::Sphere;
use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Ray, Shape, Span};

use super::super::{Beam, Candidates, Frustum, PointBounds};
use super::parts::{farthest, hair, moved, one_in, one_of, some_plane, some_shape};
use super::stage::{Stage, snapshot_of};
use super::{depth_in, holds, narrow_box};
use crate::film::NOTHING;
use crate::random::Random;
use crate::{Frame, Snapshot, SurfaceId};

/// Counts of what was tested, so that rare cases are known to occur.
#[derive(Debug, Default)]
struct Tally {
    crossings: u32,
    /// Shapes that one ray only met.
    barely: u32,
    /// Shapes that may not be met.
    left_out: u32,
    /// Points of planes near the border of their bounds.
    near_bounds: u32,
    /// Beams whose rays may cross planes in an unbounded region.
    endless: u32,
}

/// A ray, and the surface that it leaves.
type Sent = (Ray, Option<SurfaceId>);

/// Beams, and rays of theirs in the snapshot's frame.
struct Streams<'a> {
    snapshot: &'a Snapshot,
    beams: Vec<Beam>,
    rays: Vec<Sent>,
    outside: bool,
}

impl Streams<'_> {
    /// Whatever rays cross is reachable, and lies where it is said to.
    fn check(&self, tally: &mut Tally) {
        let columns = self.snapshot.columns();
        let mut reachable = Candidates::default();
        reachable.reachable(columns, &self.beams, self.outside);
        let known = reachable.find_points_of(columns, &self.beams);
        assert_eq!(known && !reachable.is_empty(), !reachable.points.is_empty());
        tally.endless += u32::from(!known && !reachable.tree);
        for prim in 0..self.snapshot.prims().len() as u32 {
            let mut met = 0;
            for (ray, leaving) in &self.rays {
                let Some(hit) = self.snapshot.cross_part(prim, None, ray, Span::AHEAD, *leaving) else {
                    continue;
                };
                met += 1;
                let what = || {
                    let prims = self.snapshot.prims();
                    format!("{ray:?} {leaving:?} {:#?} {reachable:#?} of {prims:#?}", self.beams)
                };
                assert!(
                    holds(&reachable, self.snapshot, hit.surface),
                    "{hit:?} is not reachable: {}",
                    what()
                );
                let point = ray.at(hit.crossing.t) - self.snapshot.origin_in_frame();
                let own = reachable.points.iter().filter(|bounds| bounds.prim == prim);
                let depth = own.map(|bounds| depth_in(bounds, point)).fold(f64::INFINITY, f64::min);
                assert!(!known || depth <= 1.0, "{depth} half sizes from the middle: {hit:?} {}", what());
                let endless = self.snapshot.prims()[prim as usize].shape.bounds().is_none();
                tally.near_bounds += u32::from(known && endless && depth > 0.97);
            }
            tally.crossings += met;
            tally.barely += u32::from(met == 1);
            let surface = SurfaceId { prim, facet: 0 };
            tally.left_out += u32::from(!holds(&reachable, self.snapshot, surface));
        }
    }
}

/// A ray mirrored where it meets a surface.
pub(super) fn mirrored(ray: &Ray, t: f64, normal: DVec3) -> Ray {
    let unit = ray.direction.normalize();
    Ray::new(ray.at(t), unit - normal * (2.0 * unit.dot(normal)))
}

/// The rays that surfaces send on, as beams, shape by shape.
pub(super) fn beams_of(snapshot: &Snapshot, sent: &[Sent]) -> Vec<Beam> {
    let mut prims: Vec<u32> = sent.iter().filter_map(|(_, surface)| Some(surface.as_ref()?.prim)).collect();
    prims.sort_unstable();
    prims.dedup();
    let beam = |prim: u32| {
        let own =
            || sent.iter().filter(move |(_, surface)| surface.is_some_and(|surface| surface.prim == prim));
        let starts = own().map(|(ray, _)| ray.origin - snapshot.origin_in_frame());
        Beam::new(prim, narrow_box(starts), narrow_box(own().map(|(ray, _)| ray.direction)))
    };
    prims.into_iter().map(beam).collect()
}

#[test]
fn what_mirrored_rays_cross_is_reachable() {
    let mut tally = Tally::default();
    let mut random = Random(12);
    for _ in 0..3_000 {
        let mut stage = Stage::new(&mut random, 4);
        let snapshot = stage.snapshot(&[], true);
        let view = stage.stand.view.clone();
        let frame = Frame::new(&snapshot, &view);
        let region = *one_of(stage.random, &stage.stand.regions);
        let rays = stage.rays(&frame, &region);
        let camera: Vec<Sent> = rays.into_iter().map(|ray| (ray, None)).collect();
        let sent: Vec<Sent> = camera
            .iter()
            .filter_map(|(ray, _)| {
                let hit = snapshot.nearest_in_frame(ray, Span::AHEAD, None)?;
                // Of faces that meet in a corner at which a ray is aimed, the lowest is met, though it may look away: what is
                // mirrored there does not stay outside.
                let is_closed = snapshot.prims()[hit.surface.prim as usize].shape.is_closed();
                let from_behind = hit.crossing.normal.dot(ray.direction) > 0.0;
                let stays = !(frame.outside_solids && is_closed && from_behind);
                stays.then(|| (mirrored(ray, hit.crossing.t, hit.crossing.normal), Some(hit.surface)))
            })
            .collect();
        let outside = frame.outside_solids;
        let beams = beams_of(&snapshot, &sent);
        Streams { snapshot: &snapshot, beams, rays: sent, outside }.check(&mut tally);
        let beams = vec![Frustum::new(&frame, &region).beam()];
        Streams { snapshot: &snapshot, beams, rays: camera, outside }.check(&mut tally);
    }
    assert!(tally.crossings > 25_000 && tally.barely > 100, "{tally:?}");
    assert!(tally.left_out > 3_000 && tally.near_bounds > 400 && tally.endless > 50, "{tally:?}");
}

/// A box of `size` metres: a cube, or one that is flat along some axes.
pub(super) fn some_box(random: &mut Random, center: DVec3, size: f64) -> Aabb {
    let half = if one_in(random, 2) {
        DVec3::splat(size)
    } else {
        DVec3::ZERO.map(|_| if one_in(random, 3) { 0.0 } else { size * random.power(-8, 0) })
    };
    Aabb { min: center - half, max: center + half }
}

/// Signs of a corner.
pub(super) fn signs(random: &mut Random) -> DVec3 {
    DVec3::ZERO.map(|_| if one_in(random, 2) { 1.0 } else { -1.0 })
}

/// The corner of a box in the direction of some signs.
pub(super) fn corner(of: Aabb, signs: DVec3) -> DVec3 {
    of.centre() + of.size() / 2.0 * signs
}

/// Shapes that a ray from one corner of the starts along one corner of the directions meets by a hair.
fn just_met(random: &mut Random, ray: &Ray, outwards: DVec3, unit: f64) -> Vec<Shape> {
    let mut shapes = Vec::new();
    for _ in 0..2 {
        let at = ray.at(unit * random.power(-12, 8));
        let way = if one_in(random, 4) { random.point() } else { outwards };
        let aside = way.reject_from(ray.direction).normalize_or(DVec3::X);
        let radius = unit * random.power(-8, 5);
        let off = 1.0 - hair(random);
        if one_in(random, 3) {
            let shape = some_shape(random, radius);
            shapes.push(moved(&shape, at + aside * (radius * (1.0 - off)) - farthest(&shape, -aside)));
        } else {
            shapes.push(Sphere::new(at + aside * (radius * off), radius).unwrap().into());
        }
    }
    // A plane that the ray meets far away, or that it all but starts in; the other rays do not, or do.
    let near = if one_in(random, 2) { random.power(-40, 8) } else { random.power(-3, 8) };
    let along = ray.direction.normalize();
    let normal = match random.bits() % 3 {
        0 => random.axis(),
        1 => random.point().abs() * outwards.signum(),
        _ => random.point(),
    };
    let steep = if one_in(random, 2) { hair(random) } else { normal.dot(along) };
    let normal = normal.reject_from(along) + along * steep;
    shapes.push(some_plane(random, ray.at(unit * near), normal, unit));
    shapes
}

#[test]
fn what_rays_from_within_a_box_in_directions_within_a_box_cross_is_reachable() {
    let mut tally = Tally::default();
    let mut random = Random(13);
    for _ in 0..6_000 {
        let random = &mut random;
        let unit = random.power(-6, 6);
        let size = unit * random.power(-12, 2);
        let center = random.point() * unit * random.power(-3, 3);
        let starts = some_box(random, center, size);
        let outwards = signs(random);
        let axis = random.point().normalize();
        let axis = if one_in(random, 2) { axis.reject_from(outwards).normalize() } else { axis };
        let spread = random.power(-12, 0);
        let units = some_box(random, axis, spread);
        let aslant = if one_in(random, 3) { signs(random) } else { outwards };
        let ray = Ray::new(corner(starts, outwards), corner(units, aslant));
        let shapes = just_met(random, &ray, outwards, unit);
        let snapshot = snapshot_of(&shapes, &[], true, None);
        let own = |p: DVec3| p - snapshot.origin();
        let beam = Beam::new(NOTHING, narrow_box(starts.corners().map(own)), narrow_box(units.corners()));
        let some_ray = |_| Ray::new(corner(starts, signs(random)), corner(units, signs(random)));
        let mut rays: Vec<Ray> = (0..8).map(some_ray).collect();
        rays.push(ray);
        let rays = rays.iter().map(|ray| (snapshot.own_ray(ray), None)).collect();
        Streams { snapshot: &snapshot, beams: vec![beam], rays, outside: false }.check(&mut tally);
    }
    assert!(tally.crossings > 30_000 && tally.barely > 2_000, "{tally:?}");
    assert!(tally.left_out > 80 && tally.near_bounds > 4_000 && tally.endless > 1_500, "{tally:?}");
}

#[test]
fn mirrored_beams_hold_their_rays() {
    let mut random = Random(14);
    let mut tight = 0;
    for _ in 0..20_000 {
        let random = &mut random;
        let size = random.power(-6, 6);
        let center = random.point() * random.power(-6, 6);
        let points = PointBounds::new(3, some_box(random, center, size));
        let normal = if one_in(random, 4) { random.axis() } else { random.point().normalize() };
        let axis = if one_in(random, 2) { normal } else { random.point().normalize() };
        let (spread, tilt) = (random.power(-12, -1), random.power(-12, -1));
        let units = some_box(random, axis, spread);
        let normals = some_box(random, normal, tilt);
        let beam = Beam::new(NOTHING, Aabb::of([DVec3::ZERO]), units);
        let sent = beam.mirrored(&points, normal, normals.size() / 2.0);
        assert_eq!(sent.prim, 3);
        for _ in 0..4 {
            let [along, tilted] =
                [axis, normal].map(|v| if one_in(random, 3) { signs(random) } else { v.signum() });
            let (d, n) = (corner(units, along), corner(normals, tilted));
            let (from, to) =
                (points.center + points.half * signs(random) * (1.0 - 1e-9), d - n * (2.0 * d.dot(n)));
            let off = |v: DVec3, middle: DVec3, half: DVec3| ((v - middle) / half).abs().max_element();
            assert!(off(from, sent.center, sent.half) <= 1.0, "{sent:?} {from}");
            let share = off(to, sent.axis, sent.half_spread);
            assert!(share <= 1.0, "{share} of the half sizes from the middle: {sent:?} {d} {n}");
            tight += u32::from(share > 0.99 && tilt > 1e-3);
        }
    }
    assert!(tight > 15_000, "only {tight} rays lie at the border of their beam");
}
