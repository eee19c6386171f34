//! How the properties for a texture behind a field's value follow the scene.

use catoptra_core::scene::Scene;
use catoptra_core::texture::Channel;
use catoptra_core::{TextureUse, Value};

use super::splice::Splice;
use super::value::{paint, quoted};
use crate::outline::{FieldText, Painted, Span};

/// Whether the text names the textures of a value as the scene does now.
pub(super) fn is_named_so(written: &FieldText, value: &Value, scene: &Scene) -> bool {
    let named = written.painted.as_ref().and_then(|painted| painted.texture.as_ref());
    match (named, value) {
        (Some(word), Value::Textured(textured)) => {
            scene.texture_name(textured.by.texture) == Some(word.value.as_str())
        }
        (None, Value::Texture(texture)) => {
            written.word.as_deref().is_none_or(|word| scene.texture_name(*texture) == Some(word))
        }
        _ => true,
    }
}

/// Changes, adds or removes the properties behind the values of a field that stands in the block.
pub(super) fn edit(
    text: &str,
    written: &FieldText,
    by: Option<TextureUse>,
    scene: &Scene,
    splices: &mut Vec<Splice>,
) {
    match (&written.painted, by) {
        (None, None) => {}
        (None, Some(by)) => {
            let end = written.values.last().map_or(written.span.end, |last| last.end);
            splices.push(Splice::new(end..end, paint(by, scene)));
        }
        (Some(painted), None) => {
            splices.extend(painted.spans.iter().map(|span| Splice::new(with_space(text, span), "")));
        }
        (Some(painted), Some(by)) => change(text, painted, by, scene, splices),
    }
}

fn change(text: &str, painted: &Painted, by: TextureUse, scene: &Scene, splices: &mut Vec<Splice>) {
    let channel = by.channel.map(Channel::word);
    match (&painted.texture, &painted.channel, channel) {
        (Some(name), Some(old), Some(channel)) => {
            rename(
                name.value.as_str(),
                &name.span,
                scene.texture_name(by.texture).unwrap_or_default(),
                splices,
            );
            rename(old.value.as_str(), &old.span, channel, splices);
        }
        (Some(name), None, None) => {
            rename(
                name.value.as_str(),
                &name.span,
                scene.texture_name(by.texture).unwrap_or_default(),
                splices,
            );
        }
        _ => {
            let mut spans = painted.spans.iter().map(|span| with_space(text, span));
            splices.extend(spans.next().map(|first| Splice::new(first, paint(by, scene))));
            splices.extend(spans.map(|span| Splice::new(span, "")));
        }
    }
}

fn rename(old: &str, at: &Span, new: &str, splices: &mut Vec<Splice>) {
    if old != new {
        splices.push(Splice::new(at.clone(), quoted(new)));
    }
}

/// A property with the space before it.
fn with_space(text: &str, property: &Span) -> Span {
    text[..property.start].trim_end_matches([' ', '\t']).len()..property.end
}
