//! How many rays a second are held against one shape of each kind, half of them hits?

use catoptra_benches::{alone, criterion, rays, shapes};
use catoptra_tracer::query::{HitList, find_nearest, find_occluded};
use catoptra_tracer::{Pool, backend_named};
use criterion::{BenchmarkId, Criterion, Throughput};

/// Rays of one measurement.
const RAYS: usize = 1 << 14;

fn kernels(c: &mut Criterion) {
    let (rays, pool) = (rays(RAYS), Pool::new(1).expect("a thread"));
    let backend = backend_named("wide").expect("the default backend");
    for (group, any) in [("nearest", false), ("occluded", true)] {
        let mut group = c.benchmark_group(group);
        group.throughput(Throughput::Elements(RAYS as u64));
        for (name, shape) in shapes() {
            let snapshot = alone(shape);
            let (mut hits, mut occluded) = (HitList::default(), Vec::new());
            group.bench_with_input(BenchmarkId::from_parameter(name), &(), |b, ()| {
                b.iter(|| {
                    if any {
                        find_occluded(backend, &snapshot, &rays, &mut occluded, &pool);
                    } else {
                        find_nearest(backend, &snapshot, &rays, &mut hits, &pool);
                    }
                });
            });
        }
        group.finish();
    }
}

fn main() {
    let mut criterion = criterion();
    kernels(&mut criterion);
    criterion.final_summary();
}
