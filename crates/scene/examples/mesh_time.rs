//! How long does a mesh file take to read, and where does it lie?
//!
//! `cargo run --release -p catoptra-scene --example mesh_time -- FILE…`

use std::path::Path;
use std::time::Instant;

fn main() {
    for name in std::env::args().skip(1) {
        let start = Instant::now();
        match catoptra_scene::model::read_mesh(Path::new(&name)) {
            Err(error) => println!("{error}"),
            Ok(mesh) => {
                let took = start.elapsed();
                let (triangles, bounds) = (mesh.triangles().len(), mesh.bounds());
                println!("{name}: {triangles} triangles in {took:.1?}, {} to {}", bounds.min, bounds.max);
            }
        }
    }
}
