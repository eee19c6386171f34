//! How do files of each format begin, so that they can be told from all others whatever they are called?

/// Bytes from the start that are looked through.
pub(super) const LOOKED_THROUGH: usize = 8192;

/// Words that lines of an OBJ file begin with, and no line of a scene.
const OBJ_WORDS: &[&str] = &["v", "vn", "vt", "mtllib", "o"];

pub(super) fn is_ply(bytes: &[u8]) -> bool {
    bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r")
}

pub(super) fn is_gltf(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(LOOKED_THROUGH)];
    let is_text = start.trim_ascii_start().starts_with(b"{");
    bytes.starts_with(b"glTF") || (is_text && start.windows(7).any(|word| word == b"\"asset\""))
}

pub(super) fn is_obj(bytes: &[u8]) -> bool {
    first_lines(bytes).is_some_and(|[first, _]| {
        first.split_ascii_whitespace().next().is_some_and(|word| OBJ_WORDS.contains(&word))
    })
}

/// Of binary ones the beginning says nothing.
pub(super) fn is_stl(bytes: &[u8]) -> bool {
    first_lines(bytes).is_some_and(|[first, second]| {
        first.split_ascii_whitespace().next() == Some("solid") && second.starts_with("facet")
    })
}

/// The first two lines that say something, if these are text.
fn first_lines(bytes: &[u8]) -> Option<[String; 2]> {
    let start = &bytes[..bytes.len().min(LOOKED_THROUGH)];
    if start.contains(&0) {
        return None;
    }
    let start = String::from_utf8_lossy(start);
    let mut lines = start.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let first = lines.next()?.to_owned();
    Some([first, lines.next().unwrap_or_default().to_owned()])
}

#[cfg(test)]
mod tests {
    use crate::model::of_content;

    #[test]
    fn files_are_told_by_how_they_begin() {
        for (bytes, name) in [
            (&b"ply\nformat ascii 1.0\n"[..], Some("PLY")),
            (b"glTF\x02\0\0\0", Some("glTF")),
            (b"\n { \"scenes\": [], \"asset\": {} }", Some("glTF")),
            (b"# by hand\n\nv 0 0 1\n", Some("OBJ")),
            (b"solid cube\n facet normal 0 0 1\n", Some("STL")),
            (b"solid cube\0\0\n facet normal 0 0 1\n", None),
            (b"o\0\0", None),
            (b"plywood", None),
            (b"{ \"a\": 1 }", None),
            (b"sphere \"a\" material=\"b\" { radius 1 }", None),
            (b"", None),
        ] {
            assert_eq!(
                of_content(bytes).map(|format| format.name),
                name,
                "{}",
                String::from_utf8_lossy(bytes)
            );
        }
    }
}
