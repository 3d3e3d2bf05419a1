//! What is told of an array: what instructions did with the pixel, and what differs.

use tilewright_hdl::Codes;
use tilewright_rtl::pixelflow::fields::{Field, appearance};
use tilewright_rtl::pixelflow::instruction::Instruction;
use tilewright_rtl::pixelflow::pixel::{Enabling, Function, Mask};

use super::super::commands::Taken;
use super::{ArrayObserver, Sim};
use crate::error::Error;
use crate::told::{compared, value, violated};
use crate::way::{Compared, Step};

impl ArrayObserver {
    /// The instructions with these numbers, from now on, are told, with the primitives that they are of.
    pub fn tells(&mut self, first: usize, primitives: Vec<Option<usize>>) {
        self.programs.push_back((first, primitives));
    }

    /// The number of instructions so far.
    pub fn taken(&self) -> usize {
        self.commands.count
    }

    /// Compares the byte that a port reads, which is that of the pixel, with the registers.
    pub fn read(&mut self, tick: u64, bank: usize, address: u64, seen: u64, does: &str) {
        let it = &mut self.banks[bank];
        let right = it.bytes.get(address as usize).copied().map_or(0, u64::from);
        if seen == right {
            return;
        }
        let values = vec![value("register", address), compared("byte", format!("{seen:02x}"), format!("{right:02x}"))];
        let net = format!("seen[{}]", self.place.chip);
        let step = Step { time: tick * 5000, ..it.unit.step_at(&net, tick / 2, None, does, values) };
        self.told.tell(step);
    }

    /// Whether a byte is that of the pixel, and its chip.
    pub fn chip_of(&self, pixel: u64) -> Option<u32> {
        (pixel == u64::from(self.place.pixel)).then_some(self.place.chip)
    }

    /// Tells the word of the pixel in a bank.
    pub fn word(&mut self, sim: &Sim, tick: u64, bank: usize, bytes: u64, does: &str) {
        let it = &self.banks[bank];
        let hex = |byte: &dyn Fn(usize) -> u64| {
            (0..bytes as usize).rev().map(|at| format!("{:02x}", byte(at))).collect::<String>()
        };
        let seen = hex(&|at| it.register(sim, at).unwrap_or(0));
        let values = vec![compared("word", seen, hex(&|at| it.bytes[at].into()))];
        let step = it.unit.step_at(&format!("seen[{}]", self.place.chip), tick / 2, None, does, values);
        self.told.tell(Step { time: tick * 5000, ..step });
    }

    /// The primitive of an instruction that is told.
    fn part(&mut self, number: usize) -> Option<Option<usize>> {
        while self.programs.front().is_some_and(|(first, parts)| number >= first + parts.len() + 64) {
            self.programs.pop_front();
        }
        let of = |(first, parts): &(usize, Vec<Option<usize>>)| parts.get(number.checked_sub(*first)?).copied();
        self.programs.iter().find_map(of)
    }

    pub(super) fn takes(&mut self, clock: u64, taken: &Taken) {
        let Some(primitive) = self.part(taken.number) else { return };
        let beside = |what, of: fn(&Instruction<u64>) -> String| {
            let golden = self.shown.as_ref().map(of);
            Compared { what, hardware: of(&taken.instruction), golden }
        };
        let values = vec![
            beside("function", |it| Function::ALL.get(it.function as usize).map_or("none", |it| it.name()).to_owned()),
            beside("bytes", |it| it.length.to_string()),
        ];
        self.told.tell(self.units[0].step_at(
            "instructions_function",
            clock,
            primitive,
            "takes an instruction",
            values,
        ));
    }

    pub(super) fn tell_what_ended(&mut self, sim: &mut Sim, clock: u64) {
        let is_ended = |it: &&Taken| it.times.ends + self.lag as u64 == clock;
        let ended: Vec<Taken> = self.commands.under_way.iter().filter(is_ended).copied().collect();
        for taken in ended {
            let Some(primitive) = self.part(taken.number) else { continue };
            self.tell(sim, clock, &taken, primitive);
        }
    }

