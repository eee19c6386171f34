//! How do egui's meshes get into a software frame? They are rasterised into a transparent layer that keeps what did
//! not change, which is then blended over the picture; and the rectangle that changed is told.

use std::hash::Hasher as _;

use egui::epaint::Primitive;
use egui::{ClippedPrimitive, Pos2, Rect, TexturesDelta, Vec2};
use egui_software_backend::{BufferMutRef, ColorFieldOrder, EguiSoftwareRender};

use crate::canvas::{Region, WASTE};
use crate::egui_textures::Textures;

/// The widest mesh, in pixels, that the rasteriser takes.
const WIDEST: f32 = 8192.0;

/// A layer with what egui shows.
pub(crate) struct EguiLayer {
    renderer: EguiSoftwareRender,
    textures: Textures,
    /// Pixels that the renderer has memory for: it keeps that of its largest picture.
    room: usize,
    shown: Vec<(u64, Region)>,
    size: (u32, u32),
}

impl EguiLayer {
    /// An empty layer.
    pub(crate) fn new() -> Self {
        Self { renderer: renderer(), textures: Textures::default(), room: 0, shown: Vec::new(), size: (0, 0) }
    }

    /// Rasterises what egui wants to see at that size in pixels (not empty). Returns the region that differs from
    /// the last time.
    pub(crate) fn paint(
        &mut self,
        size: (u32, u32),
        primitives: Vec<ClippedPrimitive>,
        textures: &TexturesDelta,
        pixels_per_point: f32,
    ) -> Region {
        let screen = Rect::from_min_size(Pos2::ZERO, Vec2::new(size.0 as f32, size.1 as f32));
        let (primitives, shown): (Vec<_>, Vec<_>) =
            primitives.into_iter().filter_map(|p| visible(p, screen, pixels_per_point)).unzip();
        let changed = if self.size == size && textures.set.is_empty() {
            difference(&self.shown, &shown)
        } else {
            Region::whole(size)
        };
        self.textures.take(textures);
        let (width, height) = (size.0 as usize, size.1 as usize);
        if self.room > WASTE * width * height {
            (self.renderer, self.room) = (renderer(), 0);
            let all = self.textures.all();
            self.renderer.render_to_canvas(width, height, &primitives, &all, pixels_per_point);
        } else {
            self.renderer.render_to_canvas(width, height, &primitives, textures, pixels_per_point);
        }
        self.room = self.room.max(width * height);
        self.shown = shown;
        self.size = size;
        changed
    }

    /// Blends the layer over a frame of 0x00RRGGBB pixels of the size last painted; another size is left alone.
    pub(crate) fn blend_over(&mut self, frame: &mut [u32], size: (u32, u32)) {
        if self.size == size && size.0 > 0 && size.1 > 0 {
            let bytes = bytemuck::cast_slice_mut(frame);
            let mut target = BufferMutRef::new(bytes, size.0 as usize, size.1 as usize);
            self.renderer.blit_canvas_to_buffer(&mut target);
        }
    }
}

fn renderer() -> EguiSoftwareRender {
    EguiSoftwareRender::new(ColorFieldOrder::Bgra)
}

/// The primitive cut to the screen, with a fingerprint and the pixels it may cover; `None` where it covers none,
/// which the rasteriser does not expect.
fn visible(mut p: ClippedPrimitive, screen: Rect, ppp: f32) -> Option<(ClippedPrimitive, (u64, Region))> {
    let Primitive::Mesh(mesh) = &p.primitive else { return None };
    let bounds = mesh.calc_bounds();
    let covered = (bounds.intersect(p.clip_rect) * ppp).intersect(screen);
    let whole = bounds * ppp;
    if !covered.is_positive() || !whole.is_finite() || whole.width() > WIDEST || whole.height() > WIDEST {
        return None;
    }
    let screen_points = screen / ppp;
    p.clip_rect = p.clip_rect.intersect(screen_points);
    let mut hasher = std::hash::DefaultHasher::new();
    hasher.write(bytemuck::cast_slice(&mesh.indices));
    for v in &mesh.vertices {
        hasher.write_u64(u64::from(v.pos.x.to_bits()) << 32 | u64::from(v.pos.y.to_bits()));
        hasher.write_u64(u64::from(v.uv.x.to_bits()) << 32 | u64::from(v.uv.y.to_bits()));
        hasher.write(&v.color.to_array());
    }
    let region = Region {
        left: covered.min.x.floor() as u32,
        top: covered.min.y.floor() as u32,
        right: covered.max.x.ceil() as u32,
        bottom: covered.max.y.ceil() as u32,
    };
    Some((p, (hasher.finish(), region)))
}

