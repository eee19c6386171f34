//! Is every answer about a hard ray that of exact arithmetic?

use catoptra_core::Span;
use catoptra_lab::adversary::{GROUPS, Random};
use catoptra_lab::oracle::confirm;
use catoptra_tracer::query::{HitList, RayList, find_nearest};
use catoptra_tracer::{Pool, Snapshot, Stats, backends};

/// Trials of every group; each has some two dozen rays.
const TRIALS: u64 = 40;

#[test]
fn every_backend_finds_what_exact_arithmetic_finds() {
    let pool = Pool::new(1).expect("a pool of threads");
    let (mut wrong, mut asked) = (Vec::new(), 0);
    let mut counts = vec![Stats::default(); backends().len()];
    for (group, number) in GROUPS.iter().flat_map(|group| (0..TRIALS).map(move |number| (group, number))) {
        let trial = (group.make)(&mut Random::new(number));
        let snapshot = Snapshot::extract(&trial.scene().expect("a scene"), &pool);
        let (mut list, mut hits) = (RayList::new(), HitList::default());
        trial.rays.iter().for_each(|ray| list.push(ray, [Span::AHEAD.min, Span::AHEAD.max], None));
        asked += trial.rays.len();
        for (backend, counts) in backends().iter().zip(&mut counts) {
            *counts += find_nearest(*backend, &snapshot, &list, &mut hits, &pool);
            for (at, ray) in trial.rays.iter().enumerate() {
                let confirmed = confirm(&trial.shapes, ray, Span::AHEAD, hits.get(at));
                let told = |error| format!("{} {number} by {}: {error}", group.name, backend.name());
                wrong.extend(confirmed.map_err(told).err());
            }
        }
    }
    for (backend, counts) in backends().iter().zip(&counts) {
        println!("{}: {asked} rays, {} settled, {} exactly", backend.name(), counts.settled, counts.exact);
    }
    let told = wrong.len().min(20);
    assert!(wrong.is_empty(), "{} of {asked} wrong\n{}", wrong.len(), wrong[..told].join("\n"));
}
