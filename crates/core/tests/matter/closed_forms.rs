//! Laws of optics, by their formulas.

use std::f64::consts::PI;

use catoptra_core::glam::DVec3;
use catoptra_core::lobe::fresnel::{dielectric, mean_dielectric};
use catoptra_core::lobe::local::LocalLobe;
use catoptra_core::lobe::{RoughDiffuse, SmoothInterface, ThinWall};
use catoptra_core::{Material, Rgb, SurfacePoint, Value};

use super::cubature::{Patch, over_side};
use super::{direction, material, number, seen_under, white};

/// Fresnel's formulas as they are written, by angles, degrees: perpendicular and parallel.
fn by_angles(degrees: f64, n: f64) -> [f64; 2] {
    let i = degrees.to_radians();
    let t = (i.sin() / n).asin();
    if degrees == 0.0 {
        return [((n - 1.0) / (n + 1.0)).powi(2); 2];
    }
    [((i - t).sin() / (i + t).sin()).powi(2), ((i - t).tan() / (i + t).tan()).powi(2)]
}

#[test]
fn a_slab_lets_through_what_its_faces_leave() {
    let n = 1.52;
    let pane = material("glass", &[("ior", number(n)), ("thin", Value::Flag(true))]);
    // Both faces once, and all orders.
    let known = [
        (0.0, 0.9167, 0.9183),
        (30.0, 0.9137, 0.9154),
        (45.0, 0.8967, 0.8993),
        (60.0, 0.8236, 0.8307),
        (70.0, 0.6811, 0.7025),
        (80.0, 0.3709, 0.4379),
    ];
    for (degrees, once, all) in known {
        let cosine = f64::to_radians(degrees).cos();
        let [s, p] = by_angles(degrees, n);
        let face = dielectric(cosine, n);
        assert!((face - f64::midpoint(s, p)).abs() < 1e-12, "{degrees}");
        let into =
            SmoothInterface { eta: n, tint: Rgb::WHITE }.rays(direction(cosine, 0.0)).refracted.unwrap();
        let within = DVec3::new(into.0.x, into.0.y, -into.0.z);
        let out = SmoothInterface { eta: 1.0 / n, tint: Rgb::WHITE }.rays(within).refracted.unwrap();
        assert!(((into.1 * out.1).r - (1.0 - face).powi(2)).abs() < 1e-12, "{degrees}");
        assert!(((into.1 * out.1).r - once).abs() < 5e-5, "{degrees}");
        let rays = pane.bsdf(&seen_under(cosine)).rays();
        let [reflected, through] =
            [false, true].map(|t| rays.iter().find(|r| r.is_transmitted == t).unwrap());
        assert!((through.weight.g - all).abs() < 5e-5, "{degrees}: {}", through.weight.g);
        assert!((through.weight.g - (1.0 - face) / (1.0 + face)).abs() < 1e-12);
        assert!((reflected.weight.g + through.weight.g - 1.0).abs() < 1e-12);
        assert!(through.direction.distance(-direction(cosine, 0.0)) < 1e-12);
    }
}

#[test]
fn a_wall_absorbs_along_the_way_through_it() {
    let wall = ThinWall { eta: 1.5, tint: Rgb::new(0.25, 1.0, 0.0), facets: None };
    let [reflected, through] = wall.shares(0.5);
    let face = dielectric(0.5, 1.5);
    let t = 0.25_f64.powf(1.0 / (1.0 - 0.75 / 2.25_f64).sqrt());
    // Order by order.
    let orders = |first: f64| (0..40).map(|k| first * (face * t).powi(2 * k)).sum::<f64>();
    assert!((through.r - orders((1.0 - face).powi(2) * t)).abs() < 1e-12);
    assert!((reflected.r - face - orders((1.0 - face).powi(2) * face * t * t)).abs() < 1e-12);
    assert!((through.b, reflected.b) == (0.0, face));
}

