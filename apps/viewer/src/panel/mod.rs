//! What stands beside and over the picture? The panel with tree, inspector and switches, the status line, the list of
//! keys, the report of an error, and what is asked before work is lost.

mod add;
mod banner;
#[cfg(test)]
mod clicks;
mod color;
mod dialogs;
mod fields;
mod files;
mod help;
mod inspector;
mod kind;
mod looking;
mod material;
mod menus;
mod number;
mod paint;
mod pictures;
mod placement;
mod question;
mod readout;
mod spoken;
mod switches;
mod textures;
mod theme;
mod tree;
mod tree_drag;
mod widgets;

use egui::{Frame, Margin, Panel, Rect, Ui};

use crate::viewer::Viewer;

pub(crate) use number::short;
pub(crate) use theme::set_theme;

/// Width of the panel in points.
const WIDTH: f32 = 272.0;

/// Shows everything that egui shows; what a person changes goes to the viewer. Returns the room left for the picture,
/// in points.
pub(crate) fn show(ui: &mut Ui, viewer: &mut Viewer, status: &str) -> Rect {
    let whole = ui.max_rect();
    let mut room = whole;
    if viewer.shown.panel && whole.width() > 1.5 * WIDTH {
        room.max.x -= WIDTH;
        let frame = Frame::new().fill(theme::PANEL).inner_margin(Margin::symmetric(10, 8));
        Panel::right("panel")
            .exact_size(WIDTH)
            .resizable(false)
            .show_separator_line(false)
            .frame(frame)
            .show_inside(ui, |ui| side(ui, viewer));
    }
    dialogs::status(ui, viewer, status, room);
    banner::show(ui, viewer, room);
    readout::show(ui, viewer, room);
    pictures::progress(ui, viewer, room);
    dialogs::error(ui, viewer, room);
    dialogs::failure(ui, viewer, room);
    help::show(ui, viewer, whole);
    add::show(ui, viewer, whole);
    files::show(ui, viewer, whole);
    question::show(ui, viewer, whole);
    if ui.input(|input| input.pointer.any_released()) {
        viewer.document.end_step();
    }
    room
}

fn side(ui: &mut Ui, viewer: &mut Viewer) {
    let saved = if viewer.document.is_saved() { "" } else { " *" };
    ui.horizontal(|ui| {
        ui.strong(format!("{}{saved}", viewer.document.name()));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.weak("F1 for keys");
        });
    });
    menus::bar(ui, viewer);
    ui.add_space(4.0);
    number::set_scene_size(ui, viewer.everything().size().length());
    let third = (0.34 * ui.available_height()).max(80.0);
    tree::show(ui, viewer, third);
    ui.separator();
    egui::ScrollArea::vertical().id_salt("inspector").auto_shrink([false, false]).show(ui, |ui| {
        inspector::show(ui, viewer);
        ui.add_space(6.0);
        textures::show(ui, viewer);
        switches::show(ui, viewer);
    });
}

#[cfg(test)]
mod tests {
    use catoptra_core::scene::{Edit, EntityId};
    use catoptra_core::{Light, Rgb, Value, Values};
    use catoptra_tracer::Pool;

    use super::*;
    use crate::guard::{Next, Question};
    use crate::loader;
    use crate::naming::Named;

    fn viewer() -> Viewer {
        Viewer::new(loader::welcome(&Pool::new(1).unwrap()).unwrap())
    }

    fn show_twice(viewer: &mut Viewer) {
        let context = egui::Context::default();
        for _ in 0..2 {
            let screen = Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1280.0, 2000.0));
            let input = egui::RawInput { screen_rect: Some(screen), ..Default::default() };
            let _ = context.run_ui(input, |ui| {
                show(ui, viewer, "");
            });
        }
    }

    #[test]
    fn looking_at_a_thing_changes_nothing_of_it() {
        let mut viewer = viewer();
        let all: Vec<EntityId> = viewer.document.scene().entities().collect();
        for id in all {
            viewer.select(Some(id));
            show_twice(&mut viewer);
            assert!(viewer.document.is_saved(), "{:?} was changed", viewer.document.scene().name(id));
        }
    }

    #[test]
    fn a_name_that_is_being_typed_is_an_edit() {
        let named = |viewer: &Viewer, name| viewer.document.scene().entity_named(name);
        let typing = || {
            let mut viewer = viewer();
            let floor = named(&viewer, "floor").unwrap();
            viewer.select(Some(floor));
            viewer.typed_name = Some((Named::Entity(floor), "ground".to_owned()));
            (viewer, Some(floor))
        };
        let (mut closing, _) = typing();
        closing.leave(Next::Close);
        assert_eq!(closing.guard.question(), Some(&Question::Unsaved(Next::Close)));
        let (mut elsewhere, floor) = typing();
        elsewhere.select(None);
        assert_eq!(named(&elsewhere, "ground"), floor);
        let (mut unfocused, floor) = typing();
        show_twice(&mut unfocused);
        assert_eq!(named(&unfocused, "ground"), floor);
    }

    #[test]
    fn an_angle_that_no_slider_would_give_is_kept() {
        let mut viewer = viewer();
        let scene = viewer.document.scene();
        let spot = |id: &EntityId| scene.light(*id).is_some_and(|light| light.kind_name() == "spot-light");
        let id = scene.entities().find(spot).unwrap();
        let light = scene.light(id).unwrap().with("inner", Value::Number(0.123_456_789)).unwrap();
        viewer.edit(Edit::Light(id, light.clone()));
        viewer.select(Some(id));
        show_twice(&mut viewer);
        assert_eq!(viewer.document.scene().light(id), Some(light));
    }

    #[test]
    fn looking_at_a_lamp_given_by_radiance_or_power_changes_nothing_of_it() {
        let kind = Light::kind_named("sphere-light").unwrap();
        for given in ["radiance", "power"] {
            let values = Values::new().with("radius", Value::Number(0.3));
            let lamp = (kind.make)(&values.with(given, Value::Color(Rgb::WHITE))).unwrap();
            let mut viewer = viewer();
            let scene = viewer.document.scene();
            let id = scene.entities().find(|id| scene.light(*id).is_some()).unwrap();
            viewer.edit(Edit::Light(id, lamp.clone()));
            viewer.select(Some(id));
            show_twice(&mut viewer);
            assert_eq!(viewer.document.scene().light(id), Some(lamp));
        }
    }

    #[test]
    fn the_panel_leaves_room_and_goes_when_there_is_none() {
        let context = egui::Context::default();
        let mut viewer = viewer();
        for (width, room) in [(1280.0, 1280.0 - WIDTH), (300.0, 300.0)] {
            let screen = Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(width, 400.0));
            let input = egui::RawInput { screen_rect: Some(screen), ..Default::default() };
            let mut left = Rect::NOTHING;
            let _ = context.run_ui(input, |ui| left = show(ui, &mut viewer, ""));
            assert_eq!(left.width(), room);
        }
    }
}
