//! Where is the edge of what is selected? Between pixels that see it and pixels that do not.

use catoptra_core::scene::EntityId;
use catoptra_tracer::{Film, Size};

use crate::canvas::Pixels;
use crate::fit::Fit;

/// The colour of the outline, 0x00RRGGBB.
const COLOR: u32 = 0x00ff_b02e;

/// Draws the outline of all that `selected` says yes to over the picture that was laid out from the film, at least
/// `width` pixels wide.
pub(crate) fn draw(film: &Film, width: u32, selected: impl Fn(EntityId) -> bool, picture: &mut Pixels) {
    let Size { width: columns, height: rows } = film.size();
    let mask = mask(film, selected);
    let fit = Fit::new((columns, rows), (picture.width, picture.height));
    let side = f64::from(width).max(fit.scale());
    let at = |x: u32, y: u32| mask[y as usize * columns as usize + x as usize];
    for y in 0..rows {
        for x in 0..columns {
            let inside = at(x, y);
            let differs =
                (x + 1 < columns && at(x + 1, y) != inside) || (y + 1 < rows && at(x, y + 1) != inside);
            if differs {
                let (left, top) = fit.corner(x, y);
                dot(picture, (left, left + side), (top, top + side));
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

/// Fills a square, as far as it lies in the picture.
fn dot(picture: &mut Pixels, across: (f64, f64), down: (f64, f64)) {
    // A negative number becomes 0.
    let pixel = |v: f64, most: u32| (v.round() as u32).min(most) as usize;
    let (left, right) = (pixel(across.0, picture.width), pixel(across.1, picture.width));
    for row in pixel(down.0, picture.height)..pixel(down.1, picture.height) {
        let start = row * picture.width as usize;
        picture.data[start + left..start + right].fill(COLOR);
    }
}
