//! Does a backend answer hard rays as exact arithmetic does?

use catoptra_core::Span;
use catoptra_tracer::query::{HitList, RayList, find_nearest};
use catoptra_tracer::{Backend, Pool, Snapshot, Stats};

use super::{Group, Random};
use crate::oracle::confirm;
use crate::stress::PoseError;

/// How a backend did.
#[derive(Debug, Default)]
pub struct Replies {
    /// Rays asked.
    pub asked: usize,
    /// Wrong answers, in words, by the number of their trial.
    pub wrong: Vec<String>,
    /// What was counted on the way.
    pub stats: Stats,
}

impl Group {
    /// Asks a backend about at least so many rays of the group: those of trial number `first` and its successors.
    ///
    /// # Errors
    /// None that a trial could bring about: see [`Trial::scene`](super::Trial::scene).
    pub fn ask(
        &self,
        backend: &dyn Backend,
        first: u64,
        count: usize,
        pool: &Pool,
    ) -> Result<Replies, PoseError> {
        let mut replies = Replies::default();
        for number in first.. {
            if replies.asked >= count {
                break;
            }
            let trial = (self.make)(&mut Random::new(number));
            let snapshot = Snapshot::extract(&trial.scene()?, pool);
            let (mut list, mut hits) = (RayList::new(), HitList::default());
            trial.rays.iter().for_each(|ray| list.push(ray, [Span::AHEAD.min, Span::AHEAD.max], None));
            replies.stats += find_nearest(backend, &snapshot, &list, &mut hits, pool);
            for (at, ray) in trial.rays.iter().enumerate() {
                let confirmed = confirm(&trial.shapes, ray, Span::AHEAD, hits.get(at));
                let told = |error| format!("{} {number} by {}: {error}", self.name, backend.name());
                replies.wrong.extend(confirmed.map_err(told).err());
            }
            replies.asked += trial.rays.len();
        }
        Ok(replies)
    }
}
