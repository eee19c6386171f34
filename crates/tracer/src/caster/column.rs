//! As what may points and directions of many rays be given?

use std::ops::Range;

use catoptra_core::glam::{DVec3, Vec3};

use crate::rays::RAYS_PER_BLOCK;

/// What is a point or a direction: `[f64; 3]`, [`DVec3`], and in `f32` `[f32; 3]` and [`Vec3`]. The list is closed.
pub trait Coordinates: sealed::Sealed + Sized {
    #[doc(hidden)]
    fn column(given: &[Self]) -> Column<'_>;
}

mod sealed {
    pub trait Sealed {}
}

/// Points or directions that someone else holds.
#[doc(hidden)]
#[derive(Debug, Clone, Copy)]
pub enum Column<'a> {
    Doubles(&'a [[f64; 3]]),
    DoubleVectors(&'a [DVec3]),
    Singles(&'a [[f32; 3]]),
    SingleVectors(&'a [Vec3]),
}

impl Column<'_> {
    pub(super) fn len(self) -> usize {
        match self {
            Self::Doubles(rows) => rows.len(),
            Self::DoubleVectors(rows) => rows.len(),
            Self::Singles(rows) => rows.len(),
            Self::SingleVectors(rows) => rows.len(),
        }
    }

    /// Writes some of them as a column for each axis, from the first lane on.
    ///
    /// # Panics
    /// More of them than there are, or than there are lanes.
    #[inline(always)]
    pub(super) fn put(self, rows: Range<usize>, columns: &mut [[f64; RAYS_PER_BLOCK]; 3]) {
        match self {
            Self::Doubles(all) => transpose(&all[rows], columns, |row| *row),
            Self::DoubleVectors(all) => transpose(&all[rows], columns, DVec3::to_array),
            Self::Singles(all) => transpose(&all[rows], columns, |row| row.map(f64::from)),
            Self::SingleVectors(all) => transpose(&all[rows], columns, |row| row.to_array().map(f64::from)),
        }
    }

    /// # Panics
    /// A number that is not below the length.
    #[inline(always)]
    pub(super) fn get(self, at: usize) -> DVec3 {
        match self {
            Self::Doubles(rows) => rows[at].into(),
            Self::DoubleVectors(rows) => rows[at],
            Self::Singles(rows) => Vec3::from(rows[at]).as_dvec3(),
            Self::SingleVectors(rows) => rows[at].as_dvec3(),
        }
    }
}

#[inline(always)]
fn transpose<T>(rows: &[T], columns: &mut [[f64; RAYS_PER_BLOCK]; 3], numbers: impl Fn(&T) -> [f64; 3]) {
    for (lane, row) in rows.iter().enumerate() {
        let row = numbers(row);
        for axis in 0..3 {
            columns[axis][lane] = row[axis];
        }
    }
}

macro_rules! coordinates {
    ($($kind:ty => $variant:ident),+ $(,)?) => {
        $(impl sealed::Sealed for $kind {}

        impl Coordinates for $kind {
            fn column(given: &[Self]) -> Column<'_> {
                Column::$variant(given)
            }
        })+
    };
}

coordinates! {
    [f64; 3] => Doubles,
    DVec3 => DoubleVectors,
    [f32; 3] => Singles,
    Vec3 => SingleVectors,
}
