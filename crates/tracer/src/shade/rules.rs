//! Whitted's rules, written once for a path in `f64` and for the lanes of a packet: which reflections are traced, and in
//! which direction.

use catoptra_core::optics::reflect;
use catoptra_core::{Lane, LaneMask, Triple};

use crate::lanes::{Precise, narrow3, pick3};
use crate::{Skipped, View};

/// Of lanes that send on light of a weight after `depth` reflections, those whose rays are traced; the others are counted
/// by their reason.
#[inline(always)]
pub(crate) fn continues<L: Lane>(
    lanes: L::Mask,
    weight: Triple<L>,
    depth: u32,
    view: &View,
    skipped: &mut Skipped,
) -> L::Mask {
    let largest = weight.x.max(weight.y).max(weight.z);
    let positive = lanes & largest.number(0.0).less(largest);
    skipped.not_reflective += (lanes & !positive).count();
    if depth >= view.max_depth {
        skipped.depth_limit += positive.count();
        return positive & !positive;
    }
    let faint = positive & largest.less(largest.number(f64::from(view.weight_cutoff)));
    skipped.weight_cutoff += faint.count();
    positive & !faint
}

/// From so many bounces on a path ends by chance.
const ROULETTE_FROM: u32 = 3;

/// From so many on by chance even where nothing is lost, as between white walls.
const ENDS_FROM: u32 = 64;

/// How likely a path goes on whose light would count for so much at most; what goes on counts for that much more.
#[inline(always)]
pub(crate) fn survival<L: Lane>(weight: L, depth: u32) -> L {
    match depth {
        0..ROULETTE_FROM => weight.number(1.0),
        ROULETTE_FROM..ENDS_FROM => weight.min(weight.number(1.0)),
        _ => weight.min(weight.number(0.95)),
    }
}

/// Unit normals where rays are mirrored.
pub(crate) struct MirrorNormals<P: Precise> {
    /// The surface's own, on either side.
    pub(crate) geometric: Triple<P>,
    /// The one to shade with, on either side, where any surface has another.
    pub(crate) shading: Option<Triple<P>>,
    /// The surface's own, on the viewer's side.
    pub(crate) facing: Triple<P::Narrow>,
}

/// The mirrored direction. Where a smoothed normal would send it through the surface, the surface's own normal is taken.
#[inline(always)]
pub(crate) fn mirror_direction<P: Precise>(direction: Triple<P>, normals: &MirrorNormals<P>) -> Triple<P> {
    let geometric = reflect(direction, normals.geometric);
    let Some(shading) = normals.shading else { return geometric };
    let smooth = reflect(direction, shading);
    let along = narrow3(smooth).dot(normals.facing);
    pick3(along.number(0.0).less(along), smooth, geometric)
}

#[cfg(test)]
mod tests {
    use catoptra_core::Camera;
    use catoptra_core::glam::DVec3;

    use super::*;
    use crate::Size;

    fn grey(v: f64) -> Triple<f64> {
        Triple::splat(v)
    }

    #[test]
    fn every_reason_to_stop_is_counted_and_the_first_one_counts() {
        let camera = Camera::look_at(DVec3::Z, DVec3::ZERO, DVec3::Y, 1.0).unwrap();
        let view = View { max_depth: 3, weight_cutoff: 0.01, ..View::new(camera, Size::new(1, 1)) };
        let mut skipped = Skipped::default();
        assert!(continues(true, Triple::new(0.0, 0.01, 0.0), 2, &view, &mut skipped));
        assert_eq!(skipped, Skipped::default());
        for (weight, depth) in [(0.0, 9), (f64::NAN, 9), (0.001, 3), (0.009, 2)] {
            assert!(!continues(true, grey(weight), depth, &view, &mut skipped));
        }
        assert!(!continues(false, grey(1.0), 0, &view, &mut skipped));
        let counted = Skipped { not_reflective: 2, depth_limit: 1, weight_cutoff: 1, ..Skipped::default() };
        assert_eq!(skipped, counted);
    }

    #[test]
    fn no_smooth_normal_sends_a_ray_through_its_surface() {
        let down = Triple::new(0.8, -0.6, 0.0);
        let (up, flat) = (Triple::new(0.0, 1.0, 0.0), Triple::new(0.8, 0.6, 0.0));
        let normals = |shading| MirrorNormals { geometric: up, shading, facing: up };
        let length = |v: Triple<f64>| v.dot(v).sqrt();
        assert_eq!(mirror_direction(down, &normals(None)), flat);
        let leaning = Triple::new(0.28, 0.96, 0.0);
        let mirrored = mirror_direction(down, &normals(Some(leaning)));
        assert!(mirrored != flat && mirrored.y > 0.0 && (length(mirrored) - 1.0).abs() < 1e-15);
        let too_far = Triple::new(0.8, 0.6, 0.0);
        assert!(reflect(down, too_far).y < 0.0);
        assert_eq!(mirror_direction(down, &normals(Some(too_far))), flat);
    }
}
