//! How do samples become pixels? Every pixel of a tile, one path after another, by the rules of any integrator.

use catoptra_core::lobe::point_of_disk;
use catoptra_core::{Ray, RayStart};

use super::walker::{CameraRay, Walker};
use super::{Integrate, IntegratorVisitor, Search, visit};
use crate::edges::{EdgeList, EdgeRoom};
use crate::film::NOTHING;
use crate::sample::Sample;
use crate::sampler::{Sampler, pairs, share};
use crate::{Frame, Hit, Stats, Tile};

/// Traces every pixel of a tile by the rules of the view's integrator.
pub(crate) fn trace_pixels(search: &impl Search, frame: &Frame<'_>, tile: &mut Tile) -> Stats {
    visit(frame.view.integrator, Pixels { search, frame, tile })
}

struct Pixels<'a, S> {
    search: &'a S,
    frame: &'a Frame<'a>,
    tile: &'a mut Tile,
}

impl<S: Search> IntegratorVisitor for Pixels<'_, S> {
    type Output = Stats;

    fn visit<I: Integrate>(self) -> Stats {
        let Self { search, frame, tile } = self;
        let mut walker = Walker::new(search, frame);
        let (width, height) = (tile.width, tile.height);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            trace_pixel::<I, S>(&mut walker, tile, x, y);
        }
        if let Some(edges) = frame.edges {
            show_pieces::<I, S>(&mut walker, edges, tile);
        }
        walker.stats
    }
}

/// Shows the pixels of a tile that outlines cross, in place of what their samples have shown.
pub(super) fn show_pieces<I: Integrate, S: Search>(
    walker: &mut Walker<'_, S>,
    edges: &EdgeList,
    tile: &mut Tile,
) {
    let (frame, mut room) = (walker.frame, EdgeRoom::default());
    let shown = edges.show(frame.view, tile, &mut room, |places, light| {
        light.clear();
        for at in 0..places.len() {
            let (x, y) = (places.x[at], places.y[at]);
            let sampler = Sampler::new(frame.view.seed, x as u32, y as u32);
            let ray = frame.raster.ray(x, y);
            let side = Some(places.side[at]);
            light.push(I::gather(walker, &CameraRay { ray, sampler, sample: 0, side }).0.to_array());
        }
    });
    walker.stats.edges += shown.pixels;
    walker.stats.not_finite += shown.not_finite;
}

/// Adds up the samples of a pixel.
fn trace_pixel<I: Integrate, S: Search>(walker: &mut Walker<'_, S>, tile: &mut Tile, x: u32, y: u32) {
    let (frame, i) = (walker.frame, tile.index(x, y));
    let [column, row] = [tile.x + x, tile.y + y];
    let side = frame.edges.map(|_| frame.view.side_of_sample());
    for number in frame.view.traced_samples() {
        if !tile.is_active(i, number) {
            break;
        }
        let sample = Sample::new(frame.view, number);
        let sampler = sample.sampler(column, row);
        let [right, down] = sample.place(sampler);
        let at = [f64::from(column) + right, f64::from(row) + down];
        let ray = camera_ray(frame, at, &sample, sampler);
        let (light, first) = I::gather(walker, &CameraRay { ray, sampler, sample: sample.index, side });
        walker.stats.not_finite += tile.add_sample(i, light, number, frame.view);
        if sample.kept {
            let distance = |hit: Hit| (hit.crossing.t * ray.direction.length()) as f32;
            tile.depth[i] = first.map_or(f32::INFINITY, distance);
            tile.surface[i] = first.map_or(NOTHING, |hit| hit.surface.prim);
        }
    }
}

/// The camera's ray through a place of the picture, from a point of the lens that the sample chooses.
fn camera_ray(frame: &Frame<'_>, [x, y]: [f64; 2], sample: &Sample, sampler: Sampler<u32>) -> Ray {
    match frame.raster.start {
        RayStart::Eye | RayStart::Window(_) => frame.raster.ray(x, y),
        RayStart::Lens(_) => {
            let on_lens = point_of_disk(sampler.pair(sample.index, pairs::LENS).map(share));
            frame.raster.ray_from(x, y, on_lens)
        }
    }
}
