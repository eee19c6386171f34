//! Every tolerance and error bound of the crate, with its derivation.

use catoptra_core::glam::DVec3;
use catoptra_core::numeric::UNIT_ROUNDOFF_F64;

/// Rays whose path weight is below this are not traced, unless a view says otherwise.
///
/// A quarter of the step between two levels of an 8-bit display, 1/255, for light that would show as white.
pub(crate) const WEIGHT_CUTOFF: f32 = 0.25 / 255.0;

/// Rays to a lamp for each camera ray, unless said otherwise: of 16 evenly spread ones an edge of a shadow through a lamp is
/// found within 6 % of the lamp.
pub(crate) const LAMP_RAYS: u32 = 16;

/// How many times as far from zero as the smallest thing seen sharply is large the eye may stand before a snapshot gets
/// an origin of its own: up to there `f32` has coordinates right to 2³ · 2⁻²⁴, two millionths, of that thing.
pub(crate) const FAR: f64 = 8.0;

/// Samples lie on multiples of this within their pixel, in pixels: then the sum of a sample's place and the number of
/// pixels before it, below 2³², needs 52 bits at most, so it is the same however it is put together.
pub(crate) const SAMPLE_STEP: f64 = 1.0 / (1_u32 << 20) as f64;

/// Relative error of a sum of light in `f32`, for each of its terms: a rounding.
pub(crate) const SUM_ERROR: f64 = U as f64;

/// Share of a target below which an error that is judged by few samples is believed at once: what 16 means say is off by a
/// factor of 3 in less than one case of 10⁶.
pub(crate) const AT_ONCE: f64 = 1.0 / 3.0;

/// How many times as many samples a pixel gets at most before its error is judged again: so much may be lost where the
/// error was overrated.
pub(crate) const MOST_GROWTH: u32 = 16;

/// How far from where a part of a solid is known to be met it is looked for, as a share of the way: far less than two
/// surfaces lie apart, and 10⁶ times what the way was rounded by.
pub(crate) const NEAR: f64 = 1e-9;

/// Whether results in `f32` carry error bounds, as they do in every ordinary build. Only a build that measures the cost
/// of the bounds (the feature `trust-f32`) sets them all to zero and takes `f32` results as they are.
pub(crate) const CERTAIN: bool = cfg!(not(feature = "trust-f32"));

/// Unit roundoff of `f32`, 2⁻²⁴.
const U: f32 = 1.0 / (1 << 24) as f32;

/// How far a point `origin + t · direction` may be off beside the error of t, per metre of t and of the origin's
/// magnitude: the origin is rounded once (u), the direction carries three roundings (3u of t), the fused sum one more
/// (u of both): 2u and 4u, rounded up.
pub(crate) const POSITION_ERROR: f32 = 6.0 * U;

/// How far a coordinate relative to another point may be off, per metre of the two coordinates' magnitudes: each is
/// rounded once to `f32` (u), and their difference once (2u of the same sum at most).
///
/// The difference enters a product with a unit direction whose components carry three roundings (conversion,
/// length, scaling), a sum of three products (γ₃), and a fused remainder (2u): 3 + 3 + 3 + 2 = 11, rounded up.
pub(crate) const POINT_ERROR: f32 = 12.0 * U;

/// Bounds of `kernel/round.rs`, where e is [`POINT_ERROR`] of all coordinates and of the size R of a ball round the shape, so that
/// 12u R is below e, and κ is 1 + |k|.
///
/// q is off by 2e, h by 3e (a is rounded: 2u |q|, the sum 3u |q|), the climb by 12u, n and d × a by 16u, ρ by 4κe. Then ρn − kem, called v,
/// is off by 12κe: 4κe and 4|k|e from ρ and m, 32u κR from n and the climb, 4u κR from products and a sum. The volume w is
/// off by 2e + 20u |q|, below 4e. Of a ray that meets the side |w| is at most |v|, so that v² − w² is off by 24κe |v| + 8e |v| and
/// squares of these errors: 32κe (|v| + 13κe), where 14 leaves room for the roundings of the root.
pub(crate) const ROUND_CHORD_ERROR: f32 = 32.0;

