//! Is light from surfaces the same by every backend, within what is promised, in whatever stands in its way?

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::fmt::Write;

use catoptra_core::Scene;
use catoptra_tests::{assert_same_bits, camera_of, film, parsed, traced};
use catoptra_tracer::{
    Control, Edges, Film, Instructions, Pool, Size, Skip, Snapshot, View, backend_named, render,
};

/// How far `wide` may be from the oracle, as a share of the radiance of the lamp.
const PROMISED: f64 = 2e-5;

/// Meshes that stand before each other: what one blocks for all lanes is not asked of the next.
#[test]
fn meshes_behind_meshes_are_as_bright_by_wide_as_by_scalar() {
    let mesh = catoptra_tests::scene_file("gallery/meshes/knot.ply");
    let text = format!(
        "camera \"eye\" {{ eye 5 9 12; target 1 0 1; fov 40 }}\nmatte \"m\" {{ color 0.5 }}\n\
         disk \"floor\" material=\"m\" {{ center 0 -1.3 0; radius 30 }}\n\
         repeat \"rows\" count=5 {{\n step {{ move 0 0 0.9 }}\n repeat \"row\" count=5 {{\n  step {{ move 0.9 0 0 }}\n  \
         mesh \"knot\" material=\"m\" {{ file {:?} }}\n }}\n}}\n\
         rectangle-light \"key\" {{ corner -3 8 1; edge-u 1 1.2 -1; edge-v 1.5 0 1.5; radiance 9; visible #false }}\n",
        std::path::absolute(mesh).unwrap()
    );
    let scene = parsed(&text);
    let size = Size::new(96, 96);
    let [wide, scalar] = ["wide", "scalar"].map(|backend| film(&scene, backend, size, 2));
    // Where meshes stand before a lamp, each backend samples it in its own way.
    let (mut lit, mut sums) = (0, [0.0_f64; 2]);
    for (x, y) in (0..96).flat_map(|x| (0..96).map(move |y| (x, y))) {
        let both = [&wide, &scalar].map(|film| f64::from(film.radiance(x, y)[0]));
        lit += u32::from(both[0] > 0.0);
        sums = [sums[0] + both[0], sums[1] + both[1]];
    }
    assert!((sums[0] - sums[1]).abs() <= 0.01 * sums[1], "{sums:?}");
    assert!(lit > 2000, "{lit}");
}

/// Numbers from a seed: SplitMix64.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self, size: f64) -> [f64; 3] {
        [(); 3].map(|()| self.between(-size, size))
    }

    fn pick<'a, T>(&mut self, of: &'a [T]) -> &'a T {
        &of[(self.bits() % of.len() as u64) as usize]
    }
}

fn written([x, y, z]: [f64; 3]) -> String {
    format!("{x} {y} {z}")
}

/// A floor of any slope under a lamp of any kind, with blockers of all kinds between: half of them touch the segment from the
/// floor's middle to a corner or the rim of the lamp.
fn scene(seed: u64) -> String {
    let mut random = Random(seed);
    let r = &mut random;
    let mut text = String::new();
    let slope = [r.between(-0.5, 0.5), 1.0, r.between(-0.5, 0.5)];
    let _ = writeln!(text, "camera \"c\" {{ eye 0 1.5 0; direction 0.01 -1 0; up 0 0 -1; fov 100 }}");
    let _ = writeln!(
        text,
        "matte \"m\" {{ color 1 }}\nplane \"floor\" material=\"m\" {{ normal {} }}",
        written(slope)
    );
    let (x, z) = (r.between(-1.0, 1.0), r.between(-1.0, 1.0));
    let (height, size) = (r.between(3.0, 5.0), r.between(0.3, 2.0));
    let two_sided = *r.pick(&["#true", "#false"]);
    let lamp = match r.bits() % 4 {
        0 => format!(
            "rectangle-light \"l\" {{ corner {x} {height} {z}; edge-u {size} 0 0; edge-v 0 0 {}; two-sided {two_sided}; radiance 1 }}",
            r.between(0.3, 2.0)
        ),
        1 => format!(
            "disk-light \"l\" {{ center {x} {height} {z}; normal 0.1 -1 0.2; radius {size}; two-sided {two_sided}; radiance 1 }}"
        ),
        2 => format!("sphere-light \"l\" {{ center {x} {height} {z}; radius {}; radiance 1 }}", size / 2.0),
        _ => format!(
            "emissive \"e\" {{ radiance 1; two-sided {two_sided} }}\ntriangle \"l\" material=\"e\" {{ a {x} {height} {z}; b {} {height} {z}; c {x} {} {} }}",
            x + size,
            height + r.between(-0.5, 0.5),
            z + size
        ),
    };
    let _ = writeln!(text, "{lamp}");
    for i in 0..1 + r.bits() % 8 {
        let _ = writeln!(text, "{}", blocker(r, i, [x, height, z], size));
    }
    text
}

