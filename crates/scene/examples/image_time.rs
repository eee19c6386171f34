//! How long does a large picture take to load, and how much memory do it and its smaller copies take?
//!
//! `image_time FILE` loads a file; `image_time SIZE` (pixels a side) makes a PNG first, in the folder for temporary files.

use std::path::{Path, PathBuf};
use std::time::Instant;

use catoptra_core::{ImageSource, Texture, Value, Values};
use catoptra_scene::image::{load, write_png_rows};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let given = std::env::args().nth(1).ok_or("give a file or a size")?;
    let path = match given.parse() {
        Ok(size) => made(size)?,
        Err(_) => PathBuf::from(given),
    };
    let start = Instant::now();
    let image = load(&path)?;
    let (loaded, alone) = (start.elapsed(), image.bytes());
    let source = ImageSource { path: path.display().to_string(), image };
    let kind = Texture::kind_named("image-texture").ok_or("no pictures")?;
    let texture = (kind.make)(&Values::new().with("file", Value::Image(source.clone())))?;
    println!("{} x {} pixels, {}", source.image.width(), source.image.height(), texture.kind_name());
    println!("loaded in {loaded:.2?}: {} MiB", alone >> 20);
    println!("with smaller copies after {:.2?}: {} MiB", start.elapsed(), source.image.bytes() >> 20);
    if let Some(peak) = peak() {
        println!("most memory in use: {peak}");
    }
    Ok(())
}

/// A picture with some detail everywhere.
fn made(size: u32) -> Result<PathBuf, Box<dyn std::error::Error>> {
    let path = std::env::temp_dir().join(format!("image_time-{size}.png"));
    if !Path::exists(&path) {
        write_png_rows(&path, size, size, |y, row| {
            for (x, pixel) in (0_u32..).zip(row.chunks_exact_mut(3)) {
                let hash = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77);
                pixel.copy_from_slice(&[(x >> 6) as u8, (y >> 6) as u8, (hash >> 29) as u8]);
            }
        })?;
    }
    Ok(path)
}

/// What Linux says of this process.
fn peak() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    Some(line.split_whitespace().skip(1).collect::<Vec<_>>().join(" "))
}
