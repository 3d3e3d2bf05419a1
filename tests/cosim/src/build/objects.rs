//! Steps that hold state or cross clocks: state machines, memories, synchronizers.

use super::{Builder, Kind, Late};
use crate::features::Feature;
use crate::spec::*;
use tilewright_hdl::*;

codes! {
    enum Phase { Idle = 2, Load = 0, Run = 5, Drain }
}

impl Builder<'_> {
    pub fn machine(&mut self, d: usize, number: usize, machine: &Machine) {
        let name = self.inner_name(&format!("s{number}"));
        let state = self.on(d).fsm(&name, Phase::Idle);
        let width = self.pick(d, machine.chosen[0]).width();
        let chosen = machine.chosen.map(|pick| self.pick_fit(d, pick, width));
        let chosen = state.pick(|phase| chosen[place(phase)]);
        let conditions = machine.states.iter().map(|exits| {
            exits.when.iter().map(|(pick, to)| (self.pick_fit(d, *pick, 1), phase(*to))).collect::<Vec<_>>()
        });
        let conditions: Vec<Vec<(Signal, Phase)>> = conditions.collect();
        let moves = state.next(|from| {
            let arms = &conditions[place(from)];
            let otherwise = machine.states[place(from)].otherwise;
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
        self.push(d, state.bits());
        Feature::Constants.used();
        self.push(d, state.constants(5, |phase| 5 * phase.code()));
        for ask in &machine.asks {
            self.push(d, asked(&moves, *ask));
        }
    }

    pub fn memory(&mut self, d: usize, number: usize, memory: &Memory) {
        let crossing = memory.crossing && self.block.second().is_some();
        let policy = if crossing { ReadUnderWrite::Old } else { memory.policy };
        if policy == ReadUnderWrite::New {
            Feature::WriteFirst.used();
        }
        let writer = if crossing { 1 - d } else { d };
        let (form, address_width) = (memory.form, index_width(memory.depth.into()));
        form.meaning.used(Feature::SignedWord, Feature::CodeWord);
        let writes = memory
            .writes
            .iter()
            .map(|port| (self.pick_fit(writer, port.enable, 1), self.pick_fit(writer, port.address, address_width)));
        let writes: Vec<_> = writes.collect();
        let reads = memory.reads.iter().map(|read| {
            let address = self.pick_fit(d, read.address, address_width);
            let mut enable = read.enable.map(|pick| self.pick_fit(d, pick, 1));
            if policy == ReadUnderWrite::Any {
                let quiet = writes.iter().map(|(writes, _)| !*writes);
                enable = quiet.chain(enable).reduce(|a, b| a & b);
            }
            (read.asynchronous && !crossing, enable, address)
        });
        let reads: Vec<_> = reads.collect();
        let clocked = reads.iter().filter(|(asynchronous, ..)| !asynchronous).count();
        let numbers = (0..clocked).map(|port| if clocked > 1 { format!("_read{port}") } else { "_read".to_owned() });
        let numbers: Vec<String> = numbers.collect();
        let mut name = |plain: String| self.namer.draw_with(&plain, Kind::Inner, &numbers);
        let first = (name(format!("m{number}")), form);
        let twin = memory.twin.map(|width| (name(format!("m{number}_twin")), Form { width, ..form }));
        for (name, Form { width, meaning }) in [first].into_iter().chain(twin) {
            // A memory handle goes from the own clock to the second one, not back.
            let mut mem =
                self.on(if crossing { 0 } else { d }).memory(&name, memory.depth, meaning.layout(width), policy);
            if memory.attribute {
                Feature::AttributeOfAMemory.used();
                mem = mem.attribute("ram_style", "distributed");
            }
            if writes.len() > 1 {
                mem = mem.true_dual_port();
            }
            mem = match &memory.contents {
                Contents::Unknown => mem,
                Contents::Fill(word) => mem.fill(meaning.constant(*word, width)),
                Contents::Words(words) => {
                    mem.words(words.iter().take(memory.depth as usize).map(|word| meaning.constant(*word, width)))
                }
            };
            let second = self.clock(1).filter(|_| crossing);
            let seen_from = |domain| second.filter(|_| domain == 1).map_or(mem, |clock| mem.on(clock));
            let (reading, writing) = (seen_from(d), seen_from(writer));
            for &(asynchronous, enable, address) in &reads {
                let data = match enable {
                    _ if asynchronous => reading.read_async(address),
                    Some(enable) => reading.read_when(enable, address),
                    None => reading.read(address),
                };
                self.push(d, data);
            }
            for (port, &(enable, address)) in memory.writes.iter().zip(&writes) {
                let write = Late::Write { memory: writing, meaning, enable, address, data: port.data };
                self.late.push((writer, write));
            }
        }
    }

    pub fn cross(&mut self, d: usize, number: usize, by: Crossing, of: Pick) {
        if self.block.second().is_none() {
            return;
        }
        let signal = match by {
            Crossing::QuasiStatic => self.pick(1 - d, of).quasi_static("the simulators agree on every instant"),
            Crossing::Synchronize | Crossing::SynchronizeFrom(_) => {
                let logic = self.pick_fit(1 - d, of, 1);
                let from = self.inner_name(&format!("y{number}_from"));
                let steady = self.on(1 - d).pipe(&from, logic);
                let name = self.namer.draw_with(&format!("y{number}"), Kind::Inner, &["_meta".to_owned()]);
                if let Crossing::SynchronizeFrom(reset) = by {
                    Feature::SynchronizeFrom.used();
                    self.on(d).synchronize_from(reset, &name, steady)
                } else {
                    self.on(d).synchronize(&name, steady)
                }
            }
        };
        self.push(d, signal);
    }
}

/// 1 bit: what is asked of the transitions is so.
fn asked(moves: &Moves<Phase>, ask: Ask) -> Signal {
    match ask {
        Ask::Leaves(state) => {
            Feature::Leaves.used();
            moves.leaves(phase(state))
        }
        Ask::Enters(state) => {
            Feature::Enters.used();
            moves.enters(phase(state))
        }
        Ask::Goes(from, to) => {
            Feature::Goes.used();
            moves.goes(phase(from), phase(to))
        }
    }
}

fn phase(number: u8) -> Phase {
    Phase::ALL[usize::from(number) % Phase::ALL.len()]
}

/// The place of a state among all of them.
fn place(phase: Phase) -> usize {
    Phase::NAMES.place(phase.code()).expect("a state is a code")
}
