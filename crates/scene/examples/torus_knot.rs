//! How a mesh with normals is made and written as binary PLY: a (2, 3) torus knot, the one in `scenes/gallery/knot.kdl`.
//!
//! `cargo run -p catoptra-scene --example torus_knot -- scenes/gallery/meshes/knot.ply`

use std::f64::consts::TAU;
use std::io::{self, BufWriter, Write};

use catoptra_core::glam::DVec3;

/// Rings along the knot, corners round each ring.
const RINGS: u32 = 256;
const CORNERS: u32 = 14;
/// Radius of the tube, metres; the knot itself reaches out to 3.
const TUBE: f64 = 0.45;

fn main() -> io::Result<()> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "knot.ply".to_owned());
    let mut out = BufWriter::new(std::fs::File::create(&path)?);
    write_header(&mut out)?;
    for ring in 0..RINGS {
        for corner in 0..CORNERS {
            let (position, normal) = vertex(ring, corner);
            for value in position.as_vec3().to_array().into_iter().chain(normal.as_vec3().to_array()) {
                out.write_all(&value.to_le_bytes())?;
            }
        }
    }
    for triangle in triangles() {
        out.write_all(&[3])?;
        for index in triangle {
            out.write_all(&index.to_le_bytes())?;
        }
    }
    out.flush()?;
    println!("{path}: {} vertices, {} triangles", RINGS * CORNERS, 2 * RINGS * CORNERS);
    Ok(())
}

fn write_header(out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "ply\nformat binary_little_endian 1.0\ncomment a (2, 3) torus knot")?;
    writeln!(out, "element vertex {}", RINGS * CORNERS)?;
    for name in ["x", "y", "z", "nx", "ny", "nz"] {
        writeln!(out, "property float {name}")?;
    }
    writeln!(out, "element face {}", 2 * RINGS * CORNERS)?;
    writeln!(out, "property list uchar uint vertex_indices\nend_header")
}

/// The line through the middle of the tube: twice round the axis while it goes three times up and down.
fn line(turn: f64) -> DVec3 {
    let radius = 2.0 + (3.0 * turn).cos();
    DVec3::new(radius * (2.0 * turn).cos(), radius * (2.0 * turn).sin(), (3.0 * turn).sin())
}

fn vertex(ring: u32, corner: u32) -> (DVec3, DVec3) {
    let turn = TAU * f64::from(ring) / f64::from(RINGS);
    let step = 1e-4;
    let (before, here, after) = (line(turn - step), line(turn), line(turn + step));
    // The frame: along the line, and from the middle of the torus outwards.
    let along = (after - before).normalize();
    let side = along.cross(here).normalize();
    let out = side.cross(along);
    let angle = TAU * f64::from(corner) / f64::from(CORNERS);
    let normal = out * angle.cos() + side * angle.sin();
    (here + normal * TUBE, normal)
}

fn triangles() -> impl Iterator<Item = [u32; 3]> {
    (0..RINGS).flat_map(|ring| {
        let next = (ring + 1) % RINGS * CORNERS;
        let ring = ring * CORNERS;
        (0..CORNERS).flat_map(move |corner| {
            let other = (corner + 1) % CORNERS;
            let [a, b, c, d] = [ring + corner, next + corner, next + other, ring + other];
            [[a, c, b], [a, d, c]]
        })
    })
}
