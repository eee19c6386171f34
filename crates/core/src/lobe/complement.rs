//! Where does the light go that another lobe does not send on?
//!
//! A lobe that keeps the share E(o) of an even surrounding leaves L(o) = 1 − E(o). The complement shows L(o) L(i) |cos i| / (π L̄),
//! where L̄ is the mean of L weighted by twice the cosine: reciprocal, and together with the lobe 1 from everywhere (Kelemen and
//! Szirmay-Kalos, "A microfacet based coupled specular-matte BRDF model", Eurographics 2001). It stands for
//! * light that a rough surface has reflected more than once (Kulla and Conty, SIGGRAPH 2017 course);
//! * light that went through a boundary, was scattered below and came out again: the colour of plastic;
//! * light that a rough boundary of two media has sent on more than once. It has forgotten where it came from, and leaves to either
//!   side s in the proportion of n² L̄ there, which keeps reciprocity.

use std::f64::consts::PI;

use glam::DVec3;

use super::albedo::{
    CapPoints, Interface, Side, kept_by_reflection, lost_at_interface, lost_by_reflection,
    mean_lost_by_reflection,
};
use super::boundary::Boundary;
use super::fresnel::Fresnel;
use super::ggx::Ggx;
use super::hemisphere::Disk;
use super::local::{LocalLobe, LocalSample};
use super::rough_interface::RoughInterface;
use crate::Rgb;

/// What the other lobe leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Left {
    /// Of single reflection where every facet reflects all.
    ByReflection(Ggx),
    /// Of single reflection and refraction, on one side.
    ByInterface(RoughInterface, Side),
    /// Below a boundary.
    Below(Boundary),
}

impl Left {
    fn at(&self, cosine: f64) -> Rgb {
        match self {
            Self::ByReflection(ggx) => Rgb::grey(lost_by_reflection(ggx.alpha(), cosine)),
            Self::ByInterface(interface, side) => Rgb::grey(table_of(interface).lost(*side, cosine)),
            Self::Below(boundary) => Rgb::WHITE - boundary.reflected(cosine),
        }
    }

    /// Weighted by twice the cosine.
    fn mean(&self) -> Rgb {
        match self {
            Self::ByReflection(ggx) => Rgb::grey(mean_lost_by_reflection(ggx.alpha())),
            Self::ByInterface(interface, side) => Rgb::grey(table_of(interface).mean_lost(*side)),
            Self::Below(boundary) => Rgb::WHITE - boundary.mean_reflected(),
        }
    }

    /// What is left of what `o` sees, by quadrature; `None` where a table knows it.
    fn computed(&self, o: DVec3) -> Option<Rgb> {
        let points = CapPoints::few();
        match self {
            Self::ByReflection(ggx) => {
                ggx.is_stretched().then(|| Rgb::grey(1.0 - kept_by_reflection(points, ggx, o, |_| 1.0)))
            }
            Self::ByInterface(RoughInterface { ggx, facet }, _) => {
                ggx.is_stretched().then(|| Rgb::grey(lost_at_interface(points, ggx, facet.eta, o)))
            }
            Self::Below(boundary) => boundary.computed(o).map(|reflected| Rgb::WHITE - reflected),
        }
    }
}

fn table_of(interface: &RoughInterface) -> Interface {
    let eta = interface.facet.eta;
    Interface::new(interface.ggx.alpha(), eta.max(1.0 / eta))
}

/// One side of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Half {
    left: Left,
    /// Share of all that is left that comes out on this side.
    share: Rgb,
    /// That share over the mean of what is left.
    scale: Rgb,
}

impl Half {
    fn new(left: Left, share: Rgb) -> Self {
        let mean = left.mean();
        let over = |share: f64, mean: f64| if mean > 0.0 { share / mean } else { 0.0 };
        let scale = Rgb::new(over(share.r, mean.r), over(share.g, mean.g), over(share.b, mean.b));
        Self { left, share, scale }
    }
}

/// What another lobe leaves, sent on so that the whole is complete.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Complement {
    here: Half,
    there: Option<Half>,
    /// Index of refraction beyond over that on the viewer's side.
    eta: f64,
    /// What is left of what the viewer sees, where that is known better than by table.
    seen: Option<Rgb>,
    /// How likely a sample comes from the viewer's side.
    chance: f64,
}

