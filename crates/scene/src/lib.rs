//! How scenes, meshes, profiles and pictures go into files and come out of them.
//!
//! * [`load`] and [`parse`] read scene text (KDL; `scenes/README.md` documents it) into a
//!   [`Scene`](catoptra_core::scene::Scene) and a [`SceneFile`] that keeps the text; [`SceneFile::save`] writes back
//!   only what has changed. The grammar follows the lists of kinds in the core: a new shape, light or material is
//!   read and written without a change here.
//! * [`format()`] lays scene text out by rule.
//! * [`fragment`] makes text of parts of a scene, and adds such text to another.
//! * [`model`] reads models and meshes, [`ies`] how luminaires shine, [`image`] reads and writes PNG pictures.
//! * [`atomic`] writes any file whole or not at all, and says beforehand whether it can, and [`words`] finds the word that a misspelt one was meant to be.
//!
//! Whatever a file holds, reading it ends in a value or in an error that says what, where and what to do: never in a
//! panic. Files are written whole or not at all.
#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test may stop at the first surprise"))]

pub mod atomic;
mod bare;
mod build;
mod disk;
mod excerpt;
mod file;
mod flags;
mod foreign;
mod format;
pub mod fragment;
pub mod ies;
pub mod image;
mod instance;
pub mod model;
mod outline;
mod printable;
mod read;
mod repeated;
mod report;
mod scan;
mod slip;
mod state;
pub mod words;
mod write;

pub use disk::OnDisk;
pub use file::{SaveError, SceneFile, load, load_from, parse};
pub use format::format;
pub use fragment::PasteError;
pub use printable::printable;
pub use report::{Complaint, SceneTextError};
