//! Paths by chance: all light, without any error but noise.
//!
//! At every point a direction is chosen by its lobes and followed; direct light is gathered beside it: that of lamps at lobes
//! that scatter alike in all directions in closed form, where there is one, other light by rays that are weighed against those
//! chosen. Kajiya, "The rendering equation", SIGGRAPH 1986; Veach, "Robust Monte Carlo methods for light transport simulation",
//! 1997, chapters 9 and 10. Ambient light, which stands in for what is computed here, is left out.

use catoptra_core::{Material, Rgb};

use super::matter::{self, Bounce, Estimate, Met, Numbers, Origin, PathRay};
use super::walker::{CameraRay, Walker};
use super::{Integrate, Search, whitted};
use crate::sampler::{pairs, share};
use crate::shade::{Gathers, survival};
use crate::{Frame, Hit, Stats, Tile};

/// See the file's head.
pub(super) struct Path;

impl Integrate for Path {
    fn gather<S: Search>(walker: &mut Walker<'_, S>, camera: &CameraRay) -> (Rgb, Option<Hit>) {
        walker.follow_paths::<Self>(camera)
    }

    fn trace_tile(frame: &Frame<'_>, tile: &mut Tile) -> Stats {
        match Gathers::paths(frame.snapshot) {
            Some(gathers) => whitted::trace_lanes(frame, tile, gathers),
            None => matter::trace_tile::<Self>(frame, tile),
        }
    }
}

impl Bounce for Path {
    fn meet<S: Search>(
        walker: &mut Walker<'_, S>,
        path: PathRay,
        hit: Option<Hit>,
        numbers: &Numbers,
    ) -> Rgb {
        let pair =
            |choice: u32| numbers.sampler.pair(numbers.sample, pairs::bounce(path.depth, choice)).map(share);
        let ([choose, survive], u, texel) = (pair(0), pair(1), pair(2));
        let passage = pairs::passage(path.depth, path.passed);
        let [through, _] = numbers.sampler.pair(numbers.sample, passage).map(share);
        let (vertex, path) = match walker.arrive(path, hit, Some(texel)) {
            Met::Nothing(path) => return path.weight * walker.surroundings(&path),
            Met::Passed(on) => {
                walker.pending.push(on);
                return Rgb::BLACK;
            }
            Met::Surface(vertex, path) => (vertex, path),
        };
        if through >= vertex.opacity {
            walker.pending.push(vertex.straight_on(path));
            return Rgb::BLACK;
        }
        let shows_itself =
            path.origin == Origin::Alone || !matches!(vertex.surface.material, Material::Depth(_));
        let emission = if shows_itself { vertex.bsdf.emission } else { Rgb::BLACK };
        let mut light = if emission.max_channel() > 0.0 {
            walker.share_of_emission(&vertex, &path) * emission
        } else {
            Rgb::BLACK
        };
        light += path.weight * walker.direct_light(&vertex, &path, numbers, Estimate::WithPaths);
        let depth = path.depth;
        if depth >= walker.frame.view.path_depth {
            walker.stats.skipped.depth_limit += 1;
            return light;
        }
        let Some(found) = vertex.bsdf.sample(choose, u) else { return light };
        let weight = path.weight * found.weight;
        let stays = survival(weight.max_channel(), depth);
        if !(survive < stays) {
            return light;
        }
        let origin = match (found.is_delta, found.is_transmitted) {
            (true, _) => Origin::Alone,
            (false, false) => Origin::Reflected(found.pdf),
            (false, true) => Origin::Transmitted(found.pdf),
        };
        let mut next = vertex.on_along(&path, &found.into(), weight * (1.0 / stays), origin);
        if !found.is_delta {
            next.glossy = path.weight * vertex.bsdf.glossy(found.direction) * (1.0 / (found.pdf * stays));
        }
        walker.pending.push(next);
        light
    }
}
