//! What is in the window below egui? The traced picture, scaled to its place, and the overlays over it: a frame of
//! 0x00RRGGBB pixels that is kept, so that showing egui again costs a copy and no drawing.

/// What surrounds the picture while there is none.
pub(crate) const BACKDROP: u32 = 0x0014_161a;

/// A rectangle of pixels, half open; empty where it does not have both sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Region {
    /// First column.
    pub(crate) left: u32,
    /// First row.
    pub(crate) top: u32,
    /// Column after the last.
    pub(crate) right: u32,
    /// Row after the last.
    pub(crate) bottom: u32,
}

impl Region {
    /// No pixel.
    pub(crate) const NOTHING: Self = Self { left: u32::MAX, top: u32::MAX, right: 0, bottom: 0 };

    /// All of a frame.
    pub(crate) fn whole((width, height): (u32, u32)) -> Self {
        Self { left: 0, top: 0, right: width, bottom: height }
    }

    /// Whether it holds no pixel.
    pub(crate) fn is_empty(self) -> bool {
        self.left >= self.right || self.top >= self.bottom
    }

    /// The smallest that holds both.
    #[must_use]
    pub(crate) fn union(self, other: Self) -> Self {
        if self.is_empty() {
            return other;
        }
        if other.is_empty() {
            return self;
        }
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    /// Width and height in pixels.
    pub(crate) fn size(self) -> (u32, u32) {
        (self.right.saturating_sub(self.left), self.bottom.saturating_sub(self.top))
    }
}

/// Pixels with their size, row-major from the top left, 0x00RRGGBB.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Pixels {
    /// Width in pixels.
    pub(crate) width: u32,
    /// Height in pixels.
    pub(crate) height: u32,
    /// `width * height` of them.
    pub(crate) data: Vec<u32>,
}

/// The picture with all that is drawn over it, below egui.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    picture: Pixels,
}

impl Canvas {
    /// Lays a traced picture out to a size in pixels, each of its pixels standing for `divisor` x `divisor`; what
    /// it does not reach becomes backdrop.
    pub(crate) fn lay(&mut self, traced: &Pixels, divisor: u32, (width, height): (u32, u32)) {
        self.picture.width = width;
        self.picture.height = height;
        self.picture.data.resize(width as usize * height as usize, BACKDROP);
        if width == 0 {
            return;
        }
        let reach = |pixels: u32, room: u32| pixels.saturating_mul(divisor).min(room) as usize;
        let (right, bottom) = (reach(traced.width, width), reach(traced.height, height));
        let divisor = divisor.max(1) as usize;
        for (y, row) in self.picture.data.chunks_exact_mut(width as usize).enumerate() {
            if y < bottom {
                let from = &traced.data[y / divisor * traced.width as usize..][..traced.width as usize];
                stretch(from, divisor, &mut row[..right]);
                row[right..].fill(BACKDROP);
            } else {
                row.fill(BACKDROP);
            }
        }
    }

    /// The picture's pixels, to draw over.
    pub(crate) fn picture_mut(&mut self) -> &mut Pixels {
        &mut self.picture
    }

    /// Width and height of the picture in pixels.
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.picture.width, self.picture.height)
    }

    /// Fills a frame `width` pixels wide: the picture in the top left corner, backdrop round it.
    pub(crate) fn copy_to(&self, frame: &mut [u32], width: u32) {
        let covered = self.picture.width.min(width) as usize;
        let mut rows = self.picture.data.chunks_exact((self.picture.width as usize).max(1));
        for row in frame.chunks_exact_mut((width as usize).max(1)) {
            let from = if covered > 0 { rows.next() } else { None };
            let covered = if let Some(from) = from {
                row[..covered].copy_from_slice(&from[..covered]);
                covered
            } else {
                0
            };
            row[covered..].fill(BACKDROP);
        }
    }
}

fn stretch(from: &[u32], divisor: usize, to: &mut [u32]) {
    if divisor == 1 {
        to.copy_from_slice(&from[..to.len()]);
        return;
    }
    for (block, pixel) in to.chunks_mut(divisor).zip(from) {
        block.fill(*pixel);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn traced() -> Pixels {
        Pixels { width: 2, height: 2, data: vec![1, 2, 3, 4] }
    }

    #[test]
    fn a_coarse_picture_fills_its_place_in_blocks() {
        let mut canvas = Canvas::default();
        canvas.lay(&traced(), 2, (3, 4));
        assert_eq!(canvas.picture_mut().data, [1, 1, 2, 1, 1, 2, 3, 3, 4, 3, 3, 4]);
    }

    #[test]
    fn a_picture_larger_than_its_place_is_cut() {
        let mut canvas = Canvas::default();
        canvas.lay(&traced(), 1, (1, 3));
        assert_eq!(canvas.picture_mut().data, [1, 3, BACKDROP]);
    }

    #[test]
    fn an_empty_place_takes_anything() {
        let mut canvas = Canvas::default();
        canvas.lay(&traced(), 1, (0, 2));
        let mut frame = [7; 2];
        canvas.copy_to(&mut frame, 2);
        assert_eq!(frame, [BACKDROP; 2]);
    }

    #[test]
    fn a_frame_holds_the_picture_and_backdrop_round_it() {
        let mut canvas = Canvas::default();
        canvas.lay(&traced(), 1, (2, 2));
        let mut frame = [7; 9];
        canvas.copy_to(&mut frame, 3);
        let b = BACKDROP;
        assert_eq!(frame, [1, 2, b, 3, 4, b, b, b, b]);
        canvas.copy_to(&mut frame[..3], 1);
        assert_eq!(frame[..3], [1, 3, b]);
    }

    #[test]
    fn an_empty_region_adds_nothing_to_a_union() {
        let some = Region { left: 1, top: 2, right: 3, bottom: 4 };
        assert_eq!(Region::NOTHING.union(some), some);
        assert_eq!(some.union(Region::NOTHING), some);
        assert_eq!(some.size(), (2, 2));
    }
}
