//! The paints of a chart, and the shapes of its points.

use super::svg::{Svg, TENTHS};
use crate::origin::Origin;
use plotters::element::{DynElement, IntoDynElement};
use plotters::prelude::*;
use plotters_backend::BackendColor;

/// A paint: a class of the style sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Paint {
    Axis,
    Grid,
    FineGrid,
    /// A number along an axis.
    Tick,
    /// The label of an axis.
    Label,
    /// The line of a formula.
    Curve,
    /// A line that joins points for the eye.
    Thread,
    /// The name of a series, at the end of its curve.
    Name,
    /// A point that is transparent inside.
    Hollow,
    Filled,
    Cross,
}

const CLASSES: [(Paint, &str); 11] = [
    (Paint::Axis, "axis"),
    (Paint::Grid, "grid"),
    (Paint::FineGrid, "fine"),
    (Paint::Tick, "tick"),
    (Paint::Label, "label"),
    (Paint::Curve, "curve"),
    (Paint::Thread, "thread"),
    (Paint::Name, "name"),
    (Paint::Hollow, "hollow"),
    (Paint::Filled, "filled"),
    (Paint::Cross, "cross"),
];

/// The number of looks (colour, dashes, shape) of series; further series repeat them.
pub const LOOKS: usize = 6;

impl Paint {
    /// `plotters` knows only colours, so a paint and the number of a series' name are encoded as one.
    pub fn colour(self, number: usize) -> RGBColor {
        let index = CLASSES.iter().position(|(paint, _)| *paint == self).unwrap_or(0);
        RGBColor(index as u8, (number % LOOKS) as u8, 0)
    }

    pub fn line(self, number: usize) -> ShapeStyle {
        self.colour(number).stroke_width(1)
    }

    /// The size is for `plotters`, which reserves space for text.
    pub fn text<'a>(self, number: usize) -> TextStyle<'a> {
        ("sans-serif", 13 * TENTHS).with_color(self.colour(number)).into_text_style(&(0, 0))
    }
}

/// The classes for a colour of `plotters`: that of the paint, and for series that of the look.
pub fn classes(colour: BackendColor) -> String {
    let (index, look, _) = colour.rgb;
    let (paint, class) = CLASSES[usize::from(index).min(CLASSES.len() - 1)];
    match paint {
        Paint::Axis | Paint::Grid | Paint::FineGrid | Paint::Tick | Paint::Label => class.to_owned(),
        _ => format!("{class} look{look}"),
    }
}

/// A point: its shape shows the series' name, its paint the origin. A formula's points are not drawn. If a model has points of that name, those of
/// the hardware are small.
pub fn mark(
    number: usize,
    origin: &Origin,
    has_model: bool,
    at: (f64, f64),
) -> Vec<DynElement<'static, Svg, (f64, f64)>> {
    let polygon = |paint: Paint, outline: Vec<(i32, i32)>| {
        let shape = Polygon::new(outline, paint.colour(number));
        vec![(EmptyElement::at(at) + shape).into_dyn()]
    };
    let strokes = |strokes: [[(i32, i32); 2]; 2]| {
        let stroke = |stroke: [(i32, i32); 2]| PathElement::new(stroke.to_vec(), Paint::Cross.line(number));
        strokes.map(|it| (EmptyElement::at(at) + stroke(it)).into_dyn()).into()
    };
    match origin {
        Origin::Formula => vec![],
        Origin::Count { .. } => strokes(PLUS),
        Origin::Model { .. } => polygon(Paint::Hollow, outline(number)),
        Origin::Rtl { .. } => polygon(Paint::Filled, filled(number, has_model)),
        Origin::Paper => strokes(CROSS),
    }
}

/// The strokes of a cross, in tenths around its centre.
pub const CROSS: [[(i32, i32); 2]; 2] = [[(-45, -45), (45, 45)], [(-45, 45), (45, -45)]];

/// The strokes of a plus sign, in tenths around its centre.
pub const PLUS: [[(i32, i32); 2]; 2] = [[(-45, 0), (45, 0)], [(0, -45), (0, 45)]];

/// A filled point. Beside that of a model it leaves the outline free.
pub fn filled(number: usize, has_model: bool) -> Vec<(i32, i32)> {
    let parts = if has_model { 5 } else { 8 };
    outline(number).into_iter().map(|(x, y)| (x * parts / 8, y * parts / 8)).collect()
}

/// The shape of a series' points, in tenths around its centre: circle, square, triangle, diamond, triangle on its tip, pentagon.
pub fn outline(number: usize) -> Vec<(i32, i32)> {
    let (corners, radius, turn) =
        [(20, 38.0, 0.0), (4, 46.0, 0.125), (3, 50.0, 0.0), (4, 50.0, 0.0), (3, 50.0, 0.5), (5, 46.0, 0.0)]
            [number % LOOKS];
    let corner = |index: i32| {
        let angle = std::f64::consts::TAU * (f64::from(index) / f64::from(corners) + turn);
        ((radius * angle.sin()).round() as i32, (-radius * angle.cos()).round() as i32)
    };
    (0..corners).map(corner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beside_a_models_marks_those_of_the_hardware_are_inside() {
        let reach = |outline: Vec<(i32, i32)>| outline.into_iter().map(|(x, y)| x * x + y * y).max();
        for number in 0..LOOKS {
            assert_eq!(filled(number, false), outline(number));
            assert!(reach(filled(number, true)) < reach(outline(number)), "{number}");
        }
    }
}
