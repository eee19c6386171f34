//! What is a quantity on average over the facets of a rough surface that are seen?

use std::sync::LazyLock;

use glam::DVec3;

use super::super::ggx::Ggx;
use super::super::quadrature::{Node, gauss_legendre};
use crate::numeric::LEAST_COSINE;

/// Nodes round the normal (half a turn, as the other half is its mirror image) and along it.
static NODES: LazyLock<[Vec<Node>; 2]> = LazyLock::new(|| [gauss_legendre(14), gauss_legendre(22)]);

/// Where a surface is seen from, under that cosine.
pub(super) fn seen_under(cosine: f64) -> DVec3 {
    let cosine = cosine.max(LEAST_COSINE);
    DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine)
}

/// The mean of `value` over the facet normals that are visible from `o`, which lies over the x axis.
pub(super) fn mean_over_visible(ggx: &Ggx, o: DVec3, value: impl Fn(DVec3) -> f64) -> f64 {
    let [round, along] = &*NODES;
    let at = |turn: &Node, along: &Node| {
        turn.weight * along.weight * value(ggx.visible_normal(o, [0.5 * turn.at, along.at]))
    };
    round.iter().map(|turn| along.iter().map(|along| at(turn, along)).sum::<f64>()).sum()
}

/// ∫ 2µ `value`(µ) dµ over cosines µ from 0 to 1, for what changes most where they are small.
pub(super) fn mean_over_cosines(value: impl Fn(f64) -> f64) -> f64 {
    static NODES: LazyLock<Vec<Node>> = LazyLock::new(|| gauss_legendre(40));
    // By the cube root: µ = t³.
    NODES.iter().map(|n| 6.0 * n.at.powi(5) * n.weight * value(n.at.powi(3))).sum()
}
