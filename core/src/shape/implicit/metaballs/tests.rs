use super::super::super::testing::*;
use super::kernel::{kernel, slope};
use super::*;

const DOWN: Vec3 = Vec3::new(0.0, 0.0, -1.0);
const LEFT: Vec3 = Vec3::new(-1.0, 0.0, 0.0);
const CENTER: Vec3 = Vec3::new(1.0, 2.0, 3.0);

#[test]
fn one_is_a_ball_of_half_its_radius() {
    let blobs = [Blob::new(CENTER, 4.0)];
    let ball = Metaballs::new(&blobs);
    assert_meets(ball, Vec3::new(1.0, 2.0, 10.0), DOWN, 5.0, [0.0, 0.0, 1.0]);
    assert_meets(ball, Vec3::new(1.0, 2.0, 4.5), DOWN, 3.5, [0.0, 0.0, -1.0]);
    let height = 3f64.sqrt();
    assert_meets(ball, Vec3::new(2.0, 2.0, 10.0), DOWN, 7.0 - height, [0.5, 0.0, height / 2.0]);
    assert_misses(ball, Vec3::new(1.0, 2.0, 10.0), -DOWN);
    assert_misses(ball, Vec3::new(1.0, 4.001, 10.0), DOWN);
    assert_uv(ball, Vec3::new(1.0, 2.0, 10.0), DOWN, [0.75, 0.5]);
}

#[test]
fn several_in_one_place_add_up() {
    // Four blobs of strength 3/4 and one of -1 look like one of strength 2.
    let blobs = [Blob { strength: 0.75, ..Blob::new(CENTER, 4.0) }; 4];
    let cut = [blobs[0], blobs[0], blobs[0], blobs[0], Blob { strength: -1.0, ..blobs[0] }];
    let radius = 4.0 * f64::from(reach_of(0.5f32 / 2.0).unwrap());
    let top = [0.0, 0.0, 1.0];
    assert_meets(Metaballs::new(&cut), Vec3::new(1.0, 2.0, 10.0), DOWN, 7.0 - radius, top);
    // The kernel is 1/4 there.
    let q = (radius / 4.0).powi(2);
    assert!((1.0 - 22.0 / 9.0 * q + 17.0 / 9.0 * q * q - 4.0 / 9.0 * q * q * q - 0.25).abs() < 1e-6);
}

#[test]
fn two_flow_together() {
    let one = Blob::new(Vec3::new(-1.0, 0.0, 0.0), 2.0);
    let blobs = [one, Blob { center: Vec3::new(1.0, 0.0, 0.0), ..one }];
    let pair = Metaballs::new(&blobs);
    // Between them both add 1/2 where single balls would touch, so there is a waist of radius h, where each
    // adds 1/4. Its points have a distance of r from the centers, with r² = 1 + h².
    let waist = (4.0 * f64::from(reach_of(0.25f32).unwrap()).powi(2) - 1.0).sqrt();
    assert_meets(pair, Vec3::new(0.0, 0.0, 5.0), DOWN, 5.0 - waist, [0.0, 0.0, 1.0]);
    assert_meets(pair, Vec3::ZERO, DOWN, waist, [0.0, 0.0, -1.0]);
    assert_meets(pair, Vec3::new(5.0, 0.0, 0.0), LEFT, 3.0, [1.0, 0.0, 0.0]);
    // A blob that subtracts divides them.
    let blobs = [blobs[0], blobs[1], Blob { strength: -1.0, ..Blob::new(Vec3::ZERO, 1.0) }];
    assert_misses(Metaballs::new(&blobs), Vec3::new(0.0, 0.0, 5.0), DOWN);
    assert_meets(Metaballs::new(&blobs), Vec3::new(1.0, 0.0, 5.0), DOWN, 4.0, [0.0, 0.0, 1.0]);
}

