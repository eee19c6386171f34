//! Which rays are hard? Trials of every kind, made from a number: rays aimed at edges, corners, rims and silhouettes to
//! within a few steps of `f32`, surfaces a few steps apart, numbers at both ends of the range.

mod flat;
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
    use catoptra_core::Span;
    use catoptra_tracer::query::{HitList, RayList, find_nearest};
    use catoptra_tracer::{Pool, Snapshot, backends};

    use super::*;
    use crate::oracle::confirm;

    /// Rays asked of every group.
    const ASKED: usize = 10_000;

    /// What the shapes say themselves, tried one by one: in `f64`, and where that does not decide, exactly.
    #[test]
    fn shapes_answer_hard_rays_as_the_reference_does() {
        let pool = Pool::new(1).expect("a pool of threads");
        let plain = backends().iter().find(|backend| backend.name() == "oracle").expect("it is listed");
        for group in GROUPS {
            let (mut asked, mut number, mut wrong) = (0, 1000, Vec::new());
            while asked < ASKED {
                let trial = (group.make)(&mut Random::new(number));
                let snapshot = Snapshot::extract(&trial.scene().expect("a scene"), &pool);
                let (mut list, mut hits) = (RayList::new(), HitList::default());
                trial.rays.iter().for_each(|ray| list.push(ray, [Span::AHEAD.min, Span::AHEAD.max], None));
                find_nearest(*plain, &snapshot, &list, &mut hits, &pool);
                for (at, ray) in trial.rays.iter().enumerate() {
                    wrong.extend(confirm(&trial.shapes, ray, Span::AHEAD, hits.get(at)).err());
                }
                asked += trial.rays.len();
                number += 1;
            }
            let told = wrong.len().min(5);
            assert!(wrong.is_empty(), "{}: {} wrong\n{}", group.name, wrong.len(), wrong[..told].join("\n"));
        }
    }
}
