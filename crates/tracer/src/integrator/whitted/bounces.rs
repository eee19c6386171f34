//! Whitted's rules where surfaces are of any material: what is mirrored, and what is bent by clear matter, is followed in the one
//! direction that it takes.

use catoptra_core::{Rgb, Triple};

use super::Whitted;
use crate::Hit;
use crate::integrator::Search;
use crate::integrator::matter::{Bounce, Estimate, Met, Numbers, Origin, PathRay};
use crate::integrator::walker::Walker;
use crate::shade::continues;

impl Bounce for Whitted {
    fn meet<S: Search>(
        walker: &mut Walker<'_, S>,
        path: PathRay,
        hit: Option<Hit>,
        numbers: &Numbers,
    ) -> Rgb {
        let (vertex, path) = match walker.arrive(path, hit, None) {
            Met::Nothing(path) => return path.weight * walker.surroundings(&path),
            Met::Passed(on) => {
                walker.pending.push(on);
                return Rgb::BLACK;
            }
            Met::Surface(vertex, path) => (vertex, path),
        };
        let view = walker.frame.view;
        let weight = path.weight * vertex.opacity;
        let ambient = walker.frame.snapshot.ambient();
        let mut light = weight * (vertex.bsdf.emission + vertex.bsdf.ambient * ambient);
        if vertex.opacity > 0.0 {
            light += weight * walker.direct_light(&vertex, &path, numbers, Estimate::Alone);
        }
        let mut sends_on = false;
        for way in vertex.bsdf.rays() {
            sends_on = true;
            let weight = weight * way.weight;
            if continues(true, triple(weight), path.depth, view, &mut walker.stats.skipped) {
                walker.pending.push(vertex.on_along(&path, &way.into(), weight, Origin::Alone));
            }
        }
        if !sends_on {
            walker.stats.skipped.not_reflective += 1;
        }
        let through = path.weight * (1.0 - vertex.opacity);
        let skipped = &mut walker.stats.skipped;
        // What is not there at all does not count as a bounce.
        if vertex.opacity < 1.0 && continues(true, triple(through), path.depth, view, skipped) {
            walker.pending.push(PathRay { weight: through, ..vertex.straight_on(path) });
        }
        light
    }
}

fn triple(weight: Rgb) -> Triple<f64> {
    Triple::new(weight.r, weight.g, weight.b)
}
