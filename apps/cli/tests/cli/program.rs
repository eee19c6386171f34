//! Runs the program as a user would, and says what came of it.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use tempfile::TempDir;

/// What a run has left: exit code, standard output and standard error.
pub(crate) struct Ran {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

/// Runs `catoptra` in a folder.
pub(crate) fn catoptra(folder: &Path, arguments: &[&str]) -> Ran {
    ran(Command::new(env!("CARGO_BIN_EXE_catoptra")).args(arguments).current_dir(folder))
}

/// Runs a line of shell in a folder, in which `$catoptra` is the program.
#[cfg(unix)]
pub(crate) fn shell(folder: &Path, line: &str) -> Ran {
    ran(Command::new("sh").args(["-c", line]).current_dir(folder))
}

fn ran(command: &mut Command) -> Ran {
    let output = command
        .env("NO_COLOR", "1")
        .env("catoptra", env!("CARGO_BIN_EXE_catoptra"))
        .stdin(Stdio::null())
        .output()
        .expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    Ran {
        code: output.status.code().expect("an exit code"),
        out: text(output.stdout),
        err: text(output.stderr),
    }
}

/// A folder with the small scene of these tests as `scene.kdl`.
pub(crate) fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder for the test");
    std::fs::write(folder.path().join("scene.kdl"), SCENE).expect("a scene is written");
    folder
}

/// A ball on a floor with a lamp: shadows, a light that is not reached everywhere, and reflections.
const SCENE: &str = r#"
camera "front" { eye 0 1 4; target 0 1 0 }
camera "above" { eye 0 6 0; target 0 0 0; up 0 0 -1 }
matte "grey" { color 0.5 0.5 0.5 }
phong "shiny" { ambient 0.5 0.1 0.1; diffuse 0.8 0.2 0.2; specular 1 1 1; shininess 16; reflectiveness 0.25 }
plane "floor" material="grey"
sphere "ball" material="shiny" { center 0 1 0; radius 1 }
ambient-light "sky" { radiance 0.1 0.1 0.1 }
point-light "lamp" { position 3 5 3; intensity 50 50 50 }
spot-light "spot" { position -3 5 0; direction 3 -5 0; intensity 90 90 90; inner 20; outer 30 }
"#;

/// The names of all files in a folder, sorted.
pub(crate) fn files(folder: &Path) -> Vec<String> {
    let name = |entry: std::io::Result<std::fs::DirEntry>| {
        entry.expect("an entry").file_name().to_string_lossy().into_owned()
    };
    let mut names: Vec<String> = std::fs::read_dir(folder).expect("a folder").map(name).collect();
    names.sort();
    names
}

/// Where a shipped scene lies.
pub(crate) fn shipped(name: &str) -> String {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
    path.display().to_string()
}

/// Asserts that a run was refused with exit code 2, with these words on standard error and nothing written.
#[track_caller]
pub(crate) fn assert_refused(folder: &Path, arguments: &[&str], words: &[&str]) {
    let before = files(folder);
    let ran = catoptra(folder, arguments);
    assert_eq!(ran.code, 2, "{arguments:?}\n{}{}", ran.out, ran.err);
    for word in words {
        assert!(ran.err.contains(word), "{arguments:?}: no `{word}` in\n{}", ran.err);
    }
    assert_eq!(ran.out, "", "{arguments:?}");
    assert_eq!(files(folder), before, "{arguments:?}");
}
