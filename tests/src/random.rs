//! Strategies for random parts of scenes.

use proptest::prelude::*;
use rayline::shape::{
    Blob, Cone, ConvexPolyhedron, Csg, CsgStep, Cuboid, Cylinder, Disc, Ellipsoid, Instances, Mesh,
    Metaballs, Model, Plane, Polygon, Pose, Quadric, Rectangle, Shape, Solid, Sphere, Torus, Triangle,
};
use rayline::{
    Background, Brick, Encoding, Ends, Falloff, Figure, Filter, Fresnel, Gradient, Highlight, Image, Lamp,
    Light, LightCone, LinearRgb, Map, Marble, Medium, Noise, Onto, Optics, Panorama, Pixels, Placed,
    Placement, Sides, Sky, Space, Squares, Stripes, Texture, Vec3, Wood,
};

/// Coordinates and lengths: mostly small, a few of any legal size, and typical special values.
pub fn numbers() -> BoxedStrategy<f32> {
    prop_oneof![
        20 => -10.0f32..10.0,
        2 => -1e6f32..1e6,
        2 => prop_oneof![Just(0.0f32), Just(1.0), Just(-1.0), Just(1e6), Just(-1e6), Just(1e-20), Just(1e-6)],
    ]
    .boxed()
}

/// Points and directions with these coordinates.
pub fn vectors(number: &BoxedStrategy<f32>) -> BoxedStrategy<Vec3> {
    [number.clone(), number.clone(), number.clone()].prop_map(|[x, y, z]| Vec3::new(x, y, z)).boxed()
}

/// Shapes of all kinds with these coordinates and lengths; not all are legal.
pub fn shapes(number: &BoxedStrategy<f32>) -> BoxedStrategy<Shape<'static>> {
    let vector = vectors(number);
    prop_oneof![
        (vector.clone(), number.clone())
            .prop_map(|(center, radius)| Shape::Sphere(Sphere::new(center, radius))),
        (vector.clone(), vector.clone()).prop_map(|(point, normal)| Shape::Plane(Plane::new(point, normal))),
        (vector.clone(), vector.clone(), number.clone(), number.clone())
            .prop_map(|(center, normal, hole, radius)| Shape::Disc(Disc { center, normal, radius, hole })),
        (vector.clone(), vector.clone(), number.clone())
            .prop_map(|(center, normal, radius)| Shape::Disc(Disc::new(center, normal, radius))),
        (vector.clone(), vector.clone(), vector.clone())
            .prop_map(|(corner, right, up)| Shape::Rectangle(Rectangle::new(corner, right, up))),
        (
            [vector.clone(), vector.clone(), vector.clone()],
            proptest::option::of([vector.clone(), vector.clone(), vector.clone()])
        )
            .prop_map(|(vertices, normals)| Shape::Triangle(Triangle { vertices, normals })),
        (vector.clone(), vector.clone(), vector.clone()).prop_map(|(corner, right, up)| {
            Shape::Polygon(Polygon::new(
                vec![corner, corner + right, corner + right + up, corner + up].leak(),
            ))
        }),
        (vector.clone(), vector.clone(), number.clone(), number.clone(), any::<bool>()).prop_map(
            |(base, top, base_radius, top_radius, capped)| {
                Shape::Cone(Cone { base, base_radius, top, top_radius, capped })
            }
        ),
        (vector.clone(), vector.clone(), number.clone(), any::<bool>())
            .prop_map(|(base, top, radius, capped)| Shape::Cylinder(Cylinder { base, top, radius, capped })),
        (vector.clone(), [vector.clone(), vector.clone(), vector.clone()])
            .prop_map(|(center, axes)| Shape::Ellipsoid(Ellipsoid { center, axes })),
        (vector.clone(), vector.clone(), number.clone(), number.clone()).prop_map(
            |(center, axis, major_radius, minor_radius)| {
                Shape::Torus(Torus { center, axis, major_radius, minor_radius })
            }
        ),
        (
            vector.clone(),
            [vector.clone(), vector.clone(), vector.clone()],
            number.clone(),
            vector.clone(),
            any::<bool>()
        )
            .prop_map(|(center, [squares, mixed, linear], constant, corner, capped)| {
                let [a, b, c] = [squares, mixed, linear].map(|v| [v.x, v.y, v.z]);
                let mut coefficients = [constant; 10];
                coefficients
                    .iter_mut()
                    .zip(a.into_iter().chain(b).chain(c))
                    .for_each(|(to, from)| *to = from);
                let max = Vec3::new(corner.x.abs(), corner.y.abs(), corner.z.abs());
                Shape::Quadric(Quadric { center, coefficients, min: -max, max, capped })
            }),
        (vector.clone(), vector.clone()).prop_map(|(one, other)| Shape::Cuboid(Cuboid::aligned(one, other))),
        (vector.clone(), vector.clone(), vector.clone(), number.clone()).prop_map(
            |(center, along, aside, length)| Shape::Cuboid(turned_box(center, along, aside, length))
        ),
        (vector.clone(), vector.clone(), proptest::collection::vec(vector.clone(), 0..6))
            .prop_map(|(center, half, cuts)| Shape::ConvexPolyhedron(cut_box(center, half, &cuts))),
        meshes(vector.clone(), 3..30).prop_map(Shape::Mesh),
        solids_put_together(number),
        metaballs(vector.clone(), number.clone()).prop_map(Shape::Metaballs),
        instances(vector, number.clone()).prop_map(Shape::Instances),
    ]
    .boxed()
}

