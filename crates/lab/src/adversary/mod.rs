//! Which rays are hard? Trials of every kind, made from a number: rays aimed at edges, corners, rims and silhouettes to
//! within a few steps of `f32`, surfaces a few steps apart, numbers at both ends of the range.

mod flat;
mod mesh;
mod order;
mod random;
mod round;
mod scale;

use catoptra_core::material::Matte;
use catoptra_core::{Ray, Rgb, Scene, Shape};

use crate::stress::PoseError;
pub use random::Random;

/// Shapes, and rays that are hard to answer for them.
#[derive(Debug, Clone)]
pub struct Trial {
    /// What stands there.
    pub shapes: Vec<Shape>,
    /// What is asked.
    pub rays: Vec<Ray>,
}

impl Trial {
    /// A scene of the shapes, in their order.
    ///
    /// # Errors
    /// None that a trial could bring about: every shape has a name of its own.
    pub fn scene(&self) -> Result<Scene, PoseError> {
        let mut scene = Scene::new();
        let material = scene.add_material("white", Matte::new(Rgb::WHITE)?)?;
        for (number, shape) in self.shapes.iter().enumerate() {
            scene.add_shape(&format!("shape {number}"), shape.clone(), material, None)?;
        }
        Ok(scene)
    }
}

/// A kind of trial.
#[derive(Debug)]
pub struct Group {
    /// Its name.
    pub name: &'static str,
    /// What it tries.
    pub doc: &'static str,
    /// Makes a trial; with the same numbers, the same one.
    pub make: fn(&mut Random) -> Trial,
}

/// Every kind of trial.
pub const GROUPS: &[Group] = &[
    mesh::UNIT,
    mesh::SLIVERS,
    mesh::FAR,
    mesh::WHOLE_NUMBERS,
    mesh::FLAT,
    mesh::PLACED,
    flat::TRIANGLES,
    flat::RECTANGLES,
    flat::DISKS,
    flat::TETRAHEDRA,
    flat::BOXES,
    flat::PLANES,
    flat::CANCELLING_PLANES,
    round::FAR,
    round::HUGE,
    round::TANGENT,
    round::INSIDE,
    round::ON_SURFACE,
    order::CROSSING,
    order::PARALLEL,
    order::SPHERES,
    order::MIXED,
    order::COINCIDENT,
    scale::SCENES,
    scale::DIRECTIONS,
    scale::BAD_RAYS,
];
