//! Columns of numbers, aligned to cache lines so that no packet's part of them straddles two lines.

use std::ops::{Deref, DerefMut};

use aligned_vec::AVec;

/// A growing list.
#[derive(Debug, Clone)]
pub(crate) struct Column<T>(AVec<T>);

impl<T: Clone> Column<T> {
    /// So many of one value, where there is memory for them.
    pub(crate) fn try_filled(length: usize, value: T) -> Option<Self> {
        let mut column = Self::default();
        column.0.try_reserve_exact(length).ok()?;
        column.resize(length, value);
        Some(column)
    }

    /// Cuts off or adds as many of a value as make up a length.
    pub(crate) fn resize(&mut self, length: usize, value: T) {
        self.0.resize(length, value);
    }
}

impl<T> Default for Column<T> {
    fn default() -> Self {
        // 0 means the least alignment of the type, which is a cache line.
        Self(AVec::new(0))
    }
}

impl<T> Deref for Column<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T> DerefMut for Column<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_there_is_gives_no_column() {
        assert!(Column::try_filled(1 << 58, 1.0_f32).is_none());
    }

    #[test]
    fn a_column_begins_with_a_cache_line_however_it_has_grown() {
        let mut columns: Vec<Column<f32>> = (0..9).filter_map(|i| Column::try_filled(i, 1.0)).collect();
        for column in &mut columns {
            for length in [17, 300, 5000] {
                column.resize(length, 2.0);
                assert_eq!(column.as_ptr().addr() % 64, 0);
            }
        }
        assert_eq!((columns[8][7], columns[8][8]), (1.0, 2.0));
    }
}
