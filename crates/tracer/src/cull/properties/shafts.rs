//! Does a plan keep every light that reaches what is seen, and all that may occlude it?

use std::f64::consts::{PI, TAU};

use catoptra_core::geometry::Sphere;
use catoptra_core::glam::DVec3;
use catoptra_core::{FieldKind, LaneMask, Light, Ray, Shape, Span, Triple, Value};
use fearless_simd::{Level, dispatch};

use super::super::{Candidates, Planner, PointBounds, TilePlan};
use super::beams::{corner, signs, some_box};
use super::parts::{farthest, hair, moved, one_in, one_of, some_light, some_plane, some_shape};
use super::stage::{Stage, snapshot_of};
use super::{holds, narrow_box, seen_in};
use crate::film::NOTHING;
use crate::lanes::F;
use crate::random::Random;
use crate::{Frame, Skip, Snapshot, SurfaceId};

/// Counts of what was tested, so that rare cases are known to occur.
#[derive(Debug, Default)]
struct Tally {
    blocked: u32,
    /// Shapes that occlude the light from one point only.
    barely: u32,
    /// Lights that nothing occludes.
    open: u32,
    lit: u32,
    /// Lights that shine on one point only.
    barely_lit: u32,
    /// Points that a light reaches in `f64` and not in `f32`, or the reverse.
    differently_lit: u32,
    /// Lights that reach nothing.
    unreached: u32,
}

/// A point in the snapshot's frame, and the surface that it lies on.
type Seen = (DVec3, Option<SurfaceId>);

/// Whether a light shines on a point, as the kernels' numbers have it.
fn is_lit_in_lanes(light: &Light, point: DVec3) -> bool {
    let [x, y, z] = point.to_array().map(|x| x as f32);
    dispatch!(Level::new(), s => {
        let point = Triple::new(F::splat(s, x), F::splat(s, y), F::splat(s, z));
        light.arriving(point).lit.any()
    })
}

/// Points, and the bounds that hold them.
struct Scene<'a> {
    snapshot: &'a Snapshot,
    bounds: &'a [PointBounds],
    seen: &'a [Seen],
    outside: bool,
}

impl Scene<'_> {
    /// Whatever occludes a light from a point is among its occluders, and what is lit is known to be.
    fn check(&self, tally: &mut Tally) {
        let snapshot = self.snapshot;
        let mut plan = TilePlan::default();
        plan.start(snapshot);
        let planner = Planner { snapshot, skip: Skip::ALL, outside: self.outside };
        plan.plan_lights(&planner, self.bounds);
        for (i, row) in snapshot.light_rows().iter().enumerate() {
            let reached = plan.reached.contains(&i);
            let mut lit = 0;
            for (point, _) in self.seen {
                let own = *point - snapshot.origin_in_frame();
                let wide = row.light.arriving(Triple::new(own.x, own.y, own.z)).lit;
                let lanes = is_lit_in_lanes(&row.light, own);
                lit += u32::from(wide);
                tally.differently_lit += u32::from(wide != lanes);
                assert!(reached || !(wide || lanes), "{own} is lit by {:#?}: {:#?}", row.light, self.bounds);
            }
            tally.lit += lit;
            tally.barely_lit += u32::from(lit > 0 && lit == 1);
            tally.unreached += u32::from(!reached);
            tally.open += u32::from(plan.occluders[i].is_empty());
            for prim in 0..snapshot.prims().len() as u32 {
                self.check_occluder(&plan.occluders[i], i, prim, tally);
            }
        }
    }

    fn check_occluder(&self, occluders: &Candidates, light: usize, prim: u32, tally: &mut Tally) {
        let mut blocked = 0;
        for (point, leaving) in self.seen {
            let (ray, span) = self.snapshot.light_rows()[light].segment_from(*point);
            // Not up to a light that lies in a plane but for rounding: on which side it is said to be differs.
            let span = if span.max < 1.0 { Span::until(1.0 - 1e-12) } else { span };
            // What faces a light is not shadowed by its own convex solid.
            let own = leaving.is_some_and(|surface| surface.prim == prim);
            if own && self.outside && self.snapshot.columns().is_convex(prim) {
                continue;
            }
            if let Some(hit) = self.snapshot.cross_part(prim, None, &ray, span, *leaving) {
                blocked += 1;
                let found = holds(occluders, self.snapshot, hit.surface);
                let prims = self.snapshot.prims();
                assert!(found, "{hit:?} on {ray:?}: {leaving:?} {occluders:?} {:#?} {prims:#?}", self.bounds);
            }
        }
        tally.blocked += blocked;
        tally.barely += u32::from(blocked == 1);
    }
}

