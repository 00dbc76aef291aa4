//! A scene that is built at run time, without allocation.

use core::fmt;

use heapless::Vec;

use super::{MaterialId, Object, Scene};
use crate::background::Background;
use crate::camera::Camera;
use crate::light::{Light, ObjectId};
use crate::material::Material;
use crate::motion::Motion;

/// A scene that is built at run time, in arrays of fixed capacity.
///
/// ```
/// use rayline::{Background, Camera, Light, LinearRgb, Material, SceneBuf, Vec3, shape::Sphere};
/// let camera = Camera {
///     eye: Vec3::new(0.0, 0.0, 5.0), target: Vec3::ZERO, up: Vec3::new(0.0, 1.0, 0.0), vertical_fov: 0.7,
///     lens: None,
/// };
/// let mut scene = SceneBuf::<Sphere, 8, 2, 1>::new(camera, Background::gray(0.1));
/// let red = scene.add_material(Material::matte(LinearRgb::new(0.9, 0.2, 0.1)))?;
/// scene.add_object(Sphere::new(Vec3::ZERO, 1.0), red)?;
/// scene.add_light(Light::Point { position: Vec3::new(3.0, 4.0, 5.0), color: LinearRgb::WHITE })?;
/// assert_eq!(scene.as_scene().objects.len(), 1);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Frame after frame
/// For each frame, change the moving objects in place, [prepare](crate::PreparedScene::new) the scene again,
/// which checks it, and draw it. Every frame is prepared in the same lent memory, and nothing is allocated.
/// The picture is the same as that of a newly filled scene. Where only the camera moves,
/// [`PreparedScene::set_camera`](crate::PreparedScene::set_camera) is enough, and the scene is not prepared
/// again.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8};
/// use rayline::shape::Sphere;
/// use rayline::{
///     Background, Camera, Light, LinearRgb, Material, PreparedScene, Renderer, SceneBuf, Settings, Vec3,
///     Workspace, prepared_bytes,
/// };
/// # let camera = Camera {
/// #     eye: Vec3::new(0.0, 1.0, 8.0), target: Vec3::new(0.0, 1.0, 0.0), up: Vec3::new(0.0, 1.0, 0.0),
/// #     vertical_fov: 0.7, lens: None,
/// # };
/// # let white = LinearRgb::WHITE;
/// let mut scene = SceneBuf::<Sphere, 2, 1, 1>::new(camera, Background::gray(0.1));
/// let gray = scene.add_material(Material::matte(LinearRgb::gray(0.8)))?;
/// scene.add_object(Sphere::new(Vec3::new(0.0, -100.0, 0.0), 100.0), gray)?;
/// scene.add_object(Sphere::new(Vec3::ZERO, 0.5), gray)?; // the ball
/// scene.add_light(Light::Point { position: Vec3::new(3.0, 4.0, 5.0), color: white })?;
///
/// let mut memory = Workspace::<{ prepared_bytes::<f32, Sphere>(2, 1, 1, 0) }>::new();
/// let mut line = [Gray8::new(0); 64];
/// for height in [0.5, 1.2, 1.6, 1.7] {
///     if let [_ground, ball] = scene.objects_mut() {
///         ball.shape.center.y = height;
///     }
///     let prepared = PreparedScene::<f32, _>::new(&scene.as_scene(), memory.lend())?;
///     let renderer = Renderer::new(&prepared, Settings::new(64, 48))?;
/// #   let mut display = MockDisplay::<Gray8>::new();
///     renderer.draw(&mut display, &mut line)?;
/// }
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SceneBuf<'a, S, const OBJECTS: usize, const MATERIALS: usize, const LIGHTS: usize> {
    /// The camera.
    pub camera: Camera,
    /// The color of rays that hit nothing.
    pub background: Background<'a>,
    /// The motions of objects and of the camera while the shutter is open: most often none.
    pub motions: &'a [Motion],
    objects: Vec<Object<S>, OBJECTS>,
    materials: Vec<Material<'a>, MATERIALS>,
    lights: Vec<Light, LIGHTS>,
}

