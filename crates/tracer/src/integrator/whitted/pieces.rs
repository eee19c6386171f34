//! The light that arrives along camera rays through any places of a tile, over packets of rays: what shows the pixels that
//! outlines cross.

use fearless_simd::Simd;

use super::streams::Bounce;
use super::tiles::TileTracer;
use crate::cull::{Candidates, Frustum};
use crate::edges::{EdgeList, EdgeRoom, Places};
use crate::lanes::{F, outlined};
use crate::stream::Queue;
use crate::{Region, Size, Tile};

/// Room for the rays of a tile.
pub(super) struct PieceRoom {
    edges: EdgeRoom,
    rays: Queue,
    /// The light of every ray.
    light: Tile,
}

impl Default for PieceRoom {
    fn default() -> Self {
        Self { edges: EdgeRoom::default(), rays: Queue::default(), light: Tile::without_pixels() }
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
        let (frame, columns) = (self.frame, self.frame.snapshot.columns());
        if tile.is_blank() {
            return;
        }
        let PieceRoom { edges: room, rays, light } = room;
        let mut known = false;
        let shown = edges.show(frame.view, tile, room, |places, found| {
            if !known {
                visible.visible_through(&Frustum::new(frame, &place), columns, all, self.planner.outside);
                known = true;
            }
            self.gather(places, visible, (rays, bounce, light));
            found.clear();
            let [red, green, blue] = &light.sums;
            found.extend((0..places.len()).map(|at| [red[at], green[at], blue[at]].map(f64::from)));
        });
        let stats = &mut self.shader.search.stats;
        stats.edges += shown.pixels;
        stats.not_finite += shown.not_finite;
    }

    /// Finds the light that arrives along the camera rays through some places.
    fn gather(
        &mut self,
        places: &mut Places,
        visible: &Candidates,
        (rays, bounce, light): (&mut Queue, &mut Bounce, &mut Tile),
    ) {
        rays.start(self.frame.snapshot.origin_in_frame(), f64::INFINITY);
        places.fill_up(F::<S>::LANES);
        outlined(
            self.s,
            #[inline(always)]
            || rays.push_camera_rays(self.s, self.frame, places),
        );
        light.hold_rays((0..places.len()).map(|at| [places.x[at] as u32, places.y[at] as u32]));
        self.shader.plan.dark.clear();
        self.trace(&*rays, visible, light, 0);
        if self.shader.next.len() > 0 {
            self.follow(bounce, light);
        }
    }
}
