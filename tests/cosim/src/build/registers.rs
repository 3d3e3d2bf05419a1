//! Steps that are registers of one value.

use super::records::Pair;
use super::{Builder, Kind, Late};
use crate::features::Feature;
use crate::spec::*;
use tilewright_hdl::*;

impl Builder<'_> {
    pub fn register(&mut self, d: usize, number: usize, make: &Make) {
        let Make::Register { form, attribute, reset, enable, updates, next } = make else {
            unreachable!("it is a register")
        };
        let meaning = form.meaning;
        meaning.used(Feature::SignedRegister, Feature::CodeRegister);
        let name = self.inner_name(&format!("r{number}"));
        let mut register = self.on(d).reg(&name, form.layout());
        if let Some(reset) = reset {
            register = register.reset(meaning.constant(*reset, form.width));
        }
        if *attribute {
            Feature::AttributeOfARegister.used();
            register = register.attribute("keep", "true");
        }
        if let Some(enable) = enable {
            register = register.enable(self.pick_fit(d, *enable, 1));
        }
        self.push(d, *register);
        let late = match (&updates[..], *next) {
            ([], Some(next)) => Late::Next(register, meaning, next),
            (_, otherwise) => Late::Updates { register, meaning, updates: updates.clone(), otherwise },
        };
        self.late.push((d, late));
    }

    /// What a register takes by priority.
    pub fn updates(
        &mut self,
        d: usize,
        register: Reg,
        meaning: Meaning,
        updates: &[(Pick, Pick)],
        otherwise: Option<Pick>,
    ) {
        let Some((first, rest)) = updates.split_first() else { return register.next(*register) };
        let width = register.width();
        let arm = |&(condition, value)| (self.pick_late(d, condition, 1), self.given_late(d, value, meaning, width));
        let (condition, value) = arm(first);
        let mut chain = register.when(condition, value);
        for (condition, value) in rest.iter().map(arm) {
            chain = chain.when(condition, value);
        }
        if let Some(otherwise) = otherwise {
            chain.otherwise(self.given_late(d, otherwise, meaning, width));
        }
    }

    /// A register with a value at power-on.
    pub fn power_on(&mut self, d: usize, number: usize, make: &Make) {
        let Make::PowerOn { meaning, initial, reset, next } = make else { unreachable!("it is a register") };
        meaning.used(Feature::SignedRegister, Feature::CodeRegister);
        let name = self.inner_name(&format!("o{number}"));
        let next = self.pick_as(d, *next, *meaning);
        let width = next.width();
        let register = self.on(d).reg(&name, meaning.layout(width)).initial(meaning.constant(*initial, width));
        let register = reset.map_or(register, |reset| register.reset(meaning.constant(reset, width)));
        register.next(next);
        self.push(d, *register);
    }

    /// A register that takes over a value, or a record.
    pub fn pipe(&mut self, d: usize, number: usize, make: &Make) {
        let Make::Pipe { meaning, of, beside, enable } = make else { unreachable!("it is a register") };
        meaning.used(Feature::SignedPipe, Feature::CodePipe);
        let of = self.pick_as(d, *of, *meaning);
        let enable = enable.map(|enable| self.pick_fit(d, enable, 1));
        let plain = format!("d{number}");
        let Some(beside) = beside else {
            let name = self.inner_name(&plain);
            let held = taken_over(self.on(d), enable, &name, of);
            return self.push(d, held);
        };
        Feature::PipeOfARecord.used();
        let pair = Pair { low: of, high: self.pick(d, *beside) };
        let name = self.namer.draw_with(&plain, Kind::Inner, &["_low", "_high"].map(str::to_owned));
        let held: Pair = taken_over(self.on(d), enable, &name, pair);
        [held.low, held.high].into_iter().for_each(|signal| self.push(d, signal));
    }

    /// So many registers of some width, each taking over the one before; the first one `from`, or the last one.
    pub fn chain(
        &mut self,
        d: usize,
        number: usize,
        (width, length): (u32, u32),
        enable: Option<Pick>,
        from: Option<Pick>,
    ) {
        let enable = enable.map(|pick| self.pick_fit(d, pick, 1));
        let names = (0..length.max(1)).map(|place| self.inner_name(&format!("c{number}_{place}"))).collect::<Vec<_>>();
        let register = |(place, name): (u32, &String)| {
            let register = self.on(d).reg(name, width);
            let register = if place.is_multiple_of(2) {
                register.reset(Pattern::Number(0x9e37_79b9 << place).bits(width))
            } else {
                register
            };
            enable.map_or(register, |enable| register.enable(enable))
        };
        let registers: Vec<Reg> = (0..).zip(&names).map(register).collect();
        registers.windows(2).for_each(|pair| pair[1].next(*pair[0]));
        let last = registers[registers.len() - 1];
        match from {
            Some(from) => self.late.push((d, Late::Next(registers[0], Meaning::Number, from))),
            None => registers[0].next(*last),
        }
        self.push(d, *last);
        self.push(d, *registers[0]);
    }
}

/// What a register of a value, or of each field of a record, holds, which takes it where the enable holds if there is one.
fn taken_over<B: Fields<Signal>>(m: Module, enable: Option<Signal>, name: &str, value: B) -> B::With<Signal> {
    let Some(enable) = enable else { return m.pipe(name, value) };
    Feature::PipeWhen.used();
    m.pipe_when(enable, name, value)
}