/// A box with one axis along `along`, and another of this length as close as possible to `aside`.
pub fn turned_box(center: Vec3, along: Vec3, aside: Vec3, length: f32) -> Cuboid {
    let across = along.cross(aside);
    let last = across.cross(along);
    let scaled = |v: Vec3| v * (length / v.length());
    Cuboid::oriented(center, [along, scaled(across), scaled(last)])
}

/// A box that is cut by planes through these points, given relative to its center, with normals away from it.
pub fn cut_box(center: Vec3, half: Vec3, cuts: &[Vec3]) -> ConvexPolyhedron<'static> {
    let ways = [Vec3::new(half.x, 0.0, 0.0), Vec3::new(0.0, half.y, 0.0), Vec3::new(0.0, 0.0, half.z)];
    let faces = ways.into_iter().flat_map(|way| [-way, way]).chain(cuts.iter().copied());
    let planes: Vec<_> = faces.map(|way| Plane::new(center + way, way)).collect();
    ConvexPolyhedron::new(planes.leak())
}

/// Meshes with these vertices and numbers of triangles, with and without normals and texture coordinates.
/// Some triangles have no area.
pub fn meshes(
    vector: BoxedStrategy<Vec3>,
    triangles: std::ops::Range<usize>,
) -> BoxedStrategy<Mesh<'static>> {
    let corner = || 0..8u16;
    (
        proptest::collection::vec(
            ((vector.clone(), vector), ([-2.0f32..2.0, -2.0f32..2.0], any::<[u8; 3]>())),
            8,
        ),
        proptest::collection::vec([corner(), corner(), corner()], triangles),
        [any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>()],
    )
        .prop_map(|(vertices, triangles, [is_smooth, has_uvs, has_colors, is_lifted])| {
            let ((vertices, normals), (uvs, colors)): ((Vec<_>, Vec<_>), (Vec<_>, Vec<_>)) =
                vertices.into_iter().unzip();
            let (normals, uvs, colors): (&[_], &[_], &[_]) = (normals.leak(), uvs.leak(), colors.leak());
            Mesh {
                vertices: vertices.leak(),
                triangles: triangles.leak(),
                normals: is_smooth.then_some(normals),
                uvs: has_uvs.then_some(uvs),
                colors: has_colors.then_some(colors),
                smooth_terminator: is_smooth && is_lifted,
            }
        })
        .boxed()
}

