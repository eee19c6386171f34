//! How do bytes become numbers?

use super::Which;
use crate::model::gltf::json::Whole;
use crate::model::gltf::refusal::Refusal;

/// Rows that all lie within their bytes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rows<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    count: usize,
}

impl<'a> Rows<'a> {
    /// `None` where they reach beyond the bytes.
    pub(super) fn new(bytes: &'a [u8], stride: usize, [count, size]: [usize; 2]) -> Option<Self> {
        let end = match count.checked_sub(1) {
            Some(last) => last.checked_mul(stride)?.checked_add(size)?,
            None => 0,
        };
        (end <= bytes.len()).then_some(Self { bytes, stride, size, count })
    }

    /// Each of them, or those that are wanted; wanted ones that are not there are left out.
    fn each<T>(self, which: Which<'_>, read: impl Fn(&[u8]) -> T) -> Vec<T> {
        let row = |i: usize| {
            let start = i.checked_mul(self.stride)?;
            self.bytes.get(start..)?.get(..self.size)
        };
        match which {
            Which::All if self.stride == self.size => {
                self.bytes.chunks_exact(self.size).take(self.count).map(read).collect()
            }
            Which::All => (0..self.count).filter_map(row).map(read).collect(),
            Which::These(these) => these.iter().filter_map(|&i| row(i as usize)).map(read).collect(),
        }
    }
}

/// How a number is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

/// A number as it is kept.
trait Kept<const SIZE: usize>: Copy {
    fn of(bytes: [u8; SIZE]) -> Self;
    /// As it is.
    fn plain(self) -> f32;
    /// As a share of its range: −1..=1 or 0..=1.
    fn share(self) -> f32;
}

macro_rules! kept {
    ($($kept:ty, $size:literal, $share:expr;)+) => {$(
        impl Kept<$size> for $kept {
            #[inline(always)]
            fn of(bytes: [u8; $size]) -> Self {
                <$kept>::from_le_bytes(bytes)
            }
            #[inline(always)]
            fn plain(self) -> f32 {
                self as f32
            }
            #[inline(always)]
            fn share(self) -> f32 {
                let share: fn(f32) -> f32 = $share;
                share(self as f32)
            }
        }
    )+};
}

// Section 3.11 of the specification.
kept! {
    i8, 1, |v| (v / 127.0).max(-1.0);
    u8, 1, |v| v / 255.0;
    i16, 2, |v| (v / 32767.0).max(-1.0);
    u16, 2, |v| v / 65535.0;
    u32, 4, |v| v / 4_294_967_295.0;
    f32, 4, |v| v;
}

impl Component {
    /// By its number in the file.
    pub(super) fn of(number: Whole) -> Result<Self, Refusal> {
        Ok(match number.0 {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            other => return Err(Refusal::new(format!("the componentType {other} is not known"))),
        })
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// Rows of `lanes` numbers; those that they lack are 1.
    pub(super) fn floats<const N: usize>(
        self,
        rows: Rows<'_>,
        which: Which<'_>,
        lanes: usize,
        normalized: bool,
    ) -> Vec<[f32; N]> {
        match self {
            Self::I8 => floats::<i8, 1, N>(rows, which, lanes, normalized),
            Self::U8 => floats::<u8, 1, N>(rows, which, lanes, normalized),
            Self::I16 => floats::<i16, 2, N>(rows, which, lanes, normalized),
            Self::U16 => floats::<u16, 2, N>(rows, which, lanes, normalized),
            Self::U32 => floats::<u32, 4, N>(rows, which, lanes, normalized),
            Self::F32 => floats::<f32, 4, N>(rows, which, lanes, normalized),
        }
    }

    /// Rows of one whole number each.
    pub(super) fn whole(self, rows: Rows<'_>, which: Which<'_>) -> Result<Vec<u32>, Refusal> {
        match self {
            Self::U8 => Ok(rows.each(which, |row| row.first().map_or(0, |&v| u32::from(v)))),
            Self::U16 => {
                let read = |row: &[u8]| row.first_chunk().map_or(0, |&bytes| u16::from_le_bytes(bytes));
                Ok(rows.each(which, |row| u32::from(read(row))))
            }
            Self::U32 => {
                Ok(rows.each(which, |row| row.first_chunk().map_or(0, |&bytes| u32::from_le_bytes(bytes))))
            }
            Self::I8 | Self::I16 | Self::F32 => {
                Err(Refusal::new("its numbers must be whole and have no sign"))
            }
        }
    }
}

fn floats<K: Kept<SIZE>, const SIZE: usize, const N: usize>(
    rows: Rows<'_>,
    which: Which<'_>,
    lanes: usize,
    normalized: bool,
) -> Vec<[f32; N]> {
    let read = |row: &[u8], value: fn(K) -> f32| {
        let mut out = [1.0; N];
        for (slot, bytes) in out.iter_mut().take(lanes).zip(row.as_chunks::<SIZE>().0) {
            *slot = value(K::of(*bytes));
        }
        out
    };
    if normalized {
        rows.each(which, |row| read(row, K::share))
    } else {
        rows.each(which, |row| read(row, K::plain))
    }
}
