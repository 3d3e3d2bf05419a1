//! Set-up of a sphere in integers. Each coefficient is rounded once, counted from the pixel in the middle of the
//! ellipse, and then moved exactly.

use super::Sphere;
use super::image::{Function, Image, Shade};
use super::packet::{Quadratic, SpherePacket};
use crate::error::SceneError;
use crate::packet::*;
use crate::quote::number;
use crate::screen::Screen;
use glam::{DVec2, DVec3};

/// The bits of the magnitude of [`SpherePacket::inside`] at the pixels where a machine may evaluate it.
pub const VALUE_BITS: u32 = 38;
/// The longest half axis of an ellipse, in pixels.
const MOST_HALF_WIDTH: f64 = 512.0;
/// The shortest half axis, in pixels: a smaller ellipse is not drawn.
const LEAST_HALF_WIDTH: f64 = 1.0 / 16.0;
/// The greatest ratio of an ellipse's length to its width.
const MOST_RATIO: f64 = 4.0;
/// The pixels beside an ellipse's box where a machine may evaluate it: a region's side less 1.
const BESIDE: i64 = 255;
/// The denominator of the fraction of a pixel by which rounding may move a silhouette, where the bits allow it.
const SILHOUETTE: f64 = 1.0 / 1024.0;
/// Units of a fraction.
const ONE: f64 = (1 << FRACTION_BITS) as f64;

/// The reason why a sphere is not drawn.
#[derive(Clone, Copy)]
pub(crate) enum Unseen {
    Behind,
    OffScreen,
    BetweenCentres,
}

/// A sphere that is drawn, or the reason why it is not.
pub(crate) type Seen = Result<SpherePacket, Unseen>;

/// Sets up sphere number `i` of a scene, from 0 on, whose middle is at `s` from the eye (right, down, forward).
///
/// # Errors
/// The sphere reaches the near plane; or its picture meets the screen and is too large or too slender.
pub(crate) fn set_up(i: usize, sphere: &Sphere, s: DVec3, screen: &Screen, shade: &Shade) -> Result<Seen, SceneError> {
    let r = sphere.radius;
    let wrong = |problem: String, remedy| Err(SceneError::invalid(format!("sphere {} {problem}", i + 1), remedy));
    if s.z + r <= 0.0 {
        return Ok(Err(Unseen::Behind));
    }
    if s.z - r < screen.near() {
        let problem = "reaches nearer to the eye than 1/4096 of the farthest distance".to_owned();
        return wrong(problem, "move the eye away, or make the sphere smaller");
    }
    let image = Image::new(s, r, screen.middle(), screen.scale());
    let (centre, half) = (image.centre, image.half_box());
    let size = screen.size();
    let corner = DVec2::new(size.width().into(), size.height().into());
    if (centre + half).cmplt(DVec2::ZERO).any() || (centre - half).cmpgt(corner).any() {
        return Ok(Err(Unseen::OffScreen));
    }
    let [longer, shorter] = image.half_axes;
    if shorter < LEAST_HALF_WIDTH {
        return Ok(Err(Unseen::BetweenCentres));
    }
    if longer > MOST_HALF_WIDTH {
        let problem = format!("is {} pixels wide on the screen, and the most is 1024", number((2.0 * longer).ceil()));
        return wrong(problem, "move the eye away, or take a smaller size");
    }
    if longer > MOST_RATIO * shorter {
        let ratio = number((10.0 * longer / shorter).round() / 10.0);
        let problem = format!("is {ratio} times as long as wide on the screen, and the most is 4");
        return wrong(problem, "look more straight at it, or give a smaller fov");
    }
    Ok(Rounding::new(&image).packet(&image, sphere, screen, shade).ok_or(Unseen::BetweenCentres))
}

/// The rounding of an ellipse's coefficients, and its error.
struct Rounding {
    /// The pixel that they are counted from: the one in the middle.
    origin: [i64; 2],
    /// The columns and rows from there that contain all pixels of the ellipse, and one more.
    reach: [i64; 2],
    /// The largest error of a value there, in units of the last place.
    error: f64,
    /// [`SpherePacket::inside`], from the origin.
    inside: Quadratic,
    /// A pixel inside is a pixel of the exact ellipse with `Q >= -beyond`.
    beyond: f64,
}

impl Rounding {
    /// For an ellipse with half axes in the limits.
    fn new(image: &Image) -> Rounding {
        let pixel = image.centre.floor();
        let origin = [pixel.x as i64, pixel.y as i64];
        let half = image.half_box();
        let reach = [half.x, half.y].map(|half| half.ceil() as i64 + 2);
        let [x, y] = reach.map(|reach| reach as f64);
        // Half a unit of each coefficient, and one for f64's own rounding.
        let error = 0.5 * (1.0 + x + y + x * x + x * y + y * y) + 1.0;
        let exact = image.quadratic(pixel, Function { constant: 0.0, slope: [0.0; 2], curve: 1.0 });
        let scaled = |bits: u32| rounded(exact, (1_u64 << bits) as f64);
        let fits = |bits: &u32| most(&scaled(*bits), reach.map(|reach| reach + BESIDE)) < 1 << VALUE_BITS;
        // From the silhouette outward Q decreases by at least 2 in a half axis.
        let precise = |bits: &u32| error * image.half_axes[0] <= SILHOUETTE * 2.0 * (1_u64 << bits) as f64;
        let most_bits = (0..VALUE_BITS).rev().find(fits).unwrap_or(0);
        let bits = (0..most_bits).find(precise).unwrap_or(most_bits);
        Rounding { origin, reach, error, inside: scaled(bits), beyond: error / (1_u64 << bits) as f64 }
    }

