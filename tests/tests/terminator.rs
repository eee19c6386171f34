//! Does light fade on a mesh of few triangles with normals as on the round body that it stands for?

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::sync::Arc;

use catoptra_core::geometry::{Mesh, Sphere, TriangleMesh};
use catoptra_core::glam::DVec3;
use catoptra_core::light::DirectionalLight;
use catoptra_core::material::Matte;
use catoptra_core::{Camera, Integrator, MeshSource, Rgb, Scene, Shape};
use catoptra_tests::{assert_same_bits, traced};
use catoptra_tracer::{Film, Instructions, Size, View};

const SIZE: Size = Size::new(96, 96);

/// A ball of rings of triangles, with the ball's own normals.
fn ball_of_triangles(rings: u32, sectors: u32) -> TriangleMesh {
    let mut corners = Vec::new();
    for ring in 0..=rings {
        for sector in 0..=sectors {
            let latitude = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
            let longitude = std::f64::consts::TAU * f64::from(sector) / f64::from(sectors);
            let around = DVec3::new(longitude.cos(), 0.0, -longitude.sin()) * latitude.sin();
            corners.push((around + DVec3::Y * latitude.cos()).as_vec3().to_array());
        }
    }
    let at = |ring: u32, sector: u32| ring * (sectors + 1) + sector;
    let mut triangles = Vec::new();
    for (ring, sector) in (0..rings).flat_map(|ring| (0..sectors).map(move |sector| (ring, sector))) {
        let [a, b, c, d] =
            [at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1), at(ring, sector + 1)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    TriangleMesh::new(corners.clone(), triangles, Some(corners), None).unwrap()
}

fn lit(shape: impl Into<Shape>) -> Scene {
    let mut scene = Scene::new();
    let clay = scene.add_material("clay", Matte::new(Rgb::grey(0.8)).unwrap()).unwrap();
    scene.add_shape("ball", shape, clay, None).unwrap();
    let sun = DirectionalLight::new(DVec3::new(-1.0, -0.4, -0.15), Rgb::WHITE).unwrap();
    scene.add_light("sun", sun, None).unwrap();
    scene
}

fn mesh() -> Scene {
    let source = MeshSource { path: "ball".into(), mesh: Arc::new(ball_of_triangles(8, 12)) };
    lit(Mesh::new(source))
}

fn view(soft_terminator: bool) -> View {
    let camera = Camera::look_at(DVec3::Z * 5.0, DVec3::ZERO, DVec3::Y, 0.45).unwrap();
    View { soft_terminator, ..View::new(camera, SIZE) }
}

fn picture(scene: &Scene, backend: &str, view: &View) -> Film {
    traced(scene, backend, view, Film::new(SIZE), 2)
}

/// The root of the mean squared difference of two pictures, where both show the ball.
fn difference(one: &Film, other: &Film) -> f64 {
    let pixels = (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y)));
    let both = pixels.filter(|&(x, y)| one.surface(x, y).is_some() && other.surface(x, y).is_some());
    let squares = both.map(|(x, y)| f64::from(one.radiance(x, y)[1] - other.radiance(x, y)[1]).powi(2));
    let (sum, count) = squares.fold((0.0, 0), |(sum, count), square| (sum + square, count + 1));
    assert!(count > 2000, "{count} pixels");
    (sum / f64::from(count)).sqrt()
}

#[test]
fn steps_at_the_edge_of_light_become_a_slope() {
    let round = picture(&lit(Sphere::new(DVec3::ZERO, 1.0).unwrap()), "scalar", &view(false));
    let [hard, soft] = [false, true].map(|soft| picture(&mesh(), "wide", &view(soft)));
    // The largest step from a pixel to its neighbour within the ball tells how hard the edge of light is.
    let steepest = |film: &Film| {
        let pairs = (0..SIZE.height).flat_map(|y| (1..SIZE.width).map(move |x| (x, y)));
        let both = pairs.filter(|&(x, y)| film.surface(x, y).is_some() && film.surface(x - 1, y).is_some());
        both.map(|(x, y)| (film.radiance(x, y)[1] - film.radiance(x - 1, y)[1]).abs()).fold(0.0, f32::max)
    };
    let [of_round, of_hard, of_soft] = [&round, &hard, &soft].map(steepest);
    assert!(of_hard > 2.0 * of_round && of_soft < 0.75 * of_hard, "{of_round} {of_hard} {of_soft}");
    let [from_hard, from_soft] = [&hard, &soft].map(|film| difference(film, &round));
    assert!(from_soft < 2.0 * from_hard && from_soft < 0.03, "{from_hard} {from_soft}");
}

#[test]
fn backends_agree_and_instructions_change_no_bit() {
    for integrator in [Integrator::Whitted, Integrator::Path] {
        let view = View { integrator, max_depth: 1, path_depth: 0, ..view(true) };
        let [scalar, wide] = ["scalar", "wide"].map(|backend| picture(&mesh(), backend, &view));
        assert!(difference(&scalar, &wide) < 5e-6, "{integrator:?}: {}", difference(&scalar, &wide));
        for instructions in Instructions::all() {
            let view = View { instructions: Some(instructions), ..view.clone() };
            assert_same_bits(&wide, &picture(&mesh(), "wide", &view), instructions.name());
        }
    }
}

#[test]
fn flat_shapes_are_lit_as_ever() {
    let ball = lit(Sphere::new(DVec3::ZERO, 1.0).unwrap());
    let [hard, soft] = [false, true].map(|soft| picture(&ball, "wide", &view(soft)));
    assert_same_bits(&hard, &soft, "soft");
}
