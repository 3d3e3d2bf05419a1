//! A sphere in perspective: an ellipse, with depth and light over it, in real numbers.

use crate::light::Lighting;
use glam::{DVec2, DVec3};

/// The picture of a sphere in front of the eye, on a screen of square pixels.
///
/// The sphere's centre is s = (x, y, w) from the eye, h is the length of (x, y), and r is its radius. Everything
/// follows from v = (w - r)(w + r) and e^2 = v + h^2, neither of which suffers cancellation.
pub(crate) struct Image {
    /// The middle of the ellipse, in pixels.
    pub centre: DVec2,
    /// The half axes in pixels: radially from the middle of the screen, and across; the first is the longer one.
    pub half_axes: [f64; 2],
    /// Unit vectors along both.
    axes: [DVec2; 2],
    /// 1/w in the middle of the silhouette, its increase at the outer end, and its increase at the nearest point.
    pub inverse: [f64; 3],
    /// Unit vectors along both axes of the silhouette's circle, and the one to the eye, in view space.
    frame: [DVec3; 3],
}

impl Image {
    /// For a sphere with its middle at `s` (right, down, forward of the eye), wholly in front of the eye. The screen's
    /// middle is at `middle`, with `scale` pixels per unit of right / forward.
    pub fn new(s: DVec3, r: f64, middle: DVec2, scale: f64) -> Image {
        let aside = DVec2::new(s.x, s.y);
        let h = aside.dot(aside).sqrt();
        // Scaled first, so that squares do not vanish.
        let largest = aside.abs().max_element();
        let scaled = if largest > 0.0 { aside / largest } else { DVec2::X };
        let outward = scaled / scaled.dot(scaled).sqrt();
        let across = DVec2::new(-outward.y, outward.x);
        let v = (s.z - r) * (s.z + r);
        let (e, root) = ((v + h * h).sqrt(), v.sqrt());
        let away = (s.z * s.z + h * h).sqrt();
        Image {
            centre: middle + aside * (s.z / v) * scale,
            half_axes: [r * scale * (e / v), r * scale / root],
            axes: [outward, across],
            inverse: [s.z / v, h * r / (e * v), r / (e * root)],
            frame: [
                DVec3::new(outward.x * s.z, outward.y * s.z, -h) / away,
                DVec3::new(across.x, across.y, 0.0),
                -s / away,
            ],
        }
    }

    /// Half of the width and of the height of the box round the ellipse, in pixels.
    pub fn half_box(&self) -> DVec2 {
        let [p, q] = [self.axes[0] * self.half_axes[0], self.axes[1] * self.half_axes[1]];
        let half = |p: f64, q: f64| (p * p + q * q).sqrt();
        DVec2::new(half(p.x, q.x), half(p.y, q.y))
    }

    /// The real coefficients d, e, f, a, b, c of `constant + slope . (p, q) + curve Q` over pixels counted from
    /// `pixel`, at their centres. p and q are the position in the ellipse in units of its half axes, and Q = 1 - p^2 -
    /// q^2.
    pub fn quadratic(&self, pixel: DVec2, Function { constant, slope, curve }: Function) -> [f64; 6] {
        let offset = pixel + 0.5 - self.centre;
        let along = |i: usize| {
            let step = self.axes[i] / self.half_axes[i];
            (step.x, step.y, step.dot(offset))
        };
        let ((px, py, p), (qx, qy, q)) = (along(0), along(1));
        [
            -curve * (px * px + qx * qx),
            -2.0 * curve * (px * py + qx * qy),
            -curve * (py * py + qy * qy),
            slope[0] * px + slope[1] * qx - 2.0 * curve * (px * p + qx * q),
            slope[0] * py + slope[1] * qy - 2.0 * curve * (py * p + qy * q),
            constant + slope[0] * p + slope[1] * q + curve * (1.0 - p * p - q * q),
        ]
    }

    /// Its brightness, 0 to 1.
    pub fn brightness(&self, shade: &Shade) -> Function {
        let [along, across, towards] = self.frame.map(|axis| axis.dot(shade.direction));
        let half = 0.5 / shade.most;
        Function {
            constant: (shade.ambient + 0.5 * shade.sum) / shade.most,
            slope: [along * half, across * half],
            curve: towards * half,
        }
    }
}

/// A function over an ellipse; see [`Image::quadratic`].
#[derive(Clone, Copy)]
pub(crate) struct Function {
    pub constant: f64,
    pub slope: [f64; 2],
    pub curve: f64,
}

impl Function {
    /// `base + factor * self`.
    pub fn scaled(&self, base: f64, factor: f64) -> Function {
        let slope = self.slope.map(|slope| slope * factor);
        Function { constant: base + factor * self.constant, slope, curve: factor * self.curve }
    }
}

/// The light of a scene, as spheres use it.
pub(crate) struct Shade {
    ambient: f64,
    /// Of all intensities.
    sum: f64,
    /// The sum of all directions in view space, each times its intensity.
    direction: DVec3,
    /// The greatest brightness, at least 1.
    most: f64,
}

impl Shade {
    /// For lights with directions of length 1; `turn` brings them to view space.
    pub fn new(lighting: &Lighting, turn: impl Fn(DVec3) -> DVec3) -> Shade {
        let sum = lighting.lights.iter().fold(0.0, |sum, light| sum + light.intensity);
        let add = |to: DVec3, light: &crate::light::Light| to + light.toward * light.intensity;
        let direction = turn(lighting.lights.iter().fold(DVec3::ZERO, add));
        let most = lighting.ambient + 0.5 * (sum + direction.dot(direction).sqrt());
        Shade { ambient: lighting.ambient, sum, direction, most: most.max(1.0) }
    }
}
