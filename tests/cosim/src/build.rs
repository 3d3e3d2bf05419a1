//! Random designs as hardware.

use crate::spec::*;
use std::fmt;
use std::rc::Rc;
use tilewright_hdl::ir::{Reduction, Relation, Shift};
use tilewright_hdl::*;

bundle! {
    /// The inputs of a part, by clock.
    pub struct PartIn<T> {
        /// On the module's own clock.
        pub own: Vec<T>,
        /// On the second clock.
        pub second: Vec<T>,
    }
    /// The outputs of a part, by clock.
    pub struct PartOut<T> {
        /// On the module's own clock.
        pub out: Vec<T>,
        /// On the second clock.
        pub second_out: Vec<T>,
        /// For each input on the own clock that has a link, a value of its width.
        pub link: Vec<T>,
        /// For each input on the second clock that has a link, a value of its width.
        pub second_link: Vec<T>,
    }
}

states! {
    enum Phase { Idle, Load, Run, Drain }
}

/// A part of a random design, as a block.
#[derive(Clone)]
pub struct PartBlock {
    /// Goes before the name of each module.
    pub prefix: String,
    /// The design.
    pub spec: Rc<Spec>,
    /// The part's place in it.
    pub index: usize,
}

/// The name alone: the prefix tells designs apart.
impl fmt::Debug for PartBlock {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}_part{}", self.prefix, self.index)
    }
}

/// The top of a random design, with names that begin with `prefix`.
pub fn top(spec: &Spec, prefix: &str) -> PartBlock {
    PartBlock { prefix: prefix.to_owned(), spec: Rc::new(spec.clone()), index: spec.parts.len() - 1 }
}

impl PartBlock {
    fn part(&self) -> &Part {
        &self.spec.parts[self.index]
    }

    fn second(&self) -> Option<Clock> {
        self.spec.second_period.map(|period| Clock::new("second", Period::ps(period)))
    }

    /// The clock's place in the bundles.
    fn domain(&self, clock: ClockPick) -> usize {
        usize::from(clock == ClockPick::Second && self.spec.second_period.is_some())
    }

    fn inputs_on(&self, domain: usize) -> impl Iterator<Item = &Input> {
        self.part().inputs.iter().filter(move |input| self.domain(input.clock) == domain)
    }
}

impl Block for PartBlock {
    type In = PartIn;
    type Out = PartOut;

    fn inputs(&self) -> PartIn<Width> {
        let own = self.inputs_on(0).map(|input| bits(input.width)).collect();
        let second = self.second().map(|clock| self.inputs_on(1).map(|input| bits(input.width).on(clock)).collect());
        PartIn { own, second: second.unwrap_or_default() }
    }

    fn build(&self, m: Module, i: PartIn) -> PartOut {
        m.ignore(&i);
        let mut builder = Builder::new(self, m, [i.own, i.second]);
        for (number, step) in self.part().steps.iter().enumerate() {
            builder.step(number, step);
        }
        builder.finish()
    }

    fn name(&self) -> String {
        format!("{self:?}")
    }
}

/// A value that later steps may pick.
struct Value {
    signal: Signal,
    /// Something observable depends on it.
    is_read: bool,
}

/// A connection made when all values are known.
enum Late {
    Next(Reg, Pick),
    Write { memory: Mem, enable: Signal, address: Signal, data: Pick },
}

struct Builder<'a> {
    block: &'a PartBlock,
    module: Module,
    /// By clock.
    pools: [Vec<Value>; 2],
    late: Vec<(usize, Late)>,
}

impl<'a> Builder<'a> {
    fn new(block: &'a PartBlock, module: Module, inputs: [Vec<Signal>; 2]) -> Self {
        let pools = inputs.map(|of| of.into_iter().map(|signal| Value { signal, is_read: true }).collect());
        let mut builder = Builder { block, module, pools, late: Vec::new() };
        if block.second().is_some() {
            // With state on the own clock, inputs that name no clock belong to it.
            let beat = module.reg("beat", 1).reset(0);
            beat.next(!beat);
            builder.push(0, beat.value());
        }
        builder
    }

    fn push(&mut self, domain: usize, signal: Signal) {
        self.pools[domain].push(Value { signal, is_read: false });
    }

    /// Odd picks favour recent values, so that expressions get deep; 0 is the first value.
    fn index(&self, domain: usize, pick: Pick) -> Option<usize> {
        let count = self.pools[domain].len();
        match usize::from(pick.0) {
            _ if count == 0 => None,
            number if number % 2 == 1 => Some(count - 1 - (number / 2 % 4).min(count - 1)),
            number => Some(number / 2 % count),
        }
    }

