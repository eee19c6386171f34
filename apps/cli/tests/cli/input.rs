//! Is what cannot be read told in one message, and is a scene read from wherever it comes?

use std::fs;

#[cfg(unix)]
use crate::program::shell;
use crate::program::{assert_refused, catoptra, folder};

#[cfg(unix)]
#[test]
fn a_scene_comes_from_standard_input_or_a_pipe() {
    let folder = folder();
    fs::create_dir(folder.path().join("meshes")).unwrap();
    fs::write(folder.path().join("meshes/m.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let text = fs::read_to_string(folder.path().join("scene.kdl")).unwrap()
        + "mesh \"m\" material=\"grey\" { file \"meshes/m.obj\" }\n";
    fs::write(folder.path().join("with-mesh.kdl"), text).unwrap();
    let whole = ["render", "with-mesh.kdl", "-o", "whole.png", "--size", "32x24"];
    assert_eq!(catoptra(folder.path(), &whole).code, 0);
    for (scene, from) in [
        ("-", "< with-mesh.kdl"),
        ("/dev/stdin", "< with-mesh.kdl"),
        ("/dev/fd/3", "3< with-mesh.kdl"),
        ("pipe", ""),
    ] {
        let ran = shell(
            folder.path(),
            &format!(
                "mkfifo pipe 2> pipe.err; if [ {scene} = pipe ]; then cat with-mesh.kdl > pipe & fi; \
                 $catoptra render {scene} -o a.png --size 32x24 {from}"
            ),
        );
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{scene}");
        let [a, whole] = ["a.png", "whole.png"].map(|name| fs::read(folder.path().join(name)).unwrap());
        assert!(a == whole, "{scene}");
        fs::remove_file(folder.path().join("a.png")).unwrap();
    }
}

#[cfg(unix)]
#[test]
fn a_mistake_on_standard_input_is_told_with_its_place() {
    let folder = folder();
    let ran = shell(folder.path(), "echo 'sphre \"a\"' | $catoptra render - -o a.png");
    assert!(ran.code == 2 && ran.err.contains("<stdin>:1:1"), "{}", ran.err);
    let ran = shell(folder.path(), "$catoptra explain - < /dev/null");
    assert!(ran.code == 2 && ran.err.contains("no camera"), "{}", ran.err);
}

#[test]
fn a_cause_is_told_once() {
    let folder = folder();
    fs::write(
        folder.path().join("lost.kdl"),
        "matte \"w\" { color 1 }\nmesh \"m\" material=\"w\" { file \"no.ply\" }\n",
    )
    .unwrap();
    for arguments in [
        &["render", "nowhere.kdl", "-o", "a.png"][..],
        &["render", "lost.kdl", "-o", "a.png"],
        &["compare", "a.png", "b.png"],
        &["lab", "trace", "no.ply", "no.bin"],
    ] {
        let ran = catoptra(folder.path(), arguments);
        assert_eq!(ran.code, 2);
        let told = ran.err.matches("(os error").count();
        assert_eq!(told, 1, "{arguments:?}: {}", ran.err);
    }
}

#[test]
fn what_is_no_scene_is_told_in_one_line() {
    let folder = folder();
    let path = folder.path();
    fs::write(path.join("m.fbx"), "Kaydara FBX Binary").unwrap();
    fs::write(path.join("a.png"), b"\x89PNG\r\n\x1a\n\0\0").unwrap();
    fs::create_dir(path.join("in")).unwrap();
    for (name, words) in [
        ("m.fbx", &["is a model (.fbx), not a scene", ".obj"][..]),
        ("a.png", &["is a picture, not a scene"]),
        ("in", &["in: is a folder, not a scene"]),
    ] {
        assert_refused(path, &["render", name, "-o", "b.png"], words);
        assert_refused(path, &["explain", name], words);
    }
}

#[test]
fn pictures_that_cannot_be_compared_say_why() {
    let folder = folder();
    assert_eq!(catoptra(folder.path(), &["render", "scene.kdl", "-o", "a.png", "--size", "8x8"]).code, 0);
    assert_refused(folder.path(), &["compare", ".", "a.png"], &[". is a folder, not a picture"]);
    assert_refused(folder.path(), &["compare", "a.png", "a"], &["a cannot be read: "]);
    assert_refused(folder.path(), &["compare", "scene.kdl", "a.png"], &["scene.kdl", ".png"]);
}