/// As [`ROUND_CHORD_ERROR`]: the error of A, 33u of n² and 30u k² of its other term, with 4u for the roundings of a quotient by it.
/// Of an A above four times that, three quarters are left.
pub(crate) const ROUND_SQUARE_ERROR: f32 = 48.0 * U;

/// As [`ROUND_CHORD_ERROR`]: the error of B in units of κ²e: 4e of q·n, and |k| times 16u κR + 4κe.
pub(crate) const ROUND_ROOT_ERROR: f32 = 10.0;

/// As [`ROUND_CHORD_ERROR`]: the error of a height, in units of e: 3e, and e for what adds.
pub(crate) const ROUND_END_ERROR: f32 = 4.0;

/// As [`ROUND_CHORD_ERROR`]: the error of a point as seen from the middle of a ball at an end, in units of e: √3 e of q, 3u R of
/// the way there. Along the ray it is twice that: 10u of the point's distance, below 2R, come from the direction.
pub(crate) const ROUND_BALL_ERROR: f32 = 2.0;

/// The error of a distance from a torus that `kernel/torus.rs` computes, in units of e as in [`ROUND_CHORD_ERROR`]: a point is off
/// by 4e (√3 · 2e of q, and 5u of its distance from there), as is what is no larger than how far points are apart; the axis
/// by 2u of the torus, sums and roots by 8u of it, below e each. Rounded up.
pub(crate) const TORUS_ERROR: f32 = 8.0;

/// Relative error of a scalar product with a unit direction: three roundings in each of its components (conversion,
/// length, scaling), one in those of the other vector, and three in the sum of products; doubled for the products'
/// sum of magnitudes, which is at most √3 of the vectors' lengths.
pub(crate) const DIRECTION_ERROR: f32 = 16.0 * U;

/// Share of a point's magnitude that `f64` may lose where it enters a sum that cancels, in units of [`POINT_ERROR`]: a
/// scalar product of three terms with a normalised vector is off by 8 · 2⁻⁵³ of their magnitudes (three in the sum, one
/// in each product, four in the vector), which is 2⁻²⁹ · 8 / 12 of that unit, rounded up to a power of two.
pub(crate) const WIDE_SHARE: f32 = 1.0 / (1 << 28) as f32;

/// Least size of coordinates that errors are reckoned with, 2⁻⁴⁸ metres: so the square of a [`POINT_ERROR`] of it, 2⁻¹³⁷,
/// is larger than what underflow to subnormals costs a dozen operations, 2⁻¹⁵⁰ each. Smaller things are decided in `f64`.
pub(crate) const LEAST_REACH: f32 = 1.0 / (1_u64 << 48) as f32;

/// Rounding of a shape's bounds, and of a ray carried over into a placed shape's own space, per metre of the largest
/// coordinate, in `f64`: a turn by a quaternion rounds some 15 times and is there and back within 4u of a turn, twice
/// for the move, below 64 in all; doubled.
pub(crate) const BOUNDS_ERROR: f64 = 128.0 * UNIT_ROUNDOFF_F64;

/// What [`BOUNDS_ERROR`] is in units of a reach, the smallest multiple of which that counts is [`BOX_PAD`]:
/// 2⁻⁴⁶ / 2⁻²³, doubled.
pub(crate) const WORLD_DRIFT: f32 = 1.0 / (1 << 22) as f32;

/// Relative error of a distance that was decided in `f64`: a rounding to `f32` and two for the length, rounded up beyond
/// what the near side of a box may be off by (six, see [`BOX_STRETCH`]), so that no box is left out for its rounding.
pub(crate) const SETTLED_ERROR: f32 = 8.0 * U;

/// Error of an edge value `(e × q) · d`, relative to |d|₁ L R where L bounds the coordinates of the edge e, and R
/// those of corners and origin together, so those of the corner q as seen from the origin too.
///
/// An edge coordinate is off by uL after its subtraction, one of q by 2uR after conversion and subtraction; their
/// product by uLR + 2uLR + uLR, the difference of two by twice that and one more u·2LR: 10uLR. The direction adds
/// 3u·2LR and the sum of three products γ₃·2LR: 22uLR, rounded up.
pub(crate) const EDGE_ERROR: f32 = 24.0 * U;

