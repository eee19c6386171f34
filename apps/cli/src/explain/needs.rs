//! What does a scene hold, and what runs for it? Lines of text.

use catoptra_core::Integrator;

use super::{Found, all_counted};
use crate::words::{bytes, counted, list};

impl Found<'_> {
    pub(super) fn holdings(&self) -> Vec<String> {
        let needs = &self.needs;
        let mut lines = vec![format!("{}{}", all_counted(&needs.shapes, "shape"), list(&needs.shapes))];
        if needs.unbounded > 0 {
            lines.push(format!(
                "  {} without an end: tested for every ray, outside the tree",
                needs.unbounded
            ));
        }
        if needs.meshes > 0 {
            let triangles = counted(needs.triangles as u64, "triangle");
            lines.push(format!("{} of {triangles}", counted(needs.meshes as u64, "mesh file")));
        }
        lines.push(format!("{}{}", all_counted(&needs.materials, "material"), list(&needs.materials)));
        if !needs.textures.is_empty() {
            lines.push(format!("{}{}", all_counted(&needs.textures, "texture"), list(&needs.textures)));
        }
        lines.push(format!(
            "{}{}; shadows are thrown by {}",
            all_counted(&needs.lights, "light"),
            list(&needs.lights),
            needs.shadowing_lights
        ));
        if !needs.shining_shapes.is_empty() {
            let shapes = all_counted(&needs.shining_shapes, "shape");
            lines.push(format!("  {shapes} of a material that shines{}", list(&needs.shining_shapes)));
        }
        if needs.endless_lamps > 0 {
            let shapes = counted(needs.endless_lamps as u64, "shape");
            lines.push(format!("  {shapes} without an end shine but light nothing"));
        }
        if needs.lamps_met_alone > 0 {
            let shapes = counted(needs.lamps_met_alone as u64, "shape");
            lines.push(format!("  {shapes} of no known outline shine, but only paths find their light"));
        }
        if self.ambient > 0 {
            lines.push(format!("{}: costs nothing", counted(self.ambient as u64, "ambient light")));
        }
        lines
    }

    pub(super) fn runs(&self) -> Vec<String> {
        let (job, needs) = (self.job, &self.needs);
        let threads = counted(job.pool.threads() as u64, "thread");
        let shapes: usize = needs.shapes.iter().map(|(_, count)| count).sum();
        let kernels = match shapes - needs.with_kernel {
            0 => "a SIMD kernel for every shape".to_owned(),
            without => format!(
                "SIMD kernels for {} of {shapes} shapes; {without} crossed one ray at a time",
                needs.with_kernel
            ),
        };
        let mut lines = vec![format!(
            "backend {} with {} on {threads}",
            job.backend.name(),
            job.backend.level(&job.view)
        )];
        if job.backend.name() == "wide" {
            lines.push(kernels);
        }
        if needs.shades_by_point && job.backend.name() == "wide" {
            lines.push("packets that search; what is met is shaded point by point in f64".to_owned());
        }
        lines.push(format!("trees of {}", bytes(needs.tree_bytes as u64)));
        if needs.texture_bytes > 0 {
            lines.push(format!("pictures of {}", bytes(needs.texture_bytes as u64)));
        }
        lines.push(format!("integrator {}: {}", job.view.integrator.name(), self.paths()));
        lines
    }

    /// How far the integrator follows what the camera sees.
    fn paths(&self) -> String {
        let view = &self.job.view;
        match view.integrator {
            Integrator::Whitted if self.needs.reflects => {
                format!("reflections, up to {} one after another", view.max_depth)
            }
            Integrator::Whitted => "no reflections: no surface in the scene reflects".to_owned(),
            Integrator::Path if view.path_depth < u32::MAX => {
                format!("paths by chance, of up to {} bounces; no ambient light", view.path_depth)
            }
            Integrator::Path => "paths by chance, of any length; no ambient light".to_owned(),
            Integrator::Occlusion if view.occlusion_distance.is_finite() => {
                format!("one direction a sample, {} m far", view.occlusion_distance)
            }
            Integrator::Occlusion => "one direction a sample, however far".to_owned(),
        }
    }
}