#[test]
fn what_keeps_light_from_what_is_seen_is_among_its_occluders() {
    let mut tally = Tally::default();
    let mut random = Random(15);
    for _ in 0..4_000 {
        let mut stage = Stage::new(&mut random, 4);
        let aim = *one_of(stage.random, &stage.aims);
        let size = stage.stand.unit * stage.random.power(-3, 4);
        let lights: Vec<Light> = (0..2).map(|_| some_light(stage.random, aim, size)).collect();
        let snapshot = stage.snapshot(&lights, false);
        let view = stage.stand.view.clone();
        let frame = Frame::new(&snapshot, &view);
        let region = *one_of(stage.random, &stage.stand.regions);
        let rays = stage.rays(&frame, &region).into_iter();
        let seen = rays.filter_map(|ray| {
            let hit = snapshot.nearest_in_frame(&ray, Span::AHEAD, None)?;
            Some((ray.at(hit.crossing.t), Some(hit.surface)))
        });
        let seen: Vec<Seen> = seen.collect();
        let visible = seen_in(&frame, &region);
        let met = bounds_of(&snapshot, &seen);
        for bounds in [&visible.points, &met] {
            if !bounds.is_empty() {
                let outside = frame.outside_solids;
                Scene { snapshot: &snapshot, bounds, seen: &seen, outside }.check(&mut tally);
            }
        }
    }
    assert!(tally.blocked > 20_000 && tally.barely > 70, "{tally:?}");
    assert!(tally.open > 3_000 && tally.barely_lit > 150 && tally.unreached > 600, "{tally:?}");
}

/// Bounds of points, shape by shape.
pub(super) fn bounds_of(snapshot: &Snapshot, seen: &[Seen]) -> Vec<PointBounds> {
    let prims = 0..snapshot.prims().len() as u32;
    let own = |prim: u32| {
        seen.iter()
            .filter(move |(_, surface)| surface.is_some_and(|surface| surface.prim == prim))
            .map(|(p, _)| *p)
    };
    let bounds = |prim: u32| {
        let points = own(prim).map(|p| p - snapshot.origin_in_frame());
        PointBounds::new(prim, narrow_box(points))
    };
    prims.filter(|&prim| own(prim).next().is_some()).map(bounds).collect()
}

/// A light of any kind at a point, shining along `way`.
fn light_at(random: &mut Random, position: DVec3, way: DVec3) -> Light {
    let light = some_light(random, DVec3::ZERO, 1.0);
    let mut values = light.values();
    for field in light.kind().fields {
        match field.kind {
            FieldKind::Point => values.set(field.name, Value::Vector(position)),
            // At right angles to the direction.
            FieldKind::Direction if field.name == "horizontal" => {
                values.set(field.name, Value::Vector(way.any_orthogonal_vector()));
            }
            FieldKind::Direction => values.set(field.name, Value::Vector(way)),
            _ => {}
        }
    }
    (light.kind().make)(&values).unwrap()
}

/// Shapes that only just block the segment from a point, which lies outwards in its box, to a light.
fn just_between(random: &mut Random, way: &Ray, reach: f64, outwards: DVec3, unit: f64) -> Vec<Shape> {
    let mut shapes = Vec::new();
    let along = way.direction.normalize();
    for _ in 0..2 {
        let share = match random.bits() % 4 {
            0 => 0.0,
            1 => 1.0,
            2 => random.power(-30, -1),
            _ => 1.0 - random.power(-30, -1),
        };
        let radius = unit * random.power(-12, 4);
        let any = if one_in(random, 4) { random.point() } else { outwards };
        // Beside the segment; beyond its ends only along it.
        let beyond = if share == 0.0 { -along } else { along };
        let ends = share == 0.0 || share == 1.0;
        let aside = if ends { beyond } else { any.reject_from(along).normalize_or(DVec3::X) };
        let (at, off) = (way.at(reach * share), radius * (1.0 - hair(random)));
        if one_in(random, 3) {
            let shape = some_shape(random, radius);
            shapes.push(moved(&shape, at + aside * (off - radius) - farthest(&shape, -aside)));
        } else {
            shapes.push(Sphere::new(at + aside * off, radius).unwrap().into());
        }
    }
    let normal = match random.bits() % 3 {
        0 => along,
        1 => -random.point().abs() * outwards.signum(),
        _ => random.point(),
    };
    let at =
        way.at(reach * if one_in(random, 2) { random.power(-40, 0) } else { 1.0 - random.power(-40, -1) });
    shapes.push(some_plane(random, at, normal, unit));
    shapes
}