/// There is no room for one more item in a [`SceneBuf`], which is unchanged.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Full<T> {
    /// The item.
    pub item: T,
    /// The parameter of [`SceneBuf`] to raise.
    pub parameter: &'static str,
}

impl<T> fmt::Display for Full<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the scene has no room for one more; raise `{}` of its `SceneBuf`", self.parameter)
    }
}

impl<T: fmt::Debug> core::error::Error for Full<T> {}

#[cfg(feature = "serde")]
crate::read::read_struct! {
    [S: crate::read::Read<'m>, const OBJECTS: usize, const MATERIALS: usize, const LIGHTS: usize]
    Scene as SceneBuf<'m, S, OBJECTS, MATERIALS, LIGHTS> {
        camera, background = Background::BLACK, objects, materials, lights = Vec::new(), motions = &[],
    }
}

impl<'a, S, const OBJECTS: usize, const MATERIALS: usize, const LIGHTS: usize>
    SceneBuf<'a, S, OBJECTS, MATERIALS, LIGHTS>
{
    pub(super) const NUMBERED_BY_U16: () = assert!(MATERIALS <= crate::limits::MAX_COUNT);

    /// An empty scene.
    pub const fn new(camera: Camera, background: Background<'a>) -> Self {
        let () = Self::NUMBERED_BY_U16;
        Self {
            camera,
            background,
            motions: &[],
            objects: Vec::new(),
            materials: Vec::new(),
            lights: Vec::new(),
        }
    }

    /// Adds a material and returns its id.
    ///
    /// # Errors
    /// There is no room: the material is handed back and the scene is unchanged. Raise `MATERIALS`.
    pub fn add_material(&mut self, material: Material<'a>) -> Result<MaterialId, Full<Material<'a>>> {
        let id = MaterialId(self.materials.len() as u16);
        let added = self.materials.push(material).map(|()| id);
        added.map_err(|item| Full { item, parameter: "MATERIALS" })
    }

    /// Adds an object and returns its id: its position in [`objects_mut`](Self::objects_mut).
    ///
    /// # Errors
    /// There is no room: the object is handed back and the scene is unchanged. Raise `OBJECTS`.
    pub fn add_object(&mut self, shape: S, material: MaterialId) -> Result<ObjectId, Full<Object<S>>> {
        let id = ObjectId(self.objects.len() as u16);
        let added = self.objects.push(Object { shape, material }).map(|()| id);
        added.map_err(|item| Full { item, parameter: "OBJECTS" })
    }

    /// Adds a light.
    ///
    /// # Errors
    /// There is no room: the light is handed back and the scene is unchanged. Raise `LIGHTS`.
    pub fn add_light(&mut self, light: Light) -> Result<(), Full<Light>> {
        self.lights.push(light).map_err(|item| Full { item, parameter: "LIGHTS" })
    }

    /// The objects in the order in which they were added, to be moved or given another shape or material.
    pub fn objects_mut(&mut self) -> &mut [Object<S>] {
        &mut self.objects
    }

    /// The materials in the order of their [`MaterialId`]s.
    pub fn materials_mut(&mut self) -> &mut [Material<'a>] {
        &mut self.materials
    }

    /// The lights in the order in which they were added.
    pub fn lights_mut(&mut self) -> &mut [Light] {
        &mut self.lights
    }

    /// Removes all objects, materials, lights and motions.
    pub fn clear(&mut self) {
        self.objects.clear();
        self.materials.clear();
        self.lights.clear();
        self.motions = &[];
    }

    /// The scene in its borrowed form.
    pub fn as_scene(&self) -> Scene<'_, S> {
        Scene {
            camera: self.camera,
            background: self.background,
            objects: &self.objects,
            materials: &self.materials,
            lights: &self.lights,
            motions: self.motions,
        }
    }
}
