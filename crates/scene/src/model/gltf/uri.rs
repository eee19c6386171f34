//! What does a URI of a glTF file stand for? A file beside it, or bytes in base64 (RFC 2397, 3986 and 4648).

use std::borrow::Cow;

/// What a URI names.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Named<'a> {
    /// A file, relative to the folder of the one that names it.
    File(Cow<'a, str>),
    /// The bytes themselves.
    Bytes(Vec<u8>),
}

/// Understands a URI.
///
/// # Errors
/// Data that are no base64, a file elsewhere on the network, or a name that is no UTF-8.
pub(super) fn named(uri: &str) -> Result<Named<'_>, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        let Some((head, text)) = data.split_once(',') else {
            return Err("the data URI has no comma before its data".to_owned());
        };
        if !head.ends_with(";base64") {
            return Err("the data of the URI must be in base64".to_owned());
        }
        let bytes = base64(text.as_bytes()).ok_or("the data of the URI are no base64")?;
        return Ok(Named::Bytes(bytes));
    }
    let uri = uri.strip_prefix("file://").unwrap_or(uri);
    if let Some((scheme, _)) = uri.split_once("://") {
        return Err(format!("{uri} is not read from the network ({scheme}): save it beside the file"));
    }
    // Many programs write names as they are: a sign that stands for no byte stands for itself.
    let Cow::Owned(bytes) = percent_decoded(uri) else { return Ok(Named::File(uri.into())) };
    String::from_utf8(bytes)
        .map(|name| Named::File(name.into()))
        .map_err(|_| format!("{uri} is no name of a file in UTF-8"))
}

/// The bytes that base64 stands for, with or without signs at its end that fill it up; `None` for anything else.
fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let text = text.strip_suffix(b"==").or(text.strip_suffix(b"=")).unwrap_or(text);
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for group in text.chunks(4) {
        let mut bits = 0;
        for &sign in group {
            bits = bits << 6 | u32::from(sextet(sign)?);
        }
        match group.len() {
            4 => bytes.extend_from_slice(&bits.to_be_bytes()[1..]),
            3 => bytes.extend_from_slice(&(bits >> 2).to_be_bytes()[2..]),
            2 => bytes.push((bits >> 4) as u8),
            _ => return None,
        }
    }
    Some(bytes)
}

/// Six bits; both alphabets of RFC 4648 are understood.
fn sextet(sign: u8) -> Option<u8> {
    match sign {
        b'A'..=b'Z' => Some(sign - b'A'),
        b'a'..=b'z' => Some(sign - b'a' + 26),
        b'0'..=b'9' => Some(sign - b'0' + 52),
        b'+' | b'-' => Some(62),
        b'/' | b'_' => Some(63),
        _ => None,
    }
}

/// With `%20` and the like as the bytes that they stand for.
fn percent_decoded(text: &str) -> Cow<'_, [u8]> {
    let bytes = text.as_bytes();
    if !bytes.contains(&b'%') {
        return Cow::Borrowed(bytes);
    }
    let mut out = Vec::with_capacity(bytes.len());
    let mut rest = bytes;
    while let [first, after @ ..] = rest {
        rest = after;
        let digit = |sign: u8| char::from(sign).to_digit(16);
        match after {
            [high, low, after @ ..] if *first == b'%' => {
                if let (Some(high), Some(low)) = (digit(*high), digit(*low)) {
                    out.push((high * 16 + low) as u8);
                    rest = after;
                } else {
                    out.push(*first);
                }
            }
            _ => out.push(*first),
        }
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_any_length_is_read() {
        // The test vectors of RFC 4648, section 10.
        for (text, bytes) in [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9v", "foo"),
            ("Zm9vYg==", "foob"),
            ("Zm9vYmE=", "fooba"),
            ("Zm9vYmFy", "foobar"),
            ("Zm9vYg", "foob"),
        ] {
            assert_eq!(base64(text.as_bytes()).as_deref(), Some(bytes.as_bytes()), "{text}");
        }
        assert_eq!(base64(b"+/-_"), Some(vec![0xfb, 0xff, 0xbf]));
        for text in ["Z", "Zm9vY", "Zm9 vYg", "Z===", "Zm9v!A==", "Zg==Zg=="] {
            assert_eq!(base64(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn names_of_files_are_decoded() {
        let file = |uri: &str| match named(uri) {
            Ok(Named::File(name)) => name.into_owned(),
            other => format!("{other:?}"),
        };
        assert_eq!(file("my%20buffer.bin"), "my buffer.bin");
        assert_eq!(file("textures/%C3%BCber.png"), "textures/über.png");
        assert_eq!(file("100%.png"), "100%.png");
        assert_eq!(file("a%zz%2"), "a%zz%2");
        assert_eq!(file("plain.bin"), "plain.bin");
    }

    #[test]
    fn what_is_no_file_is_told() {
        for (uri, told) in [
            ("https://example.com/a.bin", "network"),
            ("data:text/plain,hello", "base64"),
            ("data:;base64", "comma"),
            ("data:;base64,????", "no base64"),
            ("%FF.bin", "UTF-8"),
        ] {
            let message = named(uri).unwrap_err();
            assert!(message.contains(told), "{uri}: {message}");
        }
    }
}
