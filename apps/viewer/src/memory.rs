//! When does the memory of a large picture go back to the system, if nothing happens after it?
//!
//! The allocator gives back what has not been used for a second, but looks for that only when it is asked for memory.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// How long after memory was set free the allocator is made to look.
const AFTER: Duration = Duration::from_secs(2);

/// How often it is asked then: it looks at a part of its memory each time.
const TIMES: u32 = 16;

/// What it is asked for, in bytes: too much to be at hand.
const ASKED: usize = 8 << 20;

/// Makes the allocator look once, some time after the last large piece of memory was set free.
#[derive(Debug, Default)]
pub(crate) struct GivingBack {
    due: Option<Instant>,
}

impl GivingBack {
    /// A large piece has been set free.
    pub(crate) fn expect(&mut self, now: Instant) {
        self.due = Some(now + AFTER);
    }

    /// When it has to be made to look.
    pub(crate) fn due(&self) -> Option<Instant> {
        self.due
    }

    /// Makes it look if that is due.
    pub(crate) fn do_if_due(&mut self, now: Instant) {
        if self.due.is_some_and(|due| due <= now) {
            self.due = None;
            for _ in 0..TIMES {
                drop(black_box(Vec::<u8>::with_capacity(ASKED)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_looks_once_and_only_after_the_last() {
        let (mut giving, start) = (GivingBack::default(), Instant::now());
        giving.expect(start);
        giving.expect(start + AFTER / 2);
        giving.do_if_due(start + AFTER);
        assert_eq!(giving.due(), Some(start + AFTER / 2 + AFTER));
        giving.do_if_due(start + 2 * AFTER);
        assert_eq!(giving.due(), None);
    }
}
