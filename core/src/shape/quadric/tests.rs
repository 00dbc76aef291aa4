use super::super::testing::*;
use super::*;

const LEFT: Vec3 = Vec3::new(-1.0, 0.0, 0.0);
const DOWN: Vec3 = Vec3::new(0.0, -1.0, 0.0);
const AWAY: Vec3 = Vec3::new(0.0, 0.0, -1.0);
const HALF: f64 = core::f64::consts::FRAC_1_SQRT_2;

fn quadric(coefficients: [f32; 10], min: [f32; 3], max: [f32; 3]) -> Quadric {
    let vec = |[x, y, z]: [f32; 3]| Vec3::new(x, y, z);
    Quadric { center: Vec3::new(1.0, 2.0, 3.0), coefficients, min: vec(min), max: vec(max), capped: true }
}

fn ball() -> Quadric {
    quadric([1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -4.0], [-3.0; 3], [3.0; 3])
}

/// The paraboloid y = x² + z², up to y = 4.
fn bowl() -> Quadric {
    quadric([1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0], [-3.0, -1.0, -3.0], [3.0, 4.0, 3.0])
}

/// The hyperboloid x² + z² = y² + 1 of one sheet, or x² + z² = y² - 1 of two.
fn hyperboloid(sheets: f32) -> Quadric {
    quadric([1.0, -1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0 * sheets - 3.0], [-4.0; 3], [4.0, 3.0, 4.0])
}

#[test]
fn a_ball() {
    let (ball, height) = (ball(), 3f64.sqrt());
    assert_meets(ball, Vec3::new(1.0, 2.0, 10.0), AWAY, 5.0, [0.0, 0.0, 1.0]);
    assert_meets(ball, Vec3::new(1.0, 2.0, 3.0), -LEFT, 2.0, [1.0, 0.0, 0.0]);
    assert_meets(ball, Vec3::new(2.0, 2.0, 10.0), AWAY, 7.0 - height, [0.5, 0.0, height / 2.0]);
    assert_misses(ball, Vec3::new(1.0, 2.0, 10.0), -AWAY);
    assert_misses(ball, Vec3::new(1.0, 4.1, 10.0), AWAY);
    assert_spans(ball, Vec3::new(2.0, 2.0, 10.0), AWAY, &[(7.0 - height, 7.0 + height)]);
}

#[test]
fn coordinates_are_longitude_and_latitude() {
    assert_uv(ball(), Vec3::new(1.0, 2.0, 10.0), AWAY, [0.75, 0.5]);
    // 60 degrees above the equator, on the side of the x axis.
    let up = 60f32.to_radians().tan();
    let inward = Vec3::new(-1.0, -up, 0.001);
    let u = 1e-3 / core::f64::consts::TAU;
    assert_uv(ball(), Vec3::new(1.0, 2.0, 3.0) - inward * 3.0, inward, [u, 0.5 + 1.0 / 3.0]);
}

#[test]
fn the_equation_may_be_multiplied() {
    for factor in [1e-29, 1e-3, 3.0, 1e36] {
        let ball = Quadric { coefficients: ball().coefficients.map(|one| one * factor), ..ball() };
        assert_meets(ball, Vec3::new(1.0, 2.0, 10.0), AWAY, 5.0, [0.0, 0.0, 1.0]);
        let outside_in = Quadric { coefficients: ball.coefficients.map(|one| -one), ..ball };
        // The ray meets the box first, then the cavity.
        assert_meets(outside_in, Vec3::new(1.0, 2.0, 10.0), AWAY, 4.0, [0.0, 0.0, 1.0]);
        assert_spans(outside_in, Vec3::new(1.0, 2.0, 10.0), AWAY, &[(4.0, 5.0), (9.0, 10.0)]);
    }
}

#[test]
fn a_paraboloid_with_a_lid() {
    let bowl = bowl();
    assert_meets(bowl, Vec3::new(2.0, 12.0, 3.0), DOWN, 6.0, [0.0, 1.0, 0.0]);
    assert_meets(bowl, Vec3::new(5.0, 3.0, 3.0), LEFT, 3.0, [2.0 / 5f64.sqrt(), -1.0 / 5f64.sqrt(), 0.0]);
    assert_spans(bowl, Vec3::new(2.0, 12.0, 3.0), DOWN, &[(6.0, 9.0)]);
    let open = Quadric { capped: false, ..bowl };
    let outward = [2.0 / 5f64.sqrt(), -1.0 / 5f64.sqrt(), 0.0];
    assert_meets(open, Vec3::new(2.0, 12.0, 3.0), DOWN, 9.0, outward);
    assert_spans(open, Vec3::new(2.0, 12.0, 3.0), DOWN, &[]);
    assert_misses(open, Vec3::new(5.0, 6.5, 3.0), LEFT);
}

#[test]
fn hyperboloids_of_one_sheet_and_of_two() {
    let (one, two) = (hyperboloid(1.0), hyperboloid(2.0));
    // Along the axis, two sheets begin at a distance of 1 from the middle.
    let above = Vec3::new(1.0, 12.0, 3.0);
    assert_spans(two, above, DOWN, &[(7.0, 9.0), (11.0, 14.0)]);
    let inside_out = Quadric { coefficients: two.coefficients.map(|one| -one), ..two };
    assert_spans(inside_out, above, DOWN, &[(9.0, 11.0)]);
    assert_spans(one, above, DOWN, &[(7.0, 14.0)]);
    assert_meets(one, Vec3::new(9.0, 2.0, 3.0), LEFT, 7.0, [1.0, 0.0, 0.0]);
    // At z = 2 beside the axis, x² = y² + 1 - 4: the line leaves and comes back.
    let y = 3f64.sqrt();
    assert_spans(one, Vec3::new(1.0, 2.0, 5.0), DOWN, &[(-3.0, -y), (y, 4.0)]);
    let open = Quadric { capped: false, ..one };
    let length = (4.0 + 3.0f64).sqrt();
    assert_meets(open, Vec3::new(1.0, 2.0, 5.0), DOWN, y, [0.0, y / length, 2.0 / length]);
}

