//! How much light do the fibres of sheen scatter in all?

use std::sync::LazyLock;

use super::axis::{Grid, Stencil, cosine_at, place_of_cosine};
use super::cap::seen_under;
use crate::lobe::quadrature::{Node, gauss_legendre};
use crate::lobe::sheen::Sheen;

/// Roughnesses and cosines in the table: with these it is off by less than 8e-4, as the tests measure.
const ROUGHNESSES: usize = 28;
const COSINES: usize = 40;

/// Roughness of the first row.
const LEAST: f64 = 0.2;

/// Cosines up to which the table is fine, as rims are.
const FINE: f64 = 0.1;

struct Table {
    scattered: Grid,
    /// The most of each row.
    most: Vec<f64>,
}

static SHEEN: LazyLock<Table> = LazyLock::new(|| {
    let nodes: [Node; 32] = gauss_legendre();
    let scattered = Grid::new(ROUGHNESSES, COSINES, |row, column| {
        computed(&nodes, LEAST + row * (1.0 - LEAST), cosine_at(column, FINE))
    });
    let cosine = |k: u32| f64::from(k * k) / 1e4;
    let most = |row: usize| {
        let row = row as f64 / (ROUGHNESSES - 1) as f64;
        (0..=100).map(|k| scattered.at(row, place_of_cosine(cosine(k), FINE))).fold(0.0, f64::max)
    };
    Table { most: (0..ROUGHNESSES).map(most).collect(), scattered }
});

/// By quadrature over cosines, finer where they are small, and half a turn, as the other half is its mirror image.
fn computed(nodes: &[Node], roughness: f64, cosine: f64) -> f64 {
    let (sheen, o) = (Sheen::by_formula(roughness * roughness), seen_under(cosine));
    let at_viewer = sheen.hidden(o.z);
    let ring = |n: &Node| {
        let cosine = n.at.powi(3);
        let i = seen_under(cosine);
        let round = |turn: &Node| {
            let cos = (std::f64::consts::PI * turn.at).cos();
            let half2 = 2.0 + 2.0 * (o.z * i.z + o.x * i.x * cos);
            turn.weight * sheen.density((o.z + i.z) / half2.sqrt())
        };
        let density: f64 = nodes.iter().map(round).sum();
        3.0 * n.at * n.at * n.weight * density / (1.0 + at_viewer + sheen.hidden(i.z))
    };
    let sum: f64 = nodes.iter().map(ring).sum();
    std::f64::consts::TAU * sum / (4.0 * o.z)
}

fn row_of(roughness: f64) -> f64 {
    (roughness - LEAST) / (1.0 - LEAST)
}

/// What sheen by formula of that roughness, 0.2..=1, scatters to a viewer under that cosine, in shares of all light.
pub(in crate::lobe) fn sheen_albedo(roughness: f64, cosine: f64) -> f64 {
    SHEEN.scattered.at(row_of(roughness), place_of_cosine(cosine, FINE)).max(0.0)
}

/// The most of [`sheen_albedo`] at any cosine: more than 1 for narrow rims.
pub(in crate::lobe) fn most_sheen(roughness: f64) -> f64 {
    Stencil::at(row_of(roughness), ROUGHNESSES).of(|row| SHEEN.most[row])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_its_values_the_table_says_what_the_integral_does() {
        let nodes: [Node; 120] = gauss_legendre();
        for roughness in [0.2, 0.22, 0.3, 0.45, 0.6, 0.8, 1.0] {
            for cosine in [0.015, 0.03, 0.1, 0.22, 0.45, 0.66, 0.9, 1.0] {
                let expected = computed(&nodes, roughness, cosine);
                let found = sheen_albedo(roughness, cosine);
                assert!((found - expected).abs() < 8e-4, "{roughness}, {cosine}: {found}, not {expected}");
                assert!(found <= most_sheen(roughness) * 1.001, "{roughness}, {cosine}: {found}");
            }
        }
    }
}
