//! Which pixel of a traced film lies under which of the picture? A film may be coarser, and by no whole number.

/// How the pixels of a traced film lie under those of the picture: both have the same middle and the same upper and
/// lower edge, as a camera sees them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fit {
    film: (u32, u32),
    picture: (u32, u32),
}

impl Fit {
    /// Of a film and a picture with these sizes.
    pub(crate) fn new(film: (u32, u32), picture: (u32, u32)) -> Self {
        Self { film, picture }
    }

    /// Pixels of the picture to a pixel of the film, along each axis.
    pub(crate) fn scale(self) -> f64 {
        f64::from(self.picture.1) / f64::from(self.film.1.max(1))
    }

    /// Where the corner (x, y) of a film's pixel lies in the picture.
    pub(crate) fn corner(self, x: u32, y: u32) -> (f64, f64) {
        let across = (f64::from(x) - 0.5 * f64::from(self.film.0)) * self.scale();
        (across + 0.5 * f64::from(self.picture.0), f64::from(y) * self.scale())
    }

    /// The film's pixel under a point of the picture, if there is one.
    pub(crate) fn pixel(self, (x, y): (f64, f64)) -> Option<(u32, u32)> {
        let across = (x - 0.5 * f64::from(self.picture.0)) / self.scale() + 0.5 * f64::from(self.film.0);
        let down = y / self.scale();
        let within = |at: f64, count: u32| (at >= 0.0 && at < f64::from(count)).then_some(at as u32);
        Some((within(across, self.film.0)?, within(down, self.film.1)?))
    }

    /// For the middle of each column of the picture the film's column before it and the share of the next, of 256.
    pub(crate) fn columns(self) -> Vec<Tap> {
        let (film, picture) = (f64::from(self.film.0), f64::from(self.picture.0));
        let at = |x: u32| (f64::from(x) + 0.5 - 0.5 * picture) / self.scale() + 0.5 * film;
        (0..self.picture.0).map(|x| Tap::new(at(x), self.film.0)).collect()
    }

    /// The same for rows.
    pub(crate) fn rows(self) -> Vec<Tap> {
        let at = |y: u32| (f64::from(y) + 0.5) / self.scale();
        (0..self.picture.1).map(|y| Tap::new(at(y), self.film.1)).collect()
    }
}

/// Two neighbouring pixels, and how much the second counts, of 256.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tap {
    pub(crate) first: usize,
    pub(crate) second: usize,
    pub(crate) share: u32,
}

impl Tap {
    /// The pixels whose middles lie about `at`, held within 0..`count`.
    fn new(at: f64, count: u32) -> Self {
        let last = f64::from(count.saturating_sub(1));
        let before = (at - 0.5).clamp(0.0, last);
        let first = before.floor();
        let share = ((before - first) * 256.0) as u32;
        Self { first: first as usize, second: (first + 1.0).min(last) as usize, share }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn film_and_picture_share_their_middle_and_their_edges() {
        let fit = Fit::new((101, 88), (805, 701));
        assert_eq!(fit.corner(0, 0).1, 0.0);
        assert!((fit.corner(0, 88).1 - 701.0).abs() < 1e-9);
        assert!((fit.corner(50, 0).0 + fit.corner(51, 0).0 - 805.0).abs() < 1e-9);
        let (x, y) = fit.corner(17, 40);
        assert_eq!(fit.pixel((x + 1.0, y + 1.0)), Some((17, 40)));
        assert_eq!([fit.pixel((4.0, 701.5)), fit.pixel((-9.0, 4.0))], [None; 2]);
    }
}
