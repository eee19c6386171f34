//! Do lobes choose the same directions in lanes of `f32` as in `f64`?

use catoptra_core::glam::DVec3;
use catoptra_core::lobe::{Diffuse, Phong, PhongModel, PhongShape};
use catoptra_core::{Scatter, ShadingPoint, Triple};
use fearless_simd::{Level, Simd};

use crate::lanes::{F, F3, M, Work, at_level};
use crate::random::Random;

/// How far directions may differ: where 1 − x² is taken of an x near 1, half of the digits are lost.
const APART: f64 = 1e-3;

fn narrow<S: Simd>(s: S, v: Triple<f64>) -> F3<S> {
    F3::new(F::splat(s, v.x as f32), F::splat(s, v.y as f32), F::splat(s, v.z as f32))
}

fn narrow_point<S: Simd>(s: S, at: &ShadingPoint<f64>) -> ShadingPoint<F<S>> {
    ShadingPoint {
        position: narrow(s, at.position),
        normal: narrow(s, at.normal),
        to_viewer: narrow(s, at.to_viewer),
        distance: F::splat(s, at.distance as f32),
        front: M::splat(s, at.front),
    }
}

/// Chooses directions by a lobe in `f32` and holds them against those of the same lobe in `f64`.
fn compare<S: Simd>(s: S, narrow: &impl Scatter<F<S>>, wide: &impl Scatter<f64>) {
    let mut random = Random(7);
    let mut compared = 0;
    for _ in 0..2000 {
        let normal = random.point().normalize();
        let to_viewer = (normal + 0.9 * random.point().normalize()).normalize();
        let at = ShadingPoint { normal: normal.into(), to_viewer: to_viewer.into(), ..ShadingPoint::HEAD_ON };
        let u = [random.number(), random.number()].map(|number| ((number + 1.0) / 2.0) as f32);
        let one = wide.sample(&at, u.map(f64::from));
        if one.cosine < APART {
            continue;
        }
        let many = narrow.sample(&narrow_point(s, &at), u.map(|u| F::splat(s, u)));
        let direction = [many.direction.x, many.direction.y, many.direction.z].map(|v| f64::from(v.lane(0)));
        assert!(DVec3::from(direction).distance(one.direction.into()) < APART, "{u:?}: {direction:?}");
        assert_eq!(many.lanes.bits().count_ones() as usize, F::<S>::LANES);
        let weight = narrow.evaluate(&narrow_point(s, &at), many.direction, many.cosine).x / many.pdf;
        let expected = wide.evaluate(&at, one.direction, one.cosine).x / one.pdf;
        assert!((f64::from(weight.lane(0)) - expected).abs() < APART * (1.0 + expected), "{u:?}");
        compared += 1;
    }
    assert!(compared > 500, "only {compared} directions lie above the surface");
}

struct CompareLobes;

impl Work for CompareLobes {
    type Output = ();

    fn with<S: Simd>(self, s: S) {
        let grey = Triple::splat(0.5);
        compare(s, &Diffuse { albedo: narrow(s, grey) }, &Diffuse { albedo: grey });
        for exponent in [0.0, 2.5, 16.0, 1000.0] {
            let shape = PhongShape::new(exponent, PhongModel::Normalised);
            compare(s, &Phong { specular: narrow(s, grey), shape }, &Phong { specular: grey, shape });
        }
    }
}

#[test]
fn lobes_choose_the_same_directions_in_f32() {
    at_level(Level::new(), CompareLobes);
}
