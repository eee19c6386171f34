//! Do lights and materials give what their formulas say, worked out here by other means?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::{FRAC_PI_2, PI};

use catoptra_core::glam::DVec3;
use catoptra_core::material::{Emissive, Matte};
use catoptra_core::{
    Arrival, Emission, Kind, Light, Material, Placement, Rgb, ShadingPoint, Surface, Triple, Value, Values,
};

fn light(kind: &str, values: &Values) -> Light {
    (Light::kind_named(kind).unwrap().make)(values).unwrap()
}

fn material(kind: &str, values: &Values) -> Material {
    (Material::kind_named(kind).unwrap().make)(values).unwrap()
}

fn arriving(light: &Light, point: DVec3) -> Arrival<f64> {
    light.arriving(Triple::from(point))
}

fn vector(v: Triple<f64>) -> DVec3 {
    DVec3::from(v)
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * (1.0 + b.abs())
}

fn all_close(a: Triple<f64>, b: DVec3) -> bool {
    close(a.x, b.x) && close(a.y, b.y) && close(a.z, b.z)
}

const AT: DVec3 = DVec3::new(30.0, 40.0, 20.0);

fn point_light() -> Light {
    let values = Values::new().with("position", Value::Vector(AT));
    light("point-light", &values.with("intensity", Value::Color(Rgb::new(2000.0, 1.0, 0.0))))
}

/// Along −z from `AT`, with cone angles in degrees.
fn spot(inner: f64, outer: f64, falloff: f64) -> Light {
    light(
        "spot-light",
        &Values::new()
            .with("position", Value::Vector(AT))
            .with("direction", Value::Vector(DVec3::NEG_Z * 3.0))
            .with("intensity", Value::Color(Rgb::grey(1000.0)))
            .with("inner", Value::Number(inner.to_radians()))
            .with("outer", Value::Number(outer.to_radians()))
            .with("falloff", Value::Number(falloff)),
    )
}

/// What arrives from a spot at 5 m, `degrees` off its axis, as a share of a point light.
fn share(spot: &Light, degrees: f64) -> f64 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let arrival = arriving(spot, AT + DVec3::new(0.6 * sin, 0.8 * sin, -cos) * 5.0);
    if arrival.lit { spot.irradiance(&arrival).y * 25.0 / 1000.0 } else { 0.0 }
}

/// Those of the values that are fields of a kind.
fn known<P>(kind: &Kind<P>, values: &Values) -> Values {
    let known = values.iter().filter(|(name, _)| kind.field(name).is_some());
    known.fold(Values::new(), |values, (name, value)| values.with(name, value.clone()))
}

#[test]
fn a_point_light_falls_off_with_the_square_of_the_distance() {
    let direction = DVec3::new(2.0, -3.0, 6.0) / 7.0;
    for distance in [1e-3, 0.5, 1.0, 10.0, 53.0, 1e6] {
        let arrival = arriving(&point_light(), AT + direction * distance);
        let expected = DVec3::new(2000.0, 1.0, 0.0) / (distance * distance);
        assert!(arrival.lit);
        assert!(
            (vector(point_light().irradiance(&arrival)) - expected).abs().cmple(expected * 1e-11).all(),
            "{distance}"
        );
        assert!((arrival.distance / distance - 1.0).abs() < 1e-11);
        assert!(all_close(arrival.direction, -direction) || distance < 1.0);
        assert!(close(vector(arrival.direction).length(), 1.0));
    }
}

#[test]
fn nothing_arrives_where_the_light_stands() {
    assert!(!arriving(&point_light(), AT).lit);
    assert!(!arriving(&spot(20.0, 90.0, 1.0), AT).lit);
}

#[test]
fn a_spot_follows_its_formula_between_the_cones() {
    let cos = |degrees: f64| degrees.to_radians().cos();
    for falloff in [0.0, 0.5, 1.0, 2.0, 7.3] {
        let light = spot(20.0, 90.0, falloff);
        for degrees in [10.1, 15.0, 22.5, 30.0, 44.0, 44.99] {
            let expected = ((cos(degrees) - cos(45.0)) / (cos(10.0) - cos(45.0))).powf(falloff);
            let got = share(&light, degrees);
            assert!((got - expected).abs() < 1e-11, "{degrees}° falloff {falloff}: {got}, not {expected}");
        }
    }
}