/// Metaballs with these centers and radii; some blobs have a negative strength.
pub fn metaballs(
    vector: BoxedStrategy<Vec3>,
    radius: BoxedStrategy<f32>,
) -> BoxedStrategy<Metaballs<'static>> {
    let strength = prop_oneof![3 => Just(1.0f32), 1 => radius.clone()];
    let blob =
        (vector, radius, strength).prop_map(|(center, radius, strength)| Blob { center, radius, strength });
    proptest::collection::vec(blob, 1..6).prop_map(|blobs| Metaballs::new(blobs.leak())).boxed()
}

/// Up to six instances of models with these coordinates, sizes, positions and angles.
pub fn instances(
    vector: BoxedStrategy<Vec3>,
    number: BoxedStrategy<f32>,
) -> BoxedStrategy<Instances<'static>> {
    let model = prop_oneof![
        meshes(vector.clone(), 1..30).prop_map(Model::Mesh),
        metaballs(vector.clone(), number.clone()).prop_map(Model::Metaballs),
        (vector.clone(), vector.clone()).prop_map(|(center, half)| Model::ConvexPolyhedron(cut_box(
            center,
            half,
            &[]
        ))),
        (vector.clone(), number.clone()).prop_map(|(center, radius)| {
            let ball = CsgStep::Solid(Solid::Sphere(Sphere::new(center, radius)));
            Model::Csg(Csg::new(Box::leak(Box::new([ball]))))
        }),
    ];
    let pose = (vector.clone(), vector).prop_map(|(rotation, origin)| Pose { rotation, origin });
    (model, number, proptest::collection::vec(pose, 1..7))
        .prop_map(|(model, size, poses)| Instances::new(Box::leak(Box::new(model)), poses.leak()).sized(size))
        .boxed()
}

/// A CSG of two or three solids with these coordinates and lengths, with any operators.
fn solids_put_together(number: &BoxedStrategy<f32>) -> BoxedStrategy<Shape<'static>> {
    let vector = vectors(number);
    let solid = prop_oneof![
        (vector.clone(), number.clone())
            .prop_map(|(center, radius)| Solid::Sphere(Sphere::new(center, radius))),
        (vector.clone(), vector.clone()).prop_map(|(point, normal)| Solid::Plane(Plane::new(point, normal))),
        (vector.clone(), vector.clone()).prop_map(|(one, other)| Solid::Cuboid(Cuboid::aligned(one, other))),
        (vector.clone(), vector.clone(), proptest::collection::vec(vector.clone(), 0..3))
            .prop_map(|(center, half, cuts)| Solid::ConvexPolyhedron(cut_box(center, half, &cuts))),
        (vector.clone(), vector.clone(), number.clone()).prop_map(|(base, top, radius)| {
            Solid::Cylinder(Cylinder { base, top, radius, capped: true })
        }),
        (vector.clone(), [vector.clone(), vector.clone(), vector.clone()])
            .prop_map(|(center, axes)| Solid::Ellipsoid(Ellipsoid { center, axes })),
        (vector.clone(), vector.clone(), number.clone(), number.clone()).prop_map(
            |(center, axis, major_radius, minor_radius)| {
                Solid::Torus(Torus { center, axis, major_radius, minor_radius })
            }
        ),
    ]
    .prop_map(CsgStep::Solid)
    .boxed();
    let operator = prop_oneof![Just(CsgStep::Union), Just(CsgStep::Intersection), Just(CsgStep::Difference)];
    let steps = prop_oneof![
        (solid.clone(), solid.clone(), operator.clone()).prop_map(|(a, b, operator)| vec![a, b, operator]),
        ([solid.clone(), solid.clone(), solid], [operator.clone(), operator], any::<bool>()).prop_map(
            |([a, b, c], [first, second], in_order)| {
                if in_order { vec![a, b, first, c, second] } else { vec![a, b, c, first, second] }
            }
        ),
    ];
    steps.prop_map(|steps| Shape::Csg(Csg::new(steps.leak()))).boxed()
}

