//! How do lines of the world become strokes in the picture: cased, and fainter and dashed where they are hidden?
//!
//! Lines are gathered by ink and painted together, all casings under all cores, so that crossings stay clean and the
//! painter runs once per ink and not once per line.

use crate::glow::{self, Ramp};
use crate::hair;
use crate::ink::{CASING, Ink};
use crate::layer::Touched;
use crate::projection::{Projection, Spot};
use crate::sight::Sight;
use crate::tint::Tint;
use catoptra_core::glam::DVec3;
use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Shader, Stroke, StrokeDash, Transform,
};

/// Opacity of a hidden line relative to a visible one.
const HIDDEN: f32 = 0.45;
/// Dash and gap in pixels.
const DASH: [f32; 2] = [4.0, 3.5];

/// The lines gathered for one ink.
struct Strokes {
    ink: Ink,
    visible: PathBuilder,
    hidden: PathBuilder,
}

/// Where the last piece of a curve ended, so that the next one goes on from there.
type Pen = Option<(Spot, bool)>;

/// A pixmap seen from a camera.
pub(crate) struct Canvas<'a> {
    pub(crate) sight: Sight<'a>,
    pixmap: &'a mut Pixmap,
    touched: &'a mut Touched,
    strokes: Vec<Strokes>,
}

impl<'a> Canvas<'a> {
    /// A canvas over a pixmap.
    pub(crate) fn new(sight: Sight<'a>, (pixmap, touched): (&'a mut Pixmap, &'a mut Touched)) -> Self {
        Self { sight, pixmap, touched, strokes: Vec::new() }
    }

