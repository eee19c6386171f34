//! How do the paths in a text lead to the same files when the text goes into another folder?

use std::path::{Component, MAIN_SEPARATOR_STR, Path, PathBuf};

use catoptra_core::Value;

use crate::outline::{Item, Outline, Span};
use crate::write::{self, Splice, quoted};

/// The text with relative paths that started at the folder `from`, so that they start at the folder `to`.
pub(super) fn text(text: &str, outline: &Outline, from: &Path, to: &Path) -> String {
    let (Some(from), Some(to)) = (real(from), real(to)) else { return text.to_owned() };
    if from == to {
        return text.to_owned();
    }
    let named = outline.items.iter().flat_map(paths);
    let moved = named.filter_map(|(path, span)| Some(Splice::new(span, quoted(&moved(path, &from, &to)?))));
    write::apply(text, moved.collect(), &[]).0
}

/// The paths that a node names, and where.
fn paths(item: &Item) -> impl Iterator<Item = (&str, Span)> {
    let model = item.model.as_ref().zip(item.model_path.clone());
    let model = model.map(|(model, span)| (model.path.as_str(), span));
    let fields = item.fields.iter().filter_map(|written| {
        let path = match item.given.get(written.field.name)? {
            Value::Mesh(source) => source.path.as_str(),
            Value::Profile(source) => source.path.as_str(),
            Value::Image(source) => source.path.as_str(),
            _ => return None,
        };
        Some((path, written.values.first()?.clone()))
    });
    model.into_iter().chain(fields)
}

/// A folder by the path that has no links in it, or at least a whole one.
fn real(folder: &Path) -> Option<PathBuf> {
    let whole = std::path::absolute(Path::new(".").join(folder)).ok()?;
    Some(whole.canonicalize().unwrap_or(whole))
}

/// A path from one folder as it is from another: up and down again where both have an outer folder in common, else whole;
/// `None` where it can stay, or cannot be spelled.
fn moved(path: &str, from: &Path, to: &Path) -> Option<String> {
    if Path::new(path).is_absolute() {
        return None;
    }
    let whole = without_detours(&from.join(path));
    let common = whole.components().zip(to.components()).take_while(|(a, b)| a == b);
    let common: PathBuf = common.map(|(part, _)| part).collect();
    let is_root = common.parent().is_none();
    let (down, up) = (whole.strip_prefix(&common).ok()?, to.strip_prefix(&common).ok()?);
    let spelled = if is_root {
        whole
    } else {
        up.components().map(|_| Component::ParentDir).chain(down.components()).collect()
    };
    Some(spelled.to_str()?.replace(MAIN_SEPARATOR_STR, "/"))
}

/// A whole path without `.` and `..`.
fn without_detours(path: &Path) -> PathBuf {
    let mut straight = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                straight.pop();
            }
            part => straight.push(part),
        }
    }
    straight
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn paths_lead_from_the_new_folder() {
        let at = |path, from, to| moved(path, Path::new(from), Path::new(to));
        let leads = |to: &str| Some(to.to_owned());
        assert_eq!(at("maps/a.png", "/home/me/rooms", "/home/me"), leads("rooms/maps/a.png"));
        assert_eq!(at("maps/a.png", "/home/me/rooms", "/home/me/other"), leads("../rooms/maps/a.png"));
        assert_eq!(at("../a.png", "/home/me/rooms", "/home/me/other/in"), leads("../../a.png"));
        assert_eq!(at("./m.glb#head", "/home/me", "/home/me/in"), leads("../m.glb#head"));
        assert_eq!(at("a.ply", "/home/me", "/media/stick"), leads("/home/me/a.ply"), "nothing in common");
        assert_eq!(at("/a.ply", "/home/me", "/home"), None);
    }
}
