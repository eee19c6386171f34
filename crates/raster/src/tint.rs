//! In which colour is a gizmo drawn?

use catoptra_core::{Rgb, srgb_encoded};
use tiny_skia::Color;

/// A display colour, sRGB encoded, without opacity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Tint(pub(crate) u8, pub(crate) u8, pub(crate) u8);

impl Tint {
    /// What is selected.
    pub(crate) const ACCENT: Tint = Tint(255, 176, 46);
    /// The x axis.
    pub(crate) const X: Tint = Tint(255, 84, 92);
    /// The y axis.
    pub(crate) const Y: Tint = Tint(138, 217, 72);
    /// The z axis.
    pub(crate) const Z: Tint = Tint(84, 156, 255);
    /// Quiet lines: the grid, cameras.
    pub(crate) const QUIET: Tint = Tint(226, 232, 240);
    /// Casings.
    pub(crate) const DARK: Tint = Tint(8, 10, 16);

    /// The hue of a light, whatever its strength: the brightest channel becomes full, and an eighth of white keeps a
    /// pure blue readable. Grey for a light without power.
    pub(crate) fn of_light(power: Rgb) -> Tint {
        let brightest = power.r.max(power.g).max(power.b);
        if !(brightest > 0.0 && brightest.is_finite()) {
            return Tint(150, 150, 150);
        }
        let channel = |value: f64| {
            let encoded = srgb_encoded((value / brightest).clamp(0.0, 1.0));
            (255.0 * (encoded + (1.0 - encoded) * 0.125)).round() as u8
        };
        Tint(channel(power.r), channel(power.g), channel(power.b))
    }

    /// This tint with a fraction of white mixed in.
    pub(crate) fn lighter(self, fraction: f32) -> Tint {
        let mix = |value: u8| {
            let value = f32::from(value);
            (value + (255.0 - value) * fraction.clamp(0.0, 1.0)).round() as u8
        };
        Tint(mix(self.0), mix(self.1), mix(self.2))
    }

    /// This tint at an opacity of 0 to 1.
    pub(crate) fn color(self, opacity: f32) -> Color {
        let alpha = (255.0 * opacity.clamp(0.0, 1.0)).round() as u8;
        Color::from_rgba8(self.0, self.1, self.2, alpha)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_keeps_its_hue_at_any_strength() {
        assert_eq!(Tint::of_light(Rgb::new(1e-6, 0.0, 0.0)), Tint::of_light(Rgb::new(4e9, 0.0, 0.0)));
        assert_eq!(Tint::of_light(Rgb::new(2.0, 2.0, 2.0)), Tint(255, 255, 255));
    }

    #[test]
    fn a_light_without_power_is_grey() {
        assert_eq!(Tint::of_light(Rgb::new(0.0, 0.0, 0.0)), Tint(150, 150, 150));
    }
}