#[test]
fn a_spot_is_a_point_light_within_its_inner_cone() {
    for degrees in [0.0, 5.0, 9.99] {
        let got = share(&spot(20.0, 90.0, 2.0), degrees);
        assert!(close(got, 1.0), "{degrees}°: {got}");
    }
}

#[test]
fn a_spot_lights_nothing_outside_its_outer_cone() {
    for falloff in [0.0, 1.0] {
        for degrees in [45.01, 60.0, 90.0, 135.0, 180.0] {
            assert!(share(&spot(20.0, 90.0, falloff), degrees) == 0.0, "{degrees}°");
        }
    }
}

#[test]
fn a_spot_with_one_cone_has_a_hard_edge() {
    for angle in [0.01, 60.0, 180.0, 270.0] {
        let light = spot(angle, angle, 1.0);
        assert!(close(share(&light, angle * 0.499), 1.0), "{angle}°");
        assert!(share(&light, angle * 0.501) == 0.0, "{angle}°");
    }
}

#[test]
fn a_cone_of_more_than_a_half_sphere_lights_what_is_behind() {
    let light = spot(200.0, 300.0, 1.0);
    assert!(close(share(&light, 99.0), 1.0));
    assert!(share(&light, 120.0) > 0.0 && share(&light, 149.0) > 0.0);
    assert!(share(&light, 151.0) == 0.0);
}

#[test]
fn directional_light_is_the_same_everywhere() {
    let direction = DVec3::new(-30.0, -40.0, -20.0);
    let values = Values::new().with("direction", Value::Vector(direction));
    let sun = light("directional-light", &values.with("irradiance", Value::Color(Rgb::new(1.0, 2.0, 3.0))));
    for point in [DVec3::ZERO, AT, DVec3::splat(-1e9)] {
        let arrival = arriving(&sun, point);
        assert!(arrival.lit && arrival.distance.is_infinite());
        assert!(vector(sun.irradiance(&arrival)) == DVec3::new(1.0, 2.0, 3.0));
        assert!(all_close(arrival.direction, -direction.normalize()));
    }
    assert!(sun.direction().unwrap().distance(direction.normalize()) < 1e-15);
    assert_eq!(sun.position(), None);
}

#[test]
fn ambient_light_comes_from_no_direction_and_is_all_there_is_of_it() {
    let ambient = light("ambient-light", &Values::new().with("radiance", Value::Color(Rgb::grey(0.1))));
    assert_eq!(ambient.ambient(), Rgb::grey(0.1));
    assert!(!arriving(&ambient, AT).lit);
    assert!(!ambient.shadow());
    for other in [point_light(), spot(20.0, 90.0, 1.0)] {
        assert_eq!(other.ambient(), Rgb::BLACK);
    }
}

#[test]
fn every_light_moves_with_its_placement() {
    let at = Placement::IDENTITY.turned(DVec3::ONE, DVec3::new(1.0, -2.0, 0.5), 2.2).unwrap();
    let at = at.moved(DVec3::new(5.0, -6.0, 7.0)).unwrap();
    let sun = Values::new().with("direction", Value::Vector(AT));
    let sun = light("directional-light", &sun.with("irradiance", Value::Color(Rgb::WHITE)));
    let point = AT + DVec3::new(0.5, -0.25, -2.0);
    for light in [point_light(), spot(10.0, 60.0, 1.5), sun] {
        let (before, after) = (arriving(&light, point), arriving(&light.placed(&at), at.point(point)));
        assert!(before.lit && after.lit);
        assert!(all_close(after.direction, at.direction(vector(before.direction))), "{light:?}");
        assert!(all_close(light.irradiance(&after), vector(light.irradiance(&before))), "{light:?}");
        assert!(after.distance == before.distance || close(after.distance, before.distance), "{light:?}");
    }
}

