//! Does the viewer refuse to start politely, where it cannot?

use std::process::{Command, Output};

fn start(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_catoptra-viewer"))
        .args(arguments)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .expect("the viewer starts")
}

#[test]
#[cfg(target_os = "linux")]
fn without_a_display_it_names_the_headless_command() {
    let output = start(&[]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("catoptra render SCENE -o OUT.png"), "{told}");
}

#[test]
fn a_size_that_is_none_is_refused_with_code_2() {
    for size in ["0x10", "12", "axb"] {
        let output = start(&["--size", size]);
        assert_eq!(output.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&output.stderr).contains("WIDTHxHEIGHT"));
    }
}

#[test]
fn help_needs_no_display() {
    let output = start(&["--help"]);
    assert!(output.status.success());
    let told = String::from_utf8_lossy(&output.stdout);
    for option in ["--threads", "--size", "--log-frames", "[FILE]"] {
        assert!(told.contains(option), "{option} is missing in\n{told}");
    }
}
