//! Tests of pictures of meshes that lie in one plane.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)]

use core::mem::MaybeUninit;

use rayline::math::{Fixed, Real};
use rayline::shape::{Mesh, Pose};
use rayline::{Background, Camera, Light, LinearRgb, Material, PreparedScene, Renderer, Settings, Vec3};

use super::*;
use crate::space::rotation;

const SIZE: (u16, u16) = (80, 60);
const COLORS: [LinearRgb; 3] =
    [LinearRgb::new(1.0, 0.0, 0.0), LinearRgb::new(0.0, 1.0, 0.0), LinearRgb::new(0.0, 0.0, 1.0)];

/// The light of each pixel.
fn picture<R: Real>(scene: &Scene<'_>) -> Vec<[f32; 3]> {
    let mut memory = vec![MaybeUninit::uninit(); scene.bytes::<R>()];
    let prepared = PreparedScene::<R, _>::new(scene, &mut memory).unwrap();
    let renderer = Renderer::new(&prepared, Settings::new(SIZE.0.into(), SIZE.1.into())).unwrap();
    let light = |x, y| renderer.pixel(x, y, &mut ()).0.to_f32().channels();
    (0..SIZE.1).flat_map(|y| (0..SIZE.0).map(move |x| light(x, y))).collect()
}

/// A material that shows its color without light.
fn glowing(color: LinearRgb) -> Material<'static> {
    Material { ambient: 1.0, diffuse: 0.0, ..Material::matte(color) }
}

fn point(at: DVec3) -> Vec3 {
    let [x, y, z] = at.as_vec3().to_array();
    Vec3::new(x, y, z)
}

/// Squares in one plane, each with the lowest and highest of both coordinates.
struct Squares<'s> {
    squares: &'s [[f64; 2]],
    angles: Vec3,
    /// The middle of the plane, and the length of a unit.
    middle: DVec3,
    unit: f64,
}

impl Squares<'_> {
    /// The place in the scene of a point in the plane.
    fn place(&self, x: f64, y: f64) -> DVec3 {
        self.middle + rotation(self.angles) * DVec3::new(x, y, 0.0) * self.unit
    }

    fn mesh<'a>(&self, [low, high]: [f64; 2], arena: &'a Bump) -> Mesh<'a> {
        let corners = [(low, low), (high, low), (high, high), (low, high)];
        let vertices = arena.alloc_slice_fill_iter(corners.map(|(x, y)| point(self.place(x, y))));
        Mesh::new(vertices, &[[0, 1, 2], [0, 2, 3]])
    }

    fn camera(&self, eye: [f64; 3]) -> Camera {
        let eye = self.middle + rotation(self.angles) * DVec3::from_array(eye) * self.unit;
        let up = point(rotation(self.angles) * DVec3::new(0.1, 0.9, 0.3));
        Camera { eye: point(eye), target: point(self.middle), up, vertical_fov: 0.7, lens: None }
    }

    /// The number of pixels in which several squares overlap, and the number of these pixels that do not show
    /// the first square. Pixels nearer to an edge than a hundredth are left out.
    fn count<R: Real>(&self, scene: &Scene<'_>) -> (usize, usize) {
        let camera = scene.camera;
        let [eye, target] = [camera.eye, camera.target].map(vector);
        let forward = (target - eye).normalize();
        let right = forward.cross(vector(camera.up)).normalize();
        let (upward, half) = (right.cross(forward), (f64::from(camera.vertical_fov) / 2.0).tan());
        let normal = rotation(self.angles) * DVec3::Z;
        let (width, height) = (f64::from(SIZE.0), f64::from(SIZE.1));
        let [mut overlapping, mut wrong] = [0, 0];
        for (index, light) in picture::<R>(scene).into_iter().enumerate() {
            let (x, y) = (index % usize::from(SIZE.0), index / usize::from(SIZE.0));
            let across = ((x as f64 + 0.5) * 2.0 - width) / height * half;
            let up = (height - (y as f64 + 0.5) * 2.0) / height * half;
            let toward = forward + right * across + upward * up;
            let met = eye + toward * ((self.middle - eye).dot(normal) / toward.dot(normal)) - self.middle;
            let met = rotation(self.angles).transpose() * met / self.unit;
            // Positive inside.
            let inside = |[low, high]: [f64; 2]| {
                [met.x - low, high - met.x, met.y - low, high - met.y].into_iter().fold(1.0, f64::min)
            };
            let depths: Vec<_> = self.squares.iter().map(|square| inside(*square)).collect();
            let within: Vec<_> = (0..depths.len()).filter(|square| depths[*square] > 0.0).collect();
            if within.len() > 1 && depths.iter().all(|depth| depth.abs() > 0.01) {
                overlapping += 1;
                let first = LinearRgb::new(light[0], light[1], light[2]);
                wrong += usize::from(first != COLORS[within[0]]);
            }
        }
        (overlapping, wrong)
    }
}