#[test]
fn at_brewsters_angle_one_polarisation_goes_through_whole() {
    for n in [1.33, 1.5, 2.42_f64] {
        let [s, p] = by_angles(n.atan().to_degrees(), n);
        assert!(p < 1e-28);
        // Half of what is left of the other: ((n² − 1)/(n² + 1))².
        let expected = 0.5 * ((n * n - 1.0) / (n * n + 1.0)).powi(2);
        let found = dielectric(n.atan().cos(), n);
        assert!((found - 0.5 * s).abs() < 1e-14 && (found - expected).abs() < 1e-14, "{n}");
    }
}

#[test]
fn beyond_the_critical_angle_all_is_reflected() {
    for n in [1.33, 1.5, 2.42_f64] {
        let critical = (1.0 / n).asin();
        assert!(dielectric((critical + 1e-6).cos(), 1.0 / n) == 1.0);
        assert!(dielectric((critical - 1e-6).cos(), 1.0 / n) < 0.999);
        let glass = material("glass", &[("ior", number(n))]);
        let inside = |angle: f64| {
            let mut at = seen_under(angle.cos());
            at.shading.front = false;
            glass.bsdf(&at).rays()
        };
        let [beyond, before] = [inside(critical + 1e-6), inside(critical - 1e-6)];
        assert!(beyond.len() == 1 && (beyond[0].weight.g - 1.0).abs() < 1e-15 && !beyond[0].is_transmitted);
        assert!(before.len() == 2 && before[1].is_transmitted);
        let flat = (1.0 - (n * (critical - 1e-6).sin()).powi(2)).sqrt();
        assert!((before[1].direction.z + flat).abs() < 1e-9 && flat < 3e-3);
    }
}

#[test]
fn through_a_chain_of_slabs_the_sine_times_the_index_stays() {
    let indices = [1.0, 1.33, 1.52, 2.42, 1.1, 1.0];
    let (mut to_viewer, sine) = (direction(0.6, 0.3), 0.8);
    for pair in indices.windows(2) {
        // Seen from outside of the next solid, which the last one surrounds.
        let glass = material("glass", &[("ior", number(pair[1]))]);
        let mut at = seen_under(1.0);
        at.shading.to_viewer = to_viewer.into();
        let at = SurfacePoint { outside_ior: pair[0], ..at };
        let ray = glass.bsdf(&at).rays().into_iter().find(|ray| ray.is_transmitted).unwrap();
        assert!((ray.direction.truncate().length() * pair[1] - sine).abs() < 1e-14, "{pair:?}");
        to_viewer = -ray.direction;
    }
    assert!(to_viewer.distance(direction(0.6, 0.3)) < 1e-14);
}

#[test]
fn absorption_is_what_leaves_the_tint() {
    let tint = Rgb::new(0.5, 0.25, 1.0);
    let given = [("tint", Value::Color(tint)), ("tint-distance", number(0.1)), ("priority", number(2.0))];
    let medium = material("glass", &given).medium().unwrap();
    // Through the middle of a ball of 0.1 m radius, and through a slab of 0.1 m under an angle.
    let left = |metres: f64| medium.absorption.map(|a| (-a * metres).exp());
    assert!((left(0.2).r - 0.25).abs() < 1e-15 && (left(0.2).g - 0.0625).abs() < 1e-15 && left(0.2).b == 1.0);
    let within = (1.0 - (0.8_f64 / 1.5).powi(2)).sqrt();
    assert!((left(0.1 / within).r - 0.5_f64.powf(1.0 / within)).abs() < 1e-15);
    assert_eq!((medium.ior, medium.priority), (1.5, 2));
    assert_eq!(material("glass", &[("thin", Value::Flag(true))]).medium(), None);
    assert_eq!(material("plastic", &[("color", white())]).medium(), None);
}

