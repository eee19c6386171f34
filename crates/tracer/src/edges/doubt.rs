//! Where are no outlines known, and which pixels there need more samples?
//!
//! Meshes, round mirrors and round surfaces that shadows may fall on have outlines of a higher degree. Where they may be seen, what
//! the corners of a pixel show tells whether something ends in it: a thin thing between the corners is missed.

use catoptra_core::glam::DVec3;

use super::body::Body;
use super::find::near;
use super::sight::{EVERYWHERE, Sight};
use super::stage::{Lamp, Stage, Subject};
use super::{EdgeList, PixelPieces, Places};
use crate::numeric::{DOUBT_CONTRAST, MIRRORS_DEEP, MOST_SHADOWS};
use crate::{Region, View};

/// The part of the picture in which an eye sees a subject whose outlines are not known.
pub(super) fn doubtful_part(
    sight: &Sight,
    stage: &Stage,
    subject: &Subject,
    mirrors: usize,
) -> Option<Doubt> {
    let round = |center: DVec3, radius: f64| sight.bounds_of_ball(center, radius);
    let (bounds, whole) = match &subject.body {
        Body::Other(None) => (EVERYWHERE, true),
        Body::Other(Some(bounds)) => (round(bounds.centre(), bounds.size().length() / 2.0)?, true),
        Body::Ball { center, radius } => {
            let whole = subject.mirror.is_some() || (subject.grid.is_some() && mirrors > 0);
            let shaded = subject.lit && stage.may_shade(&subject.body, *center, *radius);
            if !(whole || shaded) {
                return None;
            }
            (round(*center, *radius)?, whole)
        }
        Body::Plane(_) | Body::Flats { .. } => {
            let untold = subject.lit && stage.shadows() > MOST_SHADOWS;
            let deep = subject.mirror.is_some() && mirrors >= MIRRORS_DEEP;
            if !untold && !deep {
                return None;
            }
            let bounds = match subject.body.bounds() {
                Some(bounds) => round(bounds.centre(), bounds.size().length() / 2.0)?,
                None => EVERYWHERE,
            };
            (bounds, deep)
        }
    };
    Some(Doubt { bounds, whole })
}

/// A part of the picture in which not all outlines are known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Doubt {
    /// Left, top, right, bottom.
    pub(super) bounds: [f64; 4],
    /// Whether what is seen there may look anyhow between the outlines that are known, so that pieces tell nothing.
    pub(super) whole: bool,
}

impl Stage {
    /// Whether anything else may stand between a ball and a lamp.
    fn may_shade(&self, own: &Body, center: DVec3, radius: f64) -> bool {
        let stands = |lamp: &Lamp, body: &Body| {
            let Some(bounds) = body.bounds().filter(|_| !std::ptr::eq(body, own)) else { return false };
            let (middle, size) = (bounds.centre() - center, bounds.size().length() / 2.0);
            let (way, most) = match lamp {
                Lamp::At(place) => (*place - center, 1.0),
                Lamp::Along(way) => (-*way, f64::INFINITY),
            };
            let along = (middle.dot(way) / way.length_squared()).clamp(0.0, most);
            !((middle - way * along).length() > size + radius)
        };
        self.lamps.iter().any(|lamp| self.bodies().any(|body| stands(lamp, body)))
    }

    /// How many pairs of a surface and what may throw a shadow on it there are.
    pub(super) fn shadows(&self) -> usize {
        self.subjects.len() * self.subjects.len() * self.lamps.len()
    }
}

/// The pixels of a part of the picture that are in doubt, and the corners that they have in common.
#[derive(Debug, Default)]
pub(crate) struct Doubts {
    /// Column and row from the part's corner, and the numbers of the four corners.
    pixels: Vec<([u32; 2], [u32; 4])>,
    pub(crate) corners: Places,
    numbers: Vec<u32>,
}

impl Doubts {
    /// Finds those of a part of the picture.
    pub(super) fn find(&mut self, edges: &EdgeList, region: Region, parted: &PixelPieces) {
        self.pixels.clear();
        self.corners.clear();
        let parts: Vec<&Doubt> = edges.doubts.iter().filter(|part| near(&part.bounds, region)).collect();
        if parts.is_empty() {
            return;
        }
        let (width, height) = (region.size.width, region.size.height);
        let across = width + 1;
        self.numbers.clear();
        self.numbers.resize((across * (height + 1)) as usize, u32::MAX);
        let mut known = vec![false; region.size.pixels()];
        for ([x, y], ..) in parted.pixels() {
            known[(y * width + x) as usize] = true;
        }
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let pixel = Region::new(region.x + x, region.y + y, crate::Size::new(1, 1));
            let told = known[(y * width + x) as usize];
            if !parts.iter().any(|part| (part.whole || !told) && near(&part.bounds, pixel)) {
                continue;
            }
            let corners = [[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]].map(|[x, y]| {
                let number = &mut self.numbers[(y * across + x) as usize];
                if *number == u32::MAX {
                    *number = self.corners.len() as u32;
                    self.corners.push(f64::from(region.x + x), f64::from(region.y + y), 1.0);
                }
                *number
            });
            self.pixels.push(([x, y], corners));
        }
    }

    /// Adds samples for the pixels whose corners differ from each other or from what the pixel shows so far.
    pub(super) fn sample(
        &self,
        region: Region,
        view: &View,
        (light, shown): (&[[f64; 3]], impl Fn(u32, u32) -> [f64; 3]),
        found: &mut PixelPieces,
    ) {
        found.clear();
        for ([x, y], corners) in &self.pixels {
            let [a, b, c, d] = corners.map(|corner| light[corner as usize]);
            if differ(&[a, b, c, d, shown(*x, *y)]) {
                found.add_samples([*x, *y], region, view.seed);
            }
        }
    }
}

/// Whether what the corners of a pixel (two above, two below) and its middle show is farther from changing evenly than
/// shading alone would make it.
///
/// Of a step anywhere between the corners the middle is not the mean, or the corners are not those of a plane.
fn differ([a, b, c, d, middle]: &[[f64; 3]; 5]) -> bool {
    (0..3).any(|i| {
        let turn = (a[i] + d[i]) - (b[i] + c[i]);
        let bulge = 4.0 * middle[i] - (a[i] + b[i] + c[i] + d[i]);
        let most = a[i].max(b[i]).max(c[i]).max(d[i]).max(middle[i]);
        turn.abs().max(bulge.abs()) > most * DOUBT_CONTRAST
    })
}