#[test]
fn the_shadow_switch_is_kept() {
    for kind in Light::KINDS.iter().filter(|kind| kind.field("shadow").is_some()) {
        let one = || Value::Color(Rgb::WHITE);
        let mut values = Values::new().with("irradiance", one());
        if kind.field("direction").is_some_and(|field| !field.may_be_missing) {
            values.set("direction", Value::Vector(DVec3::NEG_Y));
        }
        let values = values.with("intensity", one()).with("inner", Value::Number(0.1));
        let values = values.with("outer", Value::Number(0.2)).with("radiance", one());
        let values = values.with("edge-u", Value::Vector(DVec3::X)).with("edge-v", Value::Vector(DVec3::Y));
        let values = values.with("corner", Value::Vector(DVec3::ZERO)).with("radius", Value::Number(1.0));
        let values = known(kind, &values);
        assert!((kind.make)(&values).unwrap().shadow(), "on unless switched off: {}", kind.name);
        assert!(!(kind.make)(&values.with("shadow", Value::Flag(false))).unwrap().shadow(), "{}", kind.name);
    }
}

/// In the plane of x and y, `degrees` from the normal, which is y.
fn off_normal(degrees: f64) -> DVec3 {
    DVec3::new(degrees.to_radians().sin(), degrees.to_radians().cos(), 0.0)
}

fn seen_from(degrees: f64) -> ShadingPoint<f64> {
    ShadingPoint {
        position: Triple::from(DVec3::ZERO),
        normal: Triple::from(DVec3::Y),
        to_viewer: Triple::from(off_normal(degrees)),
        distance: 1.0,
        front: true,
    }
}

/// What is shown of one unit of irradiance from `light` degrees, seen from `viewer` degrees.
fn shown(material: &Material, viewer: f64, light: f64) -> DVec3 {
    let towards = off_normal(light);
    let at = &seen_from(viewer);
    vector(material.lobes(at).evaluate(at, Triple::from(towards), towards.y))
}

fn phong(model: &str, shininess: f64) -> Material {
    material(
        "phong",
        &Values::new()
            .with("ambient", Value::Color(Rgb::new(0.2, 0.4, 0.0)))
            .with("diffuse", Value::Color(Rgb::new(1.0, 0.5, 0.0)))
            .with("specular", Value::Color(Rgb::new(0.0, 0.5, 1.0)))
            .with("shininess", Value::Number(shininess))
            .with("model", Value::Word(model.to_owned())),
    )
}

/// Share of the light from `light` degrees that leaves in any direction, by the midpoint rule; as the half vector
/// does not care which of the two is the light, the viewer goes round instead.
fn reflectance(material: &Material, light: f64) -> DVec3 {
    let (rings, sectors) = (400, 200);
    let mut sum = DVec3::ZERO;
    for ring in 0..rings {
        let polar = (f64::from(ring) + 0.5) / f64::from(rings) * FRAC_PI_2;
        for sector in 0..sectors {
            let (sin, cos) = ((f64::from(sector) + 0.5) / f64::from(sectors) * 2.0 * PI).sin_cos();
            let viewer = DVec3::new(polar.sin() * cos, polar.cos(), polar.sin() * sin);
            let at = ShadingPoint { to_viewer: Triple::from(viewer), ..seen_from(0.0) };
            let towards = off_normal(light);
            let shown = vector(material.lobes(&at).evaluate(&at, Triple::from(towards), towards.y));
            sum += shown / towards.y * polar.cos() * polar.sin();
        }
    }
    sum * (FRAC_PI_2 / f64::from(rings)) * (2.0 * PI / f64::from(sectors))
}

#[test]
fn a_matte_surface_shows_the_cosine_over_pi_from_any_side() {
    let matte = material("matte", &Values::new().with("color", Value::Color(Rgb::new(1.0, 0.5, 0.0))));
    for viewer in [0.0, 30.0, -80.0] {
        for (degrees, cosine) in [(0.0, 1.0), (60.0, 0.5), (-45.0, 0.5_f64.sqrt())] {
            let expected = DVec3::new(1.0, 0.5, 0.0) * cosine / PI;
            assert!(shown(&matte, viewer, degrees).distance(expected) < 1e-15, "{viewer} {degrees}");
        }
    }
    assert_eq!(vector(matte.lobes(&seen_from(0.0)).ambient), DVec3::new(1.0, 0.5, 0.0));
    assert_eq!(vector(matte.lobes(&seen_from(0.0)).emission), DVec3::ZERO);
}

#[test]
fn a_matte_surface_gives_back_its_colour_in_all() {
    let matte = material("matte", &Values::new().with("color", Value::Color(Rgb::new(1.0, 0.5, 0.0))));
    assert!(reflectance(&matte, 40.0).distance(DVec3::new(1.0, 0.5, 0.0)) < 1e-5);
}

