//! How a picture is shared out among threads.

use std::ops::Range;

use rayon::prelude::*;

use crate::edges::EdgeList;
use crate::{Backend, Cancelled, Control, Film, Frame, Pool, Snapshot, Stats, Tile, View};

/// Traces a picture into `film`, tile by tile, on the threads of `pool`.
///
/// The result depends on neither the number of threads nor the size of the tiles.
///
/// # Errors
/// [`Cancelled`] when `control` said so before the last tile was begun; the film then holds some new tiles and some old ones.
///
/// # Panics
/// A film of another part of the picture than the view's, or without the samples that the view [goes on](View::range)
/// from: tiles that hold those and the view's own already are left as they are.
pub fn render(
    backend: &dyn Backend,
    snapshot: &Snapshot,
    view: &View,
    film: &mut Film,
    pool: &Pool,
    control: &Control,
) -> Result<Stats, Cancelled> {
    assert_eq!(film.region(), view.region(), "the film holds what the view shows");
    let Range { start: first, end } = view.traced_samples();
    let is_done = |tile: &Tile| first > 0 && tile.holds_evenly(end);
    let goes_on = first == 0 || film.tiles_mut().iter().all(|tile| tile.holds(first) || is_done(tile));
    assert!(goes_on, "the film holds the samples before number {first}");
    let frame = Frame::new(snapshot, view);
    let edges = EdgeList::for_view(snapshot, view, &frame.raster);
    let frame = Frame { edges: edges.as_ref(), ..frame };
    let tiles = film.tiles_mut();
    control.start(tiles.len());
    let trace = |tile: &mut Tile| {
        if control.is_cancelled() {
            return Err(Cancelled);
        }
        if is_done(tile) {
            control.advance(1);
            return Ok(Stats::default());
        }
        tile.begin(snapshot.entities(), view);
        let stats = Stats::with_exact(|| backend.trace(&frame, tile));
        control.advance(1);
        Ok(stats)
    };
    let add = |mut a: Stats, b: Stats| {
        a += b;
        Ok(a)
    };
    pool.run(|| tiles.par_iter_mut().with_max_len(1).map(trace).try_reduce(Stats::default, add))
}

#[cfg(test)]
mod tests;
