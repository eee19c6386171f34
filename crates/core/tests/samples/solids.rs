//! Samples of what is made of many flat facets.

use std::sync::Arc;

use catoptra_core::geometry::{Faceted, Heightfield, Platonic, Polyhedron, Prism, Shape};
use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{Image, ImageSource};

use super::{Form, Sample, v};

/// Samples of one kind.
pub(super) fn samples_of(kind: &str) -> Vec<Sample> {
    match kind {
        "polyhedron" => {
            let points = (0..40).map(|i| {
                let angle = f64::from(i * 3 + 1);
                (v(angle.sin(), (angle * 1.7).cos(), (angle * 0.3).sin()) * 4.0).round() + v(9.0, -2.0, 3.5)
            });
            let planes = DVec3::AXES.into_iter().flat_map(|axis| [(axis, 1.0), (-axis, 2.0)]);
            let planes = planes.chain([(v(1.0, 2.0, -1.0), 1.0), (v(0.3, -0.7, 0.1), 0.8)]);
            [Polyhedron::hull_of(points), Polyhedron::between(planes)]
                .map(|solid| solid.unwrap())
                .map(|solid| faceted(solid.clone().into(), solid.solid()))
                .to_vec()
        }
        "platonic" => ["tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"]
            .map(|solid| Platonic::new(solid, v(1.0, -3.0, 0.25), 2.0).unwrap())
            .map(|solid| faceted(solid.clone().into(), solid.solid()))
            .to_vec(),
        "prism" => vec![
            prism(&[[0.0, 0.0], [2.0, 0.0], [3.0, 1.5], [0.5, 2.0]], &[[0, 1, 2], [0, 2, 3]]),
            prism(
                &[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 3.0], [0.0, 4.0]],
                &[[0, 1, 3], [1, 2, 3], [0, 3, 4]],
            ),
        ],
        "heightfield" => vec![heightfield(false), heightfield(true)],
        _ => Vec::new(),
    }
}

/// Of a solid whose facets tests of its own hold against plain geometry.
fn faceted(shape: Shape, solid: &Faceted) -> Sample {
    let faces = (0..solid.count()).flat_map(|facet| solid.triangles(facet).map(move |face| (facet, face)));
    Sample { shape, form: Form::Faces(faces.collect()) }
}

/// Over an outline in x and z, drawn upwards along −z, that is cut into triangles as given.
fn prism(outline: &[[f64; 2]], cut: &[[usize; 3]]) -> Sample {
    let (from, height) = (v(4.0, 1.0, -2.0), 1.75);
    let at = |i: usize, up: f64| from + v(outline[i][0], up, -outline[i][1]);
    let mut faces: Vec<(u32, [DVec3; 3])> = Vec::new();
    for &[a, b, c] in cut {
        faces.push((0, [a, c, b].map(|i| at(i, 0.0))));
        faces.push((1, [a, b, c].map(|i| at(i, height))));
    }
    for i in 0..outline.len() {
        let next = (i + 1) % outline.len();
        let [a, b, c, d] = [at(i, 0.0), at(next, 0.0), at(next, height), at(i, height)];
        faces.extend([(2 + i as u32, [a, b, c]), (2 + i as u32, [a, c, d])]);
    }
    let shape = Prism::new(outline.iter().map(|&p| p.into()), height, from, DVec3::Y).unwrap().into();
    Sample { shape, form: Form::Faces(faces) }
}

/// Hills of 4 x 3 pixels over 6 x 3 m.
fn heightfield(smooth: bool) -> Sample {
    let bytes = [0, 51, 255, 0, 102, 51, 204, 153, 0, 0, 51, 255];
    let image = Image::from_bytes([4, 3], 1, bytes.to_vec()).unwrap();
    let picture = ImageSource { path: "hills.png".into(), image: Arc::new(image) };
    let shape = Heightfield::new(picture, DVec2::new(6.0, 3.0), 2.5, smooth).unwrap().into();
    let at = |column: usize, row: usize| {
        let height = 2.5 * f64::from(bytes[4 * row + column]) / 255.0;
        v(-3.0 + 2.0 * column as f64, height, -1.5 + 1.5 * row as f64).as_vec3().as_dvec3()
    };
    let cells = (0..2).flat_map(|row| (0..3).map(move |column| (column, row)));
    let faces = cells.flat_map(|(column, row)| {
        let [a, b] = [at(column, row), at(column + 1, row)];
        let [c, d] = [at(column, row + 1), at(column + 1, row + 1)];
        [[a, c, d], [a, d, b]]
    });
    Sample { shape, form: Form::Faces((0..).zip(faces).collect()) }
}