    fn pick(&mut self, domain: usize, pick: Pick) -> Signal {
        let Some(index) = self.index(domain, pick) else { return lit(1, 1) };
        self.pools[domain][index].is_read = true;
        self.pools[domain][index].signal
    }

    fn pick_fit(&mut self, domain: usize, pick: Pick, width: u32) -> Signal {
        let signal = self.pick(domain, pick);
        fit(signal, width, pick)
    }

    /// A pick that does not make its value observed: the way to an output may lead through itself.
    fn pick_late(&self, domain: usize, pick: Pick, width: u32) -> Signal {
        match self.index(domain, pick) {
            Some(index) => fit(self.pools[domain][index].signal, width, pick),
            None => fit(lit(1, 1), width, pick),
        }
    }

    /// The module seen from a clock.
    fn on(&self, domain: usize) -> Module {
        match self.block.second() {
            Some(clock) if domain == 1 => self.module.on(clock),
            _ => self.module,
        }
    }

    fn step(&mut self, number: usize, step: &Step) {
        let d = self.block.domain(step.clock);
        match &step.make {
            Make::Register { width, reset, enable, next } => {
                let mut register = self.on(d).reg(&format!("r{number}"), *width);
                if let Some(reset) = reset {
                    register = register.reset(reset.bits(*width));
                }
                if let Some(enable) = enable {
                    register = register.enable(self.pick_fit(d, *enable, 1));
                }
                self.push(d, register.value());
                self.late.push((d, Late::Next(register, *next)));
            }
            Make::Machine(machine) => self.machine(d, number, machine),
            Make::Memory(memory) => self.memory(d, number, memory),
            Make::Cross { synchronize, of } => self.cross(d, number, *synchronize, *of),
            Make::Assert(pick) => {
                let signal = self.pick(d, *pick);
                self.on(d).assert(signal.le(Bits::ones(signal.width())), "a value is at most all ones");
            }
            Make::Instance { part, inputs } => self.instance(d, number, *part, inputs),
            Make::Array { part, lanes, towards_lower, inputs, outputs } => {
                if let Some(child) = self.child(*part) {
                    let by = if *towards_lower { -1 } else { 1 };
                    self.array(d, number, &child, Row { lanes: *lanes, by, inputs, outputs });
                }
            }
            make => {
                let signal = self.expression(d, number, make);
                self.push(d, signal);
            }
        }
    }

