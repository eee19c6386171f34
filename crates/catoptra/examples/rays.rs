//! Rays against a mesh: what each meets first, in as many lines as that needs.

use catoptra::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Two triangles that make a square, and rays straight down on it, one of them on the edge they share.
    let (corners, square) = ([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], [[0, 1, 2], [0, 2, 3]]);
    let positions = corners.map(|[x, y]| [x, y, 0.0]);
    let origins = [[0.7, 0.2, 2.0], [0.2, 0.7, 2.0], [0.5, 0.5, 2.0], [1.5, 0.5, 2.0]];

    let caster = Caster::from_triangles(&positions, &square)?;
    let rays = RayColumns::new(&origins, &[[0.0, 0.0, -1.0]; 4])?;
    for hit in caster.nearest_many(&rays, Pool::shared()?)?.iter() {
        match hit {
            Some(hit) => println!("triangle {} at {} after {} m", hit.triangle, hit.point, hit.t),
            None => println!("a miss"),
        }
    }
    Ok(())
}
