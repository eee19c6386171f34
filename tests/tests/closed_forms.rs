//! Do whole pictures show what formulas say they must?

use catoptra_tests::{camera_of, parsed, traced};
use catoptra_tracer::{Film, Size, View, backends};

/// Looking straight at a point, a picture of odd size has its middle pixel exactly there.
const MIDDLE: Size = Size::new(3, 3);

/// The radiance in the middle of what the first camera of a scene sees, by every backend.
fn seen(text: &str) -> Vec<(&'static str, [f64; 3])> {
    let scene = parsed(text);
    let view = View { weight_cutoff: 0.0, ..View::of(&scene, camera_of(&scene), MIDDLE) };
    let middle = |backend| traced(&scene, backend, &view, Film::new(MIDDLE), 1).radiance(1, 1).map(f64::from);
    backends().iter().map(|backend| (backend.name(), middle(backend.name()))).collect()
}

/// Every backend shows this grey in the middle, to a few roundings of `f32`.
#[track_caller]
fn assert_shows(text: &str, expected: f64) {
    assert_shows_color(text, [expected; 3]);
}

#[track_caller]
fn assert_shows_color(text: &str, expected: [f64; 3]) {
    for (backend, found) in seen(text) {
        for channel in 0..3 {
            let error = (found[channel] - expected[channel]).abs();
            assert!(
                error <= 2e-6 * expected[channel].max(1.0),
                "{backend}: {found:?} instead of {expected:?}\n{text}"
            );
        }
    }
}

/// A white floor seen from above, at the origin.
const FLOOR: &str = r#"
    camera "eye" { eye 0 7 0; target 0 0 0; up 0 0 -1 }
    matte "white" { color 1 1 1 }
    plane "floor" material="white"
"#;

#[test]
fn a_point_light_falls_off_with_the_square_of_the_distance() {
    for height in [0.25, 1.0, 3.0, 20.0] {
        let light = format!(r#"{FLOOR} point-light "lamp" {{ position 0 {height} 0; intensity 5 5 5 }}"#);
        assert_shows(&light, 5.0 / (height * height) / std::f64::consts::PI);
    }
}

#[test]
fn irradiance_goes_with_the_cosine() {
    for degrees in [0.0_f64, 15.0, 45.0, 60.0, 89.0] {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let sun = format!(
            r#"{FLOOR} directional-light "sun" {{ direction {sine} {} 0; irradiance 2 1 0.5 }}"#,
            -cosine
        );
        let expected = [2.0, 1.0, 0.5].map(|irradiance| irradiance * cosine / std::f64::consts::PI);
        assert_shows_color(&sun, expected);
    }
}

#[test]
fn light_from_below_the_floor_adds_nothing() {
    assert_shows(&format!(r#"{FLOOR} directional-light "sun" {{ direction 0 1 0; irradiance 9 9 9 }}"#), 0.0);
}

#[test]
fn ambient_light_shows_the_albedo() {
    let grey = FLOOR.replace("color 1 1 1", "color 0.5 0.25 1");
    assert_shows_color(
        &format!(r#"{grey} ambient-light "sky" {{ radiance 0.5 0.5 0.5 }}"#),
        [0.25, 0.125, 0.5],
    );
}

#[test]
fn a_spot_light_follows_its_formula() {
    let (inner, outer) = (20.0_f64, 90.0_f64);
    let half_cosine = |full: f64| (full / 2.0).to_radians().cos();
    for falloff in [1.0, 2.5] {
        for degrees in [0.0_f64, 9.0, 11.0, 20.0, 30.0, 44.0, 46.0, 80.0] {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            // The lamp stands over the seen point and its axis leans away by the angle.
            let lamp = format!(
                r#"{FLOOR} spot-light "lamp" {{
                    position 0 2 0; direction {sine} {} 0; intensity 8 8 8
                    inner {inner}; outer {outer}; falloff {falloff}
                }}"#,
                -cosine
            );
            let share =
                ((cosine - half_cosine(outer)) / (half_cosine(inner) - half_cosine(outer))).clamp(0.0, 1.0);
            assert_shows(&lamp, share.powf(falloff) * 8.0 / 4.0 / std::f64::consts::PI);
        }
    }
}

#[test]
fn a_light_behind_a_ball_is_in_shadow_unless_its_shadow_is_off() {
    let lamp = |shadow: &str| {
        format!(
            r#"{FLOOR} sphere "ball" material="white" {{ center 3 3 0; radius 1 }}
            point-light "lamp" {{ position 6 6 0; intensity 72 72 72; shadow {shadow} }}"#
        )
    };
    assert_shows(&lamp("#true"), 0.0);
    assert_shows(&lamp("#false"), 0.5_f64.sqrt() / std::f64::consts::PI);
}

/// Two facing walls of different colour and reflectiveness, lit by ambient light alone, seen along their common normal.
fn corridor(max_depth: u32) -> String {
    format!(
        r#"
        settings {{ max-depth {max_depth} }}
        camera "eye" {{ eye 0 0 0; target 0 0 -1 }}
        matte "far" {{ color 0.75 0.5 0.25; reflectiveness 0.5 }}
        matte "near" {{ color 0.2 0.4 0.8; reflectiveness 0.75 }}
        plane "ahead" material="far" {{ point 0 0 -1; normal 0 0 1 }}
        plane "behind" material="near" {{ point 0 0 2; normal 0 0 -1 }}
        ambient-light "sky" {{ radiance 1 1 1 }}
        "#
    )
}

/// The light that each of the first `walls` walls adds, on its way back to the eye.
fn corridor_terms(walls: u32) -> [f64; 3] {
    let (far, near) = ([0.75, 0.5, 0.25], [0.2, 0.4, 0.8]);
    std::array::from_fn(|channel| {
        let mut weight = 1.0;
        let mut sum = 0.0;
        for wall in 0..walls {
            let (own, reflectiveness): (f64, f64) =
                if wall % 2 == 0 { (far[channel], 0.5) } else { (near[channel], 0.75) };
            sum += weight * own * (1.0 - reflectiveness);
            weight *= reflectiveness;
        }
        sum
    })
}

#[test]
fn a_mirror_corridor_sums_a_geometric_series() {
    let (far, near) = ([0.75, 0.5, 0.25], [0.2, 0.4, 0.8]);
    // L = far (1 - 1/2) + 1/2 (near (1 - 3/4) + 3/4 L)
    let limit = std::array::from_fn(|i| (far[i] * 0.5 + 0.5 * near[i] * 0.25) / (1.0 - 0.375));
    assert_shows_color(&corridor(60), limit);
}

#[test]
fn a_mirror_corridor_cut_short_sums_its_first_terms() {
    for max_depth in 0..6 {
        assert_shows_color(&corridor(max_depth), corridor_terms(max_depth + 1));
    }
}
