//! Does light run both ways alike?

use catoptra_core::Rgb;
use catoptra_core::glam::DVec3;
use catoptra_core::lobe::local::LocalLobe;
use catoptra_core::lobe::{
    Boundary, BsdfLobe, Complement, Ggx, GgxReflection, RoughDiffuse, RoughInterface, Roughness, Sheen,
    SmoothInterface, ThinWall, fresnel::Fresnel,
};

use super::direction;
use super::random::Random;

const COLOR: Rgb = Rgb::new(0.9, 0.5, 0.1);

/// Of a lobe as it is seen from one side and from the other; `eta` is the index beyond over that on the first side.
fn check(name: &str, here: impl Into<BsdfLobe>, there: impl Into<BsdfLobe>, eta: f64) {
    let (here, there) = (here.into(), there.into());
    let (mut random, mut met) = (Random(3), 0);
    for _ in 0..2000 {
        let o = direction(random.number(), 6.3 * random.number());
        let i = direction(2.0 * random.number() - 1.0, 6.3 * random.number());
        // The surface turned upside down, where light is transmitted.
        let over = |v: DVec3| if i.z < 0.0 { DVec3::new(v.x, v.y, -v.z) } else { v };
        let back = if i.z < 0.0 { &there } else { &here };
        let there = here.evaluate(o, i) / i.z.abs();
        let back = back.evaluate(over(i), over(o)) / o.z;
        let back = if i.z < 0.0 { back * (eta * eta) } else { back };
        for (there, back) in there.to_array().into_iter().zip(back.to_array()) {
            assert!((there - back).abs() <= 1e-9 * (1.0 + there), "{name} {o} {i}: {there} and {back}");
            met += u32::from(there > 1e-3);
        }
    }
    assert!(met > 200, "{name}: {met}");
}

#[test]
fn reflections_run_both_ways_alike() {
    let fresnel = Fresnel::metal(COLOR, Rgb::WHITE);
    let reflection = GgxReflection { ggx: Ggx::new(0.6, 0.2), fresnel };
    check("reflection", reflection, reflection, 1.0);
    let complement = Complement::of_metal(Ggx::isotropic(0.7), fresnel);
    check("complement", complement, complement, 1.0);
    let below =
        Complement::below(Boundary::new(Roughness::new(0.3), Fresnel::specular(1.5, 0.7, COLOR)), COLOR);
    check("below", below, below, 1.0);
    let diffuse = RoughDiffuse::new(COLOR, 0.6);
    check("diffuse", diffuse, diffuse, 1.0);
    let sheen = Sheen::new(0.5);
    check("sheen", sheen, sheen, 1.0);
}

#[test]
fn transmission_runs_both_ways_as_the_squared_indices() {
    for eta in [1.5, 1.0 / 1.33, 2.4] {
        let interface =
            |eta| RoughInterface { ggx: Ggx::new(0.6, 0.4), facet: SmoothInterface { eta, tint: COLOR } };
        let [here, there] = [eta, 1.0 / eta].map(interface);
        check("interface", here, there, eta);
        check("complement", Complement::of_interface(&here), Complement::of_interface(&there), eta);
    }
    let wall = ThinWall { eta: 1.5, tint: COLOR, facets: Some(Ggx::isotropic(0.4)) };
    check("wall", wall, wall, 1.0);
    let [reflected, through] = wall.mean_shares();
    let complement = Complement::of_wall(Ggx::isotropic(0.4), reflected, through);
    check("complement of a wall", complement, complement, 1.0);
}
