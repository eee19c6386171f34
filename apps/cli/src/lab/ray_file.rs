//! How are rays kept in a file? A `u32` count and 32 bytes a ray: origin, tmin, direction, tmax, all little-endian `f32`.

use std::path::Path;

use catoptra_core::Ray;
use catoptra_core::glam::{DVec3, Vec3};
use catoptra_tracer::query::RayList;
use miette::{Report, Result, miette};

use crate::output::write_file;

/// Bytes of a ray.
const BYTES: usize = 32;

/// Reads a ray file.
pub(super) fn read(path: &Path) -> Result<RayList> {
    let bytes = std::fs::read(path).map_err(|error| miette!("{} cannot be read: {error}", path.display()))?;
    let (count, body) = bytes.split_first_chunk().ok_or_else(|| too_short(path, 4, bytes.len()))?;
    let wanted = u32::from_le_bytes(*count) as usize * BYTES;
    if body.len() != wanted {
        return Err(too_short(path, wanted + 4, bytes.len()));
    }
    let mut rays = RayList::new();
    for record in body.chunks_exact(BYTES) {
        let mut numbers = [0.0; BYTES / 4];
        for (number, bytes) in numbers.iter_mut().zip(record.chunks_exact(4)) {
            *number = f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
        }
        let [ox, oy, oz, min, dx, dy, dz, max] = numbers;
        rays.push(&Ray::new(DVec3::new(ox, oy, oz), DVec3::new(dx, dy, dz)), [min, max], None);
    }
    Ok(rays)
}

fn too_short(path: &Path, wanted: usize, there: usize) -> Report {
    miette!(
        help =
            "a ray file is a u32 count and 32 bytes a ray: origin, tmin, direction, tmax, little-endian f32",
        "{} is no ray file: it should be {wanted} bytes long and is {there}",
        path.display()
    )
}

/// A ray as files hold it.
pub(super) struct Record {
    pub(super) origin: Vec3,
    pub(super) direction: Vec3,
    pub(super) span: [f32; 2],
}

/// Writes a ray file, whole or not at all.
pub(super) fn write(path: &Path, rays: &[Record]) -> Result<()> {
    let count = u32::try_from(rays.len()).map_err(|_| {
        miette!("{} would hold {} rays, more than can be counted", path.display(), rays.len())
    })?;
    let mut bytes = Vec::with_capacity(4 + rays.len() * BYTES);
    bytes.extend(count.to_le_bytes());
    for Record { origin, direction, span: [min, max] } in rays {
        let numbers = [origin.x, origin.y, origin.z, *min, direction.x, direction.y, direction.z, *max];
        bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    }
    write_file(path, &bytes)
}
