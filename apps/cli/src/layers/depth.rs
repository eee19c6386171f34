//! How far away is what the middle of each pixel shows? Metres from the eye along the ray; infinite where there is nothing.

use catoptra_scene::image::Channel;

use super::seen::float;
use super::{Layer, Need, Seen};

pub(super) const LAYER: Layer = Layer { name: "depth", needs: &[Need::Surfaces], channels };

fn channels<'a>(seen: &'a Seen<'_>) -> Vec<Channel<'a>> {
    let distance = |x, y| seen.surfaces.as_ref().map_or(f64::INFINITY, |surfaces| surfaces.distance(x, y));
    vec![float("Z", move |x, y| distance(x, y) as f32)]
}
