//! Does what is printed arrive, or does the program say that it did not?

use crate::program::{folder, shell};

#[test]
fn an_answer_that_nobody_can_get_is_no_success() {
    let folder = folder();
    for command in
        ["explain scene.kdl", "render scene.kdl --repeat 1", "--help", "--version", "render --help"]
    {
        let ran = shell(folder.path(), &format!("$catoptra {command} >&-"));
        assert_eq!(ran.code, 2, "{command}: {}", ran.err);
        assert!(ran.err.contains("standard output is closed"), "{command}: {}", ran.err);
        let ran = shell(folder.path(), &format!("$catoptra {command} > /dev/null"));
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{command}");
    }
}

#[test]
fn a_full_disk_under_standard_output_is_told() {
    let folder = folder();
    if !std::path::Path::new("/dev/full").exists() {
        println!("skipped: there is no /dev/full");
        return;
    }
    for command in ["explain scene.kdl", "render scene.kdl --repeat 1", "--help", "--version"] {
        let ran = shell(folder.path(), &format!("$catoptra {command} > /dev/full"));
        assert_eq!(ran.code, 2, "{command}: {}", ran.err);
        assert!(ran.err.contains("standard output cannot be written"), "{command}: {}", ran.err);
    }
}

#[test]
fn a_standard_output_that_cannot_be_written_to_is_told() {
    let folder = folder();
    let ran = shell(folder.path(), "$catoptra explain scene.kdl 1< scene.kdl");
    assert!(ran.code == 2 && ran.err.contains("standard output cannot be written"), "{}", ran.err);
}

#[test]
fn a_reader_that_has_had_enough_is_no_error() {
    let folder = folder();
    let ran = shell(folder.path(), "{ sleep 1; $catoptra explain scene.kdl; echo $? >&2; } | true");
    assert_eq!((ran.code, ran.err.as_str()), (0, "0\n"));
}

#[test]
fn a_standard_error_that_nobody_hears_changes_no_exit_code() {
    let folder = folder();
    for end in ["2>&-", "2> /dev/full", "2>&- >&- <&-"] {
        let missing = shell(folder.path(), &format!("$catoptra render none.kdl -o a.png {end}"));
        assert_eq!(missing.code, 2, "{end}");
        let usage = shell(folder.path(), &format!("$catoptra rendre {end}"));
        assert_eq!(usage.code, 2, "{end}");
        let warned = format!("$catoptra render scene.kdl -o a.exr --display srgb --size 8x8 {end}");
        assert_eq!(shell(folder.path(), &warned).code, 0, "{end}");
    }
}

#[test]
fn a_comparison_answers_by_its_exit_code_too() {
    let folder = folder();
    let line = "$catoptra render scene.kdl -o a.png --size 8x8 && $catoptra compare a.png a.png >&-";
    assert_eq!(shell(folder.path(), line).code, 0);
}