/// Share by which balls, boxes and margins are widened before shapes are culled from a tile: it covers the roundings of
/// the few `f64` operations of those tests (below 2⁻⁴⁵) and of points that were rounded to `f32` (2⁻²² of their
/// coordinates), with room to spare.
pub(crate) const PLAN_MARGIN: f64 = 1.0 / (1_u64 << 18) as f64;

/// Share by which the reach of an outline's function is widened before a square is said to be free of it: a dozen `f64`
/// roundings of each value (2⁻⁴⁹), with room to spare, so that a square that holds another is never free where that one is
/// not.
pub(crate) const OUTLINE_MARGIN: f64 = 1.0 / (1_u64 << 40) as f64;

/// Where a segment that runs behind the eye is cut off, as a share of the depth of its deeper end: what is nearer lies
/// 2²⁰ times as far from the picture's middle as the eye sees that end to be off it.
pub(crate) const NEAREST_SHARE: f64 = 1.0 / (1_u64 << 20) as f64;

/// Most lines of one family between checkered squares that part a square: beyond, squares are so small that their mean is
/// near.
pub(crate) const MOST_LINES: f64 = 8.0;

/// Most outlines of a frame: with so many, those in mirrors are no longer told apart.
pub(crate) const MOST_OUTLINES: usize = 1 << 16;

/// Most pairs of a flat surface and a body between it and a lamp: with more, shadows' edges are not told.
pub(crate) const MOST_SHADOWS: usize = 1 << 16;

/// How far four times what the middle of a pixel shows may be from the sum of what its corners do, as a share of the largest of
/// them, for the pixel to be taken as one surface: a hundredth of that, which is less than an eye can tell.
pub(crate) const DOUBT_CONTRAST: f64 = 4.0 / 100.0;

/// Least share of light that mirrors must leave for outlines in them to be told: what is seen in fainter ones is left to a
/// pixel's own sample.
pub(crate) const LEAST_MIRRORED: f64 = 1.0 / 16.0;

/// Most pieces of a pixel: one with more is sampled.
pub(crate) const MOST_PIXEL_PIECES: usize = 64;

/// Mirrors after one another in which outlines are told.
pub(crate) const MIRRORS_DEEP: usize = 2;

/// Largest area of a piece that is left with its neighbour, in quarters of a square: four of 2⁻²² change a pixel by a
/// millionth of what they show at most.
pub(crate) const LEAST_PIECE: f64 = 1.0 / (1_u64 << 22) as f64;

/// Half the side, in pixels, of squares that are not quartered any further: what is told by a sample in the middle of one is
/// 1/256 of a pixel.
pub(crate) const FINEST_SQUARE: f64 = 1.0 / 32.0;

/// Least share of its slope that an outline's function must keep all over a square for the outline to be replaced by a
/// straight line there: it then turns by less than 60°.
pub(crate) const MOST_BEND: f64 = 0.5;

/// Places and weights of Gauss and Legendre's rule of four points on −1 to 1, exact for degree 7.
pub(crate) const GAUSS_4: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// Share of the distance from a light by which points are taken to lie nearer to its cone than they do. `f32` knows the
/// cosine of a point's angle to the axis to 20 u, below 2⁻¹⁹ (six roundings of each coordinate of a unit vector, whose
/// difference to another is up to 2 long, and four of half its square, up to 2): for a cone of all but a full turn,
/// whose rim is a small circle round the axis, that is an angle of up to √(2 · 2⁻¹⁹).
pub(crate) const CONE_MARGIN: f64 = 1.0 / (1_u32 << 9) as f64;

/// Far ends of box intervals are stretched by 1 + 2γ₃ (Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013), with two
/// more roundings for a direction that was itself converted and scaled, and one for the box that was widened: 1 + 2γ₆.
pub(crate) const BOX_STRETCH: f32 = 1.0 + 12.0 * U / (1.0 - 6.0 * U);

/// How far a box is widened on every side, per metre of the ray origin's largest coordinate: the origin is rounded
/// once to `f32`.
pub(crate) const BOX_PAD: f32 = 2.0 * U;

