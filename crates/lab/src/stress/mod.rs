//! Questions about rays that are hard to answer, with their answers: the text formats, how answers are scored, and how
//! a scene of such a file becomes one of the tracer.
//!
//! A case file holds scenes of primitives given as `f32` bit patterns and questions about them; every number is taken
//! as the exact real number that it is. See `stress/format.md` beside this file for the formats.

mod answer;
mod pose;
mod read;
mod results;
mod score;

pub use answer::{Asked, answer};
pub use pose::{PoseError, Posed, pose};
pub use read::{StressError, read_answers, read_cases};
pub use results::{Reply, read_results, results_text};
pub use score::{Score, score};

/// A primitive of a case file, as it stands there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Primitive {
    /// Three corners, seen from both sides.
    Triangle([[f32; 3]; 3]),
    /// Centre and radius.
    Sphere([f32; 3], f32),
    /// A point and a normal of any length.
    Plane([f32; 3], [f32; 3]),
    /// The closed box between two corners, of which only hit or miss is asked.
    Volume([f32; 3], [f32; 3]),
    /// The surface of the box between two corners.
    Box([f32; 3], [f32; 3]),
}

/// Primitives that are asked about together; their ids are their places.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Stage {
    /// All of them, also those that can never be hit.
    pub primitives: Vec<Primitive>,
    /// Whether they enclose a volume, so that an edge must not be passed through.
    pub closed: bool,
}

/// What is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Question {
    /// What the ray meets first with `min <= t <= max`.
    Nearest {
        /// Lower end, in units of the direction.
        min: f32,
        /// Upper end.
        max: f32,
    },
    /// Whether the point light at that position reaches what the ray meets first.
    Shadow([f32; 3]),
    /// Where a ray is after so many perfect mirrors.
    Mirrors(u32),
    /// Where a ray is after so many surfaces of glass, and their index of refraction on the side that the normal does not
    /// point to.
    Glass(u32, f32),
}

/// One question.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its number.
    pub id: u64,
    /// What it tries, such as `a4_mesh_exact`.
    pub group: String,
    /// Which stage it is asked of.
    pub stage: usize,
    /// Where the ray starts.
    pub origin: [f32; 3],
    /// Where it goes; `t` counts in its length.
    pub direction: [f32; 3],
    /// What is asked.
    pub question: Question,
}

/// A whole case file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cases {
    /// The stages in the order of the file.
    pub stages: Vec<Stage>,
    /// The questions in the order of the file.
    pub cases: Vec<Case>,
}

/// Whether a ray must hit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Duty {
    /// It must hit.
    Hit,
    /// It must miss.
    Miss,
    /// Either will do.
    Either,
}

/// A hit that is right: which primitive, where any will do `None`, and at which `t`, where it does not count `None`.
pub type Acceptable = (Option<u32>, Option<f64>);

/// The right answer.
#[derive(Debug, Clone, PartialEq)]
pub enum Expected {
    /// To [`Question::Nearest`].
    Nearest(Duty, Vec<Acceptable>),
    /// To [`Question::Shadow`]: whether the light is hidden.
    Occluded(bool),
    /// To [`Question::Mirrors`] and [`Question::Glass`].
    Path {
        /// The last primitive.
        primitive: u32,
        /// Where it is met.
        point: [f64; 3],
        /// How long the path is.
        length: f64,
        /// How much the result changes for a relative change of the input.
        amplification: f64,
    },
}