/// The squares in this order seen from both sides, steeply and not, before and after they are parted.
fn see(squares: &Squares<'_>) -> [usize; 3] {
    let materials = COLORS.map(glowing);
    let [mut overlapping, mut before, mut after] = [0; 3];
    for eye in [[0.3, -0.2, 6.0], [1.0, 2.0, -7.0], [3.0, -6.0, 1.0]] {
        let arena = Bump::new();
        let mesh = |square: &[f64; 2]| squares.mesh(*square, &arena);
        let meshes = squares.squares.iter().map(mesh).zip(0..);
        let meshes = meshes.map(|(mesh, index)| Object::new(Shape::Mesh(mesh), index));
        let objects: Vec<Object<Shape<'_>>> = meshes.collect();
        let scene = Scene {
            camera: squares.camera(eye),
            background: Background::BLACK,
            objects: &objects,
            materials: &materials,
            lights: &[],
            motions: &[],
        };
        let parted = part(&scene, &arena);
        assert!(parted.is_whole && parted.moved == (1..objects.len()).collect::<Vec<_>>());
        let parted = Scene { objects: parted.objects, ..scene };
        for (scene, wrong) in [(scene, &mut before), (parted, &mut after)] {
            let [(count, in_f32), (_, in_fixed)] =
                [squares.count::<f32>(&scene), squares.count::<Fixed>(&scene)];
            overlapping += count;
            *wrong += in_f32 + in_fixed;
        }
    }
    [overlapping, before, after]
}

/// Where squares overlap, each pixel shows the first one, in f32 and in fixed point: in any order, in tilted
/// planes, near the origin and a thousand times as far away.
#[test]
fn the_first_of_several_meshes_in_a_plane_is_seen() {
    let [mut pixels, mut speckles] = [0, 0];
    let all = [[-1.0, 1.0], [-0.5, 1.5], [-1.5, 0.5]];
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        for angles in [Vec3::ZERO, Vec3::new(0.37, -1.13, 2.71), Vec3::new(-0.011, 0.023, 0.9)] {
            for (middle, unit) in [(DVec3::ZERO, 1.0), (DVec3::new(3.1, -2.7, 1.3), 0.37)] {
                let squares = order.map(|square: usize| all[square]);
                let [overlapping, before, after] = see(&Squares { squares: &squares, angles, middle, unit });
                assert_eq!(after, 0, "{order:?} {angles:?} {middle}");
                (pixels, speckles) = (pixels + overlapping, speckles + before);
            }
        }
    }
    assert!(pixels > 50_000, "{pixels}");
    // Without the step, distances differ by rounding.
    assert!(speckles > 1000, "{speckles}");
}

