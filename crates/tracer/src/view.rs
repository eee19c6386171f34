//! What is asked for: camera, size, and how far to go.

use std::ops::Range;

use catoptra_core::{Camera, Integrator, Scene};

use crate::numeric::{LAMP_RAYS, WEIGHT_CUTOFF};
use crate::{Filter, Instructions, Pattern};

/// Picture size in pixels; either may be zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize)]
pub struct Size {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

impl Size {
    /// `width` x `height` pixels.
    #[must_use]
    pub const fn new(width: u32, height: u32) -> Self {
        Self { width, height }
    }

    /// How many pixels.
    #[must_use]
    pub const fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

/// A rectangle of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize)]
pub struct Region {
    /// Pixels left of it.
    pub x: u32,
    /// Pixels above it.
    pub y: u32,
    /// How large it is.
    #[serde(flatten)]
    pub size: Size,
}

impl Region {
    /// `size` pixels, whose upper left one has `x` pixels to its left and `y` above it.
    #[must_use]
    pub const fn new(x: u32, y: u32, size: Size) -> Self {
        Self { x, y, size }
    }

    /// What of it lies within a picture.
    #[must_use]
    pub fn within(self, picture: Size) -> Self {
        let left = |from: u32, length: u32, whole: u32| length.min(whole.saturating_sub(from));
        let width = left(self.x, self.size.width, picture.width);
        let height = left(self.y, self.size.height, picture.height);
        Self { size: Size { width, height }, ..self }
    }
}

impl From<Size> for Region {
    /// A whole picture.
    fn from(size: Size) -> Self {
        Self::new(0, 0, size)
    }
}

/// One picture that is asked for.
///
/// ```
/// use catoptra_core::{Camera, glam::DVec3};
/// use catoptra_tracer::{Region, Size, View};
///
/// let camera = Camera::look_at(DVec3::Z * 4.0, DVec3::ZERO, DVec3::Y, 0.8)?;
/// // The upper left quarter of a picture, four samples a pixel.
/// let crop = Some(Region::new(0, 0, Size::new(320, 240)));
/// let view = View { crop, samples: 4, ..View::new(camera, Size::new(640, 480)) };
/// assert_eq!(view.region().size.pixels(), 320 * 240);
/// # Ok::<(), catoptra_core::InvalidPart>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// From where.
    pub camera: Camera,
    /// How large.
    pub size: Size,
    /// Only this part of it; its pixels are those of the whole picture, bit for bit.
    pub crop: Option<Region>,
    /// What it shows.
    pub integrator: Integrator,
    /// How many reflections after one another, at most.
    pub max_depth: u32,
    /// How many bounces a path that is followed by chance has, at most.
    pub path_depth: u32,
    /// Whether, under [`Whitted`](Integrator::Whitted), light comes through clear matter in shadows: straight, as an approximation,
    /// with what surfaces and insides leave of it.
    pub clear_shadows: bool,
    /// Rays that could add less than this share of what they meet are not traced; 0 traces them all. A pixel is darker
    /// for it by at most this share of the brightest radiance that any such ray would have met, and never brighter.
    pub weight_cutoff: f32,
    /// Up to how far away a surface hides the sky from another, metres; infinite for any distance.
    pub occlusion_distance: f64,
    /// What random choices go by: another seed makes other ones, the same one makes the same bits.
    pub seed: u32,
    /// Samples per pixel, at least 1; one lies in the pixel's centre, and is seen as through a pinhole.
    pub samples: u32,
    /// Only those of these numbers, which begin with 0: the film is to hold those before, and goes on from there. All of
    /// them if left out. Bits are those of all traced at once.
    pub range: Option<Range<u32>>,
    /// In how many sequences that know nothing of each other samples are counted off in turn; 1 is the most even.
    pub sequences: u32,
    /// Rays to a lamp from a point where it has no closed form, in all samples of a pixel together; each sample has
    /// four at least.
    pub lamp_rays: u32,
    /// How light from surfaces is found.
    pub lamp_light: LampLight,
    /// Where in a pixel samples lie.
    pub pattern: Pattern,
    /// How much each place in and round a pixel counts.
    pub filter: Filter,
    /// The most that a channel of one sample counts; brighter ones are cut off, which darkens the picture. Infinite for all.
    pub clamp: f32,
    /// How pixels are shown that outlines cross.
    pub edges: Edges,
    /// Which [standard errors](crate::Film::standard_error) the film is to tell; the picture's bits do not depend on
    /// it.
    pub moments: Moments,
    /// Which work that cannot matter is left out; the picture's bits do not depend on it.
    pub skip: Skip,
    /// Vector instructions to trace with; without, the best that the CPU has. The picture's bits do not depend on them.
    pub instructions: Option<Instructions>,
}

/// Which standard errors a film is to tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Moments {
    /// None.
    #[default]
    None,
    /// Those of luminances: 8 bytes a pixel.
    Luminance,
    /// Those of luminances, and of red, green and blue each: 32 bytes a pixel.
    Channels,
}

