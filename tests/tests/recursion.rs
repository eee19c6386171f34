//! Does light keep its way through a thousand mirrors, and what does it cost to stop early?

use std::f64::consts::PI;

use catoptra_core::glam::DVec3;
use catoptra_core::numeric::PATTERN_SHIFT;
use catoptra_core::{Camera, Scene};
use catoptra_tests::{camera_of, parsed, traced};
use catoptra_tracer::{Film, Size, View};

const SIZE: Size = Size::new(48, 40);

/// Squares per metre of the wall at the end.
const SCALE: f64 = 8.0;

/// How many bounces are followed.
const BOUNCES: u32 = 1000;

/// How far a ray may be from where it should be after a thousand bounces and a kilometre, metres, for its square to be
/// held against the formula: a few roundings of `f64` (1.1e-16) a bounce, of coordinates of up to 10 m and, for
/// directions, of the whole way that is left: 1000 bounces x 1000 m x 1e-16 x 4 = 4e-10.
const DRIFT: f64 = 1e-9;

/// Three unit vectors at right angles, none along an axis.
fn axes() -> [DVec3; 3] {
    let n = DVec3::new(1.0, 2.0, 3.0).normalize();
    let u = n.cross(DVec3::new(-2.0, 1.0, 0.5)).normalize();
    [n, u, n.cross(u)]
}

fn text(v: DVec3) -> String {
    format!("{} {} {}", v.x, v.y, v.z)
}

/// Two mirrors that meet nothing but what is between them, and a checkered wall across their end.
fn hall(mirrors: [(DVec3, DVec3); 2], end: (DVec3, DVec3), eye: DVec3, target: DVec3) -> Scene {
    let plane = |name: &str, material: &str, (point, normal): (DVec3, DVec3)| {
        format!(
            "plane \"{name}\" material=\"{material}\" {{ point {}; normal {} }}\n",
            text(point),
            text(normal)
        )
    };
    parsed(&format!(
        "settings {{ max-depth {BOUNCES} }}\n\
         camera \"eye\" {{ eye {}; target {}; up {}; fov 0.02 }}\n\
         mirror \"mirror\"\nchecker \"tiles\" {{ scale {SCALE} }}\n\
         ambient-light \"sky\" {{ radiance 1 1 1 }}\n{}{}{}",
        text(eye),
        text(target),
        text(axes()[1]),
        plane("first", "mirror", mirrors[0]),
        plane("second", "mirror", mirrors[1]),
        plane("end", "tiles", end),
    ))
}

/// The colour of the checker at a point, and how far the nearest edge of its squares is, metres.
fn checker(at: DVec3) -> (f32, f64) {
    let cells = [at.x, at.z].map(|along| along.mul_add(SCALE, PATTERN_SHIFT));
    let odd = (cells[0].floor() + cells[1].floor()).rem_euclid(2.0) == 1.0;
    let edge = cells.map(|cell| (cell - cell.round()).abs()).into_iter().fold(1.0, f64::min) / SCALE;
    (if odd { 1.0 } else { 0.0 }, edge)
}

/// Holds every pixel whose ray is not too near an edge against a formula for the end of its way, and for its bounces.
fn assert_arrives(scene: &Scene, end_of: impl Fn(&Camera, f64, f64) -> (DVec3, f64)) {
    let camera = camera_of(scene);
    let view = View { weight_cutoff: 0.0, ..View::of(scene, camera.clone(), SIZE) };
    let (mut tried, mut most) = (0, 0.0_f64);
    for backend in ["scalar", "wide"] {
        let film = traced(scene, backend, &view, Film::new(SIZE), 2);
        for (x, y) in (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y))) {
            let (end, bounces) = end_of(&camera, f64::from(x) + 0.5, f64::from(y) + 0.5);
            let (color, edge) = checker(end);
            if edge < DRIFT || bounces > f64::from(BOUNCES) - 1.0 {
                continue;
            }
            (tried, most) = (tried + 1, most.max(bounces));
            let found = film.radiance(x, y);
            assert_eq!(
                found, [color; 3],
                "{backend} at {x},{y} after {bounces} bounces, {edge} m from an edge"
            );
        }
    }
    assert!(tried > SIZE.pixels() && most > 900.0, "{tried} pixels, {most} bounces");
}

