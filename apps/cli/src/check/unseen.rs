//! Which things does no camera see? Asked only where there is a camera and nothing that could show them in another way: no mirror
//! and nothing clear.

use std::collections::HashSet;

use catoptra_core::{Aabb, Camera, Extent, Role};
use catoptra_tracer::Size;

use super::stage::Stage;
use super::{Finding, Lint};

pub(super) const LINT: Lint = Lint { name: "unseen", find };

fn find(stage: &Stage<'_>) -> Vec<Finding> {
    if stage.cameras.is_empty() || stage.snapshot().needs().reflects {
        return Vec::new();
    }
    let seen: HashSet<u32> = stage.seen.iter().map(|sighting| sighting.surface.prim).collect();
    let mut found = Vec::new();
    for (prim, shape) in stage.snapshot().prims().iter().enumerate() {
        let is_shape = |id: &_| stage.scene.role(*id) == Some(Role::Shape);
        let Some(id) = stage.entity(prim as u32).filter(is_shape) else { continue };
        let Some(line) = stage.file.line_of_entity(id).filter(|_| !seen.contains(&(prim as u32))) else {
            continue;
        };
        let moved = |bounds: Aabb| {
            let frame = stage.snapshot().frame();
            Aabb { min: bounds.min + frame, max: bounds.max + frame }
        };
        let bounds = shape.bounds().map(moved);
        let is_beside =
            |camera: &Camera| bounds.is_some_and(|bounds| lies_beside(camera, stage.size, &bounds));
        let name = stage.name(id);
        let message = if stage.cameras.iter().all(is_beside) {
            format!("\"{name}\" lies outside what the cameras see")
        } else {
            let Size { width, height } = stage.size;
            format!("\"{name}\" is met by no ray of {width}x{height}: it is behind others, or too small")
        };
        found.push(Finding { line: Some(line), message });
    }
    found
}

/// Whether a box lies wholly beside or behind what a camera sees.
fn lies_beside(camera: &Camera, size: Size, bounds: &Aabb) -> bool {
    if camera.lens_radius() > 0.0 {
        return false;
    }
    let corners = bounds.corners().map(|corner| corner - camera.eye());
    let (right, up, ahead) = (camera.right(), camera.up(), camera.forward());
    let aspect = f64::from(size.width) / f64::from(size.height);
    // How far to the sides one sees at a distance.
    let reach = |ahead: f64| match camera.extent() {
        Extent::Angle(fov) => (fov / 2.0).tan() * ahead,
        Extent::Height(height) => height / 2.0,
    };
    let all = |is_out: &dyn Fn(f64, f64, f64) -> bool| {
        corners.iter().all(|corner| is_out(corner.dot(right), corner.dot(up), corner.dot(ahead)))
    };
    all(&|_, _, z| z <= 0.0)
        || all(&|x, _, z| x > aspect * reach(z))
        || all(&|x, _, z| x < -aspect * reach(z))
        || all(&|_, y, z| y > reach(z))
        || all(&|_, y, z| y < -reach(z))
}

#[cfg(test)]
mod tests {
    use super::super::tests::findings;
    use super::*;

    const SCENE: &str = "camera \"c\" { eye 0 1 5; target 0 1 0 }\nmatte \"m\" { color 0.5 }\n\
        sphere \"seen\" material=\"m\" { center 0 1 0; radius 1 }\n\
        sphere \"inside\" material=\"m\" { center 0 1 0; radius 0.5 }\n\
        sphere \"behind\" material=\"m\" { center 0 1 9; radius 1 }\nsphere \"beside\" material=\"m\" { center 30 1 0; radius 1 }\n";

    #[test]
    fn hidden_and_distant_things_are_told_apart() {
        let found = findings(&LINT, SCENE);
        let messages: Vec<&str> = found.iter().map(|(_, message)| message.as_str()).collect();
        assert_eq!(messages[0], "\"inside\" is met by no ray of 64x48: it is behind others, or too small");
        assert_eq!(
            messages[1..],
            ["\"behind\" lies outside what the cameras see", "\"beside\" lies outside what the cameras see"]
        );
        assert_eq!(found[2].0, Some(6));
    }

    #[test]
    fn what_a_mirror_may_show_is_not_told() {
        assert_eq!(findings(&LINT, &format!("{SCENE}mirror \"g\"\nplane \"p\" material=\"g\"\n")), []);
    }
}
