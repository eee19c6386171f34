//! Which colours do surfaces have of their own? What each pixel shows where light of radiance 1 comes from everywhere: mirrors and
//! glass are dark.

use catoptra_scene::image::Channel;

use super::seen::float;
use super::{Layer, Need, Seen};

pub(super) const LAYER: Layer = Layer { name: "albedo", needs: &[Need::EvenLight], channels };

fn channels<'a>(seen: &'a Seen<'_>) -> Vec<Channel<'a>> {
    let of = |name, channel: usize| {
        float(name, move |x, y| seen.even.as_ref().map_or(0.0, |film| film.radiance(x, y)[channel]))
    };
    vec![of("albedo.R", 0), of("albedo.G", 1), of("albedo.B", 2)]
}
