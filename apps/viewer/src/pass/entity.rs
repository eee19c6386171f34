//! Which thing is seen where? Each has a colour of its own.

use catoptra_core::Integrator;
use catoptra_core::scene::EntityId;

use super::{NOTHING, Painted, Pass, Seen, packed};
use crate::lighting::Illumination;

pub(super) const PASS: Pass = Pass {
    name: "entity",
    doc: "Which thing is seen where, each in a colour of its own; its name stands by the pointer.",
    illumination: Illumination::Scene,
    integrator: Some(Integrator::Whitted),
    paint: Some(paint),
};

/// The share of the circle of hues from one thing to the next: the golden section, after which no two of them come near soon.
const TURN: f64 = 0.618_033_988_749_895;

fn paint(seen: &Seen<'_>) -> Option<Painted> {
    let color = |(x, y)| seen.film.surface(x, y).map_or(NOTHING, color_of);
    Some(Painted { colors: seen.pixels().map(color).collect(), numbers: None })
}

fn color_of(id: EntityId) -> u32 {
    let hue = (f64::from(id.index()) * TURN).fract() * 6.0;
    // Every third is darker, so that like hues differ still.
    let value = 0.95 - 0.2 * f64::from(id.index() % 3);
    let channel = |offset: f64| {
        let away = ((hue + offset) % 6.0 - 3.0).abs() - 1.0;
        value * (0.3 + 0.7 * away.clamp(0.0, 1.0))
    };
    packed([channel(0.0), channel(4.0), channel(2.0)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn things_that_stand_together_in_the_tree_have_colours_of_their_own() {
        let colors: std::collections::HashSet<u32> =
            (1..200).filter_map(EntityId::from_index).map(color_of).collect();
        assert_eq!(colors.len(), 199);
    }
}
