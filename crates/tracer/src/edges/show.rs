//! What do the pixels show that outlines cross? The same steps for every backend, which traces the rays.

use super::doubt::Doubts;
use super::find::SearchRoom;
use super::{EdgeList, PixelPieces, Places};
use crate::{EdgePixels, Region, Size, Tile, View};

/// Room for what a tile needs, kept from tile to tile.
#[derive(Debug, Default)]
pub(crate) struct EdgeRoom {
    search: SearchRoom,
    pieces: PixelPieces,
    doubts: Doubts,
    light: Vec<[f64; 3]>,
}

/// What has been done.
#[derive(Debug, Default)]
pub(crate) struct Shown {
    pub(crate) pixels: EdgePixels,
    /// Radiances that were not finite.
    pub(crate) not_finite: u64,
}

impl EdgeList {
    /// Shows the pixels of a tile that outlines cross by their pieces, and those that need more samples by these. `gather`
    /// finds the light that arrives along the camera rays through some places.
    pub(crate) fn show(
        &self,
        view: &View,
        tile: &mut Tile,
        room: &mut EdgeRoom,
        mut gather: impl FnMut(&mut Places, &mut Vec<[f64; 3]>),
    ) -> Shown {
        let EdgeRoom { search, pieces, doubts, light } = room;
        let region = Region::new(tile.x, tile.y, Size::new(tile.width, tile.height));
        let mut shown = Shown::default();
        self.find(region, search, pieces);
        doubts.find(self, region, pieces);
        if pieces.len() > 0 {
            gather(&mut pieces.places, light);
            shown.add(pieces, light, tile);
        }
        if doubts.corners.len() > 0 {
            gather(&mut doubts.corners, light);
            let so_far = |x: u32, y: u32| tile.radiance(tile.index(x, y)).map(f64::from);
            doubts.sample(region, view, (light, so_far), pieces);
            if pieces.len() > 0 {
                gather(&mut pieces.places, light);
                shown.add(pieces, light, tile);
            }
        }
        shown
    }
}

impl Shown {
    /// Gives pixels the sums of what their pieces show, by their shares.
    fn add(&mut self, pieces: &PixelPieces, light: &[[f64; 3]], tile: &mut Tile) {
        for ([x, y], pieces, shares) in pieces.pixels() {
            // Written so that pieces that look the same show exactly that.
            let light = &light[pieces];
            let mut sum = light[0];
            for (other, share) in light.iter().zip(shares).skip(1) {
                for channel in 0..3 {
                    sum[channel] += share * (other[channel] - light[0][channel]);
                }
            }
            self.not_finite += tile.set_radiance(tile.index(x, y), sum);
        }
        self.pixels += pieces.counts();
    }
}
