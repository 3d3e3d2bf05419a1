//! What a node's controller has to send for the instructions that it takes, byte by byte.

use std::collections::VecDeque;
use std::sync::LazyLock;

use tilewright_hdl::{Bundle, Codes};
use tilewright_rtl::pixel_planes::schedule::{Schedule, Step, Times};
use tilewright_rtl::pixelflow::emulator::{control, effect, signed};
use tilewright_rtl::pixelflow::instruction::{Instruction, LONGEST, Sync};
use tilewright_rtl::pixelflow::pixel::{Control, Enabling, Flagging, Function, Mask, Source};
use tilewright_rtl::pixelflow::schedule::step;

use crate::looks::fields;
use crate::told::Checks;

/// The fields of an instruction at a controller, after its path.
pub(super) static FIELDS: LazyLock<Vec<String>> =
    LazyLock::new(|| fields::<Instruction>("instructions", &Instruction::NOTHING));
/// The fields of the pixels' control.
pub(super) static CONTROL: LazyLock<Vec<String>> = LazyLock::new(|| fields::<Control>("control", &Control::ZERO));
/// A controller's other inputs, and its outputs.
pub(super) const NETS: [&str; 12] = [
    "instructions_valid",
    "instructions_ready",
    "bank_done",
    "texture_done",
    "coefficients_a",
    "coefficients_b",
    "coefficients_c",
    "first",
    "sends",
    "given_banks",
    "given_texture",
    "idle",
];

/// An instruction that was taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taken {
    pub number: usize,
    pub instruction: Instruction<u64>,
    pub step: Step,
    pub times: Times,
}

impl Taken {
    pub fn is_expression(&self) -> bool {
        self.instruction.source == Source::Expression.code()
    }

    /// The byte of its word that is sent in that clock.
    fn byte(&self, clock: u64) -> Option<u64> {
        let first = self.times.ends - self.instruction.length;
        clock.checked_sub(first).filter(|_| clock < self.times.ends)
    }
}

/// The model of a controller.
pub(super) struct Commands {
    schedule: Schedule,
    lag: u64,
    side_by_side: bool,
    /// The number of instructions so far.
    pub count: usize,
    /// Banks that the network has, and whether the unit at the texture port works.
    banks: u64,
    texture: bool,
    pub under_way: VecDeque<Taken>,
}

/// The instruction of those fields.
pub(super) fn instruction(fields: [u64; 18]) -> Instruction<u64> {
    record::<Instruction, 18>(&Instruction::NOTHING, fields)
}

/// The control of those fields, if all of them are codes.
pub(super) fn control_of(fields: [u64; 13]) -> Option<Control<u64>> {
    let c = record::<Control, 13>(&Control::ZERO, fields);
    let is_sound = (c.function as usize) < Function::ALL.len()
        && c.begin < 3
        && c.condition < 3
        && (c.enabling as usize) < Enabling::ALL.len()
        && c.flagging < 3
        && c.read < 384
        && c.write < 384;
    is_sound.then_some(c)
}

impl Commands {
    pub fn new(lag: u32, side_by_side: bool) -> Commands {
        Commands {
            schedule: Schedule::new(side_by_side),
            lag: lag.into(),
            side_by_side,
            count: 0,
            banks: 0,
            texture: false,
            under_way: VecDeque::new(),
        }
    }

    /// Compares all outputs in a clock. Returns the instruction that is taken.
    pub fn look(
        &mut self,
        clock: u64,
        fields: [u64; 18],
        nets: [u64; 12],
        sent: [u64; 13],
        checks: &mut Checks,
    ) -> Option<Taken> {
        let [valid, ready, bank_done, texture_done, coefficients @ ..] = nets;
        let [a, b, c, first, sends, banks, texture, idle] = coefficients;
        self.under_way.retain(|it| clock <= it.times.ends + self.lag);
        self.coefficients(clock, [a, b, c, first, sends], checks);
        let given = self.control(clock, sent, checks);
        checks.same("given_banks", banks, given[0]);
        checks.same("given_texture", texture, given[1]);

        let instruction = instruction(fields);
        let is_instruction = valid == 1
            && (1..=LONGEST.into()).contains(&instruction.length)
            && (instruction.enabling as usize) < Enabling::ALL.len();
        let bank = 1 << (instruction.c & 1);
        let clocks = is_instruction.then(|| step(&instruction));
        if let Some(step) = clocks {
            let is = |sync: Sync| instruction.sync == sync as u64;
            let waits = is(Sync::AwaitBank) && self.banks & bank != 0 || is(Sync::AwaitTexture) && self.texture;
            let is_alone = !is(Sync::Nothing) || !self.side_by_side;
            let from = self.schedule.ready(&step);
            let from = if is_alone && self.count > 0 { from.max(self.schedule.idle() - 1) } else { from };
            checks.bit("instructions_ready", ready, clock >= from && !waits);
        }
        let is_idle = valid == 0 && (self.count == 0 || clock >= self.schedule.idle());
        checks.bit("idle", idle, is_idle);
        self.banks &= !bank_done;
        self.texture &= texture_done == 0;
        clocks.filter(|_| ready == 1).map(|step| {
            let times = self.schedule.take_at(&step, clock);
            if instruction.sync == Sync::GiveBank as u64 {
                self.banks |= bank;
            }
            self.texture |= instruction.sync == Sync::StartTexture as u64;
            let taken = Taken { number: self.count, instruction, step, times };
            self.count += 1;
            self.under_way.push_back(taken);
            taken
        })
    }

