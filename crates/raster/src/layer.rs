//! Where overlays are drawn, and how they are laid over the traced picture.
//!
//! A layer is kept from frame to frame: it clears and blends only the rows and columns that were drawn upon.

use crate::pixel::times;
use crate::projection::Spot;
use tiny_skia::{IntRect, Pixmap, Rect};

/// A transparent picture with premultiplied alpha that remembers which part of it was drawn upon.
///
/// A layer of zero width or height holds no pixels; drawing on it and blending it do nothing.
#[derive(Debug, Clone, Default)]
pub struct Layer {
    pixmap: Option<Pixmap>,
    touched: Touched,
}

impl Layer {
    /// An empty layer without pixels; drawing gives it the size it needs.
    pub fn new() -> Self {
        Self::default()
    }

    /// The pixels, 8 bits a channel, premultiplied; `None` when the layer has zero width or height or when nothing
    /// was drawn yet.
    pub fn pixmap(&self) -> Option<&Pixmap> {
        self.pixmap.as_ref()
    }

    /// The part that was drawn upon, in pixels from the top left corner; `None` when the layer is empty.
    pub fn touched(&self) -> Option<IntRect> {
        let pixmap = self.pixmap.as_ref()?;
        let (left, top, right, bottom) = self.touched.within(pixmap)?;
        IntRect::from_ltrb(left as i32, top as i32, right as i32, bottom as i32)
    }

    /// Lays the layer over `picture`: 0x00RRGGBB, row-major, of the layer's own size.
    ///
    /// Pixels under a fully transparent part keep their value to the bit. A picture of another size is left as it
    /// is. Takes 0.5 to 1 ms where all of a picture of 1280 x 720 pixels was touched.
    pub fn blend_over(&self, picture: &mut [u32]) {
        let Some(pixmap) = &self.pixmap else { return };
        if let Some(part) = self.touched.within(pixmap) {
            blend_part(pixmap, part, picture);
        }
    }

    /// Clears what was drawn and takes on a new size; the pixels to draw upon, `None` for an empty picture.
    pub(crate) fn begin(&mut self, width: u32, height: u32) -> Option<(&mut Pixmap, &mut Touched)> {
        match &mut self.pixmap {
            Some(pixmap) if pixmap.width() == width && pixmap.height() == height => {
                if let Some(part) = self.touched.within(pixmap) {
                    clear_part(pixmap, part);
                }
            }
            stale => *stale = Pixmap::new(width, height),
        }
        self.touched = Touched::default();
        Some((self.pixmap.as_mut()?, &mut self.touched))
    }
}

/// Lays all of a premultiplied `overlay` over `picture`: 0x00RRGGBB, row-major, of the same size.
///
/// Pixels under a fully transparent part keep their value to the bit. A picture of another size is left as it is.
pub fn blend_over(overlay: &Pixmap, picture: &mut [u32]) {
    blend_part(overlay, (0, 0, overlay.width() as usize, overlay.height() as usize), picture);
}

/// Bounds of all that was drawn, in pixels.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Touched(Option<Rect>);

impl Touched {
    /// Takes in a rectangle, with `margin` pixels round it.
    pub(crate) fn add(&mut self, bounds: Rect, margin: f32) {
        let Some(bounds) = bounds.outset(margin, margin) else { return };
        self.0 = match self.0 {
            None => Some(bounds),
            Some(old) => Rect::from_ltrb(
                old.left().min(bounds.left()),
                old.top().min(bounds.top()),
                old.right().max(bounds.right()),
                old.bottom().max(bounds.bottom()),
            ),
        };
    }

    /// Takes in a straight line with `margin` pixels round it.
    pub(crate) fn add_line(&mut self, from: Spot, to: Spot, margin: f32) {
        let (left, right) = (from.x.min(to.x), from.x.max(to.x));
        let (top, bottom) = (from.y.min(to.y), from.y.max(to.y));
        if let Some(bounds) = Rect::from_ltrb(left as f32, top as f32, right as f32, bottom as f32) {
            self.add(bounds, margin);
        }
    }

