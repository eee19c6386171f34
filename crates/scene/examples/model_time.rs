//! How long do models take to load, what is in them, and what is passed over?
//!
//! `model_time FILE...`; the time is the best of five.

use std::path::Path;
use std::time::Instant;

use catoptra_core::scene::Content;
use catoptra_core::{Node, Shape};
use catoptra_scene::model::read;

fn main() {
    for name in std::env::args().skip(1) {
        let mut best = f64::INFINITY;
        let mut found = Err(String::new());
        for _ in 0..5 {
            let start = Instant::now();
            found = read(Path::new(&name)).map_err(|refused| refused.to_string());
            best = best.min(start.elapsed().as_secs_f64());
            if found.is_err() {
                break;
            }
        }
        match found {
            Err(refused) => println!("refused: {refused}"),
            Ok(model) => {
                let mut counts = Counts::default();
                model.nodes.iter().for_each(|node| counts.add(node));
                println!(
                    "{name}: {:.1} ms, {counts:?}, {} materials, {} textures",
                    best * 1e3,
                    model.materials.len(),
                    model.textures.len()
                );
                for warning in &model.warnings {
                    println!("    {}", warning.message);
                }
            }
        }
    }
}

/// What stands in nodes.
#[derive(Debug, Default)]
#[allow(dead_code, reason = "shown")]
struct Counts {
    shapes: usize,
    triangles: usize,
    lights: usize,
    cameras: usize,
    groups: usize,
}

impl Counts {
    fn add(&mut self, node: &Node) {
        match &node.content {
            Content::Shape(shape, _) => {
                self.shapes += 1;
                if let Shape::Mesh(mesh) = shape {
                    self.triangles += mesh.triangles().triangles().len();
                }
            }
            Content::Light(_) => self.lights += 1,
            Content::Camera(_) => self.cameras += 1,
            Content::Group(members) | Content::Solid(_, members) => {
                self.groups += 1;
                members.iter().for_each(|member| self.add(member));
            }
        }
    }
}
