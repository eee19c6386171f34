//! Which programs do the window tests run? A virtual screen, a hand on mouse and keys, and the viewer.

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{LazyLock, Once};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How often is looked whether something has come.
pub(crate) const LOOK: Duration = Duration::from_millis(15);

/// Set to 1, a missing program fails the tests instead of skipping them.
const REQUIRE: &str = "CATOPTRA_REQUIRE_WINDOW";

/// The first program that the tests need and the machine lacks.
static MISSING: LazyLock<Option<&str>> = LazyLock::new(|| {
    let lacks = |program: &&str| {
        Command::new(program).arg("-help").stdout(Stdio::null()).stderr(Stdio::null()).status().is_err()
    };
    ["Xvfb", "xdotool"].into_iter().find(lacks)
});

/// Skipping is told once.
static TOLD: Once = Once::new();

/// Whether the machine has all programs. If not, that is told; it is a failure when the environment demands windows.
pub(crate) fn are_there() -> bool {
    let Some(missing) = *MISSING else { return true };
    let demanded = std::env::var_os(REQUIRE).is_some_and(|v| v == "1");
    assert!(!demanded, "{REQUIRE}=1, but {missing} is missing");
    // Past the test harness, which keeps back what passing tests print.
    TOLD.call_once(|| {
        let line = format!("window tests SKIPPED: {missing} is missing; {REQUIRE}=1 makes this a failure\n");
        let _ = std::io::stderr().write_all(line.as_bytes());
    });
    false
}

/// Starts a virtual screen under a free number that it chooses itself, and sees that it answers: another screen may
/// have been faster with that number.
pub(crate) fn open_screen(buffer: &Path) -> (Child, String) {
    for _ in 0..10 {
        let mut screen = Command::new("Xvfb")
            .args([
                "-displayfd",
                "1",
                "-screen",
                "0",
                "1280x720x24",
                "-nolisten",
                "tcp",
                "-noreset",
                "-fbdir",
            ])
            .arg(buffer)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts");
        let mut number = String::new();
        let stdout = screen.stdout.as_mut().expect("it was piped");
        BufReader::new(stdout).read_line(&mut number).expect("Xvfb names its display");
        let display = format!(":{}", number.trim());
        let probe = Command::new("xdotool").arg("getdisplaygeometry").env("DISPLAY", &display).output();
        if probe.is_ok_and(|answer| answer.stdout.starts_with(b"1280 720")) {
            return (screen, display);
        }
        end(&mut screen);
        sleep(Duration::from_millis(200));
    }
    panic!("Xvfb does not answer");
}

/// Ends a program, politely at first so that it can tidy up.
pub(crate) fn end(child: &mut Child) {
    let _ = Command::new("kill").arg(child.id().to_string()).stderr(Stdio::null()).status();
    let begin = Instant::now();
    while matches!(child.try_wait(), Ok(None)) && begin.elapsed() < Duration::from_secs(2) {
        sleep(LOOK);
    }
    // It may have ended by itself.
    let _ = child.kill();
    let _ = child.wait();
}

/// The viewer that was built along with this test, or the one that the environment names.
pub(crate) fn viewer() -> PathBuf {
    if let Some(path) = std::env::var_os("CATOPTRA_VIEWER") {
        return path.into();
    }
    let test = std::env::current_exe().expect("the test's own path");
    let folder = test.parent().and_then(Path::parent).expect("a target folder");
    let viewer = folder.join(format!("catoptra-viewer{}", std::env::consts::EXE_SUFFIX));
    assert!(viewer.exists(), "{} is missing: build the workspace first", viewer.display());
    viewer
}
