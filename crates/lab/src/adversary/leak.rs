//! Does every ray from within a closed shape meet it? Half of them are aimed at its edges, rims, seams and tips.

use catoptra_core::geometry::{Capsule, Cone, Cylinder, Platonic, Polyhedron, Prism, Torus};
use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{InvalidPart, Placement, Ray, Shape, Span};
use catoptra_tracer::query::{HitList, RayList, find_nearest};
use catoptra_tracer::{Backend, Pool, Snapshot};

use super::{Random, Trial};
use crate::stress::PoseError;

/// A closed shape, a point within it, and points of its surface where parts of it meet.
#[derive(Debug)]
pub struct Closed {
    /// What it is.
    pub name: &'static str,
    shape: Shape,
    within: DVec3,
    seams: Vec<DVec3>,
}

/// Rays asked at once.
const BATCH: usize = 1 << 16;

/// One of every kind of closed shape that is no mesh and stands on no axis.
///
/// # Errors
/// None: all are made of good numbers.
pub fn closed() -> Result<Vec<Closed>, InvalidPart> {
    let (from, to) = (DVec3::new(0.3, -0.7, 1.1), DVec3::new(1.5, 1.4, -0.6));
    let axis = (to - from).normalize();
    let middle = from.lerp(to, 0.4);
    let rim = |center: DVec3, radius: f64| {
        let u = axis.any_orthonormal_vector();
        (0..32).map(move |i| {
            let turn = f64::from(i) * std::f64::consts::TAU / 32.0;
            center + (u * turn.cos() + axis.cross(u) * turn.sin()) * radius
        })
    };
    let round = |name, shape, radii: [f64; 2]| Closed {
        name,
        shape,
        within: middle,
        seams: rim(from, radii[0]).chain(rim(to, radii[1])).collect(),
    };
    let ring = Torus::new(middle, axis, 0.9, 0.35)?;
    let cross = [[0.4, 1.2], [-0.4, 1.2], [-0.4, 0.4], [-1.3, 0.3], [-1.2, -0.5], [0.0, -0.2], [1.2, -0.9]];
    let prism = Prism::new(cross.map(DVec2::from), 0.8, DVec3::ZERO, DVec3::Y)?;
    let turned = Placement::IDENTITY.turned(middle, axis, 0.7)?;
    let points: Vec<DVec3> = rim(from, 0.8).chain(rim(to, 0.3)).step_by(5).chain([from, to]).collect();
    Ok(vec![
        round("cylinder", Cylinder::new(from, to, 0.6)?.into(), [0.6; 2]),
        round("cone", Cone::new(from, to, 0.6, 0.0)?.into(), [0.6, 0.0]),
        round("cone, cut off", Cone::new(from, to, 0.6, 0.25)?.into(), [0.6, 0.25]),
        round("capsule", Capsule::new(from, to, 0.6)?.into(), [0.6; 2]),
        Closed {
            name: "torus",
            within: rim(middle, 0.9).next().unwrap_or(middle),
            shape: ring.into(),
            seams: rim(middle + axis * 0.35, 0.9).chain(rim(middle, 0.55)).collect(),
        },
        faceted("polyhedron", Polyhedron::hull_of(points)?.into(), middle),
        faceted("platonic", Platonic::new("dodecahedron", middle, 1.3)?.into(), middle),
        faceted(
            "prism, concave",
            Shape::from(prism).placed(&turned),
            turned.point(DVec3::new(0.0, 0.3, -0.5)),
        ),
    ])
}

fn faceted(name: &'static str, shape: Shape, within: DVec3) -> Closed {
    let seams = shape.faceted().map(|facets| facets.corners().to_vec()).unwrap_or_default();
    Closed { name, shape, within, seams }
}

impl Closed {
    /// How many of so many rays from within it a backend lets out.
    ///
    /// # Errors
    /// None that such a shape could bring about.
    pub fn leaks(&self, backend: &dyn Backend, count: usize, pool: &Pool) -> Result<usize, PoseError> {
        let trial = Trial { shapes: vec![self.shape.clone()], rays: Vec::new() };
        let snapshot = Snapshot::extract(&trial.scene()?, pool);
        let (mut random, mut leaks, mut hits) = (Random::new(5), 0, HitList::default());
        for start in (0..count).step_by(BATCH) {
            let mut list = RayList::new();
            let asked = BATCH.min(count - start);
            (0..asked).for_each(|_| list.push(&self.ray(&mut random), [0.0, Span::AHEAD.max], None));
            find_nearest(backend, &snapshot, &list, &mut hits, pool);
            leaks += (0..asked).filter(|&at| hits.get(at).is_none()).count();
        }
        Ok(leaks)
    }

    fn ray(&self, random: &mut Random) -> Ray {
        if random.below(2) == 0 {
            return Ray::new(self.within, random.direction());
        }
        let [a, b] = [(); 2].map(|()| self.seams[random.below(self.seams.len())]);
        let share = [0.0, random.between(0.0, 1.0)][random.below(2)];
        let start = self.within + random.point(1.0) * random.power(-30, -4);
        random.aimed(start, a.lerp(b, share))
    }
}
