//! Makes a scene that shows a finding smaller, as long as it still shows one of that kind.

use std::time::Duration;

use bumpalo::Bump;
use cpu_time::ThreadTime;
use rayline::shape::{Csg, Instances, Mesh, Metaballs, Model, Shape};
use rayline::{Background, Camera, Light, LinearRgb, Material, Motion, Object, Scene};

use crate::case::{Case, Portions};
use crate::check::{Bench, Finding};

/// A scene whose lists can be changed.
#[derive(Clone, Debug)]
pub(crate) struct Parts<'a> {
    camera: Camera,
    background: Background<'a>,
    objects: Vec<Object<Shape<'a>>>,
    materials: Vec<Material<'a>>,
    lights: Vec<Light>,
    motions: Vec<Motion>,
}

impl<'a> Parts<'a> {
    fn of(scene: &Scene<'a>) -> Self {
        let Scene { camera, background, objects, materials, lights, motions } = *scene;
        Self {
            camera,
            background,
            objects: objects.to_vec(),
            materials: materials.to_vec(),
            lights: lights.to_vec(),
            motions: motions.to_vec(),
        }
    }

    pub(crate) fn as_scene(&self) -> Scene<'_> {
        Scene {
            camera: self.camera,
            background: self.background,
            objects: &self.objects,
            materials: &self.materials,
            lights: &self.lights,
            motions: &self.motions,
        }
    }
}

/// A finding, with the smallest scene that still shows it.
pub(crate) struct Smallest<'a> {
    pub(crate) parts: Parts<'a>,
    pub(crate) case: Case,
    pub(crate) finding: Finding,
    /// Attempts that may still be made.
    left: u32,
    /// When the first was made, by the thread's own time.
    start: ThreadTime,
}

impl<'a> Smallest<'a> {
    /// Tries to leave out and to simplify one thing after the other, until nothing more can go, 2,000
    /// attempts were made, or 20 s are over.
    pub(crate) fn of(
        scene: &Scene<'a>,
        case: &Case,
        finding: &Finding,
        bench: &mut Bench,
        arena: &'a Bump,
    ) -> Self {
        let mut smallest = Self {
            parts: Parts::of(scene),
            case: *case,
            finding: finding.clone(),
            left: 2000,
            start: ThreadTime::now(),
        };
        // Each attempt at what takes seconds takes seconds.
        if !matches!(finding, Finding::Slow(_)) {
            while smallest.round(bench, arena) {}
        }
        smallest
    }

    /// Tries everything once; tells whether anything became smaller.
    fn round(&mut self, bench: &mut Bench, arena: &'a Bump) -> bool {
        let before = self.left;
        let mut is_smaller = false;
        for object in (0..self.parts.objects.len()).rev() {
            is_smaller |= self.try_out(bench, |parts, _| _ = parts.objects.remove(object));
        }
        // Fewer than a hierarchy needs would show something else.
        for object in 1..self.parts.objects.len() {
            is_smaller |= self.try_out(bench, |parts, _| {
                if let (Some(first), Some(object)) =
                    (parts.objects.first().copied(), parts.objects.get_mut(object))
                {
                    *object = first;
                }
            });
        }
        for light in (0..self.parts.lights.len()).rev() {
            is_smaller |= self.try_out(bench, |parts, _| _ = parts.lights.remove(light));
        }
        for motion in (0..self.parts.motions.len()).rev() {
            is_smaller |= self.try_out(bench, |parts, _| _ = parts.motions.remove(motion));
        }
        is_smaller |= self.simplify_case(bench);
        for material in (0..self.parts.materials.len()).rev() {
            is_smaller |= self.try_without_material(bench, material);
            is_smaller |= self.try_simpler_material(bench, material);
        }
        is_smaller |= self.try_out(bench, |parts, _| parts.background = Background::gray(0.25));
        for object in 0..self.parts.objects.len() {
            is_smaller |= self.shrink_shape(bench, arena, object);
        }
        is_smaller && self.left > 0 && self.left < before
    }