/// How pixels are shown that the outlines of things cross.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Edges {
    /// As any other: by their samples.
    #[default]
    Off,
    /// By the area of each part that outlines divide them into, and what its centroid shows. Under
    /// [`Whitted`](Integrator::Whitted) alone; other integrators sample them.
    Exact,
}

impl Edges {
    /// Both ways.
    pub const ALL: &'static [Self] = &[Self::Off, Self::Exact];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Exact => "exact",
        }
    }

    /// The way of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|edges| edges.name() == name)
    }
}

/// How light from surfaces is found; other ways than the first are there to be compared with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LampLight {
    /// In closed form, and by rays where there is none.
    #[default]
    Exact,
    /// By rays alone, with what lamps give where nothing blocks them as control variate.
    Rays,
    /// By rays to points spread evenly over a lamp's area alone, as `wide` sends them; by other backends over the solid angle.
    PlainRays,
}

/// Work that is left out because it cannot matter. Switched off, the same bits are computed the long way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Skip {
    /// Shapes that no camera ray of a tile can see first are not tested for it.
    pub hidden: bool,
    /// Shapes that cannot stand between what a tile shows and a light are not tested for its shadows.
    pub shafts: bool,
    /// Shapes that no ray of a stream of reflected rays can meet are not tested for it, and mirrored rays that can meet
    /// nothing are not made.
    pub beams: bool,
    /// Lights are not asked about parts of the picture that lie outside their cones.
    pub unreached: bool,
    /// Tiles that show nothing are not written again where they showed nothing before.
    pub blank: bool,
    /// Trees of meshes are not walked by each packet of rays alone where rays side by side have a common origin.
    pub walks: bool,
    /// Of masses of a mesh's triangles in one plane, those in a plane that a ray leaves or has met are not each held against it.
    pub planes: bool,
}

impl Skip {
    /// Everything that can be left out is.
    pub const ALL: Self = Self {
        hidden: true,
        shafts: true,
        beams: true,
        unreached: true,
        blank: true,
        walks: true,
        planes: true,
    };
    /// Nothing is left out.
    pub const NOTHING: Self = Self {
        hidden: false,
        shafts: false,
        beams: false,
        unreached: false,
        blank: false,
        walks: false,
        planes: false,
    };
}

impl View {
    /// By the default integrator, through a pixel's centre, five reflections deep.
    #[must_use]
    pub const fn new(camera: Camera, size: Size) -> Self {
        Self {
            camera,
            size,
            crop: None,
            integrator: Integrator::ALL[0],
            max_depth: 5,
            path_depth: u32::MAX,
            clear_shadows: true,
            weight_cutoff: WEIGHT_CUTOFF,
            occlusion_distance: f64::INFINITY,
            seed: 0,
            samples: 1,
            range: None,
            sequences: 1,
            lamp_rays: LAMP_RAYS,
            lamp_light: LampLight::Exact,
            pattern: Pattern::ALL[0],
            filter: Filter::ALL[0],
            clamp: f32::INFINITY,
            edges: Edges::Off,
            moments: Moments::None,
            skip: Skip::ALL,
            instructions: None,
        }
    }

    /// As the scene's settings say, from the given camera.
    #[must_use]
    pub fn of(scene: &Scene, camera: Camera, size: Size) -> Self {
        let settings = scene.settings();
        Self {
            integrator: settings.integrator(),
            max_depth: settings.max_depth(),
            occlusion_distance: settings.occlusion_distance().unwrap_or(f64::INFINITY),
            samples: settings.samples(),
            ..Self::new(camera, size)
        }
    }

    /// With so many samples a pixel.
    #[must_use]
    pub fn with_samples(self, samples: u32) -> Self {
        Self { samples, ..self }
    }

    /// The numbers of the samples that are traced.
    #[must_use]
    pub fn traced_samples(&self) -> Range<u32> {
        let all = self.samples.max(1);
        let range = self.range.clone().unwrap_or(0..all);
        range.start.min(all)..range.end.min(all)
    }

    /// The side of the square of a pixel that each of its samples stands for.
    pub(crate) fn side_of_sample(&self) -> f64 {
        1.0 / f64::from(self.samples.max(1)).sqrt()
    }

    /// Rays to a lamp from a point that one sample leads to, where it has no closed form.
    pub(crate) fn lamp_rays_of_sample(&self) -> u32 {
        // Fewer would tell too little of how much of the lamp is open.
        self.lamp_rays.div_ceil(self.samples.max(1)).max(4).next_multiple_of(2)
    }

    /// The part of the picture that is traced: what of the crop lies within it, or all of it.
    #[must_use]
    pub fn region(&self) -> Region {
        self.crop.unwrap_or(Region::from(self.size)).within(self.size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_region_is_cut_to_its_picture() {
        let picture = Size::new(40, 30);
        assert_eq!(
            Region::new(30, 5, Size::new(20, 10)).within(picture),
            Region::new(30, 5, Size::new(10, 10))
        );
        assert_eq!(Region::new(50, 5, Size::new(20, 10)).within(picture).size.pixels(), 0);
        assert_eq!(Region::from(picture).within(picture), Region::from(picture));
    }
}
