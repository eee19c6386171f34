//! Which lights give no light, or reach nothing? Looked for at points that cameras see and at what stands round each light; of surfaces
//! that shine, at points that cameras see alone.

use std::f64::consts::{PI, TAU};

use catoptra_core::glam::DVec3;
use catoptra_core::{EntityId, FieldKind, Light, Ray, Rgb, Span, Value};
use catoptra_tracer::{Control, Prim, ProbeOptions, Receiver, WorldRay, irradiance_at};

use super::stage::{Sighting, Stage};
use super::{Finding, Lint};

pub(super) const LINT: Lint = Lint { name: "dark", find };

/// Points that cameras see, at each of which a light is asked for.
const SEEN: usize = 4096;

/// The same of surfaces that shine, which take longer to ask.
const SEEN_BY_LAMPS: usize = 256;

/// Rays from a light into all directions.
const AROUND: u32 = 4096;

fn find(stage: &Stage<'_>) -> Vec<Finding> {
    let mut found = Vec::new();
    for light in stage.scene.world_lights() {
        let told = |what: &str| Finding {
            line: stage.file.line_of_entity(light.id),
            message: format!("light \"{}\" {what}", stage.name(light.id)),
        };
        if gives_nothing(&light.part) {
            found.push(told("gives no light"));
        } else if !reaches(stage, light.id, &light.part) {
            let is_point = light.part.position().is_some() && light.part.lamp().is_none();
            found.push(told(if is_point { "reaches nothing" } else { "reaches nothing that a camera sees" }));
        }
    }
    found
}

/// Whether all that says how bright it is, is 0.
fn gives_nothing(light: &Light) -> bool {
    let values = light.values();
    let amounts = light.kind().fields.iter().filter_map(|field| match (field.kind, values.get(field.name)) {
        (FieldKind::Quantity, Some(Value::Color(color))) => Some(*color),
        _ => None,
    });
    let mut amounts = amounts.peekable();
    amounts.peek().is_some() && amounts.all(|color| color == Rgb::BLACK)
}

/// Whether a light arrives at any of the points; of light without a place or a direction that is so wherever there is a surface.
fn reaches(stage: &Stage<'_>, id: EntityId, light: &Light) -> bool {
    let frame = stage.snapshot().frame();
    if light.environment().is_some() || light.ambient() != Rgb::BLACK {
        return !stage.snapshot().prims().is_empty();
    }
    if stage.cameras.is_empty() && (light.lamp().is_some() || light.position().is_none()) {
        return true;
    }
    if light.lamp().is_some() {
        return lamp_reaches(stage, id);
    }
    let from_light = light.position().into_iter().flat_map(|position| first_hits(stage, position));
    if from_light.into_iter().any(|point| is_lit(light, point)) {
        return true;
    }
    stage.some_seen(SEEN).any(|seen| {
        let point = seen.ray.at(seen.t);
        let arrival = light.arriving::<f64>(point.into());
        let way = Ray::new(point - frame, arrival.to_light.into());
        let span = if light.position().is_some() { Span::TO_LIGHT } else { Span::AHEAD };
        is_lit(light, point)
            && (!light.shadow() || !stage.snapshot().occluded_in_frame(&way, span, Some(seen.surface)))
    })
}

fn is_lit(light: &Light, point: DVec3) -> bool {
    let arrival = light.arriving::<f64>(point.into());
    arrival.lit && arrival.strength > 0.0
}

