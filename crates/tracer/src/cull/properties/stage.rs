//! Where do shapes stand? Before a random camera, so that they just reach into a region of its picture, or just do not.

use catoptra_core::geometry::{Plane, Sphere, Triangle};
use catoptra_core::glam::DVec3;
use catoptra_core::material::{Matte, Mirror};
use catoptra_core::{Camera, Light, Placement, Raster, Ray, Rgb, Scene, Shape, Span};

use super::super::quarters;
use super::parts::{farthest, hair, moved, one_in, one_of, rim, some_shape};
use crate::random::Random;
use crate::{Frame, Region, Size, Snapshot, View};

/// A camera, parts of its picture one within the other, and how large things are there.
pub(super) struct Stand {
    pub(super) unit: f64,
    pub(super) view: View,
    pub(super) regions: Vec<Region>,
}

impl Stand {
    pub(super) fn random(random: &mut Random) -> Self {
        let unit = random.power(-6, 6);
        let far = if one_in(random, 3) { random.point() * unit * random.power(0, 30) } else { DVec3::ZERO };
        let camera = loop {
            let forward = if one_in(random, 3) { random.axis() * random.number() } else { random.point() };
            let up = if one_in(random, 2) { random.axis() + random.axis() } else { random.point() };
            let eye = far + random.point() * unit * 4.0;
            let camera = Camera::looking(eye, forward, up, random.power(-8, 1));
            if let Ok(camera) = camera {
                break camera;
            }
        };
        let picture = *one_of(random, &[Size::new(64, 64), Size::new(100, 70), Size::new(1920, 1080)]);
        let tile = |random: &mut Random| {
            let x = random.bits() as u32 % picture.width.div_ceil(32) * 32;
            let y = random.bits() as u32 % picture.height.div_ceil(32) * 32;
            Region::new(x, y, Size::new(32, 32)).within(picture)
        };
        let mut regions = vec![if one_in(random, 4) { Region::from(picture) } else { tile(random) }];
        for _ in 0..3 {
            let parts: Vec<Region> = quarters(regions[regions.len() - 1]).collect();
            regions.push(*one_of(random, &parts));
        }
        Self { unit, view: View::new(camera, picture), regions }
    }

    pub(super) fn raster(&self) -> Raster {
        self.view.camera.raster(self.view.size.width, self.view.size.height)
    }
}

/// The corners of a region, one after the other.
fn corners_of(region: &Region) -> [[f64; 2]; 4] {
    let [left, top] = [f64::from(region.x), f64::from(region.y)];
    let [right, bottom] = [left + f64::from(region.size.width), top + f64::from(region.size.height)];
    [[left, top], [right, top], [right, bottom], [left, bottom]]
}

/// Where in a region rays are aimed: mostly at its border and near it.
fn place_in(random: &mut Random, region: &Region) -> [f64; 2] {
    let mut along = |from: u32, length: u32| {
        let share = match random.bits() % 5 {
            0 => 0.0,
            1 => 1.0,
            2 => random.power(-30, -2),
            3 => 1.0 - random.power(-30, -2),
            _ => random.number().abs(),
        };
        f64::from(from) + share * f64::from(length)
    };
    [along(region.x, region.size.width), along(region.y, region.size.height)]
}

/// Where in a region a point is seen, or next to where it is; `None` behind the eye.
fn seen_at(raster: &Raster, region: &Region, point: DVec3) -> Option<[f64; 2]> {
    let normal = raster.across.cross(raster.down);
    let depth = (point - raster.eye).dot(normal) / raster.corner.dot(normal);
    let on_plane = (point - raster.eye) / depth - raster.corner;
    let along = |way: DVec3, from: u32, length: u32| {
        (on_plane.dot(way) / way.length_squared()).clamp(f64::from(from), f64::from(from + length))
    };
    (depth > 0.0).then(|| {
        [along(raster.across, region.x, region.size.width), along(raster.down, region.y, region.size.height)]
    })
}

/// Shapes before a camera, and points at which rays are aimed.
pub(super) struct Stage<'a> {
    pub(super) random: &'a mut Random,
    pub(super) stand: Stand,
    pub(super) shapes: Vec<Shape>,
    pub(super) aims: Vec<DVec3>,
}

impl<'a> Stage<'a> {
    /// With `most` shapes at most.
    pub(super) fn new(random: &'a mut Random, most: u64) -> Self {
        let count = if one_in(random, 2) { 1 + random.bits() % 2 } else { 1 + random.bits() % most };
        let stand = Stand::random(random);
        let mut stage = Self { random, stand, shapes: Vec::new(), aims: Vec::new() };
        for _ in 0..count {
            let shape = stage.place();
            stage.add(shape);
        }
        stage
    }