    /// The packet; `None` if the ellipse meets no column of pixel centres, or no row, of the screen.
    fn packet(&self, image: &Image, sphere: &Sphere, screen: &Screen, shade: &Shade) -> Option<SpherePacket> {
        let bounds = self.bounds(screen)?;
        let span = f64::from(FARTHEST_VERTEX - NEAREST_VERTEX);
        // Depth decreases as 1/w increases.
        let [middle, slope, curve] = image.inverse;
        let inverse = Function { constant: middle, slope: [slope, 0.0], curve };
        let depth = inverse.scaled(screen.depth_scale(), -screen.depth_scale() * screen.near());
        let brightness = image.brightness(shade);
        let channel = |i: usize| self.fixed(image, &brightness, 0.0, 255.0, f64::from(sphere.colour[i]) / 255.0);
        let place = |from: Quadratic| from.seen_from(self.origin[0], self.origin[1]);
        Some(SpherePacket {
            inside: place(self.inside),
            z: place(self.fixed(image, &depth, NEAREST_VERTEX.into(), span, 1.0)).modulo(DEPTH_PLANE_BITS),
            rgb: [0, 1, 2].map(|i| place(channel(i)).modulo(COLOUR_PLANE_BITS)),
            bounds,
            polygon: 0,
        })
    }

    /// `least + span * part * function` with fraction bits, for a function from 0 to 1 over the ellipse, and `part`
    /// from 0 to 1. If rounding may leave the range from `least` to `least + span`, the range is reduced by that at
    /// both ends.
    fn fixed(&self, image: &Image, function: &Function, least: f64, span: f64, part: f64) -> Quadratic {
        let Function { constant, slope: [p, q], curve } = function;
        let slope = p.abs() + q.abs();
        // Rounding to the nearest whole number changes it by about half a unit.
        let beside = span * part * (slope + curve.abs()) * self.beyond + self.error / ONE - 0.5;
        let lowest = span * part * (constant - slope + curve.min(0.0));
        let highest = span * part * (constant + slope + curve.max(0.0));
        let margin = if lowest >= beside && highest <= span - beside { 0.0 } else { beside.max(0.0) };
        let value = function.scaled(least + margin + 0.5, (span - 2.0 * margin) * part);
        let pixel = DVec2::new(self.origin[0] as f64, self.origin[1] as f64);
        rounded(image.quadratic(pixel, value), ONE)
    }

    /// The columns and rows of the screen that the rounded ellipse meets.
    fn bounds(&self, screen: &Screen) -> Option<PixelBox> {
        let Quadratic { d, e, f, a, b, c } = self.inside;
        let turned = Quadratic { d: f, e, f: d, a: b, b: a, c };
        let (left, right) = columns(&self.inside, self.reach[0], self.origin[0], screen.size().width())?;
        let (top, bottom) = columns(&turned, self.reach[1], self.origin[1], screen.size().height())?;
        Some(PixelBox { left, top, right, bottom })
    }
}

/// The first and the last column of a screen that an ellipse meets, among those up to `reach` beside its origin.
fn columns(inside: &Quadratic, reach: i64, origin: i64, width: u32) -> Option<(u32, u32)> {
    let [d, e, f, a, b, c] = [inside.d, inside.e, inside.f, inside.a, inside.b, inside.c].map(i128::from);
    // The greatest value of a column, times -4 f, which is positive.
    let meets = |x: &i64| {
        let x = i128::from(*x);
        (b + e * x).pow(2) - 4 * f * (c + a * x + d * x * x) >= 0
    };
    let first = (-reach..=reach).find(meets)?;
    let last = (-reach..=reach).rev().find(meets)?;
    let (first, last) = ((origin + first).max(0), (origin + last).min(i64::from(width) - 1));
    (first <= last).then_some((first as u32, last as u32))
}

/// The coefficients in units of 1/`unit`, each rounded to the nearest.
fn rounded(exact: [f64; 6], unit: f64) -> Quadratic {
    let [d, e, f, a, b, c] = exact.map(|number| (number * unit + 0.5).floor() as i64);
    Quadratic { d, e, f, a, b, c }
}

/// An upper bound of the values up to that many columns and rows from the origin.
fn most(quadratic: &Quadratic, [x, y]: [i64; 2]) -> i128 {
    let &Quadratic { d, e, f, a, b, c } = quadratic;
    let terms = [(d, x * x), (e, x * y), (f, y * y), (a, x), (b, y), (c, 1)];
    terms.iter().map(|(factor, by)| i128::from(factor.unsigned_abs()) * i128::from(*by)).sum()
}