/// A blocker on the way from the floor's middle to a corner of the lamp or into it: half of them just touch that.
fn blocker(r: &mut Random, i: u64, [x, height, z]: [f64; 3], size: f64) -> String {
    // A point on the way from the floor to a corner or into the lamp.
    let (share, aside) = (r.between(0.2, 0.9), *r.pick(&[0.0, 0.0, 1.0, 0.5]));
    let at = [x * share + size * aside * share, height * share, z * share];
    let radius = r.between(0.05, 0.6);
    let by = |axis: usize, by: f64| {
        let mut moved = at;
        moved[axis] += by;
        moved
    };
    match r.bits() % 6 {
        // Tangent to the segment, or anywhere.
        0 => {
            format!("sphere \"b{i}\" material=\"m\" {{ center {}; radius {radius} }}", written(by(0, radius)))
        }
        1 => format!(
            "sphere \"b{i}\" material=\"m\" {{ center {}; radius {radius} }}",
            written(r.point(2.0).map(|v| v + 1.0))
        ),
        2 => format!(
            "box \"b{i}\" material=\"m\" {{ min {}; max {} }}",
            written(at),
            written(at.map(|v| v + radius))
        ),
        3 => format!(
            "disk \"b{i}\" material=\"m\" {{ center {}; normal {}; radius {radius} }}",
            written(by(2, radius)),
            written(r.point(1.0))
        ),
        4 => format!(
            "triangle \"b{i}\" material=\"m\" {{ a {}; b {}; c {} }}",
            written(at),
            written(by(0, radius)),
            written(by(2, radius))
        ),
        _ => format!(
            "tetrahedron \"b{i}\" material=\"m\" {{ a {}; b {}; c {}; d {} }}",
            written(at),
            written(by(0, radius)),
            written(by(1, radius)),
            written(by(2, radius))
        ),
    }
}

/// How far `wide` is from the oracle: at worst, and the root mean square; `None` where any light has no closed form.
fn compared(text: &str, size: Size) -> Option<(f64, f64)> {
    let scene = parsed(text);
    let view = View::of(&scene, camera_of(&scene), size);
    let pool = Pool::new(0).unwrap();
    let snapshot = Snapshot::extract(&scene, &pool);
    let trace = |backend: &str| {
        let mut film = Film::new(size);
        let backend = backend_named(backend).unwrap();
        let stats = render(backend, &snapshot, &view, &mut film, &pool, &Control::default()).unwrap();
        (film, stats.lamps.sampled)
    };
    let ((exact, sampled), (wide, _)) = (trace("oracle"), trace("wide"));
    if sampled > 0 {
        return None;
    }
    let (mut worst, mut squares) = (0.0_f64, 0.0);
    for (x, y) in (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y))) {
        if exact.surface(x, y) != wide.surface(x, y) {
            continue;
        }
        for (a, b) in exact.radiance(x, y).into_iter().zip(wide.radiance(x, y)) {
            assert!(a >= 0.0 && b >= 0.0 && a.is_finite() && b.is_finite(), "({x}, {y}): {a} {b}\n{text}");
            let off = f64::from(a - b).abs();
            squares += off * off;
            if off > worst {
                worst = off;
            }
        }
    }
    Some((worst, (squares / (3.0 * size.pixels() as f64)).sqrt()))
}

/// Compares pictures of so many random scenes; a floor of albedo 1 shows a π-th of its irradiance.
fn compare_scenes(scenes: u64, size: Size) {
    let (mut squares, mut count) = (0.0, 0.0);
    for seed in 0..scenes {
        let text = scene(seed);
        let Some((worst, rms)) = compared(&text, size) else { continue };
        assert!(worst <= PROMISED, "seed {seed}: off by {worst:e} of the radiance\n{text}");
        squares += rms * rms;
        count += 1.0;
    }
    let rms = (squares / count).sqrt();
    println!("root mean square of the difference over {count} scenes: {rms:e}");
    assert!(count > 0.6 * scenes as f64, "only {count} scenes have a closed form");
    assert!(rms < 1e-6, "root mean square {rms:e}");
}

#[test]
fn wide_is_within_what_is_promised_of_the_oracle() {
    compare_scenes(60, Size::new(40, 40));
}

#[test]
#[ignore = "a million points take minutes; the same as above"]
fn wide_is_within_what_is_promised_of_the_oracle_at_a_million_points() {
    compare_scenes(250, Size::new(64, 64));
}