    /// Adds a shape, and rays aimed at its rim.
    pub(super) fn add(&mut self, shape: Shape) {
        let rim = rim(&shape);
        let middle = rim.iter().sum::<DVec3>() / rim.len().max(1) as f64;
        for _ in 0..4.min(rim.len()) {
            let (a, b) = (*one_of(self.random, &rim), *one_of(self.random, &rim));
            let edge = a.lerp(b, *one_of(self.random, &[0.0, 0.5]));
            self.aims.push(edge.lerp(middle, hair(self.random)));
        }
        self.shapes.push(shape);
    }

    /// A shape somewhere, or where something is met by a hair.
    fn place(&mut self) -> Shape {
        let unit = self.stand.unit;
        let size = unit * self.random.power(-6, 4);
        let shape = some_shape(self.random, size);
        let raster = self.stand.raster();
        let region = *one_of(self.random, &self.stand.regions);
        let [x, y] = place_in(self.random, &region);
        let ray = raster.ray(x, y);
        let at = ray.at(unit * self.random.power(-4, 6));
        match self.random.bits() % 8 {
            0 => moved(&shape, at + self.random.point() * size),
            1 | 2 => self.just_touch(&shape, &ray, at, &region),
            3 | 4 => self.along_edge(&shape, &ray, at),
            5 => self.next_to_eye(&moved(&shape, at), &ray, size),
            6 => self.edge_on(&shape, &ray, at, size),
            _ if one_in(self.random, 2) => moved(&shape, ray.origin + self.random.point() * size),
            _ => self.touching(&shape, at),
        }
    }

    /// Where its last point touches the side of the region's frustum that a point lies on.
    fn just_touch(&mut self, shape: &Shape, ray: &Ray, at: DVec3, region: &Region) -> Shape {
        let raster = self.stand.raster();
        let middle = [
            f64::from(region.x) + f64::from(region.size.width) / 2.0,
            f64::from(region.y) + f64::from(region.size.height) / 2.0,
        ];
        let inwards = raster.ray(middle[0], middle[1]).direction - ray.direction;
        // Perpendicular to the ray and to the nearest side of the picture, or to the direction to the middle.
        let ways = [raster.across, raster.down, inwards.cross(ray.direction)];
        let normal = one_of(self.random, &ways).cross(ray.direction).normalize_or(DVec3::X);
        let inwards = normal * inwards.dot(normal).signum();
        let inwards = if one_in(self.random, 4) { -inwards } else { inwards };
        let size = farthest(shape, inwards).distance(farthest(shape, -inwards));
        let hair = hair(self.random);
        let placed = moved(shape, at + inwards * (size * hair) - farthest(shape, inwards));
        let tip = farthest(&placed, inwards);
        for share in [0.0, 0.125, 0.5] {
            self.aims.push(tip.lerp(tip - inwards * size, hair.abs() * share));
        }
        self.aims.push(at);
        placed
    }

    /// Where an edge, from one point of its rim to another, runs by a point.
    fn along_edge(&mut self, shape: &Shape, ray: &Ray, at: DVec3) -> Shape {
        let rim = rim(shape);
        if rim.is_empty() {
            return moved(shape, at);
        }
        let (a, b) = (*one_of(self.random, &rim), *one_of(self.random, &rim));
        let across = (b - a).cross(ray.direction).normalize_or(DVec3::X);
        let hair = hair(self.random);
        let middle = a.lerp(b, self.random.number().abs());
        self.aims.push(at);
        moved(shape, at + across * (a.distance(b) * hair) - middle)
    }

    /// A shape that takes up the whole of a region, but for a hair at a corner.
    pub(super) fn cover(&mut self, region: &Region) -> Option<Shape> {
        let raster = self.stand.raster();
        let corners = corners_of(region);
        let which = self.random.bits() as usize % 4;
        let [ray, opposite] = [which, which + 2].map(|i| raster.ray(corners[i % 4][0], corners[i % 4][1]));
        let depth = self.stand.unit * self.random.power(-4, 6);
        let (at, along) = (ray.at(depth), ray.direction.normalize());
        let width = (ray.direction - opposite.direction).length() * depth;
        let outwards = (ray.direction - opposite.direction).reject_from(along).normalize_or(DVec3::X);
        let outwards = (outwards + outwards.cross(along) * self.random.number()).normalize();
        let hair = hair(self.random);
        let reach = width * self.random.power(2, 8);
        self.aims.push(at);
        match self.random.bits() % 4 {
            0 => {
                let center = at - outwards * (reach * (1.0 - hair));
                Some(Sphere::new(center, reach).ok()?.into())
            }
            1 => {
                let (rim, edge) = (at + outwards * (width * hair), outwards.cross(along) * reach);
                // Each farther or nearer, which does not show.
                let mut shifted =
                    |corner: DVec3| ray.origin + (corner - ray.origin) * self.random.power(-1, 1);
                let [a, b, c] = [rim - edge, rim + edge, rim - outwards * reach].map(&mut shifted);
                Some(Triangle::new(a, b, c).ok()?.into())
            }
            2 => {
                // All but round the eye.
                let [a, b] = [(); 2].map(|()| self.random.point() * reach);
                let behind = ray.origin + a.cross(b).normalize_or(DVec3::X) * (reach * hair);
                Some(Triangle::new(behind + a, behind + b, behind - a - b).ok()?.into())
            }
            _ if one_in(self.random, 2) => {
                // Two planes, one before the other but for a hair.
                let [a, b] = [(); 2].map(|()| self.random.point());
                self.shapes.extend(Plane::new(at, a).map(Shape::from));
                Some(Plane::new(ray.at(depth * (1.0 + hair)), b).ok()?.into())
            }
            _ => {
                let normal = outwards - along * hair;
                Some(
                    Plane::new(ray.origin - outwards * (depth * self.random.power(-4, 4)), normal)
                        .ok()?
                        .into(),
                )
            }
        }
    }