#[test]
fn what_stands_between_a_box_and_a_light_is_among_its_occluders() {
    let mut tally = Tally::default();
    let mut random = Random(16);
    for _ in 0..6_000 {
        let random = &mut random;
        let unit = random.power(-6, 6);
        let size = unit * random.power(-30, 1);
        let center =
            if one_in(random, 3) { DVec3::ZERO } else { random.point() * unit * random.power(-3, 3) };
        let points = some_box(random, center, size);
        let outwards = signs(random);
        let point = corner(points, outwards);
        let aslant = random.point();
        let way =
            if one_in(random, 4) { aslant } else { aslant.reject_from(outwards) }.normalize_or(DVec3::X);
        let far = unit * random.power(-6, 8);
        let from_center = if one_in(random, 2) { points.centre() } else { point };
        let light = light_at(random, from_center + way * far, -way);
        let ray = light.position().map_or(Ray::new(point, way), |position| Ray::new(point, position - point));
        let reach = if light.position().is_some() { 1.0 } else { far };
        let shapes = just_between(random, &ray, reach, outwards, unit);
        let snapshot = snapshot_of(&shapes, &[light], false, None);
        let own = |p: DVec3| p - snapshot.origin();
        let bounds = PointBounds::new(NOTHING, narrow_box(points.corners().map(own)));
        let mut seen: Vec<Seen> = (0..6).map(|_| (corner(points, signs(random)), None)).collect();
        seen.push((point, None));
        let seen: Vec<Seen> = seen.iter().map(|(p, none)| (*p - snapshot.frame(), *none)).collect();
        // A second place, away from the first.
        let other = PointBounds::new(NOTHING, narrow_box([own(center + random.point() * unit * 8.0)]));
        let both = if one_in(random, 2) { vec![bounds, other] } else { vec![other, bounds] };
        Scene { snapshot: &snapshot, bounds: &both, seen: &seen, outside: false }.check(&mut tally);
    }
    assert!(tally.blocked > 40_000 && tally.barely > 600, "{tally:?}");
}

#[test]
fn what_the_rim_of_a_cone_lights_is_reached() {
    let mut tally = Tally::default();
    let mut random = Random(17);
    for _ in 0..6_000 {
        let random = &mut random;
        let size = random.power(-20, 3);
        let center = random.point() * random.power(-3, 3);
        let points = some_box(random, center, size);
        let outwards = signs(random);
        let point = corner(points, outwards);
        // The axis lies outwards of the point, the point on the rim.
        let position = point + random.point() * random.power(-3, 10);
        let light = light_at(random, position, DVec3::X);
        let Some(Value::Number(outer)) = light.values().get("outer").cloned() else { continue };
        let to_point = (point - position).normalize();
        let aside = outwards.reject_from(to_point).normalize_or(DVec3::X);
        // Some shine into all but a full turn.
        let (outer, angle) = if one_in(random, 3) {
            (TAU - random.power(-14, -4), PI - random.power(-16, -5))
        } else {
            (outer, outer / 2.0 * (1.0 - hair(random)))
        };
        let axis = to_point * angle.cos() + aside * angle.sin();
        let fields = [("inner", 0.0), ("outer", outer), ("inner", outer)];
        let set = |light: Light, (field, angle)| light.with(field, Value::Number(angle)).unwrap();
        let light = fields.into_iter().fold(light, set).with("direction", Value::Vector(axis)).unwrap();
        let snapshot = snapshot_of(&[], &[light], false, None);
        let bounds = [PointBounds::new(NOTHING, narrow_box(points.corners()))];
        let mut seen: Vec<Seen> = (0..6).map(|_| (corner(points, signs(random)), None)).collect();
        seen.push((point, None));
        Scene { snapshot: &snapshot, bounds: &bounds, seen: &seen, outside: true }.check(&mut tally);
    }
    assert!(tally.barely_lit > 150 && tally.differently_lit > 800 && tally.unreached > 25, "{tally:?}");
}
