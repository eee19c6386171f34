//! Which lobes a surface may have, and what a lobe must answer.
//!
//! A lobe is one part of how light leaves a surface: alike in all directions, in a highlight, mirrored. Materials answer
//! with a set of them ([`Lobes`]) and integrators know every lobe in the set, so it is closed. A new lobe is one file
//! here, its `mod` line and its line in the list below.
//!
//! Lobes of rough, clear and layered matter are known in `f64` alone: [`BsdfLobe`] lists them, [`Bsdf`] weighs them at one point,
//! and [`local`] tells what they answer.

mod albedo;
mod boundary;
mod bsdf;
mod bsdf_lobe;
mod complement;
mod diffuse;
pub mod fresnel;
mod ggx;
mod ggx_reflection;
mod hemisphere;
mod lane_lobes;
pub mod local;
mod mirror;
mod passage;
mod phong;
mod point;
mod quadrature;
mod rough_diffuse;
mod rough_interface;
#[cfg(test)]
mod scatter_checks;
mod sheen;
mod smooth_interface;
mod smooth_reflection;
mod thin_wall;

pub use boundary::{Boundary, Roughness};
pub use bsdf::{Bsdf, Continuation, Scattered};
pub use bsdf_lobe::BsdfLobe;
pub use complement::Complement;
pub use diffuse::Diffuse;
pub use ggx::Ggx;
pub use ggx_reflection::GgxReflection;
pub use hemisphere::point_of_disk;
pub use local::Frame;
pub use mirror::{Mirror, Mirrored};
pub use passage::Passage;
pub use phong::{Phong, PhongModel, PhongShape};
pub use point::{ShadingPoint, SurfacePoint};
pub use rough_diffuse::RoughDiffuse;
pub use rough_interface::RoughInterface;
pub use sheen::Sheen;
pub use smooth_interface::SmoothInterface;
pub use smooth_reflection::SmoothReflection;
pub use thin_wall::ThinWall;

use crate::{Lane, Triple};

/// A lobe that spreads light over a range of directions.
pub trait Scatter<L: Lane> {
    /// Radiance shown for each unit of irradiance (at normal incidence) from `direction`, a unit vector
    /// whose `cosine` to the normal is positive: the BRDF times the cosine.
    fn evaluate(&self, at: &ShadingPoint<L>, direction: Triple<L>, cosine: L) -> Triple<L>;

    /// How densely [`sample`](Self::sample) spreads directions over solid angle at `direction`, 1/sr, as above.
    fn pdf(&self, at: &ShadingPoint<L>, direction: Triple<L>, cosine: L) -> L;

    /// A direction that light may come from, chosen by two numbers in 0..1 such that
    /// [`evaluate`](Self::evaluate)` / `[`pdf`](Self::pdf) is bounded.
    fn sample(&self, at: &ShadingPoint<L>, u: [L; 2]) -> Sample<L>;
}

/// A direction chosen by [`Scatter::sample`].
#[derive(Debug, Clone, Copy)]
pub struct Sample<L: Lane> {
    /// Unit vector.
    pub direction: Triple<L>,
    /// Its cosine to the normal.
    pub cosine: L,
    /// [`Scatter::pdf`] there.
    pub pdf: L,
    /// Where the direction lies above the surface and `pdf` is positive; elsewhere the sample counts as one that
    /// brings no light.
    pub lanes: L::Mask,
}

