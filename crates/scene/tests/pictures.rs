//! Are pictures of every format read as what they show, and refused with a reason where they show nothing?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::io::Cursor;
use std::path::Path;

use catoptra_core::texture::Encoding;
use catoptra_core::{Image, srgb_decoded};
use catoptra_scene::image::{load, load_bytes};
use exr::prelude::{AnyChannel, AnyChannels, FlatSamples, Layer, WritableImage};

/// Eight by eight pixels, red on the left, blue on the right: baseline, progressive, and grey.
const JPEGS: [&[u8]; 3] = [
    include_bytes!("pictures/baseline.jpg"),
    include_bytes!("pictures/progressive.jpg"),
    include_bytes!("pictures/grey.jpg"),
];

fn read(bytes: &[u8], name: &str) -> Image {
    load_bytes(bytes, Path::new(name)).unwrap_or_else(|error| panic!("{error}"))
}

fn refusal(bytes: &[u8]) -> String {
    load_bytes(bytes, Path::new("a.png")).unwrap_err().to_string()
}

fn png(size: [u32; 2], color: png::ColorType, depth: png::BitDepth, bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, size[0], size[1]);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == png::ColorType::Indexed {
        encoder.set_palette(vec![255, 0, 0, 0, 0, 255]);
    }
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(bytes).unwrap();
    writer.finish().unwrap();
    out
}

/// An EXR of two by one pixels with these channels.
fn exr(channels: &[(&str, [f32; 2])]) -> Vec<u8> {
    let list = channels.iter().map(|(name, v)| AnyChannel::new(*name, FlatSamples::F32(v.to_vec())));
    let channels = AnyChannels::sort(list.collect());
    let mut out = Cursor::new(Vec::new());
    let layer = Layer::new(
        (2, 1),
        exr::meta::header::LayerAttributes::default(),
        exr::image::Encoding::SMALL_LOSSLESS,
        channels,
    );
    exr::image::Image::from_layer(layer).write().to_buffered(&mut out).unwrap();
    out.into_inner()
}

fn hdr(head: &str, pixels: &[u8]) -> Vec<u8> {
    [format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n{head}\n").as_bytes(), pixels].concat()
}

fn rgb(image: &Image, x: u32, y: u32) -> [f64; 3] {
    image.pixel(x, y).color.to_array()
}

#[test]
fn png_keeps_its_channels_and_depth() {
    use png::{BitDepth, ColorType};
    let grey = read(&png([2, 1], ColorType::Grayscale, BitDepth::Eight, &[0, 188]), "a");
    assert_eq!((grey.width(), grey.height(), grey.channels(), grey.bytes()), (2, 1, 1, 2));
    assert_eq!(grey.natural_encoding(), Encoding::Srgb);
    assert!((rgb(&grey, 1, 0)[2] - srgb_decoded(188.0 / 255.0)).abs() < 1e-7);
    let rgba = read(&png([1, 1], ColorType::Rgba, BitDepth::Eight, &[255, 0, 0, 51]), "a");
    assert_eq!((rgba.channels(), rgba.pixel(0, 0).alpha as f32), (4, 0.2));
    let indexed = read(&png([2, 1], ColorType::Indexed, BitDepth::One, &[0b0100_0000]), "a");
    assert_eq!((rgb(&indexed, 0, 0), rgb(&indexed, 1, 0)), ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]));
    let deep = read(&png([1, 1], ColorType::Grayscale, BitDepth::Sixteen, &[0x80, 0x01]), "a");
    let share = f64::from(0x8001) / 65535.0;
    assert!((rgb(&deep, 0, 0)[0] - srgb_decoded(share)).abs() < 1e-6);
    assert_eq!(deep.bytes(), 4);
}

#[test]
fn jpegs_show_what_they_show_whatever_their_name() {
    for (i, bytes) in JPEGS.iter().enumerate() {
        let image = read(bytes, "picture.png");
        assert_eq!((image.width(), image.height()), (8, 8));
        let (left, right) = (rgb(&image, 0, 4), rgb(&image, 7, 4));
        if i == 2 {
            assert_eq!(image.channels(), 1);
            assert!(left[0] < 0.05 && right[0] > 0.8, "{left:?} {right:?}");
        } else {
            assert!(
                left[0] > 0.85 && left[2] < 0.05 && right[2] > 0.85 && right[0] < 0.05,
                "{left:?} {right:?}"
            );
        }
    }
}

