//! Do help, version and mistakes on the command line end as scripts expect?

use crate::program::{assert_refused, catoptra, folder};

#[test]
fn help_and_version_are_no_errors() {
    let folder = folder();
    for arguments in [&["--help"][..], &["render", "--help"], &["compare", "--help"], &["explain", "--help"]]
    {
        let ran = catoptra(folder.path(), arguments);
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{arguments:?}");
    }
    assert_eq!(
        catoptra(folder.path(), &["--version"]).out,
        concat!("catoptra ", env!("CARGO_PKG_VERSION"), "\n")
    );
}

#[test]
fn mistakes_are_refused() {
    let folder = folder();
    assert_refused(folder.path(), &["rendre"], &["rendre", "render"]);
    assert_refused(folder.path(), &["render"], &["SCENE"]);
    assert_refused(folder.path(), &["render", "scene.kdl", "--sise", "4x4"], &["--sise", "--size"]);
}

#[test]
fn no_command_at_all_shows_the_help_as_an_error() {
    let folder = folder();
    assert_refused(folder.path(), &[], &["render", "explain", "compare"]);
}