/// A cube from -1 to 1 on a floor, with the bottom of the cube or without.
fn on_floor(has_bottom: bool, floor_is_first: bool, is_shared: bool, look: impl FnOnce(&Scene<'_>)) {
    let corner = |bits: u16| Vec3::new((bits & 1) as f32, (bits >> 1 & 1) as f32, (bits >> 2) as f32);
    let corners: Vec<_> = (0..8).map(|bits| corner(bits) * 2.0 - Vec3::new(1.0, 0.0, 1.0)).collect();
    let faces: [[u16; 4]; 6] =
        [[0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5], [0, 2, 3, 1], [4, 5, 7, 6]];
    let (mut vertices, mut triangles) = (if is_shared { corners.clone() } else { Vec::new() }, Vec::new());
    for face in &faces[usize::from(!has_bottom)..] {
        let at = |corner: usize| if is_shared { face[corner] } else { (vertices.len() + corner) as u16 };
        triangles.extend([[at(0), at(1), at(2)], [at(0), at(2), at(3)]]);
        if !is_shared {
            vertices.extend(face.map(|corner| corners[usize::from(corner)]));
        }
    }
    let floor = [[-4.0, -4.0], [-4.0, 4.0], [4.0, 4.0], [4.0, -4.0]].map(|[x, z]| Vec3::new(x, 0.0, z));
    let mesh = |vertices, triangles| Mesh::new(vertices, triangles);
    let cube = Object::new(Shape::Mesh(mesh(&*vertices, &*triangles)), 0);
    let floor = Object::new(Shape::Mesh(mesh(&floor, &[[0, 1, 2], [0, 2, 3]])), 1);
    let materials = [LinearRgb::new(0.8, 0.1, 0.1), LinearRgb::gray(0.6)].map(|color| Material {
        ambient: 0.1,
        diffuse: 0.9,
        ..Material::matte(color)
    });
    let position = Vec3::new(3.0, 6.0, 4.0);
    look(&Scene {
        camera: Camera {
            eye: Vec3::new(2.1, 4.3, 8.2),
            target: Vec3::new(0.0, 0.5, 0.0),
            up: Vec3::new(0.0, 1.0, 0.0),
            vertical_fov: 0.7,
            lens: None,
        },
        background: Background::BLACK,
        objects: &if floor_is_first { [floor, cube] } else { [cube, floor] },
        materials: &materials,
        lights: &[Light::Point { position, color: LinearRgb::WHITE }],
        motions: &[],
    });
}

/// A cube that stands on a floor looks as one without a bottom, which shares no plane with the floor.
#[test]
fn a_box_on_a_floor_keeps_its_look() {
    for (floor_is_first, is_shared) in [(true, true), (true, false), (false, true), (false, false)] {
        let mut open = Vec::new();
        on_floor(false, floor_is_first, is_shared, |scene| {
            let arena = Bump::new();
            assert!(part(scene, &arena).moved.is_empty());
            open = picture::<f32>(scene);
        });
        on_floor(true, floor_is_first, is_shared, |scene| {
            let arena = Bump::new();
            let parted = part(scene, &arena);
            assert_eq!(parted.moved, [1]);
            let closed = picture::<f32>(&Scene { objects: parted.objects, ..*scene });
            let differs =
                |(a, b): &(&[f32; 3], &[f32; 3])| a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 0.001);
            let differing = open.iter().zip(&closed).filter(differs).count();
            // A floor that moves takes its edges and the shadow on it along, by a fortieth of a pixel: of the
            // 200 pixels along them, 5.
            let most = if floor_is_first { 0 } else { 5 };
            assert!(differing <= most, "{floor_is_first} {is_shared}: {differing}");
        });
    }
}

/// A grid of squares that touch at their edges.
fn grid<'a>(side: u16, lift: f32, arena: &'a Bump) -> Vec<Mesh<'a>> {
    let square = |x: u16, y: u16| {
        let at = |x: u16, y: u16| Vec3::new(f32::from(x) * 0.013, f32::from(y) * 0.017, lift);
        let vertices = arena.alloc_slice_copy(&[at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)]);
        Mesh::new(vertices, &[[0, 1, 2], [0, 2, 3]])
    };
    (0..side).flat_map(|y| (0..side).map(move |x| square(x, y))).collect()
}

fn parted<'a>(meshes: &[Mesh<'a>], arena: &'a Bump, look: impl FnOnce(&Scene<'a>, Parted<'a>)) {
    let objects = arena.alloc_slice_fill_iter(meshes.iter().map(|mesh| Object::new(Shape::Mesh(*mesh), 0)));
    let camera = Camera {
        eye: Vec3::new(1.0, 2.0, 9.0),
        target: Vec3::ZERO,
        up: Vec3::new(0.0, 1.0, 0.0),
        vertical_fov: 0.7,
        lens: None,
    };
    let background = Background::BLACK;
    let scene = Scene { camera, background, objects, materials: &[], lights: &[], motions: &[] };
    look(&scene, part(&scene, arena));
}

