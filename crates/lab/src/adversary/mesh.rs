//! Closed meshes, and rays at their corners and edges.

use std::sync::Arc;

use catoptra_core::geometry::{Heightfield, Mesh};
use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{Image, ImageSource, MeshSource, Placement, Ray, Shape, TriangleMesh};

use super::{Group, Random, Trial};

pub(super) const UNIT: Group = Group {
    name: "mesh, unit",
    doc: "a lumpy ball of triangles, rays at its edges and corners",
    make: |random| {
        let ball = ball(random, |p, random| p * random.between(0.7, 1.3));
        trial(random, &ball, Placement::IDENTITY, 4.0)
    },
};

pub(super) const SLIVERS: Group = Group {
    name: "mesh, slivers",
    doc: "the ball stretched up to 2^20 times along one axis",
    make: |random| {
        let stretch = random.power(10, 20);
        let ball = ball(random, |p, _| DVec3::new(p.x, p.y * stretch, p.z));
        trial(random, &ball, Placement::IDENTITY, 2.0 * stretch)
    },
};

pub(super) const FAR: Group = Group {
    name: "mesh, far away",
    doc: "the ball 2^10 to 2^20 times its size away from zero",
    make: |random| {
        let away = random.point(1.0) * random.power(10, 20);
        let ball = ball(random, |p, _| p + away);
        trial(random, &ball, Placement::IDENTITY, 4.0)
    },
};

pub(super) const WHOLE_NUMBERS: Group = Group {
    name: "mesh, whole numbers",
    doc: "corners at whole numbers, met exactly",
    make: |random| {
        let size = random.power(2, 6);
        let ball = ball(random, |p, _| (p * size).round());
        let from = random.whole_point(4.0 * size);
        let mut trial = trial(random, &ball, Placement::IDENTITY, 4.0 * size);
        trial
            .rays
            .extend(features(&ball).into_iter().map(|target| Ray::new(from, target * 2.0 - from * 2.0)));
        trial
    },
};

pub(super) const FLAT: Group = Group {
    name: "mesh, flat",
    doc: "the ball pressed flat to 2^-20",
    make: |random| {
        let thin = random.power(-20, -8);
        let ball = ball(random, |p, _| DVec3::new(p.x, p.y * thin + p.x, p.z));
        trial(random, &ball, Placement::IDENTITY, 4.0)
    },
};

pub(super) const PLACED: Group = Group {
    name: "mesh, placed",
    doc: "the ball turned, scaled and moved; rays at where its edges went",
    make: |random| {
        let ball = ball(random, |p, _| p);
        let placement = Placement::IDENTITY
            .scaled(random.between(0.1, 10.0))
            .and_then(|p| p.turned(DVec3::ZERO, random.direction(), random.between(-3.0, 3.0)))
            .and_then(|p| p.moved(random.point(100.0)))
            .unwrap_or_default();
        trial(random, &ball, placement, 400.0)
    },
};

pub(super) const HEIGHTFIELD: Group = Group {
    name: "heightfield",
    doc: "hills of a small picture, placed or not; rays at their edges and corners",
    make: |random| {
        let bytes = (0..20).map(|_| random.bits() as u8).collect();
        let Ok(image) = Image::from_bytes([5, 4], 1, bytes) else { return nothing() };
        let picture = ImageSource { path: String::new(), image: Arc::new(image) };
        let size = DVec2::new(random.power(-3, 3), random.power(-3, 3)) * 3.0;
        let Ok(ground) = Heightfield::new(picture, size, random.power(-6, 3), random.below(2) == 0) else {
            return nothing();
        };
        let turned = Placement::IDENTITY.turned(DVec3::ZERO, random.direction(), random.between(-3.0, 3.0));
        let placement = if random.below(2) == 0 { turned.unwrap_or_default() } else { Placement::IDENTITY };
        let mesh = ground.mesh().triangles().clone();
        let trial = trial(random, &mesh, placement, 4.0 * size.max_element());
        Trial { shapes: vec![Shape::from(ground).placed(&placement)], ..trial }
    },
};

fn nothing() -> Trial {
    Trial { shapes: Vec::new(), rays: Vec::new() }
}

/// Corners of an octahedron's faces, each split into four, moved by `place`; as `f32` holds them.
fn ball(random: &mut Random, mut place: impl FnMut(DVec3, &mut Random) -> DVec3) -> TriangleMesh {
    let mut points: Vec<DVec3> = Vec::new();
    let mut number = |p: DVec3| {
        points.iter().position(|q| *q == p).unwrap_or_else(|| {
            points.push(p);
            points.len() - 1
        }) as u32
    };
    let mut triangles = Vec::new();
    for sign in 0..8_u32 {
        let axis = |i: usize| DVec3::AXES[i] * if sign >> i & 1 == 0 { 1.0 } else { -1.0 };
        let (a, b, c) = (axis(0), axis(1), axis(2));
        let [ab, bc, ca] = [a + b, b + c, c + a].map(|p| p * 0.75);
        for face in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
            triangles.push(face.map(&mut number));
        }
    }
    let positions = points.iter().map(|&p| place(p, random).to_array().map(|c| c as f32)).collect();
    TriangleMesh::new(positions, triangles, None, None)
        .unwrap_or_else(|_| unreachable!("indices count the points"))
}

/// Corners, middles and other points of edges.
fn features(mesh: &TriangleMesh) -> Vec<DVec3> {
    let triangles = (0..mesh.triangles().len() as u32).map(|i| mesh.corners(i));
    triangles.flat_map(|[a, b, c]| [a, a.midpoint(b), b.lerp(c, 0.3), c.lerp(a, 0.6)]).collect()
}

fn trial(random: &mut Random, mesh: &TriangleMesh, placement: Placement, reach: f64) -> Trial {
    let features: Vec<DVec3> = features(mesh).into_iter().map(|p| placement.point(p)).collect();
    let middle = features.iter().sum::<DVec3>() / features.len() as f64;
    // Rays from anywhere to anywhere, from one point to anywhere, and from one point close together: each kind may go
    // another way through a tracer.
    let bundle = random.below(3);
    let (point, feature) = (middle + random.point(reach), random.below(features.len()));
    let aim = |_| {
        let target = if bundle == 2 { feature + random.below(4) } else { random.below(features.len()) };
        let from = match (bundle, random.below(4)) {
            (1 | 2, _) => point,
            (_, 0) => middle,
            _ => middle + random.point(reach),
        };
        random.aimed(from, features[target % features.len()])
    };
    let rays = (0..24).map(aim).collect();
    let source = MeshSource { path: String::new(), mesh: Arc::new(mesh.clone()) };
    Trial { shapes: vec![Shape::from(Mesh::new(source)).placed(&placement)], rays }
}