#[test]
fn the_mean_of_fresnels_share_is_that_of_the_closed_form() {
    // Walsh, *The reflection factor of a polished glass surface for diffused light*, 1926.
    for n in [1.2, 1.5, 2.0, 2.42_f64] {
        let (n2, n4) = (n * n, n * n * n * n);
        let mean = 0.5
            + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0).powi(2))
            + n2 * (n2 - 1.0).powi(2) / (n2 + 1.0).powi(3) * ((n - 1.0) / (n + 1.0)).ln()
            - 2.0 * n * n2 * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n4 - 1.0))
            + 8.0 * n4 * (n4 + 1.0) / ((n2 + 1.0) * (n4 - 1.0).powi(2)) * n.ln();
        assert!((mean_dielectric(n) - mean).abs() < 1e-6, "{n}: {} and {mean}", mean_dielectric(n));
    }
}

#[test]
fn a_rough_matte_surface_keeps_its_energy_and_its_mean() {
    for roughness in [0.0, 0.3, 0.7, 1.0] {
        // What single scattering leaves of white, by the formula.
        let once = (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * PI)) * roughness)
            / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * roughness);
        for color in [1.0, 0.5, 0.1] {
            let diffuse = RoughDiffuse::new(Rgb::grey(color), roughness);
            let albedo = |cosine: f64| diffuse.albedo(direction(cosine, 0.0)).g;
            for cosine in [0.05, 0.4, 0.9] {
                let o = direction(cosine, 0.0);
                let sum = over_side(DVec3::Z, 1e-6, |i| diffuse.evaluate(o, i).g);
                assert!((sum - albedo(cosine)).abs() < 1e-4, "{roughness} {color} {cosine}: {sum}");
                assert!(color < 1.0 || (sum - 1.0).abs() < 1e-4, "{roughness} {cosine}: {sum}");
            }
            let all = Patch { from: [0.0, 0.0], size: [1.0, 1.0] };
            let mean = all.integral(1e-9, &|cosine, _| 2.0 * cosine * albedo(cosine));
            let expected = color * once + color * color * once * (1.0 - once) / (1.0 - color * (1.0 - once));
            assert!((mean - expected).abs() < 1e-6, "{roughness} {color}: {mean}, not {expected}");
        }
    }
}

#[test]
fn metals_by_name_have_the_colour_of_the_name() {
    let head_on = |preset: &str| {
        let metal = material("metal", &[("preset", Value::Word(preset.into())), ("roughness", number(0.0))]);
        metal.bsdf(&seen_under(1.0)).rays()[0].weight
    };
    let gold = head_on("gold");
    assert!(gold.r > gold.g && gold.g > 2.0 * gold.b, "{gold:?}");
    assert!(head_on("silver").b > 0.9 && head_on("copper").r > 1.4 * head_on("copper").g);
    let edge = Rgb::new(1.0, 0.5, 0.25);
    let metal = material(
        "metal",
        &[("color", Value::Color(Rgb::grey(0.6))), ("edge", Value::Color(edge)), ("roughness", number(0.0))],
    );
    let seen = metal.bsdf(&seen_under(1.0 / 7.0)).rays()[0].weight;
    let schlick = 0.6 + 0.4 * (6.0 / 7.0_f64).powi(5);
    for (seen, edge) in seen.to_array().into_iter().zip(edge.to_array()) {
        assert!((seen - schlick * edge).abs() < 1e-12, "{seen}");
    }
    let both = metal.values().with("preset", Value::Word("gold".into()));
    let refused = (metal.kind().make)(&both).unwrap_err().to_string();
    assert_eq!(refused, "preset must be given alone, not beside color");
}