    /// With its surface just before the eye.
    fn next_to_eye(&mut self, shape: &Shape, ray: &Ray, size: f64) -> Shape {
        let hair = hair(self.random);
        let met = shape.cross(ray, Span::AHEAD, None);
        met.map_or_else(
            || shape.clone(),
            |met| moved(shape, ray.direction.normalize() * (size * hair) - ray.direction * met.t),
        )
    }

    /// Turned so that the plane through three points of its rim all but holds the eye.
    fn edge_on(&mut self, shape: &Shape, ray: &Ray, at: DVec3, size: f64) -> Shape {
        let rim = rim(shape);
        if rim.is_empty() {
            return shape.clone();
        }
        let [a, b, c] = [(); 3].map(|()| *one_of(self.random, &rim));
        let normal = (b - a).cross(c - a).normalize_or(DVec3::X);
        let along = ray.direction.normalize();
        let share = size / at.distance(ray.origin);
        let tilted = normal.reject_from(along) + along * (share * hair(self.random));
        let turned =
            Placement::IDENTITY.turned(DVec3::ZERO, normal.cross(tilted), normal.angle_between(tilted));
        let turned = turned.unwrap_or_default();
        let by = at - turned.point(a.lerp(b, 0.4).lerp(c, 0.3));
        self.aims.extend([at, turned.point(a.lerp(b, 0.01)) + by]);
        moved(&shape.placed(&turned), by)
    }

    /// With a point of its rim on that of another shape.
    fn touching(&mut self, shape: &Shape, at: DVec3) -> Shape {
        let own = farthest(shape, self.random.point().normalize_or(DVec3::X));
        let other = self.aims.last().copied().unwrap_or(at);
        moved(shape, other - own)
    }

    /// Places in a region at which rays are aimed: its corners, where something is met by a hair, and others.
    pub(super) fn places(&mut self, frame: &Frame<'_>, region: &Region) -> Vec<[f64; 2]> {
        let moved = frame.snapshot.frame();
        let aims = self.aims.iter().filter_map(|aim| seen_at(&frame.raster, region, *aim - moved));
        let mut places: Vec<[f64; 2]> = corners_of(region).into_iter().chain(aims).collect();
        places.extend((0..8).map(|_| place_in(self.random, region)));
        places
    }

    /// The rays through them.
    pub(super) fn rays(&mut self, frame: &Frame<'_>, region: &Region) -> Vec<Ray> {
        self.places(frame, region).into_iter().map(|[x, y]| frame.raster.ray(x, y)).collect()
    }

    /// What is traced: all shapes are mirrors, or none is.
    pub(super) fn snapshot(&self, lights: &[Light], mirrors: bool) -> Snapshot {
        snapshot_of(&self.shapes, lights, mirrors, Some(&self.stand.view.camera))
    }
}

/// A snapshot of shapes and lights.
pub(super) fn snapshot_of(
    shapes: &[Shape],
    lights: &[Light],
    mirrors: bool,
    camera: Option<&Camera>,
) -> Snapshot {
    let mut scene = Scene::new();
    let matte = scene.add_material("matte", Matte::new(Rgb::WHITE).unwrap()).unwrap();
    let mirror = scene.add_material("mirror", Mirror::new(Rgb::WHITE).unwrap()).unwrap();
    let worn = if mirrors { mirror } else { matte };
    for (i, shape) in shapes.iter().enumerate() {
        scene.add_shape(&format!("shape {i}"), shape.clone(), worn, None).unwrap();
    }
    for (i, light) in lights.iter().enumerate() {
        scene.add_light(&format!("light {i}"), light.clone(), None).unwrap();
    }
    if let Some(camera) = camera {
        scene.add_camera("camera", camera.clone(), None).unwrap();
    }
    Snapshot::extract(&scene, crate::pool::one_thread())
}