#[test]
fn a_cone_with_two_naps_and_its_apex() {
    // x² + z² = y²
    let cone = quadric([1.0, -1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [-2.0; 3], [2.0; 3]);
    assert_meets(cone, Vec3::new(6.0, 3.0, 3.0), LEFT, 4.0, [HALF, -HALF, 0.0]);
    assert_spans(cone, Vec3::new(2.0, 9.0, 3.0), DOWN, &[(5.0, 6.0), (8.0, 9.0)]);
    // A ray through the apex: whether it is met or not, a normal is a unit vector.
    let mut memory = Memory::new();
    let prepared = prepared::<_, f32>(cone, &mut memory).unwrap();
    let ray = Ray { origin: Vec3::new(6.0, 2.0, 3.0), direction: LEFT };
    if let Some(t) = prepared.intersect(&ray, Interval::AHEAD) {
        let normal = prepared.surface(&ray, t).normal;
        assert!((normal.length() - 1.0).abs() < 1e-5, "{normal:?}");
    }
}

#[test]
fn mixed_terms_turn_it() {
    // A cylinder of radius 1 along (1, 1, 0): (x - y)² / 2 + z² = 1.
    let pipe = quadric([0.5, 0.5, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0], [-3.0; 3], [3.0; 3]);
    let across = Vec3::new(1.0, -1.0, 0.0);
    let origin = Vec3::new(1.5, 2.5, 3.0);
    assert_spans(pipe, origin, across, &[(-1.0, 1.0)]);
    assert_meets(pipe, origin, across, 1.0, [HALF, -HALF, 0.0]);
    let along = Vec3::new(1.0, 1.0, 0.0);
    assert_spans(pipe, origin, along, &[(-3.5 / HALF, 2.5 / HALF)]);
    // With xz and yz as well: the slab between two planes, (x + y + z)² = 3.
    let slab = quadric([1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 0.0, 0.0, 0.0, -3.0], [-3.0; 3], [3.0; 3]);
    let third = 1.0 / 3f64.sqrt();
    let diagonal = Vec3::new(1.0, 1.0, 1.0);
    assert_meets(slab, Vec3::new(1.0, 2.0, 3.0), diagonal, 1.0, [third, third, third]);
}

#[test]
fn without_squares_it_is_a_plane() {
    let half_box = quadric([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0], [-1.0; 3], [1.0; 3]);
    assert_spans(half_box, Vec3::new(1.5, 12.0, 3.0), DOWN, &[(10.0, 11.0)]);
    assert_meets(half_box, Vec3::new(1.5, 12.0, 3.0), DOWN, 10.0, [0.0, 1.0, 0.0]);
    assert_meets(half_box, Vec3::new(1.5, -8.0, 3.0), -DOWN, 9.0, [0.0, -1.0, 0.0]);
}

#[test]
fn spawned_rays_do_not_meet_their_own_surface() {
    for extent in EXTENTS {
        for quadric in [bowl(), hyperboloid(1.0), hyperboloid(2.0), ball()] {
            let [a, b, c, d, e, f, g, h, i, j] = quadric.coefficients;
            let size = extent / 4.0;
            let quadric = Quadric {
                center: quadric.center * size,
                coefficients: [a, b, c, d, e, f, g * size, h * size, i * size, j * size * size],
                min: quadric.min * size,
                max: quadric.max * size,
                capped: true,
            };
            assert_no_self_hits(quadric, quadric.center, extent, 4_000);
            assert_no_self_hits(Quadric { capped: false, ..quadric }, quadric.center, extent, 4_000);
            assert_spans_are_met(quadric, quadric.center, extent, 500);
        }
    }
}

#[test]
fn bad_quadrics_are_refused() {
    let ball = ball();
    let mut coefficients = [0.0; 10];
    coefficients[9] = -1.0;
    assert_eq!(refusal(Quadric { coefficients, ..ball }), Fault::NoSurface);
    coefficients[3] = f32::NAN;
    assert_eq!(refusal(Quadric { coefficients, ..ball }), Fault::NotFinite);
    assert_eq!(refusal(Quadric { max: ball.min, ..ball }), Fault::NoVolume);
    assert_eq!(refusal(Quadric { max: -ball.max, ..ball }), Fault::NoVolume);
    assert_eq!(refusal(Quadric { max: ball.max * 1e6, ..ball }), Fault::TooFar);
}

#[test]
fn rays_almost_along_a_plane_pass_by() {
    // The plane y = 0 in a box, as an equation of first degree: below it is inside.
    let mut coefficients = [0.0; 10];
    coefficients[7] = 1.0;
    let unit = Vec3::new(1.0, 1.0, 1.0);
    let half = Quadric { center: Vec3::ZERO, coefficients, min: -unit, max: unit, capped: true };
    for z in [5.0, -5.0] {
        for climb in [1e-4, -1e-4] {
            let (origin, toward) = (Vec3::new(0.0, 0.2, z), Vec3::new(0.0, climb, -1.0));
            assert_spans(half, origin, toward, &[]);
            assert_misses(half, origin, toward);
        }
    }
}
