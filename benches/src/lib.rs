//! What the benches share: scenes, a generated mesh, and how long is measured.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use catoptra_core::{Camera, Scene, TriangleMesh};
use criterion::Criterion;

/// Short times, so that all benches together take a minute or two; options on the command line lengthen them.
pub fn criterion() -> Criterion {
    Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
        .sample_size(20)
        .configure_from_args()
}

/// Where a shipped scene lies, by its path below `scenes/`.
pub fn scene_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes").join(name)
}

/// A shipped scene.
///
/// # Panics
/// When it cannot be read.
pub fn scene(name: &str) -> Scene {
    match catoptra_scene::load(&scene_file(name)) {
        Ok((scene, _)) => scene,
        Err(error) => panic!("{name}: {error:?}"),
    }
}

/// The first camera of a scene, in the world.
///
/// # Panics
/// When there is none.
pub fn camera(scene: &Scene) -> Camera {
    let id = scene.main_camera().expect("a scene with a camera");
    scene.world_camera(id).expect("a camera that can be placed")
}

/// A ball with waves on it, of `2 * rings * rings` triangles or a little fewer, some thin and some nearly even.
///
/// # Panics
/// Never: the positions are finite and the indices in range.
pub fn wavy_ball(rings: u32) -> Arc<TriangleMesh> {
    let (rows, columns) = (rings, rings);
    let at = |row: u32, column: u32| {
        let (polar, around) = (
            f64::from(row) / f64::from(rows) * std::f64::consts::PI,
            f64::from(column) / f64::from(columns) * std::f64::consts::TAU,
        );
        let radius = 1.0 + 0.1 * (9.0 * polar).sin() * (7.0 * around).cos();
        [polar.sin() * around.cos(), polar.cos(), polar.sin() * around.sin()].map(|v| (radius * v) as f32)
    };
    let places = (0..=rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let positions = places.map(|(row, column)| at(row, column)).collect();
    let index = |row: u32, column: u32| row * columns + column % columns;
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let triangles = cells.flat_map(|(row, column)| {
        let corners =
            [index(row, column), index(row, column + 1), index(row + 1, column + 1), index(row + 1, column)];
        [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]
    });
    Arc::new(TriangleMesh::new(positions, triangles.collect(), None, None).expect("a mesh"))
}

#[cfg(test)]
mod tests {
    use super::wavy_ball;

    #[test]
    fn the_ball_is_round_and_as_fine_as_asked() {
        let ball = wavy_ball(50);
        assert_eq!(ball.triangles().len(), 5000);
        assert!((ball.bounds().size().length() - 2.0 * 3.0_f64.sqrt()).abs() < 0.6);
    }
}
