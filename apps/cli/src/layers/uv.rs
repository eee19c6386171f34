//! Where on its texture does the middle of each pixel lie? 0 where there is nothing.

use catoptra_core::glam::DVec2;
use catoptra_scene::image::Channel;

use super::seen::float;
use super::{Layer, Need, Seen};

pub(super) const LAYER: Layer = Layer { name: "uv", needs: &[Need::Surfaces], channels };

fn channels<'a>(seen: &'a Seen<'_>) -> Vec<Channel<'a>> {
    let of = |name, axis: usize| float(name, move |x, y| uv(seen, x, y)[axis] as f32);
    vec![of("uv.U", 0), of("uv.V", 1)]
}

fn uv(seen: &Seen<'_>, x: u32, y: u32) -> DVec2 {
    let met = seen.surfaces.as_ref().and_then(|surfaces| surfaces.met(x, y));
    met.and_then(|(met, _)| seen.shapes.uv(&met)).unwrap_or(DVec2::ZERO)
}