    fn expression(&mut self, d: usize, number: usize, make: &Make) -> Signal {
        match make {
            Make::Constant(width, pattern) => match pattern.bits(*width).to_u64() {
                Some(number) => lit(*width, number),
                None => lit(*width, 0) | pattern.bits(*width),
            },
            Make::Unary(op, a) => {
                let a = self.pick(d, *a);
                match op {
                    Unary::Not => !a,
                    Unary::Negative => (-a.signed()).bits(),
                    Unary::AllOnes => a.all_ones(),
                    Unary::AnyOne => a.any_one(),
                    Unary::Parity => a.parity(),
                }
            }
            Make::Binary(op, a, b) => {
                let a = self.pick(d, *a);
                let b = self.pick_fit(d, *b, a.width());
                match op {
                    Binary::And => a & b,
                    Binary::Or => a | b,
                    Binary::Xor => a ^ b,
                    Binary::Add => a + b,
                    Binary::Sub => a - b,
                    Binary::AddCarry => narrow(a.add_carry(b)),
                }
            }
            Make::Product { signed, operands } => {
                let [a, b] = operands.map(|pick| self.pick(d, pick));
                let [a, b] = [a, b].map(|s| s.trunc(s.width().min(WIDEST / 2)));
                if *signed { (a.signed() * b.signed()).bits() } else { a * b }
            }
            Make::Compare { relation, signed, operands: [a, b] } => {
                let a = self.pick(d, *a);
                let b = self.pick_fit(d, *b, a.width());
                compare(*relation, *signed, a, b)
            }
            Make::Shift { shift, of, by } => {
                let (of, by) = (self.pick(d, *of), self.pick(d, *by));
                match shift {
                    Shift::Left => of << by,
                    Shift::Right => of >> by,
                    Shift::RightSigned => (of.signed() >> by).bits(),
                }
            }
            Make::ShiftBy { shift, of, by } => {
                let of = self.pick(d, *of);
                match shift {
                    Shift::Left => of << *by,
                    Shift::Right => of >> *by,
                    Shift::RightSigned => (of.signed() >> *by).bits(),
                }
            }
            Make::Mux { select, on_true, on_false } => {
                let select = self.pick_fit(d, *select, 1);
                let on_true = self.pick(d, *on_true);
                mux(select, on_true, self.pick_fit(d, *on_false, on_true.width()))
            }
            Make::Select { arms, default } => {
                let default = self.pick(d, *default);
                let arm = |(condition, value): &(Pick, Pick)| {
                    (self.pick_fit(d, *condition, 1), self.pick_fit(d, *value, default.width()))
                };
                let arms: Vec<_> = arms.iter().map(arm).collect();
                select(arms, default)
            }
            Make::Case { subject, arms, default } => {
                let (subject, default) = (self.pick(d, *subject), self.pick(d, *default));
                let mut known: Vec<(u64, Signal)> = Vec::new();
                for (key, value) in arms {
                    let key = Bits::new(subject.width(), *key).limbs()[0];
                    if known.iter().all(|(other, _)| *other != key) {
                        known.push((key, self.pick_fit(d, *value, default.width())));
                    }
                }
                case(subject, known, default)
            }
            Make::Slice { of, low, width } => {
                let of = self.pick(d, *of);
                let low = low % of.width();
                of.slice(low..(low + width).min(of.width()))
            }
            Make::Extend { of, by, signed } => {
                let of = self.pick(d, *of);
                let width = (of.width() + by).min(WIDEST).max(of.width());
                if *signed { of.sext(width) } else { of.zext(width) }
            }
            Make::Concat(parts) => {
                let parts: Vec<_> = parts.iter().map(|part| self.pick(d, *part)).collect();
                let mut width = 0;
                let fitting = parts.iter().take_while(|part| {
                    width += part.width();
                    width <= WIDEST
                });
                let fitting: Vec<_> = fitting.copied().collect();
                if fitting.is_empty() { lit(3, 5) } else { concat(&fitting) }
            }
            Make::Repeat(of, times) => {
                let of = self.pick(d, *of);
                of.repeat((*times).min(WIDEST / of.width()).max(1))
            }
            Make::Name(of) => self.pick(d, *of).named(&format!("n{number}")),
            Make::Wire(of) => {
                let of = self.pick(d, *of);
                let wire = self.on(d).wire(&format!("w{number}"), of.width());
                let read = !*wire;
                wire.drive(of);
                read
            }
            _ => unreachable!("the other steps are objects"),
        }
    }

    fn machine(&mut self, d: usize, number: usize, machine: &Machine) {
        let state = self.on(d).fsm(&format!("s{number}"), Phase::Idle);
        let width = self.pick(d, machine.chosen[0]).width();
        let chosen = machine.chosen.map(|pick| self.pick_fit(d, pick, width));
        let chosen = state.pick(|phase| chosen[phase.code() as usize]);
        let conditions = machine.states.iter().map(|(arms, _)| {
            arms.iter().map(|(pick, to)| (self.pick_fit(d, *pick, 1), phase(*to))).collect::<Vec<_>>()
        });
        let conditions: Vec<Vec<(Signal, Phase)>> = conditions.collect();
        state.next(|from| {
            let arms = &conditions[from.code() as usize];
            let otherwise = machine.states[from.code() as usize].1;
            let transition = arms.split_first().map(|((condition, to), rest)| {
                rest.iter().fold(when(*condition, *to), |so_far, (condition, to)| so_far.or_when(*condition, *to))
            });
            match (transition, otherwise) {
                (Some(transition), Some(to)) => transition.or_else(phase(to)),
                (Some(transition), None) => transition,
                (None, Some(to)) => goto(phase(to)),
                (None, None) => hold(),
            }
        });
        self.push(d, chosen);
        self.push(d, state.is(Phase::Run));
    }

