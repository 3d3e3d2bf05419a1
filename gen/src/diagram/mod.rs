//! Block diagrams, drawn from the circuit as a paper about the hardware would.
//!
//! [`items`] lists what a box can stand for. [`wires`] finds the paths through logic between items. [`fold`] decides which items share a box, and
//! [`build`] makes a [`Diagram`] of them. [`layout`] places everything, in pixels or in characters.

mod around;
mod ascii;
mod build;
mod dot;
mod error;
mod fold;
mod items;
mod layout;
mod model;
mod ports;
mod svg;
mod wires;

pub use error::DiagramError;
pub use model::{Arrow, ArrowKind, BoxKind, Diagram, DiagramBox, Frame};

use build::build;
use fold::Detail;
use items::Items;
use tilewright_circuit::ir::Design;

/// What to show of a design.
///
/// ```
/// use tilewright_gen::{Around, DiagramOptions};
///
/// // What feeds `count` and what `count` feeds, also inside the instances of the top module.
/// let around = Around { net: "count".to_owned(), steps: 1 };
/// let options = DiagramOptions { depth: 2, around: Some(around) };
/// assert_eq!(DiagramOptions::default(), DiagramOptions { depth: 1, around: None });
/// # let _ = options;
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DiagramOptions {
    /// The number of levels shown, at least 1: the top module, then the contents of its instances, and so on.
    pub depth: u32,
    /// Show only what feeds one net and what it feeds.
    pub around: Option<Around>,
}

impl Default for DiagramOptions {
    fn default() -> DiagramOptions {
        DiagramOptions { depth: 1, around: None }
    }
}

/// The surroundings of a net.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{Around, DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let around = Around { net: "word".to_owned(), steps: 1 };
/// let near = diagram(&design, &DiagramOptions { around: Some(around), ..DiagramOptions::default() }).unwrap();
/// assert_eq!(near.boxes.len(), 2); // the port, and the register that takes it
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Around {
    /// A port, register, memory, instance or named net, with the path of instances before its name: `u_merger.count`.
    pub net: String,
    /// The number of arrows followed forwards and backwards, at least 1.
    pub steps: u32,
}

/// The most boxes, arrows, and arrows per box of a readable diagram.
const BOXES: f64 = 24.0;
const ARROWS: f64 = 42.0;
const ARROWS_A_BOX: f64 = 3.0;

/// The weight of a control arrow: it says less than others.
const CONTROL: f64 = 1.5;

/// The most arrows of a diagram that shows all control.
const EASY_WITH_CONTROL: usize = 18;

/// The block diagram of a design.
///
/// Boxes are ports, instances, registers and memories. An arrow is any path through logic between two of them. A diagram with too much to read shows
/// less. First it leaves out control. Then items with the same neighbours share a box, then registers in a cycle, then those of a pipeline stage.
/// Many instances whose names differ only in a number share a box, too. Registers that feed assertions alone are not drawn.
///
/// # Errors
///
/// There is no such net, or the options ask for no level or no step.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let diagram = diagram(&design, &DiagramOptions::default()).unwrap();
/// assert!(diagram.svg().starts_with("<svg "));
/// ```
pub fn diagram(design: &Design, options: &DiagramOptions) -> Result<Diagram, DiagramError> {
    if options.depth == 0 || options.around.as_ref().is_some_and(|around| around.steps == 0) {
        return Err(DiagramError::Nothing);
    }
    let mut items = Items::of(design, options.depth);
    items.focus = options.around.as_ref().map(|around| around::focus(&mut items, around)).transpose()?;
    let wires = wires::wires(&items);
    let (shown, wires) = match (&options.around, items.focus) {
        (Some(around), Some(item)) => around::within(&items, &wires, item, around.steps),
        _ => (wires::live(&items, &wires), wires),
    };
    Ok(readable(|detail| build(&items, &wires, &shown, detail)))
}

