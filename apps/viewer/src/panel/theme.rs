//! How does the panel look? Dark, quiet, small.

use egui::{Color32, Context, CornerRadius, Stroke, TextStyle, Theme, Visuals};

/// Behind the panel.
pub(super) const PANEL: Color32 = Color32::from_rgb(0x1b, 0x1e, 0x24);

/// Behind what floats over the picture.
pub(super) const FLOATING: Color32 = Color32::from_rgb(0x16, 0x18, 0x1d);

/// What is selected, and what asks for attention.
pub(super) const ACCENT: Color32 = Color32::from_rgb(0xff, 0xb0, 0x2e);

/// What has failed, and what goes.
pub(super) const FAILURE: Color32 = Color32::from_rgb(0xff, 0x6b, 0x5e);

/// What is new, and well.
pub(super) const FINE: Color32 = Color32::from_rgb(0x7f, 0xc9, 0x7a);

/// Gives egui its colours and sizes; nothing is animated, so that nothing is drawn twice.
pub(crate) fn set_theme(context: &Context) {
    context.set_theme(Theme::Dark);
    context.set_visuals(visuals());
    context.all_styles_mut(|style| {
        style.animation_time = 0.0;
        style.spacing.item_spacing = egui::vec2(6.0, 4.0);
        style.spacing.interact_size.y = 18.0;
        style.spacing.indent = 12.0;
        style.spacing.slider_width = 96.0;
        style.spacing.combo_width = 96.0;
        // Room for all kinds of the longest list.
        style.spacing.combo_height = 420.0;
        for (name, size) in [(TextStyle::Body, 12.5), (TextStyle::Button, 12.5), (TextStyle::Small, 10.5)] {
            if let Some(font) = style.text_styles.get_mut(&name) {
                font.size = size;
            }
        }
    });
}

fn visuals() -> Visuals {
    let mut v = Visuals::dark();
    v.panel_fill = PANEL;
    v.window_fill = FLOATING;
    v.window_stroke = Stroke::new(1.0, Color32::from_rgb(0x3a, 0x3f, 0x49));
    v.window_shadow = egui::Shadow::NONE;
    v.popup_shadow = egui::Shadow::NONE;
    v.window_corner_radius = CornerRadius::same(6);
    v.extreme_bg_color = Color32::from_rgb(0x10, 0x12, 0x16);
    v.override_text_color = Some(Color32::from_rgb(0xd6, 0xda, 0xe0));
    v.selection.bg_fill = Color32::from_rgb(0x5a, 0x43, 0x18);
    v.selection.stroke = Stroke::new(1.0, ACCENT);
    v.slider_trailing_fill = true;
    v
}
