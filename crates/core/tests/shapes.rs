//! Does every shape keep the promises that all shapes give? Each test loops over samples of every kind.
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod samples;

use catoptra_core::geometry::Plane;
use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{Crossing, Placement, Ray, Shape, Span};
use proptest::prelude::*;
use samples::{Draw, Form, Sample, samples, samples_of};

/// Unit roundoff of `f64`.
const U: f64 = f64::EPSILON / 2.0;

fn within(range: f64) -> impl Strategy<Value = DVec3> {
    let number = -range..range;
    (number.clone(), number.clone(), number).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn direction() -> impl Strategy<Value = DVec3> {
    within(1.0).prop_filter("a direction", |d| d.length() > 0.1)
}

fn draw() -> impl Strategy<Value = Draw> {
    (direction(), 1.1..30.0, any::<usize>(), (0.0..1.0, 0.0..1.0), 0.1..5.0).prop_map(
        |(from, distance, pick, (u, v), stretch)| Draw {
            from,
            distance,
            pick,
            at: DVec2::new(u, v),
            stretch,
        },
    )
}

fn placement() -> impl Strategy<Value = Placement> {
    (within(100.0), direction(), -3.0..3.0, -2.0..2.0).prop_map(|(by, axis, angle, digits)| {
        let scaled = Placement::IDENTITY.scaled(10_f64.powf(digits)).unwrap();
        scaled.turned(DVec3::ZERO, axis, angle).unwrap().moved(by).unwrap()
    })
}

/// What rounding may do to a crossing: the share of unit roundoffs is generous, the scale is that of the numbers
/// that took part. A slanting ray moves along the surface by so much more than across it.
fn tolerance(sample: &Sample, ray: &Ray, crossing: &Crossing) -> f64 {
    let scale = ray.origin.length() + ray.at(crossing.t).length() + sample.form.largest_coordinate();
    64.0 * U * scale / slant(ray, crossing).abs().max(U)
}

/// Cosine between ray and normal: negative where the ray goes in.
fn slant(ray: &Ray, crossing: &Crossing) -> f64 {
    ray.direction.normalize().dot(crossing.normal)
}

fn all_crossings(shape: &Shape, ray: &Ray) -> Vec<Crossing> {
    let mut ahead = Span::AHEAD;
    std::iter::from_fn(|| {
        let crossing = shape.cross(ray, ahead, None)?;
        ahead.min = crossing.latest();
        Some(crossing)
    })
    .take(20)
    .collect()
}

/// Whether two crossings are one, however it was found.
fn same(a: Option<&Crossing>, b: Option<&Crossing>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => a.facet == b.facet && (a.t - b.t).abs() <= a.error + b.error,
        (a, b) => a.is_none() && b.is_none(),
    }
}

#[test]
fn every_kind_has_samples() {
    for kind in Shape::KINDS {
        let samples = samples_of(kind.name);
        assert!(!samples.is_empty(), "tests/samples has no {}", kind.name);
        assert!(samples.iter().all(|sample| sample.shape.kind_name() == kind.name));
    }
}

#[test]
fn values_make_an_equal_shape() {
    for Sample { shape, .. } in samples() {
        assert_eq!((shape.kind().make)(&shape.values()).unwrap(), shape);
    }
}

#[test]
fn bounds_are_the_smallest_box() {
    for Sample { shape, form } in samples() {
        let (bounds, expected) = (shape.bounds(), form.bounds());
        assert_eq!(bounds.is_some(), expected.is_some(), "{shape:?}");
        let (Some(bounds), Some((min, max))) = (bounds, expected) else { continue };
        let slack = 4.0 * U * form.largest_coordinate();
        let off = (bounds.min - min).abs().max((bounds.max - max).abs()).max_element();
        assert!(off <= slack, "{off} off: {bounds:?} of {shape:?}");
    }
}

#[test]
fn rays_that_are_none_cross_nothing() {
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    let spans = [Span::AHEAD, Span { min: f64::NEG_INFINITY, max: f64::INFINITY }];
    for Sample { shape, form } in samples() {
        let good = Ray::new(form.middle() + DVec3::new(0.1, 3.0, 0.2) * form.reach(), DVec3::NEG_Y);
        let mut rays = vec![Ray::new(good.origin, DVec3::ZERO), Ray::new(form.middle(), -DVec3::ZERO)];
        for (axis, value) in (0..3).flat_map(|axis| bad.map(|value| (axis, value))) {
            let mut ray = good;
            ray.origin[axis] = value;
            rays.push(ray);
            for direction in [good.direction, DVec3::ZERO] {
                let mut ray = Ray::new(good.origin, direction);
                ray.direction[axis] = value;
                rays.push(ray);
            }
        }
        for ray in rays {
            for span in spans {
                for leaving in [None, Some(0), Some(3)] {
                    let crossing = shape.cross(&ray, span, leaving);
                    assert!(crossing.is_none(), "{ray:?} crosses {shape:?}: {crossing:?}");
                }
            }
        }
    }
}