/// Relative error of the end of a stretch in metres: its rounding, that of the length (three of the squares' sum,
/// halved by the root, and those of root and quotient), the direction's own, and a quotient: below 6, rounded up.
pub(crate) const END_ERROR: f32 = 8.0 * U;

/// Between which magnitudes a ray's numbers may be traced in `f32`: their squares, and products with a scene's
/// coordinates of the same size, stay within its range (2⁻¹²⁶ … 2¹²⁸).
pub(crate) const ORDINARY: [f64; 2] = [1.0 / (1_u64 << 60) as f64, (1_u64 << 60) as f64];

/// Unit roundoff of `f64`, 2⁻⁵³.
const W: f64 = catoptra_core::numeric::UNIT_ROUNDOFF_F64;

/// Error of an edge value `(e × p) · d` in `f64`, relative to |d|₁ L P: L bounds the coordinates of the edges, P those of
/// the corners as seen from the origin.
///
/// Edge and corner are differences, off by uL and uP. A component of their cross product is off by 2 (uL·P + L·uP) from
/// those and by 3uLP from two products and a difference: 7uLP; the sum of three products adds γ₃·2LP: 13u, rounded up.
pub(crate) const PRECISE_EDGE_ERROR: f64 = 16.0 * W;

/// Error of a slope `(e × f) · d` in `f64`, relative to |d|₁ L²: 13u as above, rounded up.
pub(crate) const PRECISE_SLOPE_ERROR: f64 = 16.0 * W;

/// Error of `(e × f) · p` in `f64`, relative to L² P: 7u in each of three components, 2u for each of the corner's, and
/// γ₃·6 for the sum of products: 45u, rounded up.
pub(crate) const PRECISE_TOP_ERROR: f64 = 48.0 * W;

/// Error of where an edge from a to b crosses a plane, in `f64` relative to |a| + |b|: three differences, a product and a
/// quotient of the share that is at most 1 (5u), the sum (u); rounded up for the sum that widens by it.
pub(crate) const CLIP_ERROR: f64 = 8.0 * W;

/// How far a box is widened for a single ray, per metre of the origin's largest coordinate: the origin is rounded once,
/// and once more when it is widened.
pub(crate) const SINGLE_RAY_PAD: f32 = 4.0 * U;

/// What an origin that is off by a metre counts among the coordinates that the bounds of a single ray go by: they hold a
/// rounding of it, u of its largest coordinate along every axis.
pub(crate) const SINGLE_RAY_OFF: f32 = 1.0 / U;

/// Error of an edge value of sheared corners: X (a X + b H) + (c H)², X the largest sheared coordinate, H the largest
/// coordinate of a corner plus that of the origin. These are a, b and c.
///
/// A corner is off by uH after its subtraction and by uH for the origin's rounding, along the ray's largest axis as well,
/// where the shear takes at most all of it over; the shear is itself rounded, uH, and so is the sheared coordinate:
/// η = u (X + 5H). Each of an edge value's two products is off by 2Xη + η², and they are rounded together by 3uX²:
/// 4uX² + 20uXH + 3uX² + 2η². In η², X counts where it is below H u; above it 2η² adds less than u (X² + XH).
pub(crate) const SINGLE_RAY_SPREAD: f32 = 9.0 * U;
/// As [`SINGLE_RAY_SPREAD`].
pub(crate) const SINGLE_RAY_SHARE: f32 = 24.0 * U;
/// As [`SINGLE_RAY_SPREAD`].
pub(crate) const SINGLE_RAY_FLOOR: f32 = 12.0 * U;

/// Error of the depth z of a crossing along a single ray, beside the [`SINGLE_RAY_SHARE`] of H that corners are off by
/// (6u), their differences, products and sum, at most 2H each (6u), a sum of edge values, a quotient and a product (8u)
/// and the last sum (u): in units of E D / A, E the error of an edge value, D the corners' spread along the ray, A the
/// three edge values' sum.
///
/// A is off by 3E, so where it is beyond twice this many E three quarters of it are certain; of the depth's two terms
/// each is off by ED and A's own error by 3ED: 5ED over three quarters of A, rounded up.
/// Products that underflow are off by at most 2⁻¹⁴⁹ each, which the least normal number added to them has room for.
pub(crate) const SINGLE_RAY_STEEP: f32 = 8.0;

