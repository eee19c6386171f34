//! How does the program talk? Answers go to standard output and must arrive; what else there is to say goes to standard
//! error, and it is no error if nobody hears it.

use std::fs::File;
use std::io::{self, ErrorKind, Write};
use std::sync::atomic::{AtomicU8, Ordering};

use miette::{Result, miette};

/// Prints to standard output. A reader that has gone away, such as `head`, wants no more and is no error.
pub(crate) fn print(text: &str) -> Result<()> {
    let printed =
        standard_output().and_then(|mut out| out.write_all(text.as_bytes()).and_then(|()| out.flush()));
    match printed {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(miette!("standard output cannot be written: {error}"))
        }
        _ => Ok(()),
    }
}

/// Prints what is the only fruit of a command.
pub(crate) fn print_answer(text: &str) -> Result<()> {
    check_heard()?;
    print(text)
}

/// Refuses to work for an answer that nobody can get, as standard output was closed when the program began.
pub(crate) fn check_heard() -> Result<()> {
    match standard_output() {
        Ok(out) if !stands_in(&out) => Ok(()),
        _ => Err(miette!("standard output is closed: there is nowhere to print the answer")),
    }
}

/// How much is said that is no answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Talk {
    /// Errors.
    Quiet,
    /// Notes and warnings too.
    Usual,
    /// How the work goes on, too.
    Verbose,
}

/// The [`Talk`] that was asked for.
static TALK: AtomicU8 = AtomicU8::new(Talk::Usual as u8);

/// Sets how much is said from now on.
pub(crate) fn set_talk(talk: Talk) {
    TALK.store(talk as u8, Ordering::Relaxed);
}

/// Whether so much is to be said.
pub(crate) fn talks(talk: Talk) -> bool {
    TALK.load(Ordering::Relaxed) >= talk as u8
}

/// Says on standard error why a command fails.
pub(crate) fn complain(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Says something on standard error, unless nothing but errors is to be said.
pub(crate) fn say(text: &str) {
    if talks(Talk::Usual) {
        complain(text);
    }
}

/// Says how the work goes on, where that is asked for.
pub(crate) fn detail(text: &str) {
    if talks(Talk::Verbose) {
        complain(text);
    }
}

/// Says that something was asked for which changes nothing.
pub(crate) fn warn(text: &str) {
    say(&format!("warning: {text}"));
}

/// Standard output as a file, whose errors are not passed over as those of [`std::io::Stdout`] are in part.
#[cfg(unix)]
fn standard_output() -> io::Result<File> {
    use std::os::fd::AsFd;

    io::stdout().as_fd().try_clone_to_owned().map(File::from)
}

/// Whether it is the `/dev/null` that Rust's start-up code opens, for reading and writing, where there was nothing.
///
/// A shell's `> /dev/null` is opened for writing only. A few programs that start others pass on the same as Rust opens;
/// so this is asked only where nothing but the printed answer could have been wanted.
#[cfg(unix)]
fn stands_in(out: &File) -> bool {
    use std::os::unix::fs::MetadataExt;

    use rustix::fs::{OFlags, fcntl_getfl};

    let both_ways = fcntl_getfl(out).is_ok_and(|flags| flags.contains(OFlags::RDWR));
    let (Ok(out), Ok(null)) = (out.metadata(), std::fs::metadata("/dev/null")) else { return false };
    both_ways && out.rdev() == null.rdev() && out.rdev() != 0
}

#[cfg(not(unix))]
fn standard_output() -> io::Result<io::Stdout> {
    Ok(io::stdout())
}

#[cfg(not(unix))]
fn stands_in(_out: &io::Stdout) -> bool {
    false
}
