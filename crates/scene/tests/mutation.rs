//! Does any damaged file end in an error rather than a panic? Truncations and changed bytes of good files, always the same.
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::path::Path;

use catoptra_core::scene::Edit;
use catoptra_scene::model::read_mesh_bytes;
use catoptra_scene::parse;

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

/// Bytes that mean something in scene text or a mesh, so that damage goes deep.
const TELLING: &[u8] = b"{}\"#/-*;=()\\ \n\r0123456789.eE+-nif\0\x7f\xc2\xe2\xff";

fn damaged(original: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = original.to_vec();
    if random.below(4) == 0 {
        bytes.truncate(random.below(bytes.len() + 1));
    }
    for _ in 0..random.below(6) {
        let at = random.below(bytes.len() + 1);
        let telling = TELLING[random.below(TELLING.len())];
        match random.below(5) {
            0 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
            1 if at < bytes.len() => bytes[at] = telling,
            2 if at < bytes.len() => drop(bytes.remove(at)),
            3 => {
                let end = (at + random.below(40)).min(bytes.len());
                let piece = bytes[at..end].to_vec();
                let to = random.below(bytes.len() + 1);
                bytes.splice(to..to, piece);
            }
            _ => bytes.insert(at, telling),
        }
    }
    bytes
}

fn scenes() -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut files: Vec<_> = ["seed", "gallery"]
        .iter()
        .flat_map(|name| std::fs::read_dir(folder.join(name)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "kdl"))
        .collect();
    files.sort();
    files.iter().map(|path| std::fs::read(path).unwrap()).collect()
}

#[test]
fn no_damaged_scene_panics() {
    let scenes = scenes();
    let mut random = Random(1);
    let (mut read, mut refused) = (0, 0);
    for i in 0..2500 {
        let bytes = damaged(&scenes[i % scenes.len()], &mut random);
        let text = String::from_utf8_lossy(&bytes);
        match parse(&text, "damaged.kdl", None) {
            Ok((mut scene, mut file)) => {
                read += 1;
                file.update(&scene);
                assert_eq!(file.text(), text, "no edit changes no byte");
                // What survives damage survives edits too.
                let first = scene.entities().next();
                if let Some(first) = first {
                    scene.apply(Edit::Name(first, "another".into())).unwrap();
                    file.update(&scene);
                    parse(&file.text(), "edited.kdl", None)
                        .unwrap_or_else(|e| panic!("{e}\n{text}\n{}", file.text()));
                }
            }
            Err(error) => {
                refused += 1;
                let _ = error.to_string();
                let _ = format!("{:?}", miette::Report::new(error));
            }
        }
    }
    assert!(
        read > 250 && refused > 250,
        "{read} read, {refused} refused: the damage is not of the right size"
    );
}

/// The parser of KDL calls itself for every error that it meets and for every mark in a comment.
#[test]
fn errors_and_comments_without_end_exhaust_no_stack() {
    let mut random = Random(3);
    for _ in 0..4 {
        let word = |random: &mut Random| -> String {
            let letters =
                (0..1 + random.below(6)).map(|_| TELLING[random.below(TELLING.len() - 3)] as char).collect();
            if random.below(4) == 0 { format!("radius{letters}1 ") } else { letters }
        };
        let kinds: Vec<String> = (0..6).map(|_| word(&mut random)).collect();
        let text: String = (0..10_000).map(|_| kinds[random.below(kinds.len())].as_str()).collect();
        if let Err(error) = parse(&text, "garbage.kdl", None) {
            assert!(error.complaints().len() <= 50);
        }
    }
    for piece in
        ["}\n", "= 1\n", "a 1.\n", "{}\n", "( ", "\"a\"b ", "a \\ b\n", "/- ", "#a\n", "a {} b\n", "/ "]
    {
        assert!(parse(&piece.repeat(10_000), "garbage.kdl", None).is_err());
    }
    let comment =
        format!("/*{}*/\nmatte \"m\" color=1 /* {} */", "*".repeat(40_000), "// a / b\n".repeat(10_000));
    parse(&comment, "comment.kdl", None).unwrap();
}