    fn coefficients(&self, clock: u64, [a, b, c, first, sends]: [u64; 5], checks: &mut Checks) {
        let is_sent = |it: &&Taken| it.is_expression() && (it.times.begins..it.times.ends).contains(&clock);
        let expression = self.under_way.iter().find(is_sent);
        checks.bit("first", first, expression.is_some_and(|it| it.times.begins == clock));
        checks.bit("sends", sends, expression.is_some());
        let Some(it) = expression else { return };
        let byte = clock - it.times.begins;
        let names = ["coefficients_a", "coefficients_b", "coefficients_c"];
        let of = [it.instruction.a, it.instruction.b, it.instruction.c];
        for ((name, seen), number) in names.into_iter().zip([a, b, c]).zip(of) {
            checks.same(name, seen, (signed(number) >> (8 * byte).min(63)) as u64 & 0xff);
        }
    }

    /// Compares what of the pixels' control has an effect. Returns what is handed over.
    fn control(&self, clock: u64, sent: [u64; 13], checks: &mut Checks) -> [u64; 2] {
        let Some(sent_in) = clock.checked_sub(self.lag) else { return [0; 2] };
        let words = || self.under_way.iter().filter_map(|it| Some((it, it.byte(sent_in)?)));
        let on_memory = words().find(|(it, _)| it.step.on_memory);
        let on_tree = words().find(|(it, _)| it.step.on_tree);
        let nothing =
            Instruction { flagging: Flagging::Keep.code(), mask: Mask::Nobody.code(), ..Instruction::NOTHING };
        let memory =
            on_memory.as_ref().map_or_else(|| control(&nothing, 0), |(it, byte)| control(&it.instruction, *byte));
        let tree = on_tree.as_ref().map_or_else(|| control(&nothing, 0), |(it, byte)| control(&it.instruction, *byte));
        let right = Control { enabling: tree.enabling, by_sign: tree.by_sign, ..memory };
        let right = fields_of(&effect(&right));
        match control_of(sent).map(|sent| effect(&sent)) {
            Some(seen) => CONTROL.iter().zip(fields_of(&seen)).zip(right).for_each(|((name, seen), right)| {
                checks.same(name, seen, right);
            }),
            None => checks.same("control", "no code".to_owned(), "codes".to_owned()),
        }
        let ends = words().filter(|(it, byte)| byte + 1 == it.instruction.length);
        ends.fold([0; 2], |[banks, texture], (it, _)| {
            let i = &it.instruction;
            let bank = if i.sync == Sync::GiveBank as u64 { 1 << (i.c & 1) } else { 0 };
            [banks | bank, texture | u64::from(i.sync == Sync::StartTexture as u64)]
        })
    }
}

/// A record of these numbers, in the sequence of its fields; `like` is any record of its kind.
fn record<B: Bundle, const N: usize>(like: &B::Of<u64>, numbers: [u64; N]) -> B::Of<u64> {
    let mut numbers = numbers.into_iter();
    B::convert_leaves(like, &mut |_: &u64| numbers.next().expect("a number for each field"))
}

/// The numbers of the fields of a control.
fn fields_of(control: &Control<u64>) -> [u64; 13] {
    let mut numbers = [0; 13];
    let mut places = numbers.iter_mut();
    <Control as Bundle>::convert_leaves(control, &mut |number: &u64| {
        *places.next().expect("a place for each field") = *number;
        *number
    });
    numbers
}
