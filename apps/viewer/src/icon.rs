//! What does the window look like in a list of windows? A lit ball, as in `catoptra.svg`.

use winit::window::Icon;

/// Width and height in pixels.
const SIDE: u32 = 64;

/// The ball's middle and radius.
const BALL: (f32, f32, f32) = (32.0, 31.0, 21.0);

/// Where the light comes from, of length 1.
const LIGHT: [f32; 3] = [-0.48, -0.6, 0.64];

/// The icon; `None` where windows of this system take none.
pub(crate) fn icon() -> Option<Icon> {
    Icon::from_rgba(pixels(), SIDE, SIDE).ok()
}

/// Red, green, blue and opacity, row by row.
fn pixels() -> Vec<u8> {
    let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x as f32 + 0.5, y as f32 + 0.5)));
    places.flat_map(|(x, y)| pixel(x, y)).collect()
}

fn pixel(x: f32, y: f32) -> [u8; 4] {
    let (cx, cy, radius) = BALL;
    let (u, v) = ((x - cx) / radius, (y - cy) / radius);
    let away = u.hypot(v);
    // A pixel of fading along the rim.
    let covered = ((1.0 - away) * radius + 0.5).clamp(0.0, 1.0);
    let towards = (1.0 - away * away).max(0.0).sqrt();
    let lit = (u * LIGHT[0] + v * LIGHT[1] + towards * LIGHT[2]).max(0.0);
    let shine = lit.powi(24);
    let channel = |full: f32| ((0.12 + 0.88 * lit) * full + 0.7 * shine * (255.0 - full)).min(255.0) as u8;
    [channel(255.0), channel(176.0), channel(46.0), (255.0 * covered) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_icon_is_a_ball_that_is_lit_from_the_left_above() {
        assert!(icon().is_some());
        let at = |x: f32, y: f32| pixel(x, y);
        assert_eq!(at(1.0, 1.0)[3], 0, "nothing in the corner");
        assert_eq!(at(32.0, 31.0)[3], 255);
        assert!(at(24.0, 22.0)[0] > at(42.0, 42.0)[0] + 60);
    }

    #[test]
    fn the_desktop_entry_names_the_program_its_icon_and_its_window() {
        let entry = include_str!("../catoptra.desktop");
        let value = |key: &str| {
            entry.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix('=').map(str::to_owned))
        };
        assert!(entry.starts_with("[Desktop Entry]\n"));
        assert_eq!(value("Exec").as_deref(), Some("catoptra-viewer %f"));
        assert_eq!(value("Icon").as_deref(), Some("catoptra"));
        assert_eq!(value("StartupWMClass").as_deref(), Some(crate::screen::CLASS));
    }
}
