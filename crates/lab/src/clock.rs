//! How long does something take, on a machine that has other things to do as well?

use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// What is counted as time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clock {
    /// What passes for everyone.
    Wall,
    /// What this process's threads spend on processors, together: for work on one thread the same as [`Wall`](Self::Wall),
    /// less what other programs take in between. Where the system does not tell (only Linux does), the same.
    Processor,
}

impl Clock {
    /// Time since some moment in the past.
    #[must_use]
    pub fn now(self) -> Duration {
        static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
        let wall = BEGUN.elapsed();
        match self {
            Self::Wall => wall,
            Self::Processor => processor_time().unwrap_or(wall),
        }
    }
}

/// From the first numbers of `/proc/self/task/*/schedstat`: nanoseconds that each thread has run. A thread that sleeps
/// is counted to the nanosecond, so work should be done on another thread than the one that asks.
fn processor_time() -> Option<Duration> {
    let mut sum = 0_u64;
    for task in std::fs::read_dir("/proc/self/task").ok()? {
        let text = std::fs::read_to_string(task.ok()?.path().join("schedstat")).ok()?;
        sum += text.split(' ').next()?.parse::<u64>().ok()?;
    }
    (sum > 0).then(|| Duration::from_nanos(sum))
}

/// Answers at least `goes` times and for at least `long_enough` of wall time; the last answer, and the least time of all.
///
/// # Panics
/// When the answer does.
pub fn fastest<T>(
    clock: Clock,
    goes: u32,
    long_enough: Duration,
    mut answer: impl FnMut() -> T,
) -> (T, Duration) {
    let (mut least, begun, mut gone) = (Duration::MAX, Instant::now(), 0);
    loop {
        let started = clock.now();
        let answered = answer();
        least = least.min(clock.now().saturating_sub(started));
        gone += 1;
        if gone >= goes && begun.elapsed() >= long_enough {
            return (answered, least);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_clock_goes_backwards() {
        for clock in [Clock::Wall, Clock::Processor] {
            let earlier = clock.now();
            assert!(clock.now() >= earlier, "{clock:?}");
        }
    }

    #[test]
    fn the_last_answer_is_given_after_as_many_goes_as_asked() {
        let mut count = 0;
        let (answer, _) = fastest(Clock::Wall, 7, Duration::ZERO, || {
            count += 1;
            count
        });
        assert_eq!(answer, 7);
    }
}
