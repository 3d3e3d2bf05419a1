//! The camera that frames a mesh by itself.

use crate::camera::Camera;
use crate::mesh::{BoundingBox, Mesh};
use crate::size::Size;
use crate::sphere::Sphere;
use glam::{DVec3, dvec3};

/// Field of view of the camera that frames a mesh by itself, in degrees.
pub(super) const FRAMING_FOV: f64 = 35.0;

/// From where a mesh is seen whose y axis is up: a little from the right and from above.
const DIRECTION: DVec3 = dvec3(0.45, 0.35, 1.0);

/// The box round a mesh and spheres.
pub(super) fn bounding_box(mesh: &Mesh, spheres: &[Sphere]) -> BoundingBox {
    spheres.iter().fold(mesh.bounding_box(), |BoundingBox { min, max }, Sphere { centre, radius, .. }| BoundingBox {
        min: min.min(*centre - *radius),
        max: max.max(*centre + *radius),
    })
}

/// A camera that shows the whole of what such a box is round.
pub(super) fn framing_camera(bounds: BoundingBox, up: DVec3, fov: f64, size: Size) -> Camera {
    // If up is turned, the direction turns with it: over the same shoulder, wherever the shoulder is.
    let direction = if up.z.abs() > up.y.abs() { dvec3(DIRECTION.x, -DIRECTION.z, DIRECTION.y) } else { DIRECTION };
    Camera::framing(bounds, direction, up, fov, size)
}
