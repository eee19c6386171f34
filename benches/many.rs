//! How does a frame's time grow with the number of lights, spheres and instances?

use catoptra_benches::{criterion, frame};
use catoptra_core::Scene;
use catoptra_lab::scenes::{NoScene, Reach, many_instances, many_lights, many_spheres};
use criterion::Criterion;

/// A group of measurements, its scene for each number, and the numbers.
type Growth = (&'static str, fn(u32) -> Result<Scene, NoScene>, &'static [u32]);

const GROWTHS: [Growth; 4] = [
    ("lights everywhere", |n| many_lights(n, Reach::Everywhere), &[1, 16, 128, 1024]),
    ("lights nearby", |n| many_lights(n, Reach::Nearby), &[1, 16, 128, 1024]),
    ("spheres", many_spheres, &[1, 100, 10_000]),
    ("instances of 800 triangles", |n| many_instances(n, 20), &[1, 100, 1000]),
];

fn main() {
    let mut criterion: Criterion = criterion();
    for (group, scene, numbers) in GROWTHS {
        for number in numbers {
            frame(&mut criterion, group, &number.to_string(), &scene(*number).expect("a scene"));
        }
    }
    criterion.final_summary();
}
