//! Software prefetch.

use prefetch_index::prefetch_index;

/// Bytes of a line of the caches.
const LINE: usize = 64;

/// Asks for all of element `at` of a slice of `T`, whole lines each; `first` is what the first element begins with.
/// Nothing is read, so no bounds check is needed, and one beyond the end does no harm.
#[inline(always)]
pub(crate) fn prefetch<T, P>(first: &[P], at: usize) {
    let (lines, parts) = (size_of::<T>() / LINE, LINE / size_of::<P>());
    for line in 0..lines {
        prefetch_index(first, (at * lines + line) * parts);
    }
}
