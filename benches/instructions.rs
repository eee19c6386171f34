//! How many instructions do the main kernels take? Counted by valgrind, so that a noisy machine does not matter.
//!
//! Needs the package `valgrind` and `gungraun-runner` of the version that `Cargo.lock` has of `gungraun`; without either it
//! says so and counts nothing. Valgrind knows no AVX-512, so what is counted is the code for AVX2. Only what a backend does
//! with one tile or one share of rays counts, on whatever thread; scenes, trees and threads do not.

use std::process::Command;

#[expect(unreachable_pub, reason = "the macros make what they make public")]
mod counted {
    use catoptra_benches::{alone, camera, rays, scene, shapes};
    use catoptra_core::Scene;
    use catoptra_lab::scenes::{Reach, many_lights, many_spheres, placed_mesh};
    use catoptra_tracer::query::{HitList, RayList, find_nearest};
    use catoptra_tracer::{Control, Film, Instructions, Pool, Size, Snapshot, View, backend_named, render};
    use gungraun::prelude::*;
    use gungraun::{Callgrind, EntryPoint};

    /// Rays of one measurement: one packet's lanes many times over.
    const RAYS: usize = 1 << 12;

    const SIZE: Size = Size::new(128, 96);

    /// A shape alone, and rays half of which meet it.
    fn shape(kind: &str) -> (Snapshot, RayList, HitList, Pool) {
        let shape = shapes().into_iter().find(|(name, _)| *name == kind).expect("a shape of that kind").1;
        (alone(shape), rays(RAYS), HitList::default(), Pool::new(1).expect("a thread"))
    }

    #[library_benchmark(config = LibraryBenchmarkConfig::default().tool(Callgrind::default()
        .entry_point(EntryPoint::Custom("*Wide as catoptra_tracer::backend::Backend>::find_nearest".to_owned()))))]
    #[bench::sphere(args = ("sphere"), setup = shape)]
    #[bench::plane(args = ("plane"), setup = shape)]
    #[bench::triangle(args = ("triangle"), setup = shape)]
    #[bench::rectangle(args = ("rectangle"), setup = shape)]
    #[bench::mesh(args = ("mesh of 9800"), setup = shape)]
    fn nearest((snapshot, rays, mut hits, pool): (Snapshot, RayList, HitList, Pool)) -> HitList {
        find_nearest(backend_named("wide").expect("a backend"), &snapshot, &rays, &mut hits, &pool);
        hits
    }

    /// A scene, the picture that is asked for, and room for it.
    fn picture(name: &str) -> (Snapshot, View, Film, Pool) {
        let scene: Scene = match name {
            "64 lights" => many_lights(64, Reach::Nearby).expect("a scene"),
            "1000 spheres" => many_spheres(1000).expect("a scene"),
            "mesh" => placed_mesh(40).expect("a scene"),
            file => scene(file),
        };
        let mut view = View::of(&scene, camera(&scene), SIZE);
        view.instructions = Instructions::named("avx2");
        let pool = Pool::new(1).expect("a thread");
        (Snapshot::extract(&scene, &pool), view, Film::new(SIZE), pool)
    }

    #[library_benchmark(config = LibraryBenchmarkConfig::default().tool(Callgrind::default()
        .entry_point(EntryPoint::Custom("*Wide as catoptra_tracer::backend::Backend>::trace".to_owned()))))]
    #[bench::planes(args = ("seed/planes.kdl"), setup = picture)]
    #[bench::shadows(args = ("seed/point.kdl"), setup = picture)]
    #[bench::reflections(args = ("seed/material.kdl"), setup = picture)]
    #[bench::lights(args = ("64 lights"), setup = picture)]
    #[bench::spheres(args = ("1000 spheres"), setup = picture)]
    #[bench::mesh(args = ("mesh"), setup = picture)]
    fn frame((snapshot, view, mut film, pool): (Snapshot, View, Film, Pool)) -> Film {
        let backend = backend_named("wide").expect("a backend");
        render(backend, &snapshot, &view, &mut film, &pool, &Control::default()).expect("nobody cancels");
        film
    }

    library_benchmark_group!(name = kernels, benchmarks = [nearest, frame]);

    gungraun::main!(library_benchmark_groups = kernels);

    /// Counts, or runs what is being counted.
    pub(super) fn start() {
        main();
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let is_counted = arguments.first().is_some_and(|argument| argument == "--gungraun-run");
    // Tests have nothing to count.
    if !is_counted && !arguments.iter().any(|argument| argument == "--bench") {
        println!("instructions: counted by `cargo bench -p catoptra-benches --bench instructions`");
        return;
    }
    let missing = |program: &&str| Command::new(program).arg("--version").output().is_err();
    match ["valgrind", "gungraun-runner"].iter().find(|program| !is_counted && missing(program)) {
        Some(program) => println!("instructions: skipped, there is no {program}; see benches/README.md"),
        None => counted::start(),
    }
}
