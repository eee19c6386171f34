//! How far is one answer from another? Pictures, the error metrics over them, and distances between floating-point numbers.
//!
//! A [`Picture`] is linear or encoded RGB in `f32`, as the caller decides; a [`Pair`] is two pictures of one size, reference first.
//! [`METRICS`] lists every metric with its name, its words and its function, and tools, tests and documents follow that list.
//!
//! ```
//! use catoptra_lab::{METRICS, Pair, Picture, Viewing};
//!
//! let reference = Picture::filled(4, 4, [0.5; 3])?;
//! let test = Picture::filled(4, 4, [0.75; 3])?;
//! let pair = Pair::new(&reference, &test)?;
//! for metric in METRICS {
//!     println!("{:16} {:.6}", metric.name, (metric.measure)(pair, &Viewing::default()));
//! }
//! # Ok::<(), catoptra_lab::PictureError>(())
//! ```

pub mod adversary;
mod clock;
pub mod closed_forms;
pub mod metrics;
mod mismatch;
pub mod oracle;
mod picture;
mod plot;
pub mod scenes;
pub mod stress;
mod ulps;

pub use clock::{Clock, fastest};
pub use metrics::{METRICS, Metric, Viewing, metric_named};
pub use mismatch::mismatch_rate;
pub use picture::{Pair, Picture, PictureError};
pub use plot::{NoPlot, Plot};
pub use ulps::{ulps_f32, ulps_f64};
