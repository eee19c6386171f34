//! What does a Radiance picture (.hdr) hold? Red, green and blue with a common exponent, plain or with runs; linear.
//!
//! Ward, "Real Pixels", *Graphics Gems II* (1991), and the manual of Radiance, "Picture File Format".

use std::io::{BufRead, Read};

use catoptra_core::Image;
use catoptra_core::texture::Encoding;

use super::load::{Fault, Input, check_size, unreadable};

/// A run of 127 numbers in two bytes; a pixel is counted as four numbers.
const MOST: u64 = 64;

/// The most bytes of a header.
const LONGEST_HEADER: u64 = 1 << 16;

/// Rows of this many pixels can have runs.
const WIDTHS_WITH_RUNS: std::ops::RangeInclusive<usize> = 8..=0x7fff;

pub(super) fn read(mut input: impl Input, length: u64) -> Result<Image, Fault> {
    let exposure = read_header(&mut input)?;
    let (size, is_upside_down) = read_size(&mut input, length)?;
    let width = size[0] as usize;
    let mut row = vec![[0_u8; 4]; width];
    let mut values = Vec::new();
    for y in 0..size[1] {
        read_row(&mut input, &mut row).map_err(|e| format!("is cut short or broken in row {y}: {e}"))?;
        values.extend(row.iter().flat_map(|pixel| light(*pixel, exposure)));
    }
    if is_upside_down {
        let rows: Vec<&[f32]> = values.chunks_exact(3 * width).rev().collect();
        values = rows.concat();
    }
    Image::from_floats(size, 3, values, Encoding::Linear).map_err(|e| e.to_string())
}

/// The light of a pixel; an exponent of 0 is black.
fn light([r, g, b, exponent]: [u8; 4], exposure: f32) -> [f32; 3] {
    let unit = if exponent == 0 { 0.0 } else { (f32::from(exponent) - 136.0).exp2() / exposure };
    [r, g, b].map(|v| (f32::from(v) * unit).min(f32::MAX))
}

/// Reads up to the empty line, and answers with what the pixels were multiplied by.
fn read_header(input: &mut impl Input) -> Result<f32, Fault> {
    let mut exposure = 1.0_f32;
    let mut left = LONGEST_HEADER;
    loop {
        let line = read_line(input, &mut left)?;
        if line.is_empty() {
            break;
        }
        if let Some(format) = line.strip_prefix("FORMAT=")
            && format.trim() != "32-bit_rle_rgbe"
        {
            return Err(format!("holds {}, not red, green and blue (32-bit_rle_rgbe)", format.trim()));
        }
        if let Some(given) = line.strip_prefix("EXPOSURE=") {
            let factor: f32 = given.trim().parse().unwrap_or(f32::NAN);
            exposure *= factor;
            if !(exposure > 0.0 && exposure.is_finite()) {
                return Err(format!("has the exposure {}, which must be greater than 0", given.trim()));
            }
        }
    }
    Ok(exposure)
}

/// Reads the line with the size: rows first, from the top (−Y) or from the bottom (+Y), each from the left.
fn read_size(input: &mut impl Input, length: u64) -> Result<([u32; 2], bool), Fault> {
    let line = read_line(input, &mut { LONGEST_HEADER })?;
    let words: Vec<&str> = line.split_ascii_whitespace().collect();
    let [rows @ ("-Y" | "+Y"), height, "+X", width] = words[..] else {
        return Err(format!("has the size \"{line}\", which must be as in -Y 512 +X 1024"));
    };
    let number = |text: &str| text.parse().map_err(|_| format!("has the size \"{line}\", which is no size"));
    let size = check_size([number(width)?, number(height)?], 32, length, MOST)?;
    Ok((size, rows == "+Y"))
}

fn read_line(input: &mut impl Input, left: &mut u64) -> Result<String, Fault> {
    let mut line = Vec::new();
    input.by_ref().take(*left).read_until(b'\n', &mut line).map_err(|e| unreadable(&e))?;
    *left -= line.len() as u64;
    if line.pop() != Some(b'\n') {
        return Err("is cut short or broken in its header".to_owned());
    }
    Ok(String::from_utf8_lossy(&line).trim_end().to_owned())
}

fn read_row(input: &mut impl Input, row: &mut [[u8; 4]]) -> Result<(), Fault> {
    let first = read_bytes::<4>(input)?;
    let has_runs = WIDTHS_WITH_RUNS.contains(&row.len()) && first[..2] == [2, 2] && first[2] < 0x80;
    if !has_runs {
        return read_plain_row(input, row, first);
    }
    if usize::from(u16::from_be_bytes([first[2], first[3]])) != row.len() {
        return Err("a row of another width".to_owned());
    }
    for channel in 0..4 {
        let mut x = 0;
        while x < row.len() {
            let [count] = read_bytes::<1>(input)?;
            let (count, repeats) = if count > 128 { (count - 128, true) } else { (count, false) };
            let end = x + usize::from(count);
            if count == 0 || end > row.len() {
                return Err("a run that does not fit its row".to_owned());
            }
            let mut value = [0];
            for i in 0..usize::from(count) {
                if i == 0 || !repeats {
                    value = read_bytes::<1>(input)?;
                }
                row[x + i][channel] = value[0];
            }
            x = end;
        }
    }
    Ok(())
}

/// Pixels one by one, where 1 1 1 n stands for n more of the one before (of 256 times as many for each that follows it).
fn read_plain_row(input: &mut impl Input, row: &mut [[u8; 4]], first: [u8; 4]) -> Result<(), Fault> {
    let (mut x, mut shift, mut next) = (0, 0, Some(first));
    while x < row.len() {
        let pixel = match next.take() {
            Some(pixel) => pixel,
            None => read_bytes::<4>(input)?,
        };
        if pixel[..3] != [1, 1, 1] {
            row[x] = pixel;
            (x, shift) = (x + 1, 0);
            continue;
        }
        let count = usize::from(pixel[3]) << shift;
        if x == 0 || shift > 16 || x + count > row.len() {
            return Err("a run that does not fit its row".to_owned());
        }
        let before = row[x - 1];
        row[x..x + count].fill(before);
        (x, shift) = (x + count, shift + 8);
    }
    Ok(())
}

fn read_bytes<const N: usize>(input: &mut impl Input) -> Result<[u8; N], Fault> {
    let mut bytes = [0; N];
    input.read_exact(&mut bytes).map_err(|e| e.to_string())?;
    Ok(bytes)
}
