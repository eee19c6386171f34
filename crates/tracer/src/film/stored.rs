//! How samples of a film are kept in a file, to be gone on with.
//!
//! A line that names the format; a label, which says what picture it is and is nobody's business here; the part of the picture
//! and the edge of its tiles; for each tile how many samples its pixels hold and, row by row, the sums of their light, depths
//! and surfaces; a checksum of all that. Numbers are little-endian.

use std::io::{self, Read, Write};

use crc32fast::Hasher;

use super::sums::Counts;
use super::{Film, NoRoom, Tile};
use crate::lanes::Column;
use crate::{Region, Size};

/// What a file of samples begins with.
const FORMAT: &[u8; 16] = b"catoptra film 1\n";

/// The longest label, in bytes.
const LONGEST_LABEL: u32 = 1 << 20;

/// Why no film could be read.
#[derive(Debug, thiserror::Error)]
pub enum StoredFilmError {
    /// Something else than a film, or one of a later format.
    #[error("it is no film of this program")]
    Format,
    /// Samples of another picture.
    #[error("it holds samples of another picture")]
    OtherPicture {
        /// What the film says of it.
        label: String,
        /// The part of that picture which it holds.
        region: Region,
    },
    /// A film that was changed after it was written.
    #[error("it is damaged: {0}")]
    Damaged(&'static str),
    /// No memory for it.
    #[error(transparent)]
    NoRoom(#[from] NoRoom),
    /// No more bytes, or none at all.
    #[error(transparent)]
    Io(#[from] io::Error),
}

impl Film {
    /// The least and the most samples that its pixels hold.
    #[must_use]
    pub fn fewest_and_most(&self) -> [u32; 2] {
        let of_pixels = || self.tiles.iter().flat_map(|tile| tile.places().map(|i| tile.samples(i)));
        [of_pixels().min().unwrap_or(0), of_pixels().max().unwrap_or(0)]
    }

    /// Writes the samples of all pixels, with a label that says what picture they are of. What they tell of errors is not kept.
    ///
    /// # Errors
    /// What `out` refuses, and a label of more than a mebibyte.
    ///
    /// # Panics
    /// A film whose pixels were given numbers of samples of their own, as [`render_until`](crate::render_until) does.
    pub fn write_samples(&self, label: &str, out: &mut impl Write) -> io::Result<()> {
        let out = &mut Summed { inner: out, sum: Hasher::new() };
        let length = u32::try_from(label.len()).ok().filter(|length| *length <= LONGEST_LABEL);
        let length = length.ok_or_else(|| io::Error::other("a label of more than a mebibyte"))?;
        out.write_all(FORMAT)?;
        write_numbers(out, &[length])?;
        out.write_all(label.as_bytes())?;
        let Region { x, y, size } = self.region;
        write_numbers(out, &[x, y, size.width, size.height, self.edge])?;
        for tile in &self.tiles {
            tile.write_samples(out)?;
        }
        let sum = out.sum.clone().finalize();
        write_numbers(out, &[sum])
    }

    /// Reads what [`write_samples`](Self::write_samples) wrote of that part of that picture, and nothing else. The film has the
    /// tiles of the one that was written; [`View::range`](crate::View::range) goes on with it.
    ///
    /// # Errors
    /// See [`StoredFilmError`].
    pub fn read_samples(label: &str, region: Region, input: &mut impl Read) -> Result<Self, StoredFilmError> {
        let input = &mut Summed { inner: input, sum: Hasher::new() };
        let mut format = [0; FORMAT.len()];
        input.read_exact(&mut format).map_err(|_| StoredFilmError::Format)?;
        if format != *FORMAT {
            return Err(StoredFilmError::Format);
        }
        let [length] = read_numbers(input)?;
        if length > LONGEST_LABEL {
            return Err(StoredFilmError::Damaged("its label is too long"));
        }
        let mut found = vec![0; length as usize];
        input.read_exact(&mut found)?;
        let found = String::from_utf8(found).map_err(|_| StoredFilmError::Damaged("its label is no text"))?;
        let [x, y, width, height, edge] = read_numbers(input)?;
        let of = Region::new(x, y, Size::new(width, height));
        if found != label || of != region {
            return Err(StoredFilmError::OtherPicture { label: found, region: of });
        }
        let mut film = Self::try_of_region(region, edge)?;
        if film.edge != edge {
            return Err(StoredFilmError::Damaged("its tiles have no such edge"));
        }
        for tile in &mut film.tiles {
            tile.read_samples(input)?;
        }
        let expected = input.sum.clone().finalize();
        let [sum] = read_numbers(input)?;
        if sum == expected { Ok(film) } else { Err(StoredFilmError::Damaged("its checksum is another")) }
    }
}

impl Tile {
    fn write_samples(&self, out: &mut impl Write) -> io::Result<()> {
        let Counts::Uniform(samples) = self.counts else {
            panic!("the pixels of a tile hold different numbers of samples");
        };
        write_numbers(out, &[samples])?;
        if samples == 0 {
            return Ok(());
        }
        for i in self.places() {
            for channel in self.sum(i).light {
                out.write_all(&channel.to_le_bytes())?;
            }
            out.write_all(&self.depth[i].to_le_bytes())?;
            out.write_all(&self.surface[i].to_le_bytes())?;
        }
        Ok(())
    }

    fn read_samples(&mut self, input: &mut impl Read) -> Result<(), StoredFilmError> {
        let [samples] = read_numbers(input)?;
        self.counts = Counts::Uniform(samples);
        if samples == 0 {
            return Ok(());
        }
        self.blank = None;
        let zeros = || Column::try_filled(self.depth.len(), 0.0);
        let no_room =
            NoRoom { size: Size::new(self.width, self.height), bytes: 24 * self.depth.len() as u64 };
        let room = || zeros().ok_or(no_room);
        let mut totals = [room()?, room()?, room()?];
        for i in self.places() {
            for total in &mut totals {
                let mut channel = [0; 8];
                input.read_exact(&mut channel)?;
                total[i] = f64::from_le_bytes(channel);
            }
            let [depth, surface] = read_numbers(input)?;
            (self.depth[i], self.surface[i]) = (f32::from_bits(depth), surface);
            if !totals.iter().all(|total| total[i].is_finite()) || self.depth[i].is_nan() {
                return Err(StoredFilmError::Damaged("it holds what is no light"));
            }
        }
        self.totals = Some(totals);
        Ok(())
    }

    /// Where its pixels lie in its columns, row by row.
    fn places(&self) -> impl Iterator<Item = usize> + use<> {
        let Self { width, height, .. } = *self;
        let across = self.blocks_across();
        (0..height).flat_map(move |y| (0..width).map(move |x| Self::index_in(across, x, y)))
    }
}

/// What passes through, and its checksum so far.
struct Summed<'a, T> {
    inner: &'a mut T,
    sum: Hasher,
}

impl<T: Write> Write for Summed<'_, T> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.inner.write(bytes)?;
        self.sum.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

impl<T: Read> Read for Summed<'_, T> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(bytes)?;
        self.sum.update(&bytes[..count]);
        Ok(count)
    }
}