/// What is covered by things that are in one list only.
fn difference(before: &[(u64, Region)], after: &[(u64, Region)]) -> Region {
    let only = |a: &[(u64, Region)], b: &[(u64, Region)]| {
        a.iter().filter(|item| !b.contains(item)).fold(Region::NOTHING, |all, (_, region)| all.union(*region))
    };
    only(before, after).union(only(after, before))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Color32, Mesh};

    fn square(left: f32, top: f32, side: f32, clip: Rect) -> ClippedPrimitive {
        let mut mesh = Mesh::default();
        mesh.add_colored_rect(Rect::from_min_size(Pos2::new(left, top), Vec2::splat(side)), Color32::RED);
        ClippedPrimitive { clip_rect: clip, primitive: Primitive::Mesh(mesh) }
    }

    const SCREEN: Rect = Rect { min: Pos2::ZERO, max: Pos2::new(100.0, 80.0) };

    #[test]
    fn what_lies_off_the_screen_is_left_out() {
        assert!(visible(square(200.0, 0.0, 10.0, Rect::EVERYTHING), SCREEN, 1.0).is_none());
        assert!(visible(square(0.0, 0.0, 10.0, Rect::NOTHING), SCREEN, 1.0).is_none());
        assert!(visible(square(60.0, 0.0, 10.0, Rect::EVERYTHING), SCREEN, 2.0).is_none(), "in pixels");
    }

    #[test]
    fn a_region_is_in_pixels_and_cut_to_the_screen() {
        let (_, (_, region)) = visible(square(-5.0, 10.0, 10.0, Rect::EVERYTHING), SCREEN, 1.5).unwrap();
        assert_eq!(region, Region { left: 0, top: 15, right: 8, bottom: 30 });
    }

    #[test]
    fn only_what_changed_differs() {
        let shown = |left| visible(square(left, 0.0, 4.0, SCREEN), SCREEN, 1.0).unwrap().1;
        let (still, from, to) = (shown(0.0), shown(20.0), shown(30.0));
        assert_eq!(difference(&[still, from], &[still, from]), Region::NOTHING);
        assert_eq!(
            difference(&[still, from], &[still, to]),
            Region { left: 20, top: 0, right: 34, bottom: 4 }
        );
    }

    #[test]
    fn a_painted_square_is_blended_over_the_frame() {
        let mut layer = EguiLayer::new();
        let texture = (
            egui::TextureId::default(),
            egui::epaint::ImageDelta::full(
                egui::ColorImage::filled([1, 1], Color32::WHITE),
                egui::TextureOptions::NEAREST,
            ),
        );
        let textures = TexturesDelta { set: vec![texture], free: Vec::new() };
        layer.paint((16, 16), vec![square(4.0, 4.0, 8.0, SCREEN)], &textures, 1.0);
        let mut frame = vec![0x0000_0040; 256];
        layer.blend_over(&mut frame, (16, 16));
        assert_eq!(frame[8 * 16 + 8] & 0x00ff_ffff, 0x00ff_0000);
        assert_eq!(frame[0], 0x0000_0040);
        let nothing_new = TexturesDelta::default();
        layer.paint((64, 64), vec![square(4.0, 4.0, 8.0, SCREEN)], &nothing_new, 1.0);
        layer.paint((16, 16), vec![square(4.0, 4.0, 8.0, SCREEN)], &nothing_new, 1.0);
        assert_eq!(layer.room, 256, "the memory of the larger picture is given back");
        let mut again = vec![0x0000_0040; 256];
        layer.blend_over(&mut again, (16, 16));
        assert_eq!(again, frame, "its textures are still known");
    }
}
