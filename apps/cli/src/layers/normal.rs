//! Which way does the surface look that the middle of each pixel shows? Unit, in the world, on the side that is seen; 0 where
//! there is nothing.

use catoptra_core::glam::DVec3;
use catoptra_scene::image::Channel;

use super::seen::float;
use super::{Layer, Need, Seen};
use crate::surfaces::side;

pub(super) const LAYER: Layer = Layer { name: "normal", needs: &[Need::Surfaces], channels };

fn channels<'a>(seen: &'a Seen<'_>) -> Vec<Channel<'a>> {
    let of = |name, axis: usize| float(name, move |x, y| normal(seen, x, y)[axis] as f32);
    vec![of("normal.X", 0), of("normal.Y", 1), of("normal.Z", 2)]
}

fn normal(seen: &Seen<'_>, x: u32, y: u32) -> DVec3 {
    let Some(surfaces) = &seen.surfaces else { return DVec3::ZERO };
    let towards = surfaces.ray(x, y).direction;
    seen.met(x, y).map_or(DVec3::ZERO, |met| met.shading_normal * side(&met, towards))
}
