//! Which outlines does a frame have? Those of shapes against what is behind them, and those where two shapes meet.

use catoptra_core::Aabb;
use catoptra_core::glam::DVec3;

use super::body::{Body, Border, Flat, Level, Rim, overlap};
use super::shadows::Receiver;
use super::sight::{EVERYWHERE, Outline, Sight, circle, common, silhouette};
use super::stage::Stage;
use crate::numeric::MOST_SHADOWS;

/// Adds all outlines of some bodies as an eye sees them.
pub(crate) fn add_outlines(sight: &Sight, stage: &Stage, found: &mut Vec<Outline>) {
    for body in stage.bodies() {
        add_own(sight, body, found);
    }
    add_meetings(sight, stage, found);
    add_shadows(sight, stage, found);
}

/// The edges of shadows on flat surfaces.
fn add_shadows(sight: &Sight, stage: &Stage, found: &mut Vec<Outline>) {
    if stage.shadows() > MOST_SHADOWS {
        return;
    }
    for (i, subject) in stage.subjects.iter().enumerate().filter(|(_, subject)| subject.lit) {
        for (level, within) in subject.sheets(sight) {
            for receiver in stage.lamps.iter().filter_map(|lamp| Receiver::new(sight, level, *lamp, within)) {
                for (_, body) in stage.bodies().enumerate().filter(|(j, _)| *j != i) {
                    receiver.add_shadow(body, found);
                }
            }
        }
    }
}

/// The outlines of a body alone.
fn add_own(sight: &Sight, body: &Body, found: &mut Vec<Outline>) {
    match body {
        Body::Plane(level) => found.push(Outline { form: sight.across(level.normal), bounds: EVERYWHERE }),
        Body::Ball { center, radius } => {
            let to_center = *center - sight.eye;
            if to_center.length_squared() > radius * radius {
                found.extend(sight.conic(&silhouette(to_center, *radius), *center, *radius));
            }
        }
        Body::Flats { flats, rims, solid } => {
            let faces_eye = |side: usize| flats[side].level.height(sight.eye) >= 0.0;
            let inside = *solid && (0..flats.len()).all(|side| !faces_eye(side));
            let seen = |rim: &&Rim| !*solid || inside || rim.sides.iter().any(|&side| faces_eye(side));
            found.extend(rims.iter().filter(seen).filter_map(|rim| sight.segment(rim.ends)));
            for flat in flats {
                if let Border::Circle { center, radius } = flat.border {
                    let offset = -flat.level.height(sight.eye);
                    let q = circle(flat.level.normal, offset, center - sight.eye, radius);
                    found.extend(sight.conic(&q, center, radius));
                }
            }
        }
        Body::Other(_) => {}
    }
}

/// The outlines along which two bodies meet.
fn add_meetings(sight: &Sight, stage: &Stage, found: &mut Vec<Outline>) {
    let mut bounded: Vec<(Aabb, &Body)> = Vec::new();
    for body in stage.bodies() {
        bounded.extend(body.bounds().map(|bounds| (bounds, body)));
    }
    let levels =
        || stage.bodies().filter_map(|body| if let Body::Plane(level) = body { Some(level) } else { None });
    for (i, level) in levels().enumerate() {
        for other in levels().skip(i + 1) {
            found.extend(line_of(level, other).map(|[point, along]| sight.line(point, along)));
        }
        for (_, body) in &bounded {
            add_section(sight, body, level, EVERYWHERE, found);
        }
    }
    // Sorted by one coordinate, those that may overlap one are its followers up to where it ends.
    bounded.sort_by(|a, b| a.0.min.x.total_cmp(&b.0.min.x));
    for (i, (bounds, body)) in bounded.iter().enumerate() {
        for (other_bounds, other) in bounded[i + 1..].iter().take_while(|other| other.0.min.x <= bounds.max.x)
        {
            let apart = bounds.max.cmplt(other_bounds.min) | other_bounds.max.cmplt(bounds.min);
            if !apart.any() {
                add_meeting(sight, body, other, found);
            }
        }
    }
}

/// The line in which two planes meet: a point and the way it runs.
fn line_of(a: &Level, b: &Level) -> Option<[DVec3; 2]> {
    let along = a.normal.cross(b.normal);
    let point =
        (b.normal.cross(along) * a.offset + along.cross(a.normal) * b.offset) / along.length_squared();
    point.is_finite().then_some([point, along])
}

/// The outline along which a plane cuts a body, within a part of the picture.
fn add_section(sight: &Sight, body: &Body, level: &Level, within: [f64; 4], found: &mut Vec<Outline>) {
    match body {
        Body::Ball { center, radius } if level.height(*center).abs() < *radius => {
            let offset = -level.height(sight.eye);
            let q = circle(level.normal, offset, *center - sight.eye, *radius);
            let outline = sight.conic(&q, *center, *radius);
            found.extend(outline.map(|o| Outline { bounds: common(o.bounds, within), ..o }));
        }
        Body::Flats { flats, .. } => {
            found.extend(flats.iter().filter_map(|flat| sight.segment(flat.chord(level)?)));
        }
        _ => {}
    }
}

/// The outlines along which two bounded bodies meet.
fn add_meeting(sight: &Sight, a: &Body, b: &Body, found: &mut Vec<Outline>) {
    match (a, b) {
        (Body::Ball { center: a, radius: r }, Body::Ball { center: b, radius: s }) => {
            let (way, distance) = (*b - *a, a.distance(*b));
            if distance < r + s && distance > (r - s).abs() {
                let along = (distance * distance + r * r - s * s) / (2.0 * distance);
                let level = Level::through(*a + way * (along / distance), way / distance);
                add_section(sight, &Body::Ball { center: *a, radius: *r }, &level, EVERYWHERE, found);
            }
        }
        (ball @ Body::Ball { .. }, Body::Flats { flats, .. })
        | (Body::Flats { flats, .. }, ball @ Body::Ball { .. }) => {
            for flat in flats {
                let size = flat.bounds.size().length() / 2.0;
                if let Some(within) = sight.bounds_of_ball(flat.bounds.centre(), size) {
                    add_section(sight, ball, &flat.level, within, found);
                }
            }
        }
        (Body::Flats { flats: a, .. }, Body::Flats { flats: b, .. }) => {
            for (a, b) in a.iter().flat_map(|a| b.iter().map(move |b| (a, b))) {
                found.extend(meeting_of(a, b).and_then(|ends| sight.segment(ends)));
            }
        }
        _ => {}
    }
}

/// The segment along which two flat pieces cross.
fn meeting_of(a: &Flat, b: &Flat) -> Option<[DVec3; 2]> {
    overlap(a.chord(&b.level)?, b.chord(&a.level)?)
}
