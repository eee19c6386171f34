//! Meshes of any fineness, and a scene of two of them.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use catoptra_core::geometry::{Mesh, Plane};
use catoptra_core::glam::DVec3;
use catoptra_core::light::{AmbientLight, DirectionalLight, PointLight, SpotLight};
use catoptra_core::material::{Matte, Phong};
use catoptra_core::{Camera, Edit, MeshSource, Node, Part, Placement, Rgb, Scene, TriangleMesh};

use super::NoScene;

/// A ball of radius 1 with waves on it, of `2 * rings * rings` triangles, some thin and some nearly even; it is closed.
///
/// # Panics
/// Never: the positions are finite and the indices in range.
#[must_use]
pub fn wavy_ball(rings: u32) -> Arc<TriangleMesh> {
    let (rows, columns) = (rings.max(3), rings.max(3));
    let at = |row: u32, column: u32| {
        let (polar, around) =
            (f64::from(row) / f64::from(rows) * PI, f64::from(column) / f64::from(columns) * TAU);
        let radius = 1.0 + 0.1 * (9.0 * polar).sin() * (7.0 * around).cos();
        [polar.sin() * around.cos(), polar.cos(), polar.sin() * around.sin()].map(|v| (radius * v) as f32)
    };
    let places = (0..=rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let positions = places.map(|(row, column)| at(row, column)).collect();
    let index = |row: u32, column: u32| row * columns + column % columns;
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let triangles = cells.flat_map(|(row, column)| {
        let corners =
            [index(row, column), index(row, column + 1), index(row + 1, column + 1), index(row + 1, column)];
        [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]
    });
    TriangleMesh::new(positions, triangles.collect(), None, None).map(Arc::new).expect("finite positions")
}

/// [`wavy_ball`] as a shape.
#[must_use]
pub fn ball_mesh(rings: u32) -> Mesh {
    Mesh::new(MeshSource { path: format!("wavy-ball-{rings}"), mesh: wavy_ball(rings) })
}

/// Two wavy balls of `2 * rings * rings` triangles each, one mesh placed twice (moved, turned, scaled), in a mirroring
/// room corner under a point and a spot light.
///
/// # Errors
/// None with these numbers.
pub fn placed_mesh(rings: u32) -> Result<Scene, NoScene> {
    let mut scene = Scene::new();
    let clay = scene.add_material("clay", Matte::new(Rgb::new(0.7, 0.5, 0.4))?)?;
    let shiny = Phong::new(Rgb::grey(0.5))?.with("specular", Rgb::grey(0.5))?.with("reflectiveness", 0.3)?;
    let shiny = scene.add_material("shiny", shiny)?;
    let mesh = ball_mesh(rings);
    let turn = |by: DVec3, angle: f64, factor: f64| {
        let turned =
            Placement::IDENTITY.scaled(factor)?.turned(DVec3::ZERO, DVec3::new(1.0, 2.0, -1.0), angle)?;
        turned.moved(by)
    };
    let left = Node::shape("left", mesh.clone(), clay).placed(turn(DVec3::new(-1.3, 1.4, 0.0), 0.8, 1.25)?);
    let right = Node::shape("right", mesh, shiny).placed(turn(DVec3::new(1.4, 1.1, 0.6), 2.3, 0.9)?);
    scene.apply(Edit::insert(left))?;
    scene.apply(Edit::insert(right))?;
    scene.add_shape("floor", Plane::new(DVec3::ZERO, DVec3::Y)?, shiny, None)?;
    scene.add_shape("wall", Plane::new(DVec3::NEG_Z * 3.0, DVec3::Z)?, clay, None)?;
    scene.add_light("sky", AmbientLight::new(Rgb::grey(0.1))?, None)?;
    scene.add_light("lamp", PointLight::new(DVec3::new(3.0, 6.0, 4.0), Rgb::grey(90.0))?, None)?;
    let (from, to) = (DVec3::new(-4.0, 5.0, 3.0), DVec3::new(-1.0, 1.4, 0.0));
    scene.add_light("spot", SpotLight::new(from, to - from, Rgb::grey(60.0), [0.4, 0.7])?, None)?;
    let camera = Camera::look_at(DVec3::new(0.3, 2.6, 6.1), DVec3::new(0.1, 1.2, 0.0), DVec3::Y, 0.8)?;
    scene.add_camera("eye", camera, None)?;
    Ok(scene)
}

/// [`placed_mesh`] under the sun as well.
///
/// # Errors
/// None with these numbers.
pub fn placed_mesh_under_the_sun(rings: u32) -> Result<Scene, NoScene> {
    let mut scene = placed_mesh(rings)?;
    let sun = DirectionalLight::new(DVec3::new(0.5, -1.0, -0.6), Rgb::grey(2.0))?;
    scene.add_light("sun", sun, None)?;
    Ok(scene)
}
