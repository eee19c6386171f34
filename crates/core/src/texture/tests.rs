//! Are textures right at a point and on average over a pixel?

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::{
    Channel, Encoding, Filter, Image, Level, Paint, Texel, Texture, TexturePoint, TextureSource, TextureUse,
    Wrap,
};
use crate::{ImageSource, Material, Rgb, TextureId, Value, Values, srgb_decoded};

/// Numbers that look random, in 0..1 (xorshift, Marsaglia 2003).
fn random(state: &mut u64) -> f64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

fn texture(kind: &str, values: Values) -> Texture {
    (Texture::kind_named(kind).unwrap().make)(&values).unwrap()
}

fn word(word: &str) -> Value {
    Value::Word(word.into())
}

/// A place over which a pixel shows a parallelogram.
fn over(uv: DVec2, footprint: [DVec2; 2]) -> TexturePoint {
    TexturePoint { uv, footprint: Some(footprint), ..TexturePoint::default() }
}

/// The mean of the red of a texture over the parallelogram, by `steps`² points of it.
fn counted(texture: &Texture, at: &TexturePoint, steps: u32) -> f64 {
    let [a, b] = at.footprint.unwrap();
    let share = |i: u32| (f64::from(i) + 0.5) / f64::from(steps) - 0.5;
    let cells = (0..steps).flat_map(|i| (0..steps).map(move |j| (share(i), share(j))));
    let sum: f64 = cells.map(|(x, y)| texture.color(&TexturePoint::at_uv(at.uv + a * x + b * y)).r).sum();
    sum / f64::from(steps * steps)
}

