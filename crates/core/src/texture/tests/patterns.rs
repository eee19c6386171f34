//! Are patterns on average over a pixel what many points of it are?

use glam::{DVec2, DVec3};

use super::{random, texture, word};
use crate::texture::{Texture, TexturePoint, fractal};
use crate::{Rgb, Value, Values};

/// A place over which a pixel shows a parallelogram.
fn over(uv: DVec2, footprint: [DVec2; 2]) -> TexturePoint {
    TexturePoint { uv, footprint: Some(footprint), ..TexturePoint::default() }
}

/// The mean of the red of a texture over the parallelogram, by `steps`² points of it.
fn counted(texture: &Texture, at: &TexturePoint, steps: u32) -> f64 {
    let [a, b] = at.footprint.unwrap();
    let share = |i: u32| (f64::from(i) + 0.5) / f64::from(steps) - 0.5;
    let cells = (0..steps).flat_map(|i| (0..steps).map(move |j| (share(i), share(j))));
    let sum: f64 = cells.map(|(x, y)| texture.color(&TexturePoint::at_uv(at.uv + a * x + b * y)).r).sum();
    sum / f64::from(steps * steps)
}

/// Root of the mean squared difference from many points, of a floor seen to the horizon at one sample a pixel: 120 rows of
/// 9 pixels, from 1 m above it.
fn error_to_the_horizon(texture: &Texture) -> f64 {
    let hit = |x: f64, y: f64| {
        let direction = DVec3::new(x / 120.0, -(y + 1e-9) / 120.0, -1.0);
        let point = direction / -direction.y;
        // A camera that looks a little aside, so that no line of the pattern is a line of the picture.
        DVec2::from_angle(0.3).rotate(DVec2::new(point.x, -point.z))
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for (row, column) in (0..120_u32).flat_map(|row| (0..9_u32).map(move |column| (row, column))) {
        let (x, y) = (f64::from(column) * 13.0 - 52.0, f64::from(row) + 0.5);
        // By derivatives, as a tracer has them.
        let side =
            |dx: f64, dy: f64| (hit(x + 1e-4 * dx, y + 1e-4 * dy) - hit(x - 1e-4 * dx, y - 1e-4 * dy)) / 2e-4;
        let shown = texture.color(&over(hit(x, y), [side(1.0, 0.0), side(0.0, 1.0)])).r;
        let steps = 64;
        let share = |i: u32| (f64::from(i) + 0.5) / f64::from(steps) - 0.5;
        let cells = (0..steps).flat_map(|i| (0..steps).map(move |j| (share(i), share(j))));
        let right: f64 = cells.map(|(i, j)| texture.color(&TexturePoint::at_uv(hit(x + i, y + j))).r).sum();
        sum += (shown - right / f64::from(steps * steps)).powi(2);
        count += 1.0;
    }
    f64::sqrt(sum / count)
}

#[test]
fn a_checkered_floor_is_right_to_the_horizon() {
    for scale in [0.5, 2.0] {
        let scale = Value::Pair(DVec2::splat(scale));
        let error = error_to_the_horizon(&texture("checker-texture", &Values::new().with("scale", scale)));
        assert!(error < 1e-2, "{error}");
    }
}

#[test]
fn bricks_are_right_to_the_horizon() {
    let values =
        Values::new().with("color", Value::Color(Rgb::BLACK)).with("mortar", Value::Color(Rgb::WHITE));
    let error =
        error_to_the_horizon(&texture("brick-texture", &values.with("mortar-width", Value::Number(0.03))));
    assert!(error < 1.5e-2, "{error}");
}

#[test]
fn means_over_parallelograms_are_those_of_many_points() {
    let mut state = 88_172_645_463_325_252;
    let brick =
        Values::new().with("color", Value::Color(Rgb::WHITE)).with("mortar", Value::Color(Rgb::BLACK));
    let wide = [("size", DVec2::new(0.9, 0.4))].map(|(name, v)| (name, Value::Pair(v)));
    let brick = wide.into_iter().fold(brick, |values, (name, v)| values.with(name, v));
    let brick = texture("brick-texture", &brick.with("mortar-width", Value::Number(0.1)));
    let checker = texture("checker-texture", &Values::new());
    for size in [0.05, 0.3, 1.5] {
        let mut squares = 0.0;
        for _ in 0..60 {
            let mut vector = || DVec2::new(random(&mut state) - 0.5, random(&mut state) - 0.5) * size;
            let (a, b) = (vector(), vector());
            let at = over(vector() * 9.0, [a, b]);
            let off = |texture: &Texture| (texture.color(&at).r - counted(texture, &at, 200)).abs();
            assert!(off(&checker) < 8e-3, "checker {size}: {at:?}");
            squares += off(&brick).powi(2) / 60.0;
            let level = over(at.uv, [DVec2::X * a.x, DVec2::Y * b.y]);
            let off = (brick.color(&level).r - counted(&brick, &level, 200)).abs();
            assert!(off < 1e-2, "level bricks {off} at {size}: {level:?}");
        }
        // Boxes round pieces of a slanted parallelogram blur a little more than it.
        assert!(squares.sqrt() < 0.05, "bricks {} at {size}", squares.sqrt());
    }
}

#[test]
fn noise_fades_to_its_mean_and_not_before() {
    let noise = texture("noise-texture", &Values::new().with("mapping", word("uv")));
    let marble = texture(
        "marble-texture",
        &Values::new().with("mapping", word("uv")).with("turbulence", Value::Number(0.0)),
    );
    let mut state = 1_234_567;
    let (mut sums, mut differences) = ([0.0; 3], 0.0);
    for _ in 0..400 {
        let uv = DVec2::new(random(&mut state), random(&mut state)) * 100.0;
        let show = |width: f64| noise.color(&over(uv, [DVec2::X * width, DVec2::Y * width])).r;
        let point = noise.color(&TexturePoint::at_uv(uv)).r;
        assert!((show(0.02) - point).abs() < 0.01, "{} {point}", show(0.02));
        assert_eq!(show(1.5), 0.5);
        assert!((0.0..=1.0).contains(&point));
        for (sum, v) in sums.iter_mut().zip([point, show(0.1), show(0.5)]) {
            *sum += (v - 0.5).powi(2) / 400.0;
        }
        // Between, it comes nearer to the mean over the pixel than the point is.
        let at = over(uv, [DVec2::X * 0.4, DVec2::Y * 0.4]);
        let right = counted(&noise, &at, 12);
        differences += ((show(0.4) - right).powi(2) - (point - right).powi(2)) / 400.0;
        let wide = over(uv, [DVec2::X * 0.7, DVec2::Y * 0.1]);
        assert!((marble.color(&wide).r - counted(&marble, &wide, 100)).abs() < 1e-3);
    }
    assert!(sums[0] > sums[1] && sums[1] > sums[2] && sums[2] > 0.0 && sums[0] > 0.01, "{sums:?}");
    assert!(differences < 0.0, "{differences}");
}

#[test]
fn the_mean_magnitude_of_noise_is_what_it_is_taken_for() {
    let mut state = 3_141_592_653;
    let count = 200_000;
    let mut place = || DVec3::new(random(&mut state), random(&mut state), random(&mut state)) * 64.0;
    let mean: f64 = (0..count).map(|_| fractal::noise(place()).abs()).sum::<f64>() / f64::from(count);
    assert!((mean - fractal::MEAN_MAGNITUDE).abs() < 2e-3, "{mean}");
}
