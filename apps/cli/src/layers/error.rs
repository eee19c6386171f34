//! How sure is each pixel? The standard error of its luminance; 0 where it is not known.

use catoptra_scene::image::Channel;

use super::seen::float;
use super::{Layer, Need, Seen};

pub(super) const LAYER: Layer = Layer { name: "error", needs: &[Need::Errors], channels };

fn channels<'a>(seen: &'a Seen<'_>) -> Vec<Channel<'a>> {
    vec![float("error.Y", |x, y| seen.film.standard_error(x, y).unwrap_or(0.0))]
}
