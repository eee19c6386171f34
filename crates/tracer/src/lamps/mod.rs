//! Light from surfaces: what a point sees of a lamp, in closed form where there is one and by rays elsewhere. Nothing here
//! casts a ray: it says which, and what they tell.

mod gather;
mod lanes;
mod rays;

pub(crate) use gather::{Gathered, LitPoint, gather, gather_for_rays, may_hide};
pub(crate) use lanes::{BallOutline, Outline, open_from_afar};
pub(crate) use rays::{
    Drawn, Found, Half, LampRay, LampRays, PickedRay, follow, follow_picked, half_of_ray, pair_of_lamp,
    picked, share_seen,
};
