//! How scenes, meshes, profiles and pictures go into files and come out of them.
//!
//! * [`load`] and [`parse`] read scene text (KDL; `scenes/README.md` documents it) into a
//!   [`Scene`](catoptra_core::scene::Scene) and a [`SceneFile`] that keeps the text; [`SceneFile::save`] writes back
//!   only what has changed. The grammar follows the lists of kinds in the core: a new shape, light or material is
//!   read and written without a change here.
//! * [`format()`] lays scene text out by rule.
//! * [`fragment`] makes text of parts of a scene, and adds such text to another.
//! * [`model`] reads models and meshes, [`ies`] how luminaires shine, [`image`] reads pictures, and writes PNG and OpenEXR.
//! * [`memory`] tells how much there is for a picture.
//! * [`atomic`] writes any file whole or not at all, and says beforehand whether it can, and [`words`] finds the word that a misspelt one was meant to be.
//!
//! Feature `text` (on by default) holds all of scene text; without it neither KDL nor `miette` is built, and models, pictures and
//! profiles are read and written alone.
//!
//! Whatever a file holds, reading it ends in a value or in an error that says what, where and what to do: never in a
//! panic. Files are written whole or not at all.
#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test may stop at the first surprise"))]

pub mod atomic;
#[cfg(feature = "text")]
mod bare;
#[cfg(feature = "text")]
mod build;
#[cfg(feature = "text")]
mod disk;
#[cfg(feature = "text")]
mod excerpt;
#[cfg(feature = "text")]
mod file;
#[cfg(feature = "text")]
mod flags;
#[cfg(feature = "text")]
mod foreign;
#[cfg(feature = "text")]
mod format;
#[cfg(feature = "text")]
pub mod fragment;
pub mod ies;
pub mod image;
#[cfg(feature = "text")]
mod instance;
pub mod memory;
pub mod model;
#[cfg(feature = "text")]
mod outline;
mod printable;
#[cfg(feature = "text")]
mod read;
#[cfg(feature = "text")]
mod repeated;
#[cfg(feature = "text")]
mod report;
#[cfg(feature = "text")]
mod scan;
#[cfg(feature = "text")]
mod slip;
#[cfg(feature = "text")]
mod state;
#[cfg(feature = "text")]
mod watch;
pub mod words;
#[cfg(feature = "text")]
mod write;

#[cfg(feature = "text")]
pub use disk::OnDisk;
#[cfg(feature = "text")]
pub use file::{LoadError, SaveError, SceneFile, load, load_from, load_unless_cancelled, parse};
#[cfg(feature = "text")]
pub use format::format;
#[cfg(feature = "text")]
pub use fragment::PasteError;
pub use printable::printable;
#[cfg(feature = "text")]
pub use report::{Complaint, SceneTextError};
