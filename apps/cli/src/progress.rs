//! How far is a long render? A bar on stderr, on a terminal only, and only once a render takes longer than a second.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use catoptra_tracer::{Control, Progress};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;

use crate::console::{Talk, talks};

/// Renders shorter than this show nothing.
const PATIENCE: Duration = Duration::from_secs(1);

/// Time between two looks at the progress.
const BEAT: Duration = Duration::from_millis(100);

/// Parts of the bar.
const STEPS: u64 = 1000;

/// Runs `work` and shows the progress of `control` meanwhile.
pub(crate) fn while_showing<T>(control: &Control, work: impl FnOnce() -> T) -> T {
    if !std::io::stderr().is_terminal() || !talks(Talk::Usual) {
        return work();
    }
    let (finished, watch) = channel::<()>();
    std::thread::scope(|scope| {
        // Where the system gives no thread, the work goes on unshown.
        let _shown = std::thread::Builder::new().spawn_scoped(scope, move || {
            let started = Instant::now();
            let mut bar = None;
            while watch.recv_timeout(BEAT) == Err(RecvTimeoutError::Timeout) {
                if started.elapsed() >= PATIENCE {
                    let bar = bar.get_or_insert_with(|| new_bar(started.elapsed()));
                    bar.set_position((f64::from(control.progress()) * STEPS as f64) as u64);
                    if let Some(Progress { samples, error, .. }) = control.reached() {
                        bar.set_style(style(PASSES));
                        bar.set_message(format!("{samples:.0} samples a pixel, errors up to {error:.1e}"));
                    }
                }
            }
            if let Some(bar) = bar {
                bar.finish_and_clear();
            }
        });
        let result = work();
        drop(finished);
        result
    })
}

/// What is shown of one pass over a picture.
const ONE: &str = "{elapsed_precise} {wide_bar} {percent}% (about {eta} left)";

/// What is shown of passes until a picture is sure enough.
const PASSES: &str = "{elapsed_precise} {wide_bar} {percent}% of a pass; {msg}";

fn new_bar(elapsed: Duration) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr()).with_elapsed(elapsed);
    bar.with_style(style(ONE))
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_result_of_the_work_comes_back() {
        assert_eq!(while_showing(&Control::default(), || 7), 7);
    }

    #[test]
    fn bars_have_their_styles() {
        assert!([ONE, PASSES].iter().all(|template| ProgressStyle::with_template(template).is_ok()));
    }
}