#[test]
fn exr_is_linear_and_its_alpha_is_divided_out() {
    let image =
        read(&exr(&[("R", [100.0, 0.25]), ("G", [0.5, 0.0]), ("B", [-0.25, 0.0]), ("A", [1.0, 0.5])]), "a");
    assert_eq!((image.channels(), image.natural_encoding()), (4, Encoding::Linear));
    assert_eq!((rgb(&image, 0, 0), rgb(&image, 1, 0)), ([100.0, 0.5, 0.0], [0.5, 0.0, 0.0]));
    assert_eq!(image.pixel(1, 0).alpha, 0.5);
    let grey = read(&exr(&[("Y", [3.0, 4.0])]), "a");
    assert_eq!((grey.channels(), rgb(&grey, 1, 0)), (1, [4.0; 3]));
}

#[test]
fn hdr_is_read_plain_and_with_runs() {
    // 128 at exponent 129 is 1; exposure 2 says that it was doubled.
    let plain = read(&hdr("EXPOSURE=2\n\n-Y 1 +X 2", &[128, 0, 64, 129, 0, 255, 0, 0]), "a");
    assert_eq!((rgb(&plain, 0, 0), rgb(&plain, 1, 0)), ([0.5, 0.0, 0.25], [0.0; 3]));
    let old = read(&hdr("\n-Y 1 +X 3", &[128, 0, 0, 129, 1, 1, 1, 2]), "a");
    assert_eq!(rgb(&old, 2, 0), [1.0, 0.0, 0.0]);
    let row = [&[2, 2, 0, 8, 136, 128][..], &[136, 0, 136, 0], &[4, 129, 130, 129, 129, 132, 129]].concat();
    let runs = read(
        &hdr("\n+Y 2 +X 8", &[&row[..], &[2, 2, 0, 8, 136, 64, 136, 0, 136, 0, 136, 129]].concat()),
        "a",
    );
    // The second row of the file is the upper one.
    assert_eq!((rgb(&runs, 0, 0)[0], rgb(&runs, 0, 1)[0], rgb(&runs, 1, 1)[0]), (0.5, 1.0, 2.0));
}

#[test]
fn a_name_that_tells_another_format_does_not_matter_and_missing_files_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sky.jpeg");
    std::fs::write(&path, exr(&[("Y", [3.0, 4.0])])).unwrap();
    assert_eq!(load(&path).unwrap().width(), 2);
    let missing = load(&folder.path().join("none.png")).unwrap_err().to_string();
    assert!(missing.contains("none.png: cannot be read: "), "{missing}");
    let is_folder = load(folder.path()).unwrap_err().to_string();
    assert!(is_folder.contains("is no file with a picture"), "{is_folder}");
}

/// The bytes of a PNG with the header changed, and its checksum.
fn with_size(mut bytes: Vec<u8>, width: u32, height: u32) -> Vec<u8> {
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let checksum = bytes[12..29].iter().fold(!0_u32, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| (sum >> 1) ^ (0xedb8_8320 * (sum & 1)))
    });
    bytes[29..33].copy_from_slice(&(!checksum).to_be_bytes());
    bytes
}

fn webp(size: [u32; 2], color: image_webp::ColorType, bytes: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    image_webp::WebPEncoder::new(&mut out).encode(bytes, size[0], size[1], color).unwrap();
    out
}

#[test]
fn webps_show_what_they_hold() {
    let image =
        read(&webp([2, 1], image_webp::ColorType::Rgba8, &[255, 0, 0, 128, 0, 0, 255, 255]), "a.webp");
    assert_eq!((image.width(), image.height(), image.channels()), (2, 1, 4));
    assert_eq!((rgb(&image, 0, 0), rgb(&image, 1, 0)), ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]));
    assert!((image.pixel(0, 0).alpha - 128.0 / 255.0).abs() < 1e-6);
    assert_eq!(read(&webp([1, 3], image_webp::ColorType::Rgb8, &[9; 9]), "a.png").channels(), 3);
}