    fn memory(&mut self, d: usize, number: usize, memory: &Memory) {
        let crossing = memory.crossing && self.block.second().is_some();
        let policy = if crossing { ReadUnderWrite::Old } else { memory.policy };
        // A memory handle goes from the own clock to the second one, not back.
        let mut mem =
            self.on(if crossing { 0 } else { d }).memory(&format!("m{number}"), memory.depth, memory.width, policy);
        if memory.writes.len() > 1 {
            mem = mem.true_dual_port();
        }
        mem = match &memory.contents {
            Contents::Unknown => mem,
            Contents::Fill(word) => mem.fill(word.bits(memory.width)),
            Contents::Words(words) => {
                mem.words(words.iter().take(memory.depth as usize).map(|word| word.bits(memory.width)))
            }
        };
        let second = self.block.second().filter(|_| crossing);
        let seen_from = |domain| second.filter(|_| domain == 1).map_or(mem, |clock| mem.on(clock));
        let writer = if crossing { 1 - d } else { d };
        let (reading, writing) = (seen_from(d), seen_from(writer));
        let ports = memory.writes.iter().map(|port| {
            (self.pick_fit(writer, port.enable, 1), self.pick_fit(writer, port.address, mem.address_width()))
        });
        let ports: Vec<_> = ports.collect();
        for read in &memory.reads {
            let address = self.pick_fit(d, read.address, mem.address_width());
            let mut enable = read.enable.map(|pick| self.pick_fit(d, pick, 1));
            if policy == ReadUnderWrite::Any {
                let quiet = ports.iter().map(|(writes, _)| !*writes);
                enable = quiet.chain(enable).reduce(|a, b| a & b);
            }
            let data = match enable {
                _ if read.asynchronous && !crossing => reading.read_async(address),
                Some(enable) => reading.read_when(enable, address),
                None => reading.read(address),
            };
            self.push(d, data);
        }
        for (port, (enable, address)) in memory.writes.iter().zip(ports) {
            self.late.push((writer, Late::Write { memory: writing, enable, address, data: port.data }));
        }
    }

    fn cross(&mut self, d: usize, number: usize, synchronize: bool, of: Pick) {
        if self.block.second().is_none() {
            return;
        }
        let signal = match synchronize {
            true => {
                let signal = self.pick_fit(1 - d, of, 1);
                self.on(d).synchronize(&format!("y{number}"), signal)
            }
            false => self.pick(1 - d, of).quasi_static("the simulators agree on every instant"),
        };
        self.push(d, signal);
    }

    /// An earlier part.
    fn child(&self, part: Pick) -> Option<PartBlock> {
        let index = usize::from(part.0).checked_rem(self.block.index)?;
        Some(PartBlock { index, ..self.block.clone() })
    }

    /// The pool that a child's clock is: seen from the second clock, both are the second.
    fn outside(d: usize, child_domain: usize) -> usize {
        d.max(child_domain)
    }

    fn instance(&mut self, d: usize, number: usize, part: Pick, inputs: &[Pick]) {
        let Some(child) = self.child(part) else { return };
        let mut picks = inputs.iter().copied().chain(std::iter::repeat(Pick(1)));
        let [own, second] = [0, 1].map(|domain| {
            let feed =
                |input: &Input| self.pick_fit(Self::outside(d, domain), picks.next().expect("endless"), input.width);
            child.inputs_on(domain).map(feed).collect()
        });
        let out = self.on(d).instance(&format!("u{number}"), &child, PartIn { own, second });
        for (domain, signals) in [(0, out.out), (1, out.second_out), (0, out.link), (1, out.second_link)] {
            signals.into_iter().for_each(|signal| self.push(Self::outside(d, domain), signal));
        }
    }

    fn array(&mut self, d: usize, number: usize, child: &PartBlock, row: Row) {
        let module = self.on(d);
        let mut feeds = row.inputs.iter().copied().chain(std::iter::repeat((Feed::Broadcast, Pick(1))));
        let out = module.array(&format!("u{number}"), row.lanes, child, |array| {
            let links = [array.out.link.clone(), array.out.second_link.clone()];
            let [own, second] = [0, 1].map(|domain| {
                let mut links = links[domain].iter();
                let feed = |input: &Input| {
                    let link = input.link.and_then(|_| links.next());
                    let (feed, pick) = feeds.next().expect("endless");
                    self.feed(&array, &row, Self::outside(d, domain), (feed, pick, input.width), link)
                };
                child.inputs_on(domain).map(feed).collect()
            });
            PartIn { own, second }
        });
        let mut gathers = row.outputs.iter().copied().chain(std::iter::repeat(Gather::Reduce(Reduction::Xor)));
        for (domain, lanes) in [(0, out.out), (1, out.second_out), (0, out.link), (1, out.second_link)] {
            for lanes in lanes {
                let signal = gather(lanes, gathers.next().expect("endless"));
                self.push(Self::outside(d, domain), signal);
            }
        }
    }