#[test]
fn a_thousand_bounces_between_parallel_mirrors_end_where_the_unfolded_ray_ends() {
    let [n, u, w] = axes();
    let end = 40.0;
    let eye = 0.4 * n;
    // 24 m across for each metre along: 24 bounces a metre, 960 to the end.
    let scene = hall([(DVec3::ZERO, n), (n, -n)], (end * w, -w), eye, eye + 24.0 * n + w + 0.03 * u);
    assert_arrives(&scene, |camera, x, y| {
        let ray = camera.ray(x, y, SIZE.width, SIZE.height);
        let t = (end - w.dot(ray.origin)) / w.dot(ray.direction);
        let unfolded = n.dot(ray.origin) + t * n.dot(ray.direction);
        // Up and down between 0 and 1.
        let folded = 1.0 - ((unfolded.rem_euclid(2.0)) - 1.0).abs();
        let across = u.dot(ray.origin) + t * u.dot(ray.direction);
        (folded * n + across * u + end * w, unfolded.floor().abs())
    });
}

#[test]
fn bounces_in_a_narrow_wedge_end_where_the_unfolded_ray_ends() {
    let [n, u, w] = axes();
    let angle = PI / 1000.0;
    let end = 30.0;
    // Mirrors through the axis w, at the angles 0 and `angle` from u towards n.
    let second = angle.cos() * n - angle.sin() * u;
    let eye = 3.0 * ((0.4 * angle).cos() * u + (0.4 * angle).sin() * n);
    // Past the axis at a distance of 5 cm, and far out again.
    let scene = hall([(DVec3::ZERO, n), (DVec3::ZERO, second)], (end * w, -w), eye, 0.05 * n + 0.3 * w);
    assert_arrives(&scene, |camera, x, y| {
        let ray = camera.ray(x, y, SIZE.width, SIZE.height);
        let t = (end - w.dot(ray.origin)) / w.dot(ray.direction);
        let at = ray.origin + t * ray.direction;
        let turn = n.dot(at).atan2(u.dot(at)).rem_euclid(2.0 * PI) / angle;
        let radius = n.dot(at).hypot(u.dot(at));
        let folded = angle * (1.0 - (turn.rem_euclid(2.0) - 1.0).abs());
        (radius * (folded.cos() * u + folded.sin() * n) + end * w, turn.floor())
    });
}

/// Two mirroring walls that face each other, lit by ambient light alone; every radiance is below 1.
const CORRIDOR: &str = r#"
    settings { max-depth 200 }
    camera "eye" { eye 0 0 0; target 0.3 0.1 -1 }
    matte "far" { color 0.9 0.5 0.25; reflectiveness 0.9 }
    matte "near" { color 0.2 0.4 0.8; reflectiveness 0.8 }
    plane "ahead" material="far" { point 0 0 -1; normal 0 0 1 }
    plane "behind" material="near" { point 0 0 2; normal 0 0 -1 }
    ambient-light "sky" { radiance 1 1 1 }
"#;

#[test]
fn a_cut_off_by_weight_darkens_by_less_than_the_cut_off() {
    let scene = parsed(CORRIDOR);
    let whole = View { weight_cutoff: 0.0, ..View::of(&scene, camera_of(&scene), SIZE) };
    for backend in ["scalar", "wide"] {
        let reference = traced(&scene, backend, &whole, Film::new(SIZE), 2);
        for cutoff in [0.3, 0.03, 0.003, View::of(&scene, camera_of(&scene), SIZE).weight_cutoff] {
            let film =
                traced(&scene, backend, &View { weight_cutoff: cutoff, ..whole.clone() }, Film::new(SIZE), 2);
            let mut most = 0.0_f32;
            for (x, y) in (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y))) {
                for (was, is) in reference.radiance(x, y).into_iter().zip(film.radiance(x, y)) {
                    // A rounding of sums below 1 either way.
                    assert!(
                        is <= was + f32::EPSILON && was - is <= cutoff,
                        "{backend} {cutoff}: {was} became {is}"
                    );
                    most = most.max(was - is);
                }
            }
            assert!(most > 0.1 * cutoff, "{backend}: a cut-off of {cutoff} changes but {most}");
        }
    }
}
