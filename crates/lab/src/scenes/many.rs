//! Many of one kind: lights over a floor, spheres and instances on a grid, in a scene whose picture stays alike.

use catoptra_core::geometry::{Plane, Sphere};
use catoptra_core::glam::DVec3;
use catoptra_core::light::{AmbientLight, DirectionalLight, PointLight, SpotLight};
use catoptra_core::material::Matte;
use catoptra_core::{Camera, Edit, MaterialId, Node, Placement, Rgb, Scene, Shape};

use super::{NoScene, ball_mesh};

/// How far the lights of [`many_lights`] reach.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// Everywhere: points.
    Everywhere,
    /// Their own part of the floor: spots whose cones together cover it about once.
    Nearby,
}

/// Edge of the floor that is looked at, metres.
const EDGE: f64 = 20.0;

/// So many lights 4 m above a floor with 25 balls, in a square grid; together they are as bright as any other number.
///
/// # Errors
/// None with these numbers.
pub fn many_lights(count: u32, reach: Reach) -> Result<Scene, NoScene> {
    let (mut scene, white) = stage()?;
    scene.add_shape("floor", Plane::new(DVec3::ZERO, DVec3::Y)?, white, None)?;
    for (number, place) in grid(25, 2, EDGE).enumerate() {
        scene.add_shape(&format!("ball {number}"), Sphere::new(place + DVec3::Y, 1.0)?, white, None)?;
    }
    let side = (1..).find(|side| side * side >= count).unwrap_or(1);
    let cell = EDGE / f64::from(side);
    for (number, place) in grid(count, 2, EDGE).enumerate() {
        let (name, above) = (format!("lamp {number}"), place + 4.0 * DVec3::Y);
        if reach == Reach::Everywhere {
            let lamp = PointLight::new(above, Rgb::grey(500.0 / f64::from(count)))?;
            scene.add_light(&name, lamp, None)?;
        } else {
            let outer = 2.0 * (0.75 * cell / 4.0).atan();
            let lamp = SpotLight::new(above, -DVec3::Y, Rgb::grey(30.0), [0.8 * outer, outer])?;
            scene.add_light(&name, lamp, None)?;
        }
    }
    Ok(scene)
}

/// So many spheres in a cubic grid that fills the same box whatever their number, under one directional light.
///
/// # Errors
/// None with these numbers.
pub fn many_spheres(count: u32) -> Result<Scene, NoScene> {
    filled_box(count, |place, room| Ok(Sphere::new(place, 0.3 * room)?.into()))
}

/// So many copies of one mesh of `2 * rings * rings` triangles, turned each in its own way, as [`many_spheres`].
///
/// # Errors
/// None with these numbers.
pub fn many_instances(count: u32, rings: u32) -> Result<Scene, NoScene> {
    let mesh = ball_mesh(rings);
    filled_box(count, |place, room| {
        let turned =
            Placement::IDENTITY.turned(DVec3::ZERO, DVec3::new(1.0, 3.0, 2.0), 7.0 * place.length())?;
        let placement = turned.scaled(0.3 * room)?.moved(place)?;
        Ok(Shape::from(mesh.clone()).placed(&placement))
    })
}

fn filled_box(count: u32, shape: impl Fn(DVec3, f64) -> Result<Shape, NoScene>) -> Result<Scene, NoScene> {
    let (mut scene, white) = stage()?;
    let room = EDGE / f64::from(count).cbrt().ceil();
    let nodes = grid(count, 3, EDGE).enumerate();
    let nodes: Result<Vec<Edit>, NoScene> = nodes
        .map(|(number, place)| {
            Ok(Edit::insert(Node::shape(format!("shape {number}"), shape(place, room)?, white)))
        })
        .collect();
    scene.apply(Edit::Batch(nodes?))?;
    scene.add_light("sun", DirectionalLight::new(DVec3::new(-1.0, -3.0, -2.0), Rgb::grey(3.0))?, None)?;
    Ok(scene)
}

/// A white material, faint light from everywhere, and a camera that sees a box of the edge [`EDGE`] on the origin.
fn stage() -> Result<(Scene, MaterialId), NoScene> {
    let mut scene = Scene::new();
    let white = scene.add_material("white", Matte::new(Rgb::grey(0.8))?)?;
    scene.add_light("sky", AmbientLight::new(Rgb::grey(0.05))?, None)?;
    let camera = Camera::look_at(DVec3::new(6.0, 22.0, 26.0), DVec3::ZERO, DVec3::Y, 0.7)?;
    scene.add_camera("eye", camera, None)?;
    Ok((scene, white))
}

/// So many places in a square (2 dimensions, on the floor) or cube (3) round the origin, evenly set.
fn grid(count: u32, dimensions: u32, edge: f64) -> impl Iterator<Item = DVec3> {
    let side = (1_u32..).find(|side| side.pow(dimensions) >= count).unwrap_or(1);
    let at = move |k: u32| ((f64::from(k) + 0.5) / f64::from(side) - 0.5) * edge;
    (0..count).map(move |number| {
        let height = if dimensions == 3 { at(number / (side * side)) } else { 0.0 };
        DVec3::new(at(number % side), height, at(number / side % side))
    })
}

#[cfg(test)]
mod tests {
    use catoptra_core::Role;

    use super::*;

    #[test]
    fn there_are_as_many_as_asked() {
        for reach in [Reach::Everywhere, Reach::Nearby] {
            assert_eq!(many_lights(10, reach).unwrap().entities_of(Role::Light).count(), 11);
        }
        assert_eq!(many_spheres(30).unwrap().entities_of(Role::Shape).count(), 30);
        assert_eq!(many_instances(9, 4).unwrap().entities_of(Role::Shape).count(), 9);
    }

    #[test]
    fn places_are_distinct_and_within_the_edge() {
        let places: Vec<DVec3> = grid(28, 3, 2.0).collect();
        for (i, a) in places.iter().enumerate() {
            assert!(a.abs().max_element() < 1.0 && places[..i].iter().all(|b| a.distance(*b) > 0.3));
        }
    }
}
