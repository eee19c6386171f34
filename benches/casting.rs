//! How many rays a second does a caster answer, beside the call that it stands on? On one thread, a million rays without order
//! against a ball of 81,920 triangles.

use catoptra_benches::criterion;
use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Span};
use catoptra_lab::adversary::Random;
use catoptra_lab::scenes::icosphere;
use catoptra_tracer::query::{HitList, RayList, find_nearest, find_occluded};
use catoptra_tracer::{Caster, Pool, RayColumns, backends};
use criterion::Throughput;

const RAYS: usize = 1_000_000;

/// From all round the ball to places in and round it, so that most meet it.
fn rays() -> (Vec<DVec3>, Vec<DVec3>) {
    let mut random = Random::new(1);
    let ray = |_| {
        let from = random.direction() * 3.0;
        (from, random.point(1.0) - from)
    };
    (0..RAYS).map(ray).unzip()
}

fn main() {
    let mut criterion = criterion();
    let (positions, triangles) = icosphere(6);
    let caster = Caster::from_triangles(&positions, &triangles).expect("a caster");
    let pool = Pool::new(1).expect("a thread");
    let (origins, directions) = rays();
    let columns = RayColumns::new(&origins, &directions).expect("columns");
    let mut list = RayList::new();
    let lines = origins.iter().zip(&directions);
    lines.for_each(|(&o, &d)| list.push(&Ray::new(o, d), [Span::AHEAD.min, Span::AHEAD.max], None));
    let mut group = criterion.benchmark_group("casting");
    group.throughput(Throughput::Elements(RAYS as u64));
    group.sample_size(10);
    let (mut hits, mut met) = (HitList::default(), Vec::new());
    group.bench_function("find_nearest", |b| {
        b.iter(|| find_nearest(backends()[0], caster.snapshot(), &list, &mut hits, &pool));
    });
    group.bench_function("nearest_many", |b| b.iter(|| caster.nearest_many(&columns, &pool).expect("rays")));
    group.bench_function("find_occluded", |b| {
        b.iter(|| find_occluded(backends()[0], caster.snapshot(), &list, &mut met, &pool));
    });
    group.bench_function("any_many", |b| b.iter(|| caster.any_many(&columns, &pool).expect("rays")));
    group.finish();
    criterion.final_summary();
}
