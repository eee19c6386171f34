//! Are pictures read and averaged as they should be, and do their smaller copies keep their light?

use glam::DVec2;

use super::{picture, random};
use crate::srgb_decoded;
use crate::texture::{Encoding, Filter, Image, TexturePoint, Wrap};

#[test]
fn smaller_copies_keep_the_light() {
    for [width, height] in [[64, 64], [13, 7], [1, 9], [5, 1], [100, 3]] {
        let image = picture(width, height, |x, y| ((x * 37 + y * 101) % 256) as u8);
        let levels = image.levels(Encoding::Srgb);
        let last = levels.size(levels.count() - 1);
        assert_eq!(last, DVec2::ONE);
        let at =
            TexturePoint { footprint: Some([DVec2::X * 2.0, DVec2::Y * 2.0]), ..TexturePoint::default() };
        let whole = levels.filtered([Wrap::Repeat; 2], Filter::Linear, at.uv, at.footprint, None).color.r;
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let mean: f64 =
            pixels.map(|(x, y)| image.pixel(x, y).color.r).sum::<f64>() / f64::from(width * height);
        // Each copy rounds to bytes once more: half a step of the curve there, 0.004, a few times.
        assert!((whole - mean).abs() < 6e-3, "{width} x {height}: {whole}, not {mean}");
    }
}

#[test]
fn memory_is_that_of_the_bytes_and_a_third_more() {
    let image = Image::from_bytes([64, 64], 3, vec![9; 3 * 64 * 64]).unwrap();
    assert_eq!(image.bytes(), 3 * 64 * 64);
    image.prepare(Encoding::Linear);
    let copies: usize = [32, 16, 8, 4, 2, 1].map(|n| 3 * n * n).iter().sum();
    assert_eq!(image.bytes(), 3 * 64 * 64 + copies);
    let floats = Image::from_floats([2, 2], 1, vec![0.5; 4], Encoding::Linear).unwrap();
    floats.prepare(Encoding::Linear);
    assert_eq!(floats.bytes(), 4 * 5);
}

#[test]
fn pictures_that_are_none_are_refused() {
    for (size, channels, bytes) in
        [([0, 1], 1, 0), ([2, 2], 1, 3), ([1, 1], 5, 5), ([1 << 16, 1 << 16], 1, 0)]
    {
        assert!(Image::from_bytes(size, channels, vec![0; bytes]).is_err(), "{size:?}");
    }
    for v in [f32::NAN, f32::INFINITY, -1.0] {
        assert!(Image::from_floats([1, 1], 1, vec![v], Encoding::Linear).is_err());
    }
}

#[test]
fn borders_are_wrapped_as_asked() {
    // Columns 0, 85, 170, 255.
    let image = picture(4, 1, |x, _| (x * 85) as u8);
    let levels = image.levels(Encoding::Linear);
    let at = |wrap, column: f64| {
        let uv = DVec2::new((column + 0.5) / 4.0, 0.5);
        (levels.filtered([wrap; 2], Filter::Nearest, uv, None, None).color.r * 3.0).round()
    };
    let row = |wrap| [-5, -2, -1, 0, 3, 4, 5, 8].map(|column| at(wrap, f64::from(column)));
    assert_eq!(row(Wrap::Repeat), [3.0, 2.0, 3.0, 0.0, 3.0, 0.0, 1.0, 0.0]);
    assert_eq!(row(Wrap::Mirror), [3.0, 1.0, 0.0, 0.0, 3.0, 3.0, 2.0, 0.0]);
    assert_eq!(row(Wrap::Clamp), [0.0, 0.0, 0.0, 0.0, 3.0, 3.0, 3.0, 3.0]);
}

#[test]
fn each_axis_is_wrapped_by_itself() {
    let image = picture(2, 2, |x, y| (x * 85 + y * 170) as u8);
    let levels = image.levels(Encoding::Linear);
    let at = |u: f64, v: f64| {
        let wrap = [Wrap::Repeat, Wrap::Clamp];
        levels.filtered(wrap, Filter::Nearest, DVec2::new(u, v), None, None).color.r * 3.0
    };
    // The upper row is 0 1, the lower one 2 3.
    assert_eq!(
        [at(1.25, 0.75), at(-0.25, 0.75), at(0.25, 1.25), at(0.75, -7.0)].map(f64::round),
        [0.0, 1.0, 0.0, 3.0]
    );
}

