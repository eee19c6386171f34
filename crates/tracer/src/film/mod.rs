//! Where a picture is gathered: linear light, depth and surface of every pixel, in tiles that are written apart.
//!
//! Light is kept as the sum over a pixel's samples; reading divides by how many they are. Where a pixel has one sample alone,
//! that is the `f32` column that it was traced into.

mod deviations;
mod replicates;
mod stored;
mod sums;
mod tile;

use catoptra_core::EntityId;

use crate::{Region, Size};
pub(crate) use replicates::SEQUENCES;
pub use stored::StoredFilmError;
pub(crate) use sums::store_finite;
pub use tile::Tile;

/// Edge of the square blocks that pixels of a tile are stored in. Sixteen pixels lie side by side in memory, so that
/// a packet of 4, 8 or 16 lanes is one stretch of a column.
pub(crate) const BLOCK: u32 = 4;

/// Pixels in a block.
pub(crate) const BLOCK_PIXELS: usize = (BLOCK * BLOCK) as usize;

/// Stands for "no surface".
pub(crate) const NOTHING: u32 = u32::MAX;

/// Bytes of a pixel: light, depth and surface. Standard errors, where a view asks for them, take 8 more, those of
/// channels another 24, and more samples than one 24.
const PIXEL_BYTES: u64 = 20;

/// Bytes that a pixel takes beside these where its error is judged: the sum of its samples, their deviations, its goal and
/// number, and the sums of its sequences.
const JUDGED_BYTES: u64 = 24 + 8 + 4 + 4 + 12 * SEQUENCES as u64;

/// There is no memory for a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a film of {}x{} pixels needs {bytes} bytes of memory, more than there is", size.width, size.height)]
pub struct NoRoom {
    size: Size,
    bytes: u64,
}

/// A picture in linear Rec. 709 light, with depth and surface of every pixel.
///
/// ```
/// use catoptra_tracer::{Display, Film, Size};
///
/// let film = Film::new(Size::new(4, 3));
/// assert_eq!((film.radiance(0, 0), film.surface(0, 0), film.samples(0, 0)), ([0.0; 3], None, 0));
/// // As bytes for a display, two stops brighter.
/// assert_eq!(Display::Srgb.exposed(2.0).rgb8(&film).len(), 3 * 4 * 3);
/// ```
#[derive(Debug, Clone)]
pub struct Film {
    region: Region,
    edge: u32,
    tiles: Vec<Tile>,
}

impl Film {
    /// Edge of a tile in pixels, unless said otherwise: 32 x 32 pixels are 20 KiB, which a first-level cache holds.
    pub const TILE: u32 = 32;

    /// A black film.
    ///
    /// # Panics
    /// Where there is no memory for it, as in all but [`try_of_region`](Self::try_of_region).
    #[must_use]
    pub fn new(size: Size) -> Self {
        Self::with_tiles(size, Self::TILE)
    }

    /// A black film with tiles of `edge` pixels, rounded up to a multiple of 4; what is traced does not depend on it.
    ///
    /// # Panics
    /// Where there is no memory for it.
    #[must_use]
    pub fn with_tiles(size: Size, edge: u32) -> Self {
        Self::of_region(size.into(), edge)
    }

    /// A black film of a part of a picture, such as [`View::region`](crate::View::region); pixels are counted from its
    /// upper left corner. Tiles are as in [`with_tiles`](Self::with_tiles).
    ///
    /// # Panics
    /// Where there is no memory for it.
    #[must_use]
    pub fn of_region(region: Region, edge: u32) -> Self {
        match Self::try_of_region(region, edge) {
            Ok(film) => film,
            Err(error) => panic!("{error}"),
        }
    }

    /// The same, for sizes that need not fit in memory.
    ///
    /// # Errors
    /// Where there is no memory for it.
    pub fn try_of_region(region: Region, edge: u32) -> Result<Self, NoRoom> {
        let Region { x: left, y: top, size } = region;
        let edge = edge.clamp(BLOCK, 1 << 16).next_multiple_of(BLOCK);
        let no_room = NoRoom { size, bytes: Self::bytes_of(size) };
        let starts = |length: u32| (0..length).step_by(edge as usize);
        let mut tiles = Vec::new();
        let count = starts(size.width).len() * starts(size.height).len();
        tiles.try_reserve_exact(count).map_err(|_| no_room)?;
        for (x, y) in starts(size.height).flat_map(|y| starts(size.width).map(move |x| (x, y))) {
            let tile = Tile::new(left + x, top + y, edge.min(size.width - x), edge.min(size.height - y));
            tiles.push(tile.ok_or(no_room)?);
        }
        Ok(Self { region, edge, tiles })
    }

