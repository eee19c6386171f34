//! A glTF file as the parts of reading see it: what its JSON says, the bytes behind it, and what may still be asked for.

use super::buffers::Buffers;
use super::json::Document;
use super::limits::Limits;
use crate::model::Folder;
use crate::model::warnings::Warnings;

/// An open file.
pub(super) struct Source<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: Buffers<'a>,
    pub(super) folder: &'a Folder,
    pub(super) warnings: Warnings,
    pub(super) limits: Limits,
}

impl<'a> Source<'a> {
    /// With its buffers read; `length` is that of the file in bytes.
    pub(super) fn new(
        document: &'a Document,
        binary: Option<&'a [u8]>,
        folder: &'a Folder,
        length: usize,
    ) -> Self {
        let buffers = Buffers::read(document, binary, folder);
        let limits = Limits::new(buffers.total().saturating_add(length as u64));
        Self { document, buffers, folder, warnings: Warnings::default(), limits }
    }
}
