//! How near do sums over lamps and samples come to the integrals that they stand for?

use std::fmt::Write;

use catoptra_core::glam::DVec3;
use catoptra_core::numeric::PATTERN_SHIFT;
use catoptra_lab::{Pair, Picture, metric_named};
use catoptra_tracer::{Edges, Pattern, Size, Snapshot, View};
use miette::{IntoDiagnostic, Result, miette};

use super::{EXACT, Lab, Question, Way, parsed};
use crate::words::counted;

const SIZE: Size = Size::new(200, 150);

/// Metres from the floor up to the edge that throws the shadow.
const EDGE: f64 = 4.0;

/// Half the angle that the wide sun fills, radians.
const SUN: f64 = 0.12;

/// What the whole sun gives a floor that it stands above, W/m².
const IRRADIANCE: f64 = 3.0;

const SUNS: [u32; 6] = [1, 4, 16, 64, 256, 1024];

/// A roof over x < 0, and a floor that looks grey under it.
const ROOF: &str = r#"
camera "eye" { eye 0 3 0.4; target 0 0 0; fov 40 }
matte "white" { color 1 1 1 }
plane "floor" material="white"
rectangle "roof" material="white" { corner 0 4 -50; edge-u -50 0 0; edge-v 0 0 100 }
"#;

/// Squares that lie aslant to no pixel and end on none, seen from straight above.
const TILES: &str = r#"
camera "eye" { eye 0.37 3 0.21; direction 0 -1 0; up 0 0 -1; fov 60 }
checker "tiles" { scale 8.3 }
plane "floor" material="tiles"
ambient-light "sky" { radiance 1 1 1 }
"#;

/// Squares a metre of [`TILES`].
const TILES_SCALE: f64 = 8.3;

const GRIDS: [u32; 7] = [1, 2, 3, 4, 6, 8, 16];

pub(super) fn ask(lab: &Lab) -> Result<Vec<Question>> {
    Ok(vec![penumbra(lab)?, footprint(lab)?])
}

/// The shadow of a straight edge under a sun of some width.
fn penumbra(lab: &Lab) -> Result<Question> {
    let mut ways = Vec::new();
    for suns in SUNS {
        let mut text = ROOF.to_owned();
        for sun in 0..suns {
            let angle = SUN * (2.0 * (f64::from(sun) + 0.5) / f64::from(suns) - 1.0);
            let (share, [x, y]) = (IRRADIANCE / f64::from(suns), [-angle.sin(), -angle.cos()]);
            let _ = writeln!(
                text,
                "directional-light \"{sun}\" {{ direction {x:e} {y:e} 0; irradiance {share:e} }}"
            );
        }
        let right = |floor: &Floor<'_>| sunlit(floor(0.5, 0.5).x);
        ways.push(way(lab, &text, |view| view, right, ("suns in a row", counted(u64::from(suns), "sun")))?);
    }
    let words = format!(
        "A sun that fills {:.1} degrees from side to side, stood in by a row of directional lights, over a roof whose edge is {EDGE} m above \
         a floor: the half-shadow's radiance has the closed form E (sin α − sin φ) / 2απ, where φ is the angle under which the edge hides \
         the rest. Suns in a row give it in as many steps. {}x{} pixels by `wide`.",
        2.0 * SUN.to_degrees(),
        SIZE.width,
        SIZE.height
    );
    Ok(question("penumbra", "Half-shadow of an edge", words, ways))
}

/// The radiance of a white floor at `x` from the edge, under the part of the sun that it sees.
fn sunlit(x: f64) -> f64 {
    let hidden = (-x / EDGE).atan().clamp(-SUN, SUN);
    IRRADIANCE / (2.0 * SUN) * (SUN.sin() - hidden.sin()) / std::f64::consts::PI
}

/// What share of each pixel white squares cover.
fn footprint(lab: &Lab) -> Result<Question> {
    let mut ways = Vec::new();
    for &pattern in Pattern::ALL {
        for grid in GRIDS {
            let view = |view| View { pattern, samples: grid * grid, ..view };
            let setting = counted(u64::from(grid * grid), "sample");
            ways.push(way(lab, TILES, view, white_share, (pattern.name(), setting))?);
        }
    }
    let view = |view| View { edges: Edges::Exact, ..view };
    ways.push(way(lab, TILES, view, white_share, (EXACT, counted(1, "sample")))?);
    let words = format!(
        "Checkered ground seen from straight above, {TILES_SCALE} squares a metre, so that a pixel's footprint is a rectangle and the share of it \
         that white squares cover is a product of two integrals of a square wave. {}x{} pixels by `wide`.",
        SIZE.width, SIZE.height
    );
    Ok(question("footprint", "Checker footprints", words, ways))
}

/// What share of a pixel white squares cover.
fn white_share(floor: &Floor<'_>) -> f64 {
    let [a, b] = [floor(0.0, 0.0), floor(1.0, 1.0)];
    (1.0 - mean_sign(a.x, b.x) * mean_sign(a.z, b.z)) / 2.0
}

/// The mean of (−1)^⌊c⌋ over the cells c from one place to another.
fn mean_sign(from: f64, to: f64) -> f64 {
    let [from, to] = [from, to].map(|place| place * TILES_SCALE + PATTERN_SHIFT);
    // The integral from 0 to c is a wave of triangles.
    let integral = |c: f64| {
        let phase = c.rem_euclid(2.0);
        phase.min(2.0 - phase)
    };
    (integral(to) - integral(from)) / (to - from)
}

pub(super) fn question(name: &'static str, title: &'static str, words: String, ways: Vec<Way>) -> Question {
    Question { name, title, words, time: "ms a frame", errors: &["RMSE", "largest difference"], ways }
}

/// Where on the floor the ray through a place within a pixel ends, by the place's distance from the upper left corner.
pub(super) type Floor<'a> = dyn Fn(f64, f64) -> DVec3 + 'a;

/// Renders a scene and holds it against what is right for each pixel's part of the floor.
pub(super) fn way(
    lab: &Lab,
    text: &str,
    view: impl Fn(View) -> View,
    right: impl Fn(&Floor<'_>) -> f64,
    (series, setting): (&str, String),
) -> Result<Way> {
    let scene = parsed(text)?;
    let camera = scene.main_camera().and_then(|id| scene.world_camera(id));
    let camera = camera.ok_or_else(|| miette!("a scene of the lab has no camera"))?;
    let view = view(View::of(&scene, camera.clone(), SIZE));
    let (picture, time) = lab.picture(&Snapshot::extract(&scene, &lab.pool), &view)?;
    let size = view.size;
    let reference = Picture::painted(size.width, size.height, |x, y| {
        let floor = |across: f64, down: f64| {
            let ray = camera.ray(f64::from(x) + across, f64::from(y) + down, size.width, size.height);
            ray.at(-ray.origin.y / ray.direction.y)
        };
        [right(&floor) as f32; 3]
    });
    let reference = reference.into_diagnostic()?;
    let pair = Pair::new(&reference, &picture).into_diagnostic()?;
    let measures = ["rmse", "max-difference"].into_iter().filter_map(metric_named);
    let errors = measures.map(|metric| (metric.measure)(pair, &Default::default())).collect();
    Ok(Way { series: series.to_owned(), setting, time, errors })
}
