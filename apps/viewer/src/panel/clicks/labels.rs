//! Does every control have a name that a screen reader can tell?

use catoptra_core::Camera;
use catoptra_core::scene::{Edit, Node};
use egui::accesskit::{self, NodeId, Role};

use super::*;
use crate::browse::Purpose;
use crate::making::add::Adding;
use crate::making::starters;

/// What can be worked.
const CONTROLS: [Role; 8] = [
    Role::Button,
    Role::CheckBox,
    Role::ColorWell,
    Role::ComboBox,
    Role::RadioButton,
    Role::Slider,
    Role::SpinButton,
    Role::TextInput,
];

/// The controls without a name, of those that are shown.
fn nameless(bench: &mut Bench) -> Vec<(NodeId, accesskit::Node)> {
    bench.context.enable_accesskit();
    bench.frames(2);
    let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, egui::vec2(1280.0, 2600.0)));
    let input = egui::RawInput { screen_rect, ..Default::default() };
    let viewer = &mut bench.viewer;
    let output = bench.context.run_ui(input, |ui| {
        show(ui, viewer, "");
    });
    let nodes = output.platform_output.accesskit_update.unwrap().nodes;
    assert!(nodes.iter().filter(|(_, node)| CONTROLS.contains(&node.role())).count() > 10);
    let is_named = |node: &accesskit::Node| {
        node.label().is_some_and(|label| !label.is_empty()) || !node.labelled_by().is_empty()
    };
    nodes.into_iter().filter(|(_, node)| CONTROLS.contains(&node.role()) && !is_named(node)).collect()
}

fn assert_named(bench: &mut Bench, what: &str) {
    let nameless = nameless(bench);
    let told: Vec<String> = nameless.iter().map(|(_, node)| format!("{node:?}")).collect();
    assert!(nameless.is_empty(), "{what}: {}\n{}", nameless.len(), told.join("\n"));
}

#[test]
fn every_control_of_the_panel_has_a_name() {
    for shape in ["ball", "old", "lens", "ring", "toy", "small"] {
        assert_named(&mut Bench::new(shape), shape);
    }
    for texture in ["wood", "noise", "tiles", "bricks", "marble"] {
        let mut bench = Bench::new("ball");
        bench.viewer.texture = Some(bench.texture(texture));
        assert_named(&mut bench, texture);
    }
}

#[test]
fn every_control_of_the_boxes_has_a_name() {
    let mut bench = Bench::new("ball");
    bench.viewer.shown.help = true;
    assert_named(&mut bench, "keys");
    bench.viewer.shown.help = false;
    bench.viewer.adding = Some(Adding::default());
    assert_named(&mut bench, "something to add");
    bench.viewer.adding = None;
    bench.viewer.ask_for_picture();
    assert_named(&mut bench, "a picture");
    bench.viewer.browse(Purpose::Open, Path::new(""), String::new());
    assert_named(&mut bench, "a file");
}

#[test]
fn every_control_of_lights_and_cameras_has_a_name() {
    let kinds = catoptra_core::Light::KINDS.iter().map(|kind| kind.name);
    let nodes = kinds.filter_map(|kind| Some(Node::light(kind, starters::light(kind)?)));
    let nodes: Vec<Node> = nodes.chain([Node::camera("camera", Camera::default())]).collect();
    assert!(nodes.len() > 5);
    for node in nodes {
        let mut bench = Bench::new("ball");
        let name = node.name.clone();
        assert!(bench.viewer.edit(Edit::insert(node)));
        let id = bench.viewer.document.scene().entity_named(&name);
        bench.viewer.select(id);
        bench.frames(2);
        assert_named(&mut bench, &name);
    }
}
