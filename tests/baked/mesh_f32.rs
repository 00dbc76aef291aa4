// Written by rayline: change the scene and write it again.
/// The description of the scene. Only the parts of it that are used take flash.
pub const DESCRIPTION: rayline::Scene<'static> = {
    #[allow(unused_imports)]
    use rayline::{*, shape::*};
    Scene {
        camera: Camera {
            eye: Vec3::new(0.0, 2.6, 4.6),
            target: Vec3::new(0.0, 0.8, 0.0),
            up: Vec3::new(0.0, 1.0, 0.0),
            vertical_fov: 0.7,
            lens: None,
        },
        background: Background::Solid(LinearRgb::new(0.3, 0.4, 0.6)),
        objects: &[
            Object {
                shape: Shape::Plane(Plane {
                    point: Vec3::new(0.0, 0.0, 0.0),
                    normal: Vec3::new(0.0, 1.0, 0.0),
                }),
                material: MaterialId(0),
            },
            Object {
                shape: Shape::Mesh(Mesh {
                    vertices: &[Vec3::new(-0.5257, 1.8507, 0.0), Vec3::new(0.5257, 1.8507, 0.0), Vec3::new(-0.5257, 0.14929998, 0.0), Vec3::new(0.5257, 0.14929998, 0.0), Vec3::new(0.0, 0.47430003, 0.8507), Vec3::new(0.0, 1.5257, 0.8507), Vec3::new(0.0, 0.47430003, -0.8507), Vec3::new(0.0, 1.5257, -0.8507), Vec3::new(0.8507, 1.0, -0.5257), Vec3::new(0.8507, 1.0, 0.5257), Vec3::new(-0.8507, 1.0, -0.5257), Vec3::new(-0.8507, 1.0, 0.5257), Vec3::new(-0.809, 1.5, 0.309), Vec3::new(-0.5, 1.309, 0.809), Vec3::new(-0.309, 1.809, 0.5), Vec3::new(0.309, 1.809, 0.5), Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.309, 1.809, -0.5), Vec3::new(-0.309, 1.809, -0.5), Vec3::new(-0.5, 1.309, -0.809), Vec3::new(-0.809, 1.5, -0.309), Vec3::new(-1.0, 1.0, 0.0), Vec3::new(0.5, 1.309, 0.809), Vec3::new(0.809, 1.5, 0.309), Vec3::new(-0.5, 0.691, 0.809), Vec3::new(0.0, 1.0, 1.0), Vec3::new(-0.809, 0.5, -0.309), Vec3::new(-0.809, 0.5, 0.309), Vec3::new(0.0, 1.0, -1.0), Vec3::new(-0.5, 0.691, -0.809), Vec3::new(0.809, 1.5, -0.309), Vec3::new(0.5, 1.309, -0.809), Vec3::new(0.809, 0.5, 0.309), Vec3::new(0.5, 0.691, 0.809), Vec3::new(0.309, 0.19099998, 0.5), Vec3::new(-0.309, 0.19099998, 0.5), Vec3::new(0.0, 0.0, 0.0), Vec3::new(-0.309, 0.19099998, -0.5), Vec3::new(0.309, 0.19099998, -0.5), Vec3::new(0.5, 0.691, -0.809), Vec3::new(0.809, 0.5, -0.309), Vec3::new(1.0, 1.0, 0.0)],
                    triangles: &[[0, 12, 14], [11, 13, 12], [5, 14, 13], [12, 13, 14], [0, 14, 16], [5, 15, 14], [1, 16, 15], [14, 15, 16], [0, 16, 18], [1, 17, 16], [7, 18, 17], [16, 17, 18], [0, 18, 20], [7, 19, 18], [10, 20, 19], [18, 19, 20], [0, 20, 12], [10, 21, 20], [11, 12, 21], [20, 21, 12], [1, 15, 23], [5, 22, 15], [9, 23, 22], [15, 22, 23], [5, 13, 25], [11, 24, 13], [4, 25, 24], [13, 24, 25], [11, 21, 27], [10, 26, 21], [2, 27, 26], [21, 26, 27], [10, 19, 29], [7, 28, 19], [6, 29, 28], [19, 28, 29], [7, 17, 31], [1, 30, 17], [8, 31, 30], [17, 30, 31], [3, 32, 34], [9, 33, 32], [4, 34, 33], [32, 33, 34], [3, 34, 36], [4, 35, 34], [2, 36, 35], [34, 35, 36], [3, 36, 38], [2, 37, 36], [6, 38, 37], [36, 37, 38], [3, 38, 40], [6, 39, 38], [8, 40, 39], [38, 39, 40], [3, 40, 32], [8, 41, 40], [9, 32, 41], [40, 41, 32], [4, 33, 25], [9, 22, 33], [5, 25, 22], [33, 22, 25], [2, 35, 27], [4, 24, 35], [11, 27, 24], [35, 24, 27], [6, 37, 29], [2, 26, 37], [10, 29, 26], [37, 26, 29], [8, 39, 31], [6, 28, 39], [7, 31, 28], [39, 28, 31], [9, 41, 23], [8, 30, 41], [1, 23, 30], [41, 30, 23]],
                    normals: Some(&[Vec3::new(-0.5257, 0.8507, 0.0), Vec3::new(0.5257, 0.8507, 0.0), Vec3::new(-0.5257, -0.8507, 0.0), Vec3::new(0.5257, -0.8507, 0.0), Vec3::new(0.0, -0.5257, 0.8507), Vec3::new(0.0, 0.5257, 0.8507), Vec3::new(0.0, -0.5257, -0.8507), Vec3::new(0.0, 0.5257, -0.8507), Vec3::new(0.8507, 0.0, -0.5257), Vec3::new(0.8507, 0.0, 0.5257), Vec3::new(-0.8507, 0.0, -0.5257), Vec3::new(-0.8507, 0.0, 0.5257), Vec3::new(-0.809, 0.5, 0.309), Vec3::new(-0.5, 0.309, 0.809), Vec3::new(-0.309, 0.809, 0.5), Vec3::new(0.309, 0.809, 0.5), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.309, 0.809, -0.5), Vec3::new(-0.309, 0.809, -0.5), Vec3::new(-0.5, 0.309, -0.809), Vec3::new(-0.809, 0.5, -0.309), Vec3::new(-1.0, 0.0, 0.0), Vec3::new(0.5, 0.309, 0.809), Vec3::new(0.809, 0.5, 0.309), Vec3::new(-0.5, -0.309, 0.809), Vec3::new(0.0, 0.0, 1.0), Vec3::new(-0.809, -0.5, -0.309), Vec3::new(-0.809, -0.5, 0.309), Vec3::new(0.0, 0.0, -1.0), Vec3::new(-0.5, -0.309, -0.809), Vec3::new(0.809, 0.5, -0.309), Vec3::new(0.5, 0.309, -0.809), Vec3::new(0.809, -0.5, 0.309), Vec3::new(0.5, -0.309, 0.809), Vec3::new(0.309, -0.809, 0.5), Vec3::new(-0.309, -0.809, 0.5), Vec3::new(0.0, -1.0, 0.0), Vec3::new(-0.309, -0.809, -0.5), Vec3::new(0.309, -0.809, -0.5), Vec3::new(0.5, -0.309, -0.809), Vec3::new(0.809, -0.5, -0.309), Vec3::new(1.0, 0.0, 0.0)]),
                    uvs: None,
                    colors: None,
                    smooth_terminator: false,
                }),
                material: MaterialId(1),
            },
        ],
        materials: &[
            Material {
                color: Texture::Checker(Checker {
                    even: LinearRgb::new(0.7, 0.7, 0.7),
                    odd: LinearRgb::new(0.3, 0.3, 0.3),
                    cells_per_unit: Vec3::new(1.0, 0.0, 1.0),
                }),
                ambient: 0.0,
                diffuse: 1.0,
                specular: 0.0,
                shininess: 0.0,
                reflectance: 0.0,
                transmittance: 0.0,
                ior: 1.0,
                optics: None,
                maps: &[],
            },
            Material {
                color: Texture::Solid(LinearRgb::new(0.7, 0.3, 0.1)),
                ambient: 0.1,
                diffuse: 0.7,
                specular: 0.4,
                shininess: 60.0,
                reflectance: 0.2,
                transmittance: 0.0,
                ior: 1.0,
                optics: None,
                maps: &[],
            },
        ],
        lights: &[
            Light::Point {
                position: Vec3::new(-4.0, 6.0, 5.0),
                color: LinearRgb::new(0.9, 0.9, 0.9),
            },
        ],
        motions: &[],
    }
};

