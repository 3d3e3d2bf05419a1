//! Two eyes: the cameras of a stereo picture, and both frames side by side.
//!
//! Their lines of sight are parallel. So both see the same directions, and a shader's lights are the same for both.

use crate::camera::Camera;
use crate::error::SceneError;
use crate::frame::Frame;
use crate::quote::number;
use crate::scene::Scene;
use crate::size::{MAX_SIDE, Size};

/// The default ratio of the target's distance to that between the eyes: as for a human (6.5 cm) and an object 2 m away.
const TARGET_BY_EYES: f64 = 30.0;

impl Camera {
    /// A suitable distance between the eyes: a thirtieth of that to the target, in the mesh's unit.
    pub fn eye_distance(&self) -> f64 {
        let sight = self.target - self.eye;
        sight.dot(sight).sqrt() / TARGET_BY_EYES
    }

    /// The left and the right eye: the camera, moved to either side by half of a distance in the mesh's unit.
    ///
    /// ```
    /// use glam::DVec3;
    /// use tilewright_scenes::Camera;
    ///
    /// let camera = Camera { eye: DVec3::new(0.0, 0.0, 60.0), target: DVec3::ZERO, up: DVec3::Y, fov: 40.0 };
    /// assert_eq!(camera.eye_distance(), 2.0);
    /// let [left, right] = camera.eyes(2.0)?;
    /// assert_eq!((left.eye, left.target), (DVec3::new(-1.0, 0.0, 60.0), DVec3::new(-1.0, 0.0, 0.0)));
    /// assert_eq!(right.eye.x, 1.0);
    /// # Ok::<(), tilewright_scenes::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if the distance is negative or not finite, or there is no such camera.
    pub fn eyes(&self, distance: f64) -> Result<[Camera; 2], SceneError> {
        if !(0.0..1e100).contains(&distance) {
            let problem = format!("the distance between the eyes is {}", number(distance));
            return Err(SceneError::invalid(problem, "give a number from 0 on, below 1e100"));
        }
        let aside = self.view()?.right() * (distance / 2.0);
        let moved = |by| Camera { eye: self.eye + by, target: self.target + by, ..*self };
        let eyes = [moved(-aside), moved(aside)];
        eyes.iter().try_for_each(Camera::check)?;
        Ok(eyes)
    }
}

impl Scene {
    /// The scene as the left and the right eye see it, each on a screen of the scene's size.
    ///
    /// # Errors
    /// As [`Camera::eyes`].
    pub fn eyes(&self, distance: f64) -> Result<[Scene; 2], SceneError> {
        Ok(self.camera.eyes(distance)?.map(|camera| Scene { camera, ..self.clone() }))
    }
}

/// The size of two frames of `size` pixels side by side.
///
/// # Errors
/// [`SceneError::Invalid`] if they are wider than [`MAX_SIDE`].
pub fn stereo_size(size: Size) -> Result<Size, SceneError> {
    Size::new(2 * size.width(), size.height()).map_err(|_| {
        let problem = format!("two frames of {size} pixels side by side are too wide");
        SceneError::invalid(problem, format!("give a width up to {}", MAX_SIDE / 2))
    })
}

/// The left eye's frame, with the right eye's to the right of it.
///
/// ```
/// use tilewright_scenes::{Frame, Size, side_by_side};
///
/// let [left, right] = [[1; 3], [2; 3]].map(|rgb| Frame::blank(Size::new(2, 2).expect("in range"), rgb));
/// let both = side_by_side(&[left, right])?;
/// assert_eq!([0, 1, 2, 3].map(|x| both.rgb(x, 1)[0]), [1, 1, 2, 2]);
/// # Ok::<(), tilewright_scenes::SceneError>(())
/// ```
///
/// # Errors
/// As [`stereo_size`].
///
/// # Panics
/// If they differ in size.
pub fn side_by_side([left, right]: &[Frame; 2]) -> Result<Frame, SceneError> {
    assert_eq!(left.size(), right.size());
    let size = stereo_size(left.size())?;
    let width = left.size().width() as usize;
    let rows = left.words.chunks_exact(width).zip(right.words.chunks_exact(width));
    let words = rows.flat_map(|(left, right)| left.iter().chain(right)).copied().collect();
    Ok(Frame::from_words(size, words).expect("twice as many words"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn the_right_eye_sees_things_farther_to_the_left() {
        let scene = Scene::builtin("teapot").unwrap();
        let distance = scene.camera.eye_distance();
        let scenes = scene.eyes(distance).unwrap();
        let [left, right] = scenes.map(|scene| {
            // The old target is off the middle of each eye's view by half of the distance, and as far away as before.
            scene.camera.view().unwrap().of_point(Scene::builtin("teapot").unwrap().camera.target)
        });
        assert!((left - right - DVec3::new(distance, 0.0, 0.0)).length() < 1e-9, "{left} {right}");
        assert!((left.z - 30.0 * distance).abs() < 1e-9);
    }

    #[test]
    fn mistakes_are_said() {
        let scene = Scene::builtin("star").unwrap();
        for distance in [-0.5, f64::NAN, f64::INFINITY] {
            let error = scene.eyes(distance).unwrap_err().to_string();
            assert!(error.contains("the distance between the eyes is"), "{error}");
        }
        let error = stereo_size(Size::new(1025, 8).unwrap()).unwrap_err().to_string();
        assert!(error.ends_with("give a width up to 1024"), "{error}");
    }
}
