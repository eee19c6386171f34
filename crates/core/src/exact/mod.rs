//! How is a question about a ray answered for certain? One formula over any kind of [`Number`], first with numbers
//! that carry error bounds, then, where those cannot decide, with exact ones.
//!
//! Every `f64` is a whole number times a power of two, so sums and products of them are too, and the sign of a
//! polynomial in them can be had without any rounding. That is slow and almost never needed: [`Bounded`] carries a
//! running bound on its error, operation by operation, and is replaced by [`Dyadic`] only where the bound reaches zero.
//! (Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", Discrete &
//! Computational Geometry 18, 1997, has the same plan with static bounds and expansions; those need more care at the
//! ends of the exponent range, where whole numbers need none.)

mod bounded;
mod determinant;
mod dyadic;
mod enclosed;
mod isolated;
mod polynomial;
mod root;
mod vector;

use std::cell::Cell;
use std::cmp::Ordering;

use smallvec::SmallVec;

pub use bounded::Bounded;
pub use determinant::{Difference, sign_of_determinant};
pub use dyadic::Dyadic;
pub use isolated::Isolated;
pub use root::{Located, Radical, Root};
pub use vector::Vector;

use crate::Span;

/// The numbers at hand are too coarse to answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Undecided;

/// An answer, unless the numbers at hand are too coarse.
pub type Verdict<T> = Result<T, Undecided>;

/// What a formula of geometry needs of its numbers. Exact ones always decide.
pub trait Number: Clone {
    /// Whether nothing is ever rounded.
    const EXACT: bool;

    /// A finite number as it is.
    fn of(value: f64) -> Self;

    /// `self + other`.
    #[must_use]
    fn plus(&self, other: &Self) -> Self;

    /// `self − other`.
    #[must_use]
    fn minus(&self, other: &Self) -> Self;

    /// `self × other`.
    #[must_use]
    fn times(&self, other: &Self) -> Self;

    /// `−self`.
    #[must_use]
    fn negative(&self) -> Self;

    /// How it compares with zero.
    ///
    /// # Errors
    /// When its error reaches beyond zero.
    fn sign(&self) -> Verdict<Ordering>;

    /// How `a × b` compares with `c × d`.
    ///
    /// # Errors
    /// When their errors overlap.
    fn compare_products([a, b]: [&Self; 2], [c, d]: [&Self; 2]) -> Verdict<Ordering> {
        a.times(b).minus(&c.times(d)).sign()
    }

    /// How `a + b √s + c √r` compares with zero; `s` and `r` are not negative.
    ///
    /// # Errors
    /// When the error of the sum reaches beyond zero.
    fn sign_with_roots(terms: [&Self; 3], roots: [&Self; 2]) -> Verdict<Ordering>;

    /// Where on a ray a root lies, if it lies on the stretch.
    ///
    /// # Errors
    /// When the root may or may not lie on the stretch, or is not known as well as
    /// [`ROOT_PRECISION`](crate::numeric::ROOT_PRECISION) requires.
    fn locate(root: &Root<Self>, span: Span) -> Verdict<Option<Located>>;

    /// Passes on the roots of the polynomial with these coefficients, from the constant one upwards, that lie between −`reach`
    /// and `reach`, a power of two, in order, until one is taken. Exact numbers may pass on those beyond.
    ///
    /// # Errors
    /// When the errors of such numbers hide how many roots there are, or what `take` says of one.
    fn find_root<T>(
        coefficients: &[Self; 5],
        reach: f64,
        take: impl FnMut(Root<Self>) -> Verdict<Option<T>>,
    ) -> Verdict<Option<T>>;

    /// Where the polynomial with these coefficients changes its sign, in order; as for [`find_root`](Self::find_root).
    ///
    /// # Errors
    /// When the errors of such numbers hide how many roots there are.
    fn sign_changes(coefficients: &[Self; 5], reach: f64) -> Verdict<SmallVec<[Root<Self>; 4]>> {
        let mut found = SmallVec::new();
        // Numbers with errors find none but simple roots.
        Self::find_root(coefficients, reach, |root| {
            found.push(root);
            Ok(None::<()>)
        })?;
        Ok(found)
    }

    /// How two roots compare of which one is [isolated](Root::isolated).
    ///
    /// # Errors
    /// As for [`Root::compare`].
    fn compare_isolated(a: &Root<Self>, b: &Root<Self>) -> Verdict<Ordering>;

    /// Its square.
    #[must_use]
    fn squared(&self) -> Self {
        self.times(self)
    }
}

/// Answers that `f64` could not give, counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Answers {
    /// By exact arithmetic, whatever was asked.
    pub exact: u64,
    /// Of those, on which side of a line an edge passes, or whether points lie in one plane.
    pub sides: u64,
    /// Of those, which of two places on a ray comes first.
    pub orders: u64,
    /// Triangles that a ray was seen to meet at one point, so that no order had to be worked out.
    pub ties: u64,
}

impl std::ops::Sub for Answers {
    type Output = Self;

    fn sub(self, before: Self) -> Self {
        Self {
            exact: self.exact - before.exact,
            sides: self.sides - before.sides,
            orders: self.orders - before.orders,
            ties: self.ties - before.ties,
        }
    }
}

thread_local! {
    static ANSWERS: Cell<Answers> = const { Cell::new(Answers { exact: 0, sides: 0, orders: 0, ties: 0 }) };
}

/// What this thread has answered beyond `f64` since it started.
#[must_use]
pub fn answers() -> Answers {
    ANSWERS.get()
}

/// Counts triangles that are seen to be met together.
pub(crate) fn count_tie() {
    ANSWERS.set(Answers { ties: ANSWERS.get().ties + 1, ..ANSWERS.get() });
}

/// Counts a side that was answered exactly, beside the answer itself.
fn count_side() {
    ANSWERS.set(Answers { sides: ANSWERS.get().sides + 1, ..ANSWERS.get() });
}

/// Counts an order of two places that was answered exactly, beside the answer itself.
pub(crate) fn count_order() {
    ANSWERS.set(Answers { orders: ANSWERS.get().orders + 1, ..ANSWERS.get() });
}

/// The answer of numbers that know their error, or where they have none, of exact arithmetic.
#[inline]
pub fn decide<T>(
    bounded: impl FnOnce() -> Verdict<Option<T>>,
    exact: impl FnOnce() -> Verdict<Option<T>>,
) -> Option<T> {
    bounded().unwrap_or_else(|Undecided| exactly(exact))
}

/// Answers by exact arithmetic, and counts it.
#[cold]
#[inline(never)]
fn exactly<T>(exact: impl FnOnce() -> Verdict<Option<T>>) -> Option<T> {
    answer_exactly(exact).unwrap_or(None)
}

/// Counts an answer of exact arithmetic.
fn answer_exactly<T>(answer: impl FnOnce() -> T) -> T {
    ANSWERS.set(Answers { exact: ANSWERS.get().exact + 1, ..ANSWERS.get() });
    answer()
}
