//! Do two films agree in every bit?

use catoptra_core::EntityId;
use catoptra_tracer::{Film, Region, Size};

/// Everything that a film knows of a pixel, numbers by their bits.
#[derive(Debug, PartialEq)]
struct PixelBits {
    radiance: [u32; 3],
    standard_error: Option<u32>,
    samples: u32,
    depth: u32,
    surface: Option<EntityId>,
}

/// The pixels of a film.
fn bits(film: &Film) -> Vec<PixelBits> {
    let Size { width, height } = film.size();
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixel = |(x, y)| PixelBits {
        radiance: film.radiance(x, y).map(f32::to_bits),
        standard_error: film.standard_error(x, y).map(f32::to_bits),
        samples: film.samples(x, y),
        depth: film.depth(x, y).to_bits(),
        surface: film.surface(x, y),
    };
    places.map(pixel).collect()
}

/// Two films have the same bits.
///
/// # Panics
/// Where they have not, with the first pixel that differs.
#[track_caller]
pub fn assert_same_bits(reference: &Film, test: &Film, what: &str) {
    let width = reference.size().width as usize;
    let (reference, test) = (bits(reference), bits(test));
    assert_eq!(reference.len(), test.len(), "{what}: films of one size");
    let differing: Vec<usize> = (0..reference.len()).filter(|&i| reference[i] != test[i]).collect();
    if let Some(&first) = differing.first() {
        let (x, y) = (first % width, first / width);
        let (was, is) = (&reference[first], &test[first]);
        panic!("{what}: {} pixels differ, the first at {x},{y}: {was:x?} became {is:x?}", differing.len());
    }
}

/// The part of a whole film that a cropped one holds has the same bits.
///
/// # Panics
/// Where it has not.
#[track_caller]
pub fn assert_same_part(whole: &Film, part: &Film, what: &str) {
    let Region { x, y, size } = part.region();
    let (whole_bits, part_bits) = (bits(whole), bits(part));
    for row in 0..size.height {
        for column in 0..size.width {
            let was = &whole_bits[((y + row) * whole.size().width + x + column) as usize];
            let is = &part_bits[(row * size.width + column) as usize];
            assert!(was == is, "{what} at {column},{row}: {was:x?} became {is:x?}");
        }
    }
}
