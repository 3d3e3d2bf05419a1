//! Records that are declared with their widths.

use tilewright_hdl::*;

codes! {
    enum Source { Constant, Memory, Tree }
}

record! {
    /// What a processor does.
    struct Control {
        /// Where its operand comes from.
        source: one_of::<Source>(),
        /// The operand.
        constant: bits(8),
    }

    /// A place.
    struct Position(columns: u32, rows: u32,) { x: below(columns), y: below(rows) }

    /// All kinds of fields.
    struct Everything(side: u32) {
        lanes: bits(8).of(row(4)),
        control: Control,
        place: Position::widths(side, 2 * side),
        other: Position = Position::widths(side, side),
        here: struct Mark { page: bits(4), last: bit() },
        given: Given { page: bits(3) },
        list: [bits(6); 3],
        controls: [Control; 2],
        places: [Position::widths(side, side); 2],
        bytes: stream(bits(8)),
        jobs: stream(Control),
        moves: stream(Position::widths(side, side)),
        sources: [stream(Control); 2],
    }

    struct Pair { left: Control, right: Control, stream: stream(Control) }
}

bundle! {
    struct Given<T> { page: T }
}

#[test]
fn each_kind_of_field_has_its_width() {
    let leaves = Everything::widths(100).leaves();
    let widths: Vec<_> = leaves.iter().map(|(path, width)| format!("{path} {}", width.bits())).collect();
    assert_eq!(
        widths.join(", "),
        "lanes 8, control.source 2, control.constant 8, place.x 7, place.y 8, other.x 7, other.y 7, here.page 4, here.last 1, given.page 3, \
         list.0 6, list.1 6, list.2 6, controls.0.source 2, controls.0.constant 8, controls.1.source 2, controls.1.constant 8, \
         places.0.x 7, places.0.y 7, places.1.x 7, places.1.y 7, bytes.valid 1, bytes.ready 1, bytes.payload 8, \
         jobs.valid 1, jobs.ready 1, jobs.source 2, jobs.constant 8, moves.valid 1, moves.ready 1, moves.x 7, moves.y 7, \
         sources.0.valid 1, sources.0.ready 1, sources.0.source 2, sources.0.constant 8, \
         sources.1.valid 1, sources.1.ready 1, sources.1.source 2, sources.1.constant 8"
    );
    assert_eq!(leaves[0].1.shape(), row(4));
}

#[test]
fn zeros_are_constants() {
    const MEMORY: Control<u64> = Control { source: 1, ..Control::ZERO };
    const PAIR: Pair<u64> = Pair { left: MEMORY, ..Pair::ZERO };
    assert_eq!(PAIR.leaves().iter().map(|(_, number)| *number).collect::<Vec<_>>(), [1, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(Position::ZERO, Position { x: 0, y: 0 });
}

const FAST: Clock = Clock::new("fast", Period::ns(2));

block! {
    /// Takes records by their names.
    struct Takes { side: u32 }
    in(self) TakesIn {
        control: Control,
        clocked: Control.on(FAST),
        place: Position::widths(self.side, self.side),
        clocked_place: Position::widths(self.side, self.side).on(FAST),
        controls: [Control; 2],
        places: [Position::widths(self.side, self.side); 2],
        clocked_list: [Control.on(FAST); 2],
        jobs: stream(Control),
        moves: stream(Position::widths(self.side, self.side)).on(FAST),
        all: [stream(Control); 2],
    }
    out TakesOut {
        control_out: Control,
        jobs_out: stream(Control),
    }
}

impl Takes {
    fn build(&self, m: Module, i: TakesIn) -> TakesOut {
        i.moves.take_when(1);
        i.all.iter().for_each(|jobs| _ = jobs.take_when(1));
        m.ignore(&i);
        TakesOut { control_out: i.control, jobs_out: i.jobs }
    }
}

#[test]
fn a_port_is_declared_by_the_name_of_its_record() {
    let design = elaborate(&Takes { side: 16 }).unwrap();
    let inputs: Vec<_> = design.top().inputs.iter().map(|port| port.name.as_str()).collect();
    assert_eq!(inputs[..4], ["control_source", "control_constant", "clocked_source", "clocked_constant"]);
    assert_eq!(design.top().about.inputs["control.source"], "Where its operand comes from.");
}

#[test]
fn a_clock_may_stand_behind_the_name_of_a_record() {
    let inputs = Takes { side: 16 }.inputs().leaves();
    let on_fast = inputs.iter().filter(|(_, width)| format!("{width:?}").contains("fast"));
    assert_eq!(
        on_fast.map(|(path, _)| path.as_str()).collect::<Vec<_>>().join(", "),
        "clocked.source, clocked.constant, clocked_place.x, clocked_place.y, clocked_list.0.source, clocked_list.0.constant, \
         clocked_list.1.source, clocked_list.1.constant, moves.valid, moves.ready, moves.x, moves.y"
    );
}

block! {
    /// Has records as all of its inputs and of its outputs.
    struct Whole { side: u32 }
    in = Control;
    out(self) = Position::widths(self.side, 2 * self.side);
}

impl Whole {
    fn build(&self, m: Module, i: Control) -> Position {
        m.ignore(&i.source);
        Position { x: i.constant.trunc(4), y: i.constant.trunc(5) }
    }
}

#[test]
fn a_record_may_be_all_ports_of_a_block() {
    let design = elaborate(&Whole { side: 16 }).unwrap();
    let ports = |names: &mut dyn Iterator<Item = &str>| names.collect::<Vec<_>>().join(", ");
    let top = design.top();
    assert_eq!(ports(&mut top.inputs.iter().map(|port| &*port.name)), "source, constant");
    assert_eq!(ports(&mut top.outputs.iter().map(|port| &*port.name)), "x, y");
    assert_eq!(top.outputs.iter().map(|port| top.node(port.node).width).collect::<Vec<_>>(), [4, 5]);
    assert_eq!(top.about.inputs["source"], "Where its operand comes from.");
}