/// What rays from a place meet first: in directions all round, and towards all that ends somewhere.
fn first_hits<'a>(stage: &'a Stage<'_>, from: DVec3) -> impl Iterator<Item = DVec3> + 'a {
    let frame = stage.snapshot().frame();
    let around = (0..AROUND).map(|i| {
        // A spiral of points at equal heights, turned by the golden angle each.
        let height = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(AROUND);
        let angle = f64::from(i) * PI * (3.0 - 5.0_f64.sqrt()) % TAU;
        let radius = (1.0 - height * height).sqrt();
        DVec3::new(radius * angle.cos(), height, radius * angle.sin())
    });
    let bounds = stage.snapshot().prims().iter().filter_map(Prim::bounds);
    let towards = bounds.flat_map(move |bounds| {
        std::iter::once(bounds.centre())
            .chain(bounds.corners().map(|corner| corner.lerp(bounds.centre(), 0.3)))
    });
    let towards = towards.map(move |point| point + frame - from).filter(|way| *way != DVec3::ZERO);
    around.chain(towards).filter_map(move |direction| {
        let ray = Ray::new(from, direction);
        let hit = stage.snapshot().nearest_in_frame(&stage.snapshot().own_ray(&ray), Span::AHEAD, None)?;
        Some(ray.at(hit.crossing.t))
    })
}

/// The same of a surface that shines, which what cameras see is asked about: how much of it arrives there, and nothing else.
fn lamp_reaches(stage: &Stage<'_>, id: EntityId) -> bool {
    let Some(alone) = stage.lit_by(id) else { return true };
    let sides = |seen: &Sighting| {
        let ray = WorldRay::new(seen.ray.origin, seen.ray.direction).ok();
        let met = ray.and_then(|ray| stage.caster.hit_on(&ray, seen.surface, seen.t));
        met.into_iter()
            .flat_map(|met| [met.normal, -met.normal].map(|normal| Receiver::new(met.point, normal)))
    };
    let not_itself = |seen: &&Sighting| stage.entity(seen.surface.prim) != Some(id);
    let receivers: Vec<Receiver> =
        stage.some_seen(SEEN_BY_LAMPS).filter(not_itself).flat_map(sides).filter_map(Result::ok).collect();
    let options = ProbeOptions { rays: 32, ..ProbeOptions::default() };
    let found = irradiance_at(&alone, &receivers, &options, stage.pool, &Control::default());
    found.map_or(true, |found| found.iter().any(|light| light.mean.max_channel() > 0.0))
}

#[cfg(test)]
mod tests {
    use super::super::tests::findings;
    use super::*;

    const SCENE: &str = "camera \"c\" { eye 0 1 5; target 0 1 0 }\nmatte \"m\" { color 0.5 }\n\
        sphere \"s\" material=\"m\" { center 0 1 0; radius 1 }\n";

    fn messages(lights: &str) -> Vec<String> {
        findings(&LINT, &format!("{SCENE}{lights}")).into_iter().map(|(_, message)| message).collect()
    }

    #[test]
    fn lights_that_look_away_are_told() {
        let spot = |direction: &str| {
            format!(
                "spot-light \"l\" {{ position 0 5 0; direction {direction}; intensity 9; inner 10; outer 20 }}\n"
            )
        };
        assert_eq!(messages(&spot("0 1 0")), ["light \"l\" reaches nothing"]);
        assert!(messages(&spot("0 -1 0")).is_empty());
        let panel = |u: &str| {
            format!(
                "rectangle-light \"l\" {{ corner -1 4 -1; edge-u {u}; edge-v 0 0 2; radiance 5; visible #false }}\n"
            )
        };
        let [down, up] = [panel("2 0 0"), panel("-2 0 0")].map(|light| messages(&light).len());
        assert_eq!(down + up, 1, "one of the two looks away");
        assert_eq!(
            messages("point-light \"l\" { position 0 5 0; intensity 0 }\n"),
            ["light \"l\" gives no light"]
        );
        assert!(messages("ambient-light \"l\" { radiance 1 }\ndirectional-light \"d\" { direction 0 -1 0; irradiance 1 }\n").is_empty());
    }

    #[test]
    fn a_light_in_a_box_lights_the_box() {
        let inside = "box \"b\" material=\"m\" { min 9 9 9; max 10 10 10 }\npoint-light \"l\" { position 9.5 9.5 9.5; intensity 1 }\n";
        assert!(messages(inside).is_empty());
    }
}
