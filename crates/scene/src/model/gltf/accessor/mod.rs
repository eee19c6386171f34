//! Which numbers does an accessor give? Everything is checked against the bytes that are there before anything is reserved.

mod rows;

use rows::{Component, Rows};

use super::buffers::{Buffers, View};
use super::json::{self, Document, Whole, entry};
use super::limits::Limits;
use super::refusal::{Refusal, Within};
use super::source::Source;

/// Which rows of an accessor are wanted.
#[derive(Debug, Clone, Copy)]
pub(super) enum Which<'a> {
    /// All of them.
    All,
    /// These, in ascending order.
    These(&'a [u32]),
}

/// Rows of numbers.
#[derive(Debug)]
pub(super) struct Accessor<'a> {
    count: usize,
    component: Component,
    /// Numbers of a row.
    lanes: usize,
    normalized: bool,
    /// `None` stands for zeros.
    rows: Option<Rows<'a>>,
    sparse: Option<Sparse<'a>>,
}

/// Rows that stand in the place of others.
#[derive(Debug)]
struct Sparse<'a> {
    /// Which ones, in ascending order.
    places: Vec<u32>,
    rows: Rows<'a>,
}

/// The types of accessors, and how many numbers a row has.
const KINDS: &[(&str, usize)] =
    &[("SCALAR", 1), ("VEC2", 2), ("VEC3", 3), ("VEC4", 4), ("MAT2", 4), ("MAT3", 9), ("MAT4", 16)];

impl Source<'_> {
    /// The accessor at a place of the file's list.
    ///
    /// # Errors
    /// None is there, its type is unknown, or its rows reach beyond the bytes of their buffer.
    pub(super) fn accessor(&self, index: Whole) -> Result<Accessor<'_>, Refusal> {
        accessor(self.document, &self.buffers, &self.limits, index).referred()
    }
}

fn accessor<'a>(
    document: &Document,
    buffers: &'a Buffers<'_>,
    limits: &Limits,
    index: Whole,
) -> Result<Accessor<'a>, Refusal> {
    let given = entry(&document.accessors, index, "accessors")?;
    open(given, buffers, limits).within(|| format!("accessors[{index}]"))
}

fn open<'a>(
    given: &json::Accessor,
    buffers: &'a Buffers<'_>,
    limits: &Limits,
) -> Result<Accessor<'a>, Refusal> {
    let component = Component::of(given.component_type)?;
    let lanes = KINDS.iter().find(|(name, _)| *name == given.kind).map(|(_, lanes)| *lanes);
    let Some(lanes) = lanes else {
        return Err(Refusal::new(format!("the type \"{}\" is not known", given.kind)));
    };
    let size = lanes * component.size();
    if given.count.0 > u64::from(u32::MAX) {
        return Err(Refusal::new(format!("a count of {} is more than can be read", given.count)));
    }
    let count = given.count.index();
    let rows = match given.buffer_view {
        Some(view) => {
            let found = buffers.view(view)?;
            Some(
                rows(found, given.byte_offset, [count, size])
                    .within(|| format!("bufferViews[{view}]"))
                    .referred()?,
            )
        }
        None => {
            limits.allow_zeros(count as u64, (lanes * size_of::<f32>()) as u64)?;
            None
        }
    };
    let sparse = match &given.sparse {
        Some(sparse) => Some(open_sparse(sparse, count, size, buffers).within(|| "sparse".to_owned())?),
        None => None,
    };
    Ok(Accessor { count, component, lanes, normalized: given.normalized, rows, sparse })
}

/// `count` rows of `size` bytes each.
fn rows(view: View<'_>, offset: Whole, [count, size]: [usize; 2]) -> Result<Rows<'_>, Refusal> {
    let stride = view.stride.unwrap_or(size);
    let bytes = view.bytes.get(offset.index()..).unwrap_or_default();
    Rows::new(bytes, stride, [count, size]).ok_or_else(|| {
        Refusal::new(format!(
            "{count} rows of {size} bytes, {stride} bytes apart, from byte {offset} on do not fit its {} bytes",
            view.bytes.len()
        ))
    })
}

fn open_sparse<'a>(
    sparse: &json::Sparse,
    count: usize,
    size: usize,
    buffers: &'a Buffers<'_>,
) -> Result<Sparse<'a>, Refusal> {
    let many = sparse.count.index();
    let component = Component::of(sparse.indices.component_type)?;
    let found = buffers.view(sparse.indices.buffer_view)?;
    let places = rows(found, sparse.indices.byte_offset, [many, component.size()])
        .and_then(|rows| component.whole(rows, Which::All))
        .within(|| "indices".to_owned())?;
    let are_in_order = places.is_sorted_by(|a, b| a < b);
    if !are_in_order || places.last().is_some_and(|&last| last as usize >= count) {
        return Err(Refusal::new(format!("its indices must grow and lie below the count of {count}")));
    }
    let found = View { stride: None, ..buffers.view(sparse.values.buffer_view)? };
    let rows = rows(found, sparse.values.byte_offset, [many, size]).within(|| "values".to_owned())?;
    Ok(Sparse { places, rows })
}

impl Accessor<'_> {
    /// How many rows there are.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Rows as `f32`; whole numbers that are normalised as shares of their range. Numbers that a row lacks are 1.
    ///
    /// # Errors
    /// Rows of fewer numbers than `least`, or of more than `N`.
    pub(super) fn floats<const N: usize>(
        &self,
        least: usize,
        which: Which<'_>,
    ) -> Result<Vec<[f32; N]>, Refusal> {
        if !(least..=N).contains(&self.lanes) {
            let wanted = if least == N { N.to_string() } else { format!("{least} to {N}") };
            return Err(Refusal::new(format!("has rows of {} numbers, {wanted} are needed", self.lanes)));
        }
        let read = |rows: Rows<'_>, which: Which<'_>| {
            self.component.floats::<N>(rows, which, self.lanes, self.normalized)
        };
        let mut out = match self.rows {
            Some(rows) => read(rows, which),
            None => vec![std::array::from_fn(|i| if i < self.lanes { 0.0 } else { 1.0 }); self.chosen(which)],
        };
        if let Some(sparse) = &self.sparse {
            sparse.put(&mut out, &read(sparse.rows, Which::All), which);
        }
        Ok(out)
    }

    /// Rows of one whole number each.
    ///
    /// # Errors
    /// Rows of more numbers, or numbers that are not whole.
    pub(super) fn whole(&self) -> Result<Vec<u32>, Refusal> {
        if self.lanes != 1 {
            return Err(Refusal::new(format!("has rows of {} numbers, 1 is needed", self.lanes)));
        }
        let mut out = match self.rows {
            Some(rows) => self.component.whole(rows, Which::All)?,
            None => vec![0; self.count],
        };
        if let Some(sparse) = &self.sparse {
            sparse.put(&mut out, &self.component.whole(sparse.rows, Which::All)?, Which::All);
        }
        Ok(out)
    }

    fn chosen(&self, which: Which<'_>) -> usize {
        match which {
            Which::All => self.count,
            Which::These(these) => these.len(),
        }
    }
}

impl Sparse<'_> {
    /// Puts rows in the place of others, where those were wanted.
    fn put<T: Copy>(&self, out: &mut [T], rows: &[T], which: Which<'_>) {
        for (&place, &row) in self.places.iter().zip(rows) {
            let at = match which {
                Which::All => Some(place as usize),
                Which::These(these) => these.binary_search(&place).ok(),
            };
            if let Some(slot) = at.and_then(|at| out.get_mut(at)) {
                *slot = row;
            }
        }
    }
}