    /// Keeps a change if it changes anything and the finding stays.
    fn try_out(&mut self, bench: &mut Bench, change: impl FnOnce(&mut Parts<'a>, &mut Case)) -> bool {
        let (mut parts, mut case) = (self.parts.clone(), self.case);
        change(&mut parts, &mut case);
        let is_same = case == self.case && parts.as_scene() == self.parts.as_scene();
        if is_same || self.left == 0 || self.start.elapsed() > Duration::from_secs(20) {
            return false;
        }
        self.left -= 1;
        match bench.check_caught(&parts.as_scene(), &case) {
            Err(finding) if finding.is_like(&self.finding) => {
                (self.parts, self.case, self.finding) = (parts, case, finding);
                true
            }
            _ => false,
        }
    }

    fn simplify_case(&mut self, bench: &mut Bench) -> bool {
        let mut is_smaller = self.try_out(bench, |_, case| case.realtime = None);
        is_smaller |= self.try_out(bench, |_, case| case.portions = Portions::All);
        is_smaller |= self.try_out(bench, |_, case| case.settings.sampling.samples = 1);
        for bounces in 0..self.case.settings.bounces {
            is_smaller |= self.try_out(bench, |_, case| case.settings.bounces = bounces);
        }
        is_smaller |= self.try_out(bench, |_, case| case.settings.cutoff = 0.0);
        is_smaller | self.try_out(bench, |_, case| case.settings.rays_per_pixel = 4096)
    }

    /// Leaves out a material that no object names.
    fn try_without_material(&mut self, bench: &mut Bench, material: usize) -> bool {
        let is_used = |object: &Object<_>| usize::from(object.material.0) == material;
        if self.parts.objects.iter().any(is_used) {
            return false;
        }
        self.try_out(bench, |parts, _| {
            parts.materials.remove(material);
            for object in &mut parts.objects {
                if usize::from(object.material.0) > material {
                    object.material.0 -= 1;
                }
            }
        })
    }

    fn try_simpler_material(&mut self, bench: &mut Bench, material: usize) -> bool {
        let matte = Material::matte(LinearRgb::gray(0.5));
        let changes: [fn(&mut Material<'a>, Material<'static>); 8] = [
            |material, matte| *material = matte,
            |material, _| material.maps = &[],
            |material, _| material.optics = None,
            |material, matte| material.color = matte.color,
            |material, _| material.specular = 0.0,
            |material, _| material.ambient = 0.0,
            |material, matte| (material.reflectance, material.diffuse) = (0.0, matte.diffuse),
            |material, matte| (material.transmittance, material.diffuse) = (0.0, matte.diffuse),
        ];
        let mut is_smaller = false;
        for change in changes {
            is_smaller |= self.try_out(bench, |parts, _| {
                if let Some(material) = parts.materials.get_mut(material) {
                    change(material, matte);
                }
            });
        }
        is_smaller
    }

    /// Leaves out parts of a shape that has lists: halves first, then one by one.
    fn shrink_shape(&mut self, bench: &mut Bench, arena: &'a Bump, object: usize) -> bool {
        let mut is_smaller = false;
        let mut size = usize::MAX;
        while size > 0 {
            let Some(Object { shape, .. }) = self.parts.objects.get(object).copied() else { break };
            let count = count(&shape);
            size = size.min(count / 2 + 1);
            if count <= 1 {
                break;
            }
            let mut from = 0;
            while from < count {
                let put = |parts: &mut Parts<'a>, shape: Option<Shape<'a>>| {
                    if let (Some(object), Some(shape)) = (parts.objects.get_mut(object), shape) {
                        object.shape = shape;
                    }
                };
                let Some(Object { shape, .. }) = self.parts.objects.get(object).copied() else { break };
                let smaller = without(&shape, from, size, arena);
                let went = self.try_out(bench, |parts, _| put(parts, smaller));
                is_smaller |= went;
                from += if went { 0 } else { size };
                if self.left == 0 || count <= 1 || from >= self::count(&shape) {
                    break;
                }
            }
            size /= 2;
        }
        is_smaller
    }
}

/// How many parts a shape has that may be left out.
fn count(shape: &Shape<'_>) -> usize {
    match shape {
        Shape::Mesh(mesh) => mesh.triangles.len(),
        Shape::Metaballs(balls) => balls.blobs.len(),
        Shape::Csg(csg) => csg.steps.len().div_ceil(2),
        Shape::Instances(instances) => instances.poses.len() + count(&Shape::from(*instances.model)),
        _ => 1,
    }
}

/// The shape without some of these parts, where that is a shape.
fn without<'a>(shape: &Shape<'a>, from: usize, size: usize, arena: &'a Bump) -> Option<Shape<'a>> {
    fn rest<'a, T: Copy>(list: &[T], from: usize, size: usize, arena: &'a Bump) -> Option<&'a [T]> {
        let kept = list.iter().enumerate().filter(|(i, _)| *i < from || *i >= from + size);
        let kept: Vec<T> = kept.map(|(_, part)| *part).collect();
        (!kept.is_empty()).then(|| &*arena.alloc_slice_copy(&kept))
    }
    Some(match *shape {
        Shape::Mesh(mesh) => {
            Shape::Mesh(Mesh { triangles: rest(mesh.triangles, from, size, arena)?, ..mesh })
        }
        Shape::Metaballs(balls) => Shape::Metaballs(Metaballs::new(rest(balls.blobs, from, size, arena)?)),
        // A solid and, but for the first, the operation behind it.
        Shape::Csg(csg) => {
            let first = if from == 0 { 0 } else { 2 * from - 1 };
            let steps = rest(csg.steps, first, if from == 0 { 2 * size - 1 } else { 2 * size }, arena)?;
            // Then an operation stands where its first solid did.
            let steps =
                if from == 0 { steps.get(..1).filter(|_| steps.len() <= 2).unwrap_or(steps) } else { steps };
            Shape::Csg(Csg::new(steps))
        }
        Shape::Instances(instances) => {
            let poses = instances.poses.len();
            if from < poses {
                let poses = rest(instances.poses, from, size, arena)?;
                Shape::Instances(Instances { poses, ..instances })
            } else {
                let model = match without(&Shape::from(*instances.model), from - poses, size, arena)? {
                    Shape::Mesh(mesh) => Model::Mesh(mesh),
                    Shape::Metaballs(balls) => Model::Metaballs(balls),
                    Shape::Csg(csg) => Model::Csg(csg),
                    _ => return None,
                };
                Shape::Instances(Instances { model: arena.alloc(model), ..instances })
            }
        }
        _ => return None,
    })
}
