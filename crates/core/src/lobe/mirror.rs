//! The mirror lobe: from which direction does the light come that is seen reflected, and how much of it counts?

use super::ShadingPoint;
use crate::optics::reflect;
use crate::{Lane, Triple};

/// Perfect reflection: all light comes from a single direction, so there is no density to sample or to evaluate.
#[derive(Debug, Clone, Copy)]
pub struct Mirror<L: Lane> {
    /// Share of mirrored light that is seen, by channel.
    pub tint: Triple<L>,
}

/// Light that comes from a single direction.
#[derive(Debug, Clone, Copy)]
pub struct Mirrored<L: Lane> {
    /// Unit vector to where the light comes from; below the surface where a smooth normal leans too far.
    pub direction: Triple<L>,
    /// Radiance shown for each unit of radiance from there.
    pub weight: Triple<L>,
}

impl<L: Lane> Mirror<L> {
    /// The one direction, and how much of what it brings counts.
    #[inline(always)]
    #[must_use]
    pub fn scatter(&self, at: &ShadingPoint<L>) -> Mirrored<L> {
        let to_viewer = at.to_viewer;
        let from_viewer = Triple::new(-to_viewer.x, -to_viewer.y, -to_viewer.z);
        Mirrored { direction: reflect(from_viewer, at.normal), weight: self.tint }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::scatter_checks::seen;
    use super::*;

    #[test]
    fn the_normal_halves_the_way_between_viewer_and_light() {
        let mirror = Mirror { tint: Triple::new(1.0, 0.5, 0.0) };
        for normal in [DVec3::Y, DVec3::new(-2.0, 1.0, -2.0) / 3.0] {
            for degrees in [0.0, 30.0, 89.0] {
                let at = seen(normal, degrees);
                let Mirrored { direction, weight } = mirror.scatter(&at);
                let half = DVec3::from(direction + at.to_viewer);
                assert!(half.normalize().distance(normal) < 1e-14, "{degrees}");
                assert!((DVec3::from(direction).length() - 1.0).abs() < 1e-15);
                assert_eq!(weight, mirror.tint);
            }
        }
    }

    #[test]
    fn light_runs_both_ways_alike() {
        let mirror = Mirror { tint: Triple::splat(0.5) };
        let at = seen(DVec3::Y, 40.0);
        let there = mirror.scatter(&at).direction;
        let back = mirror.scatter(&ShadingPoint { to_viewer: there, ..at }).direction;
        assert!(DVec3::from(back).distance(at.to_viewer.into()) < 1e-15);
    }
}
