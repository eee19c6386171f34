//! Sends the paths of a chunk on: from every point one ray, in a direction that one of its lobes chooses, from points in `f64`.

use catoptra_core::lobe::Diffuse;
use catoptra_core::{Constant3, Lane, LaneMask, Material, Rgb};
use fearless_simd::Simd;

use super::rules::survival;
use super::{Gathers, Shader, dark};
use crate::lanes::{F, F3, M, MOST_LANES, U, Word, outlined, pick3, share_of_one, widen3};
use crate::sampler::{Sampler, pairs};
use crate::snapshot::MaterialRow;
use crate::stream::{Batch, QueuedRays};
use crate::{Snapshot, Tile};

impl Gathers {
    /// By the rules of Whitted.
    pub(crate) fn mirrored(snapshot: &Snapshot) -> Self {
        Self { paths: false, sky: *snapshot.background_light(), ambient: *snapshot.ambient_light() }
    }

    /// By paths, where lanes can follow them: where they know all lobes, light from all around is the same everywhere, and all
    /// lamps are asked.
    pub(crate) fn paths(snapshot: &Snapshot) -> Option<Self> {
        let lobes_known = snapshot.material_rows().iter().all(|row| !row.lobes.is_glossy());
        if !(snapshot.matter().is_plain && snapshot.lamps().tree_of_paths().is_none() && lobes_known) {
            return None;
        }
        let sky = snapshot.matter().sky(snapshot.background())?;
        Some(Self { paths: true, sky: Constant3::from(sky), ambient: Constant3::from(Rgb::BLACK) })
    }

    /// Whether nothing is seen of what meets nothing.
    pub(crate) fn is_dark(&self) -> bool {
        [&self.sky.x, &self.sky.y, &self.sky.z].iter().all(|channel| channel.narrow == 0.0)
    }
}

/// The lobes that paths choose among: how much of what arrives each sends on.
struct Choice<S: Simd> {
    diffuse: F3<S>,
    mirrored: F3<S>,
}

