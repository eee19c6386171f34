//! How many instructions do the main kernels take? Counted by valgrind, so that a noisy machine does not matter.
//!
//! The program runs itself under `callgrind` with some frames and with none; the difference is what frames cost. A tool
//! that only needs valgrind's own package is preferred to a runner that would have to be installed in the same version
//! as its library. Valgrind knows no AVX-512, so what is counted is the code for AVX2.

use std::process::Command;

use catoptra_benches::{camera, scene};
use catoptra_core::Scene;
use catoptra_lab::scenes::{Reach, many_lights, many_spheres, placed_mesh};
use catoptra_tracer::{Control, Film, Pool, Size, Snapshot, View, backend_named, render};

const SIZE: Size = Size::new(128, 96);

/// Frames that are counted.
const FRAMES: u64 = 4;

/// The word before a kernel's name and a number of frames, with which the program runs as its own subject.
const SUBJECT: &str = "--subject";

/// What is counted: a name, and the scene that shows it.
type Kernel = (&'static str, fn() -> Scene);

const KERNELS: [Kernel; 6] = [
    ("planes", || scene("seed/planes.kdl")),
    ("sphere and shadows", || scene("seed/point.kdl")),
    ("reflections", || scene("seed/material.kdl")),
    ("64 lights", || many_lights(64, Reach::Nearby).expect("a scene")),
    ("1000 spheres", || many_spheres(1000).expect("a scene")),
    ("mesh", || placed_mesh(40).expect("a scene")),
];

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    match arguments.iter().position(|argument| argument == SUBJECT) {
        Some(at) => trace(&arguments[at + 1], arguments[at + 2].parse().expect("a number of frames")),
        None => count_all(),
    }
}

/// Traces so many frames of a kernel's scene.
fn trace(kernel: &str, frames: u64) {
    let (_, scene) = KERNELS.iter().find(|(name, _)| *name == kernel).expect("a kernel of that name");
    let scene = scene();
    let (snapshot, view) = (Snapshot::extract(&scene), View::of(&scene, camera(&scene), SIZE));
    let (pool, mut film) = (Pool::new(1).expect("a thread"), Film::new(SIZE));
    let backend = backend_named("wide").expect("the default backend");
    for _ in 0..frames {
        render(backend, &snapshot, &view, &mut film, &pool, &Control::default()).expect("nobody cancels");
    }
}

fn count_all() {
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("instructions: skipped, there is no valgrind (Debian, Ubuntu: package valgrind)");
        return;
    }
    // Tests only want to see that it runs.
    let kernels =
        if std::env::args().any(|argument| argument == "--bench") { &KERNELS[..] } else { &KERNELS[..1] };
    println!("{:24} {:>18} {:>18}", "instructions", "a frame", "a pixel");
    for (name, _) in kernels {
        match (counted(name, 0), counted(name, FRAMES)) {
            (Some(before), Some(after)) => {
                let frame = after.saturating_sub(before) / FRAMES;
                println!("{name:24} {frame:>18} {:>18.1}", frame as f64 / SIZE.pixels() as f64);
            }
            _ => println!("{name:24} not counted: valgrind could not run it"),
        }
    }
}

/// Instructions of the whole program with so many frames.
fn counted(kernel: &str, frames: u64) -> Option<u64> {
    let program = std::env::current_exe().ok()?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args([SUBJECT, kernel, &frames.to_string()])
        .output()
        .ok()?;
    let words = String::from_utf8_lossy(&output.stderr).into_owned();
    let line = words.lines().find(|line| line.contains("Collected :"))?;
    line.rsplit(' ').next()?.parse().ok()
}
