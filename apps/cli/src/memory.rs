//! Is there memory for a picture?

use catoptra_scene::memory::free_bytes;
use catoptra_tracer::{Film, Region, Size};
use miette::{Report, Result, miette};

use crate::words::bytes;

/// What tracing needs beside the film, and writing the picture.
const BESIDE: u64 = 16 << 20;

/// Refuses a picture that memory cannot hold, with bytes that are needed beside its film: by what the system says is free, and by
/// asking for as much at once.
pub(crate) fn check_room(size: Size, beside: u64) -> Result<()> {
    check_bytes(size, Film::bytes_of(size).saturating_add(beside))
}

/// Refuses a picture whose film takes more bytes than there are.
fn check_bytes(size: Size, film: u64) -> Result<()> {
    let needed = film + BESIDE;
    if let Some(free) = free_bytes().filter(|free| *free < needed) {
        return Err(too_large(size, needed, &format!("only {} is free", bytes(free))));
    }
    let mut whole: Vec<u8> = Vec::new();
    let reserved = usize::try_from(needed).is_ok_and(|needed| whole.try_reserve_exact(needed).is_ok());
    if reserved { Ok(()) } else { Err(too_large(size, needed, "the system does not give as much")) }
}

/// A film of a part of a picture, which has errors to judge or not.
pub(crate) fn film(region: Region, tile: u32, judged: bool) -> Result<Film> {
    if judged {
        check_bytes(region.size, Film::judged_bytes_of(region.size))?;
    }
    Film::try_of_region(region, tile)
        .map_err(|_| too_large(region.size, Film::bytes_of(region.size), "less is left"))
}

fn too_large(size: Size, needed: u64, why: &str) -> Report {
    miette!(
        help = "ask for fewer pixels with --size, or for a part of the picture with --crop",
        "a picture of {}x{} pixels needs {} of memory, and {why}",
        size.width,
        size.height,
        bytes(needed)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_there_is_is_told_with_what_it_needs() {
        let error = check_room(Size::new(1 << 29, 1 << 29), 0).unwrap_err().to_string();
        assert!(error.contains("needs 5368709120.0 GiB of memory"), "{error}");
        assert!(check_room(Size::new(64, 64), 0).is_ok());
    }
}
