//! Text, binary files, buffers beside them and within.

use std::path::Path;

use catoptra_scene::model::{Folder, Place, read, read_bytes, read_mesh};
use serde_json::json;

use crate::builder::{Builder, CORNERS, base64, glb, only, warnings};

#[test]
fn text_and_binary_files_hold_the_same() {
    let file = Builder::with_node();
    let binary = file.read();
    assert_eq!(only(&binary).positions(), CORNERS);
    let uri = format!("data:application/octet-stream;base64,{}", base64(&file.bytes));
    let text = file.text(&uri);
    let read_text = |bytes: &[u8]| read_bytes(bytes, Path::new("a.gltf"), &Folder::none()).unwrap();
    assert_eq!(read_text(&text).nodes, binary.nodes);
    // Some editors begin a file with a mark of its byte order.
    assert_eq!(read_text(&[b"\xef\xbb\xbf", &text[..]].concat()).nodes, binary.nodes);
}

#[test]
fn buffers_lie_beside_the_file_under_names_with_spaces() {
    let folder = tempfile::tempdir().unwrap();
    let file = Builder::with_node();
    std::fs::create_dir(folder.path().join("der Würfel")).unwrap();
    std::fs::write(folder.path().join("der Würfel/a b.bin"), &file.bytes).unwrap();
    let path = folder.path().join("a.gltf");
    for uri in ["der%20W%C3%BCrfel/a%20b.bin", "der Würfel/a b.bin", "der%20W%C3%BCrfel\\a b.bin"] {
        std::fs::write(&path, file.text(uri)).unwrap();
        assert_eq!(read(&path).unwrap().nodes, file.read().nodes, "{uri}");
    }
    assert_eq!(read_mesh(&path).unwrap().positions(), CORNERS);
    std::fs::write(&path, file.text("missing.bin")).unwrap();
    let refused = read(&path).unwrap_err();
    assert!(refused.message().contains("buffers[0]: missing.bin cannot be read"), "{refused}");
    std::fs::write(&path, file.text("der Würfel")).unwrap();
    assert!(read(&path).unwrap_err().message().contains("it is no file"));
    std::fs::write(folder.path().join("short.bin"), &file.bytes[1..]).unwrap();
    std::fs::write(&path, file.text("short.bin")).unwrap();
    let refused = read(&path).unwrap_err();
    assert!(refused.message().contains("is cut short: 36 bytes are announced, 35 are there"), "{refused}");
}

#[test]
fn buffers_that_nothing_needs_may_be_missing() {
    let mut file = Builder::with_node();
    file.json["buffers"] =
        json!([{ "byteLength": 36 }, { "byteLength": 9, "uri": "https://example.com/a.bin" }]);
    let text = file.json.to_string().into_bytes();
    let bytes = glb(&[(b"JSON", text), (b"BIN\0", file.bytes.clone())]);
    let model = read_bytes(&bytes, Path::new("a.glb"), &Folder::none()).unwrap();
    assert!(warnings(&model).is_empty());
}

#[test]
fn chunks_of_other_kinds_are_passed_over() {
    let mut file = Builder::with_node();
    file.json["buffers"] = json!([{ "byteLength": 36 }]);
    let text = file.json.to_string().into_bytes();
    let chunks = [(b"JSON", text), (b"XYZ0", vec![1; 9]), (b"BIN\0", file.bytes.clone())];
    let mut bytes = glb(&chunks);
    bytes.extend(b"more than is announced");
    let model = read_bytes(&bytes, Path::new("a.glb"), &Folder::none()).unwrap();
    assert_eq!(only(&model).positions(), CORNERS);
}

#[test]
fn broken_containers_are_refused_with_their_byte() {
    let whole = Builder::with_node().glb();
    let with = |at: usize, byte: u8| {
        let mut bytes = whole.clone();
        bytes[at] = byte;
        bytes
    };
    for (bytes, place, said) in [
        (Vec::new(), Place::File, "is empty"),
        (whole[..9].to_vec(), Place::Byte(9), "cut short"),
        (whole[..whole.len() - 1].to_vec(), Place::Byte(8), "cut short"),
        (with(4, 1), Place::Byte(4), "version 1"),
        (with(16, b'X'), Place::Byte(12), "must be the JSON"),
        (with(14, 9), Place::Byte(12), "a chunk of"),
    ] {
        let refused = read_bytes(&bytes, Path::new("a.glb"), &Folder::none()).unwrap_err();
        assert_eq!(refused.place(), place, "{refused}");
        assert!(refused.message().contains(said), "{refused}");
    }
}

#[test]
fn slips_in_the_json_are_told_by_line_byte_and_path() {
    let refused = |text: &str| read_bytes(text.as_bytes(), Path::new("a.gltf"), &Folder::none()).unwrap_err();
    let slip =
        refused("{\n \"asset\": { \"version\": \"2.0\" },\n \"nodes\": [{}, {\n  \"mesh\": \"cube\" }]\n}");
    assert_eq!(slip.place(), Place::Line(4));
    assert!(slip.message().starts_with("nodes[1].mesh: invalid type: string \"cube\""), "{slip}");
    assert_eq!(refused("{\n \"asset\": {\n").place(), Place::Line(3));
    assert!(refused("{ \"asset\": {").message().contains("no valid JSON"));
    assert!(refused("{}").message().contains("no glTF file"));
    assert!(refused("{ \"asset\": { \"version\": \"3.0\" } }").message().contains("is glTF 3.0"));
    let old = refused("{ \"asset\": { \"version\": \"1.0\" }, \"accessors\": { \"a\": {} } }");
    assert!(old.message().contains("is glTF 1.0: convert it"), "{old}");
    let deep = refused(&format!("{{ \"extras\": {}", "[".repeat(1_000_000)));
    assert!(deep.message().contains("no valid JSON"), "{deep}");

    let text = b"{\"asset\":{\"version\":\"2.0\"},\"nodes\":7}".to_vec();
    let slip = read_bytes(&glb(&[(b"JSON", text)]), Path::new("a.glb"), &Folder::none()).unwrap_err();
    assert!(matches!(slip.place(), Place::Byte(53..=57)), "{slip}");
}
