//! Which materials there are, and what a material must answer.
//!
//! A material says in which [lobes](crate::lobe) light leaves it towards the viewer; it does not depend on the light
//! that arrives. A new material is one file here, its `mod` line and its name in the list below.

mod checker;
mod clear;
mod depth;
mod emissive;
mod finish;
mod footprint;
mod glass;
mod matte;
mod medium;
mod metal;
mod mirror;
mod mirror_share;
mod phong;
mod plastic;
mod principled;
mod rubber;

pub use checker::Checker;
pub use depth::Depth;
pub use emissive::Emissive;
pub use finish::{Finish, NormalMap, Sides};
pub use footprint::Footprint;
pub(crate) use footprint::{Coordinate, mean_sign};
pub use glass::Glass;
pub use matte::Matte;
pub use medium::{Medium, absorption};
pub use metal::Metal;
pub use mirror::Mirror;
pub use phong::Phong;
pub use plastic::Plastic;
pub use principled::Principled;
pub use rubber::Rubber;

use glam::DVec3;

use crate::texture::{HalfGrey, TexturePoint, TextureSource};
use crate::{Bsdf, Lane, LobeKinds, Lobes, Rgb, ShadingPoint, SurfacePoint};
use mirror_share::MirrorShare;

/// Light that a surface sends out by itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Emission {
    /// W/(m²·sr) per channel, the same in all directions.
    pub radiance: Rgb,
    /// Whether to both sides.
    pub two_sided: bool,
}

/// What a material provides to integrators.
pub trait Surface {
    /// How light leaves it where and from where it is seen. Which lobes there are depends on the material alone, how
    /// strong they are on the point.
    fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L>;

    /// Whether its lobes are more than lanes know: then [`lobes`](Self::lobes) tells its plain scattering at most, and
    /// [`bsdf`](Self::bsdf) all.
    fn needs_bsdf(&self) -> bool {
        false
    }

    /// All that light does where and from where it is seen.
    fn bsdf(&self, at: &SurfacePoint) -> Bsdf {
        Bsdf::from_lobes(&self.lobes(&at.shading), at)
    }

    /// Whether its look depends on which way texture coordinates run.
    fn is_anisotropic(&self) -> bool {
        false
    }

    /// What fills a solid of it, if light goes through.
    fn medium(&self) -> Option<Medium> {
        None
    }

    /// As [`lobes`](Self::lobes), on average over what is seen through a square of the picture.
    #[inline(always)]
    fn mean_lobes<L: Lane>(&self, at: &ShadingPoint<L>, _footprint: &Footprint<L>) -> Lobes<L> {
        self.lobes(at)
    }

    /// The same material for positions that are counted from `origin`, a point of the scene.
    #[must_use]
    fn relative_to(&self, _origin: DVec3) -> Self
    where
        Self: Clone,
    {
        self.clone()
    }

    /// Whether a texture multiplies any of its values. Such a material is [`resolved`](Self::resolved) at every point
    /// before anything else is asked of it; unresolved it answers as if every texture were white.
    fn is_textured(&self) -> bool {
        false
    }

    /// The same material with every textured value replaced by what it is at a point, and no texture left. It has at most
    /// the lobes that [`Material::lobe_kinds`] tells of. Takes neither memory nor time for checks.
    #[must_use]
    fn resolved(&self, _textures: &impl TextureSource, _at: &TexturePoint) -> Self
    where
        Self: Clone,
    {
        self.clone()
    }

    /// The light of its own with which it lights others, if there is any: as if its textures were white.
    fn emission(&self) -> Option<Emission> {
        None
    }

    /// Whether a texture multiplies the light of its own, so that it is no lamp of the one radiance that
    /// [`emission`](Self::emission) tells.
    fn emission_is_textured(&self) -> bool {
        false
    }

    /// Whether its look jumps from one position to the next; only then are positions
    /// [`undecided`](Self::undecided).
    fn is_pattern(&self) -> bool {
        false
    }

    /// Where its look could jump if the position were off by up to `error` metres and the formula by its roundings in
    /// `f32`.
    #[inline(always)]
    fn undecided<L: Lane>(&self, _at: &ShadingPoint<L>, error: L) -> L::Mask {
        error.less(error)
    }

    /// A position that looks the same as this one, and so for certain: far from where the look jumps, and near zero.
    #[inline(always)]
    fn reduced(&self, position: DVec3) -> DVec3 {
        position
    }
}

