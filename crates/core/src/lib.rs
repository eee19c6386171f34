//! What is in a scene: shapes, materials, lights and cameras as parts that know their own rules, placements,
//! and the [`Scene`] that stores them as components behind stable ids and an edit log.
//!
//! # Conventions, written once
//! * Space is right-handed, y points up, lengths are metres, a camera looks along its own −z.
//! * Angles are radians in this API and degrees in scene text.
//! * A ray is `origin + t * direction`; `direction` need not be a unit vector and `t` counts in its length.
//! * Light is linear Rec. 709. Point and spot intensity is W/sr per channel, directional light is irradiance in
//!   W/m² at normal incidence, ambient light is radiance. A Lambert surface has the BRDF albedo/π.
//! * Values are refused where they enter: constructors return [`InvalidPart`], and past that door nothing fails.
#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test may stop at the first surprise"))]

pub mod bounds;
pub mod camera;
pub mod color;
pub mod contour;
mod control;
pub mod error;
pub mod exact;
pub mod geometry;
pub mod lamp_points;
mod lane;
pub mod light;
pub mod lobe;
pub mod material;
pub mod numeric;
pub mod optics;
pub mod part;
pub mod placement;
pub mod ray;
pub mod scene;
pub mod solid;
pub mod texture;

pub use bounds::Aabb;
pub use camera::{Aim, Camera, Extent, Lens, Raster, RayStart, Window};
pub use color::{Rgb, srgb_decoded, srgb_encoded};
pub use control::{Cancelled, Control, Progress};
pub use error::InvalidPart;
pub use geometry::{Geometry, Shape, TriangleMesh};
pub use glam;
pub use lane::{Arithmetic, Coefficient, Constant3, Lane, LaneMask, Triple};
pub use light::{Arrival, Emitter, Environment, FromAfar, IntensityProfile, Lamp, Light};
pub use lobe::{Bsdf, Continuation, LobeKinds, Lobes, Scatter, Scattered, ShadingPoint, SurfacePoint};
pub use material::{Emission, Finish, Material, Medium, NormalMap, Sides, Surface};
pub use part::{
    Field, FieldKind, ImageSource, Kind, MeshSource, Part, ProfileSource, Rows, Textured, Value, Values,
};
pub use placement::Placement;
pub use ray::{Crossing, Ray, Span, order_of_roots};
pub use scene::{
    Change, ChangeKind, Content, Edit, EntityId, Flags, History, Integrator, MaterialId, Node, Placed,
    PlacedSolid, Role, Scene, SceneError, Settings, Subject, Subtree, TextureId,
};
pub use solid::{Member, Operation, Solid};
pub use texture::{Image, Level, Paint, Texture, TexturePoint, TextureSource, TextureUse};
