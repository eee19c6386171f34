//! How is the light at many receivers asked for on many threads?

use rayon::prelude::*;

use crate::integrator::Receivers;
use crate::{Cancelled, Control, Irradiance, Pool, ProbeOptions, Receiver, Snapshot};

/// The direct and ambient light at receivers, on the threads of `pool`; each answer depends on its receiver and its place in
/// the list.
///
/// Light from points, cones and directions comes past shapes or does not, exactly; that of surfaces is their closed form where
/// the shapes between have outlines, else what rays find. Ambient light adds π times its radiance. Surfaces that hold a
/// receiver but for rounding ([`HELD_WITHIN`](catoptra_core::numeric::HELD_WITHIN)) are left by its rays as by those of a
/// picture: flat ones do not block, and a ball blocks what lies behind it.
///
/// ```
/// use catoptra_core::{Rgb, Scene, light::PointLight};
/// use catoptra_core::glam::DVec3;
/// use catoptra_tracer::{Control, Pool, ProbeOptions, Receiver, Snapshot, irradiance_at};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut scene = Scene::new();
/// // 80 candela, 2 m above a desk.
/// scene.add_light("lamp", PointLight::new(DVec3::Y * 2.0, Rgb::grey(80.0))?, None)?;
/// let pool = Pool::new(1)?;
/// let snapshot = Snapshot::extract(&scene, &pool);
/// let meters = [Receiver::new(DVec3::ZERO, DVec3::Y)?, Receiver::new(DVec3::ZERO, DVec3::NEG_Y)?];
/// let lux = irradiance_at(&snapshot, &meters, &ProbeOptions::default(), &pool, &Control::default())?;
/// assert_eq!((lux[0].mean.g, lux[1].mean.g), (20.0, 0.0));
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// [`Cancelled`] when `control` said so before the last receiver was asked.
pub fn irradiance_at(
    snapshot: &Snapshot,
    receivers: &[Receiver],
    options: &ProbeOptions,
    pool: &Pool,
    control: &Control,
) -> Result<Vec<Irradiance>, Cancelled> {
    control.start(receivers.len());
    let ask = |asked: &mut Receivers<'_>, (number, receiver): (usize, &Receiver)| {
        if control.is_cancelled() {
            return Err(Cancelled);
        }
        let found = asked.irradiance(receiver.point() - snapshot.frame(), receiver.normal(), number as u32);
        control.advance(1);
        Ok(found)
    };
    pool.run(|| {
        let new = || Receivers::new(snapshot, options);
        receivers.par_iter().enumerate().map_init(new, ask).collect()
    })
}
