//! What is drawn: boxes, arrows between them, and frames around opened instances.

/// A block diagram of a circuit.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let diagram = diagram(&design, &DiagramOptions::default()).unwrap();
/// let names: Vec<&str> = diagram.boxes.iter().map(|it| &*it.names[0]).collect();
/// assert_eq!(names, ["word", "held", "late"]);
/// assert_eq!(diagram.arrows.len(), 2);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagram {
    /// The name of the top module.
    pub title: String,
    /// The boxes: input ports first, output ports last.
    pub boxes: Vec<DiagramBox>,
    /// The arrows, sorted by source and target; at most one of a kind between two boxes.
    pub arrows: Vec<Arrow>,
    /// The opened instances, each before those inside it.
    pub frames: Vec<Frame>,
    /// The clocks of the top module; empty if there is one.
    pub clocks: Vec<String>,
    /// The number of control arrows left out to keep the diagram readable.
    pub hidden: usize,
}

/// What a box stands for.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{BoxKind, DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let kinds = diagram(&design, &DiagramOptions::default()).unwrap().boxes.into_iter().map(|it| it.kind);
/// assert_eq!(kinds.collect::<Vec<_>>(), [BoxKind::Input, BoxKind::Register, BoxKind::Output]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum BoxKind {
    /// Input ports.
    Input,
    /// An instance or an array of instances that is not opened.
    Instance,
    /// A memory, or several with the same neighbours.
    Memory,
    /// A register, or several that belong together.
    Register,
    /// A named net of logic that the diagram is drawn around.
    Net,
    /// Output ports.
    Output,
}

/// A box.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let held = &diagram(&design, &DiagramOptions::default()).unwrap().boxes[1];
/// assert_eq!((&held.names[..], &*held.note), (&["held".to_owned()][..], "8 bits"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DiagramBox {
    /// What it stands for.
    pub kind: BoxKind,
    /// The lines of names in it. Where several things share a box, the first names, and how many more there are.
    pub names: Vec<String>,
    /// The line below the names: an instance's block, a memory's size, or a width.
    pub note: String,
    /// The size of an array, such as `16` or `4×8`; empty for a single one.
    pub count: String,
    /// It is a port that is a stream.
    pub is_stream: bool,
    /// The diagram is drawn around it.
    pub is_focus: bool,
    /// Its clocks, as indices into [`Diagram::clocks`]; empty if the design has one clock.
    pub clocks: Vec<usize>,
    /// The index of the frame that it is in.
    pub frame: Option<usize>,
    /// The full names of everything it stands for.
    pub members: Vec<String>,
}

/// How an arrow is drawn.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{ArrowKind, DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let arrows = diagram(&design, &DiagramOptions::default()).unwrap().arrows;
/// assert!(arrows.iter().all(|arrow| arrow.kind == ArrowKind::Data));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ArrowKind {
    /// The payload of a stream, with its handshake.
    Stream,
    /// Values.
    Data,
    /// Conditions: enables, and selects of multiplexers.
    Control,
}

/// An arrow between two boxes: all signals of one kind from one to the other, through any logic.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_sim::for_examples::Delay).unwrap();
/// let arrow = &diagram(&design, &DiagramOptions::default()).unwrap().arrows[0];
/// assert_eq!((arrow.from, arrow.to), (0, 1)); // from the port to the register
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Arrow {
    /// The index of the box that it leaves.
    pub from: usize,
    /// The index of the box that it enters.
    pub to: usize,
    /// How it is drawn.
    pub kind: ArrowKind,
    /// The instance ports at its ends, where their names differ from the box at the other end.
    pub signals: Vec<String>,
}

/// An opened instance: a frame around its contents.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_sim::for_examples::{Delay, DelayIn};
/// # block! {
/// #     struct Pair;
/// #     in PairIn { word: bits(8) }
/// #     out PairOut { late: bits(8) }
/// # }
/// # impl Pair {
/// #     fn build(&self, m: Module, i: PairIn) -> PairOut {
/// let first = m.instance("u_first", &Delay, DelayIn { word: i.word }).late;
/// #         PairOut { late: m.instance("u_second", &Delay, DelayIn { word: first }).late }
/// #     }
/// # }
/// use tilewright_gen::{DiagramOptions, diagram};
///
/// let design = elaborate(&Pair)?;
/// let opened = diagram(&design, &DiagramOptions { depth: 2, ..DiagramOptions::default() }).unwrap();
/// assert_eq!(opened.frames.iter().map(|frame| &*frame.name).collect::<Vec<_>>(), ["u_first", "u_second"]);
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Frame {
    /// The instance's name.
    pub name: String,
    /// The size of an array, such as `16`; empty for a single one.
    pub count: String,
    /// The index of the frame that it is in.
    pub frame: Option<usize>,
}

impl Arrow {
    /// The text beside it: the signals, or the first and the number of others.
    ///
    /// ```
    /// use tilewright_gen::{Arrow, ArrowKind};
    ///
    /// let mut arrow = Arrow { from: 0, to: 1, kind: ArrowKind::Data, signals: vec!["scan".to_owned()] };
    /// assert_eq!(arrow.label(), "scan");
    /// arrow.signals.extend(["the_first_of_many", "and_the_second"].map(str::to_owned));
    /// assert_eq!(arrow.label(), "scan +2");
    /// ```
    pub fn label(&self) -> String {
        let all = self.signals.join(", ");
        match &self.signals[..] {
            [] => String::new(),
            [first, others @ ..] if all.chars().count() > LONGEST_LABEL && !others.is_empty() => {
                format!("{first} +{}", others.len())
            }
            _ => all,
        }
    }
}

/// The longest list of signals written out, in characters.
const LONGEST_LABEL: usize = 18;
