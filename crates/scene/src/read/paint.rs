//! How a texture is read that multiplies the value of a field: `color 0.8 texture="wood"`, `roughness 1 texture="wood" channel="g"`.

use std::collections::HashMap;

use catoptra_core::texture::Channel;
use catoptra_core::{Field, TextureId, TextureUse, Value};
use kdl::{KdlDocument, KdlEntry, KdlNode};

use super::extra::FILE;
use super::value::value_span;
use super::{Files, Reader, span_of};
use crate::instance::full_name;
use crate::outline::{Painted, Sort, Word};
use crate::words;

/// The property of a field that names the texture.
pub(crate) const TEXTURE: &str = "texture";

/// The property of a field that names the texture's channel.
pub(crate) const CHANNEL: &str = "channel";

/// The textures that a text has, before the scene is there: they get its first ids, in the order of the text. Those of models
/// follow, in the order of the models.
pub(super) fn textures_of(document: &KdlDocument, files: &mut Files) -> HashMap<String, TextureId> {
    let mut textures = HashMap::new();
    for node in document.nodes() {
        let name = node.entries().iter().find(|e| e.name().is_none()).and_then(|e| e.value().as_string());
        if let (Some(Sort::Texture(_)), Some(name)) = (Sort::named(node.name().value()), name)
            && let Some(id) = u32::try_from(textures.len() + 1).ok().and_then(TextureId::from_index)
        {
            textures.entry(name.to_owned()).or_insert(id);
        }
    }
    add_textures_of_models(document, files, &mut textures);
    textures
}

fn add_textures_of_models(
    document: &KdlDocument,
    files: &mut Files,
    textures: &mut HashMap<String, TextureId>,
) {
    for node in document.nodes() {
        if let (Some(Sort::Model), Some((name, path))) =
            (Sort::named(node.name().value()), name_and_file(node))
            && let Ok(source) = files.model(path)
        {
            for (own, _) in &source.model.textures {
                let Some(id) = u32::try_from(textures.len() + 1).ok().and_then(TextureId::from_index) else {
                    return;
                };
                textures.entry(full_name(name, own)).or_insert(id);
            }
        }
        if let Some(inside) = node.children() {
            add_textures_of_models(inside, files, textures);
        }
    }
}

/// The name of a model's node and the path of its file, if it has both.
fn name_and_file(node: &KdlNode) -> Option<(&str, &str)> {
    let text = |entry: &'_ KdlEntry| entry.value().as_string().is_some();
    let name = node.entries().iter().find(|e| e.name().is_none() && text(e))?.value().as_string()?;
    let property = || node.entries().iter().find(|e| e.name().is_some_and(|n| n.value() == FILE));
    let child = node.children().and_then(|inside| inside.get(FILE)).and_then(|file| file.entries().first());
    Some((name, child.or_else(property)?.value().as_string()?))
}

impl Reader<'_> {
    /// The values of a field that is written as a node, and what multiplies them.
    pub(super) fn values_and_paint<'n>(
        &mut self,
        node: &'n KdlNode,
        field: &Field,
        sort: Sort,
    ) -> (Vec<&'n KdlEntry>, Option<Painted>) {
        if !node.entries().iter().any(is_paint) {
            return (self.arguments(node), None);
        }
        self.refuse_annotations(node);
        let (named, values): (Vec<_>, Vec<_>) = node.entries().iter().partition(|e| e.name().is_some());
        let takes = matches!(sort, Sort::Material(_)) && field.kind.is_paintable();
        let mut painted: Option<Painted> = None;
        for entry in named {
            let span = span_of(entry.span());
            match entry.name().map(kdl::KdlIdentifier::value) {
                Some(TEXTURE | CHANNEL) if !takes => {
                    let message = format!("{} takes no texture", field.name);
                    let help =
                        "colours and fractions of materials do, whose values differ from point to point";
                    self.complaints.add_with(span, message, help);
                    return (values, None);
                }
                Some(TEXTURE) if painted.as_ref().is_some_and(|p| p.texture.is_some()) => {
                    self.complaints.add(span, "texture is given twice");
                }
                Some(CHANNEL) if painted.as_ref().is_some_and(|p| p.channel.is_some()) => {
                    self.complaints.add(span, "channel is given twice");
                }
                Some(name @ (TEXTURE | CHANNEL)) => {
                    let painted = painted.get_or_insert_default();
                    let word = self.read_word(name, entry);
                    *(if name == TEXTURE { &mut painted.texture } else { &mut painted.channel }) = Some(word);
                    painted.spans.push(span);
                }
                name => {
                    let name = name.unwrap_or_default();
                    let help = self.complaints.hint(|| words::hint(name, &[TEXTURE, CHANNEL], "what it has"));
                    self.complaints.add_with(span, format!("{} has no property {name}", field.name), help);
                }
            }
        }
        (values, painted)
    }

    /// A word in quotes behind a property; empty where it is none, which is complained about.
    fn read_word(&mut self, name: &str, entry: &KdlEntry) -> Word {
        self.refuse_odd_quotes(entry);
        let span = value_span(entry);
        let value = entry.value().as_string().unwrap_or_default().to_owned();
        if value.is_empty() {
            let what = if name == TEXTURE { "the name of a texture" } else { "the name of a channel" };
            self.complaints.add(span.clone(), format!("{name} needs {what} in quotes"));
        }
        Word { value, span }
    }

    /// A value with the texture that multiplies it; `None` where that was complained about.
    pub(super) fn paint(&mut self, value: Value, painted: &Painted, field: &Field) -> Option<Value> {
        let Some(name) = &painted.texture else {
            let span = painted.spans.first().cloned().unwrap_or_default();
            let help = format!("write {} … {TEXTURE}=\"name of a texture\" {CHANNEL}=…", field.name);
            self.complaints.add_with(span, "a channel is one of a texture, and there is none", help);
            return None;
        };
        let texture = self.texture_of(name)?;
        let channel = match &painted.channel {
            None => None,
            Some(word) => Some(self.read_channel(word)?),
        };
        Some(value.textured(TextureUse { texture, channel }))
    }

    fn read_channel(&mut self, word: &Word) -> Option<Channel> {
        let found = Channel::named(&word.value);
        if found.is_none() && !word.value.is_empty() {
            let known = Channel::ALL.map(Channel::word);
            let message = format!("{CHANNEL} is one of {}, not \"{}\"", known.join(", "), word.value);
            self.complaints.add_with(
                word.span.clone(),
                message,
                words::hint(&word.value, &known, "channels"),
            );
        }
        found
    }

    /// The texture of that name.
    pub(super) fn texture_of(&mut self, name: &Word) -> Option<TextureId> {
        let found = self.textures.get(&name.value).copied();
        if found.is_none() && !name.value.is_empty() {
            let mut known: Vec<&str> = self.textures.keys().map(String::as_str).collect();
            known.sort_unstable();
            let help = self.complaints.hint(|| words::hint(&name.value, &known, "textures"));
            let message = format!("there is no texture \"{}\"", name.value);
            self.complaints.add_with(name.span.clone(), message, help);
        }
        found
    }
}

fn is_paint(entry: &KdlEntry) -> bool {
    entry.name().is_some_and(|name| [TEXTURE, CHANNEL].contains(&name.value()))
}