/// A floor and a wall, a ball on the floor, a box in mid-air, a turned disk and a mirror, under lamps of all kinds.
const ROOM: &str = r#"
camera "c" { eye 0 2.5 7; target 0 1.2 0; fov 50 }
matte "m" { color 0.7 0.6 0.5 }
phong "p" { diffuse 0.5 0.5 0.6; specular 0.4; shininess 20; reflectiveness 0.2 }
emissive "glow" { radiance 2 1 0.5 }
plane "floor" material="m"
plane "wall" material="m" { point 0 0 -3; normal 0 0 1 }
sphere "ball" material="p" { center -1 0.8 0; radius 0.8 }
box "box" material="m" { min 0.3 0.7 -0.4; max 1.3 1.4 0.4; turn 20 0 1 0 }
disk "disk" material="m" { center 0.4 2.4 -0.5; normal 0.2 1 0.3; radius 0.5 }
rectangle "mirror" material="p" { corner 2 0 -2; edge-u 0 0 3; edge-v 0 2 0 }
tetrahedron "ember" material="glow" { a 1.8 0.1 1.5; b 2.2 0.1 1.5; c 2 0.1 1.9; d 2 0.5 1.6 }
rectangle-light "window" { corner -1 3.4 -1; edge-u 2 0 0; edge-v 0 0 1.5; radiance 3 }
disk-light "spot" { center -2.5 2 1; normal 1 -0.5 -0.3; radius 0.4; radiance 4 2 2; visible #false }
sphere-light "bulb" { center 1.8 2 1.5; radius 0.2; power 6 }
"#;

#[test]
fn lamps_of_all_kinds_light_a_room_alike_by_every_backend() {
    // Highlights are sampled, by each backend in its own way.
    let scene = parsed(&ROOM.replace(
        "phong \"p\" { diffuse 0.5 0.5 0.6; specular 0.4; shininess 20;",
        "matte \"p\" { color 0.5;",
    ));
    let size = Size::new(120, 90);
    let exact = film(&scene, "oracle", size, 0);
    for backend in ["scalar", "wide"] {
        let other = film(&scene, backend, size, 0);
        let pixels = (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y)));
        let differs = |&(x, y): &(u32, u32)| {
            let apart =
                exact.radiance(x, y).into_iter().zip(other.radiance(x, y)).map(|(a, b)| (a - b).abs());
            exact.surface(x, y) == other.surface(x, y) && apart.fold(0.0, f32::max) > 2e-4
        };
        let odd: Vec<_> = pixels.filter(differs).collect();
        assert!(odd.len() <= 5, "{backend}: {} pixels differ, {:?}", odd.len(), &odd[..odd.len().min(9)]);
    }
}

#[test]
fn bits_of_lamplight_depend_on_neither_tiles_nor_threads_nor_instructions_nor_what_is_skipped() {
    let scene = parsed(ROOM);
    let size = Size::new(90, 70);
    let view = View::of(&scene, camera_of(&scene), size);
    let reference = traced(&scene, "wide", &view, Film::new(size), 1);
    for (tile, threads) in [(4, 1), (12, 2), (64, 3)] {
        let film = traced(&scene, "wide", &view, Film::with_tiles(size, tile), threads);
        assert_same_bits(&reference, &film, &format!("tiles of {tile}"));
    }
    for instructions in Instructions::all() {
        let view = View { instructions: Some(instructions), ..view.clone() };
        let film = traced(&scene, "wide", &view, Film::new(size), 2);
        assert_same_bits(&reference, &film, instructions.name());
    }
    let view = View { skip: Skip::NOTHING, ..view };
    assert_same_bits(&reference, &traced(&scene, "wide", &view, Film::new(size), 2), "nothing left out");
}

/// The light of a picture by the oracle, red, at a pixel.
fn red(text: &str, size: Size, [x, y]: [u32; 2]) -> f32 {
    film(&parsed(text), "wide", size, 1).radiance(x, y)[0]
}

fn with_lamp(lamp: &str, more: &str) -> Scene {
    parsed(&format!(
        "camera \"c\" {{ eye 0 2 0; direction 0 -1 0; up 0 0 -1; fov 60 }}\nmatte \"m\" {{ color 1 }}\nplane \"floor\" material=\"m\"\n{lamp}\n{more}"
    ))
}

