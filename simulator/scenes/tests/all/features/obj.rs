//! A file for each row about OBJ and MTL.

use rayline::Texture;
use rayline_scenes::LoadedScene;

use super::table::{compare, material, mesh, near, open};

/// The corners of a square, and of a triangle beside it that is a quarter as large.
const SQUARE: &str = "mtllib a.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 2 -1 0\nv 2 0 0\n";
/// Its texture coordinates.
const MAPPED: &str = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3 4/4\n";

type Case<'c> = (&'c str, String, &'c str, fn(&LoadedScene<'_>) -> bool);

fn area(scene: &LoadedScene<'_>) -> f32 {
    let mesh = mesh(scene, 0);
    let of = |corners: &[u16; 3]| {
        let [a, b, c] = corners.map(|corner| mesh.vertices[usize::from(corner)]);
        (b - a).cross(c - a).length() / 2.0
    };
    mesh.triangles.iter().map(of).sum()
}

fn whole(_: &LoadedScene<'_>) -> bool {
    true
}

fn is_image(scene: &LoadedScene<'_>) -> bool {
    matches!(material(scene).color, Texture::Placed(_)) && mesh(scene, 0).uvs.is_some()
}

fn geometry() -> Vec<Case<'static>> {
    let square = |more: &str| format!("{SQUARE}{more}");
    vec![
        ("`v`, `f`, in any order", format!("f 1 2 3 4\n{SQUARE}"), "", |scene| area(scene) == 4.0),
        ("numbers from the end, as -1", square("f -6 -5 -4 -3\n"), "", |scene| area(scene) == 4.0),
        ("faces with notches", square("v 0 0.5 0\nf 1 2 3 7 4\n"), "", |scene| near(area(scene), 3.5)),
        ("`vn`", square("vn 0 0 1\nf 1//1 2//1 3//1\n"), "", |scene| mesh(scene, 0).normals.is_some()),
        ("`vt`", square(MAPPED), "newmtl a\nmap_Kd wood.png\n", is_image),
        (
            "`v` with a color",
            "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n".to_owned(),
            "",
            |scene| mesh(scene, 0).colors == Some(&[[255, 0, 0], [0, 255, 0], [0, 0, 255]]),
        ),
        ("`s`", square("s 1\nf 1 2 3 4\n"), "", |scene| mesh(scene, 0).normals.is_some()),
        (
            "`o`, `g`, `usemtl`",
            square("o a\nf 1 2 3\ng b\nf 1 3 4\nusemtl a\nf 2 5 6\n"),
            "newmtl a\n",
            |scene| scene.scene.objects.len() == 3,
        ),
        (
            "coordinates beyond ±1e6",
            "v 0 5e6 0\nv 2 5e6 0\nv 0 5000002 0\nf 1 2 3\n".to_owned(),
            "",
            |scene| area(scene) == 2.0,
        ),
        ("meshes in one plane", square("o a\nf 1 2 3 4\no b\nf 1 5 3\n"), "", |scene| {
            let depth = mesh(scene, 1).vertices.iter().fold(0.0f32, |most, vertex| most.max(vertex.z.abs()));
            depth > 1e-5 && depth < 1e-3
        }),
        ("lines that are not UTF-8", square("f 1 2 3 4\n"), "", whole),
        ("no camera, no lights", square("f 1 2 3 4\n"), "", |scene| scene.scene.lights.len() == 2),
        ("`p`, `l`, curves and surfaces", square("f 1 2 3 4\nl 1 5\n"), "", whole),
        ("odd lines", square("vt 0 x\nf 1 2 3 4\n"), "", whole),
        ("a material that is not there", square("usemtl b\nf 1 2 3 4\n"), "newmtl a\n", whole),
        ("an MTL file that is not there", square("mtllib b.mtl\nf 1 2 3 4\n"), "", whole),
        ("a corner whose vertex is not there", square("f 1 2 9\n"), "", whole),
        ("no faces", square(""), "", whole),
    ]
}

fn materials() -> Vec<Case<'static>> {
    let (plain, mapped) = (format!("{SQUARE}usemtl a\nf 1 2 3 4\n"), format!("{SQUARE}{MAPPED}"));
    vec![
        ("`Kd`, `Ks`, `Ns`", plain.clone(), "newmtl a\nKd 1 0.5 0\nKs 0.3 0.3 0.3\nNs 40\n", |scene| {
            let material = material(scene);
            near(material.specular, 0.3) && material.shininess == 40.0
        }),
        ("`Ke`", plain.clone(), "newmtl a\nKe 1 2 3\n", |scene| {
            material(scene).optics.is_some_and(|optics| optics.emission.channels() == [1.0, 2.0, 3.0])
        }),
        ("`d`, `Ni`", plain.clone(), "newmtl a\nd 0.25\nNi 1.3\n", |scene| {
            near(material(scene).transmittance, 0.75) && material(scene).ior == 1.3
        }),
        ("`illum`", plain.clone(), "newmtl a\nKs 0.4 0.4 0.4\nillum 3\n", |scene| {
            near(material(scene).reflectance, 0.4)
        }),
        (
            "`map_Kd` with `-s`, `-o`, `-clamp`",
            mapped.clone(),
            "newmtl a\nmap_Kd -s 2 2 -clamp on wood.png\n",
            is_image,
        ),
        ("`map_Ks`, `map_d`", mapped.clone(), "newmtl a\nKs 1 1 1\nNs 9\nmap_Ks wood.png\n", |scene| {
            !material(scene).maps.is_empty()
        }),
        ("`map_Bump`, `bump`, `norm`", mapped.clone(), "newmtl a\nnorm wood.png\n", |scene| {
            !material(scene).maps.is_empty()
        }),
        ("`Tr`", plain.clone(), "newmtl a\nTr 1\nillum 2\n", |scene| material(scene).transmittance == 0.0),
        ("`Ka`", plain.clone(), "newmtl a\nKa 1 1 1\n", |scene| near(material(scene).ambient, 0.1)),
        ("other maps", plain, "newmtl a\nrefl wood.png\n", whole),
        ("a picture that is not there", mapped, "newmtl a\nmap_Kd none.png\n", whole),
    ]
}

#[test]
fn obj_and_mtl() {
    let cases = geometry().into_iter().chain(materials());
    let seen = cases.map(|(feature, obj, mtl, holds)| {
        let mut bytes = obj.into_bytes();
        if feature == "lines that are not UTF-8" {
            bytes.extend(b"# \xe4\n");
        }
        (feature, open(&[("a.obj", &bytes), ("a.mtl", mtl.as_bytes())], holds))
    });
    compare("OBJ and MTL", 15, seen.collect());
}
