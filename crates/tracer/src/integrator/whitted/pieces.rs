//! Pixels that outlines cross, over packets of rays: a ray through each piece gathers its light by itself, and the pieces of
//! a pixel are added up by their shares.

use fearless_simd::Simd;

use super::streams::Bounce;
use super::tiles::TileTracer;
use crate::cull::{Candidates, Frustum};
use crate::edges::{EdgeList, PixelPieces};
use crate::lanes::{F, outlined};
use crate::stream::Queue;
use crate::{Region, Size, Tile};

/// Room for the pieces of a tile.
pub(super) struct PieceRoom {
    pieces: PixelPieces,
    rays: Queue,
    /// The light of every piece.
    light: Tile,
}

impl Default for PieceRoom {
    fn default() -> Self {
        Self { pieces: PixelPieces::default(), rays: Queue::default(), light: Tile::without_pixels() }
    }
}

impl<S: Simd> TileTracer<'_, S> {
    /// Shows the pixels of a tile that outlines cross, in place of what their samples have shown.
    pub(super) fn show_pieces(
        &mut self,
        edges: &EdgeList,
        [all, visible]: [&mut Candidates; 2],
        (room, bounce): (&mut PieceRoom, &mut Bounce),
        tile: &mut Tile,
    ) {
        let place = Region::new(tile.x, tile.y, Size::new(tile.width, tile.height));
        let PieceRoom { pieces, rays, light } = room;
        edges.find(place, pieces);
        let (frame, snapshot) = (self.frame, self.frame.snapshot);
        let columns = snapshot.columns();
        if pieces.len() == 0 {
            return;
        }
        visible.visible_through(&Frustum::new(frame, &place), columns, all, self.planner.outside);
        if visible.is_empty() && columns.general_unbounded.is_empty() {
            return;
        }
        rays.start(snapshot.origin_in_frame(), f64::INFINITY);
        let count = pieces.len();
        pieces.fill_up(F::<S>::LANES);
        outlined(
            self.s,
            #[inline(always)]
            || rays.push_camera_rays(self.s, frame, [&pieces.x, &pieces.y], count),
        );
        light.hold_rays(count);
        self.shader.plan.dark.clear();
        self.trace(&*rays, visible, light, 0);
        if self.shader.next.len() > 0 {
            self.follow(bounce, light);
        }
        let stats = &mut self.shader.search.stats;
        for ([x, y], pieces, shares) in pieces.pixels() {
            let mut sum = [0.0; 3];
            for (at, share) in pieces.zip(shares) {
                for (sum, light) in sum.iter_mut().zip(&light.sums) {
                    *sum += share * f64::from(light[at]);
                }
            }
            stats.not_finite += tile.set_radiance(tile.index(x, y), sum);
        }
        pieces.count(&mut stats.edges);
    }
}