    /// Left, top, right and bottom in whole pixels of the picture; `None` when nothing lies within.
    fn within(self, pixmap: &Pixmap) -> Option<(usize, usize, usize, usize)> {
        let bounds = self.0?;
        // `as` clamps negative numbers to zero; a pixel of room for antialiasing.
        let left = (bounds.left() - 1.0).floor() as usize;
        let top = (bounds.top() - 1.0).floor() as usize;
        let right = ((bounds.right() + 2.0) as usize).min(pixmap.width() as usize);
        let bottom = ((bounds.bottom() + 2.0) as usize).min(pixmap.height() as usize);
        (left < right && top < bottom).then_some((left, top, right, bottom))
    }
}

type Part = (usize, usize, usize, usize);

fn clear_part(pixmap: &mut Pixmap, (left, top, right, bottom): Part) {
    let stride = 4 * pixmap.width() as usize;
    for row in pixmap.data_mut().chunks_exact_mut(stride).take(bottom).skip(top) {
        row[4 * left..4 * right].fill(0);
    }
}

/// Pixels looked at together for being empty.
const SPAN: usize = 16;

fn blend_part(overlay: &Pixmap, (left, top, right, bottom): Part, picture: &mut [u32]) {
    let (width, height) = (overlay.width() as usize, overlay.height() as usize);
    if picture.len() != width * height {
        return;
    }
    let rows = overlay.data().chunks_exact(4 * width).zip(picture.chunks_exact_mut(width));
    for (over, under) in rows.take(bottom).skip(top) {
        let over = over[4 * left..4 * right].chunks(4 * SPAN);
        for (over, under) in over.zip(under[left..right].chunks_mut(SPAN)) {
            if over.iter().fold(0, |any, &byte| any | byte) != 0 {
                blend_span(over, under);
            }
        }
    }
}

/// Without a branch, so that several pixels go at once. The unused byte of a picture's pixel is kept.
fn blend_span(over: &[u8], under: &mut [u32]) {
    for (over, under) in over.chunks_exact(4).zip(under) {
        let colour = u32::from_be_bytes([0, over[0], over[1], over[2]]);
        let below = times(*under & 0x00ff_ffff, 255 - u32::from(over[3]));
        *under = (*under & 0xff00_0000) | (colour + below);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tiny_skia::{Color, Paint, Transform};

    fn square(width: u32, height: u32) -> Layer {
        let mut layer = Layer::new();
        let (pixmap, touched) = layer.begin(width, height).unwrap();
        let rect = Rect::from_xywh(20.0, 3.0, 4.0, 2.0).unwrap();
        let mut paint = Paint::default();
        paint.set_color(Color::from_rgba8(255, 0, 0, 128));
        pixmap.fill_rect(rect, &paint, Transform::identity(), None);
        touched.add(rect, 0.0);
        layer
    }

    #[test]
    fn transparent_pixels_stay_untouched() {
        let mut picture: Vec<u32> = (0..40 * 10).map(|index| (index * 977) | 0xab00_0000).collect();
        let before = picture.clone();
        square(40, 10).blend_over(&mut picture);
        let changed: Vec<usize> = (0..picture.len()).filter(|&at| picture[at] != before[at]).collect();
        assert_eq!(changed, [140, 141, 142, 143, 180, 181, 182, 183]);
    }

    #[test]
    fn half_red_over_white_is_pink() {
        let mut picture = vec![0x00ff_ffff; 400];
        square(40, 10).blend_over(&mut picture);
        assert_eq!(picture[3 * 40 + 20], 0x00ff_7f7f);
    }

    #[test]
    fn the_touched_part_blends_as_the_whole_does() {
        let layer = square(40, 10);
        let (mut part, mut whole) = (vec![0x0012_3456; 400], vec![0x0012_3456; 400]);
        layer.blend_over(&mut part);
        blend_over(layer.pixmap().unwrap(), &mut whole);
        assert_eq!(part, whole);
    }

    #[test]
    fn a_layer_drawn_upon_again_starts_clear() {
        let mut layer = square(40, 10);
        layer.begin(40, 10);
        assert!(layer.pixmap().unwrap().data().iter().all(|&byte| byte == 0));
        assert!(layer.touched().is_none());
    }

    #[test]
    fn a_picture_of_another_size_is_left_alone() {
        let mut picture = vec![7; 11];
        square(40, 10).blend_over(&mut picture);
        assert_eq!(picture, [7; 11]);
        let mut empty = Layer::new();
        assert!(empty.begin(0, 10).is_none());
        empty.blend_over(&mut []);
    }
}