#[test]
fn classic_phong_shows_diffuse_and_highlight_at_known_angles() {
    for shininess in [0.0, 1.0, 2.0, 2.5, 16.0, 2000.0] {
        let phong = phong("classic", shininess);
        // Light, viewer, and the angle between their half vector and the normal.
        for (light, viewer, half) in
            [(60.0, -60.0, 0.0), (60.0, 0.0, 30.0), (0.0, 80.0, 40.0), (40.0, 60.0, 50.0)]
        {
            let diffuse = f64::to_radians(light).cos() / PI;
            let highlight = f64::to_radians(half).cos().powf(shininess) / PI;
            let expected = DVec3::new(diffuse, 0.5 * (diffuse + highlight), highlight);
            let got = shown(&phong, viewer, light);
            assert!(
                got.distance(expected) < 1e-12,
                "n {shininess}, {light}° {viewer}°: {got}, not {expected}"
            );
        }
        assert_eq!(vector(phong.lobes(&seen_from(0.0)).ambient), DVec3::new(0.2, 0.4, 0.0));
    }
}

#[test]
fn normalised_phong_is_proportional_to_the_cosine_of_the_light() {
    for shininess in [0.0, 2.5, 16.0] {
        let phong = phong("normalised", shininess);
        let peak = shown(&phong, 0.0, 0.0).z;
        for (light, viewer, half) in [(60.0, -60.0, 0.0), (60.0, 0.0, 30.0), (0.0, 80.0, 40.0)] {
            let cosine = f64::to_radians(light).cos();
            let expected = peak * f64::to_radians(half).cos().powf(shininess) * cosine;
            let got = shown(&phong, viewer, light);
            assert!((got.z - expected).abs() < 1e-12 && (got.x - cosine / PI).abs() < 1e-15);
        }
    }
}

#[test]
fn normalised_phong_gives_back_the_light_that_falls_straight_on_it() {
    for shininess in [0.0, 1.0, 4.0, 16.0, 100.0] {
        let all = reflectance(&phong("normalised", shininess), 0.0).z;
        assert!((all - 1.0).abs() < 1e-4, "shininess {shininess}: {all}");
    }
}

#[test]
fn normalised_phong_gives_back_less_than_it_gets_from_the_side() {
    for shininess in [0.0, 4.0, 16.0, 100.0] {
        for light in [20.0, 45.0, 70.0, 85.0] {
            let all = reflectance(&phong("normalised", shininess), light).z;
            assert!(all <= 1.0 + 1e-4, "shininess {shininess}, {light}°: {all}");
        }
    }
}

#[test]
fn checker_squares_alternate_through_the_origin_and_below_it() {
    let values = Values::new().with("scale", Value::Number(0.2));
    let checker = material("checker", &values);
    // Squares of 5 m; odd ones are white.
    for (x, z, white) in [
        (0.1, 0.1, 0.0),
        (-0.1, 0.1, 1.0),
        (0.1, -0.1, 1.0),
        (-0.1, -0.1, 0.0),
        (5.1, 0.1, 1.0),
        (-5.1, 0.1, 0.0),
        (-5.1, -0.1, 1.0),
        (-10.1, -7.0, 1.0),
        (4.9, 4.9, 0.0),
        (5.0, 0.0, 1.0),
        (-5.0, 0.0, 1.0),
        (0.0, 0.0, 0.0),
        (1e6 + 2.5, 2.5, 0.0),
        (-1e6 - 2.5, 2.5, 1.0),
    ] {
        for y in [-3.0, 0.0, 7.0] {
            let at = ShadingPoint { position: Triple::new(x, y, z), ..seen_from(0.0) };
            let expected = DVec3::splat(white);
            assert_eq!(vector(checker.lobes(&at).ambient), expected, "({x}, {y}, {z})");
            let lit = vector(checker.lobes(&at).evaluate(&at, Triple::from(DVec3::Y), 0.5));
            assert!(lit.distance(expected * 0.5 / PI) < 1e-15, "({x}, {y}, {z})");
        }
    }
}

