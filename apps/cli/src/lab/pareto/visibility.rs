//! How often does which arithmetic see the wrong thing, and what does it take?

use catoptra_core::exact::Dyadic;
use catoptra_core::geometry::Triangle;
use catoptra_core::glam::{DVec3, Vec3};
use catoptra_core::material::Matte;
use catoptra_core::{Ray, Rgb, Scene, Shape, Span};
use catoptra_lab::mismatch_rate;
use catoptra_lab::scenes::{ball_mesh, wavy_ball};
use catoptra_tracer::Snapshot;
use catoptra_tracer::query::{HitList, RayList, find_nearest};
use miette::{IntoDiagnostic, Result};

use super::{Lab, Question, Way};
use crate::names::find_backend;

/// Pairs of a ray and a triangle of each sort.
const PAIRS: usize = 100_000;

/// Rays of each sort against the mesh, which has `2 * RINGS * RINGS` triangles.
const RAYS: usize = 4_000;
const RINGS: u32 = 48;

/// Which rays.
const SORTS: [(&str, Sort); 2] = [("ordinary rays", Sort::Ordinary), ("adversarial rays", Sort::Adversarial)];

#[derive(Clone, Copy, PartialEq)]
enum Sort {
    /// Aimed anywhere near.
    Ordinary,
    /// Aimed at an edge or a corner, as nearly as `f32` can say it.
    Adversarial,
}

pub(super) fn ask(lab: &Lab) -> Result<Vec<Question>> {
    Ok(vec![triangles(lab), mesh(lab)?])
}

/// Numbers that look random, the same in every run (xorshift, Marsaglia 2003).
struct Numbers(u64);