fn write_numbers(out: &mut impl Write, numbers: &[u32]) -> io::Result<()> {
    numbers.iter().try_for_each(|number| out.write_all(&number.to_le_bytes()))
}

fn read_numbers<const N: usize>(input: &mut impl Read) -> io::Result<[u32; N]> {
    let mut numbers = [0; N];
    for number in &mut numbers {
        let mut bytes = [0; 4];
        input.read_exact(&mut bytes)?;
        *number = u32::from_le_bytes(bytes);
    }
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A film of which some tiles hold three samples and the others one.
    fn half_done() -> Film {
        let mut film = Film::of_region(Region::new(7, 3, Size::new(45, 38)), 16);
        for (at, tile) in film.tiles.iter_mut().enumerate() {
            tile.counts = Counts::Uniform(if at % 2 == 0 { 3 } else { 1 });
            let pixels = tile.depth.len();
            let light = |c: usize| {
                let mut column = Column::default();
                column.resize(pixels, 0.0);
                (0..pixels).for_each(|i| column[i] = (at * 1000 + i * 10 + c) as f64);
                column
            };
            tile.totals = Some([0, 1, 2].map(light));
            (0..pixels).for_each(|i| (tile.depth[i], tile.surface[i]) = (i as f32, i as u32));
        }
        film
    }

    fn bytes_of(film: &Film) -> Vec<u8> {
        let mut bytes = Vec::new();
        film.write_samples("a picture", &mut bytes).unwrap();
        bytes
    }

    fn read(bytes: &[u8]) -> Result<Film, StoredFilmError> {
        Film::read_samples("a picture", Region::new(7, 3, Size::new(45, 38)), &mut &bytes[..])
    }

    #[test]
    fn what_was_written_is_read() {
        let film = half_done();
        let again = read(&bytes_of(&film)).unwrap();
        assert_eq!(again.fewest_and_most(), [1, 3]);
        for (x, y) in (0..38).flat_map(|y| (0..45).map(move |x| (x, y))) {
            assert_eq!(again.radiance(x, y), film.radiance(x, y), "{x}, {y}");
            assert_eq!(again.depth(x, y), film.depth(x, y));
            assert_eq!(again.samples(x, y), film.samples(x, y));
        }
        assert_eq!(bytes_of(&again), bytes_of(&film));
    }

    #[test]
    fn a_film_that_was_not_traced_is_read_as_such() {
        let film = read(&bytes_of(&Film::of_region(Region::new(7, 3, Size::new(45, 38)), 16))).unwrap();
        assert_eq!(film.fewest_and_most(), [0, 0]);
    }

    #[test]
    fn other_pictures_are_told() {
        let bytes = bytes_of(&half_done());
        let region = Region::new(7, 3, Size::new(45, 38));
        let other = Film::read_samples("another", region, &mut &bytes[..]).unwrap_err();
        assert!(matches!(other, StoredFilmError::OtherPicture { label, .. } if label == "a picture"));
        let part = Region::new(7, 3, Size::new(45, 37));
        let other = Film::read_samples("a picture", part, &mut &bytes[..]).unwrap_err();
        assert!(matches!(other, StoredFilmError::OtherPicture { region: of, .. } if of == region));
    }

    #[test]
    fn damaged_films_are_refused_wherever_they_are_damaged() {
        let bytes = bytes_of(&half_done());
        for length in [0, 15, 16, 19, 30, 60, bytes.len() / 2, bytes.len() - 1] {
            assert!(read(&bytes[..length]).is_err(), "{length} bytes");
        }
        for at in (0..bytes.len()).step_by(97) {
            let mut changed = bytes.clone();
            changed[at] ^= 0x40;
            assert!(read(&changed).is_err(), "byte {at}");
        }
    }
}
