//! How do samples become pixels? Every pixel of a tile, one path after another, by the rules of any integrator.

use catoptra_core::Rgb;

use super::walker::{CameraRay, Walker};
use super::{Integrate, IntegratorVisitor, Search, visit};
use crate::edges::{EdgeList, EdgeRoom};
use crate::film::{NOTHING, Sum, store_finite};
use crate::sampler::Sampler;
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
        let mut walker = Walker { search, frame, stats: Stats::default() };
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
fn show_pieces<I: Integrate, S: Search>(walker: &mut Walker<'_, S>, edges: &EdgeList, tile: &mut Tile) {
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

/// Adds up the samples of a pixel; depth and surface are those of the one in the middle.
fn trace_pixel<I: Integrate, S: Search>(walker: &mut Walker<'_, S>, tile: &mut Tile, x: u32, y: u32) {
    let (frame, i) = (walker.frame, tile.index(x, y));
    let grid = frame.view.grid;
    let [column, row] = [tile.x + x, tile.y + y];
    let sampler = Sampler::new(frame.view.seed, column, row);
    let side = frame.edges.map(|_| 1.0 / f64::from(grid));
    let (mut sum, mut count) = (Rgb::BLACK, 0);
    for (u, v) in (0..grid).flat_map(|v| (0..grid).map(move |u| (u, v))) {
        let [right, down] = frame.view.place(u, v);
        let ray = frame.raster.ray(f64::from(column) + right, f64::from(row) + down);
        let sample = v.wrapping_mul(grid).wrapping_add(u);
        let (light, first) = I::gather(walker, &CameraRay { ray, sampler, sample, side });
        if frame.view.moments {
            let [before, sample] =
                [(sum, count), (light, 1)].map(|(light, count)| Sum { light: light.to_array(), count });
            tile.add_deviation(i, before.spread_to(sample));
        }
        sum += light;
        count += 1;
        if (u, v) == (grid / 2, grid / 2) {
            let distance = |hit: Hit| (hit.crossing.t * ray.direction.length()) as f32;
            tile.depth[i] = first.map_or(f32::INFINITY, distance);
            tile.surface[i] = first.map_or(NOTHING, |hit| hit.surface.prim);
        }
    }
    for (channel, light) in tile.sums.iter_mut().zip(sum.to_array()) {
        walker.stats.not_finite += store_finite(&mut channel[i], light as f32);
    }
}
