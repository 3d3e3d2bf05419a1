//! What an edge does to a register, read data or a word of a memory, and what decides that.

use tilewright_circuit::Bits;
use tilewright_circuit::ir::ReadUnderWrite;

use super::mask;
use super::operation::{Asked, Demand, Place, demands};
use super::values::within;
use super::walk::{StateOf, Walk};
use crate::engine::program::{Kind, ValueId, WritePort};

/// What an edge does to some bits of a state.
pub(super) enum Outcome {
    /// It leaves them as they are, because of this.
    Kept(Vec<Demand>),
    /// It writes them, because of this.
    Written(Vec<Demand>),
    /// It resets them.
    Reset,
}

impl Walk<'_> {
    /// What the coming edge of `self.rising` does.
    pub(super) fn outcome(&mut self, place: Place, lane: u32, bits: &Bits) -> Outcome {
        match place {
            Place::Word(memory, address) => self.outcome_for_word(memory, lane, address, bits),
            Place::Value(id) => match self.states.get(&id).copied() {
                Some(StateOf::Register(index)) => self.outcome_for_register(index, lane, bits),
                Some(StateOf::Read(memory, port)) => self.outcome_for_read(memory, port, lane, bits),
                None => Outcome::Kept(Vec::new()),
            },
        }
    }

    fn outcome_for_register(&mut self, index: u32, lane: u32, bits: &Bits) -> Outcome {
        let program = self.program.clone();
        let register = &program.registers[index as usize];
        let clock = register.clock as usize;
        if !self.rising.contains(&clock) {
            return Outcome::Kept(Vec::new());
        }
        if self.running.resets[clock] && register.reset(lane).is_some() {
            return Outcome::Reset;
        }
        let enable = register.enable.map(|enable| flag(enable, lane));
        if let Some(enable) = &enable
            && !self.is_one(register.enable, lane)
        {
            return Outcome::Kept(vec![enable.clone()]);
        }
        match self.keeps(register.next, register.value, lane, bits) {
            Some(choices) => Outcome::Kept(choices),
            None => {
                let next = Demand::data(register.next, lane, bits.clone());
                Outcome::Written([next].into_iter().chain(enable).collect())
            }
        }
    }

    /// Whether choices alone make the next value of these bits their present one; what they choose by.
    fn keeps(&mut self, next: ValueId, value: ValueId, lane: u32, bits: &Bits) -> Option<Vec<Demand>> {
        let program = self.program.clone();
        let (mut at, mut choices) = (Demand::data(next, lane, bits.clone()), Vec::new());
        loop {
            let Place::Value(id) = at.place else { return None };
            if id == value {
                return (at.lane == lane && at.bits.limbs() == bits.limbs()).then_some(choices);
            }
            let cell = &program.circuit[id];
            if !matches!(
                cell.kind,
                Kind::Mux { .. } | Kind::Select { .. } | Kind::Case { .. } | Kind::Slice(..) | Kind::Concat(_)
            ) {
                return None;
            }
            let asked = Asked { circuit: &program.circuit, cell, lane: at.lane, bits: &at.bits };
            let all = demands(&asked, &mut |id, lane| self.values.get(self.running, id, lane));
            let (controls, data): (Vec<_>, Vec<_>) =
                all.into_iter().filter(|demand| !demand.bits.is_zero()).partition(|demand| demand.is_control);
            choices.extend(controls);
            let Ok([only]) = <[Demand; 1]>::try_from(data) else { return None };
            at = only;
        }
    }

    fn outcome_for_read(&mut self, memory: u32, port: u32, lane: u32, bits: &Bits) -> Outcome {
        let program = self.program.clone();
        let declared = &program.memories[memory as usize];
        let read = &declared.reads[port as usize];
        if !self.rising.contains(&(read.clock as usize)) {
            return Outcome::Kept(Vec::new());
        }
        let enable = read.enable.map(|enable| flag(enable, lane));
        if let Some(enable) = &enable
            && !self.is_one(read.enable, lane)
        {
            return Outcome::Kept(vec![enable.clone()]);
        }
        let whole = mask::all(program.circuit[read.address].width);
        let mut all: Vec<Demand> = [Demand::control(read.address, lane, whole)].into_iter().chain(enable).collect();
        let address = self.values.get(self.running, read.address, lane);
        if let Some(address) = within(address.limbs(), declared.depth) {
            let place = Place::Word(memory, address);
            all.insert(0, Demand { place, lane, bits: bits.clone(), is_control: false });
            if declared.policy == ReadUnderWrite::Any {
                let (write, others) = self.write(memory, lane, address);
                all.extend(write.into_iter().flatten().filter(|demand| demand.is_control));
                all.extend(others.into_iter().filter(|_| self.limits.kept));
            }
        }
        Outcome::Written(all)
    }

    fn outcome_for_word(&mut self, memory: u32, lane: u32, address: u32, bits: &Bits) -> Outcome {
        let (write, others) = self.write(memory, lane, address);
        match write {
            None => Outcome::Kept(others),
            Some(mut write) => {
                write[0].bits = bits.clone();
                write.extend(others.into_iter().filter(|_| self.limits.kept));
                Outcome::Written(write)
            }
        }
    }

    /// The write of a word at the coming edge that wins: its data, enable and address. And why the ports that would
    /// win over it, or all if none writes, do not write.
    fn write(&mut self, memory: u32, lane: u32, address: u32) -> (Option<Vec<Demand>>, Vec<Demand>) {
        let program = self.program.clone();
        let of_clock = |clock: usize| program.clocks[clock].writes.iter().filter(move |(of, _)| *of == memory);
        let ports: Vec<u32> = self.rising.iter().flat_map(|&clock| of_clock(clock)).map(|(_, port)| *port).collect();
        let mut others = Vec::new();
        for port in ports.into_iter().rev() {
            let write = &program.memories[memory as usize].writes[port as usize];
            match self.why_not(write, lane, address) {
                Some(why) => others.push(why),
                None => {
                    let width = |id: ValueId| program.circuit[id].width;
                    let place = Demand::control(write.address, lane, mask::all(width(write.address)));
                    let data = Demand::data(write.data, lane, mask::all(width(write.data)));
                    return (Some(vec![data, flag(write.enable, lane), place]), others);
                }
            }
        }
        (None, others)
    }

    /// Why a port does not write a word: its enable, or a bit of its address.
    fn why_not(&mut self, write: &WritePort, lane: u32, address: u32) -> Option<Demand> {
        if !self.is_one(Some(write.enable), lane) {
            return Some(flag(write.enable, lane));
        }
        let at = self.values.get(self.running, write.address, lane);
        let width = at.width();
        let wanted = Bits::new(width.max(32), address.into()).resize(width);
        let differ = mask::xor(&at, &wanted);
        (!differ.is_zero()).then(|| Demand::control(write.address, lane, mask::first(&differ)))
    }

    fn is_one(&mut self, id: Option<ValueId>, lane: u32) -> bool {
        id.is_none_or(|id| self.values.is_one(self.running, id, lane))
    }
}

/// A flag, which chooses.
fn flag(id: ValueId, lane: u32) -> Demand {
    Demand::control(id, lane, mask::all(1))
}
