//! What does each command do to the viewer?

use std::path::Path;

use catoptra_core::scene::{EntityId, Role};
use catoptra_raster::{Constraint, Tool};

use crate::browse::Purpose;
use crate::camera_control;
use crate::deeds::Deed;
use crate::fly;
use crate::framing;
use crate::guard::Next;
use crate::input::Mode;
use crate::keys::Command;
use crate::making;
use crate::seeing;
use crate::transform::{self, Ends};
use crate::viewer::Viewer;
use crate::views;

/// The share of the distance to the target that an arrow key moves the camera.
const STEP: f64 = 0.05;

/// Does what a key asks for.
pub(crate) fn run(viewer: &mut Viewer, command: Command) {
    viewer.stale.panel = true;
    match command {
        Command::Quit => viewer.leave(Next::Close),
        Command::Help => viewer.shown.help = !viewer.shown.help,
        Command::Panel => viewer.shown.panel = !viewer.shown.panel,
        Command::FrameAll => framing::frame_all(viewer),
        Command::FrameSelected => framing::frame_selected(viewer),
        Command::ResetCamera => viewer.adopt(viewer.through.or(viewer.document.scene().main_camera())),
        Command::NextCamera => next_camera(viewer),
        Command::Look(side) => viewer.look(views::from_side(&viewer.camera, side)),
        Command::OtherProjection => viewer.look(views::other_projection(&viewer.camera)),
        Command::Step(right, up) => {
            let camera = camera_control::step(&viewer.camera, f64::from(right) * STEP, f64::from(up) * STEP);
            viewer.look(camera);
        }
        Command::ToggleMode => toggle_mode(viewer),
        Command::ToggleOverlays => {
            viewer.shown.overlays = !viewer.shown.overlays;
            viewer.stale.overlay = true;
        }
        Command::Escape => escape(viewer),
        Command::Delete => making::delete(viewer),
        Command::Add => making::choose(viewer),
        Command::Duplicate => making::duplicate(viewer),
        Command::Cut => making::cut(viewer),
        Command::Copy => {
            making::copy(viewer);
        }
        Command::Paste => making::ask_to_paste(viewer),
        Command::Rename => making::rename(viewer),
        Command::Group => making::group(viewer),
        Command::Ungroup => making::ungroup(viewer),
        Command::Hide => making::hide(viewer),
        Command::ShowAll => making::show_all(viewer),
        Command::Lock => making::lock(viewer),
        Command::SelectAll => {
            let all = viewer.document.scene().children(None);
            viewer.select_all(all.into_iter().collect());
        }
        Command::Undo => undo(viewer),
        Command::Redo => redo(viewer),
        Command::Save => viewer.save(),
        Command::SaveAs => viewer.save_elsewhere(None),
        Command::New => viewer.leave(Next::New),
        Command::Open => open(viewer),
        Command::Reload => reload(viewer),
        Command::Picture => viewer.ask_for_picture(),
        Command::PictureAgain => viewer.picture_again(),
        Command::See(see) => seeing::run(viewer, see),
        Command::Transform(tool) => {
            transform::begin(viewer, tool, Constraint::Free, Ends::ByClick, viewer.pointer.at);
        }
        Command::NextTool => next_tool(viewer),
        Command::OnSurfaces => toggle_surfaces(viewer),
        Command::Fly => fly_selected(viewer),
    }
}

fn next_tool(viewer: &mut Viewer) {
    viewer.settings.tool = match viewer.settings.tool {
        None => Some(Tool::Move),
        Some(Tool::Move) => Some(Tool::Turn),
        Some(Tool::Turn) => Some(Tool::Scale),
        Some(Tool::Scale) => None,
    };
    viewer.stale.overlay = true;
}

fn toggle_surfaces(viewer: &mut Viewer) {
    viewer.settings.on_surfaces = !viewer.settings.on_surfaces;
    let on = viewer.settings.on_surfaces;
    viewer.notify(if on {
        "things are put onto surfaces as they are moved"
    } else {
        "things are moved freely"
    });
}

fn fly_selected(viewer: &mut Viewer) {
    if viewer.flown.is_some() {
        return fly::end(viewer);
    }
    match viewer.selection.active() {
        Some(id) => fly::begin(viewer, id),
        None => viewer.notify("select a light or a camera first"),
    }
}

fn toggle_mode(viewer: &mut Viewer) {
    let mode = viewer.settings.mode.other();
    viewer.settings.mode = mode;
    viewer.notify(format!("{}: drag to {}", mode.name(), dragging(mode)));
}

fn dragging(mode: Mode) -> &'static str {
    match mode {
        Mode::Orbit => "move the camera round",
        Mode::Turntable => "turn the objects about the origin",
    }
}

fn next_camera(viewer: &mut Viewer) {
    let cameras: Vec<EntityId> = viewer.document.scene().entities_of(Role::Camera).collect();
    let now = viewer.through.and_then(|id| cameras.iter().position(|c| *c == id));
    let Some(next) = cameras.get(now.map_or(0, |i| (i + 1) % cameras.len())).copied() else {
        return viewer.notify("the scene has no camera");
    };
    viewer.adopt(Some(next));
    let name = viewer.document.scene().name(next).unwrap_or_default();
    viewer.notify(format!("camera {name}"));
}

fn escape(viewer: &mut Viewer) {
    match () {
        () if viewer.error.take().is_some() || viewer.failure.take().is_some() => {}
        () if viewer.shown.help => viewer.shown.help = false,
        () if viewer.flown.is_some() => fly::end(viewer),
        () => viewer.select(None),
    }
}

fn open(viewer: &mut Viewer) {
    viewer.finish_name();
    let folder = viewer.document.folder();
    viewer.browse(Purpose::Open, &folder, String::new());
}

fn reload(viewer: &mut Viewer) {
    match viewer.error.as_ref().map(|broken| broken.source.clone()) {
        Some(broken) => viewer.leave(broken),
        None => match viewer.document.source().map(Path::to_owned) {
            Some(file) => viewer.leave(Next::Open(file)),
            None => viewer.notify("this scene has no file to be read again"),
        },
    }
}

fn undo(viewer: &mut Viewer) {
    let deed = viewer.document.undo();
    tell(viewer, deed, "undo");
}

fn redo(viewer: &mut Viewer) {
    let deed = viewer.document.redo();
    tell(viewer, deed, "redo");
}

/// Tells what a step did, and selects what came with it.
fn tell(viewer: &mut Viewer, deed: Option<Deed>, way: &str) {
    let Some(deed) = deed else { return viewer.notify(format!("nothing to {way}")) };
    if !deed.brought.is_empty() {
        viewer.select_all(deed.brought.into_iter().collect());
    }
    viewer.notify(format!("{way}: {}", deed.words));
}

#[cfg(test)]
mod tests;
