//! How is a polygon of a file cut into triangles, flat or a little bent, convex or not?

use catoptra_core::glam::{DVec2, DVec3};

use super::ears::Ears;
use super::turn::turn;

/// Cuts polygons; kept to use its memory again.
#[derive(Debug, Default)]
pub(in crate::model) struct Cutter {
    flat: Vec<DVec2>,
    other: Vec<[u32; 3]>,
    ears: Ears,
}

impl Cutter {
    /// Cuts a polygon within its outline and adds the triangles by numbers of its corners, each wound as the polygon is.
    /// Corners are finite. Triangles are fewer by two than corners, or less where corners are doubled.
    pub(in crate::model) fn cut(&mut self, outline: &[DVec3], out: &mut Vec<[u32; 3]>) {
        let count = outline.len() as u32;
        if count <= 3 {
            out.extend((count == 3).then_some([0, 1, 2]));
            return;
        }
        let normal = normal_of(outline);
        self.flat.clear();
        self.flat.extend(outline.iter().map(|&point| without_axis(point, normal)));
        // Where all triangles of a fan run as the outline does, it covers it.
        let is_fan = |i: u32| {
            let [a, b, c] = [0, i, i + 1].map(|corner| self.flat[corner as usize]);
            turn(a, b, c).is_ge()
        };
        if normal == DVec3::ZERO || (1..count - 1).all(is_fan) {
            out.extend((1..count - 1).map(|i| [0, i, i + 1]));
            return;
        }
        let start = out.len();
        if self.ears.cut(&self.flat, out) {
            return;
        }
        // What is bent may cross itself as seen along an axis, but not as seen from before.
        let right = normal.any_orthonormal_vector();
        let up = normal.cross(right);
        self.flat.clear();
        let from = outline[0];
        self.flat.extend(
            outline.iter().map(|&point| DVec2::new((point - from).dot(right), (point - from).dot(up))),
        );
        self.other.clear();
        if self.ears.cut(&self.flat, &mut self.other) {
            out.truncate(start);
            out.append(&mut self.other);
        }
    }
}

/// Two coordinates of a point, those across which a polygon is seen best along an axis; it runs anticlockwise in them. They are
/// not rounded, so what is flat and does not cross itself stays so.
fn without_axis(point: DVec3, normal: DVec3) -> DVec2 {
    let size = normal.abs();
    let [along, a, b] = if size.x >= size.y.max(size.z) {
        [normal.x, point.y, point.z]
    } else if size.y >= size.z {
        [normal.y, point.z, point.x]
    } else {
        [normal.z, point.x, point.y]
    };
    if along > 0.0 { DVec2::new(a, b) } else { DVec2::new(b, a) }
}

