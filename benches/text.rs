//! How long does it take to read a scene from its text, and to write it back?

use std::fmt::Write;

use catoptra_benches::{criterion, scene_file};
use criterion::{BenchmarkId, Criterion, Throughput};

/// A text of so many spheres, each with a material of its own.
fn spheres(count: u32) -> String {
    let mut text = String::from("camera \"eye\" { eye 0 0 9; target 0 0 0 }\n");
    for number in 0..count {
        let _ = writeln!(
            text,
            "matte \"m{number}\" {{ color 0.5 0.25 0.125 }}\n\
             sphere \"s{number}\" material=\"m{number}\" {{ center {number} 0.5 -1; radius 0.25 }} // one of many"
        );
    }
    text
}

fn texts() -> Vec<(&'static str, String)> {
    let many = std::fs::read_to_string(scene_file("seed/many.kdl")).expect("a shipped scene");
    vec![("seed many", many), ("500 spheres", spheres(500))]
}

fn main() {
    let mut criterion: Criterion = criterion();
    for (name, text) in texts() {
        let mut group = criterion.benchmark_group("text");
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_with_input(BenchmarkId::new("parse", name), &text, |b, text| {
            b.iter(|| catoptra_scene::parse(text, name, None).is_ok());
        });
        let Ok((scene, mut file)) = catoptra_scene::parse(&text, name, None) else {
            panic!("{name} is no scene")
        };
        group.bench_function(BenchmarkId::new("write", name), |b| {
            b.iter(|| {
                file.update(&scene);
                file.text()
            });
        });
        group.finish();
    }
    criterion.final_summary();
}
