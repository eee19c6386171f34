//! Where on its texture does the middle of each pixel lie? 0 where there is nothing.

use catoptra_scene::image::Channel;

use super::seen::float;
use super::{Layer, Need, Seen};

pub(super) const LAYER: Layer = Layer { name: "uv", needs: &[Need::Surfaces], channels };

fn channels<'a>(seen: &'a Seen<'_>) -> Vec<Channel<'a>> {
    let of =
        |name, axis: usize| float(name, move |x, y| seen.met(x, y).map_or(0.0, |met| met.uv[axis] as f32));
    vec![of("uv.U", 0), of("uv.V", 1)]
}
