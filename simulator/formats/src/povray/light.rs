//! Lights in POV-Ray's language.

use rayline::shape::{Shape, Sphere};
use rayline::{Falloff, Lamp, Light, LinearRgb, Object, ObjectId, Scene};

use super::Lack;
use super::literal::{list, rgb, xyz};

/// A light. A directional light is placed far outside of the scene, at 100 times its `extent`. A lamp with a
/// size is written with its object, by [`ball_lamp`].
pub(super) fn light(scene: &Scene<'_>, light: &Light, extent: f64) -> Result<String, Lack> {
    Ok(match *light {
        Light::Point { position, color } => {
            format!("light_source {{ {} rgb {} }}\n", xyz(position.to::<f64>()), rgb(color))
        }
        Light::Directional { direction, color } => {
            let direction = direction.to::<f64>();
            let away = direction * (-100.0 * extent * direction.length().recip());
            format!("light_source {{ {} rgb {} parallel point_at 0 }}\n", xyz(away), rgb(color))
        }
        // Ambient light is a global setting, see `ambient`.
        Light::Ambient { .. } => String::new(),
        Light::Object(ObjectId(index)) => match scene.objects.get(usize::from(index)) {
            Some(Object { shape: Shape::Sphere(_), .. }) => String::new(),
            _ => return Err(Lack::Area),
        },
        Light::Sky => return Err(Lack::Sky),
        Light::Lamp(lamp) => lamp_source(&lamp)?,
        _ => return Err(Lack::New),
    })
}

/// A ball that emits light, with its `look`: the ball around the origin, with its texture. POV-Ray draws
/// points of a disc that faces the surface. Far beyond its `fade_distance` the light falls off as the square.
pub(super) fn ball_lamp(ball: &Sphere, emission: LinearRgb, look: &str) -> String {
    let (width, fade) = (2.0 * f64::from(ball.radius), 0.01 * f64::from(ball.radius));
    // The light at distance d is that of the surface times (radius / d)², and POV-Ray's is 2 (fade / d)².
    let color = emission.channels().map(|channel| f64::from(channel) * 5000.0);
    format!(
        "light_source {{ {} rgb {} area_light x*{width}, y*{width}, 17, 17 adaptive 3 jitter circular orient \
         fade_distance {fade} fade_power 2 looks_like {{ {look} }} }}\n",
        xyz(ball.center.to::<f64>()),
        list(&color)
    )
}

/// The sum of the ambient lights; white if there are none.
pub(super) fn ambient(scene: &Scene<'_>) -> LinearRgb {
    let colors = scene.lights.iter().filter_map(|light| match light {
        Light::Ambient { color } => Some(*color),
        _ => None,
    });
    colors.reduce(|a, b| a + b).unwrap_or(LinearRgb::WHITE)
}

/// A lamp. POV-Ray's lights fall off as 2 / (1 + (d / distance)²), and fade between two angles as the core's
/// do. The core's are at most as bright as without falloff, so they differ very close to the lamp.
fn lamp_source(lamp: &Lamp) -> Result<String, Lack> {
    let Falloff { constant, linear, quadratic } = lamp.falloff;
    if linear != 0.0 {
        return Err(Lack::Falloff);
    }
    let (constant, quadratic) = (f64::from(constant), f64::from(quadratic));
    let (brightness, fade) = if quadratic > 0.0 {
        // An inverse square is the limit of small distances. A thousandth of that where the light is as
        // bright as without falloff is exact to a millionth.
        let least = 1e-6;
        let constant = constant.max(least);
        (0.5 / constant, format!(" fade_distance {} fade_power 2", (constant / quadratic).sqrt()))
    } else {
        (1.0 / constant.max(1.0), String::new())
    };
    let color = lamp.color.channels().map(|channel| f64::from(channel) * brightness);
    let cone = lamp.cone.map_or(String::new(), |cone| {
        let target = lamp.position.to::<f64>() + cone.direction.to::<f64>();
        // With a bright angle of 0, POV-Ray makes the edge sharp.
        let (bright, dark) =
            (f64::from(cone.bright).to_degrees().max(1e-3), f64::from(cone.dark).to_degrees());
        format!(" spotlight radius {bright} falloff {dark} tightness 0 point_at {}", xyz(target))
    });
    Ok(format!("light_source {{ {} rgb {}{cone}{fade} }}\n", xyz(lamp.position.to::<f64>()), list(&color)))
}
