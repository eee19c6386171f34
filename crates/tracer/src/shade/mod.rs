//! Shading: from hits to surfaces, direct light, radiance and reflected rays.

mod chunk;
mod direct_light;
mod filled;
mod groups;
mod hits;
mod lamp_rays;
mod lamps;
#[cfg(test)]
mod lobe_tests;
mod look;
#[cfg(test)]
mod profile_tests;
mod reflect;
mod rules;
mod scatter;

use catoptra_core::Constant3;
use fearless_simd::Simd;

use crate::View;
use crate::cull::TilePlan;
use crate::lanes::{F3, splat3};
use crate::sample::Sample;
use crate::search::{BundleRoom, Searcher};
use crate::stream::{LaneBounds, Queue};

pub(crate) use chunk::Chunk;
pub(crate) use lamps::LampRoom;
pub(crate) use rules::{MirrorNormals, continues, mirror_direction, survival};

/// What is gathered beside direct light, and how.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gathers {
    /// Whether rays go on in directions chosen by chance, one from every point, as the integrator `path` has it; else mirrored
    /// ones alone.
    pub(crate) paths: bool,
    /// Radiance of what meets nothing.
    pub(crate) sky: Constant3,
    /// What arrives from all sides, in place of what paths would find.
    pub(crate) ambient: Constant3,
}

/// Gathers the light of packets, a chunk of them at a time.
pub(crate) struct Shader<'a, S: Simd> {
    pub(crate) s: S,
    pub(crate) search: Searcher<'a, S>,
    pub(crate) view: &'a View,
    /// What rays gather.
    pub(crate) gathers: Gathers,
    /// What culling knows about the current batch.
    pub(crate) plan: &'a mut TilePlan,
    pub(crate) chunk: &'a mut Chunk<S>,
    pub(crate) lamp_room: &'a mut LampRoom,
    /// Which of the pixels' samples is under way.
    pub(crate) sample: Sample,
    /// Rays that surfaces send on.
    pub(crate) next: &'a mut Queue,
    /// Where those start, and the unit vectors along which they run.
    pub(crate) sent: &'a mut LaneBounds<S, 2>,
    /// Room for packets that walk meshes together.
    pub(crate) bundle: &'a mut BundleRoom<S>,
}

/// No light in any lane.
#[inline(always)]
fn dark<S: Simd>(s: S) -> F3<S> {
    splat3(s, [0.0; 3])
}