/// Some blobs at random places within `extent`.
fn drops(center: Vec3, extent: f32) -> [Blob; 6] {
    let mut random = Random(5);
    core::array::from_fn(|index| Blob {
        center: center + random.vector() * (0.5 * extent),
        radius: extent * (0.8 + 0.2 * random.next()),
        strength: if index == 5 { -0.5 } else { 1.0 },
    })
}

#[test]
fn the_slope_of_the_kernel_is_known_and_bounded() {
    for step in 0..10_000u16 {
        let (r, next) = (f64::from(step) / 1e4, f64::from(step + 1) / 1e4);
        let (fall, middle) = (kernel(r * r) - kernel(next * next), (r + next) / 2.0);
        assert!(fall < 1.5836e-4 && (fall - slope(middle * middle) * middle * 1e-4).abs() < 1e-10);
    }
}

#[test]
fn every_first_hit_is_that_of_a_fine_search() {
    let blobs = drops(Vec3::ZERO, 1.0);
    let mut memory = Memory::new();
    let prepared = prepared::<_, f64>(Metaballs::new(&blobs), &mut memory).unwrap();
    let is_inside = |point: Vec3<f64>| {
        let add = |blob: &Blob| {
            let q = (point - blob.center.to()).length_squared() / f64::from(blob.radius).powi(2);
            f64::from(blob.strength) * if q < 1.0 { kernel(q) } else { 0.0 }
        };
        blobs.iter().map(add).sum::<f64>() > 0.5
    };
    let (mut random, mut met) = (Random(3), 0);
    for _ in 0..500 {
        let origin = random.direction() * 3.0;
        let direction = (random.vector() - origin).to::<f64>().normalized().unwrap();
        let ray = Ray { origin: origin.to::<f64>(), direction };
        let searched = (0..6_000).map(|step| f64::from(step) / 1e3).find(|t| is_inside(ray.at(*t)));
        let found = prepared.intersect(&ray, Interval::AHEAD);
        match (searched, found) {
            (Some(searched), Some(found)) => {
                met += 1;
                // The fine search may miss parts that are thinner than its steps.
                assert!(found <= searched && (found > searched - 1e-3 || is_inside(ray.at(found + 1e-5))));
                assert!(
                    is_inside(ray.at(found + 1e-5)) && !is_inside(ray.at(found - 1e-5)),
                    "{ray:?} {found}"
                );
            }
            (None, Some(found)) => assert!(is_inside(ray.at(found + 1e-6)), "{ray:?} {found}"),
            (searched, None) => assert_eq!(searched, None, "{ray:?}"),
        }
    }
    assert!(met > 100, "{met}");
}

#[test]
fn spawned_rays_do_not_meet_their_own_surface() {
    for extent in EXTENTS {
        for center in [Vec3::ZERO, Vec3::new(3.0, -2.0, 1.0) * extent] {
            let blobs = drops(center, extent);
            assert_no_self_hits(Metaballs::new(&blobs), center, extent, 10_000);
            let one = [Blob::new(center, 1.5 * extent)];
            assert_no_self_hits(Metaballs::new(&one), center, extent, 5_000);
        }
    }
}

#[test]
fn bad_metaballs_are_refused() {
    let refused = |blob: Blob| refusal(Metaballs::new(&[blob]));
    let blob = Blob::new(CENTER, 1.0);
    assert_eq!(refused(Blob { radius: 0.0, ..blob }), Fault::RadiusNotPositive);
    assert_eq!(refused(Blob { strength: 0.5, ..blob }), Fault::TooWeak);
    assert_eq!(refused(Blob { strength: f32::NAN, ..blob }), Fault::NotFinite);
    assert_eq!(refused(Blob { center: Vec3::new(0.0, 2e6, 0.0), ..blob }), Fault::TooFar);
    assert_eq!(refusal(Metaballs::new(&[])), Fault::TooWeak);
    assert_eq!(refusal(Metaballs::new(&[blob; 33])), Fault::TooManyBlobs { given: 33 });
}
