//! How many directions does it take to know how much of the sky a surface sees?

use catoptra_core::Integrator;
use catoptra_core::glam::DVec3;
use catoptra_tracer::{Pattern, Size, View};
use miette::Result;

use super::averages::{Floor, question, way};
use super::{Lab, Question, Way};
use crate::words::counted;

const SIZE: Size = Size::new(40, 30);

/// A floor beside a wall that runs on and on, seen from straight above.
const WALL: &str = r#"
camera "eye" { eye 1.3 3 0; direction 0 -1 0; up 0 0 -1; fov 30 }
matte "grey" { color 0.5 }
plane "floor" material="grey"
rectangle "wall" material="grey" { corner 0 0 -1e6; edge-u 0 1 0; edge-v 0 0 2e6 }
"#;

/// A floor under a ball, seen from straight above, from between both.
const BALL: &str = r#"
camera "eye" { eye 0.2 1.5 0.1; direction 0 -1 0; up 0 0 -1; fov 60 }
matte "grey" { color 0.5 }
plane "floor" material="grey"
sphere "ball" material="grey" { center 0 3 0; radius 1 }
"#;

/// Metres up to the middle of the ball.
const MIDDLE: f64 = 3.0;

const GRIDS: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];

/// A name, a scene, and the mean share of the sky over a rectangle of its floor between two corners.
type Place = (&'static str, &'static str, fn(DVec3, DVec3) -> f64);

const PLACES: [Place; 2] = [("beside a wall", WALL, beside_wall), ("under a ball", BALL, under_ball)];

pub(super) fn ask(lab: &Lab) -> Result<Vec<Question>> {
    let mut ways: Vec<Way> = Vec::new();
    for (name, text, mean) in PLACES {
        for grid in GRIDS {
            let view = |view| View {
                integrator: Integrator::Occlusion,
                size: SIZE,
                pattern: Pattern::Sobol,
                samples: grid * grid,
                ..view
            };
            let right = |floor: &Floor<'_>| mean(floor(0.0, 0.0), floor(1.0, 1.0));
            let setting = counted(u64::from(grid * grid), "sample");
            ways.push(way(lab, text, view, right, (name, setting))?);
        }
    }
    let words = format!(
        "The share of the sky that a floor sees, one direction a sample by `--integrator occlusion` (Owen-scrambled Sobol numbers), against its \
         closed form, averaged over each pixel: beside a wall of 1 m, and under a ball of 1 m whose middle stands {MIDDLE} m up. \
         {}x{} pixels by `wide`.",
        SIZE.width, SIZE.height
    );
    Ok(vec![question("occlusion", "Ambient occlusion", words, ways)])
}

/// The mean of (1 + x / √(x² + 1)) / 2.
fn beside_wall(a: DVec3, b: DVec3) -> f64 {
    f64::midpoint(1.0, (b.x.hypot(1.0) - a.x.hypot(1.0)) / (b.x - a.x))
}

/// The mean of 1 − h / d³, d how far the ball's middle is: an integral of h / d³ is the solid angle of the rectangle.
fn under_ball(a: DVec3, b: DVec3) -> f64 {
    let corner = |x: f64, z: f64| (x * z / (MIDDLE * (x * x + z * z + MIDDLE * MIDDLE).sqrt())).atan();
    let angle = corner(b.x, b.z) - corner(a.x, b.z) - corner(b.x, a.z) + corner(a.x, a.z);
    1.0 - angle / ((b.x - a.x) * (b.z - a.z))
}
