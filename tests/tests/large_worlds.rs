//! Does a scene look the same far from the world's origin, and at any scale?

use catoptra_core::glam::DVec3;
use catoptra_core::{Edit, Light, Material, Placement, Scene, Value};
use catoptra_lab::scenes::placed_mesh;
use catoptra_tests::{film, load, parsed};
use catoptra_tracer::{Film, Size, Tone};

const SEED: [&str; 8] = ["planes", "directional", "point", "spot", "many", "material", "depth", "tetra"];

const SIZE: Size = Size::new(450, 450);

/// One pixel in 10,000 may differ at all.
const ALLOWED: usize = SIZE.pixels() / 10_000;

/// How many steps of an 8-bit display a channel may differ by.
const STEPS: u8 = 2;

/// The seed scenes, and a mesh that is placed twice.
fn scenes() -> Vec<(&'static str, Scene)> {
    let mut scenes: Vec<_> = SEED.map(|name| (name, load(&format!("seed/{name}.kdl")))).into();
    scenes.push(("a placed mesh", placed_mesh(20).expect("a scene")));
    scenes
}

/// The edits that move everything at the top of a scene, and with it all there is.
fn motion(scene: &Scene, motion: &Placement) -> Vec<Edit> {
    let place = |id| scene.placement(id).map(|placement| Edit::Placement(id, placement.then(motion)));
    scene.children(None).into_iter().filter_map(place).collect()
}

/// The scene with everything so many metres along each axis.
fn moved(mut scene: Scene, offset: DVec3) -> Scene {
    let edits = motion(&scene, &Placement::IDENTITY.moved(offset).expect("an offset"));
    scene.apply(Edit::Batch(edits)).expect("a motion that can be applied");
    scene
}

/// A part with one of its numbers or colours times a factor, where it has that field.
macro_rules! times {
    ($part:expr, $field:literal, $factor:expr) => {
        match $part.values().get($field) {
            Some(Value::Number(n)) => $part.with($field, Value::Number(n * $factor)).ok(),
            Some(Value::Color(c)) => $part.with($field, Value::Color(*c * $factor)).ok(),
            _ => None,
        }
    };
}

/// The scene with all lengths times a factor: those in materials too, and light from points in the square of it.
fn scaled(mut scene: Scene, factor: f64) -> Scene {
    let mut edits = motion(&scene, &Placement::IDENTITY.scaled(factor).expect("a scale"));
    for (id, _, material) in scene.materials() {
        let longer = |material: &Material| {
            times!(material, "scale", 1.0 / factor).or_else(|| times!(material, "range", factor))
        };
        edits.extend(longer(material).map(|material| Edit::Material(id, material)));
    }
    let lights = scene.entities().filter_map(|id| Some((id, scene.light(id)?)));
    let brighter = |light: &Light| times!(light, "intensity", factor * factor);
    edits.extend(lights.filter_map(|(id, light)| Some(Edit::Light(id, brighter(&light)?))));
    scene.apply(Edit::Batch(edits)).expect("a scale that can be applied");
    scene
}

/// On how many pixels two films differ as they are displayed, and by how many steps at most.
fn difference(reference: &Film, test: &Film) -> (usize, u8) {
    let [a, b] = [reference, test].map(|film| Tone::default().rgb8(film));
    let pixels = a.chunks(3).zip(b.chunks(3));
    let steps = pixels.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0));
    steps.fold((0, 0), |(count, most), step| (count + usize::from(step > 0), most.max(step)))
}

fn assert_alike(change: impl Fn(Scene) -> Scene, what: &str) {
    let mut failures = Vec::new();
    for (name, scene) in scenes() {
        let before = film(&scene, "wide", SIZE, 0);
        let after = film(&change(scene), "wide", SIZE, 0);
        let (count, most) = difference(&before, &after);
        println!("{name} {what}: {count} pixels differ, by {most} steps at most");
        if count > ALLOWED || most > STEPS {
            failures.push(format!("{name} {what}: {count} of {ALLOWED} pixels, by {most} steps"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn a_scene_far_from_the_origin_looks_the_same() {
    for metres in [1e3, 1e5, 1e7] {
        let offset = metres * DVec3::new(1.0, -1.0, 1.0);
        assert_alike(|scene| moved(scene, offset), &format!("moved {metres} m along every axis"));
    }
}

/// A checkered floor and wall without an end, under a lamp; nothing in it is bounded.
const ENDLESS: &str = r#"
    camera "eye" { eye 0.3 1.7 0.4; target 0.1 1 -2 }
    checker "tiles" { scale 2.5; reflectiveness 0.25 }
    plane "floor" material="tiles"
    plane "wall" material="tiles" { point 0 0 -6; normal 0.1 0.2 1 }
    point-light "lamp" { position 1 3 -2; intensity 30 }
"#;

#[test]
fn a_scene_without_any_bounded_shape_looks_the_same_far_away() {
    let scene = parsed(ENDLESS);
    let before = film(&scene, "wide", SIZE, 0);
    let after = film(&moved(scene, DVec3::new(1e7, 1e5, -1e6)), "wide", SIZE, 0);
    let (count, most) = difference(&before, &after);
    assert!(count <= ALLOWED && most <= STEPS, "{count} pixels differ, by {most} steps at most");
}

#[test]
fn a_thing_far_away_does_not_blur_what_is_near() {
    let near = |scene: &str| {
        parsed(&format!(
            "{ENDLESS}\nsphere \"ball\" material=\"tiles\" {{ center 0 1 -2; radius 0.7 }}{scene}"
        ))
    };
    let far = "\nsphere \"moon\" material=\"tiles\" { center -1e7 1e6 9e6; radius 0.5 }";
    let offset = DVec3::new(1e7, 0.0, 0.0);
    let before = film(&near(""), "wide", SIZE, 0);
    let after = film(&moved(near(far), offset), "wide", SIZE, 0);
    let (count, most) = difference(&before, &after);
    assert!(count <= ALLOWED && most <= STEPS, "{count} pixels differ, by {most} steps at most");
}

#[test]
fn a_scene_of_another_scale_looks_the_same() {
    for factor in [1e-6, 1e-3, 1e3, 1e6] {
        assert_alike(|scene| scaled(scene, factor), &format!("times {factor}"));
    }
}
