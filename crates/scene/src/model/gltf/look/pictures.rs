//! Which pictures does a file have, each decoded once?

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::{Image, ImageSource};

use crate::image::{load, load_bytes};
use crate::model::gltf::json::{self, Whole, entry};
use crate::model::gltf::source::Source;
use crate::model::gltf::uri::{Named, named};

/// The pictures that have been asked for; `None` for what cannot be shown.
pub(super) struct Pictures<'a, 's> {
    source: &'s Source<'a>,
    known: HashMap<Whole, Option<ImageSource>>,
}

impl<'a, 's> Pictures<'a, 's> {
    pub(super) fn new(source: &'s Source<'a>) -> Self {
        Self { source, known: HashMap::new() }
    }

    /// The picture of that number. What cannot be shown is warned of once; nothing is shown to who wants shapes alone.
    pub(super) fn get(&mut self, index: Whole) -> Option<ImageSource> {
        if !self.source.folder.wants_materials() {
            return None;
        }
        if let Some(known) = self.known.get(&index) {
            return known.clone();
        }
        let read = self.read(index);
        if let Err(message) = &read {
            self.source.warnings.add_of_file(format!("images[{index}] is left out: {message}"));
        }
        let read = read.ok();
        self.known.insert(index, read.clone());
        read
    }

    fn read(&self, index: Whole) -> Result<ImageSource, String> {
        let source = self.source;
        let given: &json::Image = entry(&source.document.images, index, "images").map_err(|e| e.text())?;
        let embedded = |bytes: &[u8]| {
            let image = load_bytes(bytes, Path::new("it")).map_err(|e| e.to_string())?;
            source.limits.take_pixels(&image).map_err(|e| e.text())?;
            Ok(ImageSource { path: String::new(), image: Arc::new(image) })
        };
        match (&given.uri, given.buffer_view) {
            (Some(uri), _) => match named(uri)? {
                Named::Bytes(bytes) => embedded(&bytes),
                Named::File(name) => {
                    let image = load(&source.folder.place(&name)?).map_err(|e| e.to_string())?;
                    Ok(ImageSource { path: name.into_owned(), image })
                }
            },
            (None, Some(view)) => embedded(source.buffers.view(view).map_err(|e| e.text())?.bytes),
            (None, None) => Err("it has neither a uri nor a bufferView".to_owned()),
        }
    }
}

/// What a picture is called: by its own name, or by that of its file.
pub(super) fn name_of(image: &json::Image) -> Option<String> {
    let own = image.name.clone().filter(|name| !name.trim().is_empty());
    own.or_else(|| match image.uri.as_deref().map(named)? {
        Ok(Named::File(name)) => {
            PathBuf::from(name.into_owned()).file_stem().map(|stem| stem.to_string_lossy().into_owned())
        }
        _ => None,
    })
}

/// A picture that was made here.
pub(super) fn made(image: Image) -> ImageSource {
    ImageSource { path: String::new(), image: Arc::new(image) }
}
