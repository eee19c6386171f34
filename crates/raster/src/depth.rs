//! Is a point of an overlay hidden behind a traced surface?

/// How far each traced pixel sees; borrowed from a film for the time of one drawing.
#[derive(Debug, Clone, Copy)]
pub struct DepthField<'a> {
    /// Pixels in a row; may differ from the picture's (a coarse film under a fine picture).
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Metres from the eye along each pixel's ray, row-major, `width` x `height`; infinite where nothing was hit.
    /// Where the slice is too short or holds NaN, nothing is taken to be hit.
    pub metres: &'a [f32],
}

/// What a line may lie behind a surface and still be drawn as lying on it, as a fraction of the distance: the film
/// rounds to f32 (6e-8) and lines are often laid exactly onto a floor or round a box.
const CONTACT: f64 = 2e-3;

impl DepthField<'_> {
    /// Whether something `distance` metres from the eye is hidden at (`u`, `v`), fractions of the picture's width
    /// and height.
    ///
    /// It is hidden where all of the nine pixels about it see something nearer, so that a line along the rim of a
    /// surface, or on a surface seen edge-on, is not broken up by the width of a pixel.
    pub(crate) fn hides(&self, u: f64, v: f64, distance: f64) -> bool {
        if !((0.0..1.0).contains(&u) && (0.0..1.0).contains(&v)) {
            return false;
        }
        // In 0..width by the check above.
        let (column, row) = ((u * f64::from(self.width)) as usize, (v * f64::from(self.height)) as usize);
        let (width, height) = (self.width as usize, self.height as usize);
        let limit = (distance / (1.0 + CONTACT)) as f32;
        for y in row.saturating_sub(1)..(row + 2).min(height) {
            let first = y * width;
            for x in column.saturating_sub(1)..(column + 2).min(width) {
                match self.metres.get(first + x) {
                    Some(&metres) if metres < limit => {}
                    _ => return false,
                }
            }
        }
        width > 0 && height > 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall(metres: &[f32]) -> DepthField<'_> {
        DepthField { width: 4, height: 4, metres }
    }

    #[test]
    fn what_lies_behind_is_hidden_and_what_lies_before_is_not() {
        let metres = [5.0; 16];
        assert!(wall(&metres).hides(0.5, 0.5, 6.0));
        assert!(!wall(&metres).hides(0.5, 0.5, 4.0));
    }

    #[test]
    fn what_lies_on_the_surface_is_not_hidden() {
        assert!(!wall(&[5.0; 16]).hides(0.5, 0.5, 5.0 + 1e-6));
    }

    #[test]
    fn a_free_neighbour_keeps_a_rim_visible() {
        let mut metres = [5.0; 16];
        metres[1] = f32::INFINITY;
        assert!(!wall(&metres).hides(0.4, 0.4, 6.0));
        assert!(wall(&metres).hides(0.8, 0.8, 6.0));
    }

    #[test]
    fn a_broken_field_hides_nothing() {
        assert!(!wall(&[1.0; 3]).hides(0.5, 0.5, 6.0));
        assert!(!wall(&[f32::NAN; 16]).hides(0.5, 0.5, 6.0));
        assert!(!wall(&[1.0; 16]).hides(f64::NAN, 0.5, 6.0));
        assert!(!DepthField { width: 0, height: 0, metres: &[] }.hides(0.5, 0.5, 6.0));
    }
}
