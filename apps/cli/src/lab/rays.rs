//! `catoptra lab rays`: which rays does a picture ask about? Written to files, to be traced by `lab trace` or another tracer.

use std::path::PathBuf;

use catoptra_core::glam::{DVec3, Vec3};
use catoptra_core::{Ray, Scene};
use catoptra_tracer::{Caster, Control, Preset, Size, WorldRay};
use clap::Args;
use miette::{IntoDiagnostic, Result};

use super::ray_file::{self, Record};
use crate::Outcome;
use crate::args::size;
use crate::console::{check_heard, print_answer};
use crate::destination::{check_apart, check_writable};
use crate::job::{find_camera, placed_camera};
use crate::loaded::Loaded;
use crate::pool::new_pool;

#[derive(Args)]
pub(crate) struct RaysArgs {
    /// Scene file (.kdl) or model file, or - for standard input
    scene: PathBuf,
    /// File for the camera's rays: u32 count, then origin, tmin, direction and tmax of each ray, all little-endian, f32
    camera_rays: PathBuf,
    /// File for shadow rays: from what the camera's rays meet to each light without a surface that it faces
    shadow_rays: Option<PathBuf>,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "1024x1024", value_parser = size)]
    size: Size,
    /// Camera to look through [default: the scene's first]
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
}

/// Sides of the squares of pixels that rays are written in the order of: those of the inner within those of the outer ones.
const SQUARES: [u32; 2] = [4, 16];

/// The share of the way to a light at whose begin nothing is searched: `f32` does not tell on which side of its surface a ray begins.
const SHARE: f64 = 1e-3;

/// Writes the rays.
pub(crate) fn run(args: &RaysArgs) -> Result<Outcome> {
    check_heard()?;
    let Loaded { scene, inputs, .. } = Loaded::read(&args.scene)?;
    let camera_output = ("the camera's rays", args.camera_rays.as_path());
    let outputs: Vec<_> = std::iter::once(camera_output)
        .chain(args.shadow_rays.as_deref().map(|path| ("the shadow rays", path)))
        .collect();
    check_apart(&outputs, &inputs)?;
    check_writable(&outputs)?;
    let camera = placed_camera(&scene, find_camera(&scene, args.camera.as_deref())?)?;
    let pool = new_pool(None)?;
    let caster =
        Caster::from_scene_with(&scene, Preset::default(), &pool, &Control::default()).into_diagnostic()?;
    let Size { width, height } = args.size;
    let (mut seen, mut shadow) = (Vec::new(), Vec::new());
    for [x, y] in in_squares(args.size) {
        let ray = camera.ray(f64::from(x) + 0.5, f64::from(y) + 0.5, width, height);
        seen.push(record(&ray, [0.0, f64::INFINITY]));
        if args.shadow_rays.is_some() {
            shadow.extend(shadow_rays(&scene, &caster, &ray)?);
        }
    }
    ray_file::write(&args.camera_rays, &seen)?;
    if let Some(path) = &args.shadow_rays {
        ray_file::write(path, &shadow)?;
    }
    print_answer(&format!("{} camera rays, {} shadow rays\n", seen.len(), shadow.len()))?;
    Ok(Outcome::Done)
}

/// Every pixel, square by square.
fn in_squares(size: Size) -> impl Iterator<Item = [u32; 2]> {
    let [inner, outer] = SQUARES;
    let within = move |side: u32, step: u32| {
        (0..side)
            .step_by(step as usize)
            .flat_map(move |y| (0..side).step_by(step as usize).map(move |x| [x, y]))
    };
    let corners = (0..size.height)
        .step_by(outer as usize)
        .flat_map(move |y| (0..size.width).step_by(outer as usize).map(move |x| [x, y]));
    let pixels = move |[x, y]: [u32; 2]| {
        within(outer, inner)
            .flat_map(move |[u, v]| within(inner, 1).map(move |[i, j]| [x + u + i, y + v + j]))
    };
    corners.flat_map(pixels).filter(move |[x, y]| *x < size.width && *y < size.height)
}

/// From what a ray meets to the lights.
fn shadow_rays(scene: &Scene, caster: &Caster, ray: &Ray) -> Result<Vec<Record>> {
    let Some(hit) = caster.nearest(&WorldRay::new(ray.origin, ray.direction).into_diagnostic()?) else {
        return Ok(Vec::new());
    };
    let normal = if hit.normal.dot(ray.direction) > 0.0 { -hit.normal } else { hit.normal };
    let lights =
        scene.world_lights().into_iter().filter(|light| light.part.lamp().is_none() && light.part.shadow());
    let rays = lights.filter_map(|light| {
        let (to_light, end) = match (light.part.position(), light.part.direction()) {
            (Some(position), _) => (position - hit.point, 1.0),
            (None, Some(direction)) => (-direction, f64::INFINITY),
            (None, None) => return None,
        };
        let begin = if end.is_finite() { SHARE } else { SHARE * (hit.point - ray.origin).length() };
        let faces = normal.dot(to_light) > 0.0;
        faces.then(|| record(&Ray::new(hit.point, to_light), [begin, end]))
    });
    Ok(rays.collect())
}

fn record(ray: &Ray, span: [f64; 2]) -> Record {
    let narrow = |v: DVec3| -> Vec3 { v.as_vec3() };
    Record { origin: narrow(ray.origin), direction: narrow(ray.direction), span: span.map(|end| end as f32) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_comes_once_and_squares_stay_together() {
        let size = Size::new(37, 21);
        let pixels: Vec<_> = in_squares(size).collect();
        let mut sorted = pixels.clone();
        sorted.sort_unstable();
        sorted.dedup();
        assert_eq!((pixels.len(), sorted.len()), (37 * 21, 37 * 21));
        assert!(pixels[..16].iter().all(|[x, y]| *x < 4 && *y < 4));
        assert!(pixels[..256].iter().all(|[x, y]| *x < 16 && *y < 16));
    }
}
