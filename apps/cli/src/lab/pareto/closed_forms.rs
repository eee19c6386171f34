//! How near do lit surfaces come to the formulas of their light?

use std::f64::consts::PI;

use catoptra_core::glam::DVec3;
use catoptra_lab::ulps_f32;
use catoptra_tracer::{Control, Film, Size, Snapshot, View, render};
use miette::{IntoDiagnostic, Result, miette};

use super::{Lab, Question, Way, parsed};
use crate::names::find_backend;

const SIZE: Size = Size::new(200, 150);

/// A grey floor, seen aslant.
const FLOOR: &str = r#"
camera "eye" { eye 0.3 3 4; target 0 0 0 }
matte "grey" { color 0.5 0.5 0.5 }
plane "floor" material="grey"
"#;

/// Where the lamps stand, and what they send out.
const LAMP: DVec3 = DVec3::new(0.7, 2.3, -0.4);
const INTENSITY: f64 = 11.0;

/// Full angles of the spot's cones, degrees; everything that is seen lies within the outer one.
const CONES: [f64; 2] = [30.0, 170.0];

/// A light: its name, its text, and the irradiance that it gives a point of the floor.
type Lamp = (&'static str, String, fn(DVec3) -> f64);

fn lamps() -> [Lamp; 4] {
    let at = format!("position {} {} {}", LAMP.x, LAMP.y, LAMP.z);
    let [inner, outer] = CONES;
    [
        ("ambient", "ambient-light \"l\" { radiance 0.7 }".to_owned(), |_| 0.7 * PI),
        ("directional", "directional-light \"l\" { direction -1 -2 0.5; irradiance 3 }".to_owned(), |_| {
            3.0 * DVec3::new(1.0, 2.0, -0.5).normalize().y
        }),
        ("point", format!("point-light \"l\" {{ {at}; intensity {INTENSITY} }}"), point),
        (
            "spot",
            format!(
                "spot-light \"l\" {{ {at}; direction 0 -1 0; intensity {INTENSITY}; inner {inner}; outer {outer} }}"
            ),
            |at| {
                let cosine = (LAMP - at).normalize().y;
                let [inner, outer] = CONES.map(|full| (full / 2.0).to_radians().cos());
                point(at) * ((cosine - outer) / (inner - outer)).clamp(0.0, 1.0)
            },
        ),
    ]
}

/// I cos θ / d².
fn point(at: DVec3) -> f64 {
    let way = LAMP - at;
    INTENSITY * way.y / way.length().powi(3)
}

pub(super) fn ask(lab: &Lab) -> Result<Vec<Question>> {
    let mut ways = Vec::new();
    for backend in ["wide", "scalar"] {
        for lamp in lamps() {
            ways.push(way(lab, backend, &lamp)?);
        }
    }
    let words = "A floor under one light, each pixel held against the light's formula, evaluated in f64 where the pixel's ray meets the \
                 floor. An ulp is the step between one f32 and the next: the film itself holds f32, so half a step is its best. `wide` \
                 shades in f32, `scalar` in f64; which surface is seen and what is in shadow both know for certain."
        .to_owned();
    let errors = &["mean error, ulp", "largest error, ulp"];
    let time = "ns a pixel";
    Ok(vec![Question {
        name: "closed-forms",
        title: "Light against its formulas",
        words,
        time,
        errors,
        ways,
    }])
}

fn way(lab: &Lab, backend: &str, (name, text, irradiance): &Lamp) -> Result<Way> {
    let scene = parsed(&format!("{FLOOR}{text}"))?;
    let camera = scene.main_camera().and_then(|id| scene.world_camera(id));
    let camera = camera.ok_or_else(|| miette!("a scene of the lab has no camera"))?;
    let (snapshot, view) = (Snapshot::extract(&scene, &lab.pool), View::of(&scene, camera.clone(), SIZE));
    let (backend, mut film) = (find_backend(backend)?, Film::new(SIZE));
    let (done, milliseconds) =
        lab.fastest(|| render(backend, &snapshot, &view, &mut film, &lab.pool, &Control::default()));
    done.into_diagnostic()?;
    let (mut sum, mut most, mut pixels) = (0_u64, 0_u32, 0_u64);
    for (x, y) in (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y))) {
        let ray = camera.ray(f64::from(x) + 0.5, f64::from(y) + 0.5, SIZE.width, SIZE.height);
        let t = -ray.origin.y / ray.direction.y;
        if !(t > 0.0) {
            continue;
        }
        let right = 0.5 / PI * irradiance(ray.at(t));
        let ulps = ulps_f32(film.radiance(x, y)[0], right as f32).unwrap_or(u32::MAX);
        (sum, most, pixels) = (sum + u64::from(ulps), most.max(ulps), pixels + 1);
    }
    let errors = vec![sum as f64 / pixels as f64, f64::from(most)];
    let time = milliseconds * 1e6 / SIZE.pixels() as f64;
    Ok(Way { series: backend.name().to_owned(), setting: (*name).to_owned(), time, errors })
}