/// Optics of all kinds, or none. They are leaked, because materials borrow them.
pub fn optics(number: &BoxedStrategy<f32>) -> BoxedStrategy<Option<&'static Optics>> {
    let color =
        [number.clone(), number.clone(), number.clone()].prop_map(|[r, g, b]| LinearRgb::new(r, g, b));
    let fresnel = prop_oneof![Just(Fresnel::Constant), Just(Fresnel::Schlick), Just(Fresnel::Exact)];
    let highlight = prop_oneof![Just(Highlight::Phong), Just(Highlight::BlinnPhong)];
    // In f32, ratios of indices above about 8 make directions too long or too short.
    let outside = (0.7f32..1.6, color.clone()).prop_map(|(ior, absorption)| Medium { ior, absorption });
    let outside = proptest::option::of(outside);
    let colors = (color.clone(), color.clone(), color.clone(), color);
    let some = (fresnel, highlight, colors, falloffs(number), outside, any::<(bool, bool)>()).prop_map(
        |(fresnel, highlight, colors, falloff, outside, (is_one_sided, thin))| {
            let (reflection_color, transmission_color, absorption, emission) = colors;
            let outside = outside.unwrap_or(Medium::AIR);
            let optics = Optics {
                highlight,
                fresnel,
                reflection_color,
                transmission_color,
                absorption,
                emission,
                reflection_falloff: falloff,
                outside,
                sides: if is_one_sided { Sides::Front } else { Sides::Both },
                thin,
                ..Optics::PLAIN
            };
            Some(&*Box::leak(Box::new(optics)))
        },
    );
    prop_oneof![1 => Just(None), 1 => some].boxed()
}

/// Falloffs with these coefficients, or none.
fn falloffs(number: &BoxedStrategy<f32>) -> BoxedStrategy<Falloff> {
    let some = [number.clone(), number.clone(), number.clone()]
        .prop_map(|[constant, linear, quadratic]| Falloff { constant, linear, quadratic });
    prop_oneof![1 => Just(Falloff::NONE), 1 => some].boxed()
}

/// Lights of all kinds with these coordinates and colors; not all are legal.
pub fn lights(number: &BoxedStrategy<f32>, color: &BoxedStrategy<LinearRgb>) -> BoxedStrategy<Light> {
    let vector = vectors(number);
    prop_oneof![
        (vector.clone(), color.clone()).prop_map(|(position, color)| Light::Point { position, color }),
        (vector, color.clone()).prop_map(|(direction, color)| Light::Directional { direction, color }),
        lamps(number, color),
    ]
    .boxed()
}

/// Lamps with falloff, a cone or both, and ambient lights.
pub fn lamps(number: &BoxedStrategy<f32>, color: &BoxedStrategy<LinearRgb>) -> BoxedStrategy<Light> {
    let cone = (vectors(number), 0.0f32..1.5, 0.01f32..1.5).prop_map(|(direction, bright, more)| LightCone {
        direction,
        bright,
        dark: bright + more,
    });
    let lamp =
        (vectors(number), color.clone(), falloffs(&(0.01f32..2.0).boxed()), proptest::option::of(cone))
            .prop_map(|(position, color, falloff, cone)| {
                Light::Lamp(Lamp { position, color, falloff, cone })
            });
    prop_oneof![3 => lamp, 1 => color.clone().prop_map(|color| Light::Ambient { color: color * 0.1 })].boxed()
}

/// Backgrounds of all kinds with these numbers and colors; not all are legal.
pub fn backgrounds(
    number: &BoxedStrategy<f32>,
    color: &BoxedStrategy<LinearRgb>,
) -> BoxedStrategy<Background<'static>> {
    let sky = (vectors(number), color.clone(), color.clone(), color.clone())
        .prop_map(|(up, zenith, horizon, nadir)| Sky { up, zenith, horizon, nadir });
    let panorama = (images(), vectors(number)).prop_map(|(image, rotation)| Panorama { image, rotation });
    prop_oneof![
        color.clone().prop_map(Background::Solid),
        sky.prop_map(|sky| Background::Gradient(Box::leak(Box::new(sky)))),
        panorama.prop_map(|panorama| Background::Image(Box::leak(Box::new(panorama)))),
    ]
    .boxed()
}

