//! How does a node stand in its parent, as a placement and what is left of its matrix?
//!
//! A placement turns, scales alike in all directions, and moves. Of any other matrix M the rest is K in M = s·R·K, upper
//! triangular with a largest diagonal element of 1, its last one negative where M mirrors: by orthogonalising the columns of M
//! (Gram and Schmidt). So all nodes that stretch alike have the same rest, however they are turned, and can share a copy of a mesh.

use catoptra_core::Placement;
use catoptra_core::glam::{DMat3, DQuat, DVec3};

use crate::model::gltf::json::Node;
use crate::model::gltf::refusal::{Refusal, Within};

/// A matrix counts as a placement where it is off by no more than so much of its scale: about what `f32` loses in turning.
const TOLERANCE: f64 = 1e-6;
/// How thin a thing becomes that is scaled to nothing along one axis, as a part of its other sizes.
const THIN: f64 = 1e-6;
/// Elements of a rest are rounded to so many parts of 1, so that equal ones are equal.
const STEPS: f64 = (1 << 24) as f64;

/// What is left of a matrix beside a placement, by the bits of its elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Rest([u64; 9]);

impl Rest {
    /// Nothing: the matrix is a placement.
    pub(crate) const NONE: Self = Self::of(&DMat3::IDENTITY);

    const fn of(m: &DMat3) -> Self {
        let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
        Self([
            x.x.to_bits(),
            x.y.to_bits(),
            x.z.to_bits(),
            y.x.to_bits(),
            y.y.to_bits(),
            y.z.to_bits(),
            z.x.to_bits(),
            z.y.to_bits(),
            z.z.to_bits(),
        ])
    }

    /// As a matrix.
    pub(crate) fn matrix(self) -> DMat3 {
        DMat3::from_cols_array(&self.0.map(f64::from_bits))
    }
}

/// A matrix and a move, as a node has them: translation, turn and scale kept apart where the file does so.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Local {
    pub(crate) translation: DVec3,
    pub(crate) linear: Linear,
}

/// The part of a matrix that moves nothing.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Linear {
    TurnAndScale(DQuat, DVec3),
    Matrix(DMat3),
}

impl Linear {
    pub(crate) fn matrix(self) -> DMat3 {
        match self {
            Self::Matrix(matrix) => matrix,
            Self::TurnAndScale(turn, scale) => DMat3::from_quat(turn) * DMat3::from_diagonal(scale),
        }
    }
}

impl Local {
    /// As a node of the file gives it.
    ///
    /// # Errors
    /// A rotation of zero length.
    pub(crate) fn of(node: &Node) -> Result<Self, Refusal> {
        if let Some(m) = &node.matrix {
            let column = |i: usize| DVec3::new(m[i], m[i + 1], m[i + 2]);
            let matrix = DMat3::from_cols(column(0), column(4), column(8));
            return Ok(Self { translation: column(12), linear: Linear::Matrix(matrix) });
        }
        let vector = |given: Option<[f64; 3]>, default: DVec3| given.map_or(default, DVec3::from);
        let turn = node.rotation.map_or(Ok(DQuat::IDENTITY), turn).within(|| "rotation".to_owned())?;
        let scale = vector(node.scale, DVec3::ONE);
        Ok(Self {
            translation: vector(node.translation, DVec3::ZERO),
            linear: Linear::TurnAndScale(turn, scale),
        })
    }
}

/// The turn of a quaternion of any length.
///
/// # Errors
/// A length of zero.
pub(crate) fn turn(xyzw: [f64; 4]) -> Result<DQuat, Refusal> {
    let quaternion = DQuat::from_array(xyzw);
    let length = quaternion.length();
    if length > 0.0 && length.is_finite() {
        Ok(quaternion / length)
    } else {
        Err(Refusal::new(format!("must be a quaternion of a length that is not 0, not {xyzw:?}")))
    }
}

/// Where something stands: a placement, after what is left.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    pub(crate) placement: Placement,
    pub(crate) rest: Rest,
}

impl Frame {
    /// Of what stands within `outer` so; `None` where it has no extent.
    ///
    /// # Errors
    /// A placement with numbers that overflow.
    pub(crate) fn within(outer: Rest, local: &Local) -> Result<Option<Self>, Refusal> {
        let outer_matrix = outer.matrix();
        let translation = outer_matrix * local.translation;
        let placed = |turn, scale, rest| {
            let placement = Placement::new(turn, translation, scale)?;
            Ok(Some(Self { placement, rest }))
        };
        if let Linear::TurnAndScale(turn, scale) = local.linear
            && outer == Rest::NONE
            && scale.x > 0.0
            && (scale - DVec3::splat(scale.x)).abs().max_element() <= TOLERANCE * scale.x
        {
            return placed(turn, scale.x, Rest::NONE);
        }
        let Some(columns) = thickened(outer_matrix * local.linear.matrix()) else { return Ok(None) };
        let Some((turn, upper)) = orthogonalised(columns) else { return Ok(None) };
        let diagonal = DVec3::new(upper.x_axis.x, upper.y_axis.y, upper.z_axis.z);
        let scale = diagonal.abs().max_element();
        let near = (upper - DMat3::from_diagonal(DVec3::splat(scale))).to_cols_array();
        if near.iter().all(|v| v.abs() <= TOLERANCE * scale) {
            return placed(turn, scale, Rest::NONE);
        }
        placed(turn, scale, Rest::of(&rounded(upper * (1.0 / scale))))
    }
}

