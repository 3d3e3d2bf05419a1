//! The boxes and arrows of small blocks.

use crate::blocks::Counter;
use tilewright_gen::{Around, ArrowKind, BoxKind, Diagram, DiagramError, DiagramOptions, diagram};
use tilewright_hdl::*;

fn shown(block: &impl Block) -> Diagram {
    diagram(&elaborate(block).unwrap(), &DiagramOptions::default()).unwrap()
}

fn around(block: &impl Block, net: &str, steps: u32) -> Result<Diagram, DiagramError> {
    let around = Some(Around { net: net.to_owned(), steps });
    diagram(&elaborate(block).unwrap(), &DiagramOptions { depth: 1, around })
}

fn boxes(diagram: &Diagram) -> Vec<(BoxKind, String, &str)> {
    diagram.boxes.iter().map(|it| (it.kind, it.names.join(","), &*it.note)).collect()
}

/// Each arrow as `from kind to`, with what is written beside it.
fn arrows(diagram: &Diagram) -> Vec<String> {
    let name = |index: usize| diagram.boxes[index].names.join(",");
    let text = |arrow: &tilewright_gen::Arrow| {
        let sign = match arrow.kind {
            ArrowKind::Stream => "=>",
            ArrowKind::Data => "->",
            ArrowKind::Control => "..>",
        };
        let label = arrow.label();
        let label = if label.is_empty() { label } else { format!(" ({label})") };
        format!("{} {sign} {}{label}", name(arrow.from), name(arrow.to))
    };
    diagram.arrows.iter().map(text).collect()
}

block! {
    /// Holds a job until it is taken.
    struct Slot;
    in SlotIn { jobs: stream(8) }
    out SlotOut { held: stream(8), busy: bit() }
}

impl Slot {
    fn build(&self, m: Module, i: SlotIn) -> SlotOut {
        def!(full = m.reg(bit()).reset(0));
        def!(job = m.reg(8));
        let (held, sent) = m.offer(full, *job);
        let jobs = i.jobs.take_when(!full | sent);
        job.when(jobs.taken, *jobs);
        full.when(jobs.taken, 1).when(sent, 0);
        m.assert(m.past(*full).implies(full | m.past(sent)), "a job stays until it is taken");
        SlotOut { held, busy: *full }
    }
}

block! {
    /// Two slots, and a table of what the second one gives.
    struct Squares;
    in SquaresIn { jobs: stream(8), masks: [bits(4); 2], enable: bit() }
    out SquaresOut { square: bits(8), busy: bit() }
}

impl Squares {
    fn build(&self, m: Module, i: SquaresIn) -> SquaresOut {
        let first = m.instance("u_first", &Slot, SlotIn { jobs: i.jobs });
        let second = m.instance("u_second", &Slot, SlotIn { jobs: first.held });
        let last = second.held.take_when(i.enable);
        def!(masked = last.payload.trunc(4) ^ i.masks[0] ^ i.masks[1]);
        def!(squares = m.memory(16, 8, ReadUnderWrite::Any).words((0..16).map(|x| x * x)));
        SquaresOut { square: squares.read(masked), busy: first.busy | second.busy }
    }
}

#[test]
fn logic_is_arrows_of_data_and_of_control() {
    let diagram = shown(&Counter { width: 4, limit: 10 });
    let port = |name: &str, kind| (kind, name.to_owned(), "1 bit");
    let expected = [
        port("enable", BoxKind::Input),
        (BoxKind::Register, "count".to_owned(), "4 bits"),
        (BoxKind::Output, "count".to_owned(), "4 bits"),
        port("wrapped", BoxKind::Output),
    ];
    assert_eq!(boxes(&diagram), expected);
    assert_eq!(arrows(&diagram), ["enable ..> count", "enable -> wrapped", "count -> count", "count -> wrapped"]);
}

#[test]
fn streams_go_from_instance_to_instance() {
    let diagram = shown(&Squares);
    let expected = [
        (BoxKind::Input, "jobs".to_owned(), "8 bits"),
        (BoxKind::Input, "masks[*]".to_owned(), "4 bits"),
        (BoxKind::Input, "enable".to_owned(), "1 bit"),
        (BoxKind::Instance, "u_first".to_owned(), "Slot"),
        (BoxKind::Instance, "u_second".to_owned(), "Slot"),
        (BoxKind::Memory, "squares".to_owned(), "table, 16 × 8 bits"),
        (BoxKind::Output, "square".to_owned(), "8 bits"),
        (BoxKind::Output, "busy".to_owned(), "1 bit"),
    ];
    assert_eq!(boxes(&diagram), expected);
    assert_eq!(diagram.boxes[1].count, "2");
    let expected = [
        "jobs => u_first",
        "masks[*] -> squares",
        // There is nothing else that it does.
        "enable ..> u_second (held)",
        "u_first => u_second (held)",
        "u_first -> busy",
        "u_second => squares (held)",
        "u_second -> busy",
        "squares -> square",
    ];
    assert_eq!(arrows(&diagram), expected);
}

