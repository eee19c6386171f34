//! Which shapes and lights are tried? Those of all kinds, of random values, made from the lists of kinds, so that a new
//! kind is tried on arrival.

use std::f64::consts::TAU;
use std::sync::Arc;

use catoptra_core::geometry::Plane;
use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::light::Pole;
use catoptra_core::{
    Field, FieldKind, Image, ImageSource, IntensityProfile, Kind, Light, MeshSource, Placement,
    ProfileSource, Rgb, Rows, Shape, TriangleMesh, Value, Values,
};

use crate::random::Random;

/// One of a list.
pub(super) fn one_of<'a, T>(random: &mut Random, list: &'a [T]) -> &'a T {
    &list[random.bits() as usize % list.len()]
}

/// True with a chance of one in `many`.
pub(super) fn one_in(random: &mut Random, many: u64) -> bool {
    random.bits().is_multiple_of(many)
}

/// A share by which something is met, or missed: mostly tiny.
pub(super) fn hair(random: &mut Random) -> f64 {
    let sign = if one_in(random, 4) { -1.0 } else { 1.0 };
    sign * random.power(-52, -3)
}

/// What fields of one part share.
#[derive(Default)]
struct Given {
    direction: Option<DVec3>,
    angle: Option<f64>,
}

impl Given {
    /// Within a few metres of zero. A second direction is perpendicular to the first, a second angle often the same.
    fn value(&mut self, random: &mut Random, field: &Field, size: f64) -> Value {
        match field.kind {
            FieldKind::Length => Value::Number(size * random.power(-2, 0)),
            FieldKind::Count => Value::Number((random.bits() % 4) as f64),
            FieldKind::Number | FieldKind::Fraction => Value::Number(random.number().abs()),
            FieldKind::Angle => {
                let angle = self.angle.filter(|_| one_in(random, 2)).unwrap_or(random.number().abs() * TAU);
                self.angle = Some(angle);
                Value::Number(angle)
            }
            FieldKind::Point => Value::Vector(random.point() * size),
            FieldKind::Direction => {
                let any = random.point();
                let way = self.direction.map_or(any, |first| first.cross(any)).normalize_or(DVec3::X);
                self.direction = Some(way);
                Value::Vector(way * size * random.power(-2, 0))
            }
            FieldKind::Color | FieldKind::Quantity => Value::Color(Rgb::grey(0.5)),
            FieldKind::Flag => Value::Flag(true),
            FieldKind::Choice(words) => Value::Word((*one_of(random, words)).to_owned()),
            FieldKind::Mesh => Value::Mesh(some_mesh(random, size)),
            FieldKind::Profile => Value::Profile(some_profile(random)),
            FieldKind::Pair => Value::Pair(DVec2::splat(size)),
            FieldKind::Image => Value::Image(some_picture(random)),
            FieldKind::Rows(2) => Value::Rows(some_outline(random, size)),
            FieldKind::Rows(_) => Value::Rows(Rows::of([(); 8].map(|()| (random.point() * size).to_array()))),
            FieldKind::Texture => unreachable!("neither shapes nor lights have one"),
        }
    }
}

/// A few triangles.
fn some_mesh(random: &mut Random, size: f64) -> MeshSource {
    let positions: Vec<[f32; 3]> =
        (0..6).map(|_| (random.point() * size).to_array().map(|x| x as f32)).collect();
    let triangles =
        (0..2 + random.bits() % 6).map(|_| [(); 3].map(|()| (random.bits() % 6) as u32)).collect();
    let mesh = TriangleMesh::new(positions, triangles, None, None).unwrap();
    MeshSource { path: String::new(), mesh: Arc::new(mesh) }
}

/// A grey picture of a few pixels.
fn some_picture(random: &mut Random) -> ImageSource {
    let bytes = (0..12).map(|_| random.bits() as u8).collect();
    ImageSource { path: String::new(), image: Arc::new(Image::from_bytes([4, 3], 1, bytes).unwrap()) }
}

/// Corners round zero, nearer and farther.
fn some_outline(random: &mut Random, size: f64) -> Rows {
    Rows::of([0, 1, 2, 3, 4, 5].map(|i| {
        let (sine, cosine) = f64::from(i).sin_cos();
        let out = size * random.power(-2, 0);
        [cosine * out, sine * out]
    }))
}

/// Light into a cap round nadir.
fn some_profile(random: &mut Random) -> ProfileSource {
    let polar = vec![0.0, 10.0 + 170.0 * random.number().abs()];
    let profile = IntensityProfile::new(Pole::Nadir, polar, vec![0.0], vec![1.0; 2]).unwrap();
    ProfileSource { path: String::new(), profile: Arc::new(profile) }
}

