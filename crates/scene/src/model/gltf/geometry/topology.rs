//! Which triangles does a primitive have? Section 3.7.2.1 of the specification.

use crate::model::gltf::refusal::Refusal;

/// How corners are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Topology {
    /// Three corners each.
    List,
    /// Each corner with the two before it.
    Strip,
    /// Each two corners with the first one.
    Fan,
}

/// What a primitive is by its mode.
pub(crate) enum Mode {
    Triangles(Topology),
    /// What has no surface: points or lines.
    Thin,
}

impl Mode {
    /// # Errors
    /// A number that no mode has.
    pub(crate) fn of(number: u64) -> Result<Self, Refusal> {
        match number {
            0..=3 => Ok(Self::Thin),
            4 => Ok(Self::Triangles(Topology::List)),
            5 => Ok(Self::Triangles(Topology::Strip)),
            6 => Ok(Self::Triangles(Topology::Fan)),
            other => Err(Refusal::new(format!("the mode {other} is not known"))),
        }
    }
}

impl Topology {
    /// How many triangles so many corners make; corners that are left over make none.
    pub(crate) fn count(self, corners: usize) -> usize {
        match self {
            Self::List => corners / 3,
            Self::Strip | Self::Fan => corners.saturating_sub(2),
        }
    }

    /// Triangles, anticlockwise as seen from outside, of corners in their order.
    pub(crate) fn triangles(self, corner: impl Fn(usize) -> u32, corners: usize) -> Vec<[u32; 3]> {
        (0..self.count(corners)).map(|i| self.places(i).map(&corner)).collect()
    }

    /// Which corners triangle number `i` has.
    fn places(self, i: usize) -> [usize; 3] {
        match self {
            Self::List => [3 * i, 3 * i + 1, 3 * i + 2],
            Self::Strip => [i, i + 1 + i % 2, i + 2 - i % 2],
            Self::Fan => [i + 1, i + 2, 0],
        }
    }
}
