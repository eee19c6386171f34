//! What can be wrong with triangles and rays?

use catoptra_core::{InvalidPart, SceneError};

use crate::NoPool;

/// Why there is no [`Caster`](crate::Caster).
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CasterError {
    /// The triangles are none.
    #[error(transparent)]
    Triangles(#[from] InvalidPart),
    /// A scene refuses them.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The system gave no threads.
    #[error(transparent)]
    Pool(#[from] NoPool),
}

/// Why a ray is none.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidRay {
    /// A coordinate is infinite or no number.
    #[error("the origin and the direction of a ray must be finite")]
    NotFinite,
    /// The direction is zero.
    #[error("the direction of a ray must not be zero")]
    NoDirection,
    /// The ends of the stretch that is searched are no numbers, not in order, or both behind the origin.
    #[error("a ray must be searched between two numbers in order, the second at least 0, not {0} and {1}")]
    Ends(f64, f64),
}

/// Why columns of rays are none.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidRays {
    /// The columns differ in length.
    #[error("there are {origins} origins but {others} {what}")]
    Lengths {
        /// How many origins there are.
        origins: usize,
        /// Of what there are more or fewer.
        what: &'static str,
        /// How many.
        others: usize,
    },
    /// One of the rays is none, the first that is not.
    #[error("ray {at}: {cause}")]
    Ray {
        /// Its place, from 0.
        at: usize,
        /// What is wrong with it.
        #[source]
        cause: InvalidRay,
    },
}