#[test]
fn a_picture_stands_upright_and_is_linear_between_pixels() {
    let image = picture(2, 2, |x, y| [[0, 255], [0, 0]][y as usize][x as usize]);
    let levels = image.levels(Encoding::Linear);
    let at = |u, v| levels.filtered([Wrap::Clamp; 2], Filter::Ewa, DVec2::new(u, v), None, None).color.r;
    assert_eq!((at(0.75, 0.75), at(0.75, 0.25), at(0.25, 0.75)), (1.0, 0.0, 0.0));
    assert!((at(0.5, 0.5) - 0.25).abs() < 1e-6 && (at(0.625, 0.75) - 0.75).abs() < 1e-6);
}

#[test]
fn ewa_blurs_along_the_footprint_and_not_across() {
    // Stripes across v, each 8 rows wide: a footprint along them 200 columns long, turned or not, keeps them.
    let stripes = picture(256, 256, |_, y| if y / 8 % 2 == 0 { 255 } else { 0 });
    let levels = stripes.levels(Encoding::Linear);
    let long = [DVec2::X * 14.0 / 256.0, DVec2::Y / 256.0];
    let show = |filter, row: f64, sides| {
        let uv = DVec2::new(0.4, 1.0 - row / 256.0);
        levels.filtered([Wrap::Repeat; 2], filter, uv, Some(sides), None).color.r
    };
    for sides in [long, [long[1], long[0]], [-long[0], long[1]]] {
        assert!(show(Filter::Ewa, 4.0, sides) > 0.99 && show(Filter::Ewa, 12.0, sides) < 0.01);
    }
    assert!((show(Filter::Linear, 4.0, long) - 0.5).abs() < 0.25, "{}", show(Filter::Linear, 4.0, long));
    // Across them it sees both.
    let across = [DVec2::Y * 100.0 / 256.0, DVec2::X / 256.0];
    assert!((show(Filter::Ewa, 4.0, across) - 0.5).abs() < 0.05, "{}", show(Filter::Ewa, 4.0, across));
    // A slanted one is as symmetric as it should be.
    let slanted = [DVec2::new(20.0, 20.0) / 256.0, DVec2::new(1.0, -1.0) / 256.0];
    assert!((show(Filter::Ewa, 8.0, slanted) - 0.5).abs() < 0.05, "{}", show(Filter::Ewa, 8.0, slanted));
}

#[test]
fn one_colour_stays_what_it_is_under_any_filter() {
    let image = Image::from_bytes([19, 33], 4, [200, 100, 50, 25].repeat(19 * 33)).unwrap();
    let mut state = 99;
    for _ in 0..200 {
        let mut vector = |size: f64| DVec2::new(random(&mut state) - 0.5, random(&mut state) - 0.5) * size;
        let (uv, sides) = (vector(10.0), [vector(0.5), vector(0.02)]);
        let found =
            image.levels(Encoding::Srgb).filtered([Wrap::Mirror; 2], Filter::Ewa, uv, Some(sides), None);
        let right = [200.0, 100.0, 50.0].map(|v| srgb_decoded(v / 255.0));
        for (found, right) in found.color.to_array().into_iter().zip(right) {
            assert!((found - right).abs() < 3e-3, "{found} {right}");
        }
        assert!((found.alpha - 25.0 / 255.0).abs() < 3e-3);
    }
}

#[test]
fn one_chosen_pixel_is_on_average_the_mean() {
    let image = picture(32, 32, |x, y| ((x * 97 + y * y * 31) % 256) as u8);
    let levels = image.levels(Encoding::Linear);
    for sides in
        [[DVec2::X * 0.2, DVec2::Y * 0.05], [DVec2::new(0.1, 0.1), DVec2::new(0.03, -0.01)], [DVec2::ZERO; 2]]
    {
        let (uv, steps) = (DVec2::new(0.37, 0.61), 100);
        let filtered =
            |numbers| levels.filtered([Wrap::Repeat; 2], Filter::Ewa, uv, Some(sides), numbers).color.r;
        let share = |i: u32| (f64::from(i) + 0.5) / f64::from(steps);
        let cells = (0..steps * 10).flat_map(|i| (0..steps).map(move |j| [share(i) / 10.0, share(j)]));
        let mean: f64 =
            cells.map(|numbers| filtered(Some(numbers))).sum::<f64>() / f64::from(steps * steps * 10);
        assert!((mean - filtered(None)).abs() < 4e-3, "{mean}, not {}", filtered(None));
        for numbers in [[0.0, 0.0], [1.0, 1.0], [1.0_f64.next_down(); 2]] {
            assert!(filtered(Some(numbers)).is_finite());
        }
    }
}
