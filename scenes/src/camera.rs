//! The camera: the eye, its target, and its field of view.
//!
//! The recipe for views round a scene (VC1-T1: 48 azimuths) is [`Camera::orbited`].

use crate::angle;
use crate::error::SceneError;
use crate::mesh::{BoundingBox, representable};
use crate::quote::number;
use crate::size::Size;
use glam::DVec3;

/// A perspective camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The position of the eye, in the mesh's unit.
    pub eye: DVec3,
    /// The point in the middle of the picture.
    pub target: DVec3,
    /// The direction that is up in the picture; not parallel to the line of sight.
    pub up: DVec3,
    /// Vertical field of view in degrees, from 1e-6 to less than 180.
    pub fov: f64,
}

/// A part of a camera, as a scene file names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Eye,
    Target,
    Up,
    Fov,
}

/// A camera's axes, unit vectors at right angles, and the picture's scale.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    eye: DVec3,
    right: DVec3,
    down: DVec3,
    forward: DVec3,
    /// Half the picture's height at distance 1.
    pub(crate) half_height: f64,
}

impl Camera {
    /// A camera that shows the whole of a box, seen from `direction` (from the box towards the eye).
    pub fn framing(bounds: BoundingBox, direction: DVec3, up: DVec3, fov: f64, size: Size) -> Camera {
        let centre = bounds.min / 2.0 + bounds.max / 2.0;
        let half = bounds.max / 2.0 - bounds.min / 2.0;
        let radius = match half.dot(half).sqrt() {
            // A single point still needs a distance.
            0.0 => 1.0,
            radius => radius,
        };
        // The sphere round the box must fit the narrower field of view.
        let aspect = f64::from(size.width()) / f64::from(size.height());
        let tangent = angle::tan(fov / 2.0) * aspect.min(1.0);
        let sine = tangent / (1.0 + tangent * tangent).sqrt();
        let towards = direction / direction.dot(direction).sqrt();
        Camera { eye: centre + towards * (radius / sine), target: centre, up, fov }
    }

    /// The camera rotated round the axis through the target along `up`, counter-clockwise seen from above, in degrees.
    pub fn orbited(&self, degrees: f64) -> Camera {
        let axis = self.up / self.up.dot(self.up).sqrt();
        let arm = self.eye - self.target;
        let (s, c) = angle::sin_cos(degrees);
        let turned = arm * c + axis.cross(arm) * s + axis * (axis.dot(arm) * (1.0 - c));
        Camera { eye: self.target + turned, ..*self }
    }

    /// Checks the camera.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if a number is not finite, the eye is at the target, up is parallel to the line of sight, or the
    /// field of view is out of range.
    pub fn check(&self) -> Result<(), SceneError> {
        self.view().map(|_| ())
    }

    pub(crate) fn view(&self) -> Result<View, SceneError> {
        self.examined().map_err(|(_, error)| error)
    }

    /// The view, or what is wrong and the part of the camera that causes it.
    pub(crate) fn examined(&self) -> Result<View, (Part, SceneError)> {
        let wrong = |part, problem, remedy: &str| Err((part, SceneError::invalid(problem, remedy)));
        // From so far away, if a narrower field of view frames a mesh, its vertices can no longer be distinguished.
        if !(self.fov >= 1e-6 && self.fov < 180.0) {
            let problem = format!("the camera's field of view is {} degrees", number(self.fov));
            return wrong(Part::Fov, problem, "give an angle from 1e-6 to less than 180");
        }
        let vectors = [("eye", Part::Eye, self.eye), ("target", Part::Target, self.target), ("up", Part::Up, self.up)];
        for (name, part, v) in vectors {
            if !representable(v) {
                return wrong(part, format!("the camera's {name} is {v}"), "give three finite numbers below 1e100");
            }
        }
        let sight = self.target - self.eye;
        if sight == DVec3::ZERO {
            let problem = format!("the camera's eye and target are the same point, {}", self.eye);
            return wrong(Part::Eye, problem, "move one of them");
        }
        let forward = unit(sight);
        let right = forward.cross(unit(self.up));
        let sine2 = right.dot(right);
        // An up of length zero is NaN here.
        if sine2.is_nan() || sine2 < 1e-12 {
            let problem = format!("the camera's up, {}, is zero or parallel to its line of sight", self.up);
            return wrong(Part::Up, problem, "choose another up");
        }
        let right = unit(right);
        Ok(View { eye: self.eye, right, down: forward.cross(right), forward, half_height: angle::tan(self.fov / 2.0) })
    }
}

impl View {
    /// The direction to the right in the picture, a unit vector.
    pub(crate) fn right(&self) -> DVec3 {
        self.right
    }

    /// A point as (right, down, forward) of the eye, in the mesh's unit.
    pub(crate) fn of_point(&self, p: DVec3) -> DVec3 {
        self.of_direction(p - self.eye)
    }

    /// A direction as (right, down, forward) of the eye, at the same length.
    pub(crate) fn of_direction(&self, d: DVec3) -> DVec3 {
        DVec3::new(self.right.dot(d), self.down.dot(d), self.forward.dot(d))
    }
}

/// `v` at length 1; NaN if it has no direction.
fn unit(v: DVec3) -> DVec3 {
    let scaled = v / v.abs().max_element();
    scaled / scaled.dot(scaled).sqrt()
}
