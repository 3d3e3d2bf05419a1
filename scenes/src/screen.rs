//! The screen as the front end sees it: depth and guard band, clipping and snapping of view space.

use crate::camera::View;
use crate::clip::{ClipPlane, ViewVertex};
use crate::error::SceneError;
use crate::packet::*;
use crate::scene::Scene;
use crate::size::Size;
use glam::{DVec2, DVec3};

/// The error for a scene with nothing in front of the eye, or `None`; a mistake in the camera itself is an error of its
/// own.
pub(crate) fn nothing_in_front(scene: &Scene) -> Result<Option<SceneError>, SceneError> {
    let view = scene.camera.view()?;
    let positions = scene.mesh.positions().iter();
    let seen: Vec<DVec3> = positions.map(|&p| view.of_point(p)).collect();
    Ok((depth_range(scene, &seen, view).1 == 0.0).then(|| behind(scene)))
}

fn behind(scene: &Scene) -> SceneError {
    SceneError::invalid(
        format!(
            "nothing of the {} is in front of the camera at {} looking towards {}",
            if scene.spheres.is_empty() { "mesh" } else { "scene" },
            scene.camera.eye,
            scene.camera.target
        ),
        "move the eye or the target",
    )
}

/// The greatest ratio of far to near: 24 bits then still resolve depths of 1/4000 of the far distance.
const DEPTH_RATIO: f64 = 4096.0;

/// The least and the greatest distance, along the line of sight, of everything in front of the eye. The far distance is
/// 0 if there is nothing. The near distance is 0 if anything passes the eye.
fn depth_range(scene: &Scene, seen: &[DVec3], view: View) -> (f64, f64) {
    let triangles = scene.mesh.triangles().iter().map(|triangle| &triangle.positions[..]);
    let lines = scene.mesh.lines().iter().map(|line| &line.positions[..]);
    let of_mesh = triangles.chain(lines).map(|corners| {
        let distances = corners.iter().map(|&i| seen[i as usize].z);
        (distances.clone().fold(f64::INFINITY, f64::min), distances.fold(f64::NEG_INFINITY, f64::max))
    });
    let of_spheres = scene.spheres.iter().map(|sphere| {
        let distance = view.of_point(sphere.centre).z;
        (distance - sphere.radius, distance + sphere.radius)
    });
    of_mesh.chain(of_spheres).fold((f64::INFINITY, 0.0), |(near, far): (f64, f64), (nearest, farthest)| {
        if farthest > 0.0 { (near.min(nearest.max(0.0)), far.max(farthest)) } else { (near, far) }
    })
}

/// Clipping left nothing, and the side on which it was.
#[derive(Clone, Copy)]
pub(crate) enum Clipped {
    Behind,
    OffScreen,
}

/// The screen as the front end sees it: view space to 1/16 pixels.
pub(crate) struct Screen {
    size: Size,
    shift: [i32; 2],
    /// Middle of the screen, in pixels.
    centre: [f64; 2],
    /// Pixels per unit of right/forward.
    scale: f64,
    near: f64,
    /// far / (far - near).
    depth_scale: f64,
    near_plane: ClipPlane,
    guard: [ClipPlane; 4],
}

