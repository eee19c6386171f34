//! How is a texture laid onto a surface: by which coordinates, and how scaled, turned and moved?

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::TexturePoint;
use crate::part::Given;
use crate::{Field, FieldKind, InvalidPart, Value, Values};

/// What gives a texture its coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mapping {
    /// The surface's own texture coordinates.
    Uv,
    /// Position, from above: u = x, v = −z.
    Planar,
    /// Position, along the axis that the surface faces most: the other two, so that nothing is mirrored as seen from outside.
    Box,
    /// Longitude and latitude round the y axis: u = 1/2 + atan2(x, z) / 2π, v = 1/2 + latitude / π.
    Spherical,
    /// Position, all three coordinates: the pattern fills space. Only for patterns that do.
    Position,
}

const FLAT: [Mapping; 4] = [Mapping::Uv, Mapping::Planar, Mapping::Box, Mapping::Spherical];
const FLAT_WORDS: &[&str] = &["uv", "planar", "box", "spherical"];
const SOLID: [Mapping; 5] =
    [Mapping::Position, Mapping::Uv, Mapping::Planar, Mapping::Box, Mapping::Spherical];
const SOLID_WORDS: &[&str] = &["position", "uv", "planar", "box", "spherical"];

/// Coordinates for a texture: those of its mapping, times `scale`, turned counterclockwise by `turn` radians, plus `offset`.
/// Of a [`Position`](Mapping::Position), x and z are scaled by the first, y by the second number, turned about y, and x and y
/// moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Transform {
    mapping: Mapping,
    scale: DVec2,
    offset: DVec2,
    turn: f64,
    /// Cosine and sine of `turn`.
    way: DVec2,
}

/// Where a flat texture is looked up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flat {
    pub(super) uv: DVec2,
    /// How far that moves over a pixel to the right and one down.
    pub(super) footprint: Option<[DVec2; 2]>,
}

/// Where a texture that fills space is looked up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Solid {
    pub(super) position: DVec3,
    /// How far that moves over a pixel to the right and one down.
    pub(super) spread: [DVec3; 2],
}

impl Solid {
    /// The same in finer or coarser units.
    pub(super) fn times(&self, factor: f64) -> Self {
        Self { position: self.position * factor, spread: self.spread.map(|side| side * factor) }
    }
}

impl Transform {
    pub(super) const MAPPING: Field =
        Field::required("mapping", FieldKind::Choice(FLAT_WORDS), "", "What gives it its coordinates.")
            .or(|| Value::Word("uv".to_owned()));
    /// As [`MAPPING`](Self::MAPPING), for patterns that fill space.
    pub(super) const SOLID_MAPPING: Field =
        Field::required("mapping", FieldKind::Choice(SOLID_WORDS), "", "What gives it its coordinates.")
            .or(|| Value::Word("position".to_owned()));
    pub(super) const SCALE: Field =
        Field::required("scale", FieldKind::Pair, "", "What the coordinates are multiplied by, not 0.")
            .or(|| Value::Pair(DVec2::ONE));
    pub(super) const OFFSET: Field =
        Field::required("offset", FieldKind::Pair, "", "What is added to the coordinates at last.")
            .or(|| Value::Pair(DVec2::ZERO));
    pub(super) const TURN: Field =
        Field::required("turn", FieldKind::Angle, "°", "What the scaled coordinates are turned by.")
            .or(|| Value::Number(0.0));

    /// As given.
    ///
    /// # Errors
    /// A value that is refused.
    pub(super) fn given(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Self::made(given, FLAT[given.choice("mapping")?])
    }

    /// As given, for patterns that fill space.
    ///
    /// # Errors
    /// A value that is refused.
    pub(super) fn given_solid(given: &Given<'_>) -> Result<Self, InvalidPart> {
        Self::made(given, SOLID[given.choice("mapping")?])
    }

    fn made(given: &Given<'_>, mapping: Mapping) -> Result<Self, InvalidPart> {
        let (scale, turn) = (given.pair("scale")?, given.number("turn")?);
        if scale.x == 0.0 || scale.y == 0.0 {
            return Err(InvalidPart::new("scale", "must not be 0", format!("{} {}", scale.x, scale.y)));
        }
        Ok(Self { mapping, scale, offset: given.pair("offset")?, turn, way: DVec2::from_angle(turn) })
    }