fn meshes() -> Vec<(&'static str, Vec<u8>)> {
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\ncomment small\nelement vertex 4\nproperty float x\nproperty float y\n\
             property float z\nproperty float nx\nproperty float ny\nproperty float nz\nelement face 2\n\
             property list uchar int vertex_indices\nproperty uchar flags\nend_header\n"
        )
    };
    let mut ascii = header("ascii").into_bytes();
    ascii.extend(b"0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 0\n4 0 1 2 3 255\n");
    let mut all = vec![("a.ply", ascii)];
    for (format, big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
        let mut bytes = header(format).into_bytes();
        let mut put = |mut word: [u8; 4]| {
            if big {
                word.reverse();
            }
            bytes.extend(word);
        };
        for v in 0..24_u8 {
            put(f32::from(v % 5).to_le_bytes());
        }
        for face in [&[0_i32, 1, 2][..], &[0, 1, 2, 3][..]] {
            bytes.push(face.len() as u8);
            for i in face {
                bytes.extend(if big { i.to_be_bytes() } else { i.to_le_bytes() });
            }
            bytes.push(7);
        }
        all.push(("a.ply", bytes));
    }
    let obj = "# small\no a\nv 0 0 0\nv 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\ng b\ns 1\n\
               f 1/1/1 2/2/1 3/1/1\nf -4//-1 -2//-1 -1//1\nusemtl c\nf 1 2 \\\n3 4\n";
    all.push(("a.obj", obj.as_bytes().to_vec()));
    all.push(("a.ply", rich_ply()));
    all.push(("a.stl", b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
        endsolid a\nsolid\nfacet\nvertex 0 0 0 vertex 1 0 0 vertex 1 1 0 vertex .5 .1 0\nendloop\n".to_vec()));
    all.push(("a.stl", binary_stl()));
    all
}

/// Colours, texture coordinates of faces, strips, and the faces first.
fn rich_ply() -> Vec<u8> {
    let header = "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement face 2\n\
                  property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\n\
                  element vertex 4\nproperty double x\nproperty float y\nproperty float z\nproperty uchar red\n\
                  property uchar green\nproperty uchar blue\nelement tristrips 1\n\
                  property list int int vertex_indices\nend_header\n";
    let rows = "3 0 1 2 6 0 0 1 0 1 1 0\n4 0 1 2 3 0 1\n0 0 0 1 2 3\n1 0 0 4 5 6\n.5 .1 0 7 8 9\n0 1 0 255 0 9\n7 0 1 2 3 -1 3 2\n";
    format!("{header}{rows}").into_bytes()
}

fn binary_stl() -> Vec<u8> {
    let mut bytes = b"solid COLOR=\x10\x20\x30\xff".to_vec();
    bytes.resize(80, 0);
    bytes.extend(3_u32.to_le_bytes());
    for facet in 0..3_u8 {
        for v in 0..12 {
            bytes.extend(f32::from((v * 7 + facet) % 5).to_le_bytes());
        }
        bytes.extend([facet * 90; 2]);
    }
    bytes
}

#[test]
fn no_damaged_material_panics() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    put(
        "a.obj",
        b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1 3 2\n",
    );
    catoptra_scene::image::write_png(&folder.path().join("a.png"), 2, 1, &[9, 8, 7, 6, 5, 4]).unwrap();
    let original = b"newmtl a\nKd 0.5 0.5 0.5\nKs 0.25 0.5 1\nNs 96.5\nNi 1.45\nd 0.75\nillum 7\nTf 1 .9 .8\n\
        map_Kd -s 2 2 1 -o 0.5 a.png\nmap_Bump -bm 0.5 a.png\nmap_d -imfchan m a.png\nnewmtl b\nKe 2 2 2\nTr 0.5\nPr 0.25\n\
        Pm 1\nPs 0.5\nPc 1\nPcr 0.1\naniso 0.5\nanisor 0.25\nmap_Pr -mm 0 1 a.png\n";
    let mut random = Random(4);
    let mut told = 0;
    for _ in 0..3000 {
        put("a.mtl", &damaged(original, &mut random));
        // Whatever a library holds, the triangles are there.
        let model = catoptra_scene::model::read(&folder.path().join("a.obj")).unwrap();
        assert_eq!((model.nodes.len(), model.materials.len()), (2, 2));
        told += usize::from(!model.warnings.is_empty());
    }
    assert!(
        (500..2900).contains(&told),
        "{told} of 3000 were told of something: the damage is not of the right size"
    );
}

#[test]
fn no_damaged_mesh_panics() {
    let meshes = meshes();
    let mut random = Random(2);
    let (mut read, mut refused) = (0, 0);
    for i in 0..40_000 {
        let (name, original) = &meshes[i % meshes.len()];
        match read_mesh_bytes(&damaged(original, &mut random), Path::new(name)) {
            Ok(_) => read += 1,
            Err(error) => {
                refused += 1;
                let _ = error.to_string();
            }
        }
    }
    assert!(
        read > 1000 && refused > 1000,
        "{read} read, {refused} refused: the damage is not of the right size"
    );
}

#[test]
fn every_truncation_of_a_mesh_is_refused_or_read() {
    for (name, bytes) in meshes() {
        read_mesh_bytes(&bytes, Path::new(name)).unwrap();
        for end in 0..bytes.len() {
            let _ = read_mesh_bytes(&bytes[..end], Path::new(name));
        }
    }
}