    /// Notes the word of a primitive that enables the pixel: that of its new values so far.
    fn draws(&mut self, primitive: usize, enables: Option<bool>) {
        let Some(pixel) = &self.pixel else { return };
        let number = |field: Field| {
            (0..field.bytes).map(|byte| u64::from(pixel.memory[field.byte(byte) as usize]) << (8 * byte)).sum::<u64>()
        };
        let [red, green, blue] = appearance::RGB.map(number);
        let word = number(appearance::DEPTH) << 24 | red << 16 | green << 8 | blue;
        match (enables, self.drawn.get_mut(&primitive)) {
            (Some(true), _) => drop(self.drawn.insert(primitive, word)),
            (Some(false), _) => drop(self.drawn.remove(&primitive)),
            (None, Some(drawn)) => *drawn = word,
            (None, None) => {}
        }
    }

    fn tell(&mut self, sim: &Sim, clock: u64, taken: &Taken, primitive: Option<usize>) {
        let i = &taken.instruction;
        let Some(memory) = self.memory else { return };
        let changes = i.enabling != Enabling::Keep.code();
        let [_, _, flag, enable] = self.looks.from::<4>(self.places[3] + 4);
        if taken.is_expression() && changes {
            let Some([seen, right]) = self.seen.back() else { return };
            let [seen, right] = [seen, right].map(|byte| if byte & 0x80 == 0 { "inside" } else { "outside" });
            let net = format!("value[{}][{}]", self.place.chip, self.place.pixel);
            let values = vec![compared("sign", seen, right)];
            let step = self.units[1].step_at(&net, clock, primitive, "evaluates an edge", values);
            self.told.tell(step);
        }
        if let Some(primitive) = primitive {
            self.draws(primitive, changes.then_some(enable & 1 == 1));
        }
        let Some(pixel) = &self.pixel else { return };
        let mut values = Vec::new();
        if changes {
            values.push(compared("enable", enable & 1, pixel.enable & 1));
        }
        if i.flagging != 0 {
            values.push(compared("flag", flag, u64::from(pixel.flag)));
        }
        if i.mask != Mask::Nobody.code() && i.stores == 1 {
            let first = if i.descends == 1 { i.write + 1 - i.length } else { i.write };
            let word = |byte: &dyn Fn(u64) -> u64| {
                format!("{:x}", (0..i.length).map(|at| byte(first + at) << (8 * at)).sum::<u64>())
            };
            let hardware = |address: u64| match self.banks.iter().rev().find(|bank| address >= bank.first as u64) {
                Some(bank) => bank.register(sim, address as usize - bank.first),
                None => sim.word(memory, address as u32).to_u64(),
            };
            let model = |address: u64| match self.banks.iter().rev().find(|bank| address >= bank.first as u64) {
                Some(bank) => bank.bytes[address as usize - bank.first].into(),
                None => pixel.memory[address as usize].into(),
            };
            let seen = word(&|address| hardware(address).unwrap_or(0));
            values.push(value("address", first));
            values.push(compared("word", seen, word(&model)));
        }
        if !values.is_empty() {
            let step = self.units[2].step_at("enable", clock, primitive, "works on a word", values);
            self.told.tell(step);
        }
    }

    /// The step of an error that nothing told before.
    pub fn fail(&mut self, tick: u64, error: &Error) {
        if self.told.differs() {
            return;
        }
        let (unit, what) = match (violated(error), error) {
            (Some((instance, sentence)), _) => {
                let mut units = self.units.iter().chain(self.banks.iter().map(|bank| &bank.unit));
                let unit = units.find(|unit| unit.is(instance));
                (unit.unwrap_or(&self.units[3]), sentence.to_owned())
            }
            (None, Error::Differs { signal, seen, expected, .. }) => {
                (&self.units[3], format!("{signal} is {seen}, not {expected}"))
            }
            _ => return,
        };
        self.told.tell(unit.fails(tick / 2, &what));
    }
}