#[test]
fn a_foreign_module_has_its_own_name_and_stays_closed() {
    block! {
        /// A flip-flop of an iCE40.
        struct FlipFlop;
        foreign = Foreign::module("SB_DFFSR").clock("C").reset("R").capitals();
        in FlipFlopIn { d: bit() }
        out FlipFlopOut { q: bit() }
    }
    impl FlipFlop {
        fn build(&self, m: Module, i: FlipFlopIn) -> FlipFlopOut {
            FlipFlopOut { q: *m.reg("sampled", 1).reset(0).when(i.d, 1) }
        }
    }
    block! {
        /// A flip-flop at a pin.
        struct Pin;
        in PinIn { pin: bit() }
        out PinOut { word: bit() }
    }
    impl Pin {
        fn build(&self, m: Module, i: PinIn) -> PinOut {
            PinOut { word: m.instance("u_pin", &FlipFlop, FlipFlopIn { d: i.pin }).q }
        }
    }
    let diagram = diagram(&elaborate(&Pin).unwrap(), &DiagramOptions { depth: 2, around: None }).unwrap();
    assert_eq!(boxes(&diagram)[1], (BoxKind::Instance, "u_pin".to_owned(), "SB_DFFSR"));
    assert_eq!(diagram.boxes.len(), 3);
}

#[test]
fn what_only_statements_read_is_not_drawn() {
    let diagram = shown(&Slot);
    let names: Vec<String> = boxes(&diagram).into_iter().map(|it| it.1).collect();
    assert_eq!(names, ["jobs", "full", "job", "held", "busy"]);
    let expected = ["jobs ..> full", "jobs => job", "full ..> job", "full ..> held", "full -> busy", "job => held"];
    assert_eq!(arrows(&diagram), expected);
}

#[test]
fn opened_instances_have_their_boxes_inside() {
    let design = elaborate(&Squares).unwrap();
    let diagram = diagram(&design, &DiagramOptions { depth: 2, around: None }).unwrap();
    assert_eq!(diagram.frames.iter().map(|it| &*it.name).collect::<Vec<_>>(), ["u_first", "u_second"]);
    let inside: Vec<(&str, Option<usize>)> =
        diagram.boxes.iter().filter(|it| it.kind == BoxKind::Register).map(|it| (&*it.members[0], it.frame)).collect();
    let expected = ["u_first.full", "u_first.job", "u_second.full", "u_second.job"];
    assert_eq!(inside.iter().map(|it| it.0).collect::<Vec<_>>(), expected);
    assert_eq!(inside.iter().map(|it| it.1).collect::<Vec<_>>(), [0, 0, 1, 1].map(Some));
    // From register to register, through both ports.
    assert!(arrows(&diagram).contains(&"job -> job".to_owned()), "{:?}", arrows(&diagram));
}

#[test]
fn around_a_net_is_what_leads_there_and_what_it_leads_to() {
    let near = around(&Squares, "masked", 1).unwrap();
    assert_eq!(arrows(&near), ["masks[*] -> masked", "u_second => masked (held)", "masked -> squares"]);
    let focus: Vec<bool> = near.boxes.iter().map(|it| it.is_focus).collect();
    assert_eq!((near.boxes.len(), focus.iter().filter(|it| **it).count()), (4, 1));
    let far = around(&Squares, "masked", 2).unwrap();
    assert_eq!(far.boxes.len(), 7);
    // Nor what else its sources feed.
    assert!(!boxes(&far).iter().any(|it| it.1 == "busy"));
    // A port is found by its name in Verilog, too.
    assert_eq!(around(&Squares, "jobs_payload", 1).unwrap().boxes.len(), 2);
}

