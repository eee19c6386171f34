//! Which material is shown by a picture, and when is that picture to be traced? Once for each state of the material.

use std::collections::VecDeque;

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

use crate::ball::{Ball, Sample};

/// Pictures that are kept.
const KEPT: usize = 16;

/// Which picture is shown, and which is to be traced.
#[derive(Default)]
pub(crate) struct Preview {
    wanted: Option<Sample>,
    due: bool,
    /// Finished pictures, the latest at last.
    finished: VecDeque<Ball>,
    image: Option<ColorImage>,
    texture: Option<TextureHandle>,
}

impl Preview {
    /// Wants the picture of that material: it is shown at once if it is known, and else comes due.
    pub(crate) fn want(&mut self, sample: Sample) {
        if self.wanted.as_ref() == Some(&sample) {
            return;
        }
        let known = self.finished.iter().find(|ball| ball.sample == sample);
        self.due = known.is_none();
        if let Some(ball) = known {
            self.image = Some(ball.image.clone());
        }
        self.wanted = Some(sample);
    }

    /// What is to be traced now, once.
    pub(crate) fn take_due(&mut self) -> Option<Sample> {
        let due = std::mem::take(&mut self.due);
        self.wanted.clone().filter(|_| due)
    }

    /// Takes in a picture; one in full is kept. One that was wanted before is shown too, until there is a newer one: else
    /// nothing would be seen while a value is dragged.
    pub(crate) fn put(&mut self, ball: Ball, in_full: bool) {
        let is_there = |sample: &Sample| self.finished.iter().any(|ball| ball.sample == *sample);
        let wanted = self.wanted.as_ref();
        if wanted == Some(&ball.sample) || !wanted.is_some_and(is_there) {
            self.image = Some(ball.image.clone());
        }
        if in_full {
            if self.finished.len() == KEPT {
                self.finished.pop_front();
            }
            self.finished.push_back(ball);
        }
    }

    /// The picture for egui, as soon as there is one.
    pub(crate) fn picture(&mut self, context: &Context) -> Option<egui::TextureId> {
        if let Some(image) = self.image.take() {
            // A new one each time: the rasteriser keeps what it drew of a texture, even if that is changed.
            self.texture = Some(context.load_texture("ball", image, TextureOptions::LINEAR));
        }
        self.texture.as_ref().map(TextureHandle::id)
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::{Material, Rgb, Scene, Value, Values};
    use egui::Color32;

    use super::*;
    use crate::egui_paint::EguiLayer;

    fn sample(grey: f64) -> Sample {
        let values = Values::new().with("color", Value::Color(Rgb::grey(grey)));
        let mut scene = Scene::new();
        let matte = (Material::kind_named("matte").unwrap().make)(&values).unwrap();
        let id = scene.add_material("it", matte).unwrap();
        Sample::of(&scene, id).unwrap()
    }

    fn ball(grey: f64, color: Color32) -> Ball {
        Ball { sample: sample(grey), image: ColorImage::filled([4, 4], color) }
    }

    #[test]
    fn a_picture_is_due_only_after_a_change_and_a_known_one_never() {
        let mut preview = Preview::default();
        assert_eq!(preview.take_due(), None);
        preview.want(sample(0.1));
        assert_eq!(preview.take_due(), Some(sample(0.1)));
        preview.want(sample(0.1));
        assert_eq!(preview.take_due(), None, "nothing has changed");
        preview.put(ball(0.1, Color32::RED), true);
        preview.want(sample(0.2));
        assert_eq!(preview.take_due(), Some(sample(0.2)));
        preview.put(ball(0.2, Color32::RED), false);
        preview.want(sample(0.1));
        assert_eq!(preview.take_due(), None, "it is known");
        preview.want(sample(0.2));
        assert_eq!(preview.take_due(), Some(sample(0.2)), "only a coarse one is known");
    }

    #[test]
    fn a_new_picture_is_seen_in_the_place_of_the_old_one() {
        let (context, mut layer, mut preview) = (Context::default(), EguiLayer::new(), Preview::default());
        let size = (40, 40);
        let mut seen = |preview: &mut Preview| {
            let screen = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(40.0, 40.0));
            let input = egui::RawInput { screen_rect: Some(screen), ..Default::default() };
            let output = context.run_ui(input, |ui| {
                let picture = preview.picture(ui.ctx()).unwrap();
                let uv = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
                ui.painter().image(picture, screen, uv, Color32::WHITE);
            });
            let primitives = context.tessellate(output.shapes, 1.0);
            layer.paint(size, primitives, &output.textures_delta, 1.0);
            let mut frame = vec![0; 1600];
            layer.blend_over(&mut frame, size);
            frame[820]
        };
        preview.want(sample(0.1));
        for (color, pixel) in [(Color32::RED, 0x00ff_0000), (Color32::GREEN, 0x0000_ff00)] {
            preview.put(ball(0.1, color), false);
            assert_eq!(seen(&mut preview) & 0x00ff_ffff, pixel);
        }
    }
}