    fn feed(
        &mut self,
        array: &Array<PartOut<Lanes>>,
        row: &Row,
        d: usize,
        (feed, pick, width): (Feed, Pick, u32),
        link: Option<&Lanes>,
    ) -> Lanes {
        match (feed, link) {
            (Feed::Link(by), Some(link)) => {
                let edge = self.pick_fit(d, pick, width);
                link.shifted(row.by * (1 + i32::from(by % 3)), edge)
            }
            (Feed::Each, _) => {
                let picks = (0..row.lanes).map(|lane| Pick(pick.0.wrapping_add(7 * lane as u16)));
                let signals: Vec<_> = picks.map(|pick| self.pick_fit(d, pick, width)).collect();
                array.each(signals)
            }
            (Feed::Index, _) => array.constants(width, |lane| Bits::new(width, lane.into()).limbs()[0]),
            (Feed::Broadcast | Feed::Link(_), _) => {
                let signal = self.pick_fit(d, pick, width);
                array.all(&signal)
            }
        }
    }

    fn finish(mut self) -> PartOut {
        for (d, late) in std::mem::take(&mut self.late) {
            match late {
                Late::Next(register, next) => register.next(self.pick_late(d, next, register.width())),
                Late::Write { memory, enable, address, data } => {
                    memory.write(enable, address, self.pick_late(d, data, memory.width()));
                }
            }
        }
        let block = self.block;
        let [link, second_link] = [0, 1].map(|domain| {
            let link = |input: &Input| Some(self.pick_fit(domain, input.link?, input.width));
            block.inputs_on(domain).filter_map(link).collect()
        });
        let [out, second_out] = self
            .pools
            .map(|pool| pool.iter().filter(|value| !value.is_read).map(|value| value.signal).collect::<Vec<_>>());
        let nothing = out.is_empty() && second_out.is_empty();
        PartOut { out: if nothing { vec![lit(1, 1)] } else { out }, second_out, link, second_link }
    }
}

/// How an array is fed and read.
struct Row<'a> {
    lanes: u32,
    /// Which way links lead.
    by: i32,
    inputs: &'a [(Feed, Pick)],
    outputs: &'a [Gather],
}

fn phase(number: u8) -> Phase {
    Phase::ALL[usize::from(number) % Phase::ALL.len()]
}

/// The value cut or widened to a width; where it is cut and how it is widened follows from the pick.
fn fit(signal: Signal, width: u32, pick: Pick) -> Signal {
    let how = u32::from(pick.0 / 5);
    if signal.width() > width {
        let low = how % (signal.width() - width + 1);
        return signal.slice(low..low + width);
    }
    if how % 2 == 1 { signal.sext(width) } else { signal.zext(width) }
}

fn narrow(signal: Signal) -> Signal {
    signal.trunc(signal.width().min(WIDEST))
}

/// A comparison of two values of one width.
pub fn compare(relation: Relation, signed: bool, a: Signal, b: Signal) -> Signal {
    let (x, y) = (a.signed(), b.signed());
    match (relation, signed) {
        (Relation::Eq, false) => a.eq(b),
        (Relation::Ne, false) => a.ne(b),
        (Relation::Lt, false) => a.lt(b),
        (Relation::Le, false) => a.le(b),
        (Relation::Gt, false) => a.gt(b),
        (Relation::Ge, false) => a.ge(b),
        (Relation::Eq, true) => x.eq(y),
        (Relation::Ne, true) => x.ne(y),
        (Relation::Lt, true) => x.lt(y),
        (Relation::Le, true) => x.le(y),
        (Relation::Gt, true) => x.gt(y),
        (Relation::Ge, true) => x.ge(y),
    }
}

fn gather(lanes: Lanes, gather: Gather) -> Signal {
    match gather {
        Gather::Reduce(Reduction::And) => lanes.and_all(),
        Gather::Reduce(Reduction::Or) => lanes.or_all(),
        Gather::Reduce(Reduction::Xor) => lanes.xor_all(),
        Gather::Reduce(Reduction::Add) => lanes.sum(),
        Gather::Lane(index) => lanes.lane(index % lanes.count()),
        Gather::Concat => narrow(concat(&lanes.to_vec())),
    }
}

impl Pattern {
    /// The constant in `width` bits.
    pub fn bits(self, width: u32) -> Bits {
        let every = |number: u64| Bits::from_limbs(width, &vec![number; limbs_for(width)]);
        match self {
            Pattern::Zero => Bits::zero(width),
            Pattern::Ones => Bits::ones(width),
            Pattern::One => Bits::new(width, 1),
            Pattern::Sign if width == 1 => Bits::new(1, 1),
            Pattern::Sign => Bits::new(1, 1).concat(&Bits::zero(width - 1)),
            Pattern::Alternating => every(0x5555_5555_5555_5555),
            Pattern::Number(number) => every(number),
        }
    }
}