/// Root of the mean squared difference from many points, of a floor seen to the horizon at one sample a pixel: 120 rows of
/// 9 pixels, from 1 m above it.
fn error_to_the_horizon(texture: &Texture) -> f64 {
    let hit = |x: f64, y: f64| {
        let direction = DVec3::new(x / 120.0, -(y + 1e-9) / 120.0, -1.0);
        let point = direction / -direction.y;
        // A camera that looks a little aside, so that no line of the pattern is a line of the picture.
        DVec2::from_angle(0.3).rotate(DVec2::new(point.x, -point.z))
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for (row, column) in (0..120_u32).flat_map(|row| (0..9_u32).map(move |column| (row, column))) {
        let (x, y) = (f64::from(column) * 13.0 - 52.0, f64::from(row) + 0.5);
        // By derivatives, as a tracer has them.
        let side =
            |dx: f64, dy: f64| (hit(x + 1e-4 * dx, y + 1e-4 * dy) - hit(x - 1e-4 * dx, y - 1e-4 * dy)) / 2e-4;
        let shown = texture.color(&over(hit(x, y), [side(1.0, 0.0), side(0.0, 1.0)])).r;
        let steps = 64;
        let share = |i: u32| (f64::from(i) + 0.5) / f64::from(steps) - 0.5;
        let cells = (0..steps).flat_map(|i| (0..steps).map(move |j| (share(i), share(j))));
        let right: f64 = cells.map(|(i, j)| texture.color(&TexturePoint::at_uv(hit(x + i, y + j))).r).sum();
        sum += (shown - right / f64::from(steps * steps)).powi(2);
        count += 1.0;
    }
    f64::sqrt(sum / count)
}

#[test]
fn a_checkered_floor_is_right_to_the_horizon() {
    for scale in [0.5, 2.0] {
        let scale = Value::Pair(DVec2::splat(scale));
        let error = error_to_the_horizon(&texture("checker-texture", Values::new().with("scale", scale)));
        assert!(error < 1e-2, "{error}");
    }
}

#[test]
fn bricks_are_right_to_the_horizon() {
    let values =
        Values::new().with("color", Value::Color(Rgb::BLACK)).with("mortar", Value::Color(Rgb::WHITE));
    let error =
        error_to_the_horizon(&texture("brick-texture", values.with("mortar-width", Value::Number(0.03))));
    assert!(error < 1.5e-2, "{error}");
}

#[test]
fn means_over_parallelograms_are_those_of_many_points() {
    let mut state = 88_172_645_463_325_252;
    let brick =
        Values::new().with("color", Value::Color(Rgb::WHITE)).with("mortar", Value::Color(Rgb::BLACK));
    let wide = [("size", DVec2::new(0.9, 0.4))].map(|(name, v)| (name, Value::Pair(v)));
    let brick = wide.into_iter().fold(brick, |values, (name, v)| values.with(name, v));
    let brick = texture("brick-texture", brick.with("mortar-width", Value::Number(0.1)));
    let checker = texture("checker-texture", Values::new());
    for size in [0.05, 0.3, 1.5] {
        let mut squares = 0.0;
        for _ in 0..60 {
            let mut vector = || DVec2::new(random(&mut state) - 0.5, random(&mut state) - 0.5) * size;
            let (a, b) = (vector(), vector());
            let at = over(vector() * 9.0, [a, b]);
            let off = |texture: &Texture| (texture.color(&at).r - counted(texture, &at, 200)).abs();
            assert!(off(&checker) < 8e-3, "checker {size}: {at:?}");
            squares += off(&brick).powi(2) / 60.0;
            let level = over(at.uv, [DVec2::X * a.x, DVec2::Y * b.y]);
            let off = (brick.color(&level).r - counted(&brick, &level, 200)).abs();
            assert!(off < 1e-2, "level bricks {off} at {size}: {level:?}");
        }
        // Boxes round pieces of a slanted parallelogram blur a little more than it.
        assert!(squares.sqrt() < 0.05, "bricks {} at {size}", squares.sqrt());
    }
}

#[test]
fn noise_fades_to_its_mean_and_not_before() {
    let noise = texture("noise-texture", Values::new().with("mapping", word("uv")));
    let marble = texture(
        "marble-texture",
        Values::new().with("mapping", word("uv")).with("turbulence", Value::Number(0.0)),
    );
    let mut state = 1_234_567;
    let (mut sums, mut differences) = ([0.0; 3], 0.0);
    for _ in 0..400 {
        let uv = DVec2::new(random(&mut state), random(&mut state)) * 100.0;
        let show = |width: f64| noise.color(&over(uv, [DVec2::X * width, DVec2::Y * width])).r;
        let point = noise.color(&TexturePoint::at_uv(uv)).r;
        assert!((show(0.02) - point).abs() < 0.01, "{} {point}", show(0.02));
        assert_eq!(show(1.5), 0.5);
        assert!((0.0..=1.0).contains(&point));
        for (sum, v) in sums.iter_mut().zip([point, show(0.1), show(0.5)]) {
            *sum += (v - 0.5).powi(2) / 400.0;
        }
        // Between, it comes nearer to the mean over the pixel than the point is.
        let at = over(uv, [DVec2::X * 0.4, DVec2::Y * 0.4]);
        let right = counted(&noise, &at, 12);
        differences += ((show(0.4) - right).powi(2) - (point - right).powi(2)) / 400.0;
        let wide = over(uv, [DVec2::X * 0.7, DVec2::Y * 0.1]);
        assert!((marble.color(&wide).r - counted(&marble, &wide, 100)).abs() < 1e-3);
    }
    assert!(sums[0] > sums[1] && sums[1] > sums[2] && sums[2] > 0.0 && sums[0] > 0.01, "{sums:?}");
    assert!(differences < 0.0, "{differences}");
}

#[test]
fn the_mean_magnitude_of_noise_is_what_it_is_taken_for() {
    let mut state = 3_141_592_653;
    let count = 200_000;
    let mut place = || DVec3::new(random(&mut state), random(&mut state), random(&mut state)) * 64.0;
    let mean: f64 = (0..count).map(|_| super::fractal::noise(place()).abs()).sum::<f64>() / f64::from(count);
    assert!((mean - super::fractal::MEAN_MAGNITUDE).abs() < 2e-3, "{mean}");
}

/// A picture of bytes by column and row.
fn picture(width: u32, height: u32, byte: impl Fn(u32, u32) -> u8) -> Image {
    let bytes = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| byte(x, y)).collect();
    Image::from_bytes([width, height], 1, bytes).unwrap()
}