/// Images of all kinds; not all are legal.
fn images() -> BoxedStrategy<Image<'static>> {
    let pixels = prop_oneof![
        proptest::collection::vec(any::<u16>(), 6).prop_map(|pixels| Pixels::Rgb565(pixels.leak())),
        proptest::collection::vec(any::<u8>(), 18).prop_map(|bytes| Pixels::Rgb888(bytes.leak())),
        proptest::collection::vec(0..4u8, 6).prop_map(|indices| Pixels::Palette8 {
            indices: indices.leak(),
            palette: &[[7; 3], [255; 3], [90, 0, 9]]
        }),
    ];
    (pixels, ends(), any::<bool>(), any::<bool>())
        .prop_map(|(pixels, ends, srgb, nearest)| Image {
            width: 3,
            height: 2,
            pixels,
            encoding: if srgb { Encoding::Srgb } else { Encoding::Linear },
            filter: if nearest { Filter::Nearest } else { Filter::Bilinear },
            ends,
        })
        .boxed()
}

fn ends() -> impl Strategy<Value = Ends> {
    let axis = || prop_oneof![Just(Ends::Repeat), Just(Ends::Mirror), Just(Ends::Extend)];
    (axis(), axis()).prop_map(|(across, up)| Ends::of_axes([across, up]))
}

/// Patterns and images with these numbers and colors; not all are legal.
pub fn textures(
    number: &BoxedStrategy<f32>,
    color: &BoxedStrategy<LinearRgb>,
) -> BoxedStrategy<Texture<'static>> {
    let octaves = || prop_oneof![9 => 1..=8u8, 1 => any::<u8>()];
    let two = (color.clone(), color.clone());
    let figure = prop_oneof![
        two.clone().prop_map(|(even, odd)| Figure::Squares(Squares { even, odd })),
        (two.clone(), number.clone()).prop_map(|((first, second), width)| Figure::Stripes(Stripes {
            first,
            second,
            width
        })),
        (two.clone(), ends()).prop_map(|((from, to), ends)| Figure::Gradient(Gradient { from, to, ends })),
        (two.clone(), octaves()).prop_map(|((low, high), octaves)| Figure::Noise(Noise {
            low,
            high,
            octaves
        })),
        (two.clone(), number.clone(), octaves()).prop_map(|((stone, vein), turbulence, octaves)| {
            Figure::Marble(Marble { stone, vein, turbulence, octaves })
        }),
        (two.clone(), number.clone(), octaves()).prop_map(|((early, late), turbulence, octaves)| {
            Figure::Wood(Wood { early, late, turbulence, octaves })
        }),
        (two, [number.clone(), number.clone()]).prop_map(|((brick, mortar), gap)| Figure::Brick(Brick {
            brick,
            mortar,
            gap
        })),
        images().prop_map(Figure::Image),
    ];
    let vector = vectors(number);
    let space = prop_oneof![Just(Space::Scene), Just(Space::Surface)];
    (figure, space, vector.clone(), vector.clone(), vector)
        .prop_map(|(figure, space, size, rotation, origin)| {
            let placed = Placed::new(figure, Placement { space, size, rotation, origin });
            Texture::Placed(Box::leak(Box::new(placed)))
        })
        .boxed()
}

/// Up to two maps with these numbers and colors; not all are legal.
pub fn maps(
    number: &BoxedStrategy<f32>,
    color: &BoxedStrategy<LinearRgb>,
) -> BoxedStrategy<&'static [Map<'static>]> {
    let onto = prop_oneof![
        Just(Onto::Ambient),
        Just(Onto::Diffuse),
        Just(Onto::Specular),
        Just(Onto::Reflectance),
        Just(Onto::Transmittance),
        Just(Onto::ReflectionColor),
        Just(Onto::TransmissionColor),
        Just(Onto::Emission),
        (number.clone(), number.clone()).prop_map(|(height, step)| Onto::Bump { height, step }),
        number.clone().prop_map(|strength| Onto::Normal { strength }),
    ];
    let map = (onto, textures(number, color)).prop_map(|(onto, texture)| Map { onto, texture });
    let some = proptest::collection::vec(map, 1..3).prop_map(|maps| -> &'static [_] { maps.leak() });
    prop_oneof![2 => Just(&[][..]), 1 => some].boxed()
}
