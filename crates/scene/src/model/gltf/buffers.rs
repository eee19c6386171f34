//! Where are the bytes that accessors and pictures lie in?

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::rc::Rc;

use super::json::{Buffer, BufferView, Document, Whole, entry};
use super::limits::MOST_BUFFER_BYTES;
use super::refusal::{Refusal, Within};
use super::uri::{Named, named};
use crate::model::Folder;

/// The bytes of a buffer, or why there are none: not all buffers are in use.
type Found<'a> = Result<Bytes<'a>, String>;

/// Bytes of the file itself, or of another.
#[derive(Debug, Clone)]
enum Bytes<'a> {
    Own(&'a [u8]),
    Read(Rc<Vec<u8>>),
}

/// All buffers of a file.
#[derive(Debug)]
pub(super) struct Buffers<'a> {
    found: Vec<Found<'a>>,
    views: &'a [BufferView],
    total: u64,
}

/// Some bytes of a buffer.
#[derive(Debug, Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) bytes: &'a [u8],
    /// From one row to the next, where the file says.
    pub(super) stride: Option<usize>,
}

impl<'a> Buffers<'a> {
    /// Reads all of them. `binary` are the bytes of the first one, in a binary file.
    pub(super) fn read(document: &'a Document, binary: Option<&'a [u8]>, folder: &Folder) -> Self {
        let mut reader = Reader { folder, files: HashMap::new(), left: MOST_BUFFER_BYTES };
        let found = document.buffers.iter().enumerate().map(|(i, buffer)| {
            let own = binary.filter(|_| i == 0);
            reader.read(buffer, own)
        });
        let found = found.collect();
        Self { found, views: &document.buffer_views, total: MOST_BUFFER_BYTES - reader.left }
    }

    /// How many bytes there are in all, beside those of the file itself.
    pub(super) fn total(&self) -> u64 {
        self.total
    }

    /// The bytes of a view.
    pub(super) fn view(&self, index: Whole) -> Result<View<'_>, Refusal> {
        let view = entry(self.views, index, "bufferViews")?;
        self.bytes_of(view).within(|| format!("bufferViews[{index}]")).referred()
    }

    fn bytes_of(&self, view: &BufferView) -> Result<View<'_>, Refusal> {
        let found = entry(&self.found, view.buffer, "buffers")?;
        let bytes = match found {
            Ok(Bytes::Own(bytes)) => bytes,
            Ok(Bytes::Read(bytes)) => &bytes[..],
            Err(message) => return Err(Refusal::new(format!("buffers[{}]: {message}", view.buffer))),
        };
        let (start, length) = (view.byte_offset.index(), view.byte_length.index());
        let end = start.checked_add(length).filter(|&end| end <= bytes.len());
        let Some(end) = end else {
            return Err(Refusal::new(format!(
                "{length} bytes from {start} on are named, of the {} of buffers[{}]",
                bytes.len(),
                view.buffer
            )));
        };
        let stride = view.byte_stride.map(Whole::index).filter(|&stride| stride > 0);
        Ok(View { bytes: &bytes[start..end], stride })
    }
}

struct Reader<'f> {
    folder: &'f Folder,
    /// What has been read already, by name.
    files: HashMap<String, Rc<Vec<u8>>>,
    /// How many bytes may be read yet.
    left: u64,
}

impl Reader<'_> {
    fn read<'a>(&mut self, buffer: &Buffer, own: Option<&'a [u8]>) -> Found<'a> {
        let wanted = buffer.byte_length.0;
        let bytes = match (&buffer.uri, own) {
            (Some(uri), _) => match named(uri)? {
                Named::Bytes(bytes) => Bytes::Read(Rc::new(bytes)),
                Named::File(name) => Bytes::Read(self.file(&name, wanted)?),
            },
            (None, Some(own)) => Bytes::Own(own),
            (None, None) => return Err("has no bytes: neither a uri nor a binary chunk".to_owned()),
        };
        let held = match &bytes {
            Bytes::Own(bytes) => bytes.len(),
            Bytes::Read(bytes) => bytes.len(),
        };
        if (held as u64) < wanted {
            return Err(format!("is cut short: {wanted} bytes are announced, {held} are there"));
        }
        Ok(bytes)
    }

    /// As much of a file as is announced.
    fn file(&mut self, name: &str, wanted: u64) -> Result<Rc<Vec<u8>>, String> {
        if let Some(known) = self.files.get(name)
            && known.len() as u64 >= wanted
        {
            return Ok(Rc::clone(known));
        }
        if wanted > self.left {
            return Err(format!(
                "is longer than can be read: all buffers together may hold {MOST_BUFFER_BYTES} bytes"
            ));
        }
        let place = self.folder.place(name)?;
        let fail = |cause: std::io::Error| format!("{name} cannot be read: {cause}");
        let file = File::open(place).map_err(fail)?;
        if !file.metadata().map_err(fail)?.is_file() {
            return Err(format!("{name} cannot be read: it is no file"));
        }
        let mut bytes = Vec::new();
        file.take(wanted).read_to_end(&mut bytes).map_err(fail)?;
        self.left -= bytes.len() as u64;
        let bytes = Rc::new(bytes);
        self.files.insert(name.to_owned(), Rc::clone(&bytes));
        Ok(bytes)
    }
}