#[test]
fn checker_colours_are_those_given() {
    let (one, other) = (Rgb::new(0.1, 0.2, 0.3), Rgb::new(0.4, 0.5, 0.6));
    let values = Values::new().with("color", Value::Color(one)).with("other", Value::Color(other));
    let checker = material("checker", &values);
    let at = |x| {
        let at = ShadingPoint { position: Triple::new(x, 0.0, 0.5), ..seen_from(0.0) };
        vector(checker.lobes(&at).ambient)
    };
    assert_eq!((at(0.5), at(1.5)), (DVec3::new(0.4, 0.5, 0.6), DVec3::new(0.1, 0.2, 0.3)));
}

#[test]
fn colour_and_depth_follow_the_formula() {
    let color = DVec3::new(1.0, 0.5, 0.25);
    let values = Values::new().with("color", Value::Color(Rgb::new(color.x, color.y, color.z)));
    let depth = material("depth", &values);
    for normal in [DVec3::Y, DVec3::new(-2.0, 1.0, 2.0) / 3.0, DVec3::NEG_ONE.normalize()] {
        for distance in [0.0, 1.0, 15.0, 29.0, 29.9, 30.0, 31.0, 1e9, f64::INFINITY] {
            let at = ShadingPoint { normal: Triple::from(normal), distance, ..seen_from(0.0) };
            let shade = 255.0 - (distance * 255.0 / 30.0).min(255.0);
            let expected = (color * (normal * 10.0 + shade) / 255.0).max(DVec3::ZERO);
            let got = vector(depth.lobes(&at).emission);
            assert!(got.distance(expected) < 1e-14, "{normal} {distance}: {got}, not {expected}");
        }
    }
}

#[test]
fn what_is_not_lit_shows_no_light() {
    let white = || Values::new().with("color", Value::Color(Rgb::WHITE));
    for kind in ["depth", "mirror"] {
        let material = material(kind, &white());
        assert!(!material.lobe_kinds().is_lit());
        assert_eq!(shown(&material, 30.0, 10.0), DVec3::ZERO);
        assert_eq!(vector(material.lobes(&seen_from(0.0)).ambient), DVec3::ZERO);
    }
    assert!(material("matte", &white()).lobe_kinds().is_lit());
}

#[test]
fn a_mirror_reflects_all_in_its_colour_and_others_nothing_unless_told() {
    let share_and_tint = |material: &Material| {
        let lobes = material.lobes(&seen_from(30.0));
        (lobes.share, lobes.mirror.map(|mirror| vector(mirror.tint)))
    };
    let mirror = material("mirror", &Values::new().with("color", Value::Color(Rgb::new(1.0, 0.5, 0.0))));
    assert_eq!(share_and_tint(&mirror), (0.0, Some(DVec3::new(1.0, 0.5, 0.0))));
    let half = mirror.with("reflectiveness", Value::Number(0.5)).unwrap();
    assert_eq!(share_and_tint(&half), (0.5, Some(DVec3::new(0.5, 0.25, 0.0))));
    let black = mirror.with("color", Value::Color(Rgb::BLACK)).unwrap();
    assert_eq!(share_and_tint(&black), (0.0, None));
    let told = |kind: &&Kind<Material>| kind.name != "mirror" && kind.field("reflectiveness").is_some();
    for kind in Material::KINDS.iter().filter(told) {
        let color = || Value::Color(Rgb::WHITE);
        let values = known(kind, &Values::new().with("color", color()).with("diffuse", color()));
        assert_eq!(share_and_tint(&(kind.make)(&values).unwrap()), (1.0, None), "{}", kind.name);
        let told = (kind.make)(&values.with("reflectiveness", Value::Number(0.25))).unwrap();
        assert_eq!(share_and_tint(&told), (0.75, Some(DVec3::splat(0.25))), "{}", kind.name);
    }
}

#[test]
fn which_lobes_there_are_does_not_depend_on_the_point() {
    for kind in Material::KINDS {
        let color = || Value::Color(Rgb::new(0.5, 0.25, 0.0));
        let values = Values::new().with("color", color()).with("diffuse", color()).with("radiance", color());
        for reflectiveness in [0.0, 0.5, 1.0] {
            let values = values.clone().with("reflectiveness", Value::Number(reflectiveness));
            let material = (kind.make)(&known(kind, &values)).unwrap();
            for (x, degrees, distance) in [(0.0, 0.0, 1.0), (0.7, 60.0, 1e3), (-1e3, 89.0, f64::INFINITY)] {
                let at = ShadingPoint { position: Triple::new(x, 0.0, 0.3), distance, ..seen_from(degrees) };
                let (here, anywhere) = (material.lobes(&at).kinds(), material.lobe_kinds());
                assert_eq!(here, anywhere, "{} {reflectiveness}", kind.name);
            }
        }
    }
}

