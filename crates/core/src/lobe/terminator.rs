//! How is the edge of light softened on meshes of few triangles that are lit as if they were smooth?

use crate::{Lane, Triple};

/// The share of light from a direction that counts where the shading normal stands in for the geometric one: 1 where that faces
/// the light as much as the shading normal says or more, and smoothly down to 0 where it turns away. Without it light stops at
/// the edges of triangles, in steps. All vectors are unit vectors, both normals on the side of the light.
///
/// Chiang, Li and Burley, "Taming the shadow terminator", SIGGRAPH 2019 talks.
#[inline(always)]
#[must_use]
pub fn soft_terminator<L: Lane>(geometric: Triple<L>, shading: Triple<L>, to_light: Triple<L>) -> L {
    let faced = geometric.dot(to_light) / (shading.dot(to_light) * geometric.dot(shading));
    let (none, one) = (faced.number(0.0), faced.number(1.0));
    let share = faced.min(one).max(none);
    share * share.mul_add(one - share, one)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn share(geometric: DVec3, shading: DVec3, to_light: DVec3) -> f64 {
        let unit = |v: DVec3| Triple::from(v.normalize());
        soft_terminator(unit(geometric), unit(shading), unit(to_light))
    }

    #[test]
    fn nothing_changes_where_normals_agree() {
        for to_light in [DVec3::Y, DVec3::new(1.0, 0.2, 0.3), DVec3::new(3.0, 1e-3, -1.0)] {
            assert!((share(DVec3::Y, DVec3::Y, to_light) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn it_falls_smoothly_to_nothing_where_the_surface_turns_away() {
        let shading = DVec3::new(0.5, 1.0, 0.0);
        let at = |height: f64| share(DVec3::Y, shading, DVec3::new(1.0, height, 0.0));
        assert_eq!(at(0.0), 0.0);
        assert!(at(1e-6) < 1e-5);
        let steps: Vec<f64> = (0..=100).map(|i| at(f64::from(i) * 0.01)).collect();
        assert!(steps.windows(2).all(|pair| pair[0] <= pair[1] && pair[1] - pair[0] < 0.05), "{steps:?}");
        assert_eq!(at(2.0), 1.0);
    }
}