    /// Bytes of memory that a film of so many pixels takes, without those for standard errors.
    #[must_use]
    pub fn bytes_of(size: Size) -> u64 {
        let side = |length: u32| u64::from(length.next_multiple_of(BLOCK));
        (side(size.width) * side(size.height)).saturating_mul(PIXEL_BYTES)
    }

    /// Bytes of memory that a film of so many pixels takes where [`render_until`](crate::render_until) judges their errors.
    #[must_use]
    pub fn judged_bytes_of(size: Size) -> u64 {
        (Self::bytes_of(size) / PIXEL_BYTES).saturating_mul(PIXEL_BYTES + JUDGED_BYTES)
    }

    /// Its size.
    #[must_use]
    pub fn size(&self) -> Size {
        self.region.size
    }

    /// The part of a picture that it holds.
    #[must_use]
    pub fn region(&self) -> Region {
        self.region
    }

    /// Linear red, green and blue of a pixel, the mean of its samples; never NaN or infinite.
    ///
    /// # Panics
    /// A pixel outside the picture.
    #[must_use]
    pub fn radiance(&self, x: u32, y: u32) -> [f32; 3] {
        let (tile, i) = self.place(x, y);
        tile.radiance(i)
    }

    /// Metres from the eye to what a pixel shows, along its ray; infinite where it shows nothing.
    ///
    /// # Panics
    /// A pixel outside the picture.
    #[must_use]
    pub fn depth(&self, x: u32, y: u32) -> f32 {
        let (tile, i) = self.place(x, y);
        tile.depth[i]
    }

    /// What a pixel shows.
    ///
    /// # Panics
    /// A pixel outside the picture.
    #[must_use]
    pub fn surface(&self, x: u32, y: u32) -> Option<EntityId> {
        let (tile, i) = self.place(x, y);
        tile.entity(i)
    }

    /// How many samples a pixel is the mean of; 0 before it is traced.
    ///
    /// # Panics
    /// A pixel outside the picture.
    #[must_use]
    pub fn samples(&self, x: u32, y: u32) -> u32 {
        let (tile, i) = self.place(x, y);
        tile.samples(i)
    }

    /// The standard error of a pixel's [luminance](catoptra_core::Rgb::luminance). Never NaN or infinite.
    ///
    /// By [`render_until`](crate::render_until) it is what sequences of samples that know nothing of each other tell: ±1.96 of it
    /// hold the errors of 95 of 100 pixels; 0 where all samples are alike.
    ///
    /// Else it is that of independent samples, the root of their variance over their number; `None` for fewer than two
    /// samples, and where the view did not ask for [moments](crate::View::moments). Samples that are spread evenly, as those of
    /// every pattern and sampler here, err by less; how much less they do not tell.
    ///
    /// # Panics
    /// A pixel outside the picture.
    #[must_use]
    pub fn standard_error(&self, x: u32, y: u32) -> Option<f32> {
        let (tile, i) = self.place(x, y);
        tile.standard_error(i)
    }

    /// The standard errors of a pixel's red, green and blue, linear as its [radiance](Self::radiance). Never NaN or
    /// infinite.
    ///
    /// They are told as [`standard_error`](Self::standard_error) tells that of the luminance; without
    /// [`render_until`](crate::render_until) the view is to ask for [`Moments::Channels`](crate::Moments::Channels).
    ///
    /// # Panics
    /// A pixel outside the picture.
    #[must_use]
    pub fn channel_errors(&self, x: u32, y: u32) -> Option<[f32; 3]> {
        let (tile, i) = self.place(x, y);
        Some(tile.channel_errors(i)?.map(|error| sums::finite(error as f32)))
    }

