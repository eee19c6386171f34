//! By which texture is a value multiplied? A button that adds one, a list to choose another, and a texture's channel.

use catoptra_core::texture::Channel;
use catoptra_core::{Field, FieldKind, TextureId, TextureUse, Textured, Value};
use egui::{ComboBox, Ui};

use super::fields::Offers;
use super::{spoken, widgets};

/// The word for no texture.
const NONE: &str = "none";

/// Width of the list of channels, in points.
const CHANNEL_WIDTH: f32 = 36.0;

/// A button that adds a texture to a value that takes one and has none.
pub(super) fn add(ui: &mut Ui, field: &Field, value: &Value, offers: &Offers<'_>) -> Option<Value> {
    let (first, _) = offers.textures.first()?;
    let painted = |texture| value.clone().textured(TextureUse::of(texture));
    let takes = field.kind.is_paintable()
        && !matches!(value, Value::Textured(_))
        && (offers.takes)(field.name, painted(*first));
    if !takes {
        return None;
    }
    let menu = ui.menu_button("+", |ui| {
        let clicked = offers.textures.iter().find(|(_, name)| ui.button(name).clicked());
        clicked.map(|(id, _)| {
            ui.close();
            painted(*id)
        })
    });
    menu.response.on_hover_text("Multiply it by a texture.");
    menu.inner.flatten()
}

/// The texture of a value, and of a fraction its channel. Returns the value with another, or with none.
pub(super) fn choose(
    ui: &mut Ui,
    field: &Field,
    Textured { base, by }: &Textured,
    offers: &Offers<'_>,
) -> Option<Value> {
    ui.horizontal(|ui| {
        let mut new = None;
        let shown = ComboBox::from_id_salt("texture")
            .selected_text(name_of(by.texture, offers.textures))
            .show_ui(ui, |ui| {
                if ui.selectable_label(false, NONE).clicked() {
                    new = Some(base.clone());
                }
                if let Some(texture) = list(ui, Some(by.texture), offers.textures) {
                    new = Some(base.clone().textured(TextureUse { texture, ..*by }));
                }
            });
        spoken::name(ui, &shown.response);
        if field.kind == FieldKind::Fraction {
            let words = Channel::ALL.map(Channel::word);
            let now = by.channel.unwrap_or_default().word();
            ui.spacing_mut().combo_width = CHANNEL_WIDTH;
            if let Some(channel) = widgets::choice(ui, "channel", &words, now) {
                let by = TextureUse { channel: Channel::named(&channel), ..*by };
                new = Some(base.clone().textured(by));
            }
        }
        new
    })
    .inner
}

/// A list of the textures. Returns one that is picked and not the present one.
pub(super) fn pick(
    ui: &mut Ui,
    now: Option<TextureId>,
    textures: &[(TextureId, String)],
) -> Option<TextureId> {
    let shown = now.map_or_else(|| NONE.to_owned(), |id| name_of(id, textures));
    let list = |ui: &mut Ui| list(ui, now, textures);
    let shown = ComboBox::from_id_salt("texture").selected_text(shown).show_ui(ui, list);
    spoken::name(ui, &shown.response);
    shown.inner.flatten()
}

fn list(ui: &mut Ui, now: Option<TextureId>, textures: &[(TextureId, String)]) -> Option<TextureId> {
    let mut picked = None;
    for (id, name) in textures {
        if ui.selectable_label(Some(*id) == now, name).clicked() {
            picked = Some(*id);
        }
    }
    picked.filter(|id| Some(*id) != now)
}

fn name_of(id: TextureId, textures: &[(TextureId, String)]) -> String {
    let found = textures.iter().find(|(other, _)| *other == id);
    found.map_or_else(|| id.to_string(), |(_, name)| name.clone())
}
