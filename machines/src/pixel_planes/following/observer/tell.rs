//! What is told of a renderer: what instructions did with the pixel, and what differs.

use tilewright_hdl::Codes;
use tilewright_rtl::pixel_planes::fields;
use tilewright_rtl::pixel_planes::instruction::Operation;
use tilewright_rtl::pixel_planes::pixel::{Enabling, Mask, Source};

use super::super::commands::Taken;
use super::{Observer, Sim};
use crate::error::Error;
use crate::told::{compared, value, violated};

impl Observer<'_> {
    pub(super) fn takes(&mut self, clock: u64, taken: &Taken) {
        self.taken = taken.number + 1;
        let Some(part) = self.parts.get(taken.number).filter(|part| part.here) else { return };
        let [seen, right] = [taken.instruction.operation, part.instruction.operation]
            .map(|code| Operation::ALL.get(code as usize).map_or("no operation", |it| it.name()));
        let step = self.units[1].step_at(
            "instructions_operation",
            clock,
            part.primitive.map(|it| it as usize),
            "takes an instruction",
            vec![compared("operation", seen, right)],
        );
        self.told.tell(step);
    }

    /// Tells what instructions did, in the clock after their last bits were at the pixel.
    pub(super) fn tell_what_ended(&mut self, sim: &mut Sim, clock: u64) {
        let is_ended = |it: &&Taken| it.times.ends + self.lag == clock;
        let ended: Vec<Taken> = self.commands.under_way.iter().filter(is_ended).copied().collect();
        for taken in ended {
            let Some(part) = self.parts.get(taken.number).copied().filter(|part| part.here) else { continue };
            self.tell(sim, clock, &taken, part.primitive);
        }
    }

    fn tell(&mut self, sim: &mut Sim, clock: u64, taken: &Taken, primitive: Option<u32>) {
        let Taken { instruction, code, .. } = taken;
        let number = primitive.map(|it| it as usize);
        let operation = Operation::ALL[instruction.operation as usize].name();
        if taken.is_expression() {
            let words = self.expressions.word(instruction.length);
            let is_edge = code.enabling != Enabling::Keep.code();
            let shown = |word: u64| match is_edge {
                true => ["inside", "outside"][word as usize & 1].to_owned(),
                false => format!("{word:x}"),
            };
            let [seen, right] = words.map(shown);
            let what = if is_edge { "sign" } else { "value" };
            let does = format!("evaluates the expression of {operation}");
            let mut values = vec![value("coefficients", self.coefficients(taken))];
            values.push(compared(what, seen, right));
            let step = self.units[2].step_at("value", clock, number, does, values);
            self.told.tell(step);
        }
        let memory = self.memory(sim);
        let [_, enable, flag] = self.flags(sim);
        let Some(pixel) = &self.pixel else { return };

        let mut values = Vec::new();
        if code.enabling != Enabling::Keep.code() || code.captures == 1 {
            values.push(compared("enable", enable, u64::from(pixel.enable)));
        }
        if code.compares == 1 {
            values.push(compared("flag", flag, u64::from(pixel.flag)));
        }
        if code.mask != Mask::Nobody.code() {
            let (first, length) = (instruction.write, instruction.length);
            let bit = |bit: u64| u64::from(sim.word(memory, (first + bit) as u32).bit(0)) << bit;
            let [seen, right] =
                [(0..length).map(bit).sum(), pixel.word(first, length)].map(|word: u64| format!("{word:x}"));
            values.push(compared("word", seen, right));
        }
        if !values.is_empty() {
            let step = self.units[3].step_at("enable", clock, number, format!("does {operation}"), values);
            self.told.tell(step);
        }
        if let Some(primitive) = primitive {
            let drawn = self.drawn.entry(primitive).or_default();
            // Edges of the next primitive may already be under way.
            if code.enabling != Enabling::Keep.code() {
                drawn.enabled = enable == 1;
            }
            drawn.depth = pixel.word(fields::DEPTH.new_value().address.into(), 24);
            drawn.rgb = match code.source == Source::Constant.code() && code.on_memory == 1 {
                true => instruction.coefficients.c & 0xff_ffff,
                false => pixel.word(fields::RGB.new_value().address.into(), 24),
            };
        }
    }

    /// The coefficients of an expression, as an engineer writes it.
    fn coefficients(&self, taken: &Taken) -> String {
        let signed = |number: u64| (number << 24) as i64 >> 24;
        let it = &taken.instruction.coefficients;
        let [a, b, c] = [it.a, it.b, it.c].map(signed);
        let [d, e, f] = taken.curve.map(signed);
        let quadratic = if self.quadratic { format!(" {d:+} x x {e:+} x y {f:+} y y") } else { String::new() };
        format!("{a} x {b:+} y {c:+}{quadratic}")
    }

    /// The step of an error that nothing told before.
    pub fn fail(&mut self, clock: u64, error: &Error) {
        if self.told.differs() {
            return;
        }
        let (unit, what) = match (violated(error), error) {
            (Some((instance, sentence)), _) => {
                let unit = self.units.iter().position(|unit| unit.is(instance));
                (unit.unwrap_or(5), sentence.to_owned())
            }
            (None, Error::Differs { signal, seen, expected, .. }) => (5, format!("{signal} is {seen}, not {expected}")),
            _ => return,
        };
        self.told.tell(self.units[unit].fails(clock, &what));
    }
}