    /// Adds its values to those of a texture.
    pub(super) fn values(&self, values: Values) -> Values {
        let word = match self.mapping {
            Mapping::Uv => "uv",
            Mapping::Planar => "planar",
            Mapping::Box => "box",
            Mapping::Spherical => "spherical",
            Mapping::Position => "position",
        };
        values
            .with("mapping", Value::Word(word.to_owned()))
            .with("scale", Value::Pair(self.scale))
            .with("offset", Value::Pair(self.offset))
            .with("turn", Value::Number(self.turn))
    }

    /// Where a flat texture is looked up.
    pub(super) fn flat(&self, at: &TexturePoint) -> Flat {
        let Flat { uv, footprint } = self.mapped(at);
        let linear = |v: DVec2| self.way.rotate(v * self.scale);
        Flat { uv: linear(uv) + self.offset, footprint: footprint.map(|sides| sides.map(linear)) }
    }

    /// Where a texture that fills space is looked up. A flat mapping asks it in the plane z = 0.
    pub(super) fn solid(&self, at: &TexturePoint) -> Solid {
        if self.mapping != Mapping::Position {
            let flat = self.flat(at);
            let spread = flat.footprint.unwrap_or_default().map(|side| side.extend(0.0));
            return Solid { position: flat.uv.extend(0.0), spread };
        }
        let linear = |p: DVec3| {
            let turned = self.way.rotate(DVec2::new(p.z, p.x) * self.scale.x);
            DVec3::new(turned.y, p.y * self.scale.y, turned.x)
        };
        let spread = at.spread.unwrap_or_default().map(linear);
        Solid { position: linear(at.position) + self.offset.extend(0.0), spread }
    }

    /// The coordinates of the mapping alone.
    fn mapped(&self, at: &TexturePoint) -> Flat {
        let by = |linear: &dyn Fn(DVec3) -> DVec2| Flat {
            uv: linear(at.position),
            footprint: at.spread.map(|sides| sides.map(linear)),
        };
        match self.mapping {
            Mapping::Uv | Mapping::Position => Flat { uv: at.uv, footprint: at.footprint },
            Mapping::Planar => by(&from_above),
            Mapping::Box => by(&|p| facing(p, at.normal)),
            Mapping::Spherical => Flat {
                uv: longitude_and_latitude(at.position),
                footprint: at.spread.map(|sides| sides.map(|side| along_sphere(at.position, side))),
            },
        }
    }
}

fn from_above(p: DVec3) -> DVec2 {
    DVec2::new(p.x, -p.z)
}

/// The two coordinates across the axis that a normal is nearest to.
pub(crate) fn facing(p: DVec3, normal: DVec3) -> DVec2 {
    let size = normal.abs();
    if size.y >= size.x && size.y >= size.z {
        DVec2::new(p.x, if normal.y < 0.0 { p.z } else { -p.z })
    } else if size.x >= size.z {
        DVec2::new(if normal.x < 0.0 { p.z } else { -p.z }, p.y)
    } else {
        DVec2::new(if normal.z < 0.0 { -p.x } else { p.x }, p.y)
    }
}

/// Longitude and latitude of a direction round the y axis, in 0..=1; +z is the middle.
pub(crate) fn longitude_and_latitude(p: DVec3) -> DVec2 {
    DVec2::new(0.5 + p.x.atan2(p.z) / TAU, 0.5 + p.y.atan2(p.x.hypot(p.z)) / PI)
}

/// How far longitude and latitude move when the point moves a little.
fn along_sphere(p: DVec3, side: DVec3) -> DVec2 {
    let across = p.x.hypot(p.z).max(f64::MIN_POSITIVE);
    let (sine, cosine) = (p.x / across, p.z / across);
    let outwards = sine * side.x + cosine * side.z;
    let distance2 = (across * across + p.y * p.y).max(f64::MIN_POSITIVE);
    let longitude = (cosine * side.x - sine * side.z) / across;
    DVec2::new(longitude / TAU, (across * side.y - p.y * outwards) / distance2 / PI)
}