impl Complement {
    fn new(here: Half, there: Option<Half>, eta: f64) -> Self {
        let beyond = there.map_or(0.0, |half| half.share.max_channel());
        let all = here.share.max_channel() + beyond;
        let chance = if all > 0.0 { here.share.max_channel() / all } else { 1.0 };
        Self { here, there, eta, seen: None, chance }
    }

    /// Light that a metal reflects more than once. Each further reflection is coloured.
    #[must_use]
    pub fn of_metal(ggx: Ggx, fresnel: Fresnel) -> Self {
        let left = Left::ByReflection(ggx);
        let (lost, once) = (left.mean().r, fresnel.mean());
        let share = once.map(|f| f * f * (1.0 - lost) / (1.0 - f * lost));
        Self::new(Half::new(left, share), None, 1.0)
    }

    /// Light that a rough boundary of two media reflects and bends more than once.
    #[must_use]
    pub fn of_interface(interface: &RoughInterface) -> Self {
        let eta = interface.facet.eta;
        let [here, there] = if eta > 1.0 { [Side::Thin, Side::Dense] } else { [Side::Dense, Side::Thin] };
        let [here, there] = [here, there].map(|side| Left::ByInterface(*interface, side));
        let [near, far] = [here.mean().r, there.mean().r * eta * eta];
        let share = if near + far > 0.0 { near / (near + far) } else { 1.0 };
        let beyond = Half::new(there, interface.facet.tint * (1.0 - share));
        Self::new(Half::new(here, Rgb::grey(share)), Some(beyond), eta)
    }

    /// Light that a rough thin wall sends on more than once, if it sends on `reflected` and `transmitted` of what meets a facet.
    #[must_use]
    pub fn of_wall(ggx: Ggx, reflected: Rgb, transmitted: Rgb) -> Self {
        let left = Left::ByReflection(ggx);
        let lost = left.mean().r;
        let all = reflected + transmitted;
        let again = all.map(|f| f * (1.0 - lost) / (1.0 - f * lost));
        let [here, there] = [reflected, transmitted].map(|share| Half::new(left, share * again));
        Self::new(here, Some(there), 1.0)
    }

    /// Light that goes through a boundary and comes out again, of which `color` is left: what lies below scatters it evenly.
    #[must_use]
    pub fn below(boundary: Boundary, color: Rgb) -> Self {
        Self::new(Half::new(Left::Below(boundary), color), None, 1.0)
    }

    /// The same, for one viewer. Tables know facets that are alike in all directions; what others leave is computed, so that
    /// the whole is complete, though no longer reciprocal.
    #[must_use]
    pub fn seen_from(self, o: DVec3) -> Self {
        Self { seen: self.here.left.computed(o), ..self }
    }

    /// What is left of what `o` sees.
    fn left(&self, o: DVec3) -> Rgb {
        self.seen.unwrap_or_else(|| self.here.left.at(o.z))
    }

    fn half(&self, z: f64) -> Option<&Half> {
        if z > 0.0 { Some(&self.here) } else { self.there.as_ref() }
    }
}

impl LocalLobe for Complement {
    fn evaluate(&self, o: DVec3, i: DVec3) -> Rgb {
        let Some(half) = self.half(i.z) else { return Rgb::BLACK };
        let cosine = i.z.abs();
        self.left(o) * half.left.at(cosine) * half.scale * (cosine / PI)
    }

    fn pdf(&self, _: DVec3, i: DVec3) -> f64 {
        let chance = if i.z > 0.0 { self.chance } else { 1.0 - self.chance };
        chance * i.z.abs() / PI
    }

    fn sample(&self, _: DVec3, choose: f64, u: [f64; 2]) -> Option<LocalSample> {
        let disk = Disk::at(u);
        let cosine = (1.0 - disk.radius * disk.radius).max(0.0).sqrt();
        let here = choose < self.chance;
        let (z, eta) = if here { (cosine, 1.0) } else { (-cosine, self.eta) };
        let direction = DVec3::from(disk.raised(disk.radius, z));
        (cosine > 0.0).then_some(LocalSample { direction, delta: None, eta })
    }

    fn albedo(&self, o: DVec3) -> Rgb {
        let all = self.there.map_or(self.here.share, |half| half.share + self.here.share);
        self.left(o) * all
    }
}
