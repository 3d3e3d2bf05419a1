//! Block diagrams: the boxes and arrows that a paper about the hardware would show, drawn from the circuit.
//!
//! [`items`] lists what a box can stand for, [`wires`] finds the paths through logic between these, [`fold`] says what is one box, and [`build`]
//! makes a [`Diagram`] of it. [`layout`] says where everything is, once in pixels and once in characters.

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
use tilewright_hdl::ir::Design;

/// What is shown of a design.
///
/// ```
/// use tilewright_gen::{Around, DiagramOptions};
///
/// // What feeds `count` and what `count` feeds, also inside of the instances of the top module.
/// let around = Around { net: "count".to_owned(), steps: 1 };
/// let options = DiagramOptions { depth: 2, around: Some(around) };
/// assert_eq!(DiagramOptions::default(), DiagramOptions { depth: 1, around: None });
/// # let _ = options;
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DiagramOptions {
    /// How many levels are shown, at least 1: the top module, then its instances opened, then theirs.
    pub depth: u32,
    /// Only what leads to one net, or it leads to; all without.
    pub around: Option<Around>,
}

impl Default for DiagramOptions {
    fn default() -> DiagramOptions {
        DiagramOptions { depth: 1, around: None }
    }
}

/// What leads to a net, and what it leads to.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{Around, DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
/// let around = Around { net: "word".to_owned(), steps: 1 };
/// let near = diagram(&design, &DiagramOptions { around: Some(around), ..DiagramOptions::default() }).unwrap();
/// assert_eq!(near.boxes.len(), 2); // the port, and the register that takes it
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Around {
    /// The name of a port, register, memory, instance or named net, with those of the instances that it is in, as `u_merger.count`.
    pub net: String,
    /// How many arrows are followed in both directions, at least 1.
    pub steps: u32,
}

/// The most boxes and arrows that are read with ease, and the most arrows a box.
const BOXES: f64 = 24.0;
const ARROWS: f64 = 42.0;
const ARROWS_A_BOX: f64 = 3.0;

/// How many others an arrow of control is to read, as it says less.
const CONTROL: f64 = 1.5;

/// The most arrows where those of control are drawn, too.
const EASY_WITH_CONTROL: usize = 18;

/// The block diagram of a design.
///
/// Logic is an arrow from where its values come from to what takes them, at each end an instance, a register, a memory or a port. Where that would
/// be too much to read, less is shown: first no control, then as one box what has the same neighbours, registers in a cycle, those of a stage,
/// and instances whose names differ in their numbers alone. Every stream stays. What only statements read is not drawn.
///
/// # Errors
///
/// There is no such net, or nothing is to be shown.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
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

/// The first of the diagrams, from the one with all detail to that with least, that is read with ease; or that which comes nearest to it.
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

/// How much there is to read; 1 is the most that is read with ease.
fn load(diagram: &Diagram) -> f64 {
    let weight = |arrow: &Arrow| if arrow.kind == ArrowKind::Control { CONTROL } else { 1.0 };
    let arrows: f64 = diagram.arrows.iter().map(weight).sum();
    let boxes = diagram.boxes.len() as f64;
    let a_box = diagram.arrows.len() as f64 / boxes.max(1.0);
    let most = (boxes / BOXES).max(arrows / ARROWS).max(a_box / ARROWS_A_BOX);
    // Frames are read one by one.
    most / (1.0 + diagram.frames.len().saturating_sub(1) as f64 / 4.0)
}

/// What the key says of what is left out.
fn left_out(diagram: &Diagram) -> Option<String> {
    match diagram.hidden {
        0 => None,
        1 => Some("1 arrow of control is not drawn".to_owned()),
        hidden => Some(format!("{hidden} arrows of control are not drawn")),
    }
}

impl Diagram {
    /// As a picture: SVG that suits light and dark pages and paper, without scripts, and with the full names where the mouse rests.
    ///
    /// ```
    /// # use tilewright_hdl::elaborate;
    /// use tilewright_gen::{DiagramOptions, diagram};
    ///
    /// let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
    /// let picture = diagram(&design, &DiagramOptions::default()).unwrap().svg();
    /// assert!(picture.contains(">held</text>"));
    /// ```
    pub fn svg(&self) -> String {
        svg::svg(self)
    }

    /// As a graph for Graphviz.
    ///
    /// ```
    /// # use tilewright_hdl::elaborate;
    /// use tilewright_gen::{DiagramOptions, diagram};
    ///
    /// let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
    /// let graph = diagram(&design, &DiagramOptions::default()).unwrap().dot();
    /// assert!(graph.contains("b0 -> b1;"));
    /// ```
    pub fn dot(&self) -> String {
        dot::dot(self)
    }

    /// In characters, for a terminal.
    ///
    /// ```
    /// # use tilewright_hdl::elaborate;
    /// use tilewright_gen::{DiagramOptions, diagram};
    ///
    /// let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
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
