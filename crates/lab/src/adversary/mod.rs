//! Which rays are hard? Trials of every kind, made from a number: rays aimed at edges, corners, rims and silhouettes to
//! within a few steps of `f32`, surfaces a few steps apart, numbers at both ends of the range.

mod ask;
mod flat;
mod leak;
mod mesh;
mod order;
mod random;
mod ring;
mod round;
mod scale;
mod swept;

use catoptra_core::material::Matte;
use catoptra_core::{Ray, Rgb, Scene, Shape};

use crate::stress::PoseError;
pub use ask::Replies;
pub use leak::{Closed, closed};
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
    mesh::HEIGHTFIELD,
    flat::TRIANGLES,
    flat::RECTANGLES,
    flat::DISKS,
    flat::TETRAHEDRA,
    flat::BOXES,
    flat::POLYHEDRA,
    flat::PLATONIC,
    flat::PRISMS,
    flat::PLANES,
    flat::CANCELLING_PLANES,
    round::FAR,
    round::HUGE,
    round::TANGENT,
    round::INSIDE,
    round::ON_SURFACE,
    swept::CYLINDERS,
    swept::CONES,
    swept::CAPSULES,
    swept::TOUCHING,
    ring::TORI,
    ring::TOUCHING,
    order::CROSSING,
    order::PARALLEL,
    order::SPHERES,
    order::MIXED,
    order::COINCIDENT,
    scale::SCENES,
    scale::DIRECTIONS,
    scale::BAD_RAYS,
];

#[cfg(test)]
mod tests {
    use catoptra_tracer::{Pool, backends};

    use super::*;

    /// Rays asked of every group.
    const ASKED: usize = 10_000;

    /// What the shapes say themselves, tried one by one: in `f64`, and where that does not decide, exactly.
    #[test]
    fn shapes_answer_hard_rays_as_the_reference_does() {
        let pool = Pool::new(1).expect("a pool of threads");
        let plain = backends().iter().find(|backend| backend.name() == "oracle").expect("it is listed");
        for group in GROUPS {
            let replies = group.ask(*plain, 1000, ASKED, &pool).expect("trials are scenes");
            let told = replies.wrong.len().min(5);
            let wrong = replies.wrong.len();
            assert!(wrong == 0, "{}: {wrong} wrong\n{}", group.name, replies.wrong[..told].join("\n"));
        }
    }

    #[test]
    fn nothing_leaks_out_of_what_is_closed() {
        let pool = Pool::new(1).expect("a pool of threads");
        for shape in closed().expect("good numbers") {
            for backend in backends() {
                let leaks = shape.leaks(*backend, 2_000, &pool).expect("a scene");
                assert_eq!(leaks, 0, "{} by {}", shape.name, backend.name());
            }
        }
    }
}