#[test]
fn a_span_that_is_none_holds_no_crossing() {
    for sample in samples() {
        let ray = Ray::new(
            sample.form.middle() + DVec3::new(0.1, 3.0, 0.2) * sample.form.reach(),
            DVec3::new(-0.05, -1.0, -0.03),
        );
        for (min, max) in [(f64::NAN, 1e9), (0.0, f64::NAN), (2.0, 1.0), (1.0, 1.0), (-9.0, 0.0)] {
            assert!(sample.shape.cross(&ray, Span { min, max }, None).is_none(), "{min} {max} {sample:?}");
        }
    }
}

#[test]
fn a_ray_through_an_edge_or_a_corner_gets_into_a_solid() {
    for sample in samples().into_iter().filter(|sample| sample.shape.is_closed()) {
        let Form::Faces(faces) = &sample.form else { continue };
        let inside = sample.form.middle();
        for (i, (_, [a, b, _])) in faces.iter().enumerate() {
            for step in 0..=20 {
                let rim = a.lerp(*b, f64::from(step) / 20.0);
                let origin = inside + (rim - inside) * (1.5 + i as f64);
                let ray = Ray::new(origin, inside - origin);
                let crossing = sample.shape.cross(&ray, Span::until(1.0), None);
                assert!(crossing.is_some(), "{ray:?} slips into {:?}", sample.shape);
            }
        }
    }
}

#[test]
fn no_ray_gets_out_of_a_closed_shape_unmet() {
    keep_in(20_000);
}

#[test]
#[ignore = "takes minutes"]
fn no_ray_of_a_million_gets_out_of_a_closed_shape_unmet() {
    keep_in(1_000_000);
}

