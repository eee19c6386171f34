//! Are textures laid where they should be, and asked anywhere without harm?

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::{picture, random, word};
use crate::texture::{CheckerTexture, Texture, TexturePoint};
use crate::{ImageSource, Value, Values};

#[test]
fn mappings_by_position_know_their_footprints() {
    let mut state = 5;
    for mapping in ["planar", "box", "spherical"] {
        let values =
            Values::new().with("mapping", word(mapping)).with("scale", Value::Pair(DVec2::new(3.0, -2.0)));
        let values =
            values.with("turn", Value::Number(0.4)).with("offset", Value::Pair(DVec2::new(0.1, 0.2)));
        let checker: CheckerTexture = crate::part::make(&values).unwrap();
        let transform = checker.transform;
        for _ in 0..50 {
            let mut vector =
                || DVec3::new(random(&mut state) - 0.5, random(&mut state) - 0.5, random(&mut state) - 0.5);
            let (position, normal, side) = (vector(), vector(), vector());
            let at =
                TexturePoint { position, normal, spread: Some([side, -side]), ..TexturePoint::default() };
            let place = |position| transform.flat(&TexturePoint { position, ..at }).uv;
            let right = (place(position + side * 1e-6) - place(position - side * 1e-6)) / 2e-6;
            let found = transform.flat(&at).footprint.unwrap();
            assert!(
                found[0].distance(right) < 1e-5 * (1.0 + right.length()),
                "{mapping}: {} {right}",
                found[0]
            );
            assert_eq!(found[0], -found[1]);
        }
    }
}

#[test]
fn nothing_that_is_no_number_comes_out() {
    let image = Arc::new(picture(4, 4, |x, y| (x * 60 + y) as u8));
    let source = Value::Image(ImageSource { path: "a.png".into(), image });
    let bad = [f64::NAN, f64::INFINITY, -1e300, 1e18, 0.0];
    for kind in Texture::KINDS {
        let file = kind.field("file").map(|_| source.clone());
        let mappings: &[&str] = if kind.field("octaves").is_some() {
            &["position", "uv"]
        } else {
            &["uv", "planar", "box", "spherical"]
        };
        for mapping in mappings {
            let values = file.iter().fold(Values::new(), |values, file| values.with("file", file.clone()));
            let values = match kind.field("mapping") {
                Some(_) => values.with("mapping", word(mapping)),
                None => values,
            };
            let texture = (kind.make)(&values).unwrap();
            for (&a, &b) in bad.iter().flat_map(|a| bad.iter().map(move |b| (a, b))) {
                let (uv, position) = (DVec2::new(a, b), DVec3::new(b, a, 1.0));
                let footprints = [None, Some([DVec2::new(b, a); 2]), Some([DVec2::new(0.1, b), DVec2::ZERO])];
                let spreads = [None, Some([position; 2]), Some([DVec3::X * b, DVec3::ZERO])];
                for (footprint, spread) in footprints.into_iter().zip(spreads) {
                    for stochastic in [None, Some([0.3, 0.9]), Some([a, b])] {
                        let at = TexturePoint {
                            uv,
                            position,
                            normal: position,
                            color: None,
                            footprint,
                            spread,
                            stochastic,
                        };
                        let texel = texture.texel(&at);
                        let is_color = texel.color.all(|v| (0.0..=1.0).contains(&v)) && texel.alpha == 1.0;
                        assert!(is_color, "{} {mapping}: {texel:?} at {at:?}", kind.name);
                    }
                }
            }
        }
    }
}
