//! Which light does each pixel show? Linear red, green and blue.

use catoptra_scene::image::Channel;

use super::seen::float;
use super::{Layer, Seen};

pub(super) const LAYER: Layer = Layer { name: "color", needs: &[], channels };

fn channels<'a>(seen: &'a Seen<'_>) -> Vec<Channel<'a>> {
    let of = |name, channel: usize| float(name, move |x, y| seen.film.radiance(x, y)[channel]);
    vec![of("R", 0), of("G", 1), of("B", 2)]
}
