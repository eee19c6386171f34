//! The list of layers: what an EXR can hold of a picture, each as one or more channels.
//!
//! A new layer is one new file here and one line in [`LAYERS`].

mod albedo;
mod color;
mod depth;
mod error;
mod even_light;
mod id;
mod normal;
mod samples;
mod seen;
mod uv;

use catoptra_scene::image::Channel;
use miette::Result;

use crate::suggest::unknown;
pub(crate) use seen::{Seen, bytes_of};

/// One layer.
#[derive(Debug)]
pub(crate) struct Layer {
    /// Its name on the command line.
    pub(crate) name: &'static str,
    /// What must be known for it beside the light.
    pub(crate) needs: &'static [Need],
    /// Its channels, for pixels counted from the corner of the film.
    pub(crate) channels: for<'a> fn(&'a Seen<'_>) -> Vec<Channel<'a>>,
}

/// What a layer shows beside light.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Need {
    /// What the ray through the middle of each pixel meets.
    Surfaces,
    /// How it all looks in a light that is the same everywhere.
    EvenLight,
    /// How sure each pixel is.
    Errors,
}

/// All layers; the first is what a file without a word about layers holds.
pub(crate) const LAYERS: &[Layer] = &[
    color::LAYER,
    depth::LAYER,
    normal::LAYER,
    albedo::LAYER,
    uv::LAYER,
    id::LAYER,
    samples::LAYER,
    error::LAYER,
];

/// The layers of these names, each once and in the order of the list; the first, where none is named.
pub(crate) fn find_layers(names: &[String]) -> Result<Vec<&'static Layer>> {
    let known: Vec<&str> = LAYERS.iter().map(|layer| layer.name).collect();
    if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(unknown("layer", name, &known));
    }
    let wanted = |layer: &&Layer| names.iter().any(|name| name == layer.name);
    Ok(if names.is_empty() { LAYERS[..1].iter().collect() } else { LAYERS.iter().filter(wanted).collect() })
}

/// Whether one of the layers needs something.
pub(crate) fn need(layers: &[&Layer], need: Need) -> bool {
    layers.iter().any(|layer| layer.needs.contains(&need))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_found_by_name_in_the_order_of_the_list() {
        let names = |wanted: &[&str]| {
            let wanted: Vec<String> = wanted.iter().map(|name| (*name).to_owned()).collect();
            find_layers(&wanted).map(|found| found.iter().map(|layer| layer.name).collect::<Vec<_>>())
        };
        assert_eq!(names(&[]).unwrap(), ["color"]);
        assert_eq!(names(&["id", "color", "id"]).unwrap(), ["color", "id"]);
        assert!(names(&["colour"]).unwrap_err().help().unwrap().to_string().contains("color"));
    }

    #[test]
    fn names_of_layers_differ() {
        let names: std::collections::HashSet<&str> = LAYERS.iter().map(|layer| layer.name).collect();
        assert_eq!(names.len(), LAYERS.len());
    }
}