/// 60,025 squares in one plane touch each other, and one below them overlaps them all.
#[test]
fn many_meshes_in_a_plane_take_few_steps() {
    let arena = Bump::new();
    let mut meshes = grid(245, 0.0, &arena);
    parted(&meshes, &arena, |scene, parted| {
        assert!(parted.is_whole && parted.moved.is_empty());
        assert!(core::ptr::eq(parted.objects, scene.objects));
    });
    let far = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    meshes.push(Mesh { vertices: &far, ..meshes[0] });
    parted(&meshes, &arena, |scene, parted| {
        assert!(parted.is_whole);
        assert_eq!(parted.moved, [60_025]);
        let before = scene.objects.iter().zip(parted.objects).filter(|(a, b)| a == b).count();
        assert_eq!(before, 60_025);
        let Shape::Mesh(mesh) = parted.objects[60_025].shape else { unreachable!() };
        // The largest coordinate is 9: the corners lie as many 32,768ths deeper.
        assert!(mesh.vertices.iter().all(|vertex| (vertex.z + 9.0 / 32_768.0).abs() < 1e-9));
    });
}

/// In a very high stack at most 64 steps are taken, and not all of its pairs are looked at.
#[test]
fn stacks_are_limited() {
    let arena = Bump::new();
    let stack = |count| vec![grid(1, 0.0, &arena)[0]; count];
    let depth = |parted: &Parted<'_>, index: usize| {
        let Shape::Mesh(mesh) = parted.objects[index].shape else { unreachable!() };
        -f64::from(mesh.vertices[0].z) * 32_768.0 / 9.0
    };
    parted(&stack(70), &arena, |_, parted| {
        assert!(parted.is_whole);
        for index in [0, 1, 2, 63, 64, 65, 69] {
            assert!((depth(&parted, index) - index.min(64) as f64).abs() < 1e-3, "{index}");
        }
    });
    parted(&stack(30_000), &arena, |_, parted| {
        assert!(parted.is_whole);
        assert!((depth(&parted, 29_999) - 64.0).abs() < 1e-3);
    });
}

/// The boxes of 3,000 slanted strips all overlap, though the strips do not.
#[test]
fn searches_end() {
    let arena = Bump::new();
    let strip = |index: u16| {
        let at = |x: f32, up: f32| Vec3::new(x, x + f32::from(index) * 2e-3 + up, 0.0);
        let vertices =
            arena.alloc_slice_copy(&[at(0.0, 0.0), at(9.0, 0.0), at(9.0, 1.5e-3), at(0.0, 1.5e-3)]);
        Mesh::new(vertices, &[[0, 1, 2], [0, 2, 3]])
    };
    let strips: Vec<_> = (0..3000).map(strip).collect();
    parted(&strips[..30], &arena, |_, parted| assert!(parted.is_whole && parted.moved.is_empty()));
    parted(&strips, &arena, |_, parted| assert!(!parted.is_whole && parted.moved.is_empty()));
}

/// Instances move as a whole, one by one.
#[test]
fn instances_move_behind_a_floor() {
    let arena = Bump::new();
    let tile = grid(1, 0.0, &arena)[0];
    let model = Model::Mesh(tile);
    let poses = [Pose::at(Vec3::new(0.0, 0.0, 0.5)), Pose::at(Vec3::new(0.3, 0.0, 0.0))];
    let instances = Shape::Instances(Instances::new(&model, &poses));
    let floor = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    let objects = [Object::new(Shape::Mesh(Mesh { vertices: &floor, ..tile }), 0), Object::new(instances, 0)];
    parted(&[], &arena, |scene, _| {
        let parted = part(&Scene { objects: &objects, ..*scene }, &arena);
        let Shape::Instances(Instances { poses: moved, .. }) = parted.objects[1].shape else {
            unreachable!()
        };
        assert_eq!(moved[0], poses[0]);
        let down = Vec3::new(0.0, 0.0, 9.0 / 32_768.0);
        assert_eq!(moved[1], Pose::at(poses[1].origin - down));
    });
}
