//! How does a frame's time grow with lights, spheres, triangles, instances, pixels and threads? Writes a picture of each.
//!
//! ```sh
//! cargo run --release -p catoptra-benches --bin scaling -- benches
//! ```

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use catoptra_benches::{camera, scene};
use catoptra_core::Scene;
use catoptra_lab::scenes::{NoScene, Reach, many_instances, many_lights, many_spheres, placed_mesh};
use catoptra_lab::{Clock, Plot, fastest};
use catoptra_tracer::{Control, Film, Pool, Size, Snapshot, View, backend_named, render};

/// Size of the frames, unless the size is what grows.
const SIZE: Size = Size::new(450, 450);

/// A frame is traced again for this long, and the fastest counts.
const LONG_ENOUGH: Duration = Duration::from_millis(150);

type Failure = Box<dyn std::error::Error>;

/// A line of a picture: its name, and time by number.
type Line = (String, Vec<(f64, f64)>);

fn main() -> Result<(), Failure> {
    let folder = std::env::args().nth(1).map_or_else(|| PathBuf::from("benches"), PathBuf::from);
    let alone = Pool::new(1)?;
    let lights = powers(2, 11);
    write(
        &folder,
        "scaling-lights",
        "lights",
        &[
            growing(&alone, "lights everywhere", &lights, |n| many_lights(n, Reach::Everywhere))?,
            growing(&alone, "lights nearby", &lights, |n| many_lights(n, Reach::Nearby))?,
        ],
    )?;
    write(
        &folder,
        "scaling-spheres",
        "spheres",
        &[growing(&alone, "spheres", &powers(10, 7), many_spheres)?],
    )?;
    let (name, rings) = ("triangles of two meshes", [4, 16, 64, 256, 512]);
    let (_, times) = growing(&alone, name, &rings, placed_mesh)?;
    let triangles = times.into_iter().map(|(rings, time)| (4.0 * rings * rings, time)).collect();
    write(&folder, "scaling-triangles", "triangles", &[(name.to_owned(), triangles)])?;
    let instances =
        growing(&alone, "instances of 5000 triangles", &powers(10, 4), |n| many_instances(n, 50))?;
    write(&folder, "scaling-instances", "instances", &[instances])?;
    write(&folder, "scaling-pixels", "pixels", &[pixels(&alone, "point")?, pixels(&alone, "material")?])?;
    write(&folder, "scaling-threads", "threads", &[threads("point")?, threads("many")?])
}

fn powers(base: u32, count: u32) -> Vec<u32> {
    (0..count).map(|power| base.pow(power)).collect()
}

fn write(folder: &Path, name: &str, what: &str, lines: &[Line]) -> Result<(), Failure> {
    for (line, points) in lines {
        for (number, milliseconds) in points {
            println!("{line:32} {number:>12} {milliseconds:>12.3} ms a frame");
        }
    }
    let title = format!("Frame time against {what}");
    let plot = Plot { title: &title, x: what, y: "ms a frame", lines };
    catoptra_scene::atomic::write(&folder.join(format!("{name}.svg")), |out| {
        out.write_all(plot.svg().map_err(std::io::Error::other)?.as_bytes())
    })?;
    Ok(())
}

/// The time of a frame for each number of things in a scene.
fn growing(
    pool: &Pool,
    name: &str,
    numbers: &[u32],
    scene: impl Fn(u32) -> Result<Scene, NoScene>,
) -> Result<Line, Failure> {
    let mut points = Vec::new();
    for &number in numbers {
        points.push((f64::from(number), milliseconds(&scene(number)?, SIZE, pool, Clock::Processor)?));
    }
    Ok((name.to_owned(), points))
}

fn pixels(pool: &Pool, name: &str) -> Result<Line, Failure> {
    let scene = scene(&format!("seed/{name}.kdl"));
    let mut points = Vec::new();
    for edge in [32, 64, 128, 256, 512, 1024, 2048] {
        let size = Size::new(edge, edge);
        points.push((size.pixels() as f64, milliseconds(&scene, size, pool, Clock::Processor)?));
    }
    Ok((name.to_owned(), points))
}

fn threads(name: &str) -> Result<Line, Failure> {
    let scene = scene(&format!("seed/{name}.kdl"));
    let cores = std::thread::available_parallelism()?.get();
    let mut points = Vec::new();
    for threads in (0..).map(|power| 1 << power).take_while(|threads| *threads <= cores) {
        points.push((
            threads as f64,
            milliseconds(&scene, Size::new(1920, 1080), &Pool::new(threads)?, Clock::Wall)?,
        ));
    }
    Ok((name.to_owned(), points))
}

/// Of the fastest frame.
fn milliseconds(scene: &Scene, size: Size, pool: &Pool, clock: Clock) -> Result<f64, Failure> {
    let backend = backend_named("wide").ok_or("there is no backend wide")?;
    let (snapshot, view) = (Snapshot::extract(scene, pool), View::of(scene, camera(scene), size));
    let mut film = Film::new(size);
    let (done, least) = fastest(clock, 3, LONG_ENOUGH, || {
        render(backend, &snapshot, &view, &mut film, pool, &Control::default())
    });
    done?;
    Ok(least.as_secs_f64() * 1e3)
}
