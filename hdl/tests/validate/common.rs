//! The design that the tests edit, and the comparison of the first sentence of its problem with a text.

use tilewright_hdl::ir::*;
use tilewright_hdl::{
    Bits, Clock, Design, Fields as _, Module as M, Period, ReadUnderWrite, bit, bits, block, case, cat, codes,
    elaborate, mux, select, stack,
};

block! {
    /// A register and a path past it.
    struct Stage;
    in StageIn { a: bits(8), enable: bit() }
    out StageOut { at_once: _, later: _ }
}

impl Stage {
    fn build(&self, m: M, i: StageIn) -> StageOut {
        let q = m.reg("q", 8).reset(3).enable(i.enable);
        q.next(i.a);
        StageOut { at_once: (!i.a).named("inverted"), later: *q }
    }
}

const FAST: Clock = Clock::new("fast", Period::ns(4));

codes! { enum Phase { Idle, Run, Done } }

block! {
    /// Every operator and every object, most of them named.
    struct Top;
    in TopIn { a: bits(8), b: bits(8), c: bit() }
    out TopOut { sum: _, last: _, found: _, other: _ }
}

impl Top {
    fn build(&self, m: M, i: TopIn) -> TopOut {
        let sum = (i.a + i.b).named("add");
        let product = (i.a * i.b).named("product");
        let less = i.a.lt(i.b).named("less");
        let any = i.a.any_one().named("any");
        let shifted = (i.a << i.b).named("shifted");
        let chosen = mux(i.c, i.a, i.b).named("chosen");
        let first = select([(less, i.a), (any, i.b)], 7).named("first");
        let keyed = case(i.a, [(1, i.b), (2, i.a)], 0).named("keyed");
        let part = i.a.slice(2..5).named("part");
        let both = cat![i.a, i.c].named("both");
        let twice = part.repeat(2).named("twice");
        let wide = part.sext(8).named("wide");
        let phase = m.fsm("phase", Phase::Idle);
        phase.next(|_| tilewright_hdl::when(i.c, Phase::Run));
        let words = m.memory("words", 5, 8, ReadUnderWrite::Old).words([Bits::new(8, 9)]);
        words.write(i.c, part, sum);
        let read = words.read_when(i.c, part);
        let found = words.read_async(part).named("found_now");
        m.assert(i.c | less, "c or less");
        let one = m.instance("u_one", &Stage, StageIn { a: chosen, enable: i.c });
        let cells = m.array("u_cells", 4, &Stage, |cells| StageIn { a: cells.at_once.previous(i.a), enable: i.c });
        let each: StageIn = StageIn { a: cells.later, enable: cells.at_once };
        let listed = m.array("u_listed", 2, &Stage, |_| StageIn { a: stack([i.a, i.b]), enable: i.c });
        let fast = m.on(FAST).pipe("fast_c", i.c.quasi_static("set once").named("slow"));
        let all = each.map(|lanes| *lanes).leaves();
        let lane = all[0].1.lane(2).named("lane_two") ^ listed.later.lane(1);
        let other = cat![product, shifted, keyed, twice, wide, both, first, read, one.at_once, one.later, *phase];
        let other = cat![other, cells.at_once.sum().named("total"), fast.named("at_fast").quasi_static("shown only")];
        TopOut { sum, last: lane, found, other: other.parity() }
    }
}

/// The modules of the design, and ids in its top.
pub struct Edit {
    pub modules: Vec<Module>,
}

impl Edit {
    pub fn top(&mut self) -> &mut Module {
        self.modules.last_mut().unwrap()
    }

    pub fn stage(&mut self) -> &mut Module {
        &mut self.modules[0]
    }

    pub fn id(&mut self, name: &str) -> NodeId {
        let named = |node: &Node| node.name.as_deref() == Some(name);
        NodeId(self.top().nodes.iter().position(named).unwrap_or_else(|| panic!("no {name}")) as u32)
    }

    pub fn node(&mut self, name: &str) -> &mut Node {
        let id = self.id(name);
        &mut self.top().nodes[id.0 as usize]
    }

    /// The first node with such an operator.
    pub fn first(&mut self, is: fn(&Op) -> bool) -> &mut Node {
        self.top().nodes.iter_mut().find(|node| is(&node.op)).unwrap()
    }

    pub fn op(&mut self, name: &str, change: impl FnOnce(&mut Op)) {
        change(&mut self.node(name).op);
    }
}

pub fn design() -> Design {
    elaborate(&Top).unwrap()
}

/// The problems after an edit, without places and help.
pub fn problems(edit: impl FnOnce(&mut Edit)) -> Vec<String> {
    let mut it = Edit { modules: design().into_modules() };
    edit(&mut it);
    match Design::new(it.modules) {
        Ok(_) => Vec::new(),
        Err(problems) => problems.0.into_iter().map(|problem| problem.message).collect(),
    }
}

/// The edit is rejected, and this is the first sentence.
#[track_caller]
pub fn refused(sentence: &str, edit: impl FnOnce(&mut Edit)) {
    let found = problems(edit);
    assert_eq!(found.first().map(String::as_str), Some(sentence), "{found:#?}");
}