/// The most detailed diagram that is readable, or else the one nearest to that.
fn readable(build: impl Fn(Detail) -> Diagram) -> Diagram {
    let mut best: Option<Diagram> = None;
    for detail in Detail::ALL {
        let next = build(detail);
        if load(&next) <= 1.0 && (detail > Detail::All || next.arrows.len() <= EASY_WITH_CONTROL) {
            return next;
        }
        if best.as_ref().is_none_or(|best| load(&next) < load(best)) {
            best = Some(next);
        }
    }
    best.expect("there are details")
}

/// How much there is to read; up to 1 is readable.
fn load(diagram: &Diagram) -> f64 {
    let weight = |arrow: &Arrow| if arrow.kind == ArrowKind::Control { CONTROL } else { 1.0 };
    let arrows: f64 = diagram.arrows.iter().map(weight).sum();
    let boxes = diagram.boxes.len() as f64;
    let a_box = diagram.arrows.len() as f64 / boxes.max(1.0);
    let most = (boxes / BOXES).max(arrows / ARROWS).max(a_box / ARROWS_A_BOX);
    // A reader takes frames one by one.
    most / (1.0 + diagram.frames.len().saturating_sub(1) as f64 / 4.0)
}

/// The words of the key about what is left out.
fn left_out(diagram: &Diagram) -> Option<String> {
    match diagram.hidden {
        0 => None,
        1 => Some("1 arrow of control is not drawn".to_owned()),
        hidden => Some(format!("{hidden} arrows of control are not drawn")),
    }
}

impl Diagram {
    /// The diagram as SVG, for light and dark pages and for paper. Full names appear where the mouse rests. It has no scripts.
    ///
    /// ```
    /// # use tilewright_hdl::elaborate;
    /// use tilewright_gen::{DiagramOptions, diagram};
    ///
    /// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
    /// let picture = diagram(&design, &DiagramOptions::default()).unwrap().svg();
    /// assert!(picture.contains(">held</text>"));
    /// ```
    pub fn svg(&self) -> String {
        svg::svg(self)
    }

    /// As [`svg`](Diagram::svg), with all boxes below one another. A narrow page shows a wide picture so small that its text is not legible.
    ///
    /// ```
    /// # use tilewright_hdl::elaborate;
    /// use tilewright_gen::{DiagramOptions, diagram};
    ///
    /// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
    /// let diagram = diagram(&design, &DiagramOptions::default()).unwrap();
    /// let width = |svg: String| svg.split("width=\"").nth(1)?.split('"').next()?.parse::<u32>().ok();
    /// assert!(width(diagram.narrow_svg()) < width(diagram.svg()));
    /// ```
    pub fn narrow_svg(&self) -> String {
        svg::narrow_svg(self)
    }

    /// The diagram as a graph for Graphviz.
    ///
    /// ```
    /// # use tilewright_hdl::elaborate;
    /// use tilewright_gen::{DiagramOptions, diagram};
    ///
    /// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
    /// let graph = diagram(&design, &DiagramOptions::default()).unwrap().dot();
    /// assert!(graph.contains("b0 -> b1;"));
    /// ```
    pub fn dot(&self) -> String {
        dot::dot(self)
    }

    /// The diagram in characters, for a terminal.
    ///
    /// ```
    /// # use tilewright_hdl::elaborate;
    /// use tilewright_gen::{DiagramOptions, diagram};
    ///
    /// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
    /// let text = diagram(&design, &DiagramOptions::default()).unwrap().ascii();
    /// let expected = "\
    /// Delay
    ///
    /// .--------.          +--------+          .--------.
    /// |  word  |          |  held  |          |  late  |
    /// | 8 bits |--------->| 8 bits |--------->| 8 bits |
    /// '--------'          >--------+          '--------'
    /// ";
    /// assert_eq!(text, expected);
    /// ```
    pub fn ascii(&self) -> String {
        ascii::ascii(self)
    }
}