rayline::shape_set! {
    /// The shapes of the scene, and no others.
    pub enum Shapes;
    /// The prepared shapes of the scene.
    pub enum PreparedShapes {
        /// A built-in shape.
        Mesh(&'static rayline::shape::BakedMesh<f32>),
        /// A built-in shape.
        Plane(rayline::shape::Plane),
    }
}

const fn n(bits: u32) -> f32 {
    f32::from_bits(bits)
}

const fn v(x: u32, y: u32, z: u32) -> rayline::Vec3<f32> {
    rayline::Vec3::new(n(x), n(y), n(z))
}

static MESH_1: rayline::shape::BakedMesh<f32> = rayline::shape::BakedMesh::new(rayline::shape::BakedParts {
    triangles: &[[0, 12, 14], [11, 13, 12], [5, 14, 13], [12, 13, 14], [0, 14, 16], [5, 15, 14], [1, 16, 15], [14, 15, 16], [0, 16, 18], [1, 17, 16], [7, 18, 17], [16, 17, 18], [0, 18, 20], [7, 19, 18], [10, 20, 19], [18, 19, 20], [0, 20, 12], [10, 21, 20], [11, 12, 21], [20, 21, 12], [1, 15, 23], [5, 22, 15], [9, 23, 22], [15, 22, 23], [5, 13, 25], [11, 24, 13], [4, 25, 24], [13, 24, 25], [11, 21, 27], [10, 26, 21], [2, 27, 26], [21, 26, 27], [10, 19, 29], [7, 28, 19], [6, 29, 28], [19, 28, 29], [7, 17, 31], [1, 30, 17], [8, 31, 30], [17, 30, 31], [3, 32, 34], [9, 33, 32], [4, 34, 33], [32, 33, 34], [3, 34, 36], [4, 35, 34], [2, 36, 35], [34, 35, 36], [3, 36, 38], [2, 37, 36], [6, 38, 37], [36, 37, 38], [3, 38, 40], [6, 39, 38], [8, 40, 39], [38, 39, 40], [3, 40, 32], [8, 41, 40], [9, 32, 41], [40, 41, 32], [4, 33, 25], [9, 22, 33], [5, 25, 22], [33, 22, 25], [2, 35, 27], [4, 24, 35], [11, 27, 24], [35, 24, 27], [6, 37, 29], [2, 26, 37], [10, 29, 26], [37, 26, 29], [8, 39, 31], [6, 28, 39], [7, 31, 28], [39, 28, 31], [9, 41, 23], [8, 30, 41], [1, 23, 30], [41, 30, 23]],
    uvs: &[],
    colors: &[],
    vertices: &[v(0xbf069446, 0x3fece3bd, 0x0), v(0x3f069446, 0x3fece3bd, 0x0), v(0xbf069446, 0x3e18e218, 0x0), v(0x3f069446, 0x3e18e218, 0x0), v(0x0, 0x3ef2d774, 0x3f59c77a), v(0x0, 0x3fc34a23, 0x3f59c77a), v(0x0, 0x3ef2d774, 0xbf59c77a), v(0x0, 0x3fc34a23, 0xbf59c77a), v(0x3f59c77a, 0x3f800000, 0xbf069446), v(0x3f59c77a, 0x3f800000, 0x3f069446), v(0xbf59c77a, 0x3f800000, 0xbf069446), v(0xbf59c77a, 0x3f800000, 0x3f069446), v(0xbf4f1aa0, 0x3fc00000, 0x3e9e353f), v(0xbf000000, 0x3fa78d50, 0x3f4f1aa0), v(0xbe9e353f, 0x3fe78d50, 0x3f000000), v(0x3e9e353f, 0x3fe78d50, 0x3f000000), v(0x0, 0x40000000, 0x0), v(0x3e9e353f, 0x3fe78d50, 0xbf000000), v(0xbe9e353f, 0x3fe78d50, 0xbf000000), v(0xbf000000, 0x3fa78d50, 0xbf4f1aa0), v(0xbf4f1aa0, 0x3fc00000, 0xbe9e353f), v(0xbf800000, 0x3f800000, 0x0), v(0x3f000000, 0x3fa78d50, 0x3f4f1aa0), v(0x3f4f1aa0, 0x3fc00000, 0x3e9e353f), v(0xbf000000, 0x3f30e560, 0x3f4f1aa0), v(0x0, 0x3f800000, 0x3f800000), v(0xbf4f1aa0, 0x3f000000, 0xbe9e353f), v(0xbf4f1aa0, 0x3f000000, 0x3e9e353f), v(0x0, 0x3f800000, 0xbf800000), v(0xbf000000, 0x3f30e560, 0xbf4f1aa0), v(0x3f4f1aa0, 0x3fc00000, 0xbe9e353f), v(0x3f000000, 0x3fa78d50, 0xbf4f1aa0), v(0x3f4f1aa0, 0x3f000000, 0x3e9e353f), v(0x3f000000, 0x3f30e560, 0x3f4f1aa0), v(0x3e9e353f, 0x3e439580, 0x3f000000), v(0xbe9e353f, 0x3e439580, 0x3f000000), v(0x0, 0x0, 0x0), v(0xbe9e353f, 0x3e439580, 0xbf000000), v(0x3e9e353f, 0x3e439580, 0xbf000000), v(0x3f000000, 0x3f30e560, 0xbf4f1aa0), v(0x3f4f1aa0, 0x3f000000, 0xbe9e353f), v(0x3f800000, 0x3f800000, 0x0)],
    normals: &[rayline::shape::SmallNormal([-17225, 27874, 0]), rayline::shape::SmallNormal([17225, 27874, 0]), rayline::shape::SmallNormal([-17225, -27874, 0]), rayline::shape::SmallNormal([17225, -27874, 0]), rayline::shape::SmallNormal([0, -17225, 27874]), rayline::shape::SmallNormal([0, 17225, 27874]), rayline::shape::SmallNormal([0, -17225, -27874]), rayline::shape::SmallNormal([0, 17225, -27874]), rayline::shape::SmallNormal([27874, 0, -17225]), rayline::shape::SmallNormal([27874, 0, 17225]), rayline::shape::SmallNormal([-27874, 0, -17225]), rayline::shape::SmallNormal([-27874, 0, 17225]), rayline::shape::SmallNormal([-26509, 16384, 10125]), rayline::shape::SmallNormal([-16384, 10125, 26509]), rayline::shape::SmallNormal([-10125, 26509, 16384]), rayline::shape::SmallNormal([10125, 26509, 16384]), rayline::shape::SmallNormal([0, 32767, 0]), rayline::shape::SmallNormal([10125, 26509, -16384]), rayline::shape::SmallNormal([-10125, 26509, -16384]), rayline::shape::SmallNormal([-16384, 10125, -26509]), rayline::shape::SmallNormal([-26509, 16384, -10125]), rayline::shape::SmallNormal([-32767, 0, 0]), rayline::shape::SmallNormal([16384, 10125, 26509]), rayline::shape::SmallNormal([26509, 16384, 10125]), rayline::shape::SmallNormal([-16384, -10125, 26509]), rayline::shape::SmallNormal([0, 0, 32767]), rayline::shape::SmallNormal([-26509, -16384, -10125]), rayline::shape::SmallNormal([-26509, -16384, 10125]), rayline::shape::SmallNormal([0, 0, -32767]), rayline::shape::SmallNormal([-16384, -10125, -26509]), rayline::shape::SmallNormal([26509, 16384, -10125]), rayline::shape::SmallNormal([16384, 10125, -26509]), rayline::shape::SmallNormal([26509, -16384, 10125]), rayline::shape::SmallNormal([16384, -10125, 26509]), rayline::shape::SmallNormal([10125, -26509, 16384]), rayline::shape::SmallNormal([-10125, -26509, 16384]), rayline::shape::SmallNormal([0, -32767, 0]), rayline::shape::SmallNormal([-10125, -26509, -16384]), rayline::shape::SmallNormal([10125, -26509, -16384]), rayline::shape::SmallNormal([16384, -10125, -26509]), rayline::shape::SmallNormal([26509, -16384, -10125]), rayline::shape::SmallNormal([32767, 0, 0])],
    order: &[71, 68, 50, 53, 55, 49, 48, 51, 69, 52, 46, 44, 47, 64, 30, 56, 40, 67, 65, 42, 45, 43, 29, 28, 31, 70, 66, 26, 34, 60, 73, 54, 41, 57, 58, 59, 17, 18, 19, 14, 32, 1, 25, 24, 27, 33, 35, 62, 63, 74, 75, 72, 38, 61, 22, 77, 76, 79, 15, 13, 10, 36, 39, 12, 37, 8, 11, 9, 0, 16, 20, 78, 4, 7, 6, 3, 2, 21, 5, 23],
    nodes: &[rayline::shape::BoxNode::new([[n(0xbf4f1bb7), n(0xbf8000fe), n(0xbf4f1d26), n(0xbf8000a8)], [n(0xb766ec4b), n(0x3f30e384), n(0x3fa78c10), n(0x3ef2d4d4)], [n(0xbf59c898), n(0xbf800100), n(0xbf59c9f9), n(0xbf8000a8)]], [[n(0x3f4f1bb7), n(0x3f8000fe), n(0x3f4f1d26), n(0x3f8000a8)], [n(0x3f30e67e), n(0x3fc34b23), n(0x400000a8), n(0x3f8000a8)], [n(0x3f59c898), n(0x3f800100), n(0x3f59c9f9), n(0x3f8000a8)]], [(None, 12), (None, 9), (None, 4), (None, 1)]), rayline::shape::BoxNode::new([[n(0xbf8000a8), n(0xb7a7c5e3), n(0xbf000150), n(0x3efffd60)], [n(0x3efffd60), n(0x3ef2d4d4), n(0x3ef2d4d4), n(0x3efffd60)], [n(0xbf4f1bf0), n(0xbf8000a8), n(0xbf8000a8), n(0xbf4f1bf0)]], [[n(0xbefffd60), n(0x3f000150), n(0x37a7c5e3), n(0x3f8000a8)], [n(0x3f8000a8), n(0x3f8000a8), n(0x3f8000a8), n(0x3f8000a8)], [n(0x3f4f1bf0), n(0x3f8000a8), n(0x3f8000a8), n(0x3f4f1bf0)]], [(None, 3), (Some(2), 29), (Some(2), 27), (None, 2)]), rayline::shape::BoxNode::new([[n(0x3efffd60), n(0x3f4f1950), n(0x3efffd60), n(0x3f4f1950)], [n(0x3efffd60), n(0x3efffd60), n(0x3efffd60), n(0x3efffd60)], [n(0xbf4f1bf0), n(0xbf069596), n(0x3e9e329f), n(0xbe9e37df)]], [[n(0x3f59c8ca), n(0x3f8000a8), n(0x3f59c8ca), n(0x3f8000a8)], [n(0x3f8000a8), n(0x3f8000a8), n(0x3f8000a8), n(0x3f8000a8)], [n(0xbe9e329f), n(0x37a7c5e3), n(0x3f4f1bf0), n(0x3f069596)]], [(Some(1), 31), (Some(1), 33), (Some(1), 32), (Some(2), 34)]), rayline::shape::BoxNode::new([[n(0xbf8000a8), n(0xbf59c8ca), n(0xbf59c8ca), n(0xbf8000a8)], [n(0x3efffd60), n(0x3efffd60), n(0x3efffd60), n(0x3efffd60)], [n(0xbf069596), n(0xbf4f1bf0), n(0x3e9e329f), n(0xbe9e37df)]], [[n(0xbf4f1950), n(0xbefffd60), n(0xbefffd60), n(0xbf4f1950)], [n(0x3f8000a8), n(0x3f8000a8), n(0x3f8000a8), n(0x3f8000a8)], [n(0x37a7c5e3), n(0xbe9e329f), n(0x3f4f1bf0), n(0x3f069596)]], [(Some(1), 22), (Some(1), 25), (Some(1), 26), (Some(2), 23)]), rayline::shape::BoxNode::new([[n(0xbf4f1cff), n(0xbf4f1d26), n(0xbf4f1cff), n(0xbf4f1d26)], [n(0x3fa78c20), n(0x3fbffebd), n(0x3fa78c20), n(0x3fbffebd)], [n(0xbf59c9d9), n(0xbe9e3a4b), n(0x3e9e3081), n(0xbf0002a0)]], [[n(0x3f4f1cff), n(0x3f4f1d26), n(0x3f4f1cff), n(0x3f4f1d26)], [n(0x3fe78e80), n(0x400000a8), n(0x3fe78e80), n(0x400000a8)], [n(0xbe9e3081), n(0x3f0002a0), n(0x3f59c9d9), n(0x3827c5e3)]], [(None, 8), (None, 7), (None, 6), (None, 5)]), rayline::shape::BoxNode::new([[n(0xbf4f1d0c), n(0xbf0696e6), n(0x3e9e3065), n(0xbe9e3a7d)], [n(0x3fbffeca), n(0x3fe78c00), n(0x3fbffeca), n(0x3fe78c00)], [n(0xbf00026c), n(0xbf0002a0), n(0xbf00026c), n(0xbf0002a0)]], [[n(0xbe9e3065), n(0x3827c5e3), n(0x3f4f1d0c), n(0x3f0696e6)], [n(0x3fece4f3), n(0x400000a8), n(0x3fece4f3), n(0x400000a8)], [n(0x381b3fae), n(0x3827c5e3), n(0x381b3fae), n(0x3827c5e3)]], [(Some(1), 63), (Some(1), 65), (Some(1), 64), (Some(2), 66)]), rayline::shape::BoxNode::new([[n(0xbf4f1cff), n(0xbe9e39fd), n(0x3e9e3081), n(0xbf00025f)], [n(0x3fa78c20), n(0x3fa78c20), n(0x3fa78c20), n(0x3fa78c20)], [n(0x3e9e3081), n(0x3efffb42), n(0x3e9e3081), n(0x3efffb42)]], [[n(0xbe9e3081), n(0x3f00025f), n(0x3f4f1cff), n(0x3817c02c)], [n(0x3fe78e80), n(0x3fe78e80), n(0x3fe78e80), n(0x3fe78e80)], [n(0x3f4f1cff), n(0x3f59c9d9), n(0x3f4f1cff), n(0x3f59c9d9)]], [(Some(1), 75), (Some(2), 77), (Some(1), 79), (Some(1), 76)]), rayline::shape::BoxNode::new([[n(0xbf4f1d0c), n(0xbf0696e6), n(0x3e9e3065), n(0xbe9e3a7d)], [n(0x3fbffeca), n(0x3fe78c00), n(0x3fbffeca), n(0x3fe78c00)], [n(0xbe9e3a19), n(0xb827c5e3), n(0xbe9e3a19), n(0xb827c5e3)]], [[n(0xbe9e3065), n(0x3827c5e3), n(0x3f4f1d0c), n(0x3f0696e6)], [n(0x3fece4f3), n(0x400000a8), n(0x3fece4f3), n(0x400000a8)], [n(0x3f00026c), n(0x3f0002a0), n(0x3f00026c), n(0x3f0002a0)]], [(Some(2), 68), (Some(1), 72), (Some(2), 70), (Some(2), 73)]), rayline::shape::BoxNode::new([[n(0xbf4f1cff), n(0xbe9e39fd), n(0x3e9e3081), n(0xbf00025f)], [n(0x3fa78c20), n(0x3fa78c20), n(0x3fa78c20), n(0x3fa78c20)], [n(0xbf4f1cff), n(0xbf59c9d9), n(0xbf4f1cff), n(0xbf59c9d9)]], [[n(0xbe9e3081), n(0x3f00025f), n(0x3f4f1cff), n(0x3817c02c)], [n(0x3fe78e80), n(0x3fe78e80), n(0x3fe78e80), n(0x3fe78e80)], [n(0xbe9e3081), n(0xbefffb42), n(0xbe9e3081), n(0xbefffb42)]], [(Some(1), 58), (Some(2), 60), (Some(1), 62), (Some(1), 59)]), rayline::shape::BoxNode::new([[n(0xbf8000fc), n(0xb7fff8a4), n(0xbf000200), n(0x3efffc12)], [n(0x3f30e388), n(0x3f30e384), n(0x3f30e384), n(0x3f30e388)], [n(0xbf4f1c98), n(0xbf800100), n(0xbf800100), n(0xbf4f1c98)]], [[n(0xbefffc12), n(0x3f000200), n(0x37fff8a4), n(0x3f8000fc)], [n(0x3fc000fc), n(0x3fc34b23), n(0x3fc34b23), n(0x3fc000fc)], [n(0x3f4f1c98), n(0x3f800100), n(0x3f800100), n(0x3f4f1c98)]], [(None, 11), (Some(4), 47), (Some(4), 43), (None, 10)]), rayline::shape::BoxNode::new([[n(0x3efffc12), n(0x3f4f18a8), n(0x3efffc12), n(0x3f4f18a8)], [n(0x3f30e388), n(0x3f7ffe08), n(0x3f30e388), n(0x3f7ffe08)], [n(0xbf4f1c98), n(0xbf06963e), n(0x3e9e3151), n(0xbe9e392d)]], [[n(0x3f59c972), n(0x3f8000fc), n(0x3f59c972), n(0x3f8000fc)], [n(0x3fc000fc), n(0x3fc000fc), n(0x3fc000fc), n(0x3fc000fc)], [n(0xbe9e3151), n(0x37fba8d4), n(0x3f4f1c98), n(0x3f06963e)]], [(Some(2), 51), (Some(1), 55), (Some(2), 53), (Some(2), 56)]), rayline::shape::BoxNode::new([[n(0xbf8000fc), n(0xbf59c972), n(0xbf59c972), n(0xbf8000fc)], [n(0x3f7ffe08), n(0x3f30e388), n(0x3f30e388), n(0x3f7ffe08)], [n(0xbf06963e), n(0xbf4f1c98), n(0x3e9e3151), n(0xbe9e392d)]], [[n(0xbf4f18a8), n(0xbefffc12), n(0xbefffc12), n(0xbf4f18a8)], [n(0x3fc000fc), n(0x3fc000fc), n(0x3fc000fc), n(0x3fc000fc)], [n(0x37fba8d4), n(0xbe9e3151), n(0x3f4f1c98), n(0x3f06963e)]], [(Some(1), 36), (Some(2), 39), (Some(2), 41), (Some(2), 37)]), rayline::shape::BoxNode::new([[n(0xbf4f1bb7), n(0xbf4f1bb0), n(0xbf4f1bb7), n(0xbf4f1bb0)], [n(0x3e43910a), n(0xb75fed46), n(0x3e43910a), n(0xb75fed46)], [n(0xbf59c898), n(0xbe9e375d), n(0x3e9e3313), n(0xbf000110)]], [[n(0x3f4f1bb7), n(0x3f4f1bb0), n(0x3f4f1bb7), n(0x3f4f1bb0)], [n(0x3f30e67e), n(0x3f000110), n(0x3f30e67e), n(0x3f000110)], [n(0xbe9e3313), n(0x3f000110), n(0x3f59c898), n(0x3787ba76)]], [(None, 16), (None, 15), (None, 14), (None, 13)]), rayline::shape::BoxNode::new([[n(0xbf0694f6), n(0xbf4f1bb0), n(0x3e9e3321), n(0xbe9e3697)], [n(0xb7306582), n(0x3e18ddda), n(0x3e18ddda), n(0xb7306582)], [n(0xbf0000b0), n(0xbf000110), n(0xbf000110), n(0xbf0000b0)]], [[n(0x37306582), n(0xbe9e3321), n(0x3f4f1bb0), n(0x3f0694f6)], [n(0x3e439842), n(0x3f000110), n(0x3f000110), n(0x3e439842)], [n(0x37306582), n(0x3787ba76), n(0x3787ba76), n(0x37306582)]], [(Some(1), 5), (Some(1), 8), (Some(1), 9), (Some(2), 6)]), rayline::shape::BoxNode::new([[n(0xbf4f1bb0), n(0xbe9e3779), n(0x3e9e3321), n(0xbf00011e)], [n(0x3e439142), n(0x3e43910a), n(0x3e439142), n(0x3e43910a)], [n(0x3e9e3321), n(0x3efffdc6), n(0x3e9e3321), n(0x3efffdc6)]], [[n(0xbe9e3321), n(0x3f00011e), n(0x3f4f1bb0), n(0x378eb978)], [n(0x3f30e670), n(0x3f30e67e), n(0x3f30e670), n(0x3f30e67e)], [n(0x3f4f1bb0), n(0x3f59c898), n(0x3f4f1bb0), n(0x3f59c898)]], [(Some(1), 17), (Some(2), 19), (Some(1), 21), (Some(1), 18)]), rayline::shape::BoxNode::new([[n(0xbf0694f6), n(0xbf4f1bb0), n(0x3e9e3321), n(0xbe9e3697)], [n(0xb7306582), n(0x3e18ddda), n(0x3e18ddda), n(0xb7306582)], [n(0xb7306582), n(0xbe9e375d), n(0xbe9e375d), n(0xb7306582)]], [[n(0x37306582), n(0xbe9e3321), n(0x3f4f1bb0), n(0x3f0694f6)], [n(0x3e439842), n(0x3f000110), n(0x3f000110), n(0x3e439842)], [n(0x3f0000b0), n(0x3f000110), n(0x3f000110), n(0x3f0000b0)]], [(Some(1), 10), (Some(2), 13), (Some(2), 15), (Some(2), 11)]), rayline::shape::BoxNode::new([[n(0xbf4f1bb0), n(0xbe9e3779), n(0x3e9e3321), n(0xbf00011e)], [n(0x3e439142), n(0x3e43910a), n(0x3e439142), n(0x3e43910a)], [n(0xbf4f1bb0), n(0xbf59c898), n(0xbf4f1bb0), n(0xbf59c898)]], [[n(0xbe9e3321), n(0x3f00011e), n(0x3f4f1bb0), n(0x378eb978)], [n(0x3f30e670), n(0x3f30e67e), n(0x3f30e670), n(0x3f30e67e)], [n(0xbe9e3321), n(0xbefffdc6), n(0xbe9e3321), n(0xbefffdc6)]], [(Some(1), 0), (Some(2), 2), (Some(1), 4), (Some(1), 1)])],
    bounds: [v(0xbf8000a8, 0xb7a7c5ac, 0xbf8000a8), v(0x3f8000a8, 0x40000054, 0x3f8000a8)],
    lift: n(0x0),
    scale: 1.0,
    extent: 2.0,
});

const fn mesh(object: usize) -> &'static rayline::shape::BakedMesh<f32> {
    match object {
        1 => &MESH_1,
        _ => panic!("the object is no mesh"),
    }
}

