//! The light that arrives at a point in space along a direction, but for what lamps and lights send there straight.

use catoptra_core::glam::DVec3;
use catoptra_core::{Ray, Rgb, Span};

use super::{Media, Numbers, Origin, PathRay};
use crate::integrator::Trees;
use crate::integrator::path::Path;
use crate::integrator::walker::Walker;
use crate::{Frame, SurfaceId};

/// Radiance that arrives at a point of the snapshot's frame, which some surface may hold, along a path that begins with a
/// direction; where `bounces` is not asked for, only that from all around.
pub(in crate::integrator) fn light_along(
    frame: &Frame<'_>,
    (point, direction): (DVec3, DVec3),
    leaving: Option<SurfaceId>,
    numbers: &Numbers,
    bounces: bool,
) -> Rgb {
    let (snapshot, mut walker) = (frame.snapshot, Walker::new(&Trees, frame));
    let ray = Ray::new(point, direction);
    let media = Media::round(snapshot, &ray);
    if !bounces {
        let open = walker.comes_through((ray, Span::AHEAD), leaving, &media, frame.view.clear_shadows);
        let all = snapshot.matter().surroundings.iter().map(|environment| environment.radiance(direction));
        return open * all.fold(Rgb::BLACK, |sum, light| sum + light);
    }
    let path = PathRay::new(ray, leaving, media);
    walker
        .follow_ray::<Path>(PathRay { glossy: Rgb::BLACK, origin: Origin::Apart, depth: 1, ..path }, numbers)
        .0
}
