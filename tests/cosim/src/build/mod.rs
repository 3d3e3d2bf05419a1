//! Random designs as hardware.

mod again;
mod border;
pub mod clocks;
mod declared;
mod expression;
mod fit;
mod form;
mod instances;
mod lanes;
mod library;
pub(crate) mod names;
mod numbers;
mod objects;
mod records;
mod registers;
mod rom;
mod statements;

use crate::features::Feature;
use crate::spec::*;
use border::Pads;
pub use expression::compare;
use fit::{fit, narrow};
use instances::Row;
use names::{Kind, Namer, Ports};
use std::collections::VecDeque;
use std::fmt;
use std::rc::Rc;
use tilewright_hdl::*;

bundle! {
    /// The inputs of a part, by clock.
    pub struct PartIn<T> {
        /// On the module's own clock.
        pub own: Ports<T>,
        /// On the second clock.
        pub second: Ports<T>,
        /// The other sides of pads.
        pub pads: Pads<T>,
    }
    /// The outputs of a part, by clock.
    pub struct PartOut<T> {
        /// On the module's own clock.
        pub out: Ports<T>,
        /// On the second clock.
        pub second_out: Ports<T>,
        /// For each input on the own clock that has a link, a value of its width.
        pub link: Ports<T>,
        /// For each input on the second clock that has a link, a value of its width.
        pub second_link: Ports<T>,
    }
}

/// A part of a random design, as a block.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct PartBlock {
    /// Goes before the name of each module.
    pub prefix: String,
    /// The design.
    pub spec: Rc<Spec>,
    /// How many lanes each step of each part has, as [`sizes`] says.
    sizes: Rc<Vec<Vec<u32>>>,
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
    let sizes = Rc::new(sizes(spec));
    PartBlock { prefix: prefix.to_owned(), spec: Rc::new(spec.clone()), sizes, index: spec.parts.len() - 1 }
}

/// The lanes of each step: those of its array, 1 for what is none, and 0 for an instance that the part has no room for.
fn sizes(spec: &Spec) -> Vec<Vec<u32>> {
    let mut weights: Vec<u32> = Vec::new();
    let mut sizes = Vec::new();
    for part in &spec.parts {
        let mut weight = 0;
        let mut size = |step: &Step| {
            let (part, lanes) = match &step.make {
                Make::Instance { part, .. } => (*part, 1),
                Make::Array { part, lanes, .. } => (*part, *lanes),
                _ => return 1,
            };
            let child = child_index(part, weights.len()).map_or(1, |index| weights[index]);
            let lanes = lanes.min((spec.room - weight) / child);
            weight += lanes * child;
            lanes
        };
        sizes.push(part.steps.iter().map(&mut size).collect());
        weights.push(weight + part.steps.len() as u32);
    }
    sizes
}

/// The earlier part that is picked, the last one by 0.
fn child_index(part: Pick, count: usize) -> Option<usize> {
    let back = usize::from(part.0).checked_rem(count)?;
    Some(count - 1 - back)
}

impl PartBlock {
    fn part(&self) -> &Part {
        &self.spec.parts[self.index]
    }

    /// The lanes of a step.
    fn size(&self, number: usize) -> u32 {
        self.sizes[self.index][number]
    }

    fn is_top(&self) -> bool {
        self.index + 1 == self.spec.parts.len()
    }

    fn inputs_on(&self, domain: usize) -> impl Iterator<Item = &Input> {
        self.part().inputs.iter().filter(move |input| self.domain(input.clock) == domain)
    }

    /// The inputs of a clock, each made of its description.
    fn ports_on<T>(&self, domain: usize, mut make: impl FnMut(&Input) -> T) -> Ports<T> {
        let named = self.part().inputs.iter().zip(Namer::of(self).inputs);
        let ours = named.filter(|(input, _)| self.domain(input.clock) == domain);
        Ports(ours.map(|(input, name)| (name, make(input))).collect())
    }
}

impl Block for PartBlock {
    type In = PartIn;
    type Out = PartOut;

    fn inputs(&self) -> PartIn<Width> {
        let layout = |input: &Input| {
            input.form.meaning.used(Feature::SignedPort, Feature::CodePort);
            input.form.layout()
        };
        let [own, second] = [0, 1].map(|domain| {
            let clock = self.clock(domain);
            self.ports_on(domain, |input| clock.map_or(layout(input), |clock| layout(input).on(clock)))
        });
        PartIn { own, second, pads: self.outsides(Namer::of(self).pads) }
    }

    fn build(&self, m: Module, i: PartIn) -> PartOut {
        m.ignore(&i);
        let outsides = i.pads.0.into_iter().map(|(_, outside)| outside).collect();
        let mut builder = Builder::new(self, m, [i.own.values(), i.second.values()], outsides);
        for (number, step) in self.part().steps.iter().enumerate() {
            builder.step(number, step);
        }
        builder.finish()
    }