impl Numbers {
    /// From 0 to 1.
    fn share(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// From -1 to 1 along every axis, as `f32` has it.
    fn vector(&mut self) -> DVec3 {
        short(DVec3::new(self.share(), self.share(), self.share()) * 2.0 - 1.0)
    }

    /// A point of a triangle: anywhere round it, or on its border.
    fn aim(&mut self, [a, b, c]: [DVec3; 3], sort: Sort) -> DVec3 {
        let (u, v) = (self.share(), self.share());
        short(match sort {
            Sort::Ordinary => a + (b - a) * (1.5 * u - 0.25) + (c - a) * (1.5 * v - 0.25),
            Sort::Adversarial if v < 0.3 => a,
            Sort::Adversarial => a + (b - a) * u,
        })
    }
}

/// Rounded to what `f32` holds.
fn short(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}

struct Pair {
    corners: [DVec3; 3],
    shape: Shape,
    ray: Ray,
}

fn pairs(sort: Sort) -> Vec<Pair> {
    let mut numbers = Numbers(88_172_645_463_325_252);
    let made = std::iter::repeat_with(|| {
        let corners = [numbers.vector(), numbers.vector(), numbers.vector()];
        let (origin, aim) = (numbers.vector() * 4.0, numbers.aim(corners, sort));
        let shape = Triangle::new(corners[0], corners[1], corners[2]).ok()?.into();
        Some(Pair { corners, shape, ray: Ray::new(origin, short(aim - origin)) })
    });
    made.flatten().take(PAIRS).collect()
}

/// Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", JGT 2(1), 1997, without a tolerance.
macro_rules! moller_trumbore {
    ($name:ident, $vector:ty, $of:expr) => {
        fn $name(pair: &Pair) -> bool {
            let of = $of;
            let [a, b, c]: [$vector; 3] = pair.corners.map(of);
            let (origin, direction) = (of(pair.ray.origin), of(pair.ray.direction));
            let (ab, ac) = (b - a, c - a);
            let p = direction.cross(ac);
            let inverse = 1.0 / ab.dot(p);
            let from = origin - a;
            let u = from.dot(p) * inverse;
            let q = from.cross(ab);
            let v = direction.dot(q) * inverse;
            u >= 0.0 && v >= 0.0 && u + v <= 1.0 && ac.dot(q) * inverse > 0.0
        }
    };
}

moller_trumbore!(plain_f32, Vec3, |v: DVec3| v.as_vec3());
moller_trumbore!(plain_f64, DVec3, |v: DVec3| v);

fn filtered(pair: &Pair) -> bool {
    pair.shape.cross(&pair.ray, Span::AHEAD, None).is_some()
}

fn exact(pair: &Pair) -> bool {
    pair.shape.root::<Dyadic>(0, &pair.ray, Span::AHEAD, None).is_ok_and(|root| root.is_some())
}

/// A way to say whether a ray meets a triangle.
type Arithmetic = (&'static str, fn(&Pair) -> bool);

const ARITHMETIC: [Arithmetic; 4] = [
    ("f32, Möller–Trumbore", plain_f32),
    ("f64, Möller–Trumbore", plain_f64),
    ("f64 with bounds, exact where in doubt (catoptra)", filtered),
    ("exact, always", exact),
];

/// Nanoseconds an answer, and how many of a million are wrong.
fn way<T: PartialEq>(series: &str, setting: &str, milliseconds: f64, (right, found): (&[T], &[T])) -> Way {
    let wrong = mismatch_rate(right, found).unwrap_or(1.0);
    let time = milliseconds * 1e6 / found.len() as f64;
    Way { series: series.to_owned(), setting: setting.to_owned(), time, errors: vec![wrong * 1e6] }
}

fn triangles(lab: &Lab) -> Question {
    let mut ways = Vec::new();
    for (sort_name, sort) in SORTS {
        let pairs = pairs(sort);
        let right: Vec<bool> = pairs.iter().map(exact).collect();
        for (name, meets) in ARITHMETIC {
            let (found, milliseconds) =
                lab.fastest(|| lab.pool.run(|| pairs.iter().map(meets).collect::<Vec<bool>>()));
            ways.push(way(sort_name, name, milliseconds, (&right, &found)));
        }
    }
    let words = format!(
        "Does a ray meet a triangle? {PAIRS} pairs of each sort, one after the other; ordinary rays are aimed round the triangle, adversarial \
         ones at its edges and corners as nearly as f32 can say it. Right is the answer of exact arithmetic on the numbers given. The last \
         two ways are never wrong and stand at the lower edge of the picture."
    );
    let (time, errors) = ("ns a test", &["wrong answers a million"][..]);
    Question { name: "visibility", title: "Ray against triangle", words, time, errors, ways }
}

/// Rays towards the corners, edges and surroundings of a mesh's triangles.
fn mesh_rays(sort: Sort) -> RayList {
    let (mesh, mut numbers) = (wavy_ball(RINGS), Numbers(1_234_567));
    let mut rays = RayList::new();
    for at in 0..RAYS {
        let triangle = (at * 7919 % mesh.triangles().len()) as u32;
        let (origin, aim) = (numbers.vector() * 4.0, numbers.aim(mesh.corners(triangle), sort));
        rays.push(&Ray::new(origin, short(aim - origin)), [0.0, f64::INFINITY], None);
    }
    rays
}

fn mesh(lab: &Lab) -> Result<Question> {
    let mut scene = Scene::new();
    let grey = scene.add_material("grey", Matte::new(Rgb::grey(0.5)).into_diagnostic()?).into_diagnostic()?;
    scene.add_shape("ball", ball_mesh(RINGS), grey, None).into_diagnostic()?;
    let snapshot = Snapshot::extract(&scene, &lab.pool);
    let mut ways = Vec::new();
    for (sort_name, sort) in SORTS {
        let rays = mesh_rays(sort);
        let answers = |backend: &str| -> Result<(Vec<_>, f64)> {
            let (backend, mut hits) = (find_backend(backend)?, HitList::default());
            let ((), milliseconds) = lab.fastest(|| {
                find_nearest(backend, &snapshot, &rays, &mut hits, &lab.pool);
            });
            Ok(((0..rays.len()).map(|at| hits.get(at).map(|hit| hit.0)).collect(), milliseconds))
        };
        let (right, _) = answers("oracle")?;
        for (name, backend) in
            [("f32 with bounds, 4 to 16 rays at once (wide)", "wide"), ("f64 with bounds (scalar)", "scalar")]
        {
            let (found, milliseconds) = answers(backend)?;
            ways.push(way(sort_name, name, milliseconds, (&right, &found)));
        }
    }
    let words = format!(
        "Which triangle of {} does a ray meet first? {RAYS} rays of each sort, which have little in common with their neighbours. Both ways \
         go on to exact arithmetic where their own does not decide; right is the answer of every triangle tried (`oracle`).",
        2 * RINGS * RINGS
    );
    let (time, errors) = ("ns a ray", &["wrong answers a million"][..]);
    Ok(Question { name: "mesh-visibility", title: "Ray against mesh", words, time, errors, ways })
}