#[test]
fn what_a_lamp_gives_right_below_is_its_formula() {
    let size = Size::new(1, 1);
    let seen = |scene: &Scene| f64::from(film(scene, "wide", size, 1).radiance(0, 0)[0]);
    // A coaxial disk gives π L sin² of half its angle; the floor shows a π-th.
    let disk = with_lamp(
        "disk-light \"l\" { center 0 3 0; normal 0 -1 0; radius 4; radiance 5; visible #false }",
        "",
    );
    assert!((seen(&disk) - 5.0 * 16.0 / 25.0).abs() < 1e-5);
    let sphere = with_lamp("sphere-light \"l\" { center 0 3 0; radius 0.5; radiance 6; visible #false }", "");
    assert!((seen(&sphere) - 6.0 / 36.0).abs() < 1e-6);
    let dark = with_lamp(
        "disk-light \"l\" { center 0 3 0; normal 0 1 0; radius 4; radiance 5; visible #false }",
        "",
    );
    assert_eq!(seen(&dark), 0.0);
    let both = with_lamp(
        "disk-light \"l\" { center 0 3 0; normal 0 1 0; radius 4; radiance 5; visible #false; two-sided #true }",
        "",
    );
    assert!((seen(&both) - 5.0 * 16.0 / 25.0).abs() < 1e-5);
    // A ball between hides the inner part: sin² of the lamp's half-angle less that of the ball's.
    let lamp = "disk-light \"l\" { center 0 30 0; normal 0 -1 0; radius 40; radiance 5; visible #false }";
    let hidden = with_lamp(lamp, "sphere \"b\" material=\"m\" { center 0 10 0; radius 5 }");
    assert!((seen(&hidden) - 5.0 * (0.64 - 0.25)).abs() < 1e-5, "{}", seen(&hidden));
}

#[test]
fn a_body_is_seen_and_blocks_and_an_unseen_lamp_does_neither() {
    let size = Size::new(31, 31);
    let looking_up = |visible: &str| {
        format!(
            "camera \"c\" {{ eye 0 0 4; target 0 0 0; fov 60 }}\nmatte \"m\" {{ color 1 }}
            rectangle \"wall\" material=\"m\" {{ corner -9 -9 -4; edge-u 18 0 0; edge-v 0 18 0 }}
            point-light \"sun\" {{ position 0 0 4; intensity 100 }}
            rectangle-light \"l\" {{ corner -1 -1 0; edge-u 2 0 0; edge-v 0 2 0; radiance 7; visible {visible} }}"
        )
    };
    let middle = [15, 15];
    assert_eq!(red(&looking_up("#true"), size, middle), 7.0);
    assert!(red(&looking_up("#false"), size, middle) > 0.1 && red(&looking_up("#false"), size, middle) < 2.0);
    // From behind it is black.
    let behind = looking_up("#true").replace("edge-u 2 0 0; edge-v 0 2 0", "edge-u 0 2 0; edge-v 2 0 0");
    assert_eq!(red(&behind, size, middle), 0.0);
}

/// A ball that reaches through a lamp has no closed form: its shadow is told by rays.
const BY_RAYS: &str = "sphere \"ball\" material=\"m\" { center 0.4 1 0.2; radius 0.5 }\n\
     rectangle-light \"l\" { corner -0.7 1 -0.5; edge-u 1.4 0 0; edge-v 0 0 1; radiance 1 }";

#[test]
fn few_rays_a_sample_are_right_in_the_mean() {
    let (scene, size) = (with_lamp("", BY_RAYS), Size::new(64, 64));
    let view = View::of(&scene, camera_of(&scene), size);
    let mean = |backend: &str, seed: u32, samples: u32, lamp_rays: u32| {
        let view = View { seed, samples, lamp_rays, ..view.clone() };
        let film = traced(&scene, backend, &view, Film::new(size), 2);
        let pixels = (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y)));
        pixels.map(|(x, y)| f64::from(film.radiance(x, y)[0])).sum::<f64>() / size.pixels() as f64
    };
    let many = mean("wide", 0, 16, 1 << 14);
    for (backend, samples, lamp_rays) in [("wide", 16, 1), ("wide", 64, 64), ("scalar", 16, 1)] {
        // The blocks of a picture have few rays each, so that one picture's mean is still off by a hundredth.
        let few: Vec<f64> =
            (1..=9).map(|seed| mean(backend, seed, samples, lamp_rays) / many - 1.0).collect();
        let off = few.iter().sum::<f64>() / few.len() as f64;
        assert!(off.abs() < 5e-3, "{backend}, {samples} samples: off by {off}, {few:?}");
    }
}

#[test]
fn pieces_of_pixels_may_ask_lamps_by_rays() {
    let (scene, size) = (with_lamp("", BY_RAYS), Size::new(50, 50));
    let view = View { edges: Edges::Exact, ..View::of(&scene, camera_of(&scene), size) };
    let [wide, scalar] = ["wide", "scalar"].map(|backend| traced(&scene, backend, &view, Film::new(size), 2));
    let pixels = (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y)));
    let apart = pixels.map(|(x, y)| f64::from(wide.radiance(x, y)[0] - scalar.radiance(x, y)[0]).powi(2));
    let rms = (apart.sum::<f64>() / size.pixels() as f64).sqrt();
    assert!(rms < 0.02, "{rms}");
}
