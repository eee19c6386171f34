//! What is a control called that bears no word of its own, for who hears the panel? As the label before it.

use egui::{Id, Response, Ui};

fn key() -> Id {
    Id::new("what controls are called")
}

/// A label, as which the controls after it are called.
pub(super) fn label(ui: &mut Ui, name: &str) -> Response {
    next(ui, name);
    ui.label(name)
}

/// The controls that come next are called so.
pub(super) fn next(ui: &Ui, name: &str) {
    ui.data_mut(|data| data.insert_temp(key(), name.to_owned()));
}

/// Calls a control as the last label.
pub(super) fn name(ui: &Ui, control: &Response) {
    name_part(ui, control, "");
}

/// Calls a control as a part of what the last label says, such as `center x`.
pub(super) fn name_part(ui: &Ui, control: &Response, part: &str) {
    let label: String = ui.data(|data| data.get_temp(key())).unwrap_or_default();
    let whole = [&label, part].into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ");
    ui.ctx().accesskit_node_builder(control.id, |node| node.set_label(whole));
}