    fn name(&self) -> String {
        format!("{self:?}")
    }

    /// Some parts are models of foreign modules, with ports of other names. None is where an instance is enabled, as
    /// no enable reaches a foreign module.
    fn foreign(&self) -> Option<Foreign> {
        let mut steps = self.spec.parts.iter().flat_map(|part| &part.steps);
        let has_parts = |make: &Make| matches!(make, Make::Instance { .. } | Make::Array { .. });
        if self.is_top()
            || self.part().steps.len() % 3 != 1
            || steps.any(|it| it.enabled.is_some() && has_parts(&it.make))
        {
            return None;
        }
        Feature::Foreign.used();
        let foreign =
            Foreign::module(&format!("FOREIGN_{self:?}")).clock("CK").reset("RS").parameter("PART", self.index as u32);
        let of_named = |foreign: Foreign, domain: usize| match self.clock(domain) {
            Some(clock) => foreign.clock_of(clock, &format!("CK{domain}")).reset_of(clock, &format!("RS{domain}")),
            None => foreign,
        };
        Some([0, 1].into_iter().fold(foreign, of_named))
    }
}

/// A value that later steps may pick.
struct Pooled {
    signal: Signal,
    /// Something observable depends on it.
    is_read: bool,
}

/// A connection made when all values are known.
enum Late {
    Next(Reg, Meaning, Pick),
    Updates { register: Reg, meaning: Meaning, updates: Vec<(Pick, Pick)>, otherwise: Option<Pick> },
    Write { memory: Mem, meaning: Meaning, enable: Signal, address: Signal, data: Pick },
    Records { register: Reg<records::Mixed>, records: Records },
}

struct Builder<'a> {
    block: &'a PartBlock,
    module: Module,
    /// By clock.
    pools: [Vec<Pooled>; 2],
    late: Vec<(usize, Late)>,
    /// Outputs of arrays, by clock.
    rows: [Vec<Signal>; 2],
    namer: Namer,
    /// The other sides of the pads that are still to come.
    outsides: VecDeque<Outside>,
    /// What the step names in place of a clock.
    renamed: Option<(usize, Clock)>,
    /// The names that a helper asks for again and again.
    helper: Option<again::Names>,
}

impl<'a> Builder<'a> {
    fn new(block: &'a PartBlock, module: Module, inputs: [Vec<Signal>; 2], outsides: VecDeque<Outside>) -> Self {
        let pools = inputs.map(|of| of.into_iter().map(|signal| Pooled { signal, is_read: true }).collect());
        let mut builder = Builder {
            block,
            module,
            pools,
            late: Vec::new(),
            rows: [Vec::new(), Vec::new()],
            namer: Namer::of(block).namer,
            outsides,
            renamed: None,
            helper: None,
        };
        if block.second().is_some() {
            // With state on the own clock, inputs that name no clock belong to it.
            Feature::Def.used();
            let own = builder.on(0);
            def!(beat = own.reg(1).reset(0));
            beat.next(!beat);
            builder.push(0, *beat);
        }
        builder
    }

    fn push(&mut self, domain: usize, signal: Signal) {
        self.pools[domain].push(Pooled { signal, is_read: false });
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
        self.pools[domain][index].signal.bits()
    }

    fn pick_fit(&mut self, domain: usize, pick: Pick, width: u32) -> Signal {
        let signal = self.pick(domain, pick);
        fit(signal, width, pick)
    }

    /// A value read as something of that meaning, as wide as it is itself.
    fn pick_as(&mut self, domain: usize, pick: Pick, meaning: Meaning) -> Signal {
        let signal = self.pick(domain, pick);
        meaning.made_of(fit(signal, meaning.width(signal.width()), pick))
    }

    /// A value read as something of that meaning, as if so many bits were wanted.
    fn pick_fit_as(&mut self, domain: usize, pick: Pick, meaning: Meaning, width: u32) -> Signal {
        meaning.made_of(self.pick_fit(domain, pick, meaning.width(width)))
    }

    /// A pick that does not make its value observed: the way to an output may lead through itself.
    fn pick_late(&self, domain: usize, pick: Pick, width: u32) -> Signal {
        match self.index(domain, pick) {
            Some(index) => fit(self.pools[domain][index].signal, width, pick),
            None => fit(lit(1, 1), width, pick),
        }
    }

    /// A name for a register, a net or an array.
    fn inner_name(&mut self, plain: &str) -> String {
        self.namer.draw(plain, Kind::Inner)
    }

    /// Names for outputs.
    fn outputs(&mut self, plain: &str, signals: Vec<Signal>) -> Ports<Signal> {
        let named = signals.into_iter().enumerate();
        let named = named.map(|(number, signal)| (self.namer.draw(&format!("{plain}_{number}"), Kind::Output), signal));
        Ports(named.collect())
    }

