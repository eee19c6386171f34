//! How intensity profiles come in from IES files: LM-63 of 1986, 1991, 1995, 2002 and 2019.
//!
//! A file is read whole and checked while it is read: counts against the bytes that are there before anything is
//! reserved, angles for their order and range, every number for being one. A refusal says the line and the column.
//!
//! Candela are multiplied by the candela multiplier, by the ballast factor and, in files up to 1995, by the
//! ballast-lamp photometric factor; in the place of that one, 2002 has a number without a meaning and 2019 a code for
//! how the file was made. The luminaire counts as a point, so its size is passed over, and so are the lumens of its
//! lamps, to which the candela refer already, and the factors of `TILT=INCLUDE`, which say how much less a lamp gives
//! when its luminaire is tilted.

mod angles;
mod error;
mod photometry;
mod text;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use catoptra_core::IntensityProfile;

use error::Fault;
pub use error::{Place, ProfileError};

/// Longer files are refused, in bytes: a file by the degree all round has under half of this.
const LONGEST: usize = 4 << 20;

/// Reads an intensity profile.
///
/// # Errors
/// A file that cannot be read, is longer than 4 MiB, or is no valid IES file.
pub fn read(path: &Path) -> Result<IntensityProfile, ProfileError> {
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(LONGEST as u64 + 1).read_to_end(&mut bytes))
        .map_err(|e| ProfileError::new(path, Fault::file(format!("cannot be read: {e}"))))?;
    read_bytes(&bytes, path)
}

/// Reads an intensity profile from the bytes of a file.
///
/// # Errors
/// As for [`read`]; `name` stands for the file in messages.
pub fn read_bytes(bytes: &[u8], name: &Path) -> Result<IntensityProfile, ProfileError> {
    parse(bytes).map_err(|fault| ProfileError::new(name, fault))
}

fn parse(bytes: &[u8]) -> Result<IntensityProfile, Fault> {
    if bytes.len() > LONGEST {
        return Err(Fault::file(format!("is longer than {} MiB, too long for an IES file", LONGEST >> 20)));
    }
    angles::profile(photometry::read(bytes)?)
}

#[cfg(test)]
mod tests;
