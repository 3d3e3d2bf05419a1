//! What is drawn: boxes, the arrows between them, and the frames of instances that are opened.

/// A block diagram of a circuit.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
/// let diagram = diagram(&design, &DiagramOptions::default()).unwrap();
/// let names: Vec<&str> = diagram.boxes.iter().map(|it| &*it.names[0]).collect();
/// assert_eq!(names, ["word", "held", "late"]);
/// assert_eq!(diagram.arrows.len(), 2);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagram {
    /// The name of the top module.
    pub title: String,
    /// The boxes: ports that come in first, those that go out last.
    pub boxes: Vec<DiagramBox>,
    /// The arrows, in the order of the boxes that they leave and enter; one a kind between any two boxes.
    pub arrows: Vec<Arrow>,
    /// The instances that are opened, each before those inside of it.
    pub frames: Vec<Frame>,
    /// The clocks of the top module, if there are several.
    pub clocks: Vec<String>,
    /// How many arrows of control are left out, as there are too many to be read.
    pub hidden: usize,
}

/// What a box stands for.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{BoxKind, DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
/// let kinds = diagram(&design, &DiagramOptions::default()).unwrap().boxes.into_iter().map(|it| it.kind);
/// assert_eq!(kinds.collect::<Vec<_>>(), [BoxKind::Input, BoxKind::Register, BoxKind::Output]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum BoxKind {
    /// Ports that come in.
    Input,
    /// An instance that is not opened, or an array of them.
    Instance,
    /// A memory, or several with the same neighbours.
    Memory,
    /// A register, or several that belong together.
    Register,
    /// A net that was asked for, though it is logic.
    Net,
    /// Ports that go out.
    Output,
}

/// A box.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
/// let held = &diagram(&design, &DiagramOptions::default()).unwrap().boxes[1];
/// assert_eq!((&held.names[..], &*held.note), (&["held".to_owned()][..], "8 bits"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DiagramBox {
    /// What it stands for.
    pub kind: BoxKind,
    /// The names in it, each a line: more than one if several things are one box, and of many the first.
    pub names: Vec<String>,
    /// What is said below the names: the block of an instance, the size of a memory, the width of a register or a port.
    pub note: String,
    /// How many there are, such as `16` or `4 × 8`; empty for one.
    pub count: String,
    /// It is a port that is a stream.
    pub is_stream: bool,
    /// It is what the diagram is around.
    pub is_focus: bool,
    /// Its clocks, as indices of [`Diagram::clocks`]; none where that is empty.
    pub clocks: Vec<usize>,
    /// The index of the frame that it is in.
    pub frame: Option<usize>,
    /// Everything that it stands for, by its full name.
    pub members: Vec<String>,
}

/// How an arrow is drawn.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{ArrowKind, DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
/// let arrows = diagram(&design, &DiagramOptions::default()).unwrap().arrows;
/// assert!(arrows.iter().all(|arrow| arrow.kind == ArrowKind::Data));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ArrowKind {
    /// What a stream carries, with its handshake.
    Stream,
    /// Values.
    Data,
    /// What decides when something changes, and which value is chosen.
    Control,
}

/// An arrow between two boxes: all signals of one kind that lead from the one to the other, through any logic.
///
/// ```
/// # use tilewright_hdl::elaborate;
/// use tilewright_gen::{DiagramOptions, diagram};
///
/// let design = elaborate(&tilewright_gen::for_examples::Delay).unwrap();
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
    /// The ports of instances that it leaves or enters, where they are called otherwise than the boxes.
    pub signals: Vec<String>,
}

/// An instance that is opened: a frame around what is inside.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_gen::for_examples::{Delay, DelayIn};
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
    /// How many there are, such as `16`; empty for one.
    pub count: String,
    /// The index of the frame that it is in.
    pub frame: Option<usize>,
}

impl Arrow {
    /// What is written beside it: the signals, or the first and how many others; empty where the boxes say it all.
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

/// The longest list of signals that is written out, in characters.
const LONGEST_LABEL: usize = 18;