/// Error of `t` from that depth, relative to itself: two roundings; and of a `t` that is rounded to `f32`, of the ends
/// of a stretch, and of a sum of these: rounded up.
pub(crate) const SINGLE_RAY_DEPTH: f32 = 8.0 * U;

/// Error of the slopes of a ray bundle: computed in `f64` and rounded once; they are below 2.
pub(crate) const BUNDLE_SLOPE: f32 = 2.0 * U;

/// How far a box is widened for a ray bundle, per metre of the largest coordinates of mesh and common origin together:
/// subtraction, origin and slope are off by at most 2u, u and 2u of it, and the product with a slope below 2 by 2u more;
/// doubled for the slope.
pub(crate) const BUNDLE_PAD: f32 = 16.0 * U;

/// How far the slopes at which a box is seen may be off: those that rays below 2 are compared with, by a difference, a
/// quotient's and a product's roundings, 3u of 2; rounded up.
pub(crate) const BUNDLE_BOX: f32 = 8.0 * U;

/// Error of n·(u, v, 1), n = e × p, of a ray bundle, relative to the sum of its products' sizes: edge and corner
/// are rounded differences, a product and a component of n are rounded, as are the slopes, and two fused products: 7u,
/// rounded up. A box of slopes has room for as much again: its middle and its half are rounded, two fused products and a
/// sum each.
pub(crate) const BUNDLE_EDGE: f32 = 8.0 * U;

/// Error of n·(u, v, 1) whose n was computed in `f64`, relative to |n|·(|u|, |v|, 1): n and the slopes are rounded once,
/// and two fused products; rounded up.
pub(crate) const BUNDLE_PLANE: f32 = 5.0 * U;

/// Error of `(e × f) · p`, relative to the sum of its products' sizes: 3u and 4u in the two products of a component, u in
/// the corner's, and three sums of products; rounded up.
pub(crate) const BUNDLE_TOP: f32 = 8.0 * U;

/// Error of a depth from roundings alone, relative to itself: a quotient of two rounded numbers, and sums with bounds;
/// rounded up.
pub(crate) const BUNDLE_DEPTH: f32 = 8.0 * U;

/// How far the places of rays that run side by side may be off from their rounding, u, and a box round them, relative to the
/// largest; rounded up.
pub(crate) const PARALLEL_PLACE: f32 = 4.0 * U;

/// How far places and depths of rays side by side may be off from what `f64` rounds, per metre of the largest coordinate: three
/// differences and products of two of them; rounded up by far, as that is nothing beside what `f32` rounds.
pub(crate) const PARALLEL_WIDE: f32 = 64.0 * W as f32;

/// Error of an edge's value e (q − v) − f (p − u) of rays side by side, relative to E (Q + V) + F (P + U): E and F bound the edge's
/// components across the main axis, sheared, P and Q those of its corner, U and V those of places.
///
/// A sheared component a − l c, |l| ≤ 1, is off by 2u |a| and 4u |c|: of a difference each, the shear's own rounding, and that
/// of the fused product; so edge and corner are off by 4u of their bounds. A product is off by that of both, 8u, its place's
/// rounding by u more; then a product and a difference are rounded to the line's last component, 3u, and two fused
/// products, 3u: at most 12u, rounded up. A box of slopes has room for as much again, as of [`BUNDLE_EDGE`].
pub(crate) const PARALLEL_EDGE: f32 = 14.0 * U;

/// Error of N·p − N_u u − N_v v of rays side by side, N = e × f of sheared edges, relative to the sum of its products' sizes with N
/// bounded by both its products: a component along the places is off by 7u of that ((4 + 1 + 1)u of each product, u of
/// their difference), that along the main axis by 10u; the corner by 4u, a product and the sum by 4u: 18u; what divides it
/// afterwards is rounded, and its quotient, 2u; rounded up.
pub(crate) const PARALLEL_TOP: f32 = 22.0 * U;

