//! How bright is the picture shown? Stops of the window's own, by hand or after what is seen; the file does not know of them.

use catoptra_core::Rgb;
use catoptra_tracer::{Film, Size};

/// What the middle of a picture is brought to, linear: that of the grey cards which photographers meter by.
const MIDDLE_GREY: f64 = 0.18;

/// The share of pixels that may be brighter than white when exposure follows the picture.
const BRIGHTEST: f64 = 0.02;

/// Pixels that are looked at, about: more tell nothing new.
const LOOKS: u32 = 128;

/// Stops of a step by key.
pub(crate) const STEP: f64 = 1.0 / 3.0;

/// Stops either way that the slider offers.
pub(crate) const MOST: f64 = 10.0;

/// Differences in stops that nobody sees: exposure stays, so that it does not flicker while a picture gets finer.
const UNSEEN: f64 = 0.04;

/// The window's exposure, on top of the scene's.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Exposure {
    /// Stops, each a factor of two.
    pub(crate) stops: f64,
    /// Whether they follow the picture.
    pub(crate) automatic: bool,
}

impl Exposure {
    /// So many stops more, by hand from now on.
    pub(crate) fn stepped(self, stops: f64) -> Self {
        // A third of a stop thrice is a whole one again.
        let stops = ((self.stops + stops) * 60.0).round() / 60.0;
        Self { stops: stops.clamp(-MOST, MOST), automatic: false }
    }

    /// Follows a picture, if it is to; `scene` is the exposure that the scene asks for.
    pub(crate) fn followed(self, film: &Film, scene: f64) -> Self {
        let wanted = if self.automatic { of_film(film) } else { None };
        match wanted.map(|stops| stops - scene) {
            Some(stops) if (stops - self.stops).abs() > UNSEEN => Self { stops, ..self },
            _ => self,
        }
    }

    /// What is told of it; nothing where it changes nothing.
    pub(crate) fn words(self) -> Option<String> {
        let told = self.automatic || self.stops != 0.0;
        told.then(|| {
            format!("exposure {:+.1}{}", self.stops, if self.automatic { " (automatic)" } else { "" })
        })
    }
}

/// The stops that bring the mean of what is seen, by stops and not by light, to a middle grey, but leave no more than a few
/// pixels white; `None` for a picture that is all dark.
fn of_film(film: &Film) -> Option<f64> {
    let Size { width, height } = film.size();
    let step = width.max(height).div_ceil(LOOKS).max(1);
    let mut seen: Vec<f64> = (0..height)
        .step_by(step as usize)
        .flat_map(|y| (0..width).step_by(step as usize).map(move |x| (x, y)))
        .map(|(x, y)| film.radiance(x, y).map(f64::from))
        .map(|[r, g, b]| Rgb::new(r, g, b).luminance())
        .filter(|light| *light > 0.0)
        .collect();
    seen.sort_unstable_by(f64::total_cmp);
    let bright = *seen.get(((seen.len() as f64) * (1.0 - BRIGHTEST)) as usize)?;
    let mean = seen.iter().map(|light| light.log2()).sum::<f64>() / seen.len() as f64;
    let stops = (MIDDLE_GREY.log2() - mean).min(-bright.log2());
    stops.is_finite().then(|| stops.clamp(-MOST, MOST))
}

#[cfg(test)]
mod tests {
    use catoptra_core::{Camera, Scene, Settings};
    use catoptra_tracer::{Control, Pool, Snapshot, View, backends, render};

    use super::*;

    /// A picture of that light alone.
    fn film(light: f64) -> Film {
        let mut scene = Scene::new();
        let background = Settings::default().with_background(Rgb::grey(light)).unwrap();
        scene.apply(catoptra_core::Edit::Settings(background)).unwrap();
        let eye = catoptra_core::glam::DVec3::Z;
        let camera = Camera::look_at(eye, eye - eye * 2.0, catoptra_core::glam::DVec3::Y, 1.0).unwrap();
        let (view, pool) = (View::new(camera, Size::new(8, 6)), Pool::new(1).unwrap());
        let mut film = Film::new(view.size);
        let snapshot = Snapshot::extract(&scene, &pool);
        render(backends()[0], &snapshot, &view, &mut film, &pool, &Control::default()).unwrap();
        film
    }

    #[test]
    fn it_brings_what_is_seen_to_a_middle_grey() {
        let automatic = Exposure { automatic: true, ..Exposure::default() };
        for (light, scene) in [(0.18, 0.0), (0.01, 0.0), (7.0, 0.0), (0.5, 1.5)] {
            let stops = automatic.followed(&film(light), scene).stops;
            let shown = light * (stops + scene).exp2();
            assert!((shown - MIDDLE_GREY).abs() < 1e-2, "{light} is shown as {shown}");
        }
        assert_eq!(automatic.followed(&film(0.0), 0.0), automatic, "darkness asks for nothing");
        let by_hand = Exposure { stops: 1.0, automatic: false };
        assert_eq!(by_hand.followed(&film(7.0), 0.0), by_hand);
    }

    #[test]
    fn three_steps_are_a_stop_and_end_what_follows_by_itself() {
        let mut exposure = Exposure { stops: 0.0, automatic: true };
        for _ in 0..3 {
            exposure = exposure.stepped(STEP);
        }
        assert_eq!(exposure, Exposure { stops: 1.0, automatic: false });
        assert_eq!(exposure.words().as_deref(), Some("exposure +1.0"));
        assert_eq!(Exposure::default().words(), None);
    }
}