    /// The view drawn into.
    pub(crate) fn view(&self) -> &'a Projection {
        self.sight.view
    }

    /// Pixels in a pixel of a display of scale 1.
    pub(crate) fn scale(&self) -> f32 {
        self.sight.scale
    }

    /// Draws a segment between two points of the world.
    pub(crate) fn segment(&mut self, start: DVec3, end: DVec3, ink: Ink) {
        self.curve(&[start, end], ink);
    }

    /// Draws a line through points of the world; for a closed curve the last point repeats the first.
    pub(crate) fn curve(&mut self, points: &[DVec3], ink: Ink) {
        let batch = self.batch(ink);
        let (strokes, sight) = (&mut self.strokes[batch], self.sight);
        let mut pen: Pen = None;
        for pair in points.windows(2) {
            match sight.view.segment(pair[0], pair[1]) {
                Some([from, to]) => {
                    sight.split(from, to, |from, to, hidden| strokes.append(from, to, hidden, &mut pen));
                }
                None => pen = None,
            }
        }
    }

    /// Draws a thin straight line at once, its opacity changing from end to end as factors of the ink's; its hidden
    /// parts are left out. For lines by the hundred.
    pub(crate) fn hair(&mut self, ends: [(DVec3, f32); 2], ink: Ink) {
        let Some([from, to]) = self.view().segment(ends[0].0, ends[1].0) else { return };
        let length = from.pixels_to(to);
        if length == 0.0 {
            return;
        }
        let sight = self.sight;
        let opacity =
            |spot: Spot| ends[0].1 + (ends[1].1 - ends[0].1) * (from.pixels_to(spot) / length) as f32;
        sight.split(from, to, |from, to, hidden| {
            if !hidden {
                self.hair_seen([(from, opacity(from)), (to, opacity(to))], ink);
            }
        });
    }

    /// Draws a straight line as [`Self::segment`] does, its visible parts at once and several times faster; its ends
    /// are cut level or upright, so it is for lines whose ends meet other things.
    pub(crate) fn straight(&mut self, start: DVec3, end: DVec3, ink: Ink) {
        let Some([from, to]) = self.view().segment(start, end) else { return };
        let (batch, sight) = (self.batch(ink), self.sight);
        let mut pen: Pen = None;
        sight.split(from, to, |from, to, hidden| {
            if hidden {
                self.strokes[batch].append(from, to, hidden, &mut pen);
            } else {
                self.hair_seen([(from, 1.0), (to, 1.0)], ink);
            }
        });
    }

    fn hair_seen(&mut self, ends: [(Spot, f32); 2], ink: Ink) {
        hair::draw(self.pixmap, ends, ink, self.scale());
        self.touched.add_line(ends[0].0, ends[1].0, (ink.width + 2.0 * CASING) * self.scale());
    }

    /// Fills nested convex outlines, each with the opacity times the ramp.
    pub(crate) fn glow(&mut self, outlines: &[Vec<Spot>], paint: (Tint, f32), ramp: Ramp) {
        if let Some(bounds) = glow::fill(self.pixmap, outlines, paint, ramp) {
            self.touched.add(bounds, 0.0);
        }
    }

    /// Fills a path given in pixels.
    pub(crate) fn paint(&mut self, path: &Path, shader: Shader<'_>) {
        let paint = Paint { shader, ..Paint::default() };
        self.pixmap.fill_path(path, &paint, FillRule::Winding, Transform::identity(), None);
        self.touched.add(path.bounds(), 0.0);
    }

    /// Strokes a path given in pixels at once, with its casing; fainter when it is `hidden`.
    pub(crate) fn stroke(&mut self, path: &Path, ink: Ink, hidden: bool) {
        let ink = if hidden { ink.with_opacity(ink.opacity * HIDDEN) } else { ink };
        self.casing(path, ink);
        self.core(path, ink, None);
    }

    /// Paints what was gathered.
    pub(crate) fn flush(&mut self) {
        let strokes: Vec<(Ink, Option<Path>, Option<Path>)> = std::mem::take(&mut self.strokes)
            .into_iter()
            .map(|strokes| (strokes.ink, strokes.visible.finish(), strokes.hidden.finish()))
            .collect();
        for (ink, _, hidden) in &strokes {
            if let Some(path) = hidden {
                let faint = ink.with_opacity(ink.opacity * HIDDEN);
                self.core(path, faint, StrokeDash::new(DASH.map(|length| length * self.scale()).into(), 0.0));
            }
        }
        for (ink, visible, _) in &strokes {
            if let Some(path) = visible {
                self.casing(path, *ink);
            }
        }
        for (ink, visible, _) in &strokes {
            if let Some(path) = visible {
                self.core(path, *ink, None);
            }
        }
    }

    fn casing(&mut self, path: &Path, ink: Ink) {
        let opacity = ink.casing * ink.opacity;
        if opacity > 0.0 {
            self.line(path, (Tint::DARK, opacity), ink.width + 2.0 * CASING, None);
        }
    }

    fn core(&mut self, path: &Path, ink: Ink, dash: Option<StrokeDash>) {
        self.line(path, (ink.tint, ink.opacity), ink.width, dash);
    }

    fn line(&mut self, path: &Path, (tint, opacity): (Tint, f32), width: f32, dash: Option<StrokeDash>) {
        let paint = Paint { shader: Shader::SolidColor(tint.color(opacity)), ..Paint::default() };
        let stroke = Stroke {
            width: width * self.scale(),
            line_cap: LineCap::Butt,
            line_join: LineJoin::Miter,
            dash,
            ..Stroke::default()
        };
        self.pixmap.stroke_path(path, &paint, &stroke, Transform::identity(), None);
        self.touched.add(path.bounds(), 2.0 * stroke.width);
    }

    fn batch(&mut self, ink: Ink) -> usize {
        self.strokes.iter().rposition(|strokes| strokes.ink == ink).unwrap_or_else(|| {
            self.strokes.push(Strokes { ink, visible: PathBuilder::new(), hidden: PathBuilder::new() });
            self.strokes.len() - 1
        })
    }
}

impl Strokes {
    fn append(&mut self, from: Spot, to: Spot, hidden: bool, pen: &mut Pen) {
        let path = if hidden { &mut self.hidden } else { &mut self.visible };
        if *pen != Some((from, hidden)) {
            path.move_to(from.x as f32, from.y as f32);
        }
        path.line_to(to.x as f32, to.y as f32);
        *pen = Some((to, hidden));
    }
}