/// Error of N_z of rays side by side, as of [`PARALLEL_TOP`]; rounded up.
pub(crate) const PARALLEL_SLOPE: f32 = 12.0 * U;

/// As [`PARALLEL_TOP`], in `f64`.
pub(crate) const PRECISE_PARALLEL_TOP: f64 = 22.0 * W;

/// As [`PARALLEL_SLOPE`], in `f64`.
pub(crate) const PRECISE_PARALLEL_SLOPE: f64 = 12.0 * W;

/// Error of top₁ n₂ − top₂ n₁ in `f64`, relative to each product: two roundings of products and one of a difference;
/// rounded up.
pub(crate) const ORDER_ERROR: f64 = 4.0 * W;

/// Error of the sum of the components of n₁ × n₂ in `f64`, relative to L₁² L₂², the squares of the edges' largest
/// coordinates: 7u 2L² in each component of n, which are below 2L², makes 4 · 14u in each of three, and 3u · 8 for
/// their own products; rounded up.
pub(crate) const ORDER_SHEAR: f64 = 256.0 * W;

/// How far lines may pass a point by to be traced as a bundle with that common origin, per metre that they run: ends of
/// rays that were given in `f32` lie within a few roundings of each other.
pub(crate) const BUNDLE_SPREAD: f32 = 64.0 * U;

/// Most that slopes of rays may be to be traced together: so far below 2 that no error takes them there, which all
/// bounds of ray bundles rest on.
pub(crate) const BUNDLE_STEEP: f32 = 1.9;

/// Largest relative error of a triangle's `t` for which the `f64` plane equation is trusted: a 64th of what `f32` can
/// hold.
pub(crate) const DEPTH_ERROR: f64 = 1.0 / (1_u64 << 30) as f64;

/// How far the start of a shadow ray may be off that was computed in `f64` on a mesh, per metre of its reach.
///
/// The distance `t` from where the ray began is off by [`DEPTH_ERROR`]; the reach holds `t` times [`END_ERROR`] over
/// [`POINT_ERROR`], two thirds of it. The other half has room for what `f64` rounds, below [`BOUNDS_ERROR`].
pub(crate) const START_ERROR: f32 = 3.0 * DEPTH_ERROR as f32;

/// Sum of the magnitudes of the coordinates, rounded up, and at least [`LEAST_REACH`].
pub(crate) fn magnitude_of(v: DVec3) -> f32 {
    (v.abs().element_sum() as f32).next_up() + LEAST_REACH
}

/// Coordinates rounded to `f32`.
pub(crate) fn rounded(v: DVec3) -> [f32; 3] {
    v.to_array().map(|c| c as f32)
}

/// Lamps whose ball is smaller than this share of its distance are worked out in `f64`: unit vectors to their corners are off
/// by 2 roundings each, which differ by 2⁻¹⁸ of an edge of this size.
pub(crate) const SMALL_LAMP: f32 = 1.0 / 32.0;

/// By what share of its radius a ball stands clear of a plane, or a point of the ball, so that `f32` knows: 2⁻¹².
pub(crate) const CUT_MARGIN: f32 = 1.0 / 4096.0;

/// How far outside a plane through a point a box must lie to count as there, relative to the sum of their coordinates and the
/// size of the plane's normal: 2⁻¹⁸. The normal in `f32` is off by 2⁻²⁰ of itself, as is what is carried over into a mesh's
/// own space; differences, products and sums add 6 roundings.
pub(crate) const VIEW_MARGIN: f32 = 1.0 / (1 << 18) as f32;

/// Size of the cells that normals, whose largest coordinate is 1, and distances of planes are sorted into, those in parts of the
/// mesh: 2⁻³². Equal planes of triangles that are not [thin](PLANE_THIN) are computed to a thousandth of it.
pub(crate) const PLANE_CELL: f64 = 1.0 / (1_u64 << 32) as f64;

/// How small the largest coordinate of a triangle's normal is against the square of its largest extent where it counts as thin:
/// 2⁻⁸, which leaves 2⁻⁴⁴ of the normal as the error of a few roundings.
pub(crate) const PLANE_THIN: f64 = 1.0 / 256.0;
