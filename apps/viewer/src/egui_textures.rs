//! What do egui's textures hold? It tells each change once; a renderer that is made anew has to be told all.

use std::collections::HashMap;

use egui::epaint::ImageDelta;
use egui::{ColorImage, ImageData, TextureId, TextureOptions, TexturesDelta};

/// All textures that egui has now.
#[derive(Default)]
pub(crate) struct Textures {
    held: HashMap<TextureId, (ColorImage, TextureOptions)>,
}

impl Textures {
    /// Takes in what egui has set and freed.
    pub(crate) fn take(&mut self, told: &TexturesDelta) {
        for (id, delta) in &told.set {
            let ImageData::Color(image) = &delta.image;
            match (delta.pos, self.held.get_mut(id)) {
                (Some(at), Some((whole, _))) => patch(whole, image, at),
                _ => drop(self.held.insert(*id, (ColorImage::clone(image), delta.options))),
            }
        }
        for id in &told.free {
            self.held.remove(id);
        }
    }

    /// What tells a new renderer all of them.
    pub(crate) fn all(&self) -> TexturesDelta {
        let whole = |(id, (image, options)): (&TextureId, &(ColorImage, TextureOptions))| {
            (*id, ImageDelta::full(image.clone(), *options))
        };
        TexturesDelta { set: self.held.iter().map(whole).collect(), free: Vec::new() }
    }
}

/// Puts a picture into another, column and row of its upper left corner given; what lies outside is left out.
fn patch(whole: &mut ColorImage, part: &ColorImage, [x, y]: [usize; 2]) {
    let ([width, _], [across, _]) = (whole.size, part.size);
    let across_inside = across.min(width.saturating_sub(x));
    if across_inside == 0 {
        return;
    }
    let rows = whole.pixels.chunks_exact_mut(width).skip(y);
    for (row, new) in rows.zip(part.pixels.chunks_exact(across)) {
        row[x..x + across_inside].copy_from_slice(&new[..across_inside]);
    }
}

#[cfg(test)]
mod tests {
    use egui::Color32;

    use super::*;

    #[test]
    fn a_texture_holds_what_was_set_last_until_it_is_freed() {
        let (id, mut textures) = (TextureId::default(), Textures::default());
        let image = |size, color| ColorImage::filled(size, color);
        let whole = ImageDelta::full(image([3, 2], Color32::RED), TextureOptions::NEAREST);
        let part = ImageDelta::partial([1, 1], image([5, 5], Color32::BLUE), TextureOptions::NEAREST);
        textures.take(&TexturesDelta { set: vec![(id, whole), (id, part)], free: Vec::new() });
        let all = textures.all();
        let ImageData::Color(held) = &all.set[0].1.image;
        let (r, b) = (Color32::RED, Color32::BLUE);
        assert_eq!(held.pixels, [r, r, r, r, b, b]);
        textures.take(&TexturesDelta { set: Vec::new(), free: vec![id] });
        assert!(textures.all().is_empty());
    }
}
