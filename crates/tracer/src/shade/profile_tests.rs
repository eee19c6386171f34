//! Do lights with an intensity profile shine in lanes as they do in `f64`, and alike at every width?

use std::sync::Arc;

use catoptra_core::glam::DVec3;
use catoptra_core::light::{IntensityProfile, Pole};
use catoptra_core::{Light, ProfileSource, Triple, Value, Values};
use fearless_simd::Simd;

use crate::Instructions;
use crate::lanes::{F, F3, Work, at_level};
use crate::random::Random;

/// Lights with a steep and a smooth profile, about both poles.
fn lights() -> Vec<Light> {
    let steep = (vec![0.0, 20.0, 21.0, 90.0, 180.0], vec![0.0, 90.0, 200.0, 360.0]);
    let smooth = ((0..=36).map(|i| f64::from(i * 5)).collect(), vec![-90.0, 10.0, 90.0]);
    let mut lights = Vec::new();
    for (polar, azimuth) in [steep, smooth] {
        for pole in [Pole::Nadir, Pole::Across] {
            let candela = (0..polar.len() * azimuth.len()).map(|i| ((i * i) % 7) as f64).collect();
            let profile = IntensityProfile::new(pole, polar.clone(), azimuth.clone(), candela).unwrap();
            let source = ProfileSource { path: String::new(), profile: Arc::new(profile) };
            let values = Values::new()
                .with("position", Value::Vector(DVec3::new(0.5, 1.25, -0.75)))
                .with("direction", Value::Vector(DVec3::new(0.3, -1.0, 0.2)))
                .with("profile", Value::Profile(source));
            let kind = Light::kind_named("point-light").unwrap();
            lights.push((kind.make)(&values).unwrap());
        }
    }
    lights
}

/// What arrives at points in `f32`, all lanes but one of which hold other points.
struct Arriving<'a>(&'a Light, &'a [[f32; 3]]);

impl Work for Arriving<'_> {
    type Output = Vec<f32>;

    fn with<S: Simd>(self, s: S) -> Vec<f32> {
        let Self(light, points) = self;
        let mut found = Vec::new();
        for packet in points.chunks(F::<S>::LANES) {
            let mut at = F3::<S>::splat(F::splat(s, 0.0));
            for (lane, point) in packet.iter().enumerate() {
                at.x.set(lane, point[0]);
                at.y.set(lane, point[1]);
                at.z.set(lane, point[2]);
            }
            let strength = light.arriving(at).strength;
            found.extend((0..packet.len()).map(|lane| strength.lane(lane)));
        }
        found
    }
}

#[test]
fn profiles_shine_in_lanes_as_in_doubles_and_alike_at_every_width() {
    let mut random = Random(7);
    let points: Vec<[f32; 3]> =
        (0..4000).map(|_| (random.point() * 4.0).to_array().map(|x| x as f32)).collect();
    for light in lights() {
        let found = at_level(Instructions::best().level(), Arriving(&light, &points));
        for instructions in Instructions::all() {
            let other = at_level(instructions.level(), Arriving(&light, &points));
            let same = found.iter().zip(&other).all(|(a, b)| a.to_bits() == b.to_bits());
            assert!(same, "{instructions:?}");
        }
        let peak = match light.values().get("profile") {
            Some(Value::Profile(source)) => source.profile.peak(),
            _ => unreachable!("these lights have profiles"),
        };
        let mut jumped = 0;
        for (point, found) in points.iter().zip(found) {
            let point = DVec3::from(point.map(f64::from));
            let exact = light.arriving::<f64>(Triple::from(point));
            let unit = 1.0 / (exact.distance * exact.distance);
            let error = (f64::from(found) - exact.strength).abs() / (unit * peak);
            // Beyond its last angles a profile is dark at once.
            jumped += u32::from(error > 3e-5);
        }
        assert!(jumped <= 1, "{jumped} of {} points differ", points.len());
    }
}