#[test]
fn pictures_that_are_none_are_refused_with_a_reason() {
    use png::{BitDepth, ColorType};
    let small = || png([2, 2], ColorType::Grayscale, BitDepth::Eight, &[0, 1, 2, 3]);
    let cut = |bytes: Vec<u8>| bytes[..bytes.len() - 30].to_vec();
    let nan = exr(&[("R", [0.0, f32::NAN]), ("G", [0.0; 2]), ("B", [0.0; 2])]);
    let infinite = exr(&[("Y", [f32::INFINITY, 0.0])]);
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (Vec::new(), "a.png: is empty"),
        (b"hello".to_vec(), "a.png: is no picture: it must be a PNG, JPEG, WebP, EXR or HDR file"),
        (b"GIF89a......".to_vec(), "a.png: is a GIF picture: it must be"),
        (with_size(small(), 0, 2), "a.png: "),
        (with_size(small(), 16384, 16384), "a.png: is cut short: "),
        (
            with_size(small(), 1 << 16, 1 << 15),
            "a.png: is too large: 65536 x 32768 pixels are more than 2^28",
        ),
        (with_size(small(), 0x7fff_ffff, 1), "a.png: cannot be read: limits are exceeded"),
        (cut(small()), "a.png: cannot be read: "),
        (small()[..20].to_vec(), "a.png: cannot be read: "),
        (JPEGS[0][..JPEGS[0].len() - 60].to_vec(), "a.png: cannot be read: "),
        (JPEGS[0][..40].to_vec(), "a.png: cannot be read: "),
        (nan, "a.png: holds NaN in column 1 of row 0; it must be finite"),
        (infinite, "a.png: holds inf in column 0 of row 0; it must be finite"),
        (exr(&[("Z", [1.0, 2.0])]), "a.png: has no channels R, G and B, nor Y, but Z"),
        (cut(exr(&[("Y", [1.0, 2.0])])), "a.png: cannot be read: "),
        (hdr("\n-Y 1 +X 2", &[1, 2]), "a.png: is cut short or broken in row 0"),
        (hdr("\n-Y 0 +X 2", &[]), "a.png: has no pixels: its size is 2 x 0"),
        (hdr("\n-Y 30000 +X 30000", &[0; 64]), "a.png: is too large"),
        (hdr("\n-Y 16384 +X 16384", &[0; 64]), "a.png: is cut short"),
        (hdr("\n+X 2 -Y 2", &[0; 64]), "a.png: has the size \"+X 2 -Y 2\""),
        (
            hdr("\n-Y 1 +X 8", &[2, 2, 0, 8, 140, 1, 0, 0]),
            "a.png: is cut short or broken in row 0: a run that does not fit",
        ),
        (
            hdr("\n-Y 1 +X 2", &[1, 1, 1, 2]),
            "a.png: is cut short or broken in row 0: a run that does not fit",
        ),
        (b"#?RGBE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234".to_vec(), "a.png: holds 32-bit_rle_xyze"),
        (b"#?RGBE\nEXPOSURE=0\n\n-Y 1 +X 1\n1234".to_vec(), "a.png: has the exposure 0"),
        (b"#?RGBE".to_vec(), "a.png: is cut short or broken in its header"),
        (b"RIFF\x04\0\0\0WEBP".to_vec(), "a.png: cannot be read: "),
        (
            cut(webp([4, 4], image_webp::ColorType::Rgb8, &(0..48).collect::<Vec<u8>>())),
            "a.png: cannot be read: ",
        ),
    ];
    for (bytes, reason) in cases {
        let told = refusal(&bytes);
        assert!(told.starts_with(reason), "{told}, not {reason}");
    }
}

/// SplitMix64 (Steele, Lea, Flood 2014).
fn random(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Damage ends in a picture or in a message, and in neither case in gigabytes of memory.
#[test]
fn no_damaged_picture_panics() {
    use png::{BitDepth, ColorType};
    let noise: Vec<u8> = (0..192_u32).map(|i| (i * 37 % 251) as u8).collect();
    let mut originals = vec![
        png([8, 8], ColorType::Rgb, BitDepth::Eight, &noise),
        exr(&[("R", [1.0, 0.25]), ("G", [0.5, 0.0]), ("B", [0.25, 0.0]), ("A", [1.0, 0.5])]),
        exr(&[("Y", [3.0, 4.0])]),
        hdr("\n-Y 1 +X 8", &[2, 2, 0, 8, 136, 128, 136, 0, 136, 0, 136, 129]),
        webp([8, 8], image_webp::ColorType::Rgb8, &noise),
    ];
    originals.extend(JPEGS.map(<[u8]>::to_vec));
    let (mut state, mut read) = (1, 0);
    for i in 0..4000 {
        let mut bytes = originals[i % originals.len()].clone();
        for _ in 0..1 + random(&mut state) % 4 {
            let at = random(&mut state) as usize % bytes.len();
            match random(&mut state) % 4 {
                0 => bytes[at] = 0xff,
                1 => bytes[at] ^= 1 << (random(&mut state) % 8),
                2 => bytes.truncate(at.max(8)),
                _ => bytes[at] = random(&mut state) as u8,
            }
        }
        match load_bytes(&bytes, Path::new("damaged")) {
            Ok(image) => {
                read += 1;
                assert!(image.bytes() < 1 << 26, "{image:?}");
            }
            Err(error) => assert!(error.to_string().starts_with("damaged: "), "{error}"),
        }
    }
    assert!(read > 100 && read < 3900, "{read} were read");
}