    /// Adds the samples of another film of the same picture, or of a part of it, to those of this one: with another seed,
    /// what both have found. Depths and surfaces stay. Standard errors go on where both films have them.
    ///
    /// # Panics
    /// A film that reaches beyond this one.
    pub fn merge(&mut self, part: &Self) {
        let Region { x: left, y: top, size } = part.region;
        for (x, y) in (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y))) {
            let (from, j) = part.place(x, y);
            let inside = |at: u32, start: u32| at.checked_sub(start).unwrap_or(u32::MAX);
            let (tile, i) = self.find(inside(left + x, self.region.x), inside(top + y, self.region.y));
            self.tiles[tile].add(i, from, j);
        }
    }

    /// Depths of all pixels, row by row; see [`depth`](Self::depth).
    #[must_use]
    pub fn depths(&self) -> Vec<f32> {
        self.rows(|tile, i| tile.depth[i])
    }

    /// Linear radiance of all pixels, row by row; see [`radiance`](Self::radiance).
    #[must_use]
    pub fn radiances(&self) -> Vec<[f32; 3]> {
        self.rows(Tile::radiance)
    }

    fn rows<T>(&self, read: impl Fn(&Tile, usize) -> T) -> Vec<T> {
        let Size { width, height } = self.size();
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        pixels
            .map(|(x, y)| {
                let (tile, i) = self.place(x, y);
                read(tile, i)
            })
            .collect()
    }

    fn place(&self, x: u32, y: u32) -> (&Tile, usize) {
        let (tile, i) = self.find(x, y);
        (&self.tiles[tile], i)
    }

    /// In which tile a pixel lies, and where in its columns.
    fn find(&self, x: u32, y: u32) -> (usize, usize) {
        let Size { width, height } = self.size();
        assert!(x < width && y < height, "pixel ({x}, {y}) lies outside the picture");
        let across = width.div_ceil(self.edge);
        let tile = ((y / self.edge) * across + x / self.edge) as usize;
        (tile, self.tiles[tile].index(x % self.edge, y % self.edge))
    }

    /// The tiles, to be written.
    pub(crate) fn tiles_mut(&mut self) -> &mut [Tile] {
        &mut self.tiles
    }

    /// The tiles of each row of tiles, top to bottom.
    pub(crate) fn tile_rows(&self) -> impl Iterator<Item = &[Tile]> {
        self.tiles.chunks(self.size().width.div_ceil(self.edge).max(1) as usize)
    }

    /// Edge of a tile in pixels.
    pub(crate) fn edge(&self) -> u32 {
        self.edge
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_has_a_place_of_its_own() {
        let size = Size::new(45, 38);
        for edge in [4, 16, 64] {
            let film = Film::with_tiles(size, edge);
            let mut seen = std::collections::HashSet::new();
            for (x, y) in (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y))) {
                let (tile, i) = film.place(x, y);
                assert!(i < tile.depth.len() && seen.insert((tile.x, tile.y, i)), "({x}, {y}) at {edge}");
            }
        }
    }

    #[test]
    fn a_film_that_fits_no_memory_is_an_error() {
        // Its list of tiles alone is larger than any address space.
        let error = Film::try_of_region(Size::new(1 << 29, 1 << 29).into(), BLOCK).err();
        assert!(error.is_some_and(|error| error.to_string().contains("bytes of memory")));
    }

    #[test]
    fn bytes_are_those_of_the_columns() {
        let size = Size::new(45, 38);
        let film = Film::with_tiles(size, 16);
        let columns = film
            .tiles
            .iter()
            .map(|tile| 4 * tile.depth.len() + 4 * tile.surface.len() + 12 * tile.sums[0].len());
        assert_eq!(columns.sum::<usize>() as u64, Film::bytes_of(size));
    }

    #[test]
    fn a_film_that_was_not_traced_is_black_and_holds_no_samples() {
        let film = Film::new(Size::new(5, 3));
        assert_eq!((film.samples(4, 2), film.radiance(4, 2), film.standard_error(4, 2)), (0, [0.0; 3], None));
    }

    #[test]
    fn an_empty_picture_has_no_tiles() {
        assert!(Film::new(Size::new(0, 100)).tiles.is_empty());
        assert!(Film::new(Size::new(0, 100)).radiances().is_empty());
    }
}
