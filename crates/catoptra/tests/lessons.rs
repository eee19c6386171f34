//! Does every example run to its end, say what it promises, and stay a lesson: at most 30 lines of code?

use std::path::{Path, PathBuf};
use std::process::Command;

/// Each example, and what it prints.
const LESSONS: &[(&str, &[&str])] = &[
    ("picture", &["picture.png: 320 x 240 pixels"]),
    (
        "rays",
        &["triangle 0 at [0.7, 0.2, 0] after 2 m", "triangle 1", "triangle 0 at [0.5, 0.5, 0]", "a miss"],
    ),
    ("progress", &["stopped here", "the work was cancelled", "100 % done"]),
    (
        "edit",
        &[
            "the ball in the middle: [0.8, 0.5, 0.3]",
            "moved aside: [0.0, 0.0, 0.0]",
            "undone: [0.8, 0.5, 0.3]",
        ],
    ),
    ("light", &["0.0 m:", "0.8 m:", "off by 0"]),
    ("compare", &["rmse: ", "flip: "]),
];

/// Where cargo puts the examples that it builds with the tests of a package.
fn program(name: &str) -> PathBuf {
    let test = std::env::current_exe().expect("a test that runs");
    let profile = test.parent().and_then(Path::parent).expect("a folder of the profile");
    profile.join("examples").join(name).with_extension(std::env::consts::EXE_EXTENSION)
}

#[test]
fn every_example_runs_and_says_what_it_promises() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, promised) in LESSONS {
        let program = program(name);
        let run = Command::new(&program).current_dir(&folder).output();
        let run = run
            .unwrap_or_else(|e| panic!("{}: {e}; `cargo test` without --test builds it", program.display()));
        let said = String::from_utf8_lossy(&run.stdout);
        assert!(run.status.success(), "{name}: {}", String::from_utf8_lossy(&run.stderr));
        let mut rest = &said[..];
        for words in *promised {
            let at =
                rest.find(words).unwrap_or_else(|| panic!("{name} says {words:?} in its place:\n{said}"));
            rest = &rest[at + words.len()..];
        }
    }
    assert!(folder.path().join("picture.png").is_file());
}

#[test]
fn every_example_is_short() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut files: Vec<_> =
        std::fs::read_dir(folder).expect("a folder").map(|file| file.expect("a file").path()).collect();
    files.sort();
    assert_eq!(files.len(), LESSONS.len(), "every example is run");
    for file in files {
        let text = std::fs::read_to_string(&file).expect("an example");
        let is_code = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with("//");
        let lines = text.lines().filter(is_code).count();
        assert!(lines <= 30, "{}: {lines} lines", file.display());
    }
}
