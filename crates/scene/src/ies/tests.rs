//! What is read from IES files, and what is refused.

use std::f64::consts::PI;

use catoptra_core::light::Pole;

use super::*;

/// A file of type C with some angles and `1 2 3 …` for intensities, or those given.
fn file(kind: u8, vertical: &[f64], horizontal: &[f64], candela: Option<&[f64]>) -> String {
    let words = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let counted: Vec<f64> = (1..=vertical.len() * horizontal.len()).map(|i| i as f64).collect();
    format!(
        "IESNA:LM-63-1995\n[TEST] none\nTILT=NONE\n1 -1 1 {} {} {kind} 2 0 0 0\n1 1 10\n{}\n{}\n{}\n",
        vertical.len(),
        horizontal.len(),
        words(vertical),
        words(horizontal),
        words(candela.unwrap_or(&counted)),
    )
}

fn good(text: &str) -> IntensityProfile {
    read_bytes(text.as_bytes(), Path::new("lamp.ies")).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn refusal(text: impl AsRef<[u8]>) -> String {
    let refused = read_bytes(text.as_ref(), Path::new("lamp.ies"));
    refused.err().map_or_else(|| panic!("{}", String::from_utf8_lossy(text.as_ref())), |e| e.to_string())
}

fn at(profile: &IntensityProfile, polar: f64, azimuth: f64) -> f64 {
    profile.intensity(polar.to_radians(), azimuth.to_radians())
}

const PLAIN: &str =
    "IESNA:LM-63-1995\n[TEST] none\nTILT=NONE\n1 1000 2 3 1 1 1 0 0 0\n0.5 3 10\n0 45 90\n0\n3 2 1\n";

#[test]
fn factors_are_applied() {
    assert_eq!(good(PLAIN).candela(), [9.0, 6.0, 3.0]);
}

#[test]
fn from_2002_on_the_number_behind_the_ballast_factor_is_no_factor() {
    for (version, lamp) in [
        ("IESNA91", 3.0),
        ("IESNA:LM-63-1986", 3.0),
        ("IESNA:LM-63-1991", 3.0),
        ("IESNA:LM-63-2002", 1.0),
        ("IES:LM-63-2019", 1.0),
        ("ies:lm-63-19", 1.0),
        ("no version, as in 1986", 3.0),
    ] {
        let text = PLAIN.replace("IESNA:LM-63-1995", version);
        assert_eq!(good(&text).candela(), [3.0 * lamp, 2.0 * lamp, lamp], "{version}");
    }
}

#[test]
fn spelling_does_not_matter() {
    let expected = good(PLAIN);
    let crlf = PLAIN.replace('\n', "\r\n");
    let latin: Vec<u8> = PLAIN.bytes().map(|b| if b == b'e' { 0xe9 } else { b }).collect();
    let wrapped = PLAIN.replace("0 45 90\n0\n3 2 1\n", "0\n\n45, 90 0 3\n2,\t1\n\u{1a}");
    let decimals = PLAIN.replace("0 45 90\n0\n3 2 1", "0.0 4.5E1 +90. 0 3 2 1.0");
    for text in [
        crlf.as_bytes(),
        &latin,
        wrapped.as_bytes(),
        decimals.as_bytes(),
        PLAIN.replace('\n', "\r").as_bytes(),
        format!("\u{feff}{PLAIN}").as_bytes(),
        PLAIN.replace("TILT=NONE", "  tilt = none  ").as_bytes(),
        PLAIN.replace("TILT=NONE", "TILT=INCLUDE\n1\n3\n0 45 90\n1 0.95 0.9").as_bytes(),
        format!("{PLAIN}end of file").as_bytes(),
    ] {
        let found = read_bytes(text, Path::new("lamp.ies"));
        assert_eq!(found.unwrap(), expected, "{}", String::from_utf8_lossy(text));
    }
}

#[test]
fn symmetric_files_equal_their_unfolded_ones() {
    let quarter = good(&file(1, &[0.0, 90.0], &[0.0, 30.0, 90.0], None));
    let unfolded = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let [a, b, c] = [&unfolded[..2], &unfolded[2..4], &unfolded[4..]];
    let half =
        good(&file(1, &[0.0, 90.0], &[0.0, 30.0, 90.0, 150.0, 180.0], Some(&[a, b, c, b, a].concat())));
    let whole_angles = [0.0, 30.0, 90.0, 150.0, 180.0, 210.0, 270.0, 330.0, 360.0];
    let whole = good(&file(1, &[0.0, 90.0], &whole_angles, Some(&[a, b, c, b, a, b, c, b, a].concat())));
    assert_eq!(quarter, whole);
    assert_eq!(half, whole);
    let open = good(&file(1, &[0.0, 90.0], &whole_angles[..8], Some(&[a, b, c, b, a, b, c, b].concat())));
    assert_eq!(open, whole);
}

#[test]
fn planes_from_90_to_270_are_mirrored_in_the_plane_across() {
    let profile = good(&file(1, &[0.0, 90.0], &[90.0, 180.0, 270.0], None));
    for (azimuth, candela) in
        [(90.0, 2.0), (180.0, 4.0), (-90.0, 6.0), (0.0, 4.0), (45.0, 3.0), (-45.0, 5.0), (-135.0, 5.0)]
    {
        assert!((at(&profile, 90.0, azimuth) - candela).abs() < 1e-12, "{azimuth}");
    }
}

#[test]
fn upper_halves_and_whole_spheres_are_read() {
    let up = good(&file(1, &[90.0, 180.0], &[0.0], None));
    assert_eq!((at(&up, 89.0, 0.0), at(&up, 90.0, 0.0), at(&up, 180.0, 0.0)), (0.0, 1.0, 2.0));
    let whole = good(&file(1, &[0.0, 90.0, 180.0], &[0.0], Some(&[7.0; 3])));
    assert!((whole.flux() - 28.0 * PI).abs() < 1e-9);
}

#[test]
fn the_flux_of_a_cosine_is_that_of_its_lamp() {
    let vertical: Vec<f64> = (0..=180).map(|i| f64::from(i) / 2.0).collect();
    let candela: Vec<f64> = vertical.iter().map(|v| 1000.0 / PI * v.to_radians().cos().max(0.0)).collect();
    let flux = good(&file(1, &vertical, &[0.0], Some(&candela))).flux();
    assert!((flux / 1000.0 - 1.0).abs() < 1e-5, "{flux}");
}

#[test]
fn type_b_counts_vertical_angles_round_the_axis_across() {
    // Horizontal angles turn clockwise seen from above: towards the pole, at polar angle 0.
    let profile = good(&file(2, &[-90.0, 0.0, 90.0], &[-90.0, 0.0, 90.0], None));
    assert_eq!(profile.pole(), Pole::Across);
    for (vertical, horizontal, candela) in
        [(0.0, 0.0, 5.0), (90.0, 0.0, 6.0), (-90.0, 0.0, 4.0), (0.0, 45.0, 6.5), (0.0, -45.0, 3.5)]
    {
        assert!((at(&profile, 90.0 - horizontal, vertical) - candela).abs() < 1e-12);
    }
    assert_eq!(at(&profile, 90.0, 180.0), 0.0);
    let half = good(&file(2, &[-90.0, 0.0, 90.0], &[0.0, 90.0], None));
    let row = [4.0, 5.0, 6.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    assert_eq!(half, good(&file(2, &[-90.0, 0.0, 90.0], &[-90.0, 0.0, 90.0], Some(&row))));
}

#[test]
fn type_a_counts_vertical_angles_from_the_horizontal() {
    let profile = good(&file(3, &[-90.0, 0.0, 90.0], &[-90.0, 0.0, 90.0], None));
    assert_eq!(profile.pole(), Pole::Nadir);
    for (vertical, horizontal, candela) in
        [(0.0, 0.0, 5.0), (45.0, 0.0, 5.5), (-45.0, 0.0, 4.5), (0.0, 90.0, 8.0), (0.0, -90.0, 2.0)]
    {
        assert!((at(&profile, 90.0 + vertical, -horizontal) - candela).abs() < 1e-12);
    }
    assert_eq!(at(&profile, 90.0, 180.0), 0.0);
}

/// What is changed in the plain file, to what, and what is said then.
const FAULTS: &[(&str, &str, &str)] = &[
    ("TILT=NONE", "TILT=", "3:1: TILT= must be followed by NONE or INCLUDE"),
    (
        "TILT=NONE",
        "TILT=My Tilt.dat",
        "3:1: tilt factors in a file of their own (\"My Tilt.dat\") are not read: write TILT=NONE to do without",
    ),
    (
        "TILT=NONE",
        "TILT=INCLUDE\n1\n1e9",
        "5:1: 1000000000 by 1 angles need 2000000001 numbers, and at most 25 can follow in the file",
    ),
    ("1 1000 2 3", "1 1000 0 3", "4:8: the candela multiplier must be greater than 0, not 0"),
    (
        "2 3 1 1 1",
        "2 1 1 1 1",
        "4:10: the number of vertical angles must be a whole number of at least 2, not 1",
    ),
    (
        "2 3 1 1 1",
        "2 3 0.5 1 1",
        "4:12: the number of horizontal angles must be a whole number of at least 1, not 0.5",
    ),
    (
        "2 3 1 1 1",
        "2 3 1000000000 1 1",
        "4:12: 3 by 1000000000 angles need 4000000003 numbers, and at most 9 can follow in the file",
    ),
    ("2 3 1 1 1", "2 3 1 4 1", "4:14: the photometric type must be 1 (C), 2 (B) or 3 (A), not 4"),
    ("0.5 3 10", "-1 3 10", "5:1: the ballast factor must be greater than 0, not -1"),
    ("0.5 3 10", "0.5 0 10", "5:5: the ballast-lamp photometric factor must be greater than 0, not 0"),
    ("0.5 3 10", "0.5 3 ten", "5:7: the input watts must be a number, not \"ten\""),
    ("0.5 3 10", "0.5 3 inf", "5:7: the input watts must be a number, not \"inf\""),
    ("0 45 90", "0 45 45", "6:6: vertical angles must increase: 45 follows 45"),
    ("0 45 90", "0 45 181", "6:6: vertical angles must lie in 0..180, not be 181"),
    (
        "3 2 1\n",
        "3 -2 1\n",
        "8:3: the intensity at vertical angle 45 and horizontal 0 must lie in 0..3.4e38 cd, not -2",
    ),
    (
        "3 2 1\n",
        "3 2    ",
        "8:8: the file ends before an intensity (3 of 3: the intensity at vertical angle 90 and horizontal 0)",
    ),
    ("3 2 1\n", "3 2 1\n4\n", "9:1: more than 3 intensities: the numbers of angles do not fit what follows"),
];

#[test]
fn every_fault_is_told_with_its_place() {
    for (from, to, expected) in FAULTS {
        assert!(PLAIN.contains(from), "{from}");
        assert_eq!(refusal(PLAIN.replace(from, to)), format!("lamp.ies:{expected}"));
    }
    assert!(refusal(PLAIN.replace("3 2 1\n", "3 2 1e39\n")).contains(":8:5: "));
}

#[test]
fn what_is_no_ies_file_is_told() {
    for (bytes, expected) in [
        (&b""[..], "is empty"),
        (b" \n \r\n", "is empty"),
        (b"\x89PNG\0\0TILT=NONE", "is no IES file: it holds bytes that are no text"),
        (b"\xff\xfeT\0I\0", "is text in UTF-16: save it as plain text (ASCII or UTF-8)"),
        (b"a poem\nof two lines\n", "is no IES file: no line begins with TILT="),
        (&vec![b' '; LONGEST + 1], "is longer than 4 MiB, too long for an IES file"),
    ] {
        assert_eq!(refusal(bytes), format!("lamp.ies: {expected}"));
    }
}

#[test]
fn angles_that_do_not_fit_the_type_are_told() {
    let spans = "horizontal angles of type C must be 0 alone or span 0..90, 0..180, 90..270 or 0..360, not";
    for (text, expected) in [
        (file(1, &[0.0, 90.0], &[0.0, 45.0, 100.0], None), format!("7:6: {spans} 0..100")),
        (file(1, &[0.0, 90.0], &[45.0, 90.0], None), format!("7:1: {spans} 45..90")),
        (
            file(2, &[0.0, 90.0], &[0.0], None),
            "7:1: types A and B need at least 2 horizontal angles".to_owned(),
        ),
        (
            file(3, &[-90.0, 91.0], &[0.0, 90.0], None),
            "6:5: vertical angles must lie in -90..90, not be 91".to_owned(),
        ),
    ] {
        assert_eq!(refusal(text), format!("lamp.ies:{expected}"));
    }
}

#[test]
fn a_file_cut_off_anywhere_is_refused() {
    for length in 0..PLAIN.len() - 2 {
        refusal(&PLAIN[..length]);
    }
}

#[test]
fn a_file_that_is_not_there_is_an_error() {
    let error = read(Path::new("no-such-folder/lamp.ies")).unwrap_err();
    assert!(error.to_string().starts_with("no-such-folder/lamp.ies: cannot be read: "), "{error}");
}