#[test]
fn old_materials_have_the_same_look_as_in_lanes() {
    let color = Rgb::new(0.8, 0.5, 0.2);
    let phong = [
        ("diffuse", Value::Color(color)),
        ("ambient", Value::Color(Rgb::grey(0.25))),
        ("reflectiveness", number(0.25)),
    ];
    let old: [(&str, &[(&'static str, Value)]); 3] =
        [("matte", &[("color", Value::Color(color))]), ("phong", &phong), ("mirror", &[])];
    for (kind, given) in old {
        let material: Material = material(kind, given);
        assert!(!material.needs_bsdf());
        let at = seen_under(0.7);
        let (lobes, bsdf) = (material.lobes(&at.shading), material.bsdf(&at));
        for k in 0..20 {
            let i = direction(0.05 * f64::from(k) + 0.01, f64::from(k));
            let expected = DVec3::from(lobes.evaluate(&at.shading, i.into(), i.z)) * lobes.share;
            let found = DVec3::from(bsdf.evaluate(i).to_array());
            assert!(found.distance(expected) < 1e-14, "{kind} {i}: {found}, not {expected}");
            assert_eq!(bsdf.evaluate(-i), Rgb::BLACK);
        }
        let share = |v| DVec3::from(v) * lobes.share;
        assert_eq!(DVec3::from(bsdf.ambient.to_array()), share(lobes.ambient), "{kind}");
        let diffuse = lobes.diffuse.map_or(DVec3::ZERO, |d| share(d.albedo));
        assert_eq!(DVec3::from(bsdf.diffuse().to_array()), diffuse);
        let mirrored: Vec<DVec3> = bsdf.rays().iter().map(|ray| DVec3::from(ray.weight.to_array())).collect();
        assert_eq!(mirrored, lobes.mirror.map(|m| DVec3::from(m.tint)).into_iter().collect::<Vec<_>>());
    }
}

#[test]
fn directions_that_leave_the_shape_on_the_wrong_side_bring_no_light() {
    let plastic = material("plastic", &[("color", white())]);
    let at = SurfacePoint { geometric: direction(0.9, 0.0), ..seen_under(0.5) };
    let bsdf = plastic.bsdf(&at);
    // Above the smooth surface and below the shape's own, and the other way round.
    let between = direction(0.3, PI);
    assert!(between.z > 0.0 && between.dot(at.geometric) < 0.0);
    assert_eq!((bsdf.evaluate(between), bsdf.pdf(between)), (Rgb::BLACK, 0.0));
    assert!(bsdf.evaluate(direction(0.3, 0.0)).g > 0.0);
    for k in 0..1000 {
        let u = [0.618, 0.755].map(|step| (step * f64::from(k)).fract());
        if let Some(scattered) = bsdf.sample((0.57 * f64::from(k)).fract(), u) {
            assert!(scattered.direction.dot(at.geometric) > 0.0);
        }
    }
}

#[test]
fn in_matter_of_its_own_index_glass_is_not_seen() {
    let glass = material("glass", &[("ior", number(1.33))]);
    let at = SurfacePoint { outside_ior: 1.33, ..seen_under(0.6) };
    let rays = glass.bsdf(&at).rays();
    let straight = rays.iter().find(|ray| ray.is_transmitted).unwrap();
    assert_eq!((straight.weight, rays.len()), (Rgb::WHITE, 1));
    assert!(straight.direction.distance(-at.to_viewer()) < 1e-15);
}

#[test]
fn what_is_mirrored_is_not_ambient_as_well() {
    for roughness in [0.0, 0.1, 0.3, 0.5, 0.9] {
        for kind in ["plastic", "metal", "rubber"] {
            let bsdf = material(kind, &[("color", white()), ("roughness", number(roughness))])
                .bsdf(&seen_under(0.6));
            let rays: f64 = bsdf.rays().iter().map(|ray| ray.weight.g).sum();
            assert!(
                (bsdf.ambient.g + rays - 1.0).abs() < 2e-3,
                "{kind} {roughness}: {} and {rays}",
                bsdf.ambient.g
            );
            assert_eq!(roughness < 0.4, rays > 0.0, "{kind} {roughness}");
        }
    }
}
