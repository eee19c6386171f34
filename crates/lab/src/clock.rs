//! How long does something take, on a machine that has other things to do as well?

use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// What is counted as time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clock {
    /// What passes for everyone.
    Wall,
    /// What this process's threads spend on processors, together: for work on one thread the same as [`Wall`](Self::Wall),
    /// less what other programs take in between. Where the system does not tell (only Unix does), the same.
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

#[cfg(unix)]
fn processor_time() -> Option<Duration> {
    use rustix::time::{ClockId, clock_gettime};

    let spent = clock_gettime(ClockId::ProcessCPUTime);
    Duration::try_from(spent).ok()
}

#[cfg(not(unix))]
fn processor_time() -> Option<Duration> {
    None
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
    fn time_that_ended_threads_spent_is_kept() {
        let work =
            || std::hint::black_box((0..1_000_000_u64).fold(0, |sum, i| std::hint::black_box(sum ^ i)));
        for _ in 0..20 {
            let earlier = Clock::Processor.now();
            assert!(std::thread::spawn(work).join().is_ok());
            assert!(Clock::Processor.now() > earlier);
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
