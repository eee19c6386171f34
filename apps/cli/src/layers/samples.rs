//! How many samples has each pixel?

use catoptra_scene::image::Channel;

use super::seen::whole;
use super::{Layer, Seen};

pub(super) const LAYER: Layer = Layer { name: "samples", needs: &[], channels };

fn channels<'a>(seen: &'a Seen<'_>) -> Vec<Channel<'a>> {
    vec![whole("samples", |x, y| seen.film.samples(x, y))]
}
