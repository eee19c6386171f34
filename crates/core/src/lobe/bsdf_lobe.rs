//! Which lobes a [`Bsdf`](super::Bsdf) may have.
//!
//! A new one is one file beside this, its `mod` line and its line in the list below.

use glam::DVec3;

use super::local::{LocalLobe, LocalSample, Rays};
use super::{
    Complement, Diffuse, GgxReflection, Passage, Phong, RoughDiffuse, RoughInterface, Sheen, SmoothInterface,
    SmoothReflection, ThinWall,
};
use crate::Rgb;

/// Declares the enum and its answers from the list.
macro_rules! lobes {
    ($($(#[$doc:meta])* $Name:ident($Lobe:ty)),+ $(,)?) => {
        /// One lobe.
        #[derive(Debug, Clone, Copy)]
        #[non_exhaustive]
        #[allow(clippy::large_enum_variant, reason = "a point has few lobes, and boxes would be allocated at each hit")]
        pub enum BsdfLobe { $($(#[$doc])* $Name($Lobe)),+ }

        $(impl From<$Lobe> for BsdfLobe {
            fn from(lobe: $Lobe) -> Self {
                Self::$Name(lobe)
            }
        })+

        impl LocalLobe for BsdfLobe {
            fn evaluate(&self, o: DVec3, i: DVec3) -> Rgb {
                match self { $(Self::$Name(lobe) => LocalLobe::evaluate(lobe, o, i)),+ }
            }

            fn pdf(&self, o: DVec3, i: DVec3) -> f64 {
                match self { $(Self::$Name(lobe) => LocalLobe::pdf(lobe, o, i)),+ }
            }

            fn sample(&self, o: DVec3, choose: f64, u: [f64; 2]) -> Option<LocalSample> {
                match self { $(Self::$Name(lobe) => LocalLobe::sample(lobe, o, choose, u)),+ }
            }

            fn albedo(&self, o: DVec3) -> Rgb {
                match self { $(Self::$Name(lobe) => lobe.albedo(o)),+ }
            }

            fn rays(&self, o: DVec3) -> Rays {
                match self { $(Self::$Name(lobe) => lobe.rays(o)),+ }
            }

            fn ambient(&self, o: DVec3) -> Rgb {
                match self { $(Self::$Name(lobe) => lobe.ambient(o)),+ }
            }
        }
    };
}

lobes! {
    /// Light scattered alike in all directions.
    Diffuse(Diffuse<f64>),
    /// A rough matte surface.
    RoughDiffuse(RoughDiffuse),
    /// A highlight by formula.
    Phong(Phong<f64>),
    /// Perfect reflection.
    SmoothReflection(SmoothReflection),
    /// Reflection by facets.
    GgxReflection(GgxReflection),
    /// A smooth boundary of two media.
    SmoothInterface(SmoothInterface),
    /// A rough one.
    RoughInterface(RoughInterface),
    /// Both faces of a thin wall.
    ThinWall(ThinWall),
    /// What another lobe leaves.
    Complement(Complement),
    /// The rim of cloth.
    Sheen(Sheen),
    /// Light that goes straight on.
    Passage(Passage),
}