/// From random points about the middle to random sides, and to points where facets meet: each way out is met, and once.
fn keep_in(rays: u32) {
    for sample in samples().into_iter().filter(|sample| sample.shape.is_closed()) {
        let mut state = 1_u64;
        let mut number = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let seams = sample.form.seams();
        for i in 0..rays {
            let away = DVec3::new(number() - 0.5, number() - 0.5, number() - 0.5);
            let (inside, sees_all) = sample.form.inside();
            let from = inside + away * (0.1 * sample.form.depth());
            let seam = if seams.is_empty() { None } else { Some(seams[i as usize % seams.len()]) };
            let direction = match seam {
                Some([a, b]) if i % 2 == 0 => a.lerp(b, number()) - from,
                _ => DVec3::new(number() - 0.5, number() - 0.5, number() - 0.5),
            };
            let ray = Ray::new(from, direction);
            let Some(out) = sample.shape.cross(&ray, Span::AHEAD, None) else {
                panic!("{ray:?} gets out of {:?}", sample.shape)
            };
            let next = Span { min: out.latest(), ..Span::AHEAD };
            let again = sample.shape.cross(&ray, next, None);
            if sees_all {
                assert!(again.is_none(), "{ray:?} is out twice of {:?}", sample.shape);
            } else {
                let count = all_crossings(&sample.shape, &ray).len();
                assert!(count % 2 == 1, "{ray:?} crosses {:?} {count} times", sample.shape);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_crossing_lies_on_the_surface_and_knows_its_normal(draw in draw(), at in placement()) {
        for sample in samples().into_iter().flat_map(|sample| [sample.placed(&at), sample]) {
            let ray = sample.aimed(&draw);
            for crossing in all_crossings(&sample.shape, &ray) {
                let (point, facet) = (ray.at(crossing.t), crossing.facet);
                let tolerance = tolerance(&sample, &ray, &crossing);
                let off = sample.form.distance(point, facet);
                prop_assert!(off <= tolerance, "{off} off, {tolerance} allowed: {crossing:?} of {ray:?} on {sample:?}");
                let normal = sample.form.normal(point, facet);
                prop_assert!(crossing.normal.distance(normal) < 1e-9, "{normal} is out: {crossing:?} on {sample:?}");
                prop_assert!((crossing.normal.length() - 1.0).abs() < 32.0 * U);
                prop_assert!((crossing.shading_normal.length() - 1.0).abs() < 32.0 * U);
                prop_assert!(crossing.shading_normal.dot(crossing.normal) > 0.0);
                let margin = tolerance / sample.form.reach();
                prop_assert!(crossing.uv.min_element() >= -margin && crossing.uv.max_element() <= 1.0 + margin);
            }
        }
    }

    #[test]
    fn texture_coordinates_run_along_the_surface(draw in draw(), at in placement()) {
        for sample in samples().into_iter().flat_map(|sample| [sample.placed(&at), sample]) {
            let ray = sample.aimed(&draw);
            for crossing in all_crossings(&sample.shape, &ray) {
                let (point, facet) = (ray.at(crossing.t), crossing.facet);
                let found = sample.shape.parametrization(point, facet);
                prop_assert_eq!(sample.shape.uv_and_tangent(point, facet), (found.uv, found.along_u));
                let kind = sample.shape.kind_name();
                if ["rectangle", "mesh"].contains(&kind) && crossing.uv != DVec2::ZERO {
                    prop_assert!(found.uv.distance(crossing.uv) < 1e-6, "{found:?} of {crossing:?}");
                }
                let whole = found.uv.min_element() > -1e-6 && found.uv.max_element() < 1.0 + 1e-6;
                prop_assert!(whole || ["plane", "mesh"].contains(&kind), "{kind}: {}", found.uv);
                let (u, v) = (found.along_u, found.along_v);
                let tangent = found.tangent(crossing.normal);
                prop_assert!((tangent.length() - 1.0).abs() < 1e-12 && tangent.dot(crossing.normal).abs() < 1e-9);
                let across = |w: DVec3| w.dot(crossing.normal).abs() <= 1e-6 * w.length() + 1e-12;
                prop_assert!(across(u) && across(v), "{found:?} leaves {kind}");
                // Away from poles and middles, where one of the two has no direction.
                if u.cross(v).length() < 1e-2 * u.length() * v.length() || u.length().min(v.length()) < 1e-3 * u.length().max(v.length()) {
                    continue;
                }
                let is_disk = kind == "disk" || (["cylinder", "cone"].contains(&kind) && facet > 0);
                if !is_disk && kind != "mesh" {
                    prop_assert!(u.cross(v).dot(crossing.normal) > 0.0, "{kind} is mirrored");
                }
                let step = 1e-4;
                let moved = |by: DVec3| sample.shape.parametrization(point + by * step, facet).uv - found.uv;
                let [by_u, by_v] = found.footprint([u, v]);
                prop_assert!(by_u.distance(DVec2::X) < 1e-6 && by_v.distance(DVec2::Y) < 1e-6, "{by_u} {by_v}");
                for (is, right) in [(moved(u), DVec2::X), (moved(v), DVec2::Y)] {
                    // Longitudes and angles begin again after 1: of a torus both coordinates are angles.
                    let again = |by: f64| if by.abs() > 0.5 { by - by.signum() } else { by };
                    let is = DVec2::new(again(is.x), if kind == "torus" { again(is.y) } else { is.y });
                    prop_assert!((is / step).distance(right) < 0.05, "{kind}: {} for {right}", is / step);
                }
            }
        }
    }

    #[test]
    fn a_ray_aimed_at_the_surface_meets_it(draw in draw(), at in placement()) {
        for sample in samples().into_iter().flat_map(|sample| [sample.placed(&at), sample]) {
            let ray = sample.aimed(&draw);
            let Some(crossing) = sample.shape.cross(&ray, Span::AHEAD, None) else {
                return Err(TestCaseError::fail(format!("{ray:?} misses {sample:?}")));
            };
            let target = 1.0 / draw.stretch;
            let tolerance = tolerance(&sample, &ray, &crossing) / ray.direction.length();
            prop_assert!(crossing.t <= target + tolerance, "{crossing:?} behind {target} for {ray:?} on {sample:?}");
        }
    }

    #[test]
    fn a_span_ends_where_it_says(draw in draw()) {
        for sample in samples() {
            let ray = sample.aimed(&draw);
            let crossings = all_crossings(&sample.shape, &ray);
            let mut before = Span::AHEAD.min;
            for (i, crossing) in crossings.iter().enumerate() {
                let cross = |min, max| sample.shape.cross(&ray, Span { min, max }, None);
                let earliest = (crossing.t - crossing.error).next_down();
                let next = crossings.get(i + 1);
                prop_assert!(before < earliest);
                prop_assert!(same(cross(before, crossing.latest()).as_ref(), Some(crossing)));
                prop_assert_eq!(cross(before, earliest), None);
                prop_assert!(same(cross(crossing.latest(), f64::INFINITY).as_ref(), next));
                prop_assert!(same(cross(earliest, f64::INFINITY).as_ref(), Some(crossing)));
                before = crossing.latest();
            }
        }
    }

    #[test]
    fn a_span_ends_exactly_at_a_crossing_that_f64_can_name(height in -20..20, steps in 1..40_u32) {
        let t = f64::from(height).exp2();
        let down = Ray::new(DVec3::new(0.1, t, 0.2), DVec3::NEG_Y);
        let plane = Shape::from(Plane::new(DVec3::ZERO, DVec3::Y).unwrap());
        let next = |t: f64| (0..steps).fold(t, |t, _| t.next_up());
        let last = |t: f64| (0..steps).fold(t, |t, _| t.next_down());
        let is_met = |min, max| plane.cross(&down, Span { min, max }, None).is_some();
        prop_assert!(is_met(t, t));
        prop_assert!(is_met(last(t), next(t)));
        prop_assert!(!is_met(next(t), 1e9));
        prop_assert!(!is_met(0.0, last(t)));
    }

    #[test]
    fn a_ray_from_outside_enters_a_solid_before_it_leaves(draw in draw(), at in placement()) {
        for sample in samples().into_iter().filter(|sample| sample.shape.is_closed()) {
            if !sample.form.is_convex() {
                continue;
            }
            for sample in [sample.placed(&at), sample] {
                // Between the middle and the surface, so that it is a real way through.
                let ray = sample.aimed(&draw);
                let target = sample.form.middle().lerp(ray.at(1.0 / draw.stretch), 0.9);
                let ray = sample.through(target, &draw);
                let crossings = all_crossings(&sample.shape, &ray);
                let ways: Vec<bool> = crossings.iter().map(|crossing| slant(&ray, crossing) < 0.0).collect();
                prop_assert_eq!(ways, [true, false], "{:?} {:?}", ray, sample);
                prop_assert!(crossings[0].t < 1.0 / draw.stretch && 1.0 / draw.stretch < crossings[1].t);
            }
        }
    }

    #[test]
    fn a_ray_from_inside_a_solid_leaves_once(target in direction(), at in placement()) {
        for sample in samples().into_iter().filter(|sample| sample.shape.is_closed()) {
            let sample = sample.placed(&at);
            let (inside, sees_all) = sample.form.inside();
            if !sees_all {
                continue;
            }
            let ray = Ray::new(inside, target);
            let crossings = all_crossings(&sample.shape, &ray);
            prop_assert_eq!(crossings.len(), 1, "{:?} {:?}", ray, sample);
            prop_assert!(slant(&ray, &crossings[0]) > 0.0);
        }
    }

    #[test]
    fn what_is_left_is_not_met_again(draw in draw(), at in placement(), along in direction()) {
        for sample in samples().into_iter().flat_map(|sample| [sample.placed(&at), sample]) {
            let ray = sample.aimed(&draw);
            let Some(crossing) = sample.shape.cross(&ray, Span::AHEAD, None) else { continue };
            let mirrored = ray.direction.reflect(crossing.normal);
            for direction in [along, -along, ray.direction, -ray.direction, mirrored, crossing.normal] {
                let away = Ray::new(ray.at(crossing.t), direction);
                let next = sample.shape.cross(&away, Span::AHEAD, Some(crossing.facet));
                if let Form::Sphere { radius, .. } = sample.form {
                    // The far end of the chord, as known in closed form, or nothing.
                    let chord = -2.0 * radius * slant(&away, &crossing);
                    let slack = 1e-9 * radius + tolerance(&sample, &ray, &crossing);
                    match next {
                        Some(far) => prop_assert!((far.t * direction.length() - chord).abs() < slack),
                        None => prop_assert!(chord < slack, "{away:?} {sample:?}"),
                    }
                } else if let Form::Ring(ring) = &sample.form {
                    // A ball of the tube's radius touches the surface from inside, one as narrow as the hole from outside.
                    let Some(next) = next else { continue };
                    let goes_in = slant(&away, &crossing) < 0.0;
                    let ball = if goes_in { ring.radii[1] } else { ring.radii[0] - ring.radii[1] };
                    let least = 2.0 * ball * slant(&away, &crossing).abs();
                    let slack = 1e-9 * ring.radii[0] + tolerance(&sample, &ray, &crossing);
                    prop_assert!(next.t * direction.length() > least - slack, "{away:?} {next:?} {sample:?}");
                } else if let Form::Round(round) = &sample.form && round.is_curved(crossing.facet) {
                    // Through the solid, if it goes in, and nowhere near where it came from.
                    let Some(next) = next else { continue };
                    let goes_in = slant(&away, &crossing) < 0.0;
                    let middle = away.at(next.t / 2.0);
                    let (inside, slack) = (round.holds(middle), 1e-9 * sample.form.reach());
                    let is_short = next.t * direction.length() < slack;
                    prop_assert!(goes_in && (inside || is_short), "{away:?} {next:?} {sample:?}");
                } else {
                    prop_assert!(next.is_none_or(|next| next.facet != crossing.facet), "{away:?} {sample:?}");
                }
            }
        }
    }

    #[test]
    fn light_between_the_inner_walls_of_a_solid_never_gets_out(along in direction(), at in placement()) {
        for sample in samples().into_iter().filter(|sample| sample.shape.is_closed()) {
            let sample = sample.placed(&at);
            let mut ray = Ray::new(sample.form.inside().0, along.normalize());
            let mut leaving = None;
            for bounce in 0..40 {
                let Some(wall) = sample.shape.cross(&ray, Span::AHEAD, leaving) else {
                    return Err(TestCaseError::fail(format!("out after {bounce} bounces: {ray:?} {sample:?}")));
                };
                ray = Ray::new(ray.at(wall.t), ray.direction.reflect(wall.normal).normalize());
                leaving = Some(wall.facet);
            }
        }
    }

    #[test]
    fn moving_shape_and_ray_together_changes_nothing(draw in draw(), at in placement()) {
        for sample in samples() {
            let ray = sample.aimed(&draw);
            let moved = sample.placed(&at);
            let moved_ray = Ray::new(at.point(ray.origin), at.vector(ray.direction));
            let before = all_crossings(&sample.shape, &ray);
            let after = all_crossings(&moved.shape, &moved_ray);
            prop_assert_eq!(before.len(), after.len(), "{:?} {:?} {:?}", ray, sample, at);
            for (before, after) in before.iter().zip(&after) {
                let own = tolerance(&sample, &ray, before) / ray.direction.length();
                let theirs = tolerance(&moved, &moved_ray, after) / moved_ray.direction.length();
                prop_assert!((before.t - after.t).abs() <= own + theirs, "{before:?} {after:?} {sample:?} {at:?}");
                prop_assert_eq!(before.facet, after.facet);
                let turned = at.direction(before.normal);
                let off = (own + theirs) * ray.direction.length() / sample.form.bend(ray.at(before.t));
                prop_assert!(turned.distance(after.normal) <= 4.0 * off + 1e-12, "{before:?} {after:?} {sample:?}");
                prop_assert!((before.uv - after.uv).abs().max_element() <= off + 1e-12);
            }
        }
    }

    #[test]
    fn a_longer_direction_makes_a_shorter_parameter(draw in draw(), at in placement(), digits in -40..40) {
        let longer = f64::from(digits).exp2();
        for sample in samples().into_iter().flat_map(|sample| [sample.placed(&at), sample]) {
            let ray = sample.aimed(&draw);
            let one = sample.shape.cross(&ray, Span::AHEAD, None);
            let other = sample.shape.cross(&Ray::new(ray.origin, ray.direction * longer), Span::AHEAD, None);
            // Exactly, as a power of two rounds nothing.
            prop_assert_eq!(one.map(|c| c.t), other.map(|c| c.t * longer), "{:?}", sample);
        }
    }

    #[test]
    fn bounds_hold_every_crossing(draw in draw(), at in placement()) {
        for sample in samples().into_iter().flat_map(|sample| [sample.placed(&at), sample]) {
            let Some(bounds) = sample.shape.bounds() else { continue };
            let ray = sample.aimed(&draw);
            for crossing in all_crossings(&sample.shape, &ray) {
                let margin = tolerance(&sample, &ray, &crossing);
                let point = ray.at(crossing.t);
                let inside = (bounds.min - margin).cmple(point).all() && point.cmple(bounds.max + margin).all();
                prop_assert!(inside, "{point} out of {bounds:?} by more than {margin}");
            }
        }
    }

    #[test]
    fn a_placed_shape_is_where_its_points_went(draw in draw(), first in placement(), second in placement()) {
        for sample in samples() {
            let twice = sample.placed(&first).placed(&second);
            let once = sample.placed(&first.then(&second));
            let ray = once.aimed(&draw);
            let (a, b) = (all_crossings(&twice.shape, &ray), all_crossings(&once.shape, &ray));
            prop_assert_eq!(a.len(), b.len());
            for (a, b) in a.iter().zip(&b) {
                let slack = 4.0 * tolerance(&once, &ray, b) / ray.direction.length();
                prop_assert!((a.t - b.t).abs() <= slack + 1e-12 * b.t, "{a:?} {b:?} {sample:?}");
            }
        }
    }
}
