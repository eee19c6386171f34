//! How scene text follows its scene: which pieces of the text change when the scene has changed.
//!
//! The text is never printed anew. Every difference between what the text says and what the scene holds becomes a
//! [`Splice`], so that all else (comments, order, blank lines, the spelling of numbers that did not change) stays
//! as it was, to the byte.

mod edit;
mod flags;
mod full;
mod layout;
mod node;
mod paint;
mod parts;
mod placement;
mod splice;
mod tree;
mod value;

pub(crate) use full::in_full;
pub(crate) use parts::{edit_parts, remove_parts};
pub(crate) use splice::{Splice, apply};
pub(crate) use tree::{Brought, arrange, remove};

pub(crate) use edit::edit;
pub(crate) use layout::INDENT;
pub(crate) use value::{number, quoted};
