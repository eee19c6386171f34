//! How do arbitrary bytes become shapes and rays?
//!
//! Numbers are drawn so that those meet which must not be confused: small whole numbers, bit patterns of `f32`, numbers
//! that have come before, and their neighbours.

pub mod model;

use catoptra_core::geometry::{Cuboid, Disk, Plane, Rectangle, Sphere, Tetrahedron, Triangle};
use catoptra_core::glam::DVec3;
use catoptra_core::{InvalidPart, Placement, Ray, Shape};

/// Bytes to be used up.
pub struct Bytes<'a> {
    left: &'a [u8],
    seen: Vec<f64>,
}

impl<'a> Bytes<'a> {
    /// All of `bytes`.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { left: bytes, seen: Vec::new() }
    }

    /// Whether there are any left.
    pub fn any_left(&self) -> bool {
        !self.left.is_empty()
    }

    /// The next; 0 past the end.
    pub fn byte(&mut self) -> u8 {
        match self.left.split_first() {
            Some((&byte, rest)) => {
                self.left = rest;
                byte
            }
            None => 0,
        }
    }

    fn number(&mut self) -> f64 {
        let kind = self.byte();
        let again = |seen: &[f64]| {
            seen.get(usize::from(kind >> 3) % seen.len().max(1)).copied().unwrap_or(1.0) as f32
        };
        let number = match kind & 7 {
            0 | 1 => f64::from(self.byte() as i8),
            2 => f64::from(self.byte() as i8) / 16.0,
            3 => f64::from(f32::from_bits(u32::from_le_bytes([
                self.byte(),
                self.byte(),
                self.byte(),
                self.byte(),
            ]))),
            4 => f64::from(self.byte() as i8) * 2.0_f64.powi(i32::from(self.byte() as i8)),
            5 => f64::from(again(&self.seen)),
            6 => f64::from(again(&self.seen).next_up()),
            _ => f64::from(again(&self.seen).next_down()),
        };
        self.seen.push(number);
        number
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    /// A ray, which may be none.
    pub fn ray(&mut self) -> Ray {
        let (origin, towards) = (self.point(), self.point());
        // As often at a point that was given as along a direction.
        let direction = if self.byte() & 1 == 0 { towards - origin } else { towards };
        Ray::new(origin, direction)
    }

    /// A shape, unless its constructor refuses it; placed somewhere now and then.
    pub fn shape(&mut self) -> Option<Shape> {
        let kind = self.byte();
        let shape = match kind % 7 {
            0 => made(Triangle::new(self.point(), self.point(), self.point())),
            1 => made(Sphere::new(self.point(), self.number())),
            2 => made(Plane::new(self.point(), self.point())),
            3 => made(Cuboid::new(self.point(), self.point())),
            4 => made(Rectangle::new(self.point(), self.point(), self.point())),
            5 => made(Disk::new(self.point(), self.point(), self.number())),
            _ => made(Tetrahedron::new(self.point(), self.point(), self.point(), self.point())),
        }?;
        if kind < 128 {
            return Some(shape);
        }
        let turned = Placement::IDENTITY.turned(DVec3::ZERO, self.point(), self.number()).ok()?;
        let placement = turned.scaled(self.number().abs()).and_then(|p| p.moved(self.point())).ok()?;
        let placed = shape.placed(&placement);
        // What a placement carries beyond the numbers there are is no shape.
        let finite = |shape: &Shape| match shape {
            Shape::Plane(plane) => plane.point().is_finite(),
            shape => shape
                .bounds()
                .is_some_and(|b| b.min.is_finite() && b.max.is_finite() && b.min.cmplt(b.max).any()),
        };
        Some(placed).filter(finite)
    }
}

fn made(shape: Result<impl Into<Shape>, InvalidPart>) -> Option<Shape> {
    shape.ok().map(Into::into)
}