impl<S: Simd> Shader<'_, S> {
    /// Queues the rays that the first packets of the chunk send on. See [`outlined`].
    #[inline(always)]
    pub(super) fn scatter_paths(&mut self, batch: &impl Batch<S>, count: usize, tile: &Tile, depth: u32) {
        outlined(
            self.s,
            #[inline(always)]
            || {
                for slot in 0..count {
                    self.scatter(batch, slot, tile, depth);
                }
            },
        );
    }

    /// Queues the rays that a packet sends on.
    #[inline(always)]
    fn scatter(&mut self, batch: &impl Batch<S>, slot: usize, tile: &Tile, depth: u32) {
        let s = self.s;
        let (zero, one) = (F::splat(s, 0.0), F::splat(s, 1.0));
        let live = self.chunk.best[slot].hits() & batch.live_lanes(s, self.chunk.at[slot]);
        let Choice { diffuse, mirrored } = self.choice(batch, slot);
        let (of_diffuse, of_mirror) = (largest(diffuse), largest(mirrored));
        let all = of_diffuse + of_mirror;
        let sending = live & zero.less(all);
        if !sending.any() {
            return;
        }
        if depth >= self.view.path_depth {
            self.search.stats.skipped.depth_limit += sending.count();
            return;
        }
        let pixels = batch.pixels(s, self.chunk.at[slot]);
        let sampler = self.sampler_of(pixels, sending, 1, tile);
        let sample = pixels.of(self.sample.index);
        let [choose, survive] = sampler.pair(sample, pairs::bounce(depth, 0)).map(share_of_one);
        let u = sampler.pair(sample, pairs::bounce(depth, 1)).map(share_of_one);
        let is_diffuse = (choose * all).less(of_diffuse);
        let chosen = F3::select(is_diffuse, diffuse, mirrored);
        let weight = batch.weights(s, self.chunk.at[slot]).times(chosen.scale(all / largest(chosen)));
        let stays = survival(largest(weight), depth);
        let sent = sending & survive.less(stays);
        if sent.any() {
            let weight = weight.scale(one / stays);
            self.send(batch, slot, (sent, is_diffuse), weight, (pixels, u));
        }
    }

    /// What the lobes of a packet's points send on.
    #[inline(always)]
    fn choice(&mut self, batch: &impl Batch<S>, slot: usize) -> Choice<S> {
        let mut choice = Choice { diffuse: dark(self.s), mirrored: dark(self.s) };
        for group in 0..self.chunk.groups[slot].len() {
            let (mask, material) = self.chunk.groups[slot].get(self.s, group);
            let row = &self.search.snapshot.material_rows()[material];
            if row.is_pattern && batch.has_footprints() {
                self.move_off_edges(batch, slot, mask, &row.material);
            }
            let [diffuse, mirrored] = row.material.visit_lobes(
                #[inline(always)]
                || self.shading_point(slot),
                #[inline(always)]
                |lobes| {
                    let none = dark(self.s);
                    let diffuse = lobes.diffuse.map_or(none, |diffuse| diffuse.albedo.scale(lobes.share));
                    [diffuse, lobes.mirror.map_or(none, |mirror| mirror.tint)]
                },
            );
            choice.diffuse = F3::select(mask, diffuse, choice.diffuse);
            choice.mirrored = F3::select(mask, mirrored, choice.mirrored);
        }
        choice
    }

    /// Queues rays of some lanes of a packet.
    #[inline(always)]
    fn send(
        &mut self,
        batch: &impl Batch<S>,
        slot: usize,
        (sent, is_diffuse): (M<S>, M<S>),
        weight: F3<S>,
        (pixel, u): (U<S>, [F<S>; 2]),
    ) {
        let packet = &self.packet_of(batch, slot);
        let best = self.chunk.best[slot];
        let refined = self.search.refine_every(packet, &best, sent);
        let smooth = self.search.snapshot.columns().smooth;
        let ground = self.chunk.normal[slot];
        let normal = if smooth { self.chunk.smooth[slot] } else { ground };
        let (scattered, _) = Diffuse::direction(normal, u);
        let mut direction = widen3(scattered);
        // What would run into the surface ends there.
        let sent = sent & !(is_diffuse & !F::splat(self.s, 0.0).less(scattered.dot(ground)));
        if (sent & !is_diffuse).any() {
            direction = pick3(is_diffuse, direction, self.mirrored(packet, &refined, slot));
        }
        let rays = QueuedRays {
            origin: refined.point,
            direction,
            weight,
            pixel,
            prim: best.prim,
            facet: best.facet,
        };
        self.next.push_chosen(sent, &rays, !is_diffuse);
    }

    /// The random numbers of the squares of the film, so many pixels wide, that the lanes' pixels lie in.
    #[inline(always)]
    pub(super) fn sampler_of(&self, pixels: U<S>, lanes: M<S>, side: u32, tile: &Tile) -> Sampler<U<S>> {
        let (mut columns, mut rows) = ([0; MOST_LANES], [0; MOST_LANES]);
        for lane in lanes.lanes() {
            let [x, y] = tile.place_of(pixels.lane(lane) as usize);
            (columns[lane], rows[lane]) = (x / side, y / side);
        }
        self.sample.sampler(U::load(self.s, &columns), U::load(self.s, &rows))
    }

    /// The lanes of one material whose own light counts: all, but for what was gathered where a path comes from.
    #[inline(always)]
    pub(super) fn counted_emission(
        &self,
        batch: &impl Batch<S>,
        slot: usize,
        mask: M<S>,
        row: &MaterialRow,
    ) -> M<S> {
        let every = M::splat(self.s, true);
        if !self.gathers.paths {
            return every;
        }
        let alone = batch.alone(self.s, self.chunk.at[slot]);
        if matches!(row.material, Material::Depth(_)) {
            return alone;
        }
        let areas = &self.search.snapshot.lamps().areas;
        let mut counted = alone;
        for (prim, lanes) in self.chunk.best[slot].prim.groups(mask & !alone) {
            if !areas.contains_key(&prim) {
                counted = counted | lanes;
            }
        }
        counted
    }
}

/// The largest channel.
#[inline(always)]
fn largest<S: Simd>(light: F3<S>) -> F<S> {
    light.x.max(light.y).max(light.z)
}