#[test]
fn smaller_copies_keep_the_light() {
    for [width, height] in [[64, 64], [13, 7], [1, 9], [5, 1], [100, 3]] {
        let image = picture(width, height, |x, y| ((x * 37 + y * 101) % 256) as u8);
        let levels = image.levels(Encoding::Srgb);
        let last = levels.size(levels.count() - 1);
        assert_eq!(last, DVec2::ONE);
        let at =
            TexturePoint { footprint: Some([DVec2::X * 2.0, DVec2::Y * 2.0]), ..TexturePoint::default() };
        let whole = levels.filtered(Wrap::Repeat, Filter::Linear, at.uv, at.footprint, None).color.r;
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
        (levels.filtered(wrap, Filter::Nearest, uv, None, None).color.r * 3.0).round()
    };
    let row = |wrap| [-5, -2, -1, 0, 3, 4, 5, 8].map(|column| at(wrap, f64::from(column)));
    assert_eq!(row(Wrap::Repeat), [3.0, 2.0, 3.0, 0.0, 3.0, 0.0, 1.0, 0.0]);
    assert_eq!(row(Wrap::Mirror), [3.0, 1.0, 0.0, 0.0, 3.0, 3.0, 2.0, 0.0]);
    assert_eq!(row(Wrap::Clamp), [0.0, 0.0, 0.0, 0.0, 3.0, 3.0, 3.0, 3.0]);
}