    /// What goes into something as wide as that, as [`Builder::pick_late`]: of wide numbers the low bits, in some.
    fn given_late(&self, domain: usize, pick: Pick, meaning: Meaning, width: u32) -> Value {
        if let Some(index) = self.index(domain, pick) {
            let signal = self.pools[domain][index].signal.bits();
            if meaning == Meaning::Number && signal.width() > width && pick.0.is_multiple_of(3) {
                Feature::Low.used();
                return signal.low().operand();
            }
        }
        meaning.made_of(self.pick_late(domain, pick, meaning.width(width))).operand()
    }

    fn make(&mut self, d: usize, number: usize, step: &Step) {
        match &step.make {
            Make::Register { .. } => self.register(d, number, &step.make),
            Make::Pipe { .. } => self.pipe(d, number, &step.make),
            Make::Toggle(turns) => {
                Feature::Toggle.used();
                let (name, turns) = (self.inner_name(&format!("t{number}")), self.pick_fit(d, *turns, 1));
                let toggle = self.on(d).toggle(&name, turns);
                self.push(d, toggle);
            }
            Make::Machine(machine) => self.machine(d, number, machine),
            Make::Memory(memory) => self.memory(d, number, memory),
            Make::Records(records) => self.records(d, number, records),
            Make::Rom(rom) => self.rom(d, number, rom),
            Make::Library(library) => self.library(d, number, library),
            Make::Lanes(work) => {
                let signal = self.lanes(d, number, work);
                self.push(d, signal);
            }
            Make::Cross { by, of } => self.cross(d, number, *by, *of),
            Make::State(statement, pick) => self.state(d, number, *statement, *pick),
            Make::Coded(coded) => self.coded(d, number, coded),
            Make::PowerOn { .. } => self.power_on(d, number, &step.make),
            Make::InParts(parts) => self.parts(d, number, parts),
            Make::Pad(pad) => self.pad(d, number, pad),
            Make::Again { times, of } => self.again(d, *times, *of),
            Make::Declared(declared) => self.declared(d, number, declared),
            Make::Never(pick, pattern) => {
                let signal = self.pick(d, *pick);
                self.on(d).assert(signal.ne(pattern.bits(signal.width())), "a value is never this one");
            }
            Make::Chain { width, length, ring, enable, from } => {
                self.chain(d, number, (*width, *length), *enable, (!ring).then_some(*from));
            }
            Make::Instance { part, inputs } => {
                if let Some(child) = self.child(number, *part) {
                    self.instance(d, number, &child, inputs);
                }
            }
            Make::Array { part, towards_lower, inputs, outputs, .. } => {
                if let Some(child) = self.child(number, *part) {
                    let by = if *towards_lower { -1 } else { 1 };
                    let lanes = self.block.size(number);
                    self.array(d, number, &child, Row { lanes, by, inputs, outputs });
                }
            }
            make => {
                let signal = self.expression(d, number, make);
                self.push(d, signal);
            }
        }
    }

    fn finish(mut self) -> PartOut {
        for (d, late) in std::mem::take(&mut self.late) {
            match late {
                Late::Next(register, meaning, next) => {
                    register.next(self.given_late(d, next, meaning, register.width()));
                }
                Late::Updates { register, meaning, updates, otherwise } => {
                    self.updates(d, register, meaning, &updates, otherwise);
                }
                Late::Records { register, records } => self.update_record(d, &register, &records),
                Late::Write { memory, meaning, enable, address, data } => {
                    memory.write(enable, address, self.given_late(d, data, meaning, memory.width()));
                }
            }
        }
        let block = self.block;
        let [link, second_link] = [0, 1].map(|domain| {
            let link = |(number, input): (usize, &Input)| {
                let Link { of, registered } = input.link?;
                let signal = self.pick_fit_as(domain, of, input.form.meaning, input.form.width);
                let name = self.inner_name(&format!("l{domain}_{number}"));
                Some(if registered { self.on(domain).pipe(&name, signal) } else { signal })
            };
            block.inputs_on(domain).enumerate().filter_map(link).collect::<Vec<_>>()
        });
        let [out, second_out] = std::mem::take(&mut self.pools)
            .map(|pool| pool.iter().filter(|value| !value.is_read).map(|value| value.signal).collect::<Vec<_>>());
        let nothing = out.is_empty() && second_out.is_empty();
        let out = if nothing { vec![lit(1, 1)] } else { out };
        PartOut {
            out: self.outputs("out", out),
            second_out: self.outputs("second_out", second_out),
            link: self.outputs("link", link),
            second_link: self.outputs("second_link", second_link),
        }
    }
}
