//! How sure is each pixel? The standard errors of its red, green and blue; 0 where they are not known.

use catoptra_scene::image::Channel;

use super::seen::float;
use super::{Layer, Need, Seen};

pub(super) const LAYER: Layer = Layer { name: "error", needs: &[Need::Errors], channels };

fn channels<'a>(seen: &'a Seen<'_>) -> Vec<Channel<'a>> {
    let of = |name, channel: usize| {
        float(name, move |x, y| seen.film.channel_errors(x, y).map_or(0.0, |errors| errors[channel]))
    };
    vec![of("error.R", 0), of("error.G", 1), of("error.B", 2)]
}
