//! The SVG backend of `plotters`. Paints are classes (see [`classes`]), so that a style sheet decides on colours for light screens, dark screens and
//! paper.

use super::mark::classes;
use maud::{Render, html};
use plotters::prelude::DrawingBackend;
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingErrorKind};
use std::cell::RefCell;
use std::convert::Infallible;
use std::rc::Rc;

/// `plotters` counts whole pixels. It gets ten for each of ours, for smooth curves.
pub const TENTHS: i32 = 10;

/// Text to which SVG elements are added. It is shared, because `plotters` takes its backend and does not return it.
pub struct Svg {
    elements: Rc<RefCell<String>>,
    size: (u32, u32),
}

impl Svg {
    /// A picture of that width and height, in CSS pixels.
    pub fn new(elements: Rc<RefCell<String>>, (width, height): (u32, u32)) -> Svg {
        let tenths = TENTHS.unsigned_abs();
        Svg { elements, size: (width * tenths, height * tenths) }
    }

    fn add(&mut self, element: &impl Render) -> Done {
        element.render_to(&mut self.elements.borrow_mut());
        Ok(())
    }
}

type Done = Result<(), DrawingErrorKind<Infallible>>;

impl DrawingBackend for Svg {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Done {
        Ok(())
    }

    fn present(&mut self) -> Done {
        Ok(())
    }

    /// Nothing is drawn by pixels.
    fn draw_pixel(&mut self, _: BackendCoord, _: BackendColor) -> Done {
        Ok(())
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Done {
        self.draw_path([from, to], style)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Done {
        self.add(&html! { polyline class=(classes(style.color())) points=(points(path)) {} })
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, corners: I, style: &S) -> Done {
        self.add(&html! { polygon class=(classes(style.color())) points=(points(corners)) {} })
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, (x, y): BackendCoord) -> Done {
        let anchor = match style.anchor().h_pos {
            HPos::Left => "start",
            HPos::Center => "middle",
            HPos::Right => "end",
        };
        // From the requested height to the baseline.
        let down = match style.anchor().v_pos {
            VPos::Top => "0.75em",
            VPos::Center => "0.35em",
            VPos::Bottom => "-0.25em",
        };
        let class = classes(style.color());
        self.add(&html! { text class=(class) x=(tenths(x)) y=(tenths(y)) dy=(down) text-anchor=(anchor) { (text) } })
    }

    /// A rough size, as only the browser has the fonts.
    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        Ok(((text.chars().count() as f64 * style.size() * 0.55) as u32, style.size() as u32))
    }
}

/// Points written as `12.3,4 5,6.7`.
pub fn points(path: impl IntoIterator<Item = BackendCoord>) -> String {
    path.into_iter().map(|(x, y)| format!("{},{}", tenths(x), tenths(y))).collect::<Vec<_>>().join(" ")
}

/// A length in CSS pixels.
pub fn tenths(value: i32) -> f64 {
    f64::from(value) / f64::from(TENTHS)
}