#[test]
fn a_net_that_is_not_there_is_named_with_the_nearest() {
    let sentence = |net: &str, steps: u32| around(&Squares, net, steps).unwrap_err().to_string();
    assert_eq!(sentence("mask", 1), "there is no net `mask`: did you mean `masked`?");
    assert_eq!(
        sentence("frequency", 1),
        "there is no net `frequency`: name a port, register, memory, instance or named net of the levels shown, or show more levels"
    );
    assert_eq!(sentence("masked", 0), "depth and steps have to be at least 1: with less there is nothing to show");
    let design = elaborate(&Squares).unwrap();
    assert_eq!(diagram(&design, &DiagramOptions { depth: 0, around: None }), Err(DiagramError::Nothing));
}

block! {
    /// A pipeline of `count` stages with two words each.
    struct Stages { count: u32 }
    in StagesIn { left: bits(8), right: bits(8) }
    out StagesOut { mixed: bits(8) }
}

impl Stages {
    fn build(&self, m: Module, i: StagesIn) -> StagesOut {
        let (mut left, mut right) = (i.left, i.right);
        for stage in 0..self.count {
            let mixed = left ^ right;
            left = m.pipe(&format!("left{stage}"), mixed);
            right = m.pipe(&format!("right{stage}"), right + mixed);
        }
        StagesOut { mixed: left ^ right }
    }
}

#[test]
fn long_pipelines_are_a_box_a_stage() {
    let few = shown(&Stages { count: 3 });
    assert_eq!(boxes(&few).iter().filter(|it| it.0 == BoxKind::Register).count(), 6);
    let many = shown(&Stages { count: 12 });
    let registers: Vec<String> =
        boxes(&many).into_iter().filter(|it| it.0 == BoxKind::Register).map(|it| it.1).collect();
    let expected: Vec<String> = (0..12).map(|stage| format!("left{stage},right{stage}")).collect();
    assert_eq!(registers, expected);
    // Of very many stages, several share a box.
    let folded = shown(&Stages { count: 60 });
    assert!(folded.boxes.len() <= 24);
    assert_eq!(folded.boxes[1].names.last().unwrap(), "and 3 more");
    assert_eq!(folded.boxes[1].members.len(), 8);
}

block! {
    /// Slots one behind another.
    struct Row { count: u32 }
    in RowIn { jobs: stream(8) }
    out(self) RowOut { held: stream(8), busy: bits(self.count) }
}

impl Row {
    fn build(&self, m: Module, i: RowIn) -> RowOut {
        let (mut held, mut busy) = (i.jobs, Vec::new());
        for number in 0..self.count {
            let slot = m.instance(&format!("u_slot{number}"), &Slot, SlotIn { jobs: held });
            held = slot.held;
            busy.push(slot.busy);
        }
        RowOut { held, busy: concat(&busy) }
    }
}

#[test]
fn numbered_instances_are_one_box_where_they_are_too_many() {
    let instances = |diagram: &Diagram| {
        let all = diagram.boxes.iter().filter(|it| it.kind == BoxKind::Instance);
        all.map(|it| (it.names[0].clone(), it.count.clone())).collect::<Vec<_>>()
    };
    assert_eq!(instances(&shown(&Row { count: 5 })).len(), 5);
    let many = shown(&Row { count: 40 });
    assert_eq!(instances(&many), [("u_slot[*]".to_owned(), "40".to_owned())]);
    assert_eq!(arrows(&many), ["jobs => u_slot[*]", "u_slot[*] => held", "u_slot[*] -> busy"]);
    assert!(many.boxes[1].members.contains(&"u_slot39".to_owned()));
}

#[test]
fn the_net_that_is_asked_for_is_never_one_of_a_folded_row() {
    let near = around(&Row { count: 40 }, "u_slot20", 30).unwrap();
    let focus: Vec<&[String]> = near.boxes.iter().filter(|it| it.is_focus).map(|it| &it.names[..]).collect();
    assert_eq!(focus, [["u_slot20"]]);
}

#[test]
fn graphviz_is_told_of_frames_and_arrows() {
    let design = elaborate(&Squares).unwrap();
    let dot = diagram(&design, &DiagramOptions { depth: 2, around: None }).unwrap().dot();
    let lines: Vec<&str> = dot.lines().map(str::trim).collect();
    for line in ["digraph \"Squares\" {", "subgraph cluster_0 {", "label=\"u_first\";", "rankdir=LR;"] {
        assert!(lines.contains(&line), "{line} is not in\n{dot}");
    }
    assert_eq!(dot.matches('{').count(), dot.matches('}').count());
    assert!(dot.contains("[penwidth=3];") && dot.contains("[style=dashed];"), "{dot}");
}
