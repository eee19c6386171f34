//! Where is the edge of what is selected? Between pixels that see it and pixels that do not.

use catoptra_core::scene::EntityId;
use catoptra_tracer::{Film, Size};

use crate::canvas::Pixels;

/// The colour of the outline, 0x00RRGGBB.
const COLOR: u32 = 0x00ff_b02e;

/// Draws the outline of all that `selected` says yes to, `width` pixels wide, over a picture in which each pixel of
/// the film stands for `divisor` x `divisor`.
pub(crate) fn draw(
    film: &Film,
    divisor: u32,
    width: u32,
    selected: impl Fn(EntityId) -> bool,
    picture: &mut Pixels,
) {
    let Size { width: columns, height: rows } = film.size();
    let mask = mask(film, selected);
    let at = |x: u32, y: u32| mask[y as usize * columns as usize + x as usize];
    for y in 0..rows {
        for x in 0..columns {
            let inside = at(x, y);
            let differs =
                (x + 1 < columns && at(x + 1, y) != inside) || (y + 1 < rows && at(x, y + 1) != inside);
            if differs {
                dot(picture, x * divisor, y * divisor, width.max(divisor));
            }
        }
    }
}

fn mask(film: &Film, selected: impl Fn(EntityId) -> bool) -> Vec<bool> {
    let Size { width, height } = film.size();
    let mut last = (None, false);
    let mut seen = |id: Option<EntityId>| {
        if id != last.0 {
            last = (id, id.is_some_and(&selected));
        }
        last.1
    };
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| seen(film.surface(x, y))).collect()
}

fn dot(picture: &mut Pixels, x: u32, y: u32, side: u32) {
    let right = (x + side).min(picture.width) as usize;
    for row in y..(y + side).min(picture.height) {
        let start = row as usize * picture.width as usize;
        if let Some(span) = picture.data.get_mut(start + (x as usize).min(right)..start + right) {
            span.fill(COLOR);
        }
    }
}