crate::part::parts! {
    $ each_material
    /// A material.
    pub enum Material {
        /// Lambert.
        Matte,
        /// Blinn–Phong.
        Phong,
        /// Two colours in squares.
        Checker,
        /// Colour that fades with distance.
        Depth,
        /// Perfect reflection.
        Mirror,
        /// Light of its own.
        Emissive,
        /// Clear matter.
        Glass,
        /// Metal.
        Metal,
        /// Colour under a clear surface.
        Plastic,
        /// Rough colour under a rough surface.
        Rubber,
        /// Metal, glass, plastic and cloth in one.
        Principled,
    }
}

impl Material {
    /// See [`Surface::lobes`].
    #[inline(always)]
    pub fn lobes<L: Lane>(&self, at: &ShadingPoint<L>) -> Lobes<L> {
        each_material!(self, material => material.lobes(at))
    }

    /// Calls `work` with its lobes. That is compiled for each kind of material, so lobes that the kind lacks cost
    /// nothing, and of `at` only what it needs is computed.
    #[inline(always)]
    pub fn visit_lobes<L: Lane, T>(
        &self,
        at: impl Fn() -> ShadingPoint<L>,
        work: impl FnOnce(Lobes<L>) -> T,
    ) -> T {
        each_material!(self, material => work(material.lobes(&at())))
    }

    /// See [`Surface::emission`].
    #[must_use]
    pub fn emission(&self) -> Option<Emission> {
        each_material!(self, material => material.emission())
    }

    /// See [`Surface::emission_is_textured`].
    #[must_use]
    pub fn emission_is_textured(&self) -> bool {
        each_material!(self, material => material.emission_is_textured())
    }

    /// As [`visit_lobes`](Self::visit_lobes), with [`Surface::mean_lobes`].
    #[inline(always)]
    pub fn visit_mean_lobes<L: Lane, T>(
        &self,
        (at, footprint): (&ShadingPoint<L>, &Footprint<L>),
        work: impl FnOnce(Lobes<L>) -> T,
    ) -> T {
        each_material!(self, material => work(material.mean_lobes(at, footprint)))
    }

    /// See [`Surface::needs_bsdf`].
    #[must_use]
    pub fn needs_bsdf(&self) -> bool {
        each_material!(self, material => material.needs_bsdf())
    }

    /// See [`Surface::bsdf`].
    #[must_use]
    pub fn bsdf(&self, at: &SurfacePoint) -> Bsdf {
        each_material!(self, material => material.bsdf(at))
    }

    /// See [`Surface::is_anisotropic`].
    #[must_use]
    pub fn is_anisotropic(&self) -> bool {
        each_material!(self, material => material.is_anisotropic())
    }

    /// See [`Surface::medium`].
    #[must_use]
    pub fn medium(&self) -> Option<Medium> {
        each_material!(self, material => material.medium())
    }

    /// Which lobes it has, anywhere.
    #[must_use]
    pub fn lobe_kinds(&self) -> LobeKinds {
        let somewhere = self.resolved(&HalfGrey, &TexturePoint::default());
        somewhere.lobes(&ShadingPoint::HEAD_ON).kinds()
    }

    /// See [`Surface::is_textured`].
    #[must_use]
    pub fn is_textured(&self) -> bool {
        each_material!(self, material => material.is_textured())
    }

    /// See [`Surface::resolved`].
    #[must_use]
    pub fn resolved(&self, textures: &impl TextureSource, at: &TexturePoint) -> Self {
        each_material!(self, material => material.resolved(textures, at).into())
    }
}

/// Patterns, and where they are.
impl Material {
    /// See [`Surface::relative_to`].
    #[must_use]
    pub fn relative_to(&self, origin: DVec3) -> Self {
        each_material!(self, material => material.relative_to(origin).into())
    }

    /// See [`Surface::is_pattern`].
    #[must_use]
    pub fn is_pattern(&self) -> bool {
        each_material!(self, material => material.is_pattern())
    }

    /// See [`Surface::undecided`].
    #[inline(always)]
    pub fn undecided<L: Lane>(&self, at: &ShadingPoint<L>, error: L) -> L::Mask {
        each_material!(self, material => material.undecided(at, error))
    }

    /// See [`Surface::reduced`].
    #[must_use]
    #[inline(always)]
    pub fn reduced(&self, position: DVec3) -> DVec3 {
        each_material!(self, material => material.reduced(position))
    }
}
