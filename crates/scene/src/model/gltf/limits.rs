//! How much may a file ask for? Lists are bounded by the bytes that they lie in; what a file can name many times over is
//! bounded here.

use std::cell::Cell;

use catoptra_core::Image;

use super::refusal::Refusal;

/// So much memory meshes may take whatever the size of the file.
const LEAST_FOR_MESHES: u64 = 1 << 30;
/// So many bytes of meshes each byte of the file and its buffers may stand for.
const MESH_BYTES_OF_BYTE: u64 = 64;
/// So many bytes of an accessor without bytes, all zeros, may stand for each byte of the file and its buffers.
const ZEROS_OF_BYTE: u64 = 64;
/// So many bytes of zeros are let through whatever the size of the file.
const LEAST_ZEROS: u64 = 1 << 20;
/// All pictures within a file together have so many pixels at most.
const MOST_PIXELS: u64 = 1 << 31;
/// All buffers together hold so much at most.
pub(super) const MOST_BUFFER_BYTES: u64 = 1 << 32;
/// So many shapes, lights, cameras and groups come of a file at most.
pub(super) const MOST_NODES: usize = 1 << 20;
/// So deep nodes may lie inside each other.
pub(super) const MOST_DEPTH: usize = 128;
/// So deep they become groups inside each other; what lies deeper stands in the last one. Half of what a scene takes, so
/// that a model can be put into groups.
pub(super) const MOST_GROUPS: usize = catoptra_core::Scene::MAX_DEPTH / 2;
/// Names are cut after so many characters.
pub(super) const LONGEST_NAME: usize = 120;

/// What is left of the memory that a file may ask for.
#[derive(Debug)]
pub(super) struct Limits {
    meshes: Cell<u64>,
    pixels: Cell<u64>,
    zeros: u64,
}

impl Limits {
    /// For a file that is so long with its buffers.
    pub(super) fn new(bytes: u64) -> Self {
        let meshes = LEAST_FOR_MESHES.saturating_add(bytes.saturating_mul(MESH_BYTES_OF_BYTE));
        let zeros = LEAST_ZEROS.saturating_add(bytes.saturating_mul(ZEROS_OF_BYTE));
        Self { meshes: Cell::new(meshes), pixels: Cell::new(MOST_PIXELS), zeros }
    }

    /// Takes so much for meshes, before it is reserved: `count` rows of so many bytes.
    pub(super) fn take(&self, count: usize, bytes_of_row: usize) -> Result<(), Refusal> {
        let wanted = (count as u64).saturating_mul(bytes_of_row as u64);
        let Some(left) = self.meshes.get().checked_sub(wanted) else {
            return Err(Refusal::new(
                "the meshes of the file take more memory than a file of its size may ask for",
            ));
        };
        self.meshes.set(left);
        Ok(())
    }

    /// Takes the pixels of a picture.
    pub(super) fn take_pixels(&self, image: &Image) -> Result<(), Refusal> {
        let pixels = u64::from(image.width()) * u64::from(image.height());
        let Some(left) = self.pixels.get().checked_sub(pixels) else {
            return Err(Refusal::new("the pictures of the file together have more than 2^31 pixels"));
        };
        self.pixels.set(left);
        Ok(())
    }

    /// Whether so many zeros may be made of nothing.
    pub(super) fn allow_zeros(&self, count: u64, bytes_of_row: u64) -> Result<(), Refusal> {
        if count.saturating_mul(bytes_of_row) <= self.zeros {
            return Ok(());
        }
        Err(Refusal::new(format!(
            "a count of {count} without a bufferView is more than a file of this size may ask for"
        )))
    }
}