#[test]
fn what_shines_to_one_side_is_black_from_the_other() {
    let radiance = Rgb::new(3.0, 2.0, 0.5);
    let seen = |material: &Emissive, front| {
        let at = ShadingPoint { front, ..seen_from(30.0) };
        vector(material.lobes(&at).unlit(Triple::splat(1.0)))
    };
    let one_sided = Emissive::new(radiance).unwrap();
    assert_eq!(seen(&one_sided, true), DVec3::new(3.0, 2.0, 0.5));
    assert_eq!(seen(&one_sided, false), DVec3::ZERO);
    let two_sided = Emissive::from(Emission { radiance, two_sided: true });
    assert_eq!(seen(&two_sided, false), DVec3::new(3.0, 2.0, 0.5));
    assert_eq!(Material::from(one_sided).emission(), Some(Emission { radiance, two_sided: false }));
    assert_eq!(Material::from(Matte::new(Rgb::WHITE).unwrap()).emission(), None);
}

fn surface_lights(power: f64) -> [(Light, f64); 3] {
    let vector = |v: DVec3| Value::Vector(v);
    let values = || Values::new().with("power", Value::Color(Rgb::grey(power)));
    let rectangle = values()
        .with("corner", vector(DVec3::ONE))
        .with("edge-u", vector(DVec3::X * 2.0))
        .with("edge-v", vector(DVec3::Z * 3.0));
    let round = values().with("radius", Value::Number(0.5));
    [
        (light("rectangle-light", &rectangle), PI * 6.0),
        (light("disk-light", &round), PI * PI * 0.25),
        (light("sphere-light", &round), PI * PI),
    ]
}

#[test]
fn power_is_spread_over_the_surface_and_all_directions() {
    for (light, flux_of_one) in surface_lights(12.0) {
        let lamp = light.lamp().unwrap();
        assert!((lamp.emission.radiance.g * flux_of_one - 12.0).abs() < 1e-12, "{}", light.kind_name());
        // A scaled light sends out the same power; one of a given radiance keeps that.
        let scaled = light.placed(&Placement::IDENTITY.scaled(2.0).unwrap()).lamp().unwrap();
        assert!((scaled.emission.radiance.g * 4.0 / lamp.emission.radiance.g - 1.0).abs() < 1e-14);
        let both = light.values().with("radiance", Value::Color(Rgb::WHITE));
        let both = (light.kind().make)(&both).unwrap_err();
        assert_eq!(both.to_string(), "power must be given alone, not beside radiance");
    }
    let [(rectangle, flux_of_one), (disk, _), (sphere, _)] = surface_lights(12.0);
    let two_sided = rectangle.with("two-sided", Value::Flag(true)).unwrap().lamp().unwrap();
    assert!((two_sided.emission.radiance.r * flux_of_one * 2.0 - 12.0).abs() < 1e-12);
    assert!(two_sided.emission.two_sided && !disk.lamp().unwrap().emission.two_sided);
    assert_eq!(sphere.with("two-sided", Value::Flag(true)).unwrap_err().field(), "two-sided");
    let point = light("point-light", &Values::new().with("intensity", Value::Color(Rgb::WHITE)));
    assert_eq!(point.lamp(), None);
}

#[test]
fn surface_lights_that_are_none_are_refused() {
    let kind = Light::kind_named("sphere-light").unwrap();
    let sphere = |values: Values| (kind.make)(&values).unwrap_err().to_string();
    let radius = |radius: f64| Values::new().with("radius", Value::Number(radius));
    let power = |power: f64| Value::Color(Rgb::grey(power));
    assert_eq!(sphere(radius(1.0)), "radiance must be given, or power, not missing");
    assert!(sphere(radius(0.0).with("power", power(1.0))).starts_with("radius must be greater than 0"));
    assert!(sphere(radius(1.0).with("power", power(-1.0))).starts_with("power must be light"));
    assert!(sphere(radius(1.0).with("radiance", power(f64::NAN))).starts_with("radiance must be light"));
    assert!(
        sphere(radius(1e-30).with("power", power(1.0))).starts_with("power must give a radiance of at most")
    );
}