#[test]
fn a_picture_stands_upright_and_is_linear_between_pixels() {
    let image = picture(2, 2, |x, y| [[0, 255], [0, 0]][y as usize][x as usize]);
    let levels = image.levels(Encoding::Linear);
    let at = |u, v| levels.filtered(Wrap::Clamp, Filter::Ewa, DVec2::new(u, v), None, None).color.r;
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
        levels.filtered(Wrap::Repeat, filter, uv, Some(sides), None).color.r
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
        let found = image.levels(Encoding::Srgb).filtered(Wrap::Mirror, Filter::Ewa, uv, Some(sides), None);
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
        let filtered = |numbers| levels.filtered(Wrap::Repeat, Filter::Ewa, uv, Some(sides), numbers).color.r;
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

#[test]
fn mappings_by_position_know_their_footprints() {
    let mut state = 5;
    for mapping in ["planar", "box", "spherical"] {
        let values =
            Values::new().with("mapping", word(mapping)).with("scale", Value::Pair(DVec2::new(3.0, -2.0)));
        let values =
            values.with("turn", Value::Number(0.4)).with("offset", Value::Pair(DVec2::new(0.1, 0.2)));
        let checker: super::CheckerTexture = crate::part::make(&values).unwrap();
        let transform = checker.transform;
        for _ in 0..50 {
            let mut vector =
                || DVec3::new(random(&mut state) - 0.5, random(&mut state) - 0.5, random(&mut state) - 0.5);
            let (position, normal, side) = (vector(), vector(), vector());
            let at =
                TexturePoint { position, normal, spread: Some([side, -side]), ..TexturePoint::default() };
            let place = |position| transform.flat(&TexturePoint { position, ..at }).uv;
            let right = (place(position + side * 1e-6) - place(position - side * 1e-6)) / 2e-6;
            let found = transform.flat(&at).footprint.unwrap();
            assert!(
                found[0].distance(right) < 1e-5 * (1.0 + right.length()),
                "{mapping}: {} {right}",
                found[0]
            );
            assert_eq!(found[0], -found[1]);
        }
    }
}

#[test]
fn nothing_that_is_no_number_comes_out() {
    let image = Arc::new(picture(4, 4, |x, y| (x * 60 + y) as u8));
    let source = Value::Image(ImageSource { path: "a.png".into(), image });
    let bad = [f64::NAN, f64::INFINITY, -1e300, 1e18, 0.0];
    for kind in Texture::KINDS {
        let file = kind.field("file").map(|_| source.clone());
        let mappings: &[&str] = if kind.field("octaves").is_some() {
            &["position", "uv"]
        } else {
            &["uv", "planar", "box", "spherical"]
        };
        for mapping in mappings {
            let values = file.iter().fold(Values::new(), |values, file| values.with("file", file.clone()));
            let texture = (kind.make)(&values.with("mapping", word(mapping))).unwrap();
            for (&a, &b) in bad.iter().flat_map(|a| bad.iter().map(move |b| (a, b))) {
                let (uv, position) = (DVec2::new(a, b), DVec3::new(b, a, 1.0));
                let footprints = [None, Some([DVec2::new(b, a); 2]), Some([DVec2::new(0.1, b), DVec2::ZERO])];
                let spreads = [None, Some([position; 2]), Some([DVec3::X * b, DVec3::ZERO])];
                for (footprint, spread) in footprints.into_iter().zip(spreads) {
                    for stochastic in [None, Some([0.3, 0.9]), Some([a, b])] {
                        let at =
                            TexturePoint { uv, position, normal: position, footprint, spread, stochastic };
                        let texel = texture.texel(&at);
                        let is_color = texel.color.all(|v| (0.0..=1.0).contains(&v)) && texel.alpha == 1.0;
                        assert!(is_color, "{} {mapping}: {texel:?} at {at:?}", kind.name);
                    }
                }
            }
        }
    }
}

/// A source with one texel everywhere.
struct Everywhere(Texel);

impl TextureSource for Everywhere {
    fn texture(&self, _: TextureId) -> Option<&Texture> {
        None
    }

    fn texel(&self, _: TextureId, _: &TexturePoint) -> Texel {
        self.0
    }
}

#[test]
fn paint_multiplies_and_stays_a_reflectance() {
    let texel = Texel { color: Rgb::new(0.5, 3.0, 0.25), alpha: 0.75 };
    let (source, at) = (Everywhere(texel), TexturePoint::default());
    let by = TextureUse::of(TextureId::from_index(1).unwrap());
    let paint = Paint::new(Rgb::new(0.5, 0.5, 1.0), Some(by));
    assert_eq!(paint.at(&source, &at), Rgb::new(0.25, 1.0, 0.25));
    assert_eq!(paint.light_at(&source, &at), Rgb::new(0.25, 1.5, 0.25));
    assert_eq!(Paint::from(Rgb::grey(0.3)).at(&source, &at), Rgb::grey(0.3));
    let level = |channel| Level::new(0.5, Some(TextureUse { channel, ..by })).at(&source, &at);
    let all = [None, Some(Channel::Red), Some(Channel::Green), Some(Channel::Blue), Some(Channel::Alpha)];
    assert_eq!(all.map(level), [0.25, 0.25, 1.0, 0.125, 0.375]);
    assert_eq!(level(Some(Channel::Luminance)), (0.5 * texel.color.luminance()).min(1.0));
    struct Nowhere;
    impl TextureSource for Nowhere {
        fn texture(&self, _: TextureId) -> Option<&Texture> {
            None
        }
    }
    assert_eq!(paint.at(&Nowhere, &at), paint.rgb());
}

#[test]
fn a_resolved_material_is_the_one_that_was_never_textured() {
    let by = TextureUse::of(TextureId::from_index(1).unwrap());
    let (source, at) = (Everywhere(Texel::opaque(Rgb::grey(0.5))), TexturePoint::default());
    for kind in Material::KINDS {
        let plain = |grey: f64| {
            kind.fields.iter().fold(Values::new(), |values, field| match field.default {
                _ if field.kind.is_paintable() && field.kind == crate::FieldKind::Fraction => {
                    values.with(field.name, Value::Number(grey))
                }
                _ if field.kind.is_paintable() => values.with(field.name, Value::Color(Rgb::grey(grey))),
                Some(default) => values.with(field.name, default()),
                None => values,
            })
        };
        let painted = plain(0.5).iter().fold(Values::new(), |values, (name, value)| {
            let is_paintable = kind.field(name).unwrap().kind.is_paintable();
            values.with(name, if is_paintable { value.clone().textured(by) } else { value.clone() })
        });
        let painted = (kind.make)(&painted).unwrap();
        let right = (kind.make)(&plain(0.25)).unwrap();
        assert_eq!(painted.resolved(&source, &at), right, "{}", kind.name);
        assert_eq!(right.resolved(&source, &at), right);
        assert_eq!(painted.lobe_kinds(), right.lobe_kinds());
        // Painted altogether mirroring or black, it may still have every lobe somewhere.
        let full = plain(1.0).iter().fold(Values::new(), |values, (name, value)| {
            let is_paintable = kind.field(name).unwrap().kind.is_paintable();
            values.with(name, if is_paintable { value.clone().textured(by) } else { value.clone() })
        });
        assert_eq!((kind.make)(&full).unwrap().lobe_kinds(), right.lobe_kinds(), "{}", kind.name);
    }
}
