//! Are materials changed by clicks as they should be?

use catoptra_core::{Rgb, Value};

use super::*;

#[test]
fn looking_at_materials_and_textures_changes_nothing_of_them() {
    for shape in ["ball", "old", "lens", "ring", "toy"] {
        let mut bench = Bench::new(shape);
        for texture in ["wood", "noise", "tiles", "bricks", "marble"] {
            bench.viewer.texture = Some(bench.texture(texture));
            bench.frames(3);
            assert!(bench.viewer.document.is_saved(), "{shape} with {texture} was changed");
        }
    }
}

#[test]
fn a_field_gets_a_texture_and_loses_it() {
    let mut bench = Bench::new("ball");
    let before = bench.value("grey", "color");
    bench.click("+");
    bench.click("marble");
    let id = bench.texture("marble");
    assert_eq!(
        bench.viewer.document.scene().painted_with(id),
        [bench.material_id("grey")],
        "{:?}",
        bench.viewer.notice
    );
    bench.undo();
    assert_eq!(bench.value("grey", "color"), before);
    let mut bench = Bench::new("old");
    let is_painted = |bench: &Bench| matches!(bench.value("worn", "reflectiveness"), Value::Textured(_));
    assert!(is_painted(&bench));
    bench.click("g");
    bench.click("luminance");
    let Value::Textured(textured) = bench.value("worn", "reflectiveness") else {
        panic!("it lost its texture")
    };
    assert_eq!(textured.by.channel, Some(catoptra_core::texture::Channel::Luminance));
    bench.undo();
}

#[test]
fn another_kind_keeps_the_color_as_one_step() {
    let mut bench = Bench::new("ball");
    let (before, color) = (bench.material("grey").clone(), bench.value("grey", "color"));
    bench.click("matte");
    bench.click("plastic");
    assert_eq!((bench.material("grey").kind_name(), bench.value("grey", "color")), ("plastic", color));
    bench.undo();
    assert_eq!(*bench.material("grey"), before);
}

#[test]
fn glass_is_water_by_its_name() {
    let mut bench = Bench::new("lens");
    bench.click("preset");
    bench.click("water");
    assert_eq!(bench.value("clear", "ior"), Value::Number(1.333));
    bench.undo();
}

#[test]
fn a_named_metal_gets_a_color_and_a_name_again() {
    let mut bench = Bench::new("ring");
    let metal = |bench: &Bench, field: &str| bench.material("gold").values().get(field).cloned();
    let named = |name: &str| Some(Value::Word(name.to_owned()));
    bench.click("gold");
    bench.click("copper");
    assert_eq!(metal(&bench, "preset"), named("copper"));
    bench.undo();
    assert_eq!(metal(&bench, "preset"), named("gold"));
    bench.click("0.97");
    assert_eq!((metal(&bench, "preset"), metal(&bench, "color").is_some()), (None, true));
    bench.click("–");
    bench.click("silver");
    assert_eq!((metal(&bench, "preset"), metal(&bench, "color")), (named("silver"), None));
}

#[test]
fn a_finish_gets_a_normal_map_and_loses_it() {
    let mut bench = Bench::new("ball");
    bench.click("Finish");
    let finish = |bench: &Bench| bench.viewer.document.scene().finish(bench.material_id("grey"));
    // Of the two that can be given, the normal map is the last.
    bench.click("give");
    assert_eq!(finish(&bench).normal_map().map(|map| map.texture), Some(bench.texture("wood")));
    bench.click("×");
    assert!(finish(&bench).is_plain());
}

#[test]
fn a_colour_is_typed_in_digits_or_as_the_file_has_it() {
    let mut bench = Bench::new("ball");
    bench.type_over("#bcaa95", "0.5 1/4 1", egui::Key::Enter);
    assert_eq!(bench.value("grey", "color"), Value::Color(Rgb::new(0.5, 0.25, 1.0)));
    bench.undo();
}

#[test]
fn the_tint_of_light_is_typed_too() {
    let mut bench = Bench::new("toy");
    let mut typed = |now: &str, text: &str| {
        // So long that clicks on one place are no double click.
        bench.frames(60);
        bench.type_over(now, text, egui::Key::Enter);
        bench.value("all", "emission")
    };
    // It shines not at all at first: digits make it shine as a display shows them.
    assert_eq!(typed("#000000", "#ff0000"), Value::Color(Rgb::new(1.0, 0.0, 0.0)));
    assert_eq!(typed("#ff0000", "8 4 2"), Value::Color(Rgb::new(8.0, 4.0, 2.0)));
    assert_eq!(typed("#ffbc89", "#00ff00"), Value::Color(Rgb::new(0.0, 8.0, 0.0)));
}
