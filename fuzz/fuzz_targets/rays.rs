//! Do the packets and the trees find what whole numbers find, for arbitrary shapes and rays?
#![no_main]

use std::sync::LazyLock;

use catoptra_core::{Ray, Shape, Span};
use catoptra_fuzz::Bytes;
use catoptra_lab::adversary::Trial;
use catoptra_lab::oracle::confirm;
use catoptra_tracer::query::{HitList, RayList, find_nearest};
use catoptra_tracer::{Pool, Snapshot, backends};
use libfuzzer_sys::fuzz_target;

static POOL: LazyLock<Pool> = LazyLock::new(|| Pool::new(1).expect("a pool of one thread"));

fuzz_target!(|bytes: &[u8]| {
    let mut bytes = Bytes::new(bytes);
    let count = bytes.byte() % 8;
    let shapes: Vec<Shape> = (0..count).filter_map(|_| bytes.shape()).collect();
    let mut rays: Vec<Ray> = Vec::new();
    while bytes.any_left() && rays.len() < 20 {
        rays.push(bytes.ray());
    }
    let trial = Trial { shapes, rays };
    let snapshot = Snapshot::extract(&trial.scene().expect("a scene"), &POOL);
    let mut list = RayList::new();
    trial.rays.iter().for_each(|ray| list.push(ray, [Span::AHEAD.min, Span::AHEAD.max], None));
    for backend in backends() {
        let mut hits = HitList::default();
        find_nearest(*backend, &snapshot, &list, &mut hits, &POOL);
        for (at, ray) in trial.rays.iter().enumerate() {
            if let Err(error) = confirm(&trial.shapes, ray, Span::AHEAD, hits.get(at)) {
                panic!("{}: {error} {:?}", backend.name(), trial.shapes);
            }
        }
    }
});
