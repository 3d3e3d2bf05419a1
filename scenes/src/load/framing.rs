//! The automatic camera, which frames a mesh.

use crate::camera::Camera;
use crate::mesh::{BoundingBox, Mesh};
use crate::size::Size;
use crate::sphere::Sphere;
use glam::{DVec3, dvec3};

/// The automatic camera's field of view, in degrees.
pub(super) const FRAMING_FOV: f64 = 35.0;

/// The viewing direction for a mesh whose y axis is up: a little from the right and from above.
const DIRECTION: DVec3 = dvec3(0.45, 0.35, 1.0);

/// The box round a mesh and spheres.
pub(super) fn bounding_box(mesh: &Mesh, spheres: &[Sphere]) -> BoundingBox {
    spheres.iter().fold(mesh.bounding_box(), |BoundingBox { min, max }, Sphere { centre, radius, .. }| BoundingBox {
        min: min.min(*centre - *radius),
        max: max.max(*centre + *radius),
    })
}

/// A camera that shows everything in such a box.
pub(super) fn framing_camera(bounds: BoundingBox, up: DVec3, fov: f64, size: Size) -> Camera {
    // If up changes, the direction is rotated with it: over the same shoulder, wherever the shoulder is.
    let direction = if up.z.abs() > up.y.abs() { dvec3(DIRECTION.x, -DIRECTION.z, DIRECTION.y) } else { DIRECTION };
    Camera::framing(bounds, direction, up, fov, size)
}
