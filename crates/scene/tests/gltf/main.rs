//! Do glTF files come in as what they say, and are bad ones refused with their place?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod accessors;
mod builder;
mod containers;
mod damaged;
mod looks;
mod nodes;
mod posed;
mod refused;
mod textures;
mod things;