/// A part of some kind near zero, about `size` metres large.
fn some_part<T>(random: &mut Random, kind: &Kind<T>, size: f64) -> T {
    let mut part = || {
        let mut given = Given::default();
        // Of two fields one is given.
        let mut fields: Vec<_> = kind.fields.iter().collect();
        let place = |name: &str| kind.fields.iter().position(|field| field.name == name);
        fields.retain(|field| field.instead_of.is_none_or(|other| place(field.name) < place(other)));
        let fields = fields.into_iter();
        let values = fields.map(|field| (field.name, given.value(random, field, size)));
        (kind.make)(&values.fold(Values::new(), |values, (name, value)| values.with(name, value)))
    };
    let tries = (0..1000).find_map(|_| part().ok());
    tries.unwrap_or_else(|| panic!("no {} can be made of random values", kind.name))
}

/// A shape of any kind, turned or not.
pub(super) fn some_shape(random: &mut Random, size: f64) -> Shape {
    let kind = one_of(random, Shape::KINDS);
    let shape = some_part(random, kind, size);
    let turned = Placement::IDENTITY.turned(DVec3::ZERO, random.point(), random.number() * TAU);
    if one_in(random, 2) { shape.placed(&turned.unwrap()) } else { shape }
}

/// A plane through a point, given by that or by one far away.
pub(super) fn some_plane(random: &mut Random, through: DVec3, normal: DVec3, size: f64) -> Shape {
    let normal = normal.normalize_or(DVec3::X);
    let along = random.point().reject_from_normalized(normal);
    let away = if one_in(random, 3) { size * random.power(0, 30) } else { 0.0 };
    Plane::new(through + along * away, normal).unwrap().into()
}

/// A light of any kind that shines from somewhere.
pub(super) fn some_light(random: &mut Random, position: DVec3, size: f64) -> Light {
    loop {
        let kind = one_of(random, Light::KINDS);
        let light = some_part(random, kind, size);
        if light.position().is_some() || light.direction().is_some() {
            return light.placed(&Placement::IDENTITY.moved(position).unwrap());
        }
    }
}

/// A shape moved by so much.
pub(super) fn moved(shape: &Shape, by: DVec3) -> Shape {
    shape.placed(&Placement::IDENTITY.moved(by).unwrap())
}

/// Points of a shape's rim, where its kind has any; corners of its box where the kind is not known here.
pub(super) fn rim(shape: &Shape) -> Vec<DVec3> {
    let round = |center: DVec3, axis: DVec3, radius: f64| -> Vec<DVec3> {
        let a = axis.any_orthonormal_vector();
        let b = axis.cross(a);
        (0..8).map(|i| center + (a * f64::from(i).sin() + b * f64::from(i).cos()) * radius).collect()
    };
    let swept = |[from, to]: [DVec3; 2], [lower, upper]: [f64; 2]| -> Vec<DVec3> {
        let axis = (to - from).normalize();
        [round(from, axis, lower), round(to, axis, upper)].concat()
    };
    match shape {
        Shape::Plane(p) => {
            let a = p.normal().any_orthonormal_vector();
            vec![p.point(), p.point() + a, p.point() + p.normal().cross(a)]
        }
        Shape::Sphere(s) => round(s.center(), DVec3::new(1.0, 2.0, 3.0).normalize(), s.radius()),
        Shape::Disk(d) => round(d.center(), d.normal(), d.radius()),
        Shape::Triangle(t) => t.corners().to_vec(),
        Shape::Tetrahedron(t) => t.corners().to_vec(),
        Shape::Rectangle(r) => {
            let [u, v] = r.edges();
            vec![r.corner(), r.corner() + u, r.corner() + u + v, r.corner() + v]
        }
        Shape::Cuboid(c) => c.object_bounds().corners().map(|p| c.placement().point(p)).to_vec(),
        shape if shape.as_mesh().is_some() => shape.as_mesh().map_or_else(Vec::new, |m| {
            let corners = m.triangles().positions().iter();
            corners.map(|p| m.placement().point(DVec3::from(p.map(f64::from)))).collect()
        }),
        shape if shape.faceted().is_some() => shape.faceted().map_or_else(Vec::new, |s| s.corners().to_vec()),
        Shape::Cylinder(c) => swept(c.ends(), [c.radius(); 2]),
        Shape::Cone(c) => swept(c.ends(), c.radii()),
        shape => shape.bounds().map_or_else(Vec::new, |bounds| bounds.corners().to_vec()),
    }
}

/// The point of a shape, or of its rim, that lies farthest along a unit vector.
pub(super) fn farthest(shape: &Shape, along: DVec3) -> DVec3 {
    match shape {
        Shape::Sphere(s) => s.center() + along * s.radius(),
        Shape::Disk(d) => {
            d.center() + along.reject_from_normalized(d.normal()).normalize_or_zero() * d.radius()
        }
        Shape::Capsule(c) => {
            let [from, to] = c.ends();
            (if (to - from).dot(along) > 0.0 { to } else { from }) + along * c.radius()
        }
        Shape::Cylinder(c) => {
            let [from, to] = c.ends();
            (if (to - from).dot(along) > 0.0 { to } else { from })
                + along.reject_from_normalized(c.axis()).normalize_or_zero() * c.radius()
        }
        shape => {
            let rim = rim(shape).into_iter();
            rim.max_by(|a, b| a.dot(along).total_cmp(&b.dot(along))).unwrap_or(DVec3::ZERO)
        }
    }
}
