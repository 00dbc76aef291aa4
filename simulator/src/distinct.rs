//! Scenes without repeated objects. Files may have thousands of equal objects at one place, of which every
//! ray there tests all: a hierarchy cannot divide them.
//!
//! Of equal objects, the first is seen. The others change nothing as long as they are opaque, do not move,
//! and are no lights.

use core::fmt::{self, Write};
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use rayline::limits::MAX_COUNT;
use rayline::shape::{Mesh, Shape};
use rayline::{Light, Material, Object, Scene};

/// The objects of a scene without those that equal an earlier one; `None` if all of them are needed.
pub(crate) fn distinct<'a>(scene: &Scene<'a>) -> Option<Vec<Object<Shape<'a>>>> {
    /// The most objects that look alike at first and are compared: they may differ.
    const MOST_ALIKE: usize = 8;
    let Scene { objects, lights, motions, .. } = *scene;
    let is_light = |light: &Light| matches!(light, Light::Object(_));
    if objects.len() > MAX_COUNT || !motions.is_empty() || lights.iter().any(is_light) {
        return None;
    }
    let mut alike: HashMap<u64, Vec<&Object<Shape<'a>>>> = HashMap::new();
    let mut is_new = |object: &'a Object<Shape<'a>>| {
        if !scene.material_of(object).is_some_and(is_opaque) {
            return true;
        }
        let alike = alike.entry(look(object)).or_default();
        let is_new = !alike.contains(&object);
        if is_new && alike.len() < MOST_ALIKE {
            alike.push(object);
        }
        is_new
    };
    let kept: Vec<_> = objects.iter().filter(|object| is_new(object)).copied().collect();
    (kept.len() < objects.len()).then_some(kept)
}

fn is_opaque(material: &Material<'_>) -> bool {
    material.transmittance == 0.0 && material.maps.is_empty()
}

/// A number that equal objects share.
fn look(object: &Object<Shape<'_>>) -> u64 {
    struct Text(DefaultHasher);
    impl Write for Text {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            self.0.write(text.as_bytes());
            Ok(())
        }
    }
    let mut text = Text(DefaultHasher::new());
    object.material.0.hash(&mut text.0);
    // Hashing cannot fail.
    let _ = match &object.shape {
        // Meshes are long: their counts and two of their vertices distinguish most of them.
        Shape::Mesh(Mesh { vertices, triangles, .. }) => {
            write!(
                text,
                "{} {} {:?} {:?}",
                vertices.len(),
                triangles.len(),
                vertices.first(),
                vertices.last()
            )
        }
        Shape::Instances(instances) => write!(text, "{:?}", instances.poses),
        shape => write!(text, "{shape:?}"),
    };
    text.0.finish()
}

#[cfg(test)]
mod tests {
    use rayline::builtin::{CLASSIC, SPHERES};
    use rayline::shape::Sphere;
    use rayline::{LinearRgb, Vec3};

    use super::*;

    fn ball(x: f32, material: u16) -> Object<Shape<'static>> {
        Object::new(Shape::Sphere(Sphere::new(Vec3::new(x, 0.0, 0.0), 0.5)), material)
    }

    const MATTE: Material<'static> = Material::matte(LinearRgb::WHITE);

    #[test]
    fn only_equal_opaque_objects_are_left_out() {
        let clear = Material { transmittance: 0.5, ..MATTE };
        let materials = [MATTE, clear, MATTE];
        let objects = [
            ball(0.0, 0),
            ball(0.0, 1),
            ball(0.0, 0),
            ball(0.0, 1),
            ball(1.0, 0),
            ball(0.0, 2),
            ball(1.0, 0),
        ];
        let scene = Scene { objects: &objects, materials: &materials, ..SPHERES };
        let kept = distinct(&scene).unwrap();
        assert_eq!(kept, [objects[0], objects[1], objects[3], objects[4], objects[5]]);
        assert_eq!(distinct(&Scene { objects: &kept, ..scene }), None);
        let lights = [Light::Object(rayline::ObjectId(0))];
        assert_eq!(distinct(&Scene { lights: &lights, ..scene }), None);
        assert_eq!(distinct(&CLASSIC), None);
    }
}
