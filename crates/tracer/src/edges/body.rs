//! What has outlines? Shapes as flat pieces, balls, and planes without an end.

use catoptra_core::geometry::Cuboid;
use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Shape};

/// A plane: normal · p = offset.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Level {
    /// Of unit length; outwards, where the plane bounds a solid.
    pub(crate) normal: DVec3,
    pub(crate) offset: f64,
}

impl Level {
    pub(crate) fn through(point: DVec3, normal: DVec3) -> Self {
        Self { normal, offset: normal.dot(point) }
    }

    /// How far in front of it a point lies.
    pub(crate) fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// A flat piece of a surface, convex.
#[derive(Debug, Clone)]
pub(crate) struct Flat {
    pub(crate) level: Level,
    pub(crate) border: Border,
    pub(crate) bounds: Aabb,
}

#[derive(Debug, Clone)]
pub(crate) enum Border {
    /// Corners in order.
    Polygon(Vec<DVec3>),
    Circle {
        center: DVec3,
        radius: f64,
    },
}

/// An edge of a shape, and the flat pieces on both sides of it; the same one twice where there is one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rim {
    pub(crate) ends: [DVec3; 2],
    pub(crate) sides: [usize; 2],
}

/// A shape in terms of its outlines.
#[derive(Debug, Clone)]
pub(crate) enum Body {
    Plane(Level),
    Ball {
        center: DVec3,
        radius: f64,
    },
    /// One flat piece, or those of a convex solid.
    Flats {
        flats: Vec<Flat>,
        rims: Vec<Rim>,
        solid: bool,
    },
    /// One that no outlines are known of, within a box if it has an end.
    Other(Option<Aabb>),
}

impl Body {
    pub(crate) fn of(shape: &Shape) -> Self {
        if let Some(solid) = shape.faceted().filter(|solid| solid.is_convex()) {
            let outline = |facet| solid.outline(facet).iter().map(|&i| i as usize).collect();
            let faces: Vec<Vec<usize>> = (0..solid.count()).map(outline).collect();
            return Self::solid(solid.corners(), &faces.iter().map(Vec::as_slice).collect::<Vec<_>>());
        }
        match shape {
            Shape::Plane(plane) => {
                Self::Plane(Level::through(plane.point(), plane.normal().normalize_or_zero()))
            }
            Shape::Sphere(sphere) => Self::Ball { center: sphere.center(), radius: sphere.radius() },
            Shape::Triangle(triangle) => Self::sheet(triangle.corners().to_vec()),
            Shape::Rectangle(rectangle) => {
                let (corner, [u, v]) = (rectangle.corner(), rectangle.edges());
                Self::sheet(vec![corner, corner + u, corner + u + v, corner + v])
            }
            Shape::Disk(disk) => Self::disk(disk.center(), disk.normal(), disk.radius()),
            Shape::Tetrahedron(t) => {
                Self::solid(&t.corners(), &[&[0, 1, 2], &[0, 1, 3], &[0, 2, 3], &[1, 2, 3]])
            }
            Shape::Cuboid(cuboid) => Self::cuboid(cuboid),
            other => Self::Other(other.bounds()),
        }
    }

    /// Whether it lies in one plane.
    pub(crate) fn is_flat(&self) -> bool {
        match self {
            Self::Plane(_) => true,
            Self::Flats { solid, .. } => !solid,
            _ => false,
        }
    }

    /// A box round it, where it has an end.
    pub(crate) fn bounds(&self) -> Option<Aabb> {
        match self {
            Self::Plane(_) => None,
            Self::Ball { center, radius } => {
                let reach = DVec3::splat(*radius);
                Some(Aabb { min: *center - reach, max: *center + reach })
            }
            Self::Flats { flats, .. } => {
                let corners = flats.iter().flat_map(|flat| [flat.bounds.min, flat.bounds.max]);
                Some(corners.fold(Aabb::EMPTY, |bounds, corner| bounds.union(Aabb::of([corner]))))
            }
            Self::Other(bounds) => *bounds,
        }
    }

    fn sheet(corners: Vec<DVec3>) -> Self {
        let ends = (0..corners.len()).map(|i| [corners[i], corners[(i + 1) % corners.len()]]);
        let rims = ends.map(|ends| Rim { ends, sides: [0, 0] }).collect();
        match Flat::polygon(corners) {
            Some(flat) => Self::Flats { flats: vec![flat], rims, solid: false },
            None => Self::Other(None),
        }
    }