impl Screen {
    pub(crate) fn new(
        scene: &Scene,
        seen: &[DVec3],
        view: View,
        size: Size,
        shift: [i32; 2],
    ) -> Result<Screen, SceneError> {
        let (nearest, far) = depth_range(scene, seen, view);
        if far == 0.0 {
            return Err(behind(scene));
        }
        let near = nearest.max(far / DEPTH_RATIO);
        // A mesh at one distance: any far plane behind it works.
        let far = far.max(near * 1.001);
        let centre = [f64::from(size.width()) / 2.0, f64::from(size.height()) / 2.0];
        let scale = centre[1] / view.half_height;
        // The guard band less the shift, so that a moved vertex still has 16 bits.
        let limits = |axis: usize| {
            let sub = |position: i32| f64::from(position - shift[axis]) / f64::from(SUBPIXELS);
            (sub(i16::MIN.into()), sub(i16::MAX.into()))
        };
        let ((left, right), (top, bottom)) = (limits(0), limits(1));
        let plane = |x: f64, y: f64, w: f64| ClipPlane { normal: DVec3::new(x, y, w), offset: 0.0 };
        Ok(Screen {
            size,
            shift,
            centre,
            scale,
            near,
            depth_scale: far / (far - near),
            near_plane: ClipPlane { normal: DVec3::Z, offset: near },
            guard: [
                plane(scale, 0.0, centre[0] - left),
                plane(-scale, 0.0, right - centre[0]),
                plane(0.0, scale, centre[1] - top),
                plane(0.0, -scale, bottom - centre[1]),
            ],
        })
    }

    /// In pixels.
    pub(crate) fn size(&self) -> Size {
        self.size
    }

    /// Its middle, in pixels.
    pub(crate) fn middle(&self) -> DVec2 {
        DVec2::from_array(self.centre)
    }

    /// Pixels per unit of right/forward.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// The least distance, along the line of sight.
    pub(crate) fn near(&self) -> f64 {
        self.near
    }

    /// far / (far - near).
    pub(crate) fn depth_scale(&self) -> f64 {
        self.depth_scale
    }

    /// The part of a convex polygon beyond the near plane and, where it leaves the guard band, inside that: at least
    /// three vertices.
    pub(crate) fn clip(&self, corners: &[ViewVertex]) -> Result<Vec<ViewVertex>, Clipped> {
        let planes = [(&self.near_plane, Clipped::Behind)]
            .into_iter()
            .chain(self.guard.iter().map(|plane| (plane, Clipped::OffScreen)));
        let mut polygon = corners.to_vec();
        for (plane, outside) in planes {
            if polygon.iter().any(|v| plane.inside_by(v.at) < 0.0) {
                polygon = plane.clip(&polygon);
            }
            if polygon.len() < 3 {
                return Err(outside);
            }
        }
        Ok(polygon)
    }

    /// The part of a line beyond the near plane and inside the guard band.
    pub(crate) fn clip_line(&self, ends: [ViewVertex; 2]) -> Result<[ViewVertex; 2], Clipped> {
        let line = self.near_plane.clip_line(ends).ok_or(Clipped::Behind)?;
        let guarded = self.guard.iter().try_fold(line, |line, plane| plane.clip_line(line));
        guarded.ok_or(Clipped::OffScreen)
    }

    /// A vertex snapped to 1/16 pixel.
    pub(crate) fn snap(&self, v: ViewVertex) -> ScreenVertex {
        let w = v.at.z;
        let place = |axis: usize, offset: f64| {
            let pixels = self.centre[axis] + offset * self.scale / w;
            let snapped = (pixels * f64::from(SUBPIXELS) + 0.5).floor() as i32;
            snapped.saturating_add(self.shift[axis]).clamp(i16::MIN.into(), i16::MAX.into())
        };
        let range = f64::from(FARTHEST_VERTEX - NEAREST_VERTEX);
        let depth = ((1.0 - self.near / w) * self.depth_scale).clamp(0.0, 1.0);
        ScreenVertex {
            x: place(0, v.at.x),
            y: place(1, v.at.y),
            z: NEAREST_VERTEX + (depth * range + 0.5).floor() as u32,
            rgb: v.rgb.to_array().map(|c| (c * 255.0 + 0.5).floor() as u8),
        }
    }

    /// Whether the box round the vertices meets the screen.
    pub(crate) fn meets(&self, vertices: &[ScreenVertex]) -> bool {
        let axis = |position: fn(&ScreenVertex) -> i32, side: u32| {
            vertices.iter().any(|v| position(v) > 0) && vertices.iter().any(|v| position(v) < side as i32 * SUBPIXELS)
        };
        axis(|v| v.x, self.size.width()) && axis(|v| v.y, self.size.height())
    }
}
