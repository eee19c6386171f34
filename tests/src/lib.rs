//! What the whole-system tests share: the shipped scenes, films of scenes, and what a failure leaves to look at.

mod bits;
mod comparison;
mod scenes;

pub use bits::{assert_same_bits, assert_same_part};
pub use comparison::{Comparison, Rates, picture};
pub use scenes::{camera_of, is_by_chance, load, parsed, parsed_in, scene_file, shipped_scenes, triangles};

use catoptra_core::Scene;
use catoptra_tracer::{Control, Film, Pool, Size, Snapshot, View, backend_named, render};

/// The film of a scene through its first camera, every pixel sampled once at its centre; 0 threads are one per core.
///
/// # Panics
/// When the scene has no camera, there is no such backend, or there are no threads: a test ends there.
pub fn film(scene: &Scene, backend: &str, size: Size, threads: usize) -> Film {
    let view = View::of(scene, camera_of(scene), size).with_samples(1);
    traced(scene, backend, &view, Film::new(size), threads)
}

/// Traces a view into a film.
///
/// # Panics
/// When there is no such backend, there are no threads, or the film has another size than the view.
pub fn traced(scene: &Scene, backend: &str, view: &View, mut film: Film, threads: usize) -> Film {
    let backend = backend_named(backend).expect("a backend of that name");
    let pool = Pool::new(threads).expect("a pool of threads");
    let snapshot = Snapshot::extract(scene, &pool);
    render(backend, &snapshot, view, &mut film, &pool, &Control::default()).expect("nobody cancels");
    film
}
