//! Does `catoptra lab` answer, and refuse files that are none?

use std::path::Path;

use crate::program::{assert_refused, catoptra, folder};

const TRIANGLE: &str = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";

/// Writes a ray file of two rays, one that meets the triangle at 2 and one that passes it.
fn write_rays(path: &Path) {
    let rays: [[f32; 8]; 2] =
        [[0.0, 0.0, 2.0, 0.0, 0.0, 0.0, -1.0, 9.0], [5.0, 0.0, 2.0, 0.0, 0.0, 0.0, -1.0, 9.0]];
    let mut bytes = 2_u32.to_le_bytes().to_vec();
    bytes.extend(rays.as_flattened().iter().flat_map(|v| v.to_le_bytes()));
    std::fs::write(path, bytes).expect("a ray file is written");
}

#[test]
fn rays_of_a_file_are_traced_and_summed_up() {
    let folder = folder();
    std::fs::write(folder.path().join("one.obj"), TRIANGLE).expect("a mesh is written");
    write_rays(&folder.path().join("two.bin"));
    for (more, figures) in
        [(&[][..], "rays 2 hits 1 sum_t 2.000000000e0"), (&["--any"], "rays 2 hits 1 sum_t 0.000000000e0")]
    {
        let arguments =
            [&["lab", "trace", "one.obj", "two.bin", "--repeat", "2", "--threads", "1"], more].concat();
        let ran = catoptra(folder.path(), &arguments);
        assert_eq!(ran.code, 0, "{}", ran.err);
        assert!(ran.out.contains(figures) && ran.out.lines().count() == 1, "{}", ran.out);
    }
}

#[test]
fn files_that_are_none_are_refused() {
    let folder = folder();
    std::fs::write(folder.path().join("one.obj"), TRIANGLE).expect("a mesh is written");
    std::fs::write(folder.path().join("short.bin"), [1, 0, 0, 0, 7]).expect("a file is written");
    assert_refused(folder.path(), &["lab", "trace", "one.obj", "short.bin"], &["short.bin", "36 bytes"]);
    assert_refused(folder.path(), &["lab", "trace", "one.obj", "none.bin"], &["none.bin"]);
    write_rays(&folder.path().join("two.bin"));
    assert_refused(folder.path(), &["lab", "trace", "none.obj", "two.bin"], &["none.obj"]);
}