/// A matrix whose columns all have a length: one that has none gets a little across the others. `None` where more lack one.
fn thickened(m: DMat3) -> Option<DMat3> {
    let mut columns = [m.x_axis, m.y_axis, m.z_axis];
    let lengths = columns.map(DVec3::length);
    let longest = lengths.into_iter().fold(0.0, f64::max);
    let empty: Vec<usize> = (0..3).filter(|&i| !(lengths[i] > 0.0)).collect();
    match empty[..] {
        [] => {}
        [one] => {
            let across = columns[(one + 1) % 3].cross(columns[(one + 2) % 3]);
            columns[one] = across.try_normalize()? * (THIN * longest);
        }
        _ => return None,
    }
    longest.is_finite().then(|| DMat3::from_cols(columns[0], columns[1], columns[2]))
}

/// The turn and the upper triangular matrix that make a matrix; `None` where its columns lie in a plane.
fn orthogonalised(m: DMat3) -> Option<(DQuat, DMat3)> {
    let [a, b, c] = [m.x_axis, m.y_axis, m.z_axis];
    let x = a.try_normalize()?;
    let along = x.dot(b);
    let across = b - x * along;
    if !(across.length() > TOLERANCE * b.length()) {
        return None;
    }
    let y = across.normalize();
    let z = x.cross(y);
    let depth = z.dot(c);
    if !(depth.abs() > TOLERANCE * TOLERANCE * c.length()) {
        return None;
    }
    let upper = DMat3::from_cols(
        DVec3::new(a.length(), 0.0, 0.0),
        DVec3::new(along, across.length(), 0.0),
        DVec3::new(x.dot(c), y.dot(c), depth),
    );
    Some((DQuat::from_mat3(&DMat3::from_cols(x, y, z)).normalize(), upper))
}

/// Rounded so that no noise of the last digits is left; a diagonal element stays what it is in `f32`, so that none becomes 0.
fn rounded(m: DMat3) -> DMat3 {
    // Adding 0 makes −0 into 0.
    let even = |v: f64| (v * STEPS).round() / STEPS + 0.0;
    let thin = |v: f64| if v.abs() < 0.1 { f64::from(v as f32) } else { even(v) };
    DMat3::from_cols(
        DVec3::new(thin(m.x_axis.x), 0.0, 0.0),
        DVec3::new(even(m.y_axis.x), thin(m.y_axis.y), 0.0),
        DVec3::new(even(m.z_axis.x), even(m.z_axis.y), thin(m.z_axis.z)),
    )
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    fn of(turn: DQuat, scale: DVec3) -> Frame {
        let local = Local { translation: DVec3::X, linear: Linear::TurnAndScale(turn, scale) };
        Frame::within(Rest::NONE, &local).unwrap().unwrap()
    }

    #[test]
    fn a_turn_with_one_scale_is_a_placement_to_the_bit() {
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 2.0) / 3.0, 0.7);
        let frame = of(turn, DVec3::splat(2.5));
        assert_eq!(frame.rest, Rest::NONE);
        assert_eq!(frame.placement, Placement::new(turn, DVec3::X, 2.5).unwrap());
    }

    #[test]
    fn placement_and_rest_make_the_matrix_again() {
        let turn = DQuat::from_axis_angle(DVec3::new(2.0, 1.0, -2.0) / 3.0, 1.1);
        for scale in [
            DVec3::new(3.0, 2.0, 1.0),
            DVec3::new(-1.0, 1.0, 1.0),
            DVec3::new(-2.0, -2.0, -2.0),
            DVec3::new(1.0, 0.5, -4.0),
        ] {
            let outer = of(DQuat::IDENTITY, DVec3::new(1.0, 2.0, 0.5));
            let local = Local { translation: DVec3::Y, linear: Linear::TurnAndScale(turn, scale) };
            let frame = Frame::within(outer.rest, &local).unwrap().unwrap();
            let wanted = outer.rest.matrix() * local.linear.matrix();
            for axis in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE] {
                let found = frame.placement.vector(frame.rest.matrix() * axis);
                assert!((found - wanted * axis).length() < 1e-6, "{scale}: {found}");
            }
            assert_eq!(frame.placement.translation(), DVec3::Y, "the rest keeps its longest axis");
        }
    }

    #[test]
    fn nodes_that_stretch_alike_share_a_rest_however_they_are_turned() {
        let first = of(DQuat::IDENTITY, DVec3::new(1.0, 2.0, 3.0));
        for i in 1..50 {
            let turn = DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), f64::from(i));
            assert_eq!(of(turn, DVec3::new(2.0, 4.0, 6.0)).rest, first.rest, "{i}");
        }
        let mirrored = of(DQuat::IDENTITY, DVec3::new(-1.0, 1.0, 1.0));
        for scale in [DVec3::new(1.0, -1.0, 1.0), DVec3::splat(-3.0)] {
            assert_eq!(of(DQuat::from_rotation_y(FRAC_PI_2), scale).rest, mirrored.rest, "{scale}");
        }
    }

    #[test]
    fn what_has_no_extent_is_nowhere_and_what_is_flat_stays() {
        let within = |scale| {
            let local = Local { translation: DVec3::X, linear: Linear::TurnAndScale(DQuat::IDENTITY, scale) };
            Frame::within(Rest::NONE, &local).unwrap()
        };
        assert!(within(DVec3::ZERO).is_none() && within(DVec3::X).is_none());
        let flat = within(DVec3::new(2.0, 0.0, 2.0)).unwrap();
        let thickness = flat.placement.vector(flat.rest.matrix() * DVec3::Y).length();
        assert!(thickness > 0.0 && thickness < 1e-5, "{thickness}");
    }
}