const fn narrowed(object: usize) -> Shapes {
    match DESCRIPTION.objects[object].shape {
        rayline::shape::Shape::Mesh(_) => Shapes::Mesh(mesh(object)),
        rayline::shape::Shape::Plane(shape) => Shapes::Plane(shape),
        #[allow(unreachable_patterns)]
        _ => panic!("the scene has no such shape"),
    }
}

static OBJECTS: [rayline::Object<Shapes>; 2] = {
    let all = DESCRIPTION.objects;
    let mut objects = [rayline::Object::new(narrowed(0), all[0].material.0); 2];
    let mut i = 1;
    while i < 2 {
        objects[i] = rayline::Object::new(narrowed(i), all[i].material.0);
        i += 1;
    }
    objects
};

/// The scene, in flash.
pub static SCENE: rayline::Scene<'static, Shapes> = rayline::Scene {
    camera: DESCRIPTION.camera,
    background: DESCRIPTION.background,
    objects: &OBJECTS,
    materials: DESCRIPTION.materials,
    lights: DESCRIPTION.lights,
    motions: DESCRIPTION.motions,
};

/// The set of shapes, with its lifetime.
pub type Set = Shapes;

/// The bytes of memory that the prepared scene takes in the number system `R`.
pub const fn prepared_bytes<R: rayline::Real>() -> usize {
    rayline::prepared_bytes!(R, SCENE)
}