/// The unit normal of the plane in which a polygon has its area (M. E. Newell; I. Sutherland, R. Sproull, R. Schumacker 1974);
/// where that is none, that of its largest piece at the first corner; zero where all corners lie on a line.
pub(in crate::model) fn normal_of(outline: &[DVec3]) -> DVec3 {
    let Some((&from, rest)) = outline.split_first() else { return DVec3::ZERO };
    let pieces = || rest.windows(2).map(|pair| (pair[0] - from).cross(pair[1] - from));
    let sum: DVec3 = pieces().sum();
    let unit = |v: DVec3| {
        let size = v.abs().max_element();
        if size > 0.0 && size.is_finite() { (v / size).normalize() } else { DVec3::ZERO }
    };
    let largest =
        || pieces().fold(DVec3::ZERO, |a, b| if b.length_squared() > a.length_squared() { b } else { a });
    if sum == DVec3::ZERO { unit(largest()) } else { unit(sum) }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Cuts a polygon and checks that triangles of its own orientation cover it: their borders add up to its outline, so where
    /// none is turned over, each point within it lies in one.
    fn cut(outline: &[DVec3]) -> Vec<[u32; 3]> {
        let mut triangles = Vec::new();
        Cutter::default().cut(outline, &mut triangles);
        let normal = normal_of(outline);
        let area = |corners: &[DVec3]| {
            let (from, rest) = corners.split_first().unwrap();
            rest.windows(2).map(|pair| (pair[0] - from).cross(pair[1] - from).dot(normal)).sum::<f64>()
        };
        let areas: Vec<f64> = triangles.iter().map(|t| area(&t.map(|i| outline[i as usize]))).collect();
        let (whole, sum) = (area(outline), areas.iter().sum::<f64>());
        assert!((whole - sum).abs() < 1e-9 * whole, "{whole} is cut into {sum}");
        let turned = areas.iter().copied().fold(0.0, f64::min);
        assert!(turned > -1e-12 * whole, "a triangle is turned over by {turned} of {whole}");
        triangles
    }

    /// On a plane that lies across all axes.
    fn aslant(outline: &[[f64; 2]]) -> Vec<DVec3> {
        let (right, up) = (DVec3::new(0.36, 0.48, -0.8), DVec3::new(-0.8, 0.6, 0.0));
        outline.iter().map(|&[x, y]| DVec3::new(5.0, -3.0, 2.0) + right * x + up * y).collect()
    }

    /// Cuts it flat, seen from behind and aslant.
    fn cut_all_ways(outline: &[[f64; 2]]) {
        let flat: Vec<DVec3> = outline.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect();
        let count = cut(&flat).len();
        assert!(count <= outline.len() - 2);
        let behind: Vec<DVec3> = flat.iter().rev().copied().collect();
        cut(&behind);
        cut(&aslant(outline));
        // Whichever corner comes first.
        for start in 1..outline.len().min(12) {
            let mut turned = flat.clone();
            turned.rotate_left(start);
            cut(&turned);
        }
    }

    const L: [[f64; 2]; 6] = [[2.0, 0.0], [2.0, 0.6], [0.6, 0.6], [0.6, 1.6], [0.0, 1.6], [0.0, 0.0]];

    #[test]
    fn what_a_fan_covers_is_a_fan() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(cut(&aslant(&square)), [[0, 1, 2], [0, 2, 3]]);
        let dart = [[2.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.0, -1.0]];
        assert_eq!(cut(&aslant(&dart)), [[0, 1, 2], [0, 2, 3]]);
        let [a, b, c, d] = dart;
        let turned = cut(&aslant(&[b, c, d, a]));
        assert!(!turned.contains(&[0, 1, 2]), "{turned:?}");
    }

    #[test]
    fn concave_outlines_are_cut_within() {
        cut_all_ways(&L);
        let comb: Vec<[f64; 2]> = (0..40)
            .map(|i| [f64::from(i / 2), if i % 2 == 0 { 0.0 } else { 5.0 }])
            .chain([[20.0, -1.0], [0.0, -1.0]])
            .rev()
            .collect();
        cut_all_ways(&comb);
        let star: Vec<[f64; 2]> = (0..200)
            .map(|i| {
                let (angle, radius) = (f64::from(i) * TAU / 200.0, [3.0, 1.0, 2.0][i as usize % 3]);
                [radius * angle.cos(), radius * angle.sin()]
            })
            .collect();
        cut_all_ways(&star);
    }

    #[test]
    fn corners_on_sides_and_doubled_ones_change_nothing() {
        let mut rich = Vec::new();
        for (i, a) in L.iter().enumerate() {
            let b = L[(i + 1) % L.len()];
            let at = |t: f64| [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
            rich.extend([*a, at(0.25), at(0.5), at(0.5), at(0.75)]);
        }
        cut_all_ways(&rich);
        let doubled: Vec<[f64; 2]> = L.iter().flat_map(|&corner| [corner; 3]).collect();
        cut_all_ways(&doubled);
        // A spike outwards and one inwards.
        let [a, b, c, d, e, f] = L;
        cut_all_ways(&[a, [3.0, 0.0], a, b, c, d, e, f, [0.3, 0.3], f]);
    }

    #[test]
    fn holes_are_joined_by_bridges() {
        let circle = |radius: f64, count: u32, backwards: bool| {
            let at = move |i: u32| {
                let angle = f64::from(if backwards { count - i } else { i }) * TAU / f64::from(count);
                [radius * angle.cos(), radius * angle.sin()]
            };
            (0..=count).map(move |i| at(i % count))
        };
        let ring: Vec<_> = circle(2.0, 48, false).chain(circle(1.0, 48, true)).collect();
        cut_all_ways(&ring);
        // Two holes, both bridged from one corner, of which one touches a side.
        let hole = |x: f64, y: f64| [[x, y], [x, y + 1.0], [x + 1.0, y + 1.0], [x + 1.0, y], [x, y]];
        let plate = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]];
        let outline: Vec<_> = plate[..1]
            .iter()
            .chain(&hole(1.0, 1.0))
            .chain(&plate[..1])
            .chain(&hole(3.0, 1.0))
            .chain(&plate[..1])
            .chain(&plate[1..])
            .copied()
            .collect();
        cut_all_ways(&outline);
        let tip = [6.0, 3.0];
        let hole = [[5.0, 3.0], [4.0, 2.0], [4.0, 4.0], [5.0, 3.0]];
        let notched: Vec<_> =
            [&plate[..2], &[tip], &hole, &[tip], &plate[2..]].into_iter().flatten().copied().collect();
        cut_all_ways(&notched);
    }

    /// The outline of squares that have grown together by chance: most corners lie on a line with others, and it touches
    /// itself at some.
    fn grown(seed: u64, size: usize) -> Vec<[f64; 2]> {
        const WAYS: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];
        let step = |[x, y]: [i32; 2], way: usize| [x + WAYS[way % 4][0], y + WAYS[way % 4][1]];
        let (mut cells, mut random) = (vec![[0, 0]], seed);
        while cells.len() < size {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let from = cells[(random >> 33) as usize % cells.len()];
            let cell = step(from, (random >> 60) as usize);
            if !cells.contains(&cell) {
                cells.push(cell);
            }
        }
        let lowest = *cells.iter().min_by_key(|[x, y]| (*y, *x)).unwrap();
        // Along the lower side of the lowest; what is inside stays to the left, and of two ways the right one is taken.
        let (mut outline, mut at, mut way) = (Vec::new(), lowest, 0);
        loop {
            outline.push(at.map(f64::from));
            at = step(at, way);
            let [x, y] = at;
            // The cells ahead, to the right and to the left.
            let [right, left] = match way % 4 {
                0 => [[x, y - 1], [x, y]],
                1 => [[x, y], [x - 1, y]],
                2 => [[x - 1, y], [x - 1, y - 1]],
                _ => [[x - 1, y - 1], [x, y - 1]],
            };
            way += if cells.contains(&right) {
                3
            } else if cells.contains(&left) {
                0
            } else {
                1
            };
            if at == lowest && way % 4 == 0 {
                return outline;
            }
        }
    }

    #[test]
    fn outlines_that_touch_themselves_are_cut_within() {
        for seed in 0..150 {
            cut_all_ways(&grown(seed, 3 + seed as usize));
        }
    }

    #[test]
    fn a_hundred_thousand_corners_take_no_time() {
        let count = 50_000;
        let spiral = |radius: f64| {
            (0..count).map(move |i| {
                let turns = f64::from(i) * 40.0 / f64::from(count);
                let (angle, radius) = (turns * TAU, radius + turns);
                [radius * angle.cos(), radius * angle.sin()]
            })
        };
        let inner: Vec<_> = spiral(1.0).collect();
        let outline: Vec<_> = spiral(1.5).chain(inner.into_iter().rev()).collect();
        assert_eq!(cut(&aslant(&outline)).len(), outline.len() - 2);
        let comb: Vec<_> = (0..100_000).map(|i| [f64::from(i), if i % 2 == 0 { 0.0 } else { 1.0 }]).collect();
        let comb: Vec<_> = comb.into_iter().chain([[1e5, -1.0], [0.0, -1.0]]).rev().collect();
        cut(&aslant(&comb));
    }

    #[test]
    fn slightly_bent_outlines_are_cut_within() {
        let mut outline = aslant(&L);
        for (i, point) in outline.iter_mut().enumerate() {
            *point += DVec3::new(0.01, 0.02, -0.01) * (i as f64).sin();
        }
        cut(&outline);
    }

    #[test]
    fn outlines_that_cross_themselves_come_to_an_end() {
        let mut triangles = Vec::new();
        let eight = aslant(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 1.0]]);
        Cutter::default().cut(&eight, &mut triangles);
        assert_eq!(triangles.len(), 2);
        let wild: Vec<DVec3> = (0..3000_u32)
            .map(|i| DVec3::from([7, 11, 13].map(|k| f64::from(i.wrapping_mul(i).wrapping_mul(k) % 101))))
            .collect();
        triangles.clear();
        Cutter::default().cut(&wild, &mut triangles);
        assert!(triangles.len() <= 2998 && triangles.iter().flatten().all(|&corner| corner < 3000));
        for flat in [vec![DVec3::ONE; 9], (0..9).map(|i| DVec3::X * f64::from(i * i % 7)).collect()] {
            triangles.clear();
            Cutter::default().cut(&flat, &mut triangles);
            assert!(triangles.len() <= 7);
        }
    }
}