/// Declares [`Lobes`] and [`LobeKinds`] from the list of lobes beside the diffuse one: `glossy` ones, which are
/// evaluated for every light, and `delta` ones, which send light on in single directions.
macro_rules! lobes {
    (
        glossy { $($(#[$glossy_doc:meta])* $glossy:ident: $Glossy:ident),* $(,)? }
        delta { $($(#[$delta_doc:meta])* $delta:ident: $Delta:ident),* $(,)? }
    ) => {
        /// How light leaves a surface towards the viewer: what is seen is
        /// `share · (emission + ambient · ambient radiance + diffuse + glossy lobes) + delta lobes`.
        ///
        /// Whether a lobe is there depends on the material alone and never on the point; how strong it is may depend on
        /// the point.
        #[derive(Debug, Clone, Copy)]
        pub struct Lobes<L: Lane> {
            /// Radiance shown without any light's help.
            pub emission: Triple<L>,
            /// Radiance shown for each unit of ambient radiance.
            pub ambient: Triple<L>,
            /// The base's share of what is seen, 0..=1; delta lobes carry their own.
            pub share: L,
            /// Light scattered alike in all directions.
            pub diffuse: Option<Diffuse<L>>,
            $($(#[$glossy_doc])* pub $glossy: Option<$Glossy<L>>,)*
            $($(#[$delta_doc])* pub $delta: Option<$Delta<L>>,)*
        }

        impl<L: Lane> Lobes<L> {
            /// A base that shows nothing; `like` only says which lanes.
            #[inline(always)]
            #[must_use]
            pub fn none(like: L) -> Self {
                let dark = Triple::splat(like.number(0.0));
                Self {
                    emission: dark,
                    ambient: dark,
                    share: like.number(1.0),
                    diffuse: None,
                    $($glossy: None,)*
                    $($delta: None,)*
                }
            }

            /// [`Scatter::evaluate`] summed over the glossy lobes, if there are any.
            #[inline(always)]
            #[must_use]
            pub fn glossy(&self, at: &ShadingPoint<L>, direction: Triple<L>, cosine: L) -> Option<Triple<L>> {
                let sum = None;
                $(let sum = add(sum, evaluate(&self.$glossy, at, direction, cosine));)*
                sum
            }

            /// Whether there are lobes that are evaluated for every light beside the diffuse one.
            #[inline(always)]
            #[must_use]
            pub fn is_glossy(&self) -> bool {
                false $(|| self.$glossy.is_some())*
            }
        }

        impl Lobes<f64> {
            /// Which lobes there are. Those of a base that has no share of what is seen are as good as missing.
            #[must_use]
            pub fn kinds(&self) -> LobeKinds {
                let base = self.share > 0.0;
                LobeKinds {
                    base,
                    diffuse: base && self.diffuse.is_some(),
                    $($glossy: base && self.$glossy.is_some(),)*
                    $($delta: self.$delta.is_some(),)*
                }
            }
        }

        /// Which lobes a material has, so that nothing is computed for those it lacks.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
        pub struct LobeKinds {
            /// Whether anything is seen but what delta lobes send on.
            pub base: bool,
            /// Light scattered alike in all directions.
            pub diffuse: bool,
            $($(#[$glossy_doc])* pub $glossy: bool,)*
            $($(#[$delta_doc])* pub $delta: bool,)*
        }

        impl LobeKinds {
            /// Whether there are lobes that are evaluated for every light beside the diffuse one.
            #[inline(always)]
            #[must_use]
            pub const fn is_glossy(self) -> bool {
                false $(|| self.$glossy)*
            }
        }
    };
}

lobes! {
    glossy {
        /// A highlight.
        phong: Phong,
    }
    delta {
        /// Perfect reflection.
        mirror: Mirror,
    }
}

impl<L: Lane> Lobes<L> {
    /// A base that scatters light alike in all directions, ambient light as well.
    #[inline(always)]
    #[must_use]
    pub fn matte(albedo: Triple<L>) -> Self {
        Self { ambient: albedo, diffuse: Some(Diffuse { albedo }), ..Self::none(albedo.x) }
    }

    /// Whether lights make any difference to it.
    #[inline(always)]
    #[must_use]
    pub fn is_lit(&self) -> bool {
        self.diffuse.is_some() || self.is_glossy()
    }

    /// The same, which shines by itself in some lanes alone.
    #[inline(always)]
    #[must_use]
    pub fn shining(self, lanes: L::Mask) -> Self {
        let dark = Triple::splat(self.share.number(0.0));
        Self { emission: Triple::select(lanes, self.emission, dark), ..self }
    }

    /// Radiance shown of itself and of ambient radiance, before its [share](Self::share).
    #[inline(always)]
    #[must_use]
    pub fn unlit(&self, ambient: Triple<L>) -> Triple<L> {
        self.ambient.times_add(ambient, self.emission)
    }

    /// Radiance shown of itself, of ambient radiance, and of light that gives so much irradiance in all: the base but for
    /// its glossy lobes, before its [share](Self::share).
    #[inline(always)]
    #[must_use]
    pub fn without_glossy(&self, ambient: Triple<L>, irradiance: Triple<L>) -> Triple<L> {
        let unlit = self.unlit(ambient);
        match &self.diffuse {
            Some(diffuse) => diffuse.brdf().times_add(irradiance, unlit),
            None => unlit,
        }
    }

    /// [`Scatter::evaluate`] summed over the diffuse and the glossy lobes, before the base's [share](Self::share).
    #[inline(always)]
    #[must_use]
    pub fn evaluate(&self, at: &ShadingPoint<L>, direction: Triple<L>, cosine: L) -> Triple<L> {
        let diffuse = evaluate(&self.diffuse, at, direction, cosine);
        match add(diffuse, self.glossy(at, direction, cosine)) {
            Some(sum) => sum,
            None => Triple::splat(cosine.number(0.0)),
        }
    }
}

impl LobeKinds {
    /// Whether lights make any difference.
    #[inline(always)]
    #[must_use]
    pub const fn is_lit(self) -> bool {
        self.diffuse || self.is_glossy()
    }
}

/// [`Scatter::evaluate`] of a lobe, if there is one. Closures given to [`Option`] would be compiled without the caller's
/// vector instructions.
#[inline(always)]
fn evaluate<L: Lane>(
    lobe: &Option<impl Scatter<L>>,
    at: &ShadingPoint<L>,
    direction: Triple<L>,
    cosine: L,
) -> Option<Triple<L>> {
    match lobe {
        Some(lobe) => Some(lobe.evaluate(at, direction, cosine)),
        None => None,
    }
}

/// The sum of those that there are.
#[inline(always)]
fn add<L: Lane>(a: Option<Triple<L>>, b: Option<Triple<L>>) -> Option<Triple<L>> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a + b),
        (Some(one), None) | (None, Some(one)) => Some(one),
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Coefficient;

    fn grey(v: f64) -> Triple<f64> {
        Triple::splat(v)
    }

    #[test]
    fn lobes_add_up() {
        let (at, direction) = (&ShadingPoint::HEAD_ON, Triple::new(0.6, 0.0, 0.8));
        let phong = Phong { specular: grey(0.5), shape: PhongShape::new(3.0, PhongModel::Normalised) };
        let lobes = Lobes { phong: Some(phong), ..Lobes::matte(grey(0.25)) };
        let [diffuse, glossy] =
            [lobes.diffuse.unwrap().evaluate(at, direction, 0.8), phong.evaluate(at, direction, 0.8)];
        assert_eq!(lobes.evaluate(at, direction, 0.8), diffuse + glossy);
        assert_eq!(lobes.glossy(at, direction, 0.8), Some(glossy));
        assert_eq!(Lobes::none(0.0).evaluate(at, direction, 0.8), grey(0.0));
        assert_eq!(lobes.without_glossy(grey(2.0), grey(0.0)), grey(0.5));
        let lit = lobes.without_glossy(grey(0.0), grey(std::f64::consts::PI));
        assert!((lit.x - 0.25).abs() < 1e-16);
    }

    #[test]
    fn a_base_without_a_share_has_no_kinds() {
        let share = Coefficient::new(0.5);
        let half = Lobes { share: 0.0.of(share), ..Lobes::matte(grey(0.25)) };
        assert!(half.kinds().base && half.kinds().is_lit() && !half.kinds().is_glossy());
        let mirror = Lobes { share: 0.0, mirror: Some(Mirror { tint: grey(1.0) }), ..half };
        assert_eq!(mirror.kinds(), LobeKinds { mirror: true, ..LobeKinds::default() });
    }
}