    fn disk(center: DVec3, normal: DVec3, radius: f64) -> Self {
        let normal = normal.normalize_or_zero();
        let reach = DVec3::splat(radius);
        let flat = Flat {
            level: Level::through(center, normal),
            border: Border::Circle { center, radius },
            bounds: Aabb { min: center - reach, max: center + reach },
        };
        Self::Flats { flats: vec![flat], rims: Vec::new(), solid: false }
    }

    fn cuboid(cuboid: &Cuboid) -> Self {
        let (bounds, placement) = (cuboid.object_bounds(), cuboid.placement());
        let corners: [DVec3; 8] = std::array::from_fn(|i| {
            let end = |axis: usize| if i >> axis & 1 == 0 { bounds.min[axis] } else { bounds.max[axis] };
            placement.point(DVec3::new(end(0), end(1), end(2)))
        });
        Self::solid(
            &corners,
            &[&[0, 2, 6, 4], &[1, 3, 7, 5], &[0, 1, 5, 4], &[2, 3, 7, 6], &[0, 1, 3, 2], &[4, 5, 7, 6]],
        )
    }

    /// A convex solid of flat faces, each given by its corners in order.
    fn solid(corners: &[DVec3], faces: &[&[usize]]) -> Self {
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let flats: Option<Vec<Flat>> = faces
            .iter()
            .map(|face| {
                let mut flat = Flat::polygon(face.iter().map(|&i| corners[i]).collect())?;
                if flat.level.height(middle) > 0.0 {
                    flat.level = Level { normal: -flat.level.normal, offset: -flat.level.offset };
                }
                Some(flat)
            })
            .collect();
        let Some(flats) = flats else { return Self::Other(Some(Aabb::of(corners.iter().copied()))) };
        let mut rims: Vec<([usize; 2], Rim)> = Vec::new();
        for (side, face) in faces.iter().enumerate() {
            for i in 0..face.len() {
                let (a, b) = (face[i], face[(i + 1) % face.len()]);
                let between = [a.min(b), a.max(b)];
                match rims.iter_mut().find(|(known, _)| *known == between) {
                    Some((_, rim)) => rim.sides[1] = side,
                    None => {
                        rims.push((between, Rim { ends: between.map(|i| corners[i]), sides: [side, side] }));
                    }
                }
            }
        }
        Self::Flats { flats, rims: rims.into_iter().map(|(_, rim)| rim).collect(), solid: true }
    }
}

impl Flat {
    /// `None` for one without an area.
    fn polygon(corners: Vec<DVec3>) -> Option<Self> {
        let [a, b, .., z] = corners[..] else { return None };
        let normal = (b - a).cross(z - a).try_normalize()?;
        let bounds = Aabb::of(corners.iter().copied());
        Some(Self { level: Level::through(a, normal), border: Border::Polygon(corners), bounds })
    }

    /// The part of it that lies in a plane which it crosses.
    pub(crate) fn chord(&self, level: &Level) -> Option<[DVec3; 2]> {
        match &self.border {
            Border::Polygon(corners) => {
                let mut ends = Vec::with_capacity(2);
                for i in 0..corners.len() {
                    let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
                    let [below, above] = [a, b].map(|p| level.height(p));
                    if (below < 0.0) != (above < 0.0) {
                        ends.push(a + (b - a) * (below / (below - above)));
                    }
                }
                <[DVec3; 2]>::try_from(ends).ok()
            }
            Border::Circle { center, radius } => {
                let along = self.level.normal.cross(level.normal);
                let up = along.cross(self.level.normal);
                // Where up · normal is the square of the sine between both planes.
                let steep = up.dot(level.normal);
                let foot = *center - up * (level.height(*center) / steep);
                let half2 = radius * radius - foot.distance_squared(*center);
                let half = along.try_normalize()? * half2.max(0.0).sqrt();
                (half2 > 0.0).then_some([foot - half, foot + half])
            }
        }
    }
}

/// The part that two stretches of one line have in common.
pub(crate) fn overlap([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> Option<[DVec3; 2]> {
    let along = (b - a).try_normalize()?;
    let length = (b - a).dot(along);
    let [from, to] = [c, d].map(|p| (p - a).dot(along));
    let (from, to) = (from.min(to).max(0.0), from.max(to).min(length));
    (from < to).then(|| [a + along * from, a + along * to])
}
